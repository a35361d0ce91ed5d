// SPDX-License-Identifier: MIT
//
// lodestar-host-osg-view, with a display and without.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "golden/gltf_builder.h"
#include "support/picture.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

class OsgView : public ::testing::Test {
protected:
    OsgView() {
        GltfBuilder file;
        const io::GltfPrimitive shape = sphere(24, 48);
        const int red = file.lambert(0.7f, 0.3f, 0.2f);
        file.show({file.primitive(shape, red)}, {{"translation", {-1.1, 0, 0}}});
        file.show({file.primitive(shape, red)}, {{"translation", {1.1, 0, 0}}});
        scene_ = file.write(folder_).string();
        lighting_ = folder_
                        .write("day.lodestar.json", std::string(R"({"lodestar": 1, "lights": [
            {"kind": "sun", "visibility": false, "path": {"latitude": 45, "dayOfYear": 170}, "keys": [
                {"hour": 12, "gradient": {"stops": [{"at": 0, "color": [4, 3.5, 3]}, {"at": 40, "color": [0, 0, 0]}]}}]}]})"))
                        .string();
    }

    /// @return the exit status  @param before the program: a display or none
    int called(const std::string& before, const std::string& program, const std::string& more) {
        const std::string own = LODESTAR_EXECUTABLE;
        const std::string line = before + " " + own.substr(0, own.rfind('/') + 1) + program + " " +
                                 scene_ + " --lighting " + lighting_ + " --size 160x100 " + more;
        return WEXITSTATUS(std::system(line.c_str()));
    }

    core::Image drawn(const std::string& before, const std::string& program,
                      const std::string& more) {
        const std::string out = (folder_ / "drawn.png").string();
        std::filesystem::remove(out); // no picture of before is read
        const int status = called(before, program, more + " -o " + out);
        EXPECT_EQ(status, 0) << more;
        return status == 0 ? readPicture(out) : core::Image(1, 1, 4);
    }

    /// One step of 8 bits, rounded: the trackball's turns and a window's rows, which run the other
    /// way, each round differently.
    static constexpr double kStep = 1.5 / 255.0;

    TemporaryFolder folder_;
    std::string scene_, lighting_;
};

constexpr const char* kNoDisplay = "env -u DISPLAY";
constexpr const char* kDisplay = "bash " LODESTAR_TEST_DATA "/hosts/on_display.sh";
constexpr const char* kView = "lodestar-host-osg-view";

TEST_F(OsgView, WithoutADisplayItDrawsWhatThePlainHostDraws) {
    const core::Image plain = drawn(kNoDisplay, "lodestar-host-osg", "--hour 8");
    const core::Image first = drawn(kNoDisplay, kView, "--hour 8 --frames 1 --no-backdrop");
    EXPECT_LE(compare(first, plain, kStep).largest, kStep);
    // Half a second at two hours a second is an hour later.
    const core::Image later =
        drawn(kNoDisplay, kView, "--hour 8 --hours-per-second 2 --frames 16 --no-backdrop");
    EXPECT_LE(compare(later, drawn(kNoDisplay, "lodestar-host-osg", "--hour 9"), kStep).largest,
              kStep);
    EXPECT_GT(compare(later, plain, kStep).largest, 10.0 * kStep);
    // With its backdrop what nothing covers is opaque.
    const core::Image whole = drawn(kNoDisplay, kView, "--hour 8 --frames 1");
    EXPECT_EQ(whole.at(0, 0)[3], 1.0f);
    EXPECT_EQ(first.at(0, 0)[0], 0.0f);
}

TEST_F(OsgView, OnADisplayItDrawsTheSameByAllThreads) {
    if (WEXITSTATUS(std::system((std::string(kDisplay) + " true >/dev/null").c_str())) == 77) {
        GTEST_SKIP() << "needs Xvfb";
    }
    const std::string day = "--hour 8 --hours-per-second 6 --frames 12";
    const core::Image wanted = drawn(kNoDisplay, kView, day);
    for (const std::string threads :
         {"", " --threading 0", " --threading 1", " --threading 2", " --threading 3"}) {
        EXPECT_LE(compare(drawn(kDisplay, kView, day + threads), wanted, kStep).largest, kStep)
            << threads;
    }
}

TEST_F(OsgView, WhatItCannotDoIsSaid) {
    const std::string quiet = " 2>/dev/null >/dev/null";
    EXPECT_EQ(called(kNoDisplay, kView, "--help" + quiet), 2) << "a word without its value";
    EXPECT_EQ(called(kNoDisplay, kView, "--threading 4 --frames 1" + quiet), 2);
    EXPECT_EQ(called(kNoDisplay, kView, "--frames 0" + quiet), 2);
    EXPECT_EQ(called(kNoDisplay, kView, "-o x.png" + quiet), 2) << "of which frame";
    EXPECT_EQ(called(kNoDisplay, kView, quiet), 2) << "no display, no end";
    EXPECT_EQ(called(kNoDisplay, kView, "--frames 1 --threading 2" + quiet), 2);
    folder_.write("day.lodestar.json", std::string(R"({"lodestar": 1})"));
    EXPECT_EQ(called(kNoDisplay, kView, "--frames 1" + quiet), 3);
    scene_ += ".missing";
    EXPECT_EQ(called(kNoDisplay, kView, "--frames 1" + quiet), 3);
}

} // namespace
} // namespace lodestar::testing
