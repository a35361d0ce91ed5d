// SPDX-License-Identifier: MIT
//
// The ladder: what an estimator's answers are wrong by, as relative RMSE over the sphere and RGB
// against sums over all texels, on a fixed set of environments and exponents; the published and the
// best known figures reproduced. The error is that of the method: the same definition, environments
// and directions gave the figures quoted here.
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/lookup.h"
#include "lighting/mips.h"
#include "lighting/prefiltered.h"
#include "numerics/ladder_truth.h"

namespace lodestar::testing {

namespace {

using lighting::Estimator;
using lighting::EstimatorKind;

/// Relative RMSE by environment and exponent.
class Ladder {
public:
    Ladder(std::vector<NamedCube> environments, int lastExponent)
        : directions_(ladderDirections()), means_(lobeMeans(environments, directions_)) {
        for (const int s : ladderExponents()) {
            if (s <= lastExponent) {
                exponents_.push_back(s);
            }
        }
        for (NamedCube& environment : environments) {
            names_.push_back(environment.name);
            prepared_.push_back(
                lighting::prepare(std::move(environment.base), {true, true, false, false, true}));
        }
    }

    /// Makes prefiltered mips anew.
    void prefilter(const lighting::PrefilterRun& run) {
        for (lighting::PreparedEnvironment& environment : prepared_) {
            environment.prefilteredMips = lighting::prefilteredMips(environment.base, run);
        }
    }

    [[nodiscard]] double error(const Estimator& estimator, std::size_t environment,
                               std::size_t exponent) const {
        double difference = 0.0;
        double norm = 0.0;
        for (std::size_t d = 0; d < directions_.size(); ++d) {
            const glm::dvec3 truth =
                means_[(d * ladderExponents().size() + exponent) * names_.size() + environment];
            const auto answer =
                lighting::lookup(prepared_[environment],
                                 {lighting::Lobe::Phong, static_cast<double>(exponents_[exponent]),
                                  directions_[d].direction, estimator});
            const glm::dvec3 off = answer.radiance - truth;
            difference += directions_[d].weight * glm::dot(off, off);
            norm += directions_[d].weight * glm::dot(truth, truth);
        }
        return std::sqrt(difference / norm);
    }

    /// Prints the table and returns the RMS over all of it; by exponent too, where asked for.
    double report(const Estimator& estimator, std::vector<double>* rmsByExponent = nullptr) const {
        std::printf("%-10s", lighting::estimatorName(estimator).c_str());
        for (const int s : exponents_) {
            std::printf(" %5d", s);
        }
        std::printf("\n");
        double sum = 0.0;
        std::vector<double> byExponent(exponents_.size());
        for (std::size_t k = 0; k < names_.size(); ++k) {
            std::printf("%-10s", names_[k].c_str());
            for (std::size_t e = 0; e < exponents_.size(); ++e) {
                const double value = error(estimator, k, e);
                byExponent[e] += value * value;
                sum += value * value;
                std::printf(" %.3f", value);
            }
            std::printf("\n");
        }
        const double rms = std::sqrt(sum / static_cast<double>(names_.size() * exponents_.size()));
        std::printf("%-10s", "RMS");
        for (double& square : byExponent) {
            square = std::sqrt(square / static_cast<double>(names_.size()));
            std::printf(" %.3f", square);
        }
        if (rmsByExponent != nullptr) {
            *rmsByExponent = byExponent;
        }
        std::printf("   overall %.4f\n\n", rms);
        return rms;
    }

private:
    std::vector<WeightedDirection> directions_;
    std::vector<glm::dvec3> means_;
    std::vector<int> exponents_;
    std::vector<std::string> names_;
    std::vector<lighting::PreparedEnvironment> prepared_;
};

/// What several taps are held to: the best known figure for each and a tenth more, our own and a
/// tenth more, and each family better with every step.
struct Rung {
    Estimator estimator;
    double known;
    double own;
};

void expectRungs(const Ladder& ladder, double tent, const std::vector<Rung>& rungs) {
    EstimatorKind family = EstimatorKind::Tent; // a ring of one
    double last = tent;
    for (const Rung& rung : rungs) {
        const double rms = ladder.report(rung.estimator);
        const std::string name = lighting::estimatorName(rung.estimator);
        EXPECT_LE(rms, 1.1 * rung.known) << name;
        EXPECT_LE(rms, 1.1 * rung.own) << name;
        if (rung.estimator.kind != EstimatorKind::Taps || family == EstimatorKind::Taps) {
            EXPECT_LT(rms, last) << name;
        }
        family = rung.estimator.kind;
        last = rms;
    }
}

/// A figure and a tenth more, and better than one fetch from tents.
double expectWithin(const Ladder& ladder, const Estimator& estimator, double figure, double tent) {
    const double rms = ladder.report(estimator);
    EXPECT_LE(rms, 1.1 * figure) << lighting::estimatorName(estimator);
    EXPECT_LT(rms, tent) << lighting::estimatorName(estimator);
    return rms;
}

// One fetch from levels that are means over lobes: .064 and .098 are the best known, our own are
// .064 and .102. Sums over the map's own texels are no better, to a hundredth.
void expectPrefiltered(Ladder& ladder, double tent, double known) {
    const double rms = expectWithin(ladder, {EstimatorKind::Prefiltered}, known, tent);
    ladder.prefilter({.leastSourceWidth = 4096});
    EXPECT_LE(rms, 1.01 * ladder.report({EstimatorKind::Prefiltered}));
}

} // namespace

TEST(Ladder, FirstSet) {
    if (!std::filesystem::exists(panoramaPath("sunset"))) {
        GTEST_SKIP() << "needs the panoramas of blender-data, which this machine lacks";
    }
    auto environments = analyticSet(256);
    for (NamedCube& cube : panoramaSet({"sunset", "interior", "courtyard", "forest"}, 256)) {
        environments.push_back(std::move(cube));
    }
    Ladder ladder(std::move(environments), 4096);
    std::vector<double> byExponent;
    const double mip = ladder.report({EstimatorKind::Mip}, &byExponent);
    const double tent = ladder.report({EstimatorKind::Tent});
    EXPECT_NEAR(mip, 0.341, 0.1 * 0.341);
    // The published row, s = 0 to 512. Beyond, the figures of sunset and forest hang on whether one
    // of some 2000 directions meets a sun half a degree wide, and differ between sets of
    // directions.
    const std::vector<double> published{.47, .38, .39, .35, .38, .35, .34, .32, .32, .31, .28};
    for (std::size_t e = 0; e < published.size(); ++e) {
        EXPECT_NEAR(byExponent[e], published[e], 0.1 * published[e]) << ladderExponents()[e];
    }
    // .123 is the best known for tents alone and must be met within 10 %; .109 is our own figure.
    EXPECT_LE(tent, 1.1 * 0.123);
    EXPECT_LE(tent, 1.1 * 0.109);
    EXPECT_LE(tent, 0.5 * mip);
    expectPrefiltered(ladder, tent, .064);
    expectWithin(ladder, {EstimatorKind::Taps, 0.0f, 2}, .094, tent);
    // Our own figures are those that the constants of taps.glsl were fitted to.
    expectRungs(ladder, tent,
                {{{EstimatorKind::Ring3}, .085, .077},
                 {{EstimatorKind::Ring7}, .067, .061},
                 {{EstimatorKind::Taps, 0.0f, 4}, .195, .114},
                 {{EstimatorKind::Taps, 0.0f, 16}, .079, .069},
                 {{EstimatorKind::Taps, 0.0f, 64}, .042, .038}});
}

TEST(Ladder, SecondSet) {
    if (!std::filesystem::exists(panoramaPath("city"))) {
        GTEST_SKIP() << "needs the panoramas of blender-data, which this machine lacks";
    }
    // The published set names a disc of 2 degrees, not where it stands. It stands here at the one
    // other axis that the environments name, the gradient's, neither at a corner nor at a centre.
    // The box mips' error depends on the place (0.72 at the corner, 0.35 to 0.43 at general ones);
    // the panoramas alone, 0.469, are near the figure of the whole set.
    auto environments = panoramaSet({"city", "night", "studio", "sunrise"}, 128);
    environments.push_back({"disc2", lampCube(glm::dvec3(0.36, 0.48, 0.8), 2.0, 128)});
    Ladder ladder(std::move(environments), 1024);
    const double mip = ladder.report({EstimatorKind::Mip});
    const double tent = ladder.report({EstimatorKind::Tent});
    EXPECT_NEAR(mip, 0.466, 0.1 * 0.466);
    EXPECT_LE(tent, 1.1 * 0.20); // the best known for tents alone, and our own figure
    EXPECT_LE(tent, 1.1 * 0.179);
    EXPECT_LE(tent, 0.5 * mip);
    expectPrefiltered(ladder, tent, .098);
    expectWithin(ladder, {EstimatorKind::Taps, 0.0f, 2}, .150, tent);
    // Nothing was fitted on this set.
    expectRungs(ladder, tent,
                {{{EstimatorKind::Ring3}, .146, .112},
                 {{EstimatorKind::Ring7}, .102, .089},
                 {{EstimatorKind::Taps, 0.0f, 4}, .297, .165},
                 {{EstimatorKind::Taps, 0.0f, 16}, .122, .108},
                 {{EstimatorKind::Taps, 0.0f, 64}, .062, .065}});
}

} // namespace lodestar::testing
