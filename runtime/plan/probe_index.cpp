// SPDX-License-Identifier: MIT
//
// The choice among the probes that a draw touches.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "plan/box_tree.h"
#include "plan/probe_plan.h"

namespace lodestar::plan {
namespace {

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
    std::vector<int> rank; ///< in the order of who stands in front, by probe
    std::vector<int> held; ///< the probe of each box
    BoxTree tree;

    [[nodiscard]] const lighting::PlacedVolume& volume(int probe) const {
        return *probes[static_cast<std::size_t>(probe)].influence;
    }
};

ProbeIndex::ProbeIndex(std::span<const ProbeView> probes) : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.probes = probes;
    std::vector<BoxTree::Box> boxes;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        if (probes[i].influence) {
            state.held.push_back(static_cast<int>(i));
            boxes.push_back({probes[i].influence->low, probes[i].influence->high});
        }
    }
    state.tree = BoxTree(std::move(boxes));
    std::vector<int> front = state.held;
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
}

ProbeIndex::~ProbeIndex() = default;

void ProbeIndex::touching(const glm::vec3& low, const glm::vec3& high,
                          std::vector<int>& out) const {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    state_->tree.visit(
        [&](const BoxTree::Box& box) {
            return glm::all(glm::lessThanEqual(box.low, high)) &&
                   glm::all(glm::lessThanEqual(low, box.high));
        },
        [&](std::size_t box) { out.push_back(state_->held[box]); });
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
