// SPDX-License-Identifier: MIT
//
// What is wrong with a glTF file, as a list: checks add to it and go on where going on is safe.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/result.h"

namespace lodestar::io {

/// One breach of the standard, or one thing that the file needs and is not read.
struct GltfProblem {
    std::string where;     ///< JSON pointer or "byte N"; empty for the whole file
    std::string what;      ///< a sentence, no full stop
    bool repaired = false; ///< the file is loaded nevertheless
};

/// Problems in the order found. Bounded: what goes beyond kMax is counted only.
class GltfProblems {
public:
    static constexpr std::size_t kMax = 1000;

    /// A problem that no picture can be made with. Replaces what was said as repaired of the very
    /// same place.
    void refuse(std::string what, std::string where);
    void refuse(const core::Error& error) { refuse(error.what, error.where); }
    /// A breach of the standard that is mended or does not matter to the picture.
    void repaired(std::string what, std::string where);

    [[nodiscard]] bool refused() const { return refusedCount_ > 0; }
    [[nodiscard]] std::size_t refusedCount() const { return refusedCount_; }
    [[nodiscard]] const std::vector<GltfProblem>& list() const { return list_; }
    [[nodiscard]] std::size_t leftOut() const { return leftOut_; }
    /// The first refusal. @pre refused()
    [[nodiscard]] core::Error first() const;

    /// Whether nothing below the pointer, and not itself, was refused or tainted. Known for
    /// pointers of one or two steps: "/nodes", "/nodes/3".
    [[nodiscard]] bool clean(const std::string& element) const {
        return tainted_.count(element) == 0;
    }
    /// Says that an element depends on a refused one.
    void taint(const std::string& element) { tainted_.insert(element); }

private:
    void add(GltfProblem problem);

    std::vector<GltfProblem> list_;
    std::set<std::string> repairedAt_; ///< places of the list's repaired problems
    std::set<std::string> tainted_;
    core::Error first_;
    std::size_t refusedCount_ = 0;
    std::size_t leftOut_ = 0;
};

} // namespace lodestar::io
