// SPDX-License-Identifier: MIT
#include "lighting/error_forecast.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "core/contract.h"
#include "core/parallel.h"
#include "lighting/accuracy.h"
#include "lighting/lobe_sums.h"
#include "lighting/lookup.h"
#include "lighting/mips.h"

namespace lodestar::lighting {
namespace {

constexpr Estimator kLadder[] = {{EstimatorKind::Tent},
                                 {EstimatorKind::Ring3},
                                 {EstimatorKind::Ring7},
                                 {EstimatorKind::Taps, 0.0f, 32},
                                 {EstimatorKind::Taps, 0.0f, 64}};
constexpr int kDirections = 768;
/// What directions and exponents in between leave open.
constexpr double kMargin = 1.3;
/// Of a lobe's variance, that means of texels may add to it before it is taken off again.
constexpr double kAddedVariance = 6e-3;
constexpr int kNarrowestSource = 16;
/// Places are exponents s with log2(s + 1) = 1.5 k; the last is beyond what a texel resolves.
constexpr double kOctaves = 1.5;
constexpr int kPlaces = 12;

double exponentAt(int place) {
    return std::exp2(kOctaves * place) - 1.0;
}

/// Where an exponent lies among the places, [0, kPlaces - 1].
double placeOf(double exponent) {
    const double repaired = exponent >= 0.0 ? std::min(exponent, 1e7) : 0.0;
    return std::min(std::log2(repaired + 1.0) / kOctaves, kPlaces - 1.0);
}

/// Means over lobes, fast: over the coarsest means of texels that add the share above at most;
/// sharp lobes, which reach few texels, by the reference.
class Truths {
public:
    explicit Truths(const Cubemap& base) : base_(base), chain_(solidAngleMips(base)) {
        for (int level = 0; level < chain_.levelCount(); ++level) {
            if (level == 0 || chain_.width(level) >= kNarrowestSource) {
                sources_.push_back(lobeSource(chain_, level));
            }
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> at(const std::vector<MeasuredDirection>& directions,
                                             double exponent) const {
        const LobeSource* source = sourceFor(exponent);
        std::vector<glm::dvec3> truths;
        std::vector<float> scratch;
        for (const MeasuredDirection& measured : directions) {
            truths.push_back(
                source != nullptr
                    ? glm::dvec3(lobeMean(*source, measured.direction,
                                          narrowed(exponent, source->width, measured.direction),
                                          scratch))
                    : referencePhong(base_, measured.direction, exponent));
        }
        return truths;
    }

private:
    [[nodiscard]] const LobeSource* sourceFor(double exponent) const {
        const LobeSource* coarsest = nullptr;
        for (const LobeSource& source : sources_) {
            const double squared = static_cast<double>(source.width) * source.width;
            const bool resolves = exponent + 1.0 <= 3.0 / 16.0 * squared;
            const bool fine = exponent / (3.0 * squared) <= kAddedVariance;
            if (resolves && (fine || &source == sources_.data())) {
                coarsest = &source;
            }
        }
        return coarsest;
    }

    /// Spreads add (PRE-2): a twelfth of a texel's solid angle there, less what the map's own do.
    [[nodiscard]] double narrowed(double exponent, int width, const glm::dvec3& direction) const {
        const glm::dvec3 a = glm::abs(direction);
        const double density = std::pow(std::max({a.x, a.y, a.z}), 3.0);
        const auto area = [](int n) { return 4.0 / (static_cast<double>(n) * n); };
        const double added = density * (area(width) - area(base_.width())) / 12.0;
        return std::max(1.0 / (1.0 / (exponent + 2.0) - added) - 2.0, 0.0);
    }

    const Cubemap& base_;
    Cubemap chain_;
    std::vector<LobeSource> sources_; ///< the finest first
};

} // namespace

std::span<const Estimator> autoLadder() {
    return kLadder;
}

ErrorForecast::ErrorForecast(const Cubemap& base, const Cubemap& tentMips) {
    LODESTAR_EXPECT(!tentMips.empty(), "the map has mips");
    PreparedEnvironment environment;
    environment.tentMips = tentMips;
    const std::vector<MeasuredDirection> directions = measuredDirections(base, kDirections);
    const Truths means(base);
    const std::size_t rungs = std::size(kLadder);
    errors_.assign(rungs, std::vector<double>(kPlaces));
    core::inParallel(kPlaces, [&](std::size_t place) {
        const double exponent = exponentAt(static_cast<int>(place));
        const auto answers = [&](const Estimator& estimator) {
            std::vector<glm::dvec3> all;
            for (const MeasuredDirection& measured : directions) {
                all.push_back(
                    lookup(environment, {Lobe::Phong, exponent, measured.direction, estimator})
                        .radiance);
            }
            return all;
        };
        const std::vector<glm::dvec3> truths = means.at(directions, exponent);
        for (std::size_t rung = 0; rung < rungs; ++rung) {
            errors_[rung][place] =
                kMargin * accuracyOf(directions, truths, answers(kLadder[rung])).rmse;
        }
    });
}

double ErrorForecast::error(std::size_t rung, double exponent) const {
    const double place = placeOf(exponent);
    const auto low = static_cast<std::size_t>(place);
    const std::size_t high = std::min(low + 1, static_cast<std::size_t>(kPlaces - 1));
    const double t = place - static_cast<double>(low);
    return errors_[rung][low] * (1.0 - t) + errors_[rung][high] * t;
}

double ErrorForecast::worst(std::size_t rung, double bluntest, double sharpest) const {
    double most = std::max(error(rung, bluntest), error(rung, sharpest));
    const double from = placeOf(bluntest);
    const double to = placeOf(sharpest);
    for (int place = 0; place < kPlaces; ++place) {
        if (place > from && place < to) {
            most = std::max(most, errors_[rung][static_cast<std::size_t>(place)]);
        }
    }
    return most;
}

ErrorForecast::Choice ErrorForecast::choose(double tolerance, double bluntest,
                                            double sharpest) const {
    LODESTAR_EXPECT(!empty(), "the forecast has been made");
    Choice best{kLadder[0], worst(0, bluntest, sharpest), false};
    for (std::size_t rung = 0; rung < std::size(kLadder); ++rung) {
        const double error = worst(rung, bluntest, sharpest);
        if (error <= tolerance) {
            return {kLadder[rung], error, true};
        }
        if (error < best.error) {
            best = {kLadder[rung], error, false};
        }
    }
    return best;
}

} // namespace lodestar::lighting
