// SPDX-License-Identifier: MIT
//
// Lobes, levels and transfer functions against the oracles, and the hazards that their stable forms
// are for. Float tolerances count roundings of 6e-8; levels are as fine as a float of 8 allows,
// 1e-5 leaves a factor of 20.
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/environment.h"
#include "lodestar/cube.glsl"
#include "lodestar/display.glsl"
#include "lodestar/lobes.glsl"
#include "lodestar/sh9.glsl"
#include "numerics/oracles.h"

namespace lodestar::testing {

namespace {

using namespace shader;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

float number(const nlohmann::json& value) {
    return static_cast<float>(value.get<double>());
}

} // namespace

TEST(LobeOracles, CubeMipLevel) {
    for (const auto& one : oracleCases("cube_mip_level")) {
        const float w = number(one["in"]["w"]);
        const float s = number(one["in"]["s"]);
        EXPECT_NEAR(lodestar_mipLevelUnclamped(s, w), one["out"]["raw"].get<double>(), 1e-5);
        EXPECT_NEAR(lodestar_mipLevel(s, w, std::floor(std::log2(w))),
                    one["out"]["clamped"].get<double>(), 1e-5);
    }
}

TEST(LobeOracles, BlinnNormaliser) {
    for (const auto& one : oracleCases("blinn_normaliser")) {
        const double exact = one["out"]["exact"];
        // Ten roundings at most.
        EXPECT_NEAR(lodestar_blinnPhongNormaliser(number(one["in"]["s"])), exact, 6e-7 * exact);
    }
    EXPECT_NEAR(lodestar_blinnPhongNormaliser(0.0f), 1.0 / M_PI, 1e-7); // Lambert
}

TEST(LobeOracles, CosinePowerFromChord) {
    for (const auto& one : oracleCases("cos_power_from_chord")) {
        // s log(1 - d) is off by 6e-7 of itself, |a| e^a <= 0.37; the power of 0.1^10 by 1.4e-5 of
        // it.
        const double value = one["out"]["value"];
        EXPECT_NEAR(lodestar_cosinePowerFromChord(number(one["in"]["d"]), number(one["in"]["s"])),
                    value, std::min(1e-6, 2e-5 * value + 1e-30));
    }
}

TEST(LobeOracles, LobeWidth) {
    for (const auto& one : oracleCases("lobe_width")) {
        const float s = number(one["in"]["s"]);
        // At the half-maximum angle the power is a half; about r at n = v the Blinn-Phong power is
        // at twice that angle, where n.h is the cosine of half of it. The angle enters by sin(a) s
        // / 2 per radian, at most 20, its float rounding is 4e-8.
        const double phong = one["out"]["phong"];
        EXPECT_NEAR(lodestar_cosinePower(static_cast<float>(std::cos(phong)), s), 0.5, 5e-5);
        const double blinn = one["out"]["blinn"];
        const vec3 n(0.0f, 0.0f, 1.0f);
        const vec3 l(static_cast<float>(std::sin(blinn)), 0.0f,
                     static_cast<float>(std::cos(blinn)));
        EXPECT_NEAR(lodestar_cosinePowerBetween(n, normalize(n + l), s), 0.5, 5e-6);
        // The exponent whose Phong lobe has this width; ours also allows for n.l, and its stated
        // width error is 4 %: width goes as the root of the exponent.
        const double equivalent = one["out"]["equivalent_phong"];
        const double ours = lodestar_phongFromBlinnPhong(s);
        if (s >= 16.0f) {
            EXPECT_NEAR(std::sqrt((equivalent + 0.5) / ours), 1.0, 0.04);
        }
    }
}

TEST(LobeOracles, Schlick) {
    for (const auto& one : oracleCases("fresnel")) {
        EXPECT_NEAR(lodestar_schlickWeight(number(one["in"]["x"])),
                    one["out"]["schlick"].get<double>(), 9 * 6e-8);
    }
}

TEST(LobeOracles, Srgb) {
    for (const auto& one : oracleCases("srgb")) {
        const float linear = number(one["in"]["linear"]);
        const double encoded = one["out"]["encoded"];
        EXPECT_NEAR(lodestar_srgbFromLinear(linear), encoded, 14 * 6e-8);
        EXPECT_NEAR(lodestar_linearFromSrgb(static_cast<float>(encoded)), linear, 24 * 6e-8);
    }
}

TEST(LobeOracles, Sh9OfADeltaLight) {
    // One texel of a 64^2 face along +Z's neighbourhood, of solid angle W and radiance 1 / W.
    constexpr int kWidth = 64;
    lighting::Cubemap map(kWidth);
    const double omega = lighting::texelSolidAngles(kWidth)[kWidth / 2 * kWidth + kWidth / 2];
    map.texel(4, kWidth / 2, kWidth / 2) =
        glm::vec4(glm::vec3(static_cast<float>(1.0 / omega)), 1.0f);
    const float u = 1.0f / kWidth;
    const vec3 light = normalize(lodestar_cubeDirection(4, u, u));
    const vec3 side = normalize(cross(light, vec3(0.0f, 1.0f, 0.0f)));
    const lighting::Sh9Coefficients c = lighting::sh9FromCube(map);
    const auto at = [&](double x) {
        const vec3 n =
            light * static_cast<float>(x) + side * static_cast<float>(std::sqrt(1.0 - x * x));
        return lodestar_sh9(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], n).x;
    };
    for (const auto& one : oracleCases("sh9_delta")) {
        EXPECT_NEAR(at(one["in"]["x"]), one["out"]["sh9"].get<double>(), 2e-6);
    }
    EXPECT_EQ(at(-8.0 / 15.0), 0.0f); // -0.0126 before the clamp
}

TEST(LobeHazards, PowersAtTheEnds) {
    EXPECT_EQ(lodestar_cosinePower(0.0f, 0.0f), 0.0f);
    EXPECT_EQ(lodestar_cosinePower(0.3f, 0.0f), 1.0f);
    EXPECT_EQ(lodestar_cosinePower(-0.5f, 2.0f), 0.0f);
    EXPECT_EQ(lodestar_cosinePower(kNan, 2.0f), 0.0f);
    EXPECT_EQ(lodestar_cosinePower(std::numeric_limits<float>::denorm_min(), 1e7f), 0.0f);
    EXPECT_EQ(lodestar_cosinePowerFromChord(1.0f, 0.0f), 0.0f);
    EXPECT_EQ(lodestar_cosinePowerFromChord(0.0f, 1e7f), 1.0f);
}

TEST(LobeHazards, ExponentsAreRepaired) {
    EXPECT_EQ(lodestar_repairExponent(kNan), 0.0f);
    EXPECT_EQ(lodestar_repairExponent(-3.0f), 0.0f);
    EXPECT_EQ(lodestar_repairExponent(kInfinity), 1e7f);
    EXPECT_EQ(lodestar_mipLevel(kNan, 256.0f, 8.0f), 8.0f);
    EXPECT_EQ(lodestar_mipLevel(-3.0f, 256.0f, 8.0f), 8.0f);
    EXPECT_EQ(lodestar_mipLevel(kInfinity, 256.0f, 8.0f), 0.0f);
}

TEST(LobeHazards, LevelsStayInTheChain) {
    EXPECT_NEAR(lodestar_mipLevelUnclamped(1.0f, 256.0f), 8.29248125, 1e-5);
    EXPECT_EQ(lodestar_mipLevel(1.0f, 256.0f, 8.0f), 8.0f);
    EXPECT_NEAR(lodestar_mipLevelUnclamped(1e7f, 256.0f), -2.83426715, 1e-5);
    EXPECT_EQ(lodestar_mipLevel(1e7f, 256.0f, 8.0f), 0.0f);
    EXPECT_EQ(lodestar_raiseLevel(3.0f, -kInfinity, 8.0f), 3.0f);
    EXPECT_EQ(lodestar_raiseLevel(3.0f, kNan, 8.0f), 3.0f);
    EXPECT_EQ(lodestar_raiseLevel(3.0f, kInfinity, 8.0f), 8.0f);
    const vec3 d(0.2f, -0.4f, 0.9f);
    const vec3 still(0.0f);
    EXPECT_EQ(lodestar_raiseLevel(3.0f, lodestar_footprintLevel(d, still, still, 256.0f), 8.0f),
              3.0f);
    EXPECT_EQ(lodestar_raiseLevel(3.0f, lodestar_footprintLevel(still, still, still, 256.0f), 8.0f),
              3.0f);
    EXPECT_EQ(lodestar_raiseLevel(3.0f, lodestar_footprintLevel(d, vec3(kNan), d, 256.0f), 8.0f),
              3.0f);
}

TEST(LobeHazards, SharpPowersOfFloatVectors) {
    // An angle of 1e-4 at s = 1e7: exp(-0.05). The cosine rounds to 1 in float, the chord does not:
    // its square is off by 2 roundings of the sine.
    const vec3 n(0.0f, 0.0f, 1.0f);
    const vec3 h(std::sin(1e-4f), 0.0f, std::cos(1e-4f));
    EXPECT_NEAR(lodestar_cosinePowerBetween(n, h, 1e7f), 0.951229424, 1e-6);
    EXPECT_NEAR(lodestar_cosinePowerFromChord(1e-6f, 1e5f), 0.904837372794, 1e-6);
}

TEST(LobeHazards, SchlickBeyondOne) {
    EXPECT_EQ(lodestar_schlickWeight(1.0000001f), 0.0f);
    EXPECT_EQ(lodestar_schlickWeight(-0.1f), 1.0f);
}

TEST(LobeHazards, OppositeAndZeroVectors) {
    const vec3 n(0.0f, 0.0f, 1.0f);
    const vec3 l = normalize(vec3(0.3f, 0.1f, 0.8f));
    const vec3 diffuse(0.5f);
    // No half vector: no highlight, what stays is diffuse light.
    const vec3 opposite = lodestar_directReflectance(n, -l, l, diffuse, vec3(0.0f), 64.0f);
    EXPECT_LE(opposite.x, 0.5f / LODESTAR_PI * l.z * (1.0f + 1e-6f));
    const vec3 zero(0.0f);
    for (const vec3& value :
         {lodestar_directReflectance(zero, l, l, diffuse, diffuse, 8.0f),
          lodestar_directReflectance(n, zero, zero, diffuse, diffuse, 8.0f),
          lodestar_safeNormalize(zero, n), lodestar_safeNormalize(vec3(kNan), n)}) {
        EXPECT_TRUE(std::isfinite(value.x + value.y + value.z));
    }
    EXPECT_EQ(lodestar_texelSizeLevel(zero), 0.0f);
    EXPECT_TRUE(std::isfinite(lodestar_tentLevel(zero, kNan, 256.0f, 8.0f)));
    EXPECT_EQ(lodestar_cubeCoordinates(zero), vec2(0.0f));
    const vec2 tiny = lodestar_cubeCoordinates(vec3(1e-40f, 0.0f, 0.0f));
    EXPECT_EQ(tiny, vec2(0.0f));
}

TEST(TexelSize, NeedsNoUnitDirection) {
    const vec3 d = normalize(vec3(0.3f, -0.7f, 0.5f));
    const float unit = lodestar_texelSizeLevel(d);
    // Scaling by a power of two is exact; lengths whose squares leave float's range work too.
    EXPECT_NEAR(lodestar_texelSizeLevel(d * 0.125f), unit, 1e-6f);
    EXPECT_NEAR(lodestar_texelSizeLevel(d * 1e-25f), unit, 1e-6f);
    EXPECT_NEAR(unit, -1.5f * std::log2(0.7f / std::sqrt(0.83f)) - 0.467f, 1e-6f);
    // The ends: a face's centre and the cube's corner.
    EXPECT_NEAR(lodestar_texelSizeLevel(vec3(0.0f, 2.0f, 0.0f)), -0.467f, 1e-7f);
    EXPECT_NEAR(lodestar_texelSizeLevel(vec3(-1.0f, 1.0f, 1.0f)), 0.75 * std::log2(3.0) - 0.467,
                1e-6);
}

TEST(TexelSize, CountsTexels) {
    // MIP-4: 4^q is the mean texel over this one, so its mean over the sphere is 1: over the texels
    // of a face, the sum of W 4^q is that of as many mean texels. 0.467 stands for 0.46674.
    constexpr int kWidth = 64;
    const std::vector<double> omega = lighting::texelSolidAngles(kWidth);
    double sum = 0.0;
    for (int i = 0; i < kWidth * kWidth; ++i) {
        const float u = static_cast<float>(2 * (i % kWidth) + 1) / kWidth - 1.0f;
        const float v = static_cast<float>(2 * (i / kWidth) + 1) / kWidth - 1.0f;
        sum += omega[static_cast<std::size_t>(i)] *
               std::exp2(2.0 * lodestar_texelSizeLevel(lodestar_cubeDirection(0, u, v)));
    }
    // The midpoint rule at 64 texels is good to 1e-4, the rounded constant to 4e-4.
    EXPECT_NEAR(sum * 6.0 / (4.0 * M_PI), 1.0, 6e-4);
}

TEST(TentLevel, NeverRisesWithTheExponentAndMovesWithTheDirection) {
    for (const vec3& d : {vec3(0.0f, 0.0f, 1.0f), vec3(0.6f, 0.0f, 0.8f), vec3(0.577f)}) {
        float before = INFINITY;
        for (float logExponent = 0.0f; logExponent < 20.0f; logExponent += 0.01f) {
            const float s = std::exp2(logExponent) - 1.0f;
            const float level = lodestar_tentLevel(d, s, 4096.0f, 20.0f);
            EXPECT_LE(level, before + 2e-6f) << s; // two units in the last place of 13
            before = level;
        }
    }
    // MIP-5: round levels do not see the texel's size, tents all of it.
    const vec3 corner(0.57735027f);
    const vec3 centre(0.0f, 1.0f, 0.0f);
    EXPECT_EQ(lodestar_tentLevel(corner, 20.0f, 256.0f, 8.0f),
              lodestar_tentLevel(centre, 20.0f, 256.0f, 8.0f));
    // 0.75 log2(3) between them; the levels are rounded at 3, eight units in the last place.
    EXPECT_NEAR(lodestar_tentLevel(corner, 8191.0f, 256.0f, 8.0f) -
                    lodestar_tentLevel(centre, 8191.0f, 256.0f, 8.0f),
                0.75 * std::log2(3.0), 2e-6);
}

TEST(Furnace, FresnelSplitsAllLight) {
    // k_L (1 - F) + F under a white environment: 1 for (k_L = 1, F0 = 0) and for F0 = 1.
    for (const float s : {0.0f, 0.5f, 1.0f, 10.0f, 1e3f, 1e5f, 1e7f, kInfinity, kNan, -1.0f}) {
        for (const float nDotV : {0.0f, 1e-4f, 0.1f, 0.5f, 0.9f, 1.0f, 1.0000001f}) {
            const float dielectric = lodestar_fresnelEnvironment(vec3(0.0f), nDotV, s).x;
            EXPECT_GE(dielectric, 0.0f);
            EXPECT_LE(dielectric, 1.0f);
            EXPECT_NEAR((1.0f - dielectric) + dielectric, 1.0f, 6e-8f);
            EXPECT_EQ(lodestar_fresnelEnvironment(vec3(1.0f), nDotV, s).x, 1.0f);
        }
    }
    // Rough things have no white rims: at s = 0 the rise is nothing at all.
    EXPECT_EQ(lodestar_fresnelEnvironment(vec3(0.04f), 0.0f, 0.0f).x, 0.04f);
}

} // namespace lodestar::testing
