// SPDX-License-Identifier: MIT
//
// Counted warnings: what was repaired or ignored, and how often. Values, passed along and merged;
// nothing is printed here.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace lodestar::core {

/// Counts by rule, e.g. "texel not finite, set to 0": 2.
class Tally {
public:
    void add(std::string_view rule, std::uint64_t count = 1) {
        if (count > 0) {
            counts_[std::string(rule)] += count;
        }
    }
    void merge(const Tally& other) {
        for (const auto& [rule, count] : other.counts_) {
            counts_[rule] += count;
        }
    }
    [[nodiscard]] bool empty() const { return counts_.empty(); }
    [[nodiscard]] const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

private:
    std::map<std::string, std::uint64_t> counts_;
};

} // namespace lodestar::core
