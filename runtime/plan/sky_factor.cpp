// SPDX-License-Identifier: MIT
#include "plan/sky_factor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lodestar::plan {
namespace {

/// Relative difference of two products of samples that rounding may make.
constexpr double kRounding = 32.0 / 16777216.0;

std::optional<float> channelFactor(const SkyRadiance& then, const SkyRadiance& now, int channel) {
    const auto at = [channel](const SkyRadiance& sky, std::size_t i) {
        return static_cast<double>(sky.samples[i][channel]);
    };
    std::size_t brightest = 0;
    for (std::size_t i = 1; i < then.samples.size(); ++i) {
        brightest = at(then, i) > at(then, brightest) ? i : brightest;
    }
    const double before = then.samples.empty() ? 0.0 : at(then, brightest);
    const double after = then.samples.empty() ? 0.0 : at(now, brightest);
    for (std::size_t i = 0; i < then.samples.size(); ++i) {
        const double a = at(now, i) * before;
        const double b = at(then, i) * after;
        const bool appeared = !(before > 0.0) && at(now, i) != 0.0;
        if (appeared || !(std::abs(a - b) <= kRounding * std::max(a, b))) {
            return std::nullopt;
        }
    }
    const auto factor = static_cast<float>(before > 0.0 ? after / before : 1.0);
    const bool same = std::abs(after - before) <= kRounding * before;
    return factor > kGreatestFactor || (now.fixed && !same) ? std::nullopt
                                                            : std::optional<float>(factor);
}

} // namespace

std::optional<glm::vec3> skyFactor(const SkyRadiance& then, const SkyRadiance& now) {
    if (then.rest != now.rest || then.fixed != now.fixed ||
        then.samples.size() != now.samples.size()) {
        return std::nullopt;
    }
    glm::vec3 factor(1.0f);
    for (int c = 0; c < 3; ++c) {
        const std::optional<float> one = channelFactor(then, now, c);
        if (!one) {
            return std::nullopt;
        }
        factor[c] = *one;
    }
    return factor;
}

} // namespace lodestar::plan
