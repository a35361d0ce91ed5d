// SPDX-License-Identifier: MIT
//
// What light probes take of the GPU's time, as measured while they are drawn. Nothing waits for a
// measurement: it is read in the frame in which it is there.
#pragma once

#include <array>
#include <cstddef>
#include <list>
#include <span>
#include <vector>

#include "gl/timer.h"
#include "plan/probe_plan.h"

namespace lodestar::scene {

class ProbeTimes {
public:
    /// A face in OpenGL's order, or this: all that is made of them.
    static constexpr int kLight = 6;

    ProbeTimes(gl::Device& device, std::size_t probes) : device_(&device), taken_(probes) {}

    /// Of the stretch to `end`; stretches do not nest. Not measured where too many wait.
    void begin(std::size_t probe, int part);
    void end();
    /// Reads what has come, and fills in what each probe takes: the median of the last few. A face
    /// that has not been measured is taken for the dearest of its probe's.
    void describe(std::span<plan::ProbeView> probes);

private:
    struct Stretch {
        explicit Stretch(gl::Device& device) : timer(device) {}
        gl::Timer timer;
        std::size_t probe = 0;
        int part = 0;
    };
    struct Taken {
        std::array<std::vector<double>, kLight + 1> ms; ///< by part, the last few
    };

    void collect();

    gl::Device* device_;
    std::vector<Taken> taken_;
    std::list<Stretch> free_, waiting_;
    bool measuring_ = false;
};

} // namespace lodestar::scene
