// SPDX-License-Identifier: MIT
//
// Measures what `lodestar cost` tells, for the worst of the selected materials under the light that
// shines now, beside the editor's frames: errors on a thread of its own, times in slices of a few
// milliseconds.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/cost_shading.h"
#include "lighting/day.h"
#include "ui/accuracy.h"

namespace lodestar::app {

class AccuracyMeter {
public:
    /// A material as it is worn.
    struct Worn {
        std::string material;
        double exponent = 0.0; ///< Blinn-Phong
        std::string used;      ///< its estimator or the lights' layout
        bool operator==(const Worn&) const = default;
    };
    /// What is measured.
    struct Subject {
        /// At least one. Of several the one whose own estimator errs most is measured by all.
        std::vector<Worn> materials;
        std::vector<std::string> estimators;                  ///< of environments
        std::shared_ptr<const lighting::Cubemap> environment; ///< null: skies and suns alone shine
        std::vector<lighting::DayLight> lights;
        double hour = 0.0;
        std::uint64_t light = 0;                     ///< another number for another light
        bool rows = false;                           ///< the maps' rows too
        lighting::RsrmLayout maps = lighting::kRsrm; ///< what the document has for `rsrm`
    };

    AccuracyMeter();
    ~AccuracyMeter();
    AccuracyMeter(const AccuracyMeter&) = delete;
    AccuracyMeter& operator=(const AccuracyMeter&) = delete;

    /// Measures another subject in place of the last; goes on where it is the same.
    void measure(Subject subject);
    void cancel();
    [[nodiscard]] bool busy() const;
    /// What is known so far. @return whether there was news
    bool poll(ui::AccuracyView& view);
    /// Times for a few milliseconds, where there is something to time. @errors as CostShading
    [[nodiscard]] core::Result<void> slice(gl::Device& device);

private:
    struct Work;    ///< a subject and what is known of it
    class Measurer; ///< what the thread keeps from one to the next
    void loop();
    [[nodiscard]] core::Result<void> prepareLine(gl::Device& device, std::size_t line);

    std::shared_ptr<lighting::RsrmKernels> kernels_ = std::make_shared<lighting::RsrmKernels>();
    std::mutex mutex_;
    std::condition_variable wakes_;
    bool ends_ = false;
    std::shared_ptr<Work> work_; ///< null: nothing is asked
    std::thread thread_;
    std::unique_ptr<CostShading> shading_;
    std::optional<std::size_t> timing_; ///< the line that is timed
    int rows_ = 0;                      ///< of its slices
    int enough_ = 0;                    ///< slices that took long enough to count
    double least_ = 0.0;
    std::shared_ptr<const lighting::Cubemap> prepared_; ///< the environment that is uploaded
};

} // namespace lodestar::app
