// SPDX-License-Identifier: MIT
//
// `auto`: what it foresees against what comes true, on panoramas that took no part in choosing its
// margin or the constants of what it chooses from.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

#include "lighting/accuracy.h"
#include "lighting/error_forecast.h"
#include "lighting/lookup.h"
#include "lighting/mips.h"
#include "numerics/ladder_environments.h"

namespace lodestar::testing {
namespace {

using namespace lighting;

constexpr double kTolerances[] = {0.2, 0.1, 0.07, 0.05, 0.03};

struct Score {
    int chosen = 0,
        right = 0; ///< choices said to meet a tolerance, and their errors within 1.5 of it
    int possible = 0, cheap = 0; ///< pairs that some rung meets, and choices at most a rung dearer
};

/// The errors of the ladder's rungs at an exponent.
std::vector<double> errorsOf(const PreparedEnvironment& environment,
                             const std::vector<MeasuredDirection>& directions,
                             const std::vector<glm::dvec3>& truths, double exponent) {
    std::vector<double> errors;
    for (const Estimator& rung : autoLadder()) {
        std::vector<glm::dvec3> answers;
        for (const MeasuredDirection& measured : directions) {
            answers.push_back(
                lookup(environment, {Lobe::Phong, exponent, measured.direction, rung}).radiance);
        }
        errors.push_back(accuracyOf(directions, truths, answers).rmse);
    }
    return errors;
}

void count(const ErrorForecast& forecast, const std::vector<double>& errors, double exponent,
           Score& score) {
    for (const double tolerance : kTolerances) {
        const ErrorForecast::Choice choice = forecast.choose(tolerance, exponent, exponent);
        std::size_t chosen = 0;
        std::size_t cheapest = errors.size();
        for (std::size_t rung = errors.size(); rung-- > 0;) {
            chosen = autoLadder()[rung] == choice.estimator ? rung : chosen;
            cheapest = errors[rung] <= tolerance ? rung : cheapest;
        }
        if (choice.met) {
            ++score.chosen;
            score.right += errors[chosen] <= 1.5 * tolerance ? 1 : 0;
        }
        if (cheapest < errors.size()) {
            ++score.possible;
            score.cheap += chosen <= cheapest + 1 ? 1 : 0;
        }
    }
}

} // namespace

// Of the choices .95 are within 1.5 of the tolerance, and .80 of the pairs are served by the
// cheapest rung that meets it or the next; docs/estimators.md has both.
TEST(Auto, ForeseesPanoramasItWasNotTunedOn) {
    if (!std::filesystem::exists(panoramaPath("city"))) {
        GTEST_SKIP() << "needs the panoramas of blender-data, which this machine lacks";
    }
    constexpr int kWidth = 128;
    Score score;
    for (const NamedCube& map : panoramaSet({"city", "night", "studio", "sunrise"}, kWidth)) {
        const PreparedEnvironment environment = prepare(map.base, {false, true, false, false});
        const ErrorForecast forecast(environment.base, environment.tentMips);
        const std::vector<MeasuredDirection> directions = measuredDirections(map.base, 800);
        std::vector<glm::dvec3> axes;
        for (const MeasuredDirection& measured : directions) {
            axes.push_back(measured.direction);
        }
        std::vector<double> exponents;
        for (double s = 0.5; s + 1.0 <= 3.0 * kWidth * kWidth / 16.0; s = 1.7 * s + 0.3) {
            exponents.push_back(s);
        }
        const std::vector<glm::dvec3> all = lobeMeans(map.base, axes, exponents);
        for (std::size_t e = 0; e < exponents.size(); ++e) {
            std::vector<glm::dvec3> truths;
            for (std::size_t d = 0; d < axes.size(); ++d) {
                truths.push_back(all[d * exponents.size() + e]);
            }
            count(forecast, errorsOf(environment, directions, truths, exponents[e]), exponents[e],
                  score);
        }
    }
    std::printf("within 1.5 of the tolerance: %d of %d; at most one rung dearer: %d of %d\n",
                score.right, score.chosen, score.cheap, score.possible);
    EXPECT_GT(score.chosen, 150);
    EXPECT_GE(score.right, 0.95 * score.chosen);
    EXPECT_GE(score.cheap, 0.80 * score.possible);
}

TEST(Auto, IsContentWithOneFetchWhereNothingIsWrong) {
    Cubemap grey(32);
    std::fill(grey.level(0).begin(), grey.level(0).end(), glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
    const ErrorForecast forecast(grey, tentMips(grey));
    const ErrorForecast::Choice choice = forecast.choose(1e-3, 0.0, 1e7);
    EXPECT_TRUE(choice.met);
    EXPECT_EQ(choice.estimator.kind, EstimatorKind::Tent);
}

// A range of exponents is as wrong as its worst; where nothing is right enough the best is taken.
TEST(Auto, TakesTheWorstOfARangeAndTheBestThatThereIs) {
    const Cubemap lamp = lampCube(glm::dvec3(0.36, 0.48, 0.8), 4.0, 64);
    const ErrorForecast forecast(lamp, tentMips(lamp));
    for (std::size_t rung = 0; rung < autoLadder().size(); ++rung) {
        EXPECT_GT(forecast.error(rung, 64.0), 0.0);
    }
    const ErrorForecast::Choice none = forecast.choose(1e-9, 1.0, 2000.0);
    EXPECT_FALSE(none.met);
    double worst = 0.0;
    for (const double exponent : {1.0, 8.0, 64.0, 512.0, 2000.0}) {
        worst = std::max(worst, forecast.error(0, exponent));
    }
    const ErrorForecast::Choice wide = forecast.choose(10.0, 1.0, 2000.0); // the first rung
    EXPECT_GE(wide.error, worst);
    EXPECT_TRUE(wide.met);
}

} // namespace lodestar::testing
