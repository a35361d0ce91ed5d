// SPDX-License-Identifier: MIT
//
// A number that tells states apart: what plan::LightState says of a sky.
#pragma once

#include <bit>
#include <cstdint>

namespace lodestar::plan {

/// Folds values into 64 bits, after Fowler, Noll and Vo.
class StateHash {
public:
    void fold(std::uint64_t value) {
        state_ = (state_ ^ value) * 1099511628211ull;
        state_ ^= state_ >> 29;
    }
    void fold(double value) { fold(std::bit_cast<std::uint64_t>(value)); }
    [[nodiscard]] std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 14695981039346656037ull;
};

} // namespace lodestar::plan
