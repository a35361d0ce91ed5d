// SPDX-License-Identifier: MIT
//
// The reference against closed forms, its passage to the bilinear lookup of a mirror, and one
// furnace for all estimators.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/lookup.h"
#include "lodestar/cube.glsl"
#include "numerics/blinn_lobe.h"
#include "numerics/ladder_environments.h"
#include "numerics/oracles.h"

namespace lodestar::testing {

namespace {

using glm::dvec3;
using lighting::Cubemap;
using lighting::EstimatorKind;
using lighting::Lobe;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::vector<dvec3> kDirections{
    {0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}, {-0.3, 0.8, 0.52}, {0.9, -0.41, 0.02}, {0.48, 0.6, 0.64}};

Cubemap constantCube(float radiance, int width) {
    Cubemap map(width);
    for (glm::vec4& texel : map.level(0)) {
        texel = glm::vec4(radiance, radiance, radiance, 1.0f);
    }
    return map;
}

/// a + b (d.axis) at texel centres, in all channels.
Cubemap linearCube(double a, double b, const dvec3& axis, int width) {
    return bakeCube([&](const dvec3& d) { return dvec3(a + b * glm::dot(d, axis)); }, width, 1);
}

} // namespace

TEST(Reference, ConstantMapIsExact) {
    // The weights are divided by their own sum: only the sums' rounding is left, 6 x 64 rows of 64
    // terms, at most 5e2 roundings of 1e-16.
    const Cubemap map = constantCube(0.7f, 64);
    const double expected = static_cast<double>(0.7f);
    for (const dvec3& d : kDirections) {
        for (const double s : {0.0, 0.3, 1.0, 17.0, 1e3, 8e3, 1.5e4, 1e5, 1e7, kInfinity}) {
            EXPECT_NEAR(lighting::referencePhong(map, d, s).g, expected, 1e-12);
            EXPECT_NEAR(lighting::referenceBlinnPhong(map, d, d, s).g, expected, 1e-12);
            const dvec3 view = glm::normalize(glm::normalize(d) + dvec3(0.7, 0.1, -0.5));
            EXPECT_NEAR(lighting::referenceBlinnPhong(map, d, view, s).g, expected, 1e-12);
        }
    }
}

TEST(Reference, AnyNumberOfThreadsGivesTheSameBits) {
    const Cubemap map = lampCube(kCornerAxis, 9.0, 100); // 600 rows: pieces of unequal length
    for (const dvec3& d : kDirections) {
        for (const double s : {0.0, 1.0, 40.0, 3000.0}) {
            const dvec3 phong = lighting::referencePhong(map, d, s);
            const dvec3 blinn = lighting::referenceBlinnPhong(map, d, {0.0, 0.6, 0.8}, s);
            for (const std::size_t threads : {0u, 2u, 3u, 7u, 64u}) {
                EXPECT_EQ(lighting::referencePhong(map, d, s, {threads}), phong) << threads;
                EXPECT_EQ(lighting::referenceBlinnPhong(map, d, {0.0, 0.6, 0.8}, s, {threads}),
                          blinn)
                    << threads;
            }
        }
    }
}

TEST(Reference, ProgressRisesToTheEnd) {
    const Cubemap map = constantCube(1.0f, 100);
    std::vector<double> told;
    static_cast<void>(lighting::referencePhong(map, {0.0, 0.0, 1.0}, 3.0,
                                               {1, [&](double share) { told.push_back(share); }}));
    ASSERT_GT(told.size(), 10u);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 1.0);
}

/// The point of a face of OpenGL's cube (its table 8.19), in double precision.
dvec3 faceDirection(int face, double u, double v) {
    const dvec3 points[] = {{1, -v, -u}, {-1, -v, u}, {u, 1, v},
                            {u, -1, -v}, {u, -v, 1},  {-u, -v, -1}};
    return points[face];
}

TEST(Reference, SkipsOnlyTexelsWithoutWeight) {
    // Columns are skipped row by row: the sum over all texels must come to the same. (Below s = 1 a
    // texel on the horizon weighs as the last bits of its cosine say.)
    const Cubemap map = lampCube(kCornerAxis, 40.0, 96);
    double brightest = 0.0;
    for (const glm::vec4& texel : map.level(0)) {
        brightest = std::max(brightest, static_cast<double>(texel.g));
    }
    const std::vector<double> solidAngles = lighting::texelSolidAngles(96);
    for (const dvec3& direction : kDirections) {
        const dvec3 d = glm::normalize(direction);
        for (const double s : {1.0, 2.0, 9.0, 30.0, 150.0, 800.0, 3000.0}) {
            double sum = 0.0;
            double weights = 0.0;
            for (std::size_t t = 0; t < map.level(0).size(); ++t) {
                const int inFace = static_cast<int>(t % solidAngles.size());
                const dvec3 texel = faceDirection(static_cast<int>(t / solidAngles.size()),
                                                  (2 * (inFace % 96) + 1 - 96) / 96.0,
                                                  (2 * (inFace / 96) + 1 - 96) / 96.0);
                const double x = glm::dot(glm::normalize(texel), d);
                const double weight =
                    x > 0.0 ? std::pow(x, s) * solidAngles[t % solidAngles.size()] : 0.0;
                sum += weight * static_cast<double>(map.level(0)[t].g);
                weights += weight;
            }
            // What is skipped is 1e-12 of the lobe, of the brightest radiance at most; rounding of
            // some 10^4 terms of one sign is far below.
            EXPECT_NEAR(lighting::referencePhong(map, d, s).g, sum / weights, 1e-12 * brightest)
                << s;
        }
    }
}

TEST(Reference, LinearGradient) {
    // a + b lambda_1 cos, lambda_1 = (s + 1) / (s + 2). Texel values at centres and a smooth lobe:
    // the midpoint rule's error, h^2 / 24 of a second difference, h = 2 / 256: 3e-6; the kink of
    // the clamped cosine at s = 1 is of that order too. Float texels add 3e-8.
    const dvec3 axis = glm::normalize(dvec3(0.36, 0.48, 0.8));
    const Cubemap map = linearCube(1.0, 0.8, axis, 256);
    for (const dvec3& d : kDirections) {
        const double cosine = glm::dot(glm::normalize(d), axis);
        for (const double s : {1.0, 2.0, 7.5, 64.0, 1024.0, 2e4}) {
            EXPECT_NEAR(lighting::referencePhong(map, d, s).r,
                        1.0 + 0.8 * (s + 1.0) / (s + 2.0) * cosine, 1e-5)
                << s;
        }
    }
}

TEST(Reference, LinearOracles) {
    const dvec3 axis = glm::normalize(dvec3(-0.2, 0.7, 0.4));
    const dvec3 side = glm::normalize(glm::cross(axis, dvec3(0.0, 0.0, 1.0)));
    for (const auto& one : oracleCases("linear_env")) {
        const double cosine = one["in"]["cos"];
        const double a = one["in"]["a"];
        const double b = one["in"]["b"];
        const Cubemap map = linearCube(a, b, axis, 128);
        const dvec3 d = axis * cosine + side * std::sqrt(1.0 - cosine * cosine);
        EXPECT_NEAR(lighting::referencePhong(map, d, one["in"]["s"]).r,
                    one["out"]["value"].get<double>(), 1e-3);
        // Lambert's lobe is s = 1: the irradiance cube, 16 texels a side, bilinear.
        const auto prepared = lighting::prepare(map, {false, false, false, true});
        const auto answer =
            lighting::lookup(prepared, {Lobe::Lambert, 0.0, d, {EstimatorKind::Irradiance, 0.0f}});
        EXPECT_NEAR(answer.radiance.r, a + b * 2.0 / 3.0 * cosine, 1e-3);
    }
}

TEST(Reference, DiscByQuadrature) {
    // A lamp of 5 degrees. Azimuth by azimuth about the lamp's axis the lobe's mean over the disc
    // is a smooth double integral, by Gauss and Legendre. Texel means of a lamp by 8x8 subsamples:
    // its edge is known to 1/8 texel, on average to 1e-3 of the edge's share; for s <= 1024 the
    // lobe spans 4 texels and more, and the means' own width, s h^2 / 12 <= 5e-3 of its variance,
    // moves the answer by at most 6e-4 (the steepest second derivative of the disc's blurred edge,
    // 0.24 of the radiance over the variance, times h^2 / 24).
    const dvec3 axis = kCornerAxis;
    const double radius = 5.0 * std::numbers::pi / 180.0;
    const Cubemap map = bakeCube(
        [&](const dvec3& d) { return dvec3(glm::dot(d, axis) > std::cos(radius) ? 1.0 : 0.0); },
        256, 8);
    const dvec3 side = glm::normalize(glm::cross(axis, dvec3(0.0, 1.0, 0.0)));
    const GaussLegendre nodes(48);
    const auto exact = [&](double s, double angle) {
        double sum = 0.0;
        for (std::size_t i = 0; i < nodes.nodes.size(); ++i) {
            const double z = 1.0 - (1.0 - std::cos(radius)) * nodes.nodes[i];
            for (std::size_t k = 0; k < nodes.nodes.size(); ++k) {
                const double azimuth = std::numbers::pi * nodes.nodes[k];
                const double x = z * std::cos(angle) +
                                 std::sqrt(1.0 - z * z) * std::sin(angle) * std::cos(azimuth);
                sum += nodes.weights[i] * nodes.weights[k] * (x > 0.0 ? std::pow(x, s) : 0.0);
            }
        }
        return (s + 1.0) * sum * (1.0 - std::cos(radius));
    };
    for (const double s : {1.0, 16.0, 256.0, 1024.0}) {
        for (const double angle : {0.0, 0.05, 0.0873, 0.2}) {
            const dvec3 d = axis * std::cos(angle) + side * std::sin(angle);
            EXPECT_NEAR(lighting::referencePhong(map, d, s).r, exact(s, angle), 1e-3)
                << s << " at " << angle;
        }
    }
}

TEST(Reference, MirrorReadsBilinearly) {
    Cubemap map(32);
    float value = 0.0f;
    for (glm::vec4& texel : map.level(0)) {
        value = std::fmod(value * 1.37f + 0.171f, 1.0f);
        texel = glm::vec4(value, 1.0f - value, value * value, 1.0f);
    }
    // Over faces, edges and corners the double lookup is the seamless one of the mip chain, which
    // filters in float: coordinates to 32 x 6e-8, so weights to 2e-6.
    for (int i = 0; i < 4000; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / 4000.0;
        const double r = std::sqrt(1.0 - z * z);
        const dvec3 d(r * std::cos(2.4 * i), r * std::sin(2.4 * i), z);
        const dvec3 mirror = lighting::referencePhong(map, d, kInfinity);
        const glm::vec4 lookup = map.sampleLevel(glm::vec3(d), 0);
        ASSERT_NEAR(mirror.r, lookup.r, 4e-6);
        ASSERT_NEAR(mirror.b, lookup.b, 4e-6);
    }
}

TEST(Reference, NarrowLobesGoOverSmoothly) {
    // A single bright texel seen a third of a texel off its centre. In steps of 2 % of s the answer
    // never jumps, and it ends at the bilinear lookup. The passage takes log 3 of s; over it the
    // answer moves by less than the texel's own value, so a smooth step moves it by at most
    // 1.5 x 0.02 / log 3 = 2.8 % a step, and the lobe's own narrowing by 2 %.
    Cubemap map(32);
    map.texel(0, 20, 14) = glm::vec4(1.0f);
    const double u = (2.0 * 20 + 1.0) / 32 - 1.0 + 0.02;
    const double v = (2.0 * 14 + 1.0) / 32 - 1.0 + 0.01;
    const dvec3 d = glm::normalize(dvec3(1.0, -v, -u));
    double before = lighting::referencePhong(map, d, 100.0).r;
    for (double s = 102.0; s < 1e5; s *= 1.02) {
        const double now = lighting::referencePhong(map, d, s).r;
        ASSERT_LE(std::abs(now - before), 0.05) << s;
        before = now;
    }
    EXPECT_NEAR(before, map.sampleLevel(glm::vec3(d), 0).r, 4e-6);
}

TEST(Reference, BlinnPhongByQuadrature) {
    // Against the quadrature over half vectors in another parametrisation, on a linear map, where
    // it is the lobe's first moment. The midpoint rule over texels as above; at the horizon the
    // lobe has a kink, h^2 of its slope: 1e-4.
    const dvec3 axis = glm::normalize(dvec3(-0.6, 0.3, 0.7));
    const Cubemap map = linearCube(1.0, 1.0, axis, 128);
    for (const double s : {0.0, 1.0, 12.0, 300.0}) {
        for (const double degrees : {0.0, 40.0, 75.0}) {
            const BlinnLobe lobe(s, degrees * std::numbers::pi / 180.0, 128, 192);
            EXPECT_NEAR(lighting::referenceBlinnPhong(map, dvec3(0.0, 0.0, 1.0), lobe.view(), s).r,
                        1.0 + glm::dot(lobe.meanDirection(), axis), 3e-4)
                << s << " at " << degrees;
        }
    }
}

TEST(Reference, BlinnPhongOfZeroIsLambert) {
    const Cubemap map = lampCube(kCornerAxis, 20.0, 32);
    for (const dvec3& d : kDirections) {
        const dvec3 view = glm::normalize(glm::normalize(d) + dvec3(0.5, -0.2, 0.4));
        const dvec3 blinn = lighting::referenceBlinnPhong(map, d, view, 0.0);
        const dvec3 lambert = lighting::referencePhong(map, d, 1.0);
        EXPECT_NEAR(glm::distance(blinn, lambert), 0.0, 1e-12 * glm::length(lambert));
    }
}

TEST(Furnace, EveryEstimatorLobeAndExponent) {
    // Radiance 1 everywhere gives 1: bilinear weights that sum to 1 in float to 2 roundings, over a
    // chain of 9 levels each kept to 6e-8, stay below 1e-6.
    const auto prepared =
        lighting::prepare(constantCube(1.0f, 256), {true, true, true, true, true});
    int answers = 0;
    for (const auto lobe : {Lobe::Phong, Lobe::BlinnPhong, Lobe::Lambert}) {
        const auto term = lobe == Lobe::Lambert ? lighting::Term::Diffuse : lighting::Term::Glossy;
        for (std::string name : lighting::estimatorNames(term)) {
            if (const auto at = name.find("LAMBDA"); at != std::string::npos) {
                name.replace(at, 6, "2.5");
            }
            if (name == "taps:N") {
                name = "taps:16";
            }
            if (name == "auto:ERROR") {
                continue; // it stands for others
            }
            const auto estimator = lighting::parseEstimator(name, term);
            ASSERT_TRUE(estimator) << name;
            EXPECT_EQ(lighting::estimatorName(*estimator), name);
            for (const double s : {0.0, 0.5, 1.0, 10.0, 1e3, 1e5, 1e6, kInfinity}) {
                for (const dvec3& d : kDirections) {
                    const auto answer = lighting::lookup(prepared, {lobe, s, d, *estimator});
                    EXPECT_NEAR(answer.radiance.r, 1.0, 1e-6) << name << " " << s;
                    EXPECT_NEAR(answer.radiance.b, 1.0, 1e-6) << name << " " << s;
                    EXPECT_LE(answer.level, 8.0);
                    ++answers;
                }
            }
        }
    }
    EXPECT_EQ(answers, (2 * 10 + 5) * 8 * 5); // estimators by lobe, exponents, directions
}

TEST(Lookup, CountsFetchesAndLevels) {
    const auto prepared = lighting::prepare(constantCube(1.0f, 64), {true, true, true, true, true});
    const dvec3 up(0.0, 1.0, 0.0);
    const auto of = [&](Lobe lobe, double s, EstimatorKind kind) {
        return lighting::lookup(prepared, {lobe, s, up, {kind, 1.25f}});
    };
    EXPECT_EQ(of(Lobe::Phong, 64.0, EstimatorKind::Mip).fetches, 1);
    // log2(64 sqrt 3) - log2(65) / 2; a float of 3.8 is good to 2e-7, its terms to 1e-6.
    EXPECT_NEAR(of(Lobe::Phong, 64.0, EstimatorKind::Mip).level,
                std::log2(64.0 * std::sqrt(3.0)) - 0.5 * std::log2(65.0), 2e-6);
    EXPECT_EQ(of(Lobe::Phong, 64.0, EstimatorKind::MipFloor).level,
              of(Lobe::Phong, 64.0, EstimatorKind::Mip).level);
    EXPECT_EQ(of(Lobe::Phong, 64.0, EstimatorKind::Bias).level, 1.25);
    EXPECT_EQ(of(Lobe::Lambert, 64.0, EstimatorKind::LowestMip).level, 6.0);
    EXPECT_LT(of(Lobe::Lambert, 64.0, EstimatorKind::Sh9).level, 0.0);
    EXPECT_EQ(of(Lobe::Lambert, 64.0, EstimatorKind::Sh9).fetches, 0);
    EXPECT_EQ(of(Lobe::Lambert, 64.0, EstimatorKind::Irradiance).fetches, 1);
    EXPECT_LT(of(Lobe::Lambert, 64.0, EstimatorKind::Irradiance).level, 0.0);
    EXPECT_EQ(of(Lobe::Phong, 64.0, EstimatorKind::Reference).fetches, 6 * 64 * 64);
    EXPECT_LT(of(Lobe::Phong, 64.0, EstimatorKind::Reference).level, 0.0);
    EXPECT_EQ(of(Lobe::Phong, 64.0, EstimatorKind::Ring3).fetches, 3);
    EXPECT_EQ(of(Lobe::Phong, 64.0, EstimatorKind::Ring7).fetches, 7);
    EXPECT_EQ(of(Lobe::Phong, 64.0, EstimatorKind::Prefiltered).fetches, 1);
    // Level 2 of 64 is made for 3 / 16 x 16^2 - 1 = 47.
    EXPECT_EQ(of(Lobe::Phong, 47.0, EstimatorKind::Prefiltered).level, 2.0);
    EXPECT_EQ(of(Lobe::Phong, 64.0, EstimatorKind::Taps).fetches, 16);
    EXPECT_LT(of(Lobe::Phong, 64.0, EstimatorKind::Taps).level, 0.0); // several
    // As published the exponent is used as given; `tent` converts it, to about a quarter.
    EXPECT_EQ(of(Lobe::BlinnPhong, 64.0, EstimatorKind::Mip).level,
              of(Lobe::Phong, 64.0, EstimatorKind::Mip).level);
    EXPECT_GT(of(Lobe::BlinnPhong, 64.0, EstimatorKind::Tent).level,
              of(Lobe::Phong, 64.0, EstimatorKind::Tent).level + 0.5);
}

} // namespace lodestar::testing
