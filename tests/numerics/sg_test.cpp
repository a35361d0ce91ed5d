// SPDX-License-Identifier: MIT
//
// Spherical Gaussians: against values computed to 34 digits, against cosine powers, and for any
// finite input (docs/derivations/sg.md). u below is 2^-24, a float's rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/lobes.glsl"
#undef LODESTAR_DOUBLE_PRECISION
#include "numerics/oracles.h"
#include "numerics/property_inputs.h"
#include "numerics/sg_float.h"

namespace lodestar::testing {
namespace {

constexpr double u = 0x1p-24;
constexpr double kPi = std::numbers::pi;

float number(const nlohmann::json& value) {
    return static_cast<float>(value.get<double>());
}

/// Two unit vectors with that cosine between them.
struct Pair {
    glm::vec3 a{0.0f, 0.0f, 1.0f};
    glm::vec3 b;
};
Pair apart(double cosine) {
    return {
        {0.0f, 0.0f, 1.0f},
        {static_cast<float>(std::sqrt(1.0 - cosine * cosine)), 0.0f, static_cast<float>(cosine)}};
}

double exactIntegral(double l) {
    return l > 0.0 ? -2.0 * kPi * std::expm1(-2.0 * l) / l : 4.0 * kPi;
}

rc::Gen<float> anyFinite() {
    return rc::gen::map(anyFloat(), [](float x) { return std::isfinite(x) ? x : 0.0f; });
}

bool isShare(float x) {
    return x >= 0.0f && x <= 1.0f; // false for NaN
}

} // namespace

TEST(SgOracles, Integral) {
    for (const auto& one : oracleCases("sg_integral")) {
        const double exact = one["out"]["sphere"];
        EXPECT_NEAR(sg::integral(number(one["in"]["lam"])), exact, 1e-6 * exact);
    }
    // Where exp rounds 1 - exp(-2 l) to 0.
    EXPECT_NEAR(sg::integral(1e-8f), 12.5663704887, 1e-6 * 12.6);
}

TEST(SgOracles, VonMisesFisherPeak) {
    for (const auto& one : oracleCases("vmf")) {
        const double exact = one["out"]["peak"];
        EXPECT_NEAR(sg::vonMisesFisher(0.0f, number(one["in"]["k"])), exact, 1e-6 * exact);
    }
    // Where 4 pi sinh(k) is infinite in float.
    EXPECT_NEAR(sg::vonMisesFisher(0.0f, 90.0f), 14.3239448783, 1e-6 * 14.4);
}

// A vector's components are off by u; the chord's square, and with it the logarithm y of the
// product's amplitude, by 4 u / |chord| of itself, beside 12 roundings.
TEST(SgOracles, IntegralOfAProduct) {
    for (const auto& one : oracleCases("sg_inner_product")) {
        const double cosine = one["in"]["c"];
        const auto [a, b] = apart(cosine);
        const double exact = one["out"]["value"];
        const double la = one["in"]["l1"], lb = one["in"]["l2"];
        const double chord = std::sqrt(2.0 - 2.0 * cosine);
        const double m = std::sqrt(la * la + lb * lb + 2.0 * la * lb * cosine);
        const double y = la * lb * chord * chord / (la + lb + m);
        const double bound = y * (chord > 0.0 ? 4.0 * u / chord : 0.0) + 12.0 * u * (1.0 + y);
        EXPECT_NEAR(sg::productIntegral(a, static_cast<float>(la), b, static_cast<float>(lb)),
                    exact, exact * bound)
            << la << " " << lb << " " << cosine;
    }
    const auto [a, b] = apart(-1.0);
    EXPECT_NEAR(sg::productIntegral(a, 3.0f, b, 3.0f), 0.0311489185131, 1e-6 * 0.0312);
}

TEST(SgOracles, Fresnel) {
    for (const auto& one : oracleCases("fresnel")) {
        // y by three roundings, of which 2^y leaves |y| 2^y ln 2 <= 0.37; exp2 by one of 1, and the
        // oracle's x by its own: a slope of at most 5 times u / 2.
        EXPECT_NEAR(sg::fresnelWeight(number(one["in"]["x"])), one["out"]["sg"].get<double>(),
                    4.0 * u);
    }
}

TEST(SgOracles, FitsOfCosinePowers) {
    for (const auto& one : oracleCases("sg_blinn_fit")) {
        const double k = one["in"]["k"], d = 1.0 - one["in"]["x"].get<double>();
        const std::pair<const char*, double> fits[] = {{"c0", 0.0},
                                                       {"c075", shader_double::LODESTAR_SG_SHAPE},
                                                       {"c1", shader_double::LODESTAR_SG_ENERGY}};
        for (const auto& [name, rise] : fits) {
            EXPECT_NEAR(shader_double::lodestar_sg(d, shader_double::lodestar_sgSharpness(k, rise)),
                        one["out"][name].get<double>(), 1e-13);
        }
    }
}

// 1e-6 of itself for every sharpness, a hundred an octave, and where the forms meet.
TEST(Sg, IntegralIsRightForEverySharpness) {
    std::vector<float> all{0.0f, 1e-38f, 1e-8f, 9.99e-4f, 1e-3f, 0.0499f, 0.05f, 1e6f};
    for (double l = 1e-9; l < 1e6; l *= 1.00695) {
        all.push_back(static_cast<float>(l));
    }
    double worst = 0.0;
    for (const float l : all) {
        const double exact = exactIntegral(static_cast<double>(l));
        worst = std::max(worst, std::abs(static_cast<double>(sg::integral(l)) / exact - 1.0));
        // And the density made of it integrates to 1.
        EXPECT_NEAR(static_cast<double>(sg::vonMisesFisher(0.0f, l)) * exact, 1.0, 1e-6) << l;
    }
    std::printf("integral: at most %.2e of itself off\n", worst);
    EXPECT_LE(worst, 1e-6);
}

// The greatest difference from x^k over the hemisphere, k = 1 4 8 16 32 128 1024, as found by a
// separate study; within 5 %, its figures having two or three digits (SG-2, SG-3).
TEST(Sg, GreatestDifferenceFromAPower) {
    constexpr std::array<double, 7> kExponents{1, 4, 8, 16, 32, 128, 1024};
    const std::pair<double, std::array<double, 7>> table[] = {
        {0.0, {.368, .074, .035, .017, .0086, .0021, 2.6e-4}},
        {0.775, {.169, .036, .019, .0097, .0049, .0012, 1.6e-4}},
        {1.0, {.153, .051, .027, .014, .0071, .0018, 2.2e-4}}};
    for (const auto& [rise, expected] : table) {
        for (std::size_t i = 0; i < kExponents.size(); ++i) {
            const double k = kExponents[i];
            double most = 0.0;
            for (int j = 0; j <= 100000; ++j) {
                // Even in x, and in the d of sharp lobes.
                for (const double d : {j * 1e-5, j * 1e-5 * std::min(1.0, 20.0 / k)}) {
                    const double lobe =
                        shader_double::lodestar_sg(d, shader_double::lodestar_sgSharpness(k, rise));
                    most = std::max(most, std::abs(std::pow(1.0 - d, k) - lobe));
                }
            }
            EXPECT_NEAR(most, expected[i], 0.05 * expected[i]) << rise << " " << k;
        }
    }
}

// What direct light takes is nearer than either (SG-3): the table's best is .016 and 9.8e-4.
TEST(Sg, AHighlightsShapeIsNearTheBest) {
    for (const auto& [k, best] : {std::pair{8.0, .016}, {128.0, 9.8e-4}}) {
        double most = 0.0;
        for (int j = 0; j <= 100000; ++j) {
            const double d = j * 1e-5 * std::min(1.0, 20.0 / k);
            const double lobe = shader_double::lodestar_sg(
                d, shader_double::lodestar_sgSharpness(k, shader_double::LODESTAR_SG_SHAPE));
            most = std::max(most, std::abs(std::pow(1.0 - d, k) - lobe));
        }
        EXPECT_LT(most, 1.25 * best);
        EXPECT_GT(most, best * 0.95);
    }
}

// With c = 1 the integral over the sphere is the power's, 2 pi / (k + 1), but for e^(-2 (k + 1)).
TEST(Sg, EnergyIsThePowers) {
    for (const double k : {2.0, 8.0, 64.0, 1e4}) {
        const double whole = shader_double::lodestar_sgIntegral(
            shader_double::lodestar_sgSharpness(k, shader_double::LODESTAR_SG_ENERGY));
        EXPECT_NEAR(whole * (k + 1.0) / (2.0 * kPi), 1.0,
                    1.01 * std::exp(-2.0 * (k + 1.0)) + 1e-14);
    }
}

// The greatest and least difference from (1 - x)^5, and their places (SG-8).
TEST(Sg, FresnelsDifferenceFromSchlick) {
    double most = 0.0, least = 0.0, sum = 0.0;
    constexpr int kSteps = 100000;
    for (int i = 0; i <= kSteps; ++i) {
        const double x = static_cast<double>(i) / kSteps;
        const double off =
            shader_double::lodestar_sgFresnelWeight(x) - shader_double::lodestar_schlickWeight(x);
        most = std::max(most, off);
        least = std::min(least, off);
        sum += off * off / kSteps;
    }
    EXPECT_NEAR(most, .00377, 5e-6);
    EXPECT_NEAR(least, -.0029, 5e-5);
    EXPECT_NEAR(std::sqrt(sum), .0022, 5e-5);
}

// A product at its own axis is the product of both there, and so is its integral by a sum over
// the sphere: the midpoint rule in cosine and azimuth about the product's axis, whose error is
// 1 / 24 n^2 of the change of slope, sharpness^2 / sharpness: 2e-5 for 50 and n = 2000.
TEST(Sg, AProductIsTheProduct) {
    using namespace shader_double;
    const vec3 a = glm::normalize(vec3(1.0, 2.0, -0.5));
    for (const auto& [b, la, lb] : {std::tuple{glm::normalize(vec3(-1.0, 2.0, 0.3)), 3.0, 20.0},
                                    {vec3(-a), 2.0, 5.0},
                                    {a, 7.0, 11.0}}) {
        const LodestarSg product = lodestar_sgProduct(a, la, b, lb);
        const vec3 across = glm::normalize(glm::cross(product.axis, vec3(0.0, 0.0, 1.0)));
        const vec3 along = glm::cross(product.axis, across);
        constexpr int kRings = 2000, kTurns = 16;
        double sum = 0.0;
        for (int i = 0; i < kRings; ++i) {
            const double z = 1.0 - 2.0 * (i + 0.5) / kRings;
            for (int j = 0; j < kTurns; ++j) {
                const double azimuth = 2.0 * kPi * j / kTurns;
                const vec3 d =
                    z * product.axis + std::sqrt(1.0 - z * z) *
                                           (std::cos(azimuth) * across + std::sin(azimuth) * along);
                const double both = lodestar_sgBetween(a, d, la) * lodestar_sgBetween(b, d, lb);
                EXPECT_NEAR(product.amplitude * lodestar_sg(1.0 - z, product.sharpness), both,
                            1e-12);
                sum += both;
            }
        }
        const double whole = lodestar_sgProductIntegral(a, la, b, lb);
        EXPECT_NEAR(sum * 4.0 * kPi / (kRings * kTurns), whole, 2e-5 * whole + 1e-12);
    }
}

RC_GTEST_PROP(Sg, AnyFiniteInputGivesFiniteShares, ()) {
    const glm::vec3 a(*anyFinite(), *anyFinite(), *anyFinite());
    const glm::vec3 b(*anyFinite(), *anyFinite(), *anyFinite());
    const float la = *anyFinite(), lb = *anyFinite(), d = *anyFinite();
    RC_ASSERT(isShare(sg::lobe(d, la)));
    RC_ASSERT(isShare(sg::between(a, b, la)));
    const float whole = sg::integral(la);
    RC_ASSERT(whole >= 0.0f && whole <= 4.0f * std::numbers::pi_v<float> * (1.0f + 1e-6f));
    const float density = sg::vonMisesFisher(d, la);
    RC_ASSERT(density >= 0.0f && density <= 1.6e6f); // 1e7 / (2 pi)
    const auto [sharpness, amplitude, axis] = sg::product(a, la, b, lb);
    RC_ASSERT(sharpness >= 0.0f && sharpness <= 2.001e7f && isShare(amplitude));
    RC_ASSERT(std::isfinite(axis.x) && std::isfinite(axis.y) && std::isfinite(axis.z));
    const float both = sg::productIntegral(a, la, b, lb);
    RC_ASSERT(both >= 0.0f && both <= 4.0f * std::numbers::pi_v<float> * (1.0f + 1e-6f));
    RC_ASSERT(isShare(sg::fresnelWeight(d)));
}

// Both forms of direct light: finite, nowhere negative, one where the exponent is sharp.
RC_GTEST_PROP(Sg, HighlightsAreNearThePowers, ()) {
    const glm::vec3 n = *direction(), v = *direction(), l = *direction();
    const float s = *exponent();
    const float power = sg::direct(n, v, l, s, 0, 0);
    const float gaussian = sg::direct(n, v, l, s, 1, 0);
    RC_ASSERT(std::isfinite(gaussian) && gaussian >= 0.0f);
    RC_ASSERT(std::isfinite(sg::direct(n, v, l, s, 1, 1)));
    // Of a peak of (s + 2) (s + 4) / (8 pi s): s times the greatest difference is .174 at s = 1,
    // the most, and .152 for sharp lobes; a half vector's rounding moves either by sqrt(s) u of the
    // peak.
    const float finite = std::min(s, 1e7f);
    if (finite >= 1.0f) {
        const float peak = (finite + 2.0f) * (finite + 4.0f) / (25.0f * finite);
        const float off = 0.175f / finite + 4e-7f * std::sqrt(finite);
        RC_ASSERT(std::abs(power - gaussian) <= peak * off);
    }
}

} // namespace lodestar::testing
