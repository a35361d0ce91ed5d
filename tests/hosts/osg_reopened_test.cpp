// SPDX-License-Identifier: MIT
//
// Documents opened again and light that changes while OpenSceneGraph draws: the textures of the old
// ones end and are taken for new ones, without an error of OpenGL's, and the pictures are the same.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <EGL/egl.h>
#include <gtest/gtest.h>
#include <osg/DisplaySettings>
#include <osgUtil/SceneView>

#include "hosts/osg/headless.h"
#include "hosts/osg/lighting.h"
#include "osg_scene.h"

namespace lodestar::testing {
namespace {

/// Errors that the driver has told of, in the current context and from now on.
int errors = 0;
void countErrors() {
    using Called =
        void(GLenum, GLenum type, GLuint, GLenum, GLsizei, const char* text, const void*);
    const auto callBack = reinterpret_cast<void (*)(Called*, const void*)>(
        eglGetProcAddress("glDebugMessageCallback"));
    constexpr GLenum kOutput = 0x92E0, kAtOnce = 0x8242, kError = 0x824C; // KHR_debug
    ASSERT_NE(callBack, nullptr);
    glEnable(kOutput);
    glEnable(kAtOnce);
    callBack(
        [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const char* text, const void*) {
            if (type == kError) {
                std::printf("%s\n", text);
                ++errors;
            }
        },
        nullptr);
}

/// In each update but the last ones it opens the document anew, or moves a ball.
struct Changes : osg::NodeCallback {
    Changes(osghost::Lighting& changed, osg::MatrixTransform& moved, bool reopens)
        : lighting(changed), ball(moved), document(changed.getDocument()), opens(reopens) {}
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        ++updates;
        if (updates <= kChanges) {
            if (opens && updates % 3 == 0) {
                document += "\n";
                lighting.setDocument(document);
            }
            ball.setMatrix(osg::Matrixd::translate(-1.1, 0.02 * (kChanges - updates), 0.0));
        }
        traverse(node, visitor);
    }
    static constexpr int kChanges = 24;
    osghost::Lighting& lighting;
    osg::MatrixTransform& ball;
    std::string document;
    bool opens;
    int updates = 0;
};

/// Two balls under a sky, the golden one, second, with a probe of its own.
osg::ref_ptr<osghost::Lighting> balls() {
    constexpr const char* kProbe = R"("probes": [{"node": "golden", "capture": {"resolution": 16,
        "near": 0.95, "far": 50}, "influence": {"shape": "box", "size": [2, 2, 2]}}], )";
    osg::ref_ptr<osghost::Lighting> node = new osghost::Lighting;
    std::string document = kDay;
    document.insert(document.find("\"lights\""), kProbe);
    node->setDocument(document);
    addBalls(*node);
    node->getChild(1)->setName("golden");
    return node;
}

osg::ref_ptr<osg::Image> drawn(bool changes, bool reopens) {
    const osg::ref_ptr<osghost::Lighting> node = balls();
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(node);
    if (changes) {
        auto& red = static_cast<osg::MatrixTransform&>(*node->getChild(0));
        root->setUpdateCallback(new Changes(*node, red, reopens));
    }
    EXPECT_TRUE(osghost::makeContextCurrent());
    countErrors();
    return osghost::drawOnce(*root, viewOfBalls(), projectionOfBalls(), 96, 64,
                             Changes::kChanges + 24);
}

int largest(const osg::Image& a, const osg::Image& b) {
    int most = 0;
    for (unsigned i = 0; i < a.getTotalSizeInBytes(); ++i) {
        most = std::max(most, std::abs(int{a.data()[i]} - int{b.data()[i]}));
    }
    return most;
}

TEST(OsgReopened, NoTextureIsGivenStorageTwice) {
    osg::DisplaySettings::instance()->setMaxTexturePoolSize(256u << 20); // what ends is kept
    errors = 0;
    const osg::ref_ptr<osg::Image> still = drawn(false, false);
    for (const bool reopens : {false, true}) {
        const osg::ref_ptr<osg::Image> last = drawn(true, reopens);
        EXPECT_LE(largest(*still, *last), 1) << reopens;
        EXPECT_EQ(errors, 0) << reopens;
    }
}

/// A scene view that culls and that nothing draws, as where the threading model changes.
void cullWithoutDrawing(osg::Group& root, int frames) {
    const osg::ref_ptr<osgUtil::SceneView> view = new osgUtil::SceneView;
    view->setDefaults();
    view->setViewport(0, 0, 96, 64);
    view->setViewMatrix(viewOfBalls());
    view->setProjectionMatrix(projectionOfBalls());
    view->setSceneData(&root);
    for (int frame = 0; frame < frames; ++frame) {
        view->update();
        view->cull();
    }
}

// A face that is culled and then never drawn is not waited for: others are drawn in its place.
TEST(OsgReopened, FacesThatAreNeverDrawnAreAskedForAgain) {
    const osg::ref_ptr<osg::Image> wanted = drawn(false, false);
    for (const int frames : {1, 2, 3, 4, 5, 9}) {
        const osg::ref_ptr<osghost::Lighting> node = balls();
        cullWithoutDrawing(*node, frames);
        EXPECT_TRUE(osghost::makeContextCurrent());
        const osg::ref_ptr<osg::Image> later =
            osghost::drawOnce(*node, viewOfBalls(), projectionOfBalls(), 96, 64, 24);
        EXPECT_LE(largest(*wanted, *later), 1) << frames;
    }
}

} // namespace
} // namespace lodestar::testing
