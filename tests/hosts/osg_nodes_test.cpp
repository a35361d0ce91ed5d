// SPDX-License-Identifier: MIT
//
// lodestar::Lighting as OpenSceneGraph's users meet it: a node of a scene, in a file, on threads.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <osg/Notify>
#include <osg/Program>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>
#include <osgUtil/UpdateVisitor>
#include <osgViewer/View>

#include "golden/gltf_builder.h"
#include "hosts/osg/headless.h"
#include "hosts/osg/hour_keys.h"
#include "hosts/osg/lighting.h"
#include "hosts/osg/lights.h"
#include "hosts/osg/scene.h"
#include "hosts/osg/thread_contexts.h"
#include "io/image_file.h"
#include "osg_scene.h"

namespace lodestar::testing {
namespace {

using osghost::Lighting;

class OsgNodes : public ::testing::Test {
protected:
    void SetUp() override {
        static const bool current = osghost::makeContextCurrent();
        const char* required = std::getenv("LODESTAR_REQUIRE_GL");
        if (!current && (required == nullptr || std::strcmp(required, "1") != 0)) {
            GTEST_SKIP() << "needs OpenGL";
        }
        ASSERT_TRUE(current) << "no compatibility context without a surface";
    }
};

/// Each picture by a context of its own: a viewer takes OpenGL's initial state for granted.
osg::ref_ptr<osg::Image> drawn(osg::Group& scene) {
    EXPECT_TRUE(osghost::makeContextCurrent());
    return osghost::drawOnce(scene, viewOfBalls(), projectionOfBalls(), 96, 64);
}

osg::ref_ptr<Lighting> litBalls(double hour) {
    osg::ref_ptr<Lighting> node = new Lighting;
    node->setDocument(kDay);
    node->setHour(hour);
    addBalls(*node);
    return node;
}

bool same(const osg::Image& a, const osg::Image& b) {
    EXPECT_EQ(a.getTotalSizeInBytes(), 96u * 64u * 4u);
    EXPECT_EQ(b.getTotalSizeInBytes(), 96u * 64u * 4u);
    return std::memcmp(a.data(), b.data(), a.getTotalSizeInBytes()) == 0;
}

/// How far two pictures are apart at most, in steps of 8 bits.
int largest(const osg::Image& a, const osg::Image& b) {
    int most = 0;
    for (unsigned i = 0; i < a.getTotalSizeInBytes(); ++i) {
        most = std::max(most, std::abs(int{a.data()[i]} - int{b.data()[i]}));
    }
    return most;
}

/// What one update traversal does.
void update(osg::Node& node, double time) {
    osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
    stamp->setSimulationTime(time);
    osgUtil::UpdateVisitor visitor;
    visitor.setFrameStamp(stamp);
    node.accept(visitor);
}

/// Lines that OpenSceneGraph is told, while this lives.
class Heard : public osg::NotifyHandler {
public:
    static osg::ref_ptr<Heard> listen() {
        osg::ref_ptr<Heard> heard = new Heard;
        osg::setNotifyHandler(heard);
        return heard;
    }
    void notify(osg::NotifySeverity severity, const char* message) override {
        text += severity == osg::WARN ? message : "";
    }
    std::string text;
};

TEST_F(OsgNodes, TheNodeLightsAsItsPartsDo) {
    const auto lit = hosts::LitContext::read(kDay, {});
    ASSERT_TRUE(lit) << lit.error().message();
    osg::ref_ptr<osg::Group> parts = new osg::Group;
    addBalls(*parts);
    parts->getOrCreateStateSet()->setAttributeAndModes(osghost::programOf(lit->api()));
    osghost::Lights lights(lit->api(), lit->get(), *parts->getStateSet(), 0);
    ASSERT_EQ(lights.update(9.0), LODESTAR_OK);

    const osg::ref_ptr<osg::Image> byNode = drawn(*litBalls(9.0));
    EXPECT_TRUE(same(*byNode, *drawn(*parts)));
    EXPECT_FALSE(same(*byNode, *drawn(*litBalls(10.0)))) << "the hour changes nothing";
    // The node draws with what is its own: its StateSet stays the user's.
    EXPECT_EQ(litBalls(9.0)->getStateSet(), nullptr);
}

TEST_F(OsgNodes, AFileIsFoundBesideTheSceneAndAmongDataFiles) {
    const TemporaryFolder folder;
    folder.write("day.lodestar.json", std::string(kDay));
    const osg::ref_ptr<osg::Image> wanted = drawn(*litBalls(9.0));
    for (const bool beside : {true, false}) {
        osg::ref_ptr<Lighting> node = litBalls(9.0);
        node->setDocument("");
        node->setFile("day.lodestar.json");
        if (beside) {
            node->setFolder(folder.path().string());
        } else {
            osgDB::Registry::instance()->getDataFilePathList().push_front(folder.path().string());
        }
        EXPECT_TRUE(same(*drawn(*node), *wanted));
    }
    osgDB::Registry::instance()->getDataFilePathList().pop_front();
}

TEST_F(OsgNodes, AnEnvironmentIsFoundBesideTheDocumentOrTheScene) {
    const TemporaryFolder folder, elsewhere;
    core::Image room(16, 8, 3);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
            room.at(x, y)[x < 8 ? 0 : 2] = y < 4 ? 1.0f : 0.2f;
        }
    }
    ASSERT_TRUE(io::writeImage(folder / "room.exr", room));
    const std::string text = R"({"lodestar": 1, "environment": {"source": "room.exr"}})";
    osg::ref_ptr<Lighting> byFile = litBalls(9.0), byText = litBalls(9.0);
    byFile->setDocument("");
    byFile->setFile(folder.write("room.lodestar.json", text).string());
    byText->setDocument(text);
    byText->setFolder(folder.path().string());
    const osg::ref_ptr<osg::Image> wanted = drawn(*byFile);
    EXPECT_TRUE(same(*drawn(*byText), *wanted));
    EXPECT_FALSE(same(*drawn(*litBalls(9.0)), *wanted));
    const osg::ref_ptr<Heard> heard = Heard::listen();
    byText->setFolder(elsewhere.path().string());
    EXPECT_FALSE(same(*drawn(*byText), *wanted));
    EXPECT_NE(heard->text.find("room.exr"), std::string::npos) << heard->text;
    osg::setNotifyHandler(new osg::StandardNotifyHandler);
}

TEST_F(OsgNodes, ASceneMayHaveZUp) {
    // The balls, the camera and the sky stand as before, all turned: Y north, Z up.
    const osg::Matrixd turn = osg::Matrixd::rotate(osg::PI_2, osg::Vec3d(1, 0, 0));
    const osg::ref_ptr<osg::MatrixTransform> turned = new osg::MatrixTransform(turn);
    addBalls(*turned);
    const osg::ref_ptr<Lighting> node = new Lighting;
    node->setDocument(kDay);
    node->setHour(9.0);
    node->addChild(turned);
    const auto shown = [&] {
        EXPECT_TRUE(osghost::makeContextCurrent());
        return osghost::drawOnce(*node, osg::Matrixd::inverse(turn) * viewOfBalls(),
                                 projectionOfBalls(), 96, 64);
    };
    const osg::ref_ptr<osg::Image> wanted = drawn(*litBalls(9.0));
    EXPECT_GT(largest(*shown(), *wanted), 20);
    node->setUp(osg::Vec3d(0, 0, 2));
    node->setNorth(osg::Vec3d(0, 1, 0));
    // Sines and cosines of the turn are rounded: a step of 8 bits.
    EXPECT_LE(largest(*shown(), *wanted), 1);
    // A document's environment turns with them; a gradient of 0.1 to 1.1 over the sphere changes by
    // less than a step of 8 bits within a texel, which is what turning a cube blurs.
    const std::string around = R"({"lodestar": 1, "environment": {"source": "gradient:0.1,1.1"}})";
    const osg::ref_ptr<Lighting> plain = new Lighting;
    plain->setDocument(around);
    addBalls(*plain);
    EXPECT_TRUE(osghost::makeContextCurrent());
    const osg::ref_ptr<osg::Image> straight =
        osghost::drawOnce(*plain, viewOfBalls(), projectionOfBalls(), 96, 64);
    node->setDocument(around);
    EXPECT_LE(largest(*shown(), *straight), 1);
    const osg::ref_ptr<Heard> heard = Heard::listen();
    node->setNorth(osg::Vec3d(0, 0, 1));
    update(*node, 0.0);
    EXPECT_NE(heard->text, "") << "up and north are one";
    osg::setNotifyHandler(new osg::StandardNotifyHandler);
}

TEST_F(OsgNodes, AChildWithoutAMaterialIsWhite) {
    osg::ref_ptr<Lighting> bare = litBalls(9.0), white = litBalls(9.0);
    for (unsigned i = 0; i < 2; ++i) {
        osg::Node* ball = bare->getChild(i)->asGroup()->getChild(0);
        ball->setStateSet(nullptr);
        ball = white->getChild(i)->asGroup()->getChild(0);
        osghost::setMaterial(*ball->getStateSet(), osghost::Material{});
    }
    EXPECT_TRUE(same(*drawn(*bare), *drawn(*white)));
    EXPECT_FALSE(same(*drawn(*bare), *drawn(*litBalls(9.0))));
}

TEST_F(OsgNodes, TheHourFollowsTheSimulationTime) {
    const osg::ref_ptr<Lighting> node = litBalls(23.0);
    node->setHoursPerSecond(0.5);
    update(*node, 100.0); // where it begins is no passing of time
    EXPECT_EQ(node->getHour(), 23.0);
    update(*node, 101.0);
    EXPECT_EQ(node->getHour(), 23.5);
    update(*node, 101.0);
    EXPECT_EQ(node->getHour(), 23.5);
    update(*node, 103.0);
    EXPECT_EQ(node->getHour(), 0.5);
    node->setHoursPerSecond(-1.0);
    update(*node, 104.0);
    EXPECT_EQ(node->getHour(), 23.5);
    node->setHour(std::nan(""));
    node->setHoursPerSecond(1.0 / 0.0);
    EXPECT_EQ(node->getHour(), 23.5);
    EXPECT_EQ(node->getHoursPerSecond(), -1.0);
    // A copy goes its own way, by a context of its own.
    const osg::ref_ptr<Lighting> copy = new Lighting(*node);
    EXPECT_EQ(copy->getDocument(), kDay);
    const std::size_t contexts = osghost::ThreadContexts::ofThisThread()->size();
    update(*copy, 104.0);
    update(*copy, 105.0);
    EXPECT_EQ(osghost::ThreadContexts::ofThisThread()->size(), contexts + 1);
    EXPECT_EQ(copy->getHour(), 22.5);
    EXPECT_EQ(node->getHour(), 23.5);
    EXPECT_NE(copy->getLightState(), node->getLightState());
}

TEST_F(OsgNodes, ARefusalIsSaidOnceAndNothingIsLit) {
    const osg::ref_ptr<Heard> heard = Heard::listen();
    osg::ref_ptr<osg::Group> unlit = new osg::Group;
    addBalls(*unlit);
    const osg::ref_ptr<osg::Image> plain = drawn(*unlit);
    const osg::ref_ptr<osg::Image> wanted = drawn(*litBalls(9.0));
    ASSERT_FALSE(same(*plain, *wanted));

    const osg::ref_ptr<Lighting> node = litBalls(9.0);
    node->setName("hall");
    node->setDocument(R"({"lodestar": 1, "lights": [{"kind": "moon", "keys": []}]})");
    EXPECT_TRUE(same(*drawn(*node), *plain));
    EXPECT_TRUE(same(*drawn(*node), *plain));
    EXPECT_NE(heard->text.find("\"hall\""), std::string::npos) << heard->text;
    const std::size_t place = heard->text.find("(/lights/0/kind)");
    ASSERT_NE(place, std::string::npos) << heard->text;
    EXPECT_EQ(heard->text.find("(/lights/0/kind)", place + 1), std::string::npos) << heard->text;
    // What is set next counts, for better or worse.
    node->setDocument(kDay);
    EXPECT_TRUE(same(*drawn(*node), *wanted));
    node->setDocument("");
    node->setFile("no-such.lodestar.json");
    EXPECT_TRUE(same(*drawn(*node), *plain));
    EXPECT_NE(heard->text.find("no-such.lodestar.json"), std::string::npos) << heard->text;
    osg::setNotifyHandler(new osg::StandardNotifyHandler);
}

TEST_F(OsgNodes, ANodeMayEndOnAnyThread) {
    const auto here = osghost::ThreadContexts::ofThisThread();
    const std::size_t before = here->size();
    osg::ref_ptr<Lighting> node = litBalls(9.0);
    update(*node, 0.0);
    ASSERT_NE(node->getLightState(), nullptr);
    EXPECT_EQ(here->size(), before + 1);
    std::thread([&] { node = nullptr; }).join();
    EXPECT_EQ(here->size(), before + 1) << "ended where the library refuses it";
    const osg::ref_ptr<Lighting> other = litBalls(9.0);
    update(*other, 0.0);
    EXPECT_EQ(here->size(), before + 1) << "what was released does not end";
}

TEST_F(OsgNodes, UpdatesMayMoveToAnotherThread) {
    const auto here = osghost::ThreadContexts::ofThisThread();
    const std::size_t before = here->size();
    const osg::ref_ptr<Heard> heard = Heard::listen();
    std::shared_ptr<osghost::ThreadContexts> there;
    const osg::ref_ptr<Lighting> node = litBalls(9.0);
    update(*node, 0.0);
    std::thread([&] {
        there = osghost::ThreadContexts::ofThisThread();
        update(*node, 1.0);
        EXPECT_EQ(there->size(), 1u);
    }).join();
    EXPECT_NE(node->getLightState(), nullptr);
    EXPECT_EQ(there->size(), 0u) << "a thread has left a context behind";
    update(*node, 2.0); // back again, where the first was only released
    EXPECT_EQ(here->size(), before + 1);
    EXPECT_EQ(heard->text, "");
    EXPECT_TRUE(same(*drawn(*node), *drawn(*litBalls(9.0))));
    osg::setNotifyHandler(new osg::StandardNotifyHandler);
}

TEST(OsgMaterial, IsTwoUniforms) {
    const osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    EXPECT_FALSE(osghost::materialOf(*state));
    const float packed[8] = {0.1f, 0.2f, 0.3f, 40.0f, 0.5f, 0.6f, 0.7f, 1.0f};
    osghost::setMaterial(*state, osghost::materialOf(packed));
    const auto read = osghost::materialOf(*state);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->diffuse, osg::Vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(read->f0, osg::Vec3(0.5f, 0.6f, 0.7f));
    EXPECT_EQ(read->exponent, 40.0f);
    state->removeUniform("material_f0");
    EXPECT_FALSE(osghost::materialOf(*state));
}

TEST(OsgHourKeys, MoveThroughTheDay) {
    const osg::ref_ptr<Lighting> node = new Lighting;
    osghost::HourKeys keys(*node);
    const osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
    const auto press = [&](int key, int modifiers = 0) {
        const osg::ref_ptr<osgGA::GUIEventAdapter> event = new osgGA::GUIEventAdapter;
        event->setEventType(osgGA::GUIEventAdapter::KEYDOWN);
        event->setKey(key);
        event->setModKeyMask(modifiers);
        return keys.handle(*event, *view);
    };
    node->setHour(23.75);
    EXPECT_TRUE(press(osgGA::GUIEventAdapter::KEY_Right));
    EXPECT_EQ(node->getHour(), 0.0);
    EXPECT_TRUE(press(osgGA::GUIEventAdapter::KEY_Left));
    EXPECT_EQ(node->getHour(), 23.75);
    EXPECT_TRUE(press(osgGA::GUIEventAdapter::KEY_Left, osgGA::GUIEventAdapter::MODKEY_SHIFT));
    EXPECT_EQ(node->getHour(), 23.75 - 1.0 / 60.0);
    node->setHoursPerSecond(2.0);
    EXPECT_TRUE(press('p'));
    EXPECT_EQ(node->getHoursPerSecond(), 0.0);
    EXPECT_TRUE(press('p'));
    EXPECT_EQ(node->getHoursPerSecond(), 2.0);
    EXPECT_FALSE(press('q')) << "other keys are the viewer's";
}

/// The node of a scene that was read.
Lighting* lightingOf(osg::Node* scene) {
    return dynamic_cast<Lighting*>(scene);
}

/// The folder of the build's programs and modules.
std::string buildFolder() {
    const std::string own = LODESTAR_EXECUTABLE;
    return own.substr(0, own.rfind('/'));
}

TEST_F(OsgNodes, ASceneKeepsIt) {
    // This program has no serializers: they come with the module, by OSG_LIBRARY_PATH.
    osgDB::Registry& registry = *osgDB::Registry::instance();
    registry.setLibraryFilePathList(osgDB::FilePathList());
    ASSERT_EQ(registry.getObjectWrapperManager()->findWrapper("lodestar::Lighting"), nullptr);
    setenv("OSG_LIBRARY_PATH", buildFolder().c_str(), 1);
    registry.initLibraryFilePathList();
    ASSERT_NE(registry.getObjectWrapperManager()->findWrapper("lodestar::Lighting"), nullptr);

    const TemporaryFolder folder;
    folder.write("day.lodestar.json", std::string(kDay));
    const osg::ref_ptr<Lighting> node = litBalls(17.123456789012);
    node->setHoursPerSecond(0.0625);
    node->setUp(osg::Vec3d(0.25, 1.0, 0.0));
    node->setNorth(osg::Vec3d(1.0, 0.0, 0.0));
    node->setName("hall");
    node->setFile("day.lodestar.json");
    const osg::ref_ptr<osg::Image> wanted = drawn(*node);
    for (const char* name : {"scene.osgt", "scene.osgb", "scene.osgx"}) {
        const std::string file = (folder / name).string();
        ASSERT_TRUE(osgDB::writeNodeFile(*node, file)) << name;
        const osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(file);
        Lighting* const back = lightingOf(read);
        ASSERT_NE(back, nullptr) << name;
        EXPECT_EQ(back->getDocument(), kDay) << name;
        EXPECT_EQ(back->getFile(), "day.lodestar.json") << name;
        EXPECT_EQ(back->getHour(), node->getHour()) << name;
        EXPECT_EQ(back->getHoursPerSecond(), 0.0625) << name;
        EXPECT_EQ(back->getName(), "hall") << name;
        EXPECT_EQ(back->getUp(), node->getUp()) << name;
        EXPECT_EQ(back->getNorth(), node->getNorth()) << name;
        EXPECT_TRUE(same(*drawn(*back), *wanted)) << name;
        back->setHour(10.0);
        EXPECT_FALSE(same(*drawn(*back), *wanted)) << name;
        // Nothing of what it draws with is in the file, and a document is found beside the scene.
        EXPECT_EQ(back->getStateSet(), nullptr) << name;
        EXPECT_EQ(back->getFolder(), folder.path().string()) << name;
    }
    // A program that knows nothing of Lodestar reads, updates and writes it, without a word.
    const std::string from = (folder / "scene.osgt").string(), to = (folder / "copy.osgt").string();
    const std::string words = (folder / "words").string();
    const std::string plain =
        buildFolder() + "/osg-plain " + from + " " + to + " >" + words + " 2>&1";
    ASSERT_EQ(std::system(plain.c_str()), 0);
    EXPECT_EQ(std::filesystem::file_size(words), 0u);
    const osg::ref_ptr<osg::Node> copy = osgDB::readRefNodeFile(to);
    ASSERT_NE(lightingOf(copy), nullptr);
    EXPECT_TRUE(same(*drawn(*lightingOf(copy)), *wanted));
    EXPECT_NE(std::system(("OSG_LIBRARY_PATH= " + plain).c_str()), 0) << "whence did it know";
}

} // namespace
} // namespace lodestar::testing
