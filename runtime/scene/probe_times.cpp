// SPDX-License-Identifier: MIT
#include "scene/probe_times.h"

#include <algorithm>
#include <utility>

namespace lodestar::scene {
namespace {

/// Stretches whose results have not come, at most: two frames of all that a budget lets through.
constexpr std::size_t kWaiting = 64;
/// A median of three is not moved by one stretch that something else held up.
constexpr std::size_t kKept = 3;

double medianOf(std::vector<double> values) {
    if (values.empty()) {
        return 0.0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

void ProbeTimes::begin(std::size_t probe, int part) {
    measuring_ = !free_.empty() || waiting_.size() < kWaiting;
    if (!measuring_) {
        return;
    }
    if (free_.empty()) {
        free_.emplace_back(*device_);
    }
    waiting_.splice(waiting_.end(), free_, free_.begin());
    waiting_.back().part = part;
    waiting_.back().probe = probe;
    waiting_.back().timer.begin();
}

void ProbeTimes::end() {
    if (std::exchange(measuring_, false)) {
        waiting_.back().timer.end();
    }
}

void ProbeTimes::collect() {
    while (!waiting_.empty() && waiting_.front().timer.isReady()) {
        const Stretch& stretch = waiting_.front();
        std::vector<double>& kept =
            taken_[stretch.probe].ms[static_cast<std::size_t>(stretch.part)];
        kept.push_back(stretch.timer.milliseconds());
        if (kept.size() > kKept) {
            kept.erase(kept.begin());
        }
        free_.splice(free_.end(), waiting_, waiting_.begin());
    }
}

void ProbeTimes::describe(std::span<plan::ProbeView> probes) {
    collect();
    for (std::size_t i = 0; i < probes.size(); ++i) {
        std::array<double, 6>& faces = probes[i].faceMs;
        std::transform(taken_[i].ms.begin(), taken_[i].ms.begin() + kLight, faces.begin(),
                       medianOf);
        std::replace(faces.begin(), faces.end(), 0.0,
                     *std::max_element(faces.begin(), faces.end()));
        probes[i].lightMs = medianOf(taken_[i].ms[kLight]);
    }
}

} // namespace lodestar::scene
