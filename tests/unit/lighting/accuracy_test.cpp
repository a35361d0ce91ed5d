// SPDX-License-Identifier: MIT
#include "lighting/accuracy.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/environment.h"
#include "lighting/lookup.h"

namespace lodestar::lighting {
namespace {

Cubemap lamp(double degrees) {
    return cubeFromAnalytic(DiscEnvironment{glm::dvec3(0.36, 0.48, 0.8),
                                            degrees * std::acos(-1.0) / 180.0, glm::dvec3(100.0),
                                            glm::dvec3(0.05)},
                            64);
}

// The lamp of 2 degrees covers 3e-4 of the sphere and holds nearly all of radiance^2: of 400 even
// directions a tenth of one meets it, of the others nearly all.
TEST(Accuracy, HalfOfTheDirectionsSeekWhatIsBright) {
    const Cubemap map = lamp(2.0);
    const std::vector<MeasuredDirection> directions = measuredDirections(map, 800);
    ASSERT_EQ(directions.size(), 800u);
    double sum = 0.0;
    int inside = 0;
    for (const MeasuredDirection& measured : directions) {
        EXPECT_NEAR(glm::length(measured.direction), 1.0, 1e-6);
        EXPECT_GT(measured.weight, 0.0);
        sum += measured.weight;
        inside += map.sampleLevel(glm::vec3(measured.direction), 0).x > 10.0f ? 1 : 0;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_GT(inside, 380);
}

// Importance sampling is unbiased: of a function that is 1 in the lamp and 0 outside the weighted
// mean is the lamp's share. 400 stratified draws of an area that 200 texels cover: a few per cent.
TEST(Accuracy, WeightsAreSharesOfTheSphere) {
    const Cubemap map = lamp(8.0);
    const std::vector<double> solidAngles = texelSolidAngles(64);
    double share = 0.0;
    for (std::size_t i = 0; i < map.level(0).size(); ++i) {
        share += map.level(0)[i].x > 50.0f ? solidAngles[i % solidAngles.size()] : 0.0;
    }
    share /= 4.0 * std::acos(-1.0);
    double mean = 0.0;
    for (const MeasuredDirection& measured : measuredDirections(map, 800)) {
        mean += map.sampleLevel(glm::vec3(measured.direction), 0).x > 50.0f ? measured.weight : 0.0;
    }
    EXPECT_NEAR(mean / share, 1.0, 0.05);
}

TEST(Accuracy, ADarkMapIsMeasuredEvenly) {
    const std::vector<MeasuredDirection> directions = measuredDirections(Cubemap(8), 100);
    EXPECT_EQ(directions.size(), 100u);
    for (const MeasuredDirection& measured : directions) {
        EXPECT_NEAR(measured.weight, 0.01, 1e-15);
    }
}

// Coarser means may add 1e-4 of a lobe's variance: of what the lobe sees of a lamp's edge, less
// than 1e-3 of the lamp. Sharp lobes are the reference's own.
TEST(Accuracy, LobeMeansAreTheReference) {
    const Cubemap map = lamp(8.0);
    const std::vector<glm::dvec3> directions = {glm::normalize(glm::dvec3(0.36, 0.48, 0.8)),
                                                glm::normalize(glm::dvec3(0.5, 0.5, 0.7)),
                                                {0.0, -1.0, 0.0}};
    const std::vector<double> exponents = {0.0, 1.0, 4.0, 64.0, 4096.0};
    const std::vector<glm::dvec3> means = lobeMeans(map, directions, exponents);
    for (std::size_t d = 0; d < directions.size(); ++d) {
        for (std::size_t e = 0; e < exponents.size(); ++e) {
            const double truth = referencePhong(map, directions[d], exponents[e]).x;
            EXPECT_NEAR(means[d * exponents.size() + e].x, truth, 1e-3 * truth + 1e-6)
                << d << ' ' << exponents[e];
        }
    }
}

TEST(Accuracy, IsRelativeToTheTruthsRootMeanSquare) {
    const std::vector<MeasuredDirection> directions = {{{0, 1, 0}, 0.75}, {{0, -1, 0}, 0.25}};
    const std::vector<glm::dvec3> truths = {glm::dvec3(2.0), glm::dvec3(2.0)};
    const std::vector<glm::dvec3> answers = {glm::dvec3(2.0), glm::dvec3(3.0)};
    const Accuracy accuracy = accuracyOf(directions, truths, answers);
    EXPECT_DOUBLE_EQ(accuracy.rmse, 0.25); // sqrt(.25 x 3 / 12)
    EXPECT_DOUBLE_EQ(accuracy.worst, 0.5); // sqrt(3 / 12)
    EXPECT_EQ(accuracyOf(directions, truths, truths).rmse, 0.0);
    const std::vector<glm::dvec3> dark(2);
    EXPECT_EQ(accuracyOf(directions, dark, dark).rmse, 0.0);
    EXPECT_TRUE(std::isinf(accuracyOf(directions, dark, answers).rmse));
}

} // namespace
} // namespace lodestar::lighting
