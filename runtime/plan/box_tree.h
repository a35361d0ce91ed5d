// SPDX-License-Identifier: MIT
//
// Boxes in a tree of halves, so that those that something touches are found without asking all.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace lodestar::plan {

class BoxTree {
public:
    struct Box {
        glm::vec3 low{0.0f}, high{0.0f};
    };

    BoxTree() = default;
    explicit BoxTree(std::vector<Box> boxes);

    /// Visits boxes. @param enters of a box about several, or one: whether to look inside
    /// @param found called with the index of one that was entered
    template <class Enters, class Found>
    void visit(const Enters& enters, const Found& found) const {
        std::array<std::size_t, 64> left{}; // a tree of halves is as deep as a count has bits
        std::size_t depth = branches_.empty() ? 0 : 1;
        while (depth > 0) {
            const Branch& branch = branches_[left[--depth]];
            if (!enters(branch.box)) {
                continue;
            }
            if (branch.count == 0) {
                left[depth++] = branch.first;
                left[depth++] = branch.first + 1;
                continue;
            }
            for (std::size_t i = branch.first; i < branch.first + branch.count; ++i) {
                if (enters(boxes_[order_[i]])) {
                    found(order_[i]);
                }
            }
        }
    }

private:
    struct Branch {
        Box box;
        std::size_t first = 0; ///< of the order, of a leaf; else the first child, the second behind
        std::size_t count = 0; ///< of a leaf; 0: it has children
    };
    void build(std::size_t branch, std::size_t first, std::size_t count);

    std::vector<Box> boxes_;
    std::vector<std::size_t> order_; ///< boxes as the leaves hold them
    std::vector<Branch> branches_;
};

} // namespace lodestar::plan
