// SPDX-License-Identifier: MIT
#include "app/accuracy_meter.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "app/accuracy_truth.h"
#include "lighting/accuracy.h"
#include "lighting/day_lookup.h"
#include "lighting/error_forecast.h"
#include "lodestar/lobes.glsl"

namespace lodestar::app {
namespace {

/// Directions that errors are measured at: of an environment; of skies and suns, spread evenly and
/// for each light; at each row of the maps.
constexpr int kEnvironmentDirections = 192;
constexpr int kEven = 32, kAtLight = 24;
constexpr int kEvenOfRow = 4, kAtLightOfRow = 3;

/// A slice that takes so long, milliseconds, counts; so many of them are timed.
constexpr double kSliceMs = 2.0;
constexpr int kSlices = 3;
constexpr int kFirstRows = 4;

constexpr const char* kLayouts[] = {"rsrm", "rsrm-published", "rsrm-published-columns"};

/// How a line's maps are stored: the first has the document's own rows.
const lighting::RsrmLayout& layoutOf(const AccuracyMeter::Subject& subject, std::size_t line) {
    return line == 0 ? subject.maps : *lighting::rsrmLayoutNamed(kLayouts[line]);
}

/// Phong: of the lookups of a material that is seen from above.
double lookupExponent(double exponent) {
    return static_cast<double>(shader::lodestar_lookupExponent(static_cast<float>(exponent), 1.0f));
}

} // namespace

struct AccuracyMeter::Work {
    Subject subject;
    std::vector<Worn> asked; ///< of the frames' thread alone: its materials, as they are used now
    std::atomic<bool> cancelled{false};
    std::mutex mutex; ///< of what follows
    Worn worst;       ///< of the subject's; it stands once a line has an error
    std::shared_ptr<const lighting::PreparedEnvironment>
        made; ///< likewise; null: of no environment
    ui::AccuracyView view;
    bool news = true;
    bool measured = false; ///< the thread is done
    std::size_t steps = 1, done = 0;

    /// The material that is measured. @pre the mutex is held, or nobody else has the work yet
    void wear(const Worn& worn) {
        worst = worn;
        view.material = worn.material;
        view.exponent = lookupExponent(worn.exponent);
        for (ui::EstimateLine& line : view.lines) {
            line.used = line.name == worn.used;
        }
        news = true;
    }
};

/// On the thread.
class AccuracyMeter::Measurer {
public:
    explicit Measurer(std::shared_ptr<lighting::RsrmKernels> kernels)
        : kernels_(std::move(kernels)) {}

    void run(Work& work) {
        work.subject.environment ? ofEnvironment(work) : ofLights(work);
        const std::lock_guard lock(work.mutex);
        work.measured = true;
        work.news = true;
    }

private:
    /// One step more. @return false: it is cancelled
    static bool step(Work& work) {
        const std::lock_guard lock(work.mutex);
        ++work.done;
        work.view.progress = static_cast<double>(work.done) / static_cast<double>(work.steps);
        work.news = work.news || work.done % 16 == 0;
        return !work.cancelled;
    }
    static void setLine(Work& work, std::size_t line, const lighting::Accuracy& accuracy,
                        int fetches) {
        const std::lock_guard lock(work.mutex);
        ui::EstimateLine& shown = work.view.lines[line];
        shown.error = accuracy.rmse;
        shown.worst = accuracy.worst;
        shown.fetches = fetches;
        work.news = true;
    }

    [[nodiscard]] static double exponentOf(Work& work) {
        const std::lock_guard lock(work.mutex);
        return work.view.exponent;
    }
    /// How many steps more there are than of one material.
    [[nodiscard]] static std::size_t stepsOfChoice(const Work& work, std::size_t ofEach) {
        const std::size_t count = work.subject.materials.size();
        return count > 1 ? count * ofEach : 0;
    }
    /// Of several materials chooses the one that errs most.
    /// @param errorOf a material's, by what it uses; nothing: it is cancelled
    template <class ErrorOf>
    static void chooseWorst(Work& work, const ErrorOf& errorOf) {
        const std::vector<Worn>& materials = work.subject.materials;
        double most = -1.0;
        for (std::size_t i = 0; i < materials.size() && materials.size() > 1; ++i) {
            const std::optional<double> error =
                errorOf(materials[i], work.view.selected[i].exponent);
            if (!error) {
                return;
            }
            const std::lock_guard lock(work.mutex);
            work.view.selected[i].error = error;
            if (*error > most) {
                most = *error;
                work.wear(materials[i]);
            }
        }
    }

    /// @return nothing: it is cancelled
    std::optional<std::vector<glm::dvec3>> meansOf(Work& work, double exponent) {
        std::vector<glm::dvec3> means;
        for (const lighting::MeasuredDirection& measured : directions_) {
            means.push_back((*means_)(measured.direction, exponent));
            if (!step(work)) {
                return std::nullopt;
            }
        }
        return means;
    }
    /// What an estimator answers. @return nothing: it is cancelled
    std::optional<lighting::Accuracy> accuracyOf(Work& work, const ReadyLookup& ready,
                                                 double exponent,
                                                 const std::vector<glm::dvec3>& truth,
                                                 int& fetches) {
        std::vector<glm::dvec3> answers;
        for (const lighting::MeasuredDirection& measured : directions_) {
            const CostAnswer answer = ready.answer(measured.direction, exponent);
            answers.push_back(answer.radiance);
            fetches = answer.fetches;
            if (!step(work)) {
                return std::nullopt;
            }
        }
        return lighting::accuracyOf(directions_, truth, answers);
    }

    void ofEnvironment(Work& work) {
        if (environment_ != work.subject.environment) {
            environment_ = work.subject.environment;
            ready_.clear();
            means_.emplace(*environment_);
            directions_ = lighting::measuredDirections(*environment_, kEnvironmentDirections);
            lighting::PreparedParts parts;
            parts.tentMips = true;
            made_ = std::make_shared<lighting::PreparedEnvironment>(
                lighting::prepare(*environment_, parts));
            forecast_ = lighting::ErrorForecast(*environment_, made_->tentMips);
        }
        {
            const std::lock_guard lock(work.mutex);
            work.made = made_;
            work.steps = directions_.size() * (1 + work.view.lines.size()) +
                         stepsOfChoice(work, 2 * directions_.size());
        }
        int fetches = 0;
        chooseWorst(work, [&](const Worn& worn, double exponent) -> std::optional<double> {
            const auto truth = meansOf(work, exponent);
            const auto accuracy = truth ? accuracyOf(work, readyFor(chosenBy(worn.used, exponent)),
                                                     exponent, *truth, fetches)
                                        : std::nullopt;
            return accuracy ? std::optional(accuracy->rmse) : std::nullopt;
        });
        const double exponent = exponentOf(work);
        const auto truth = work.cancelled ? std::nullopt : meansOf(work, exponent);
        for (std::size_t line = 0; truth && line < work.view.lines.size(); ++line) {
            const std::string& name = work.view.lines[line].name;
            const std::string chosen = chosenBy(name, exponent);
            if (chosen != name) {
                const std::lock_guard lock(work.mutex);
                work.view.lines[line].chosen = chosen;
            }
            const auto accuracy = accuracyOf(work, readyFor(chosen), exponent, *truth, fetches);
            if (!accuracy) {
                return;
            }
            setLine(work, line, *accuracy, fetches);
        }
    }

    /// An estimator's name, or that of what `auto` stands for at an exponent.
    [[nodiscard]] std::string chosenBy(const std::string& name, double exponent) const {
        const auto estimator = *lighting::parseEstimator(name, lighting::Term::Glossy);
        return estimator.kind != lighting::EstimatorKind::Auto
                   ? name
                   : lighting::estimatorName(
                         forecast_
                             .choose(static_cast<double>(estimator.tolerance), exponent, exponent)
                             .estimator);
    }

    const ReadyLookup& readyFor(const std::string& name) {
        const auto found = ready_.find(name);
        if (found != ready_.end()) {
            return found->second;
        }
        const auto estimator = *lighting::parseEstimator(name, lighting::Term::Glossy);
        return ready_
            .emplace(name,
                     makeReady({name, lighting::Term::Glossy, estimator, nullptr}, *environment_))
            .first->second;
    }

    void ofLights(Work& work) {
        const Subject& subject = work.subject;
        const lighting::ReferenceDay reference(subject.lights, subject.hour);
        const std::vector<Drawn> drawn = drawnLights(subject.lights, subject.hour, kAtLight);
        const std::vector<Drawn> drawnOfRow =
            drawnLights(subject.lights, subject.hour, kAtLightOfRow);
        {
            const std::lock_guard lock(work.mutex);
            const std::size_t places = std::max<std::size_t>(2 * work.view.rows.size(), 1) - 1;
            const std::size_t whole = kEven + kAtLight * drawn.size();
            work.steps = whole + stepsOfChoice(work, whole) +
                         places * (kEvenOfRow + kAtLightOfRow * drawn.size());
        }
        const auto advance = [&work] { return step(work); };
        lighting::DayLookup fitted(subject.lights, subject.maps, kernels_);
        chooseWorst(work, [&](const Worn&, double exponent) {
            std::optional<double> error;
            measureMaps(work, fitted, truthOf(reference, drawn, kEven, exponent, advance), exponent,
                        [&](const lighting::Accuracy& accuracy, int) { error = accuracy.rmse; });
            return error;
        });
        const double exponent = exponentOf(work);
        const Truth truth = truthOf(reference, drawn, kEven, exponent, advance);
        for (std::size_t line = 0; line < work.view.lines.size() && !work.cancelled; ++line) {
            // Kernels are made here, for the slices too.
            lighting::DayLookup maps(subject.lights, layoutOf(subject, line), kernels_);
            measureMaps(work, maps, truth, exponent,
                        [&](const lighting::Accuracy& accuracy, int fetches) {
                            setLine(work, line, accuracy, fetches);
                        });
        }
        for (std::size_t row = 0; row < work.view.rows.size() && !work.cancelled; ++row) {
            for (const bool between : {false, true}) {
                const ui::MapRow& shown = work.view.rows[row];
                const double at = between ? shown.between : shown.exponent;
                if (between && row + 1 == work.view.rows.size()) {
                    continue;
                }
                measureMaps(work, fitted, truthOf(reference, drawnOfRow, kEvenOfRow, at, advance),
                            at, [&](const lighting::Accuracy& accuracy, int) {
                                const std::lock_guard lock(work.mutex);
                                ui::MapRow& written = work.view.rows[row];
                                (between ? written.betweenError : written.error) = accuracy.rmse;
                                work.news = true;
                            });
            }
        }
    }

    template <class Tell>
    static void measureMaps(const Work& work, lighting::DayLookup& maps, const Truth& truth,
                            double exponent, const Tell& tell) {
        if (work.cancelled) {
            return;
        }
        std::vector<glm::dvec3> answers;
        int fetches = 0;
        for (const lighting::MeasuredDirection& measured : truth.directions) {
            const auto answer = maps.lookup(work.subject.hour, measured.direction, exponent);
            answers.push_back(answer.radiance);
            fetches = answer.fetches;
        }
        tell(lighting::accuracyOf(truth.directions, truth.radiance, answers), fetches);
    }

    std::shared_ptr<lighting::RsrmKernels> kernels_;
    std::shared_ptr<const lighting::Cubemap> environment_;
    std::shared_ptr<const lighting::PreparedEnvironment> made_; ///< of it: tent mips
    std::map<std::string, ReadyLookup> ready_;
    std::optional<lighting::LobeMeans> means_;
    std::vector<lighting::MeasuredDirection> directions_;
    lighting::ErrorForecast forecast_;
};

AccuracyMeter::AccuracyMeter() : thread_([this] { loop(); }) {}

AccuracyMeter::~AccuracyMeter() {
    cancel();
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    wakes_.notify_all();
    thread_.join();
}

void AccuracyMeter::loop() {
    Measurer measurer(kernels_);
    std::shared_ptr<Work> last;
    for (;;) {
        std::shared_ptr<Work> work;
        {
            std::unique_lock lock(mutex_);
            wakes_.wait(lock, [&] { return ends_ || (work_ && work_ != last); });
            if (ends_) {
                return;
            }
            work = last = work_;
        }
        measurer.run(*work);
    }
}

void AccuracyMeter::cancel() {
    const std::lock_guard lock(mutex_);
    if (work_) {
        work_->cancelled = true;
        work_ = nullptr;
    }
    timing_.reset();
}

void AccuracyMeter::measure(Subject subject) {
    if (work_) {
        const std::vector<Worn>& now = work_->asked;
        const bool sameLight = work_->subject.light == subject.light &&
                               work_->subject.hour == subject.hour &&
                               work_->subject.rows == subject.rows &&
                               work_->subject.environment == subject.environment;
        const bool sameOne = now.size() == 1 && subject.materials.size() == 1 &&
                             now.front().material == subject.materials.front().material &&
                             now.front().exponent == subject.materials.front().exponent;
        if (sameLight && now == subject.materials) {
            return;
        }
        if (sameLight && sameOne) { // what it uses is measured already, whatever it is
            const std::lock_guard lock(work_->mutex);
            work_->asked = subject.materials;
            work_->wear(subject.materials.front());
            return;
        }
    }
    cancel();
    auto work = std::make_shared<Work>();
    ui::AccuracyView& view = work->view;
    view.selectable = subject.environment != nullptr;
    view.progress = 0.0;
    if (view.selectable) {
        for (const std::string& name : subject.estimators) {
            view.lines.push_back({.name = name});
        }
    } else {
        for (const char* name : kLayouts) {
            view.lines.push_back({.name = name});
        }
        const lighting::RsrmLayout& maps = subject.maps;
        for (int row = 0; subject.rows && row < maps.rows; ++row) {
            view.rows.push_back(
                {.exponent = lighting::rowExponent(maps, row),
                 .between = row + 1 < maps.rows ? lighting::rowExponent(maps, row + 0.5) : 0.0});
        }
    }
    for (const Worn& worn : subject.materials) {
        if (subject.materials.size() > 1) {
            view.selected.push_back({worn.material, lookupExponent(worn.exponent), worn.used});
        }
    }
    work->wear(subject.materials.front());
    work->asked = subject.materials;
    work->subject = std::move(subject);
    {
        const std::lock_guard lock(mutex_);
        work_ = std::move(work);
    }
    wakes_.notify_all();
}

bool AccuracyMeter::busy() const {
    if (!work_) {
        return false;
    }
    const std::lock_guard lock(work_->mutex);
    return work_->news || !work_->measured ||
           std::any_of(work_->view.lines.begin(), work_->view.lines.end(),
                       [](const ui::EstimateLine& line) { return !line.ms; });
}

bool AccuracyMeter::poll(ui::AccuracyView& view) {
    if (!work_) {
        const bool news = !view.material.empty();
        view = {};
        return news;
    }
    const std::lock_guard lock(work_->mutex);
    if (!work_->news) {
        return false;
    }
    work_->news = false;
    std::vector<ui::EstimateLine>& lines = work_->view.lines;
    for (ui::EstimateLine& line : lines) {
        line.front = line.ms && line.error &&
                     std::none_of(lines.begin(), lines.end(), [&](const ui::EstimateLine& other) {
                         return other.ms && other.error && *other.ms <= *line.ms &&
                                *other.error <= *line.error &&
                                (*other.ms < *line.ms || *other.error < *line.error);
                     });
    }
    view = work_->view;
    return true;
}

core::Result<void> AccuracyMeter::prepareLine(gl::Device& device, std::size_t line) {
    if (!shading_) {
        auto made = CostShading::make(device, kernels_);
        if (!made) {
            return made.error();
        }
        shading_ = std::move(*made);
    }
    const Subject& subject = work_->subject;
    if (!subject.environment) {
        prepared_ = nullptr;
        return shading_->prepare(subject.lights, layoutOf(subject, line), subject.hour);
    }
    const std::string& chosen = work_->view.lines[line].chosen;
    CostedLookup lookup{work_->view.lines[line].name, lighting::Term::Glossy, {}, nullptr};
    lookup.estimator =
        *lighting::parseEstimator(chosen.empty() ? lookup.name : chosen, lighting::Term::Glossy);
    if (prepared_ == subject.environment) {
        shading_->use(lookup); // all of them read tent mips
        return {};
    }
    prepared_ = subject.environment;
    auto made = shading_->prepare(lookup, *prepared_, work_->made.get());
    return made ? core::Result<void>() : core::Result<void>(made.error());
}

core::Result<void> AccuracyMeter::slice(gl::Device& device) {
    if (!work_) {
        return {};
    }
    if (!timing_) { // the first line whose error is known, so that `auto` has chosen
        const std::lock_guard lock(work_->mutex);
        const auto& lines = work_->view.lines;
        const auto next = std::find_if(lines.begin(), lines.end(),
                                       [](const auto& line) { return line.error && !line.ms; });
        if (next == lines.end()) {
            return {};
        }
        timing_ = static_cast<std::size_t>(next - lines.begin());
        rows_ = 0;
    }
    if (rows_ == 0) {
        rows_ = kFirstRows;
        enough_ = -1; // the first compiles
        least_ = std::numeric_limits<double>::infinity();
        return prepareLine(device, *timing_);
    }
    const auto ms = shading_->slice(work_->worst.exponent, rows_);
    if (!ms) {
        return ms.error();
    }
    const double took = *ms * rows_ * CostShading::kTileSide * 1e-6;
    if (enough_ < 0) {
        enough_ = 0;
    } else if (took >= kSliceMs || rows_ == CostShading::kTileSide) {
        least_ = std::min(least_, *ms);
        ++enough_;
    } else {
        rows_ = std::min(2 * rows_, CostShading::kTileSide);
    }
    if (enough_ == kSlices) {
        const std::lock_guard lock(work_->mutex);
        work_->view.lines[*timing_].ms = least_;
        work_->news = true;
        timing_.reset();
    }
    return {};
}

} // namespace lodestar::app
