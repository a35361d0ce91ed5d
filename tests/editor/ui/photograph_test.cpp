// SPDX-License-Identifier: MIT
//
// Lights out of photographs, through the editor's window: by synthetic events.
#include <cmath>
#include <fstream>

#include <glm/geometric.hpp>

#include "app/bake_lights.h"
#include "editor/ui/editor_fixture.h"
#include "io/environment_file.h"
#include "io/image_file.h"
#include "lighting/zonal_picture.h"
#include "model/ramp.h"
#include "support/shared.h"

namespace lodestar::testing {
namespace {

using platform::Key;

/// Width of the panoramas, pixels.
constexpr int kPanorama = 256;

class PhotographTest : public EditorTest {
protected:
    void SetUp() override {
        EditorTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) {
            click(mark("key 0").center());
        }
    }
    /// A panorama whose radiance is a function of elevation, degrees, with a sun of 2.5 degrees'
    /// radius at azimuth 90, elevation 45, where it has one.
    std::string panorama(const std::string& name, bool sun) {
        core::Image image(kPanorama, kPanorama / 2, 3);
        const glm::dvec3 towards = glm::normalize(glm::dvec3(1.0, 1.0, 0.0)); // azimuth 90: +X
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const glm::dvec3 d = lighting::latLongDirection(x + 0.5, y + 0.5, image);
                const bool inSun = sun && glm::dot(d, towards) > std::cos(2.5 * M_PI / 180.0);
                const glm::dvec3 radiance = sky(90.0 - 180.0 * (y + 0.5) / image.height()) +
                                            (inSun ? glm::dvec3(500.0) : glm::dvec3(0.0));
                for (int c = 0; c < 3; ++c) {
                    image.at(x, y)[c] = static_cast<float>(radiance[c]);
                }
            }
        }
        const std::string path = folder_.file(name);
        EXPECT_TRUE(io::writeImage(path, image).ok());
        return path;
    }
    /// Linear in elevation: 1 to 3, red above, blue below.
    static glm::dvec3 sky(double elevation) {
        const double t = (elevation + 90.0) / 180.0;
        return {1.0 + 2.0 * t, 1.0, 3.0 - 2.0 * t};
    }
    void drop(const std::string& path) {
        send(platform::DropEvent{{path}});
        settle();
    }
    void dropAndFinish(const std::string& path) {
        drop(path);
        finish();
    }
    [[nodiscard]] ImVec2 onPicture(float x, float y) const {
        const ui::Mark picture = mark("photograph");
        return {picture.low.x + x * (picture.high.x - picture.low.x),
                picture.low.y + y * (picture.high.y - picture.low.y)};
    }
    [[nodiscard]] const ui::Photograph& photograph() const {
        return editor_->surroundings().photograph;
    }
    [[nodiscard]] const ui::LogLine& said() const { return editor_->workspace().log().back(); }
    [[nodiscard]] std::string text() { return document::writeDocument(model().document()); }
};

TEST_F(PhotographTest, ASkyAndItsSunBecomeTheLights) {
    const std::string before = text();
    dropAndFinish(panorama("sky.exr", true));
    ASSERT_TRUE(photograph().fit.has_value());
    ASSERT_TRUE(photograph().fit->sun.has_value());
    // Its middle is found within the map's own texels of 1.4 degrees.
    EXPECT_GT(glm::dot(*photograph().fit->sun, glm::normalize(glm::dvec3(1.0, 1.0, 0.0))),
              std::cos(1.4 * M_PI / 180.0));
    EXPECT_FALSE(photograph().fit->advice.empty());
    keep("photograph-lights");
    click(mark("Use as the lights").center());
    finish();
    ASSERT_EQ(model().document().lights.size(), 2u);
    EXPECT_EQ(light(0).kind, lighting::LightKind::Sky);
    EXPECT_EQ(light(1).kind, lighting::LightKind::Sun);
    EXPECT_EQ(model().undoCount(), 1u);
    click(mark("takes sun").center());
    click(mark("Use as the lights").center());
    finish();
    EXPECT_EQ(model().document().lights.size(), 1u) << "the sun stays in the sky";
    control(Key::Z);
    control(Key::Z);
    EXPECT_EQ(text(), before);
}

TEST_F(PhotographTest, ARealSkyIsFittedBesideTheFramesAsBakingDoes) {
    LODESTAR_NEEDS_SHARED();
    for (const char* name : {"park", "city", "studio"}) {
        const auto path =
            sharedPath((std::string("assets/hdr/pmndrs/") + name + ".hdr").c_str()).string();
        const auto start = std::chrono::steady_clock::now();
        send(platform::DropEvent{{path}});
        double longest = 0.0;
        int frames = 0;
        while (editor_->works() && frames < 20000) {
            const auto before = std::chrono::steady_clock::now();
            frame();
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
            longest = std::max(longest, took.count());
            ++frames;
        }
        const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
        ASSERT_TRUE(photograph().fit.has_value()) << name;
        std::printf("%s: %.2f s, %d frames meanwhile, the longest %.0f ms; asymmetry %.3f, "
                    "diffuse error %.3f\n",
                    name, all.count(), frames, 1e3 * longest, photograph().fit->residual,
                    photograph().fit->diffuseError);
        EXPECT_GT(frames, 1) << "the frames waited";
        core::Tally warnings;
        const auto image = io::loadRadiance(path, warnings);
        ASSERT_TRUE(image.ok());
        const auto lights = lighting::lightsFromPanorama(*image, glm::dvec3(0.0, 1.0, 0.0));
        EXPECT_EQ(photograph().fit->residual, lights.residual) << name;
        settle();
        keep(std::string("photograph-") + name);
        click(mark("Use as the lights").center());
        finish();
        EXPECT_EQ(model().document().lights, app::documentLights(lights, glm::dvec3(0.0, 1.0, 0.0)))
            << name;
        keep(std::string("photograph-") + name + "-used");
    }
}

TEST_F(PhotographTest, TheMeanOverAzimuthBecomesTheGradient) {
    dropAndFinish(panorama("sky.exr", false));
    EXPECT_FALSE(photograph().fit->sun.has_value());
    click(mark("way Mean over azimuth").center());
    click(mark("Use as the gradient").center());
    finish();
    EXPECT_EQ(model().undoCount(), 1u);
    const std::vector<double> at{80.0, 10.0, -60.0};
    const auto radiance =
        model::radianceAt(light(0).keys.front().gradient, lighting::LightKind::Sky, at);
    for (std::size_t i = 0; i < at.size(); ++i) {
        // The sky is linear, so linear stops hold it but for the zones' width of 180 / 256 degrees.
        EXPECT_LT(glm::length(radiance[i] - sky(at[i])), 3.0 * 180.0 / 256.0 / 90.0) << at[i];
    }
    // About another axis the key turns there: it shows what was averaged.
    click(mark("photograph axis").center());
    click(mark("photograph axis/another").center());
    typeInto("photograph azimuth", "90");
    typeInto("photograph elevation", "0");
    click(mark("Use as the gradient").center());
    finish();
    ASSERT_TRUE(light(0).keys.front().axis.has_value());
    EXPECT_GT(light(0).keys.front().axis->x, 0.999999);
    EXPECT_EQ(model().undoCount(), 2u) << "gradient and axis are one step";
    keep("photograph-mean");
}

TEST_F(PhotographTest, ALineIsDraggedOverThePicture) {
    dropAndFinish(panorama("sky.exr", false));
    click(mark("way Line").center());
    drag(onPicture(0.3f, 0.1f), onPicture(0.3f, 0.9f));
    EXPECT_EQ(model().undoCount(), 1u) << "one drag is one step";
    const std::vector<double> at{45.0, 0.0, -45.0};
    const auto radiance =
        model::radianceAt(light(0).keys.front().gradient, lighting::LightKind::Sky, at);
    for (std::size_t i = 0; i < at.size(); ++i) {
        // A pixel of the window is half a degree at most.
        EXPECT_LT(glm::length(radiance[i] - sky(at[i])), 0.03) << at[i];
    }
    keep("photograph-line");
    click(mark("by elevation").center());
    typeInto("line from", "10");
    typeInto("line to", "-10");
    const auto& stops = light(0).keys.front().gradient.stops;
    EXPECT_DOUBLE_EQ(stops.front().stop.at, 10.0);
    EXPECT_DOUBLE_EQ(stops.back().stop.at, -10.0);
    const std::string before = text();
    click(onPicture(0.5f, 0.5f));
    EXPECT_EQ(text(), before) << "a line without length";
    drag(onPicture(0.5f, 0.5f), onPicture(0.5f, 0.5f));
    EXPECT_EQ(text(), before);
}

TEST_F(PhotographTest, APixelIsPickedForTheSelectedStops) {
    dropAndFinish(panorama("sky.exr", false));
    click(mark("way Pixel").center());
    click(onPicture(0.5f, 0.75f));
    EXPECT_EQ(model().undoCount(), 0u) << "no stop is selected";
    EXPECT_TRUE(said().isError);
    click(mark("stop 0").center());
    click(onPicture(0.5f, 0.75f));
    ASSERT_EQ(model().undoCount(), 1u);
    const glm::dvec3 given =
        lighting::radianceOf(light(0).keys.front().gradient.stops.front().stop);
    EXPECT_LT(glm::length(given - sky(-45.0)), 0.03);
    press(Key::B);
    click(onPicture(0.5f, 0.25f));
    EXPECT_LT(glm::length(editor_->workspace().view().brushSettings.color - sky(45.0)), 0.03);
    EXPECT_EQ(model().undoCount(), 1u);
    keep("photograph-pixel");
}

TEST_F(PhotographTest, IsAskedForByItsKeyAndClosed) {
    const std::string path = panorama("sky.exr", false);
    control(Key::P);
    ASSERT_TRUE(has("path"));
    type(path);
    press(Key::Enter);
    finish();
    ASSERT_TRUE(photograph().radiance != nullptr);
    EXPECT_FALSE(editor_->wantsFrame()) << "an open photograph draws nothing";
    click(mark("Close").center());
    EXPECT_EQ(photograph().radiance, nullptr);
    EXPECT_FALSE(has("photograph"));
}

TEST_F(PhotographTest, ReadingIsCancelled) {
    const std::string before = text();
    const std::string path = panorama("sky.exr", true);
    for (const bool byKey : {true, false}) {
        send(platform::DropEvent{{path}});
        ASSERT_TRUE(editor_->works());
        // No `advance` before: it would bring in what has ended already.
        draw();
        draw();
        ASSERT_TRUE(has("Cancel work"));
        if (byKey) {
            send(platform::KeyEvent{Key::Escape, true, false, {}});
            send(platform::KeyEvent{Key::Escape, false, false, {}});
        } else {
            const ImVec2 place = mark("Cancel work").center();
            send(platform::MotionEvent{static_cast<double>(place.x), static_cast<double>(place.y)});
            send(platform::ButtonEvent{platform::PointerButton::Left, true, {}});
            send(platform::ButtonEvent{platform::PointerButton::Left, false, {}});
        }
        for (int i = 0; i < 4; ++i) {
            draw();
        }
        EXPECT_FALSE(editor_->works());
        settle();
        EXPECT_FALSE(has("Cancel work"));
        EXPECT_EQ(photograph().radiance, nullptr);
        EXPECT_EQ(text(), before);
    }
}

TEST_F(PhotographTest, WhatIsNoPictureIsOneLineInTheLog) {
    const std::string before = text();
    const std::string broken = folder_.file("broken.hdr");
    std::ofstream(broken) << "#?RADIANCE\nnot a picture";
    for (const std::string& path :
         {broken, folder_.file("absent.exr"), folder_.path().string() + "/"}) {
        const std::size_t lines = editor_->workspace().log().size();
        dropAndFinish(path);
        ASSERT_EQ(editor_->workspace().log().size(), lines + 1) << path;
        EXPECT_TRUE(said().isError);
        EXPECT_EQ(photograph().radiance, nullptr);
        EXPECT_EQ(text(), before);
    }
}

TEST_F(PhotographTest, OnePixelAndNumbersThatAreNoneAreTaken) {
    LODESTAR_NEEDS_SHARED();
    core::Image one(1, 1, 3);
    one.at(0, 0)[0] = 2.0f;
    ASSERT_TRUE(io::writeImage(folder_.file("one.exr"), one).ok());
    const std::string none =
        sharedPath("assets/hdr/OpenImageIO/oiiotool-fixnan/src/bad.exr").string();
    for (const std::string& path : {folder_.file("one.exr"), none}) {
        SCOPED_TRACE(path);
        dropAndFinish(path);
        ASSERT_NE(photograph().radiance, nullptr);
        for (const char* way : {"way Sky and sun", "way Mean over azimuth", "way Line"}) {
            if (!has(way)) {
                continue; // of panoramas alone
            }
            click(mark(way).center());
            for (const char* use : {"Use as the lights", "Use as the gradient"}) {
                if (has(use)) {
                    click(mark(use).center());
                    finish();
                }
            }
            drag(onPicture(0.2f, 0.2f), onPicture(0.7f, 0.9f));
            drag(onPicture(0.2f, 0.2f), onPicture(0.9f, 0.2f)); // no height
        }
        core::Tally repaired;
        const auto again = document::parseDocument(text(), repaired);
        ASSERT_TRUE(again.ok()) << again.error().message();
        EXPECT_EQ(document::writeDocument(*again), text());
        click(mark("Close").center());
    }
}

} // namespace
} // namespace lodestar::testing
