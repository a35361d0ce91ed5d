// SPDX-License-Identifier: MIT
//
// osg-threads: a day of an animated scene in OpenSceneGraph's four threading models, on a display.
//     osg-threads [--frames N] [--plant] [--probes]
// Each model's pictures are the single thread's, and no draw sees its light change. With
// --plant the light's StateSet says STATIC, so that OpenSceneGraph does not wait: the fault that
// this and the thread sanitizer must see.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include <osg/Drawable>
#include <osg/Texture2DArray>
#include <osgViewer/Viewer>

#include "hosts/osg/lighting.h"
#include "hosts/osg/snapshot.h"
#include "osg_scene.h"

namespace lodestar::testing {
namespace {

using osghost::Lighting;
constexpr int kWidth = 96, kHeight = 64;

struct Model {
    osgViewer::ViewerBase::ThreadingModel model;
    const char* name;
    bool drawsBesideUpdate;
};
constexpr Model kModels[] = {
    {osgViewer::ViewerBase::SingleThreaded, "SingleThreaded", false},
    {osgViewer::ViewerBase::CullDrawThreadPerContext, "CullDrawThreadPerContext", false},
    {osgViewer::ViewerBase::DrawThreadPerContext, "DrawThreadPerContext", true},
    {osgViewer::ViewerBase::CullThreadPerCameraDrawThreadPerContext,
     "CullThreadPerCameraDrawThreadPerContext", true}};

/// Reads what OpenSceneGraph's own draw reads, twice: its code cannot be instrumented, this is.
class Watch : public osg::Drawable::DrawCallback {
public:
    /// @param patience how long a draw waits for its light to change, at most [ms]
    Watch(const Lighting& node, int patience) : node_(node), patience_(patience) {}

    void drawImplementation(osg::RenderInfo& info, const osg::Drawable* drawable) const override {
        const std::vector<float> before = seen();
        bool same = true;
        for (int waited = 0; waited < patience_ && same && changed < kEnough; waited += 2) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            same = seen() == before;
        }
        ++drawn;
        changed += same ? 0 : 1;
        drawable->drawImplementation(info);
    }

    mutable std::atomic<int> drawn{0}, changed{0};

private:
    std::vector<float> seen() const {
        const osg::StateSet& state = *node_.getLightState();
        std::vector<float> values;
        for (const auto& [name, uniform] : state.getUniformList()) {
            const osg::FloatArray* floats = uniform.first->getFloatArray();
            for (std::size_t i = 0; floats != nullptr && i < floats->size(); ++i) {
                values.push_back((*floats)[i]);
            }
        }
        for (unsigned unit = 0; unit < 3; ++unit) {
            const auto* texture = static_cast<const osg::Texture2DArray*>(
                state.getTextureAttribute(unit, osg::StateAttribute::TEXTURE));
            const osg::Image& image = *texture->getImage(0);
            const float* texels = reinterpret_cast<const float*>(image.data());
            for (std::size_t i = 0; i < image.getTotalSizeInBytes() / sizeof(float); i += 16) {
                values.push_back(texels[i]);
            }
        }
        return values;
    }

    static constexpr int kEnough = 3;
    const Lighting& node_;
    int patience_;
};

constexpr const char* kProbe = R"("probes": [{"name": "own", "node": "golden",
    "capture": {"resolution": 16, "near": 0.9, "far": 50}, "influence": {"shape": "box", "size": [2, 2, 2]}}], )";

/// A day: the hour goes on, a ball moves. With probes the hour stays, for captures come when they
/// come: once the ball stands still, pictures are the same again.
struct Day {
    std::string document;
    osg::ref_ptr<Lighting> lighting = new Lighting;
    osg::ref_ptr<Watch> watch;

    Day(int patience, bool probes) : watch(new Watch(*lighting, patience)) {
        document = kDay;
        if (probes) {
            document.insert(document.find("\"lights\""), kProbe);
        }
        lighting->setDocument(document);
        lighting->setHour(7.0);
        lighting->setHoursPerSecond(probes ? 0.0 : 6.0);
        addBalls(*lighting);
        ballNode(1).setName("golden");
        osg::Drawable& watched = *ballNode(0).getChild(0)->asGeode()->getDrawable(0);
        watched.setUseDisplayList(false); // a list calls back once only
        watched.setUseVertexBufferObjects(true);
        watched.setDrawCallback(watch);
    }
    osg::MatrixTransform& ballNode(unsigned i) {
        return static_cast<osg::MatrixTransform&>(*lighting->getChild(i));
    }
};

bool openPbuffer(osgViewer::Viewer& viewer) {
    const osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->width = kWidth;
    traits->height = kHeight;
    traits->pbuffer = true;
    traits->doubleBuffer = true;
    traits->alpha = 0; // with alpha each swap of GLX's pbuffers is an X error
    const osg::ref_ptr<osg::GraphicsContext> context =
        osg::GraphicsContext::createGraphicsContext(traits);
    if (!context) {
        return false;
    }
    osg::Camera& camera = *viewer.getCamera();
    camera.setGraphicsContext(context);
    camera.setViewport(0, 0, kWidth, kHeight);
    camera.setDrawBuffer(GL_BACK);
    camera.setReadBuffer(GL_BACK);
    camera.setClearColor(osg::Vec4(0, 0, 0, 1));
    camera.setViewMatrix(viewOfBalls());
    camera.setProjectionMatrix(projectionOfBalls());
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    return true;
}

using Picture = std::vector<unsigned char>;

struct Outcome {
    Picture middle, last;       ///< frames; empty: none
    int drawn = 0, changed = 0; ///< of the watched ball
};

Picture bytesOf(const osg::Image& image) {
    return {image.data(), image.data() + image.getTotalSizeInBytes()};
}

Outcome play(osgViewer::ViewerBase::ThreadingModel model, int frames, bool plant, bool probes) {
    // An update lasts about a millisecond; the fault is waited for, however slow the machine is.
    Day day(plant ? 500 : 4, probes);
    osgViewer::Viewer viewer;
    if (!openPbuffer(viewer)) {
        return {};
    }
    const osg::ref_ptr<osghost::Snapshot> middle =
        new osghost::Snapshot(static_cast<unsigned>(frames / 2));
    const osg::ref_ptr<osghost::Snapshot> last =
        new osghost::Snapshot(static_cast<unsigned>(frames));
    viewer.getCamera()->addFinalDrawCallback(middle);
    viewer.getCamera()->addFinalDrawCallback(last);
    viewer.setSceneData(day.lighting);
    viewer.setThreadingModel(model);
    viewer.realize();
    for (int i = 0; i < frames; ++i) {
        const double time = i / 30.0;
        const double way = probes ? std::min(i, frames / 3) / 30.0 : time;
        day.ballNode(1).setMatrix(osg::Matrix::translate(1.1 - 0.8 * way, 0.5 * way, 0.0));
        if (i == frames / 4 && !plant) { // the same again, by another context and StateSet
            day.lighting->setDocument(day.document + "\n");
        }
        viewer.frame(time);
        if (plant) {
            day.lighting->getLightState()->setDataVariance(osg::Object::STATIC);
        }
    }
    last->wait(20.0);
    viewer.stopThreading();
    return {bytesOf(middle->image()), bytesOf(last->image()), day.watch->drawn, day.watch->changed};
}

/// @return bytes that differ; -1 where there are not two whole pictures
int count(const Picture& a, const Picture& b) {
    if (a.size() != std::size_t{kWidth} * kHeight * 4 || b.size() != a.size()) {
        return -1;
    }
    int different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        different += a[i] != b[i] ? 1 : 0;
    }
    return different;
}

int run(int frames, bool plant, bool probes) {
    const Outcome wanted = play(kModels[0].model, frames, false, probes);
    const int motion = probes
                           ? count(play(kModels[0].model, frames, false, false).last, wanted.last)
                           : count(wanted.middle, wanted.last);
    std::printf("%s: %d bytes differ\n", probes ? "probes" : "half the day", motion);
    bool passed = motion > 0;
    for (const Model& model : kModels) {
        if (plant && !model.drawsBesideUpdate) {
            continue;
        }
        const Outcome outcome = play(model.model, frames, plant, probes);
        const int middle = count(outcome.middle, wanted.middle);
        const int last = count(outcome.last, wanted.last);
        std::printf("%s: %d draws, %d saw their light change; %d and %d bytes differ\n", model.name,
                    outcome.drawn, outcome.changed, middle, last);
        const bool asExpected = plant
                                    ? outcome.changed > 0
                                    : outcome.changed == 0 && (probes || middle == 0) && last == 0;
        // Faces draw it too.
        const bool drawn = probes ? outcome.drawn > frames : outcome.drawn == frames;
        passed = passed && asExpected && drawn;
    }
    return passed ? 0 : 1;
}

} // namespace
} // namespace lodestar::testing

int main(int argc, char** argv) {
    int frames = 36;
    bool plant = false, probes = false;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--plant") == 0) {
            plant = true;
        } else if (std::strcmp(argv[i], "--probes") == 0) {
            probes = true;
        } else if (std::strcmp(argv[i], "--frames") == 0 && i + 1 < argc) {
            frames = std::atoi(argv[++i]);
        }
    }
    return lodestar::testing::run(frames < 4 ? 4 : frames, plant, probes);
}
