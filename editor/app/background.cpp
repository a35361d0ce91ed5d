// SPDX-License-Identifier: MIT
#include "app/background.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace lodestar::app {
namespace {

constexpr auto kNow = std::chrono::seconds(0);

/// An exception, of memory that is not there above all, is an error of the work alone.
core::Result<Background::Finish> guarded(const Background::Task& task,
                                         Background::Progress& progress) {
    try {
        return task(progress);
    } catch (const std::exception& error) {
        return core::Error{core::ErrorCode::Internal, error.what(), {}, {}};
    }
}

} // namespace

Background::~Background() {
    cancel();
}

void Background::start(std::vector<std::string> stages, Task task) {
    cancel();
    work_ = std::make_unique<Work>();
    work_->stages = std::move(stages);
    work_->result =
        std::async(std::launch::async, [task = std::move(task), progress = &work_->progress] {
            return guarded(task, *progress);
        });
}

void Background::cancel() {
    if (work_) {
        work_->progress.cancelled = true;
        cancelled_.push_back(std::move(work_));
    }
}

const std::string& Background::stage() const {
    return work_->stages[std::min(work_->seen, work_->stages.size() - 1)];
}

double Background::share() const {
    return static_cast<double>(work_->seen) / static_cast<double>(work_->stages.size());
}

core::Result<bool> Background::poll() {
    std::erase_if(cancelled_, [](const std::unique_ptr<Work>& work) {
        return work->result.wait_for(kNow) == std::future_status::ready;
    });
    if (!work_) {
        return false;
    }
    if (work_->result.wait_for(kNow) == std::future_status::ready) {
        const auto finish = std::exchange(work_, nullptr)->result.get();
        if (!finish) {
            return finish.error();
        }
        (*finish)();
        return true;
    }
    const std::size_t stage = work_->progress.stage;
    return std::exchange(work_->seen, stage) != stage;
}

} // namespace lodestar::app
