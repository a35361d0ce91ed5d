// SPDX-License-Identifier: MIT
//
// A document's light probes in OpenSceneGraph: the built-in renderer's pictures; a closed room
// keeps the sky out.
#include <algorithm>
#include <cstdlib>
#include <span>
#include <string>

#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include "hosts/osg/headless.h"
#include "hosts/osg/lighting.h"
#include "io/document_file.h"
#include "lighting/mips.h"
#include "osg_room.h"
#include "osg_scene.h"

namespace lodestar::testing {
namespace {

/// The probe of a room as the built-in renderer makes it.
class OsgRoom : public ProbeTest {
protected:
    /// What its levels are off the CPU's, of the same level 0.
    struct Off {
        float fine = 0.0f, coarse = 0.0f; ///< of more than 16 texels; of at most so many
        float peak = 0.0f;
    };
    Off measured(const std::string& path, const std::string& light) {
        core::Tally warnings;
        const auto file = io::loadGltf(path, {});
        const auto document = io::loadDocument(light, warnings);
        scene::Scene room = scene::buildScene(*file, file->defaultScene);
        const lighting::Probe probes[] = {document->probes[0].probe};
        scene::setProbes(room, probes, {}, warnings);
        scene::updateTransforms(room);
        const auto renderer = rendererOf(room);
        renderer->setLights(*document::dayLights(*document, warnings));
        scene::RenderSettings settings = small(64);
        settings.hour = 9.0;
        frameOf(*renderer, lookAt(room, {0.0f, 1.5f, 1.75f}, {0.0f, 1.5f, -1.0f}, 1.3f), settings);
        EXPECT_TRUE(renderer->isProbeReady(0));
        lighting::Cubemap base(probes[0].capture.resolution);
        for (int face = 0; face < 6; ++face) {
            copyFace(renderer->readProbe(0, face), &base.texel(face, 0, 0));
        }
        return difference(*renderer, lighting::tentMips(base));
    }

private:
    static void copyFace(const core::Image& from, glm::vec4* to) {
        for (std::size_t i = 0; i < from.pixels().size() / 4; ++i) {
            to[i] = glm::make_vec4(&from.pixels()[4 * i]);
        }
    }
    static Off difference(const scene::Renderer& renderer, const lighting::Cubemap& exact) {
        Off off;
        for (int level = 0; level < exact.levelCount(); ++level) {
            for (int face = 0; face < 6; ++face) {
                const core::Image ours = renderer.readProbe(0, face, level);
                const glm::vec4* theirs = &exact.texel(face, 0, 0, level);
                float& most = exact.width(level) > 16 ? off.fine : off.coarse;
                for (std::size_t i = 0; i < ours.pixels().size(); ++i) {
                    const float other = theirs[i / 4][static_cast<int>(i % 4)];
                    if (i % 4 < 3) { // what is not read is not made: no pixels
                        most = std::max(most, std::abs(ours.pixels()[i] - other));
                        off.peak = std::max(off.peak, other);
                    }
                }
            }
        }
        return off;
    }
};

// What a polished thing shows is filtered otherwise: a host reads exact sums, the built-in renderer
// makes levels of 16 texels and below in passes, of some fetches a texel; .8 % of the peak are
// left, half of that on the ball, of f0 .5, and it changes the display by two steps. Finer levels
// are rounded to half floats twice (2^-11 each), and weigh four fetches by the solid angle in their
// middles: 2e-3 of the peak at a window's edge, measured.
TEST_F(OsgRoom, LevelsAreTheHosts) {
    const TemporaryFolder folder;
    const Off off =
        measured(room(folder, {.mirror = false, .ball = true}), lighting(folder, kRoom));
    std::printf("off the CPU's levels: %.2f %%, of at most 16 texels %.2f %% of %.2f\n",
                static_cast<double>(100.0f * off.fine / off.peak),
                static_cast<double>(100.0f * off.coarse / off.peak), static_cast<double>(off.peak));
    EXPECT_LE(off.fine, 0.0025f * off.peak);
    EXPECT_LE(off.coarse, 0.01f * off.peak);
    EXPECT_GT(off.coarse, 0.0f) << "nothing was compared";
}

// Captured, composed, corrected for parallax, looked up: all by the same rules, within two steps of
// 8 bits. Irradiance along the axes lies on texels' centres in a host's cube and in the built-in
// renderer's tile. In the mean half floats count: .03 of a step for a texel that is rounded once.
TEST_F(OsgRoom, IsLitAsOurs) {
    const TemporaryFolder folder, bare, far;
    const std::string scene = room(folder, {});
    const std::string light = lighting(folder, kRoom);
    const core::Image own = byUs(folder, scene, light);
    EXPECT_TRUE(near(byOsg(folder, scene, light), own, "a mirror"));
    EXPECT_FALSE(near(byOsg(folder, scene, lighting(bare, "")), own, "without the probe"));
    // What must fail the gate: another place, no parallax.
    std::string elsewhere = kRoom;
    elsewhere.replace(elsewhere.find("0.3, 1.6, 0.6"), 13, "0.2, 1.6, 0.2");
    EXPECT_FALSE(near(byOsg(folder, scene, lighting(far, elsewhere)), own, "captured elsewhere"));
}

// By every lobe, and by faces whose width is no power of two.
TEST_F(OsgRoom, ThingsShineAsOurs) {
    for (const double exponent : {2.0, 8.0, 30.0, 300.0, 1e3}) {
        const TemporaryFolder folder;
        const std::string scene =
            room(folder, {.mirror = false, .ball = true, .exponent = exponent});
        std::string probe = kRoom;
        if (exponent == 300.0) {
            probe.replace(probe.find("64"), 2, "48");
        }
        const std::string light = lighting(folder, probe);
        EXPECT_TRUE(near(byOsg(folder, scene, light), byUs(folder, scene, light),
                         std::to_string(exponent).c_str()));
    }
}

/// One light, of the document's form, and a probe of the room; empty: none.
std::string under(const TemporaryFolder& folder, const std::string& light,
                  const std::string& probe) {
    return folder
        .write("sky.lodestar.json",
               R"({"lodestar": 1, "probes": [)" + probe + R"(], "lights": [)" + light + "]}")
        .string();
}

float brightest(const core::Image& picture) {
    float most = 0.0f;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            most = std::max(most, picture.at(x, y)[0]);
        }
    }
    return most;
}

// From its first picture on: no sky on its walls, and none in its faces.
TEST(OsgProbes, AClosedRoomKeepsTheSkyOut) {
    constexpr const char* kSky = R"({"kind": "sky", "keys": [{"hour": 12, "gradient": {"stops": [
        {"at": 90, "color": [1, 1, 1]}, {"at": -90, "color": [1, 1, 1]}]}}]})";
    const TemporaryFolder folder, open;
    const std::string scene = room(folder, {.window = false});
    EXPECT_LE(brightest(byOsg(folder, scene, under(folder, kSky, kRoom))), 1.0f / 255.0f);
    EXPECT_GT(brightest(byOsg(folder, scene, under(open, kSky, ""))), 0.4f);
}

/// A sun without shadows, two degrees wide. @param axis three numbers
std::string sun(const std::string& axis) {
    return R"({"kind": "sun", "visibility": false, "axis": [)" + axis +
           R"(], "keys": [{"hour": 12, "gradient": {"stops": [{"at": 0, "color": [3000, 3000, 3000]},
           {"at": 1, "color": [3000, 3000, 3000]}, {"at": 1, "color": [0, 0, 0]}]}}]})";
}

// A sun that casts no shadow is let through by what the probe sees of it: nothing in a closed room,
// through a window as the built-in renderer's.
TEST(OsgProbes, SunsWithoutShadowsAreHeldBack) {
    const TemporaryFolder folder, open, window;
    const std::string above = sun("0.2, 0.5, 1");
    const std::string scene = room(folder, {.window = false});
    EXPECT_LE(brightest(byOsg(folder, scene, under(folder, above, kRoom))), 1.0f / 255.0f);
    EXPECT_GT(brightest(byOsg(folder, scene, under(open, above, ""))), 0.4f);
    const std::string lit = room(window, {});
    for (const char* axis : {"0.2, 0.5, 1", "0.1, 0.3, -1"}) {
        const std::string light = under(window, sun(axis), kRoom);
        EXPECT_TRUE(near(byOsg(window, lit, light), byUs(window, lit, light), axis));
    }
}

/// Moves a node after some updates.
struct Jump : osg::NodeCallback {
    explicit Jump(const osg::Vec3d& to) : place(to) {}
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        if (++updates == 4) {
            static_cast<osg::MatrixTransform*>(node)->setMatrix(osg::Matrixd::translate(place));
        }
        traverse(node, visitor);
    }
    osg::Vec3d place;
    int updates = 0;
};

// What shares no layer with a capture is in the picture, and not in the mirror: as the built-in
// renderer has it, by glTF's masks.
TEST_F(OsgRoom, LayersAreOurs) {
    const TemporaryFolder two, none, all;
    std::string probe = kRoom;
    probe.replace(probe.find("\"near\""), 0, "\"layers\": 5, ");
    const std::string light = lighting(two, probe);
    const Room with{.block = true};
    const std::string everything = room(all, with);
    const core::Image whole = byOsg(all, everything, light);
    EXPECT_TRUE(near(whole, byUs(all, everything, light), "all layers"));
    for (const auto& [folder, layers] : {std::pair(&two, 2u), std::pair(&none, 0u)}) {
        Room masked = with;
        masked.layers = layers;
        const std::string scene = room(*folder, masked);
        const core::Image picture = byOsg(*folder, scene, light);
        EXPECT_TRUE(near(picture, byUs(*folder, scene, light), "another layer"));
        EXPECT_FALSE(near(picture, whole, "against all layers"));
    }
}

/// Two balls under a sky, the golden one with a probe of its own; at last it is at (1.2, 0, 0.4).
/// @param mask, inner of the red ball's node and of the one below it
osg::ref_ptr<osg::Image> carried(bool jumps, const char* probe, unsigned mask = ~0u,
                                 unsigned inner = ~0u) {
    osg::ref_ptr<osghost::Lighting> node = new osghost::Lighting;
    std::string document = kDay;
    document.insert(document.find("\"lights\""), std::string("\"probes\": [") + probe + "], ");
    node->setDocument(document);
    const osg::ref_ptr<osg::MatrixTransform> red =
        ball({-1.1f, 0, 0}, 1.0f, {.diffuse = {0.7f, 0.2f, 0.1f}});
    red->setNodeMask(mask);
    red->getChild(0)->setNodeMask(inner);
    node->addChild(red);
    const osg::Vec3 last(1.2f, 0.0f, 0.4f);
    osg::ref_ptr<osg::MatrixTransform> golden =
        ball(jumps ? osg::Vec3(1.6f, 0.5f, -0.5f) : last, 0.9f,
             {.diffuse = {0, 0, 0}, .f0 = {1.0f, 0.77f, 0.34f}, .exponent = 150.0f});
    golden->setName("golden");
    if (jumps) {
        golden->setUpdateCallback(new Jump(last));
    }
    node->addChild(golden);
    EXPECT_TRUE(osghost::makeContextCurrent());
    return osghost::drawOnce(*node, viewOfBalls(), projectionOfBalls(), 96, 64, 24);
}

int largest(const osg::Image& a, const osg::Image& b) {
    int most = 0;
    for (unsigned i = 0; i < a.getTotalSizeInBytes(); ++i) {
        most = std::max(most, std::abs(int{a.data()[i]} - int{b.data()[i]}));
    }
    return most;
}

// Node masks are layers: what all masks down to a drawable have in common.
TEST(OsgProbes, NodeMasksAreLayers) {
    constexpr const char* kSees = R"({"name": "own", "node": "golden", "capture": {"resolution": 32,
        "near": 0.95, "far": 50, "layers": 3}, "influence": {"shape": "box", "size": [2, 2, 2]}})";
    const osg::ref_ptr<osg::Image> all = carried(false, kSees);
    EXPECT_EQ(largest(*all, *carried(false, kSees, 2)), 0);
    EXPECT_EQ(largest(*all, *carried(false, kSees, 6, 3)), 0);
    const osg::ref_ptr<osg::Image> without = carried(false, kSees, 4);
    EXPECT_GT(largest(*all, *without), 20) << "the golden ball still shows the red one";
    EXPECT_EQ(largest(*without, *carried(false, kSees, 6, 5)), 0);
    EXPECT_EQ(largest(*without, *carried(false, kSees, 1, 2)), 0) << "no mask holds both";
}

// What moved and its probe with it is lit as if it had always been there.
TEST(OsgProbes, AProbeFollowsItsNode) {
    constexpr const char* kCarried =
        R"({"name": "own", "node": "golden", "capture": {"resolution": 32,
        "near": 0.95, "far": 50}, "influence": {"shape": "box", "size": [2, 2, 2], "blend": 0.05}})";
    const osg::ref_ptr<osg::Image> jumped = carried(true, kCarried);
    EXPECT_LE(largest(*jumped, *carried(false, kCarried)), 1);
    EXPECT_GT(largest(*jumped, *carried(true, "")), 20) << "the probe shows nothing";
}

} // namespace
} // namespace lodestar::testing
