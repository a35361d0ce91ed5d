// SPDX-License-Identifier: MIT
//
// Panoramas with real dynamic range: the cube made from one, and the irradiance cube made from
// that.
#include <gtest/gtest.h>

#include "io/file.h"
#include "io/image_file.h"
#include "lighting/environment.h"
#include "numerics/ladder_environments.h"
#include "support/full_irradiance.h"

namespace lodestar::lighting {
namespace {

constexpr int kWidth = 256;

class Panoramas : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        path_ = testing::panoramaPath(GetParam());
        if (!std::filesystem::exists(path_)) {
            GTEST_SKIP() << path_ << " is absent (Debian package blender-data)";
        }
        auto bytes = io::readFile(path_);
        ASSERT_TRUE(bytes) << bytes.error().message();
        auto decoded = io::decodeImage(*bytes, 3);
        ASSERT_TRUE(decoded) << decoded.error().message();
        core::Tally warnings;
        repairRadiance(decoded->image, warnings);
        cube_ = cubeFromLatLong(decoded->image, kWidth);
    }

    std::filesystem::path path_;
    Cubemap cube_;
};

/// The ladder's own resampling, in double with an arc function a sample. Ours keeps positions in
/// float after the floor (6e-8 of a pixel), of which a pixel's neighbours may be 1e4 times brighter
/// than the texel's other samples; the texel then holds some of the bright one too.
TEST_P(Panoramas, CubeAgreesWithPlainResampling) {
    const Cubemap plain = testing::panoramaSet({GetParam()}, kWidth).at(0).base;
    ASSERT_EQ(plain.level(0).size(), cube_.level(0).size());
    for (std::size_t i = 0; i < plain.level(0).size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float expected = plain.level(0)[i][c];
            ASSERT_NEAR(cube_.level(0)[i][c], expected, 1e-5f * expected) << "texel " << i;
        }
    }
}

TEST_P(Panoramas, IrradianceIsWithinHalfAPercentOfTheFullSum) {
    const double error = testing::relativeIrradianceError(cube_);
    RecordProperty("relative_rms", std::to_string(error));
    EXPECT_LT(error, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Blender, Panoramas,
                         ::testing::Values("sunset", "interior", "courtyard", "forest"));

} // namespace
} // namespace lodestar::lighting
