// SPDX-License-Identifier: MIT
//
// A document's light probes in OpenSceneGraph: the built-in renderer's pictures; a closed room
// keeps the sky out.
#include <algorithm>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "host_pictures.h"
#include "hosts/osg/headless.h"
#include "hosts/osg/lighting.h"
#include "osg_scene.h"
#include "support/probe_world.h"

namespace lodestar::testing {
namespace {

/// What a room holds.
struct Room {
    bool window = true;               ///< the wall towards +Z is left out
    bool mirror = true;               ///< a panel on the back wall
    bool ball = false;                ///< polished, not quite a mirror
    glm::vec3 at{0.0f, 0.75f, -0.5f}; ///< the ball's centre
    unsigned layers = 0xffffffff;     ///< of the ball
};

/// A room of 4 x 3 x 4 metres.
std::string room(const TemporaryFolder& folder, const Room& with) {
    GltfBuilder file;
    const auto polished = [&](double f0, const nlohmann::json& exponent) {
        return file.add(
            "materials",
            {{"extras",
              {{"lodestar",
                {{"diffuse", {0.2, 0.2, 0.25}}, {"f0", {f0, f0, f0}}, {"exponent", exponent}}}}}});
    };
    const auto box = [&](const glm::vec3& low, const glm::vec3& high, int material) {
        const glm::vec3 c = 0.5f * (low + high), h = 0.5f * (high - low);
        io::GltfPrimitive shape = cube();
        shape.uvs[0].resize(shape.positions.size());
        file.show({file.primitive(shape, material)},
                  {{"translation", {c.x, c.y, c.z}}, {"scale", {h.x, h.y, h.z}}});
    };
    const int stone = file.lambert(0.7f, 0.6f, 0.5f);
    box({-2.25f, -0.25f, -2.25f}, {2.25f, 0.0f, 2.25f}, stone);
    box({-2.25f, 3.0f, -2.25f}, {2.25f, 3.25f, 2.25f}, stone);
    box({-2.25f, 0.0f, -2.25f}, {-2.0f, 3.0f, 2.25f}, file.lambert(0.7f, 0.15f, 0.1f));
    box({2.0f, 0.0f, -2.25f}, {2.25f, 3.0f, 2.25f}, stone);
    box({-2.0f, 0.0f, -2.25f}, {2.0f, 3.0f, -2.0f}, stone);
    if (!with.window) {
        box({-2.0f, 0.0f, 2.0f}, {2.0f, 3.0f, 2.25f}, stone);
    }
    if (with.mirror) {
        box({-1.0f, 0.5f, -2.0f}, {1.0f, 2.5f, -1.9375f}, polished(0.6, 1e6));
    }
    if (with.ball) {
        file.show({file.primitive(sphere(48, 96), polished(0.5, 300))},
                  {{"name", "ball"},
                   {"translation", {with.at.x, with.at.y, with.at.z}},
                   {"scale", {0.75, 0.75, 0.75}},
                   {"extras", {{"lodestar", {{"layers", with.layers}}}}}});
    }
    return file.write(folder).string();
}

/// A painted sky, and a probe of the room; empty: none.
std::string lighting(const TemporaryFolder& folder, const std::string& probe) {
    return folder
        .write("sky.lodestar.json", R"({"lodestar": 1, "probes": [)" + probe + R"(], "lights": [
            {"name": "sky", "kind": "sky", "keys": [{"hour": 12, "gradient": {"stops": [
            {"at": 90, "color": [0.6, 1.2, 3.0]}, {"at": 0, "color": [3.0, 3.2, 3.4]},
            {"at": 0, "color": [1.0, 0.8, 0.6]}, {"at": -90, "color": [0.5, 0.4, 0.3]}]}}]}]})")
        .string();
}

constexpr const char* kRoom = R"({"name": "room", "position": [0.3, 1.6, 0.6],
    "capture": {"resolution": 64, "near": 0.05, "far": 50}, "exterior": false,
    "influence": {"shape": "box", "center": [-0.3, -0.1, -0.6], "size": [4.1, 3.1, 4.1], "blend": 0.2},
    "proxy": {"shape": "box", "center": [-0.3, -0.1, -0.6], "size": [4, 3, 4]}})";

constexpr const char* kInside = " --eye 0,1.5,1.75 --target 0,1.5,-1 --fov 75";

core::Image byOsg(const TemporaryFolder& folder, const std::string& scene, const std::string& light,
                  const char* view = kInside) {
    return drawn(program("lodestar-host-osg"), folder, scene, light, "9", view);
}
core::Image byUs(const TemporaryFolder& folder, const std::string& scene, const std::string& light,
                 const char* view = kInside) {
    return drawn(program("lodestar") + " render --samples 1 --no-backdrop", folder, scene, light,
                 "9", view);
}

/// What two filters of one cube may differ by: the built-in renderer makes coarse levels in passes,
/// from some fetches a texel, up to 2.9 % of the peak off a host's exact sums. Few pixels show it
/// fully: those where lookups jump from wall to wall.
bool near(const core::Image& a, const core::Image& b, const char* what) {
    const Difference d = compare(a, b, 2.5 / 255.0);
    std::printf("%s: largest %.2f / 255, mean %.4f / 255\n", what, 255.0 * d.largest,
                255.0 * d.mean);
    return d.largest <= 15.0 / 255.0 && d.mean <= 0.1 / 255.0;
}

// Captured, composed, corrected for parallax, looked up: all by the same rules.
TEST(OsgProbes, ARoomIsLitAsOurs) {
    const TemporaryFolder folder, bare, ball, far;
    const std::string scene = room(folder, {});
    const std::string light = lighting(folder, kRoom);
    const core::Image own = byUs(folder, scene, light);
    EXPECT_TRUE(near(byOsg(folder, scene, light), own, "a mirror"));
    EXPECT_FALSE(near(byOsg(folder, scene, lighting(bare, "")), own, "without the probe"));
    const std::string polished = room(ball, {.mirror = false, .ball = true});
    EXPECT_TRUE(near(byOsg(ball, polished, light), byUs(ball, polished, light), "a ball"));
    // What must fail the gate: another place, no parallax.
    std::string elsewhere = kRoom;
    elsewhere.replace(elsewhere.find("0.3, 1.6, 0.6"), 13, "0.2, 1.6, 0.2");
    EXPECT_FALSE(near(byOsg(folder, scene, lighting(far, elsewhere)), own, "captured elsewhere"));
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
