// SPDX-License-Identifier: MIT
//
// What hosts of this engine get wrong must fail the gate that a right picture passes: without these
// the gate would prove nothing.
#include <osg/FrontFace>

#include <glm/gtc/type_ptr.hpp>

#include "host_pictures.h"
#include "hosts/osg/backdrop.h"
#include "hosts/osg/headless.h"
#include "hosts/osg/lights.h"
#include "hosts/osg/scene.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace lodestar::testing {
namespace {

constexpr int kWidth = 240, kHeight = 120;

osg::Matrixd matrixOf(const glm::mat4& m) {
    return osg::Matrixd(glm::value_ptr(glm::dmat4(m)));
}

/// The scene under its document, in this process, so that its state can be spoilt.
class Controls : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(osghost::makeContextCurrent());
        lighting_ = day(folder_);
        scene_ = spheres(folder_, 0.3); // before the middle one, behind it from elsewhere
        const auto file = io::loadGltf(scene_, {});
        auto lit = hosts::LitContext::open(lighting_);
        ASSERT_TRUE(file.ok() && lit.ok());
        lit_.emplace(std::move(*lit));
        root_ = osghost::sceneOf(*file, *lit_);
        ASSERT_TRUE(root_.valid());
        root_->getOrCreateStateSet()->setAttributeAndModes(osghost::programOf(lit_->api()));
        lights_.emplace(lit_->api(), lit_->get(), *root_->getStateSet(), 0);
        ASSERT_EQ(lights_->update(17.5), LODESTAR_OK);
        const scene::Scene scene = scene::buildScene(*file, file->defaultScene);
        scene::CameraRequest request;
        request.eye = glm::vec3(4.0f, 2.0f, 5.0f);
        request.target = glm::vec3(0.0f);
        const auto view = scene::chooseView(scene, request, float{kWidth} / kHeight);
        ASSERT_TRUE(view.ok());
        view_ = *view;
        expected_ = drawn(program("lodestar-host-builtin"), folder_, scene_, lighting_, "17.5",
                          " --eye 4,2,5 --target 0,0,0");
    }
    core::Image draw() {
        const osg::ref_ptr<osg::Image> image =
            osghost::drawOnce(*root_, matrixOf(view_.cameraFromWorld),
                              matrixOf(view_.clipFromCamera), kWidth, kHeight);
        core::Image picture(kWidth, kHeight, 4);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < 4 * kWidth; ++x) {
                picture.at(0, kHeight - 1 - y)[x] =
                    static_cast<float>(image->data(0, static_cast<unsigned>(y))[x]) / 255.0f;
            }
        }
        return picture;
    }
    osg::StateSet& state() { return *root_->getStateSet(); }

    TemporaryFolder folder_;
    std::string scene_, lighting_;
    std::optional<hosts::LitContext> lit_;
    osg::ref_ptr<osg::Group> root_;
    std::optional<osghost::Lights> lights_;
    scene::View view_{};
    core::Image expected_;
};

constexpr auto kOver = osg::StateAttribute::OVERRIDE;

TEST_F(Controls, ARightPicturePasses) {
    EXPECT_TRUE(passes(draw(), expected_, "as it is"));
}

// What nothing covers shows the lights, as the built-in renderer's backdrop; it changes neither
// near nor far.
TEST_F(Controls, TheBackdropIsTheLights) {
    root_->addChild(osghost::backdrop(lit_->api()));
    const core::Image own = drawn(program("lodestar") + " render --samples 1", folder_, scene_,
                                  lighting_, "17.5", " --eye 4,2,5 --target 0,0,0");
    EXPECT_TRUE(passes(draw(), own, "with its backdrop"));
    EXPECT_FALSE(passes(own, expected_, "without"));
    EXPECT_FALSE(root_->getChild(root_->getNumChildren() - 1)->getBound().valid());
}

TEST_F(Controls, DepthTestOffFails) {
    state().setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF | kOver);
    EXPECT_FALSE(passes(draw(), expected_, "depth test off"));
}

TEST_F(Controls, WindingInvertedFails) {
    state().setAttributeAndModes(new osg::FrontFace(osg::FrontFace::CLOCKWISE),
                                 osg::StateAttribute::ON | kOver);
    EXPECT_FALSE(passes(draw(), expected_, "winding inverted"));
}

TEST_F(Controls, UpsideDownFails) {
    view_.clipFromCamera[1][1] = -view_.clipFromCamera[1][1];
    state().setAttributeAndModes(new osg::FrontFace(osg::FrontFace::CLOCKWISE),
                                 osg::StateAttribute::ON | kOver);
    EXPECT_FALSE(passes(draw(), expected_, "upside down"));
}

// The sky turns with its axis and the sun with its own: a light that stays behind is seen.
TEST_F(Controls, StaleUniformsFail) {
    ASSERT_EQ(lights_->update(17.0), LODESTAR_OK);
    EXPECT_FALSE(passes(draw(), expected_, "half an hour late"));
}

TEST_F(Controls, SeamsFail) {
    // Only where an environment is read: cubes filtered face by face.
    writeRoom(folder_ / "room.exr");
    const std::string room = folder_
                                 .write("room.lodestar.json",
                                        R"({"lodestar": 1, "environment": {"source": "room.exr"}})")
                                 .string();
    auto lit = hosts::LitContext::open(room);
    ASSERT_TRUE(lit.ok());
    osghost::Lights lights(lit->api(), lit->get(), state(), 0);
    ASSERT_EQ(lights.update(17.5), LODESTAR_OK);
    const core::Image own = drawn(program("lodestar-host-builtin"), folder_, scene_, room, "17.5",
                                  " --eye 4,2,5 --target 0,0,0");
    EXPECT_TRUE(passes(draw(), own, "seamless"));
    state().setMode(0x884F, osg::StateAttribute::OFF | kOver);
    EXPECT_FALSE(passes(draw(), own, "with seams"));
}

} // namespace
} // namespace lodestar::testing
