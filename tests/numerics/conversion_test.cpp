// SPDX-License-Identifier: MIT
//
// The lookup conversion (docs/derivations/lookup.md): its limits, and the L2 error of the Phong
// lobe it gives against the true Blinn-Phong lobe, by quadrature over half vectors.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "lodestar/cube.glsl"
#include "lodestar/lobes.glsl"
#include "lodestar/taps.glsl"
#include "numerics/blinn_lobe.h"

namespace lodestar::shader {

/// The least host that the text can be read into: black, fetches nothing.
class BlackHost {
public:
    vec4 lodestar_host_cube(int, vec3, Real) { return vec4(0.0f); }
    vec3 lodestar_host_irradiance(int, vec3) { return vec3(0.0f); }
#define LODESTAR_HOST_CLASS
#include "lodestar/environment.glsl"
#undef LODESTAR_HOST_CLASS
};

} // namespace lodestar::shader

namespace lodestar::testing {

namespace {

using namespace shader;

constexpr std::array kDegrees{0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0};

/// The error of the conversion, the error about the reflection with the exponent of n = v, and with
/// the Blinn-Phong exponent as it is.
struct Errors {
    double converted;
    double aboutReflection;
    double asGiven;
};

Errors errorsAt(double exponent, double degrees) {
    // At 64 x 96 points the errors stand to 1e-4 up to s = 1e5 (checked against 160 x 256).
    const BlinnLobe lobe(exponent, degrees * std::numbers::pi / 180.0, 64, 96);
    const float s = static_cast<float>(exponent);
    const float nDotV = static_cast<float>(lobe.view().z);
    return {
        lobe.phongError(lobe.direction(static_cast<double>(lodestar_lookupBlend(s, nDotV))),
                        static_cast<double>(lodestar_lookupExponent(s, nDotV))),
        lobe.phongError(lobe.reflection(), static_cast<double>(lodestar_phongFromBlinnPhong(s))),
        lobe.phongError(lobe.reflection(), exponent)};
}

} // namespace

TEST(Conversion, ZeroIsExactlyLambert) {
    BlackHost host;
    const vec3 n = glm::normalize(vec3(0.2f, 0.9f, -0.3f));
    for (const vec3& v : {n, glm::normalize(vec3(0.9f, 0.3f, 0.1f)), vec3(0.0f, 1.0f, 0.0f)}) {
        for (const float s : {0.0f, lodestar_exponentFromRoughness(1.0f)}) {
            const auto lookup = host.lodestar_lookup(n, v, s);
            // Making the normal unit again rounds twice.
            EXPECT_NEAR(glm::distance(lookup.direction, n), 0.0f, 3e-7f);
            EXPECT_NEAR(lookup.exponent, 1.0f, 3e-7f);
        }
    }
}

TEST(Conversion, KeepsTheExponentAtNormalIncidence) {
    for (const float s : {0.0f, 0.3f, 1.0f, 8.0f, 100.0f, 1e5f, 1e7f}) {
        EXPECT_EQ(lodestar_lookupExponent(s, 1.0f), lodestar_phongFromBlinnPhong(s));
    }
}

TEST(Conversion, RisesFromNormalToReflection) {
    for (const float nDotV : {0.0f, 0.01f, 0.3f, 0.7f, 1.0f}) {
        float blend = 0.0f;
        float exponent = 1.0f;
        EXPECT_EQ(lodestar_lookupBlend(0.0f, nDotV), 0.0f);
        for (float s = 1e-4f; s < 1e7f; s *= 1.3f) {
            const float nextBlend = lodestar_lookupBlend(s, nDotV);
            const float nextExponent = lodestar_lookupExponent(s, nDotV);
            // Steps near the ends are finer than float's.
            EXPECT_GE(nextBlend, blend);
            EXPECT_LE(nextBlend, 1.0f);
            EXPECT_GE(nextExponent, exponent * (1.0f - 1e-6f));
            blend = nextBlend;
            exponent = nextExponent;
        }
        // 1 - t = 1 / (1 + o), o >= 0.34 sqrt(s).
        EXPECT_GT(blend, 0.999f);
    }
}

TEST(Conversion, IsFiniteEverywhere) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float s : {-1.0f, std::nanf(""), 0.0f, 1e-38f, 1.0f, 1e7f, 1e30f, kInfinity}) {
        for (const float nDotV : {0.0f, 1e-20f, 0.5f, 1.0f, 1.0000001f}) {
            const float blend = lodestar_lookupBlend(s, nDotV);
            EXPECT_TRUE(blend >= 0.0f && blend <= 1.0f) << s;
            const float exponent = lodestar_lookupExponent(s, nDotV);
            EXPECT_TRUE(exponent >= 1.0f - 1e-6f && exponent <= 1.3e7f) << s;
        }
    }
    BlackHost host;
    for (const vec3& v : {vec3(0.0f), vec3(0.0f, 0.0f, -1.0f), vec3(1.0f, 0.0f, 0.0f)}) {
        const auto lookup = host.lodestar_lookup(vec3(0.0f, 0.0f, 1.0f), v, 4.0f);
        EXPECT_NEAR(glm::length(lookup.direction), 1.0f, 3e-7f);
    }
}

TEST(Conversion, NormalIncidenceIsWithinThreePercent) {
    for (const double s : {0.5, 1.0, 2.0, 4.0, 6.0, 8.0, 12.0, 16.0, 64.0, 1024.0}) {
        EXPECT_LE(errorsAt(s, 0.0).converted, 0.0295) << s; // stated as 0.029
    }
}

TEST(Conversion, TableOfErrors) {
    // The table of docs/derivations/lookup.md; its three digits and the quadrature are good to
    // 2e-3.
    struct Row {
        double exponent;
        std::array<double, kDegrees.size()> errors;
    };
    const std::array rows{Row{0.5, {.006, .015, .026, .036, .041, .044, .057}},
                          Row{1.0, {.011, .023, .040, .054, .062, .070, .096}},
                          Row{2.0, {.018, .031, .051, .068, .083, .106, .147}},
                          Row{4.0, {.025, .035, .053, .075, .104, .153, .208}},
                          Row{8.0, {.029, .031, .049, .085, .136, .214, .286}},
                          Row{16.0, {.024, .027, .053, .106, .180, .284, .378}},
                          Row{32.0, {.016, .025, .062, .130, .227, .358, .472}},
                          Row{64.0, {.009, .023, .069, .149, .267, .428, .566}},
                          Row{256.0, {.002, .021, .073, .167, .315, .531, .715}},
                          Row{1024.0, {.001, .019, .073, .171, .331, .579, .798}}};
    for (const Row& row : rows) {
        std::printf("%6.6g", row.exponent);
        for (std::size_t i = 0; i < kDegrees.size(); ++i) {
            const Errors errors = errorsAt(row.exponent, kDegrees[i]);
            std::printf("  %.3f", errors.converted);
            EXPECT_NEAR(errors.converted, row.errors[i], 2e-3)
                << row.exponent << " " << kDegrees[i];
            // Never worse than the simpler answers.
            EXPECT_LE(errors.converted, errors.aboutReflection + 1e-3);
            EXPECT_LT(errors.converted, errors.asGiven);
        }
        std::printf("\n");
    }
}

} // namespace lodestar::testing
