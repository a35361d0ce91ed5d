// SPDX-License-Identifier: MIT
//
// Boxes of probes in a tree of halves, and the choice among those that a draw touches.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "plan/probe_plan.h"

namespace lodestar::plan {
namespace {

struct Branch {
    glm::vec3 low{0.0f}, high{0.0f};
    int first = 0; ///< of the order, of a leaf; else the first child, the second behind it
    int count = 0; ///< of a leaf; 0: it has children
};

constexpr int kLeaf = 4;

bool overlap(const glm::vec3& aLow, const glm::vec3& aHigh, const glm::vec3& bLow,
             const glm::vec3& bHigh) {
    return glm::all(glm::lessThanEqual(aLow, bHigh)) && glm::all(glm::lessThanEqual(bLow, aHigh));
}

/// A probe that touches a draw.
struct Candidate {
    int probe = 0;
    double mean = 0.0;  ///< weight over the draw's box
    double shown = 0.0; ///< what of it those in front of it leave
    bool dark = false;
};

double rest(double share) {
    return 1.0 - share;
}

} // namespace

struct ProbeIndex::State {
    std::span<const ProbeView> probes;
    std::vector<int> rank;  ///< in the order of who stands in front, by probe
    std::vector<int> order; ///< probes as the leaves hold them
    std::vector<Branch> branches;

    void build(std::size_t branch, int first, int count);
    void touching(const glm::vec3& low, const glm::vec3& high, std::vector<int>& out) const;
    [[nodiscard]] const lighting::PlacedVolume& volume(int probe) const {
        return *probes[static_cast<std::size_t>(probe)].influence;
    }
};

void ProbeIndex::State::build(std::size_t branch, int first, int count) {
    const auto begin = order.begin() + first;
    glm::vec3 low = volume(*begin).low, high = volume(*begin).high;
    for (auto it = begin; it != begin + count; ++it) {
        low = glm::min(low, volume(*it).low);
        high = glm::max(high, volume(*it).high);
    }
    branches[branch] = {low, high, first, count};
    if (count <= kLeaf) {
        return;
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int half = count / 2;
    std::nth_element(begin, begin + half, begin + count, [&](int a, int b) {
        return volume(a).low[axis] + volume(a).high[axis] <
               volume(b).low[axis] + volume(b).high[axis];
    });
    const std::size_t children = branches.size();
    branches.resize(children + 2);
    branches[branch].first = static_cast<int>(children);
    branches[branch].count = 0;
    build(children, first, half);
    build(children + 1, first + half, count - half);
}

void ProbeIndex::State::touching(const glm::vec3& low, const glm::vec3& high,
                                 std::vector<int>& out) const {
    std::array<std::size_t, 64> left{}; // a tree of halves is as deep as a count has bits
    std::size_t depth = branches.empty() ? 0 : 1;
    while (depth > 0) {
        const Branch& branch = branches[left[--depth]];
        if (!overlap(branch.low, branch.high, low, high)) {
            continue;
        }
        if (branch.count == 0) {
            left[depth++] = static_cast<std::size_t>(branch.first);
            left[depth++] = static_cast<std::size_t>(branch.first) + 1;
            continue;
        }
        for (int i = branch.first; i < branch.first + branch.count; ++i) {
            const int probe = order[static_cast<std::size_t>(i)];
            if (overlap(volume(probe).low, volume(probe).high, low, high)) {
                out.push_back(probe);
            }
        }
    }
}

ProbeIndex::ProbeIndex(std::span<const ProbeView> probes) : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.probes = probes;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        if (probes[i].influence) {
            state.order.push_back(static_cast<int>(i));
        }
    }
    std::vector<int> front = state.order;
    std::sort(front.begin(), front.end(), [&](int a, int b) {
        const auto key = [&](int probe) {
            return std::tuple(-probes[static_cast<std::size_t>(probe)].priority,
                              state.volume(probe).measure, probe);
        };
        return key(a) < key(b);
    });
    state.rank.resize(probes.size());
    for (std::size_t i = 0; i < front.size(); ++i) {
        state.rank[static_cast<std::size_t>(front[i])] = static_cast<int>(i);
    }
    if (!state.order.empty()) {
        state.branches.resize(1);
        state.build(0, 0, static_cast<int>(state.order.size()));
    }
}

ProbeIndex::~ProbeIndex() = default;

void ProbeIndex::touching(const glm::vec3& low, const glm::vec3& high,
                          std::vector<int>& out) const {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    state_->touching(low, high, out);
    std::sort(out.begin() + first, out.end(), [&](int a, int b) {
        return state_->rank[static_cast<std::size_t>(a)] <
               state_->rank[static_cast<std::size_t>(b)];
    });
}

ProbeChoice ProbeIndex::choose(const glm::vec3& low, const glm::vec3& high,
                               const std::vector<bool>& lit, int except) const {
    std::vector<int> touched;
    touching(low, high, touched);
    std::vector<Candidate> lights;
    double left = 1.0;    // of the draw, for those behind
    double outside = 1.0; // of it, to all interiors
    for (const int probe : touched) {
        const ProbeView& view = state_->probes[static_cast<std::size_t>(probe)];
        const double mean = static_cast<double>(lighting::meanWeight(*view.influence, low, high));
        outside *= view.interior ? rest(mean) : 1.0;
        const bool dark = !lit[static_cast<std::size_t>(probe)] || probe == except;
        if ((!dark || view.interior) && mean > 0.0) {
            lights.push_back({probe, mean, left * mean, dark});
            left *= rest(mean);
        }
    }
    ProbeChoice choice;
    std::vector<std::size_t> strongest(lights.size());
    std::iota(strongest.begin(), strongest.end(), std::size_t{0});
    std::stable_sort(strongest.begin(), strongest.end(), [&](std::size_t a, std::size_t b) {
        return lights[a].shown > lights[b].shown;
    });
    const double third = lights.size() > 2 ? lights[strongest[2]].shown : 0.0;
    if (strongest.size() > 1 && strongest[0] > strongest[1]) {
        std::swap(strongest[0], strongest[1]); // the one in front comes first
    }
    const std::size_t chosen = std::min(lights.size(), std::size_t{2});
    double unrepresented = 1.0; // of the interiors, by those chosen
    for (std::size_t k = 0; k < chosen; ++k) {
        const Candidate& light = lights[strongest[k]];
        choice.probe[k] = light.probe;
        choice.dark[k] = light.dark;
        choice.factor[k] =
            light.shown > 0.0 ? static_cast<float>((light.shown - third) / light.shown) : 0.0f;
    }
    if (chosen == 2 && choice.factor[0] == 0.0f && choice.factor[1] == 0.0f) {
        // Three that show equally: no continuous rule maps a triangle's inside to its edges (there
        // is no retraction), so here, and nowhere else, the choice may jump.
        choice.factor = {1.0f, 1.0f};
    }
    for (std::size_t k = 0; k < chosen; ++k) {
        const Candidate& light = lights[strongest[k]];
        if (state_->probes[static_cast<std::size_t>(light.probe)].interior) {
            unrepresented *= rest(static_cast<double>(choice.factor[k]) * light.mean);
        }
    }
    // What interiors hold and none of those chosen shows is kept from the sky.
    const double inside = rest(outside);
    const double represented = rest(unrepresented);
    choice.open = static_cast<float>(rest(std::clamp(inside - represented, 0.0, 1.0)));
    return choice;
}

} // namespace lodestar::plan
