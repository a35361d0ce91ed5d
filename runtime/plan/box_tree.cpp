// SPDX-License-Identifier: MIT
#include "plan/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <glm/common.hpp>

namespace lodestar::plan {

namespace {

constexpr std::size_t kLeaf = 4;

} // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (!boxes_.empty()) {
        branches_.reserve(boxes_.size());
        branches_.resize(1);
        build(0, 0, boxes_.size());
    }
}

void BoxTree::build(std::size_t branch, std::size_t first, std::size_t count) {
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    Box about = boxes_[*begin];
    for (auto it = begin; it != end; ++it) {
        about.low = glm::min(about.low, boxes_[*it].low);
        about.high = glm::max(about.high, boxes_[*it].high);
    }
    branches_[branch] = {about, first, count};
    if (count <= kLeaf) {
        return;
    }
    const glm::vec3 size = about.high - about.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = count / 2;
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half), end,
                     [&](std::size_t a, std::size_t b) {
                         return boxes_[a].low[axis] + boxes_[a].high[axis] <
                                boxes_[b].low[axis] + boxes_[b].high[axis];
                     });
    const std::size_t children = branches_.size();
    branches_.resize(children + 2);
    branches_[branch].first = children;
    branches_[branch].count = 0;
    build(children, first, half);
    build(children + 1, first + half, count - half);
}

} // namespace lodestar::plan
