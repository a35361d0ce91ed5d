// SPDX-License-Identifier: MIT
//
// Whether one sky is another of which only the intensity or tint has changed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace lodestar::plan {

/// What stands behind captured geometry, as far as it may change by a factor.
struct SkyRadiance {
    /// Of all that may not: directions, the distant environment, which suns are up.
    std::uint64_t rest = 0;
    std::vector<glm::vec3> samples; ///< radiance, >= 0, of all skies in one order
    bool fixed = false; ///< something that is no sample shines too: only the factor 1 is one
    bool operator==(const SkyRadiance&) const = default;
};

/// A factor beyond it composes. Half floats of less than 2^-14 are stored within 2^-24, by a driver
/// that cuts off, and the factor multiplies that: 2^-20, half a step at 2^-9. So light is as exact
/// as composed anew down to 24 octaves below 2^15, the most that all of a day's skies are stored
/// as.
inline constexpr float kGreatestFactor = 16.0f;

/// The factor of each channel that makes `now` of `then`: 1 where both are black. Nothing where
/// there is none, one beyond kGreatestFactor, or light where there was none. Samples are told apart
/// by more than the rounding of how they were made: a tint's product and a blend of two keys take
/// five roundings, 2^-24 each, four samples are compared, so 20 in 32.
[[nodiscard]] std::optional<glm::vec3> skyFactor(const SkyRadiance& then, const SkyRadiance& now);

} // namespace lodestar::plan
