// SPDX-License-Identifier: MIT
#include "io/gltf_problems.h"

#include <vector>

namespace lodestar::io {
namespace {

constexpr std::size_t kMaxText = 300;

std::string shortened(std::string text) {
    if (text.size() > kMaxText) {
        text.resize(kMaxText);
        text += "...";
    }
    return text;
}

} // namespace

void GltfProblems::refuse(std::string what, std::string where) {
    // The first two steps of the pointer name the element.
    const std::size_t second = where.find('/', 1);
    const std::size_t third = second == std::string::npos ? second : where.find('/', second + 1);
    tainted_.insert(where.substr(0, third));
    what = shortened(std::move(what));
    where = shortened(std::move(where));
    if (refusedCount_++ == 0) {
        first_ = core::refused(what, where);
    }
    if (repairedAt_.erase(where) > 0) {
        std::erase_if(list_, [&](const GltfProblem& problem) {
            return problem.repaired && problem.where == where;
        });
    }
    add({std::move(where), std::move(what), false});
}

void GltfProblems::repaired(std::string what, std::string where) {
    add({std::move(where), std::move(what), true});
}

void GltfProblems::add(GltfProblem problem) {
    if (list_.size() >= kMax) {
        ++leftOut_;
        return;
    }
    problem.where = shortened(std::move(problem.where));
    problem.what = shortened(std::move(problem.what));
    if (problem.repaired) {
        repairedAt_.insert(problem.where);
    }
    list_.push_back(std::move(problem));
}

core::Error GltfProblems::first() const {
    LODESTAR_EXPECT(refused(), "there is no refusal");
    return first_;
}

} // namespace lodestar::io
