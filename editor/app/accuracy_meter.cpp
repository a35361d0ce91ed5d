// SPDX-License-Identifier: MIT
#include "app/accuracy_meter.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "lighting/accuracy.h"
#include "lighting/day_lookup.h"
#include "lighting/drawn_light.h"
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

/// Phong: of the lookups of a material that is seen from above.
double lookupExponent(double exponent) {
    return static_cast<double>(shader::lodestar_lookupExponent(static_cast<float>(exponent), 1.0f));
}

glm::dvec3 evenDirection(int i, int count) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    return {r * std::cos(angle), z, r * std::sin(angle)};
}

/// A direction in the Phong lobe about another, by two numbers of [0, 1).
glm::dvec3 inLobe(const glm::dvec3& about, double exponent, double u, double turn) {
    const double cosine = std::pow(1.0 - u, 1.0 / (exponent + 1.0));
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const glm::dvec3 x = glm::normalize(glm::cross(
        std::abs(about.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0), about));
    const double azimuth = 2.0 * std::numbers::pi * turn;
    return glm::normalize(
        cosine * about + sine * (std::cos(azimuth) * x + std::sin(azimuth) * glm::cross(about, x)));
}

double sumOf(const glm::dvec3& radiance) {
    return radiance.r + radiance.g + radiance.b;
}

/// Directions and what lights shine into lobes about them.
struct Truth {
    std::vector<lighting::MeasuredDirection> directions;
    std::vector<glm::dvec3> radiance;
};

/// A light as it is drawn from.
struct Drawn {
    std::vector<glm::dvec3> points;
    double sum = 0.0;
};

std::vector<Drawn> drawnLights(const std::vector<lighting::DayLight>& lights, double hour,
                               int count) {
    std::vector<Drawn> all;
    for (const lighting::DayLight& light : lights) {
        const lighting::DayMoment moment = lighting::momentAt(light, hour);
        if (moment.visibility <= 0.0) {
            continue; // as ReferenceDay
        }
        const lighting::DrawnLight drawn = lighting::drawnLight(light, moment, count);
        all.push_back({{}, drawn.sum});
        for (const lighting::DrawnTexel& point : drawn.points) {
            all.back().points.emplace_back(point.direction);
        }
    }
    return all;
}

/// Half of the directions even over the sphere, half drawn by what the lobes get: points of each
/// light moved by the lobe itself, whose density is the lobe's mean over that light's sum.
/// @param advance called once a direction; false: stop
template <class Advance>
Truth truthOf(const lighting::ReferenceDay& reference, const std::vector<Drawn>& drawn, int even,
              double exponent, const Advance& advance) {
    Truth truth;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < even; ++i) {
        directions.push_back(evenDirection(i, even));
    }
    for (const Drawn& light : drawn) {
        for (std::size_t i = 0; i < light.points.size(); ++i) {
            const double u = (static_cast<double>(i * 7 % light.points.size()) + 0.5) /
                             static_cast<double>(light.points.size());
            const double turn = 0.7548776662466927 * static_cast<double>(i + 1);
            directions.push_back(
                inLobe(glm::normalize(light.points[i]), exponent, u, turn - std::floor(turn)));
        }
    }
    double weights = 0.0;
    for (const glm::dvec3& direction : directions) {
        if (!advance()) {
            return {};
        }
        double density = even / (4.0 * std::numbers::pi);
        glm::dvec3 sum(0.0);
        for (std::size_t light = 0; light < reference.count(); ++light) {
            const glm::dvec3 part = reference(light, direction, exponent);
            sum += part;
            density += drawn[light].sum > 0.0 ? static_cast<double>(drawn[light].points.size()) *
                                                    sumOf(part) / drawn[light].sum
                                              : 0.0;
        }
        truth.directions.push_back({direction, 1.0 / density});
        truth.radiance.push_back(sum);
        weights += 1.0 / density;
    }
    for (lighting::MeasuredDirection& direction : truth.directions) {
        direction.weight /= weights;
    }
    return truth;
}

} // namespace

struct AccuracyMeter::Work {
    Subject subject;
    std::atomic<bool> cancelled{false};
    std::mutex mutex; ///< of what follows
    ui::AccuracyView view;
    bool news = true;
    bool measured = false; ///< the thread is done
    std::size_t steps = 1, done = 0;
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

    void ofEnvironment(Work& work) {
        if (environment_ != work.subject.environment) {
            environment_ = work.subject.environment;
            ready_.clear();
            means_.emplace(*environment_);
            directions_ = lighting::measuredDirections(*environment_, kEnvironmentDirections);
            lighting::PreparedParts parts;
            parts.tentMips = true;
            forecast_ = lighting::ErrorForecast(*environment_,
                                                lighting::prepare(*environment_, parts).tentMips);
        }
        const double exponent = work.view.exponent;
        {
            const std::lock_guard lock(work.mutex);
            work.steps = directions_.size() * (1 + work.view.lines.size());
        }
        std::vector<glm::dvec3> truth;
        for (const lighting::MeasuredDirection& measured : directions_) {
            truth.push_back((*means_)(measured.direction, exponent));
            if (!step(work)) {
                return;
            }
        }
        for (std::size_t line = 0; line < work.view.lines.size(); ++line) {
            const ReadyLookup& ready = readyFor(work, line, exponent);
            std::vector<glm::dvec3> answers;
            int fetches = 0;
            for (const lighting::MeasuredDirection& measured : directions_) {
                const CostAnswer answer = ready.answer(measured.direction, exponent);
                answers.push_back(answer.radiance);
                fetches = answer.fetches;
                if (!step(work)) {
                    return;
                }
            }
            setLine(work, line, lighting::accuracyOf(directions_, truth, answers), fetches);
        }
    }

    /// A line's lookup; what `auto` stands for at the exponent is said.
    const ReadyLookup& readyFor(Work& work, std::size_t line, double exponent) {
        std::string name = work.view.lines[line].name; // written by no one else
        auto estimator = *lighting::parseEstimator(name, lighting::Term::Glossy);
        if (estimator.kind == lighting::EstimatorKind::Auto) {
            estimator =
                forecast_.choose(static_cast<double>(estimator.tolerance), exponent, exponent)
                    .estimator;
            name = lighting::estimatorName(estimator);
            const std::lock_guard lock(work.mutex);
            work.view.lines[line].chosen = name;
        }
        const auto found = ready_.find(name);
        if (found != ready_.end()) {
            return found->second;
        }
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
            work.steps = kEven + kAtLight * drawn.size() +
                         places * (kEvenOfRow + kAtLightOfRow * drawn.size());
        }
        const auto advance = [&work] { return step(work); };
        const double exponent = work.view.exponent;
        const Truth truth = truthOf(reference, drawn, kEven, exponent, advance);
        for (std::size_t line = 0; line < work.view.lines.size() && !work.cancelled; ++line) {
            const lighting::RsrmLayout& layout = *lighting::rsrmLayoutNamed(kLayouts[line]);
            (void)kernels_->get(layout, lighting::LightKind::Sky); // for the slices
            lighting::DayLookup maps(subject.lights, layout, kernels_);
            measureMaps(work, maps, truth, exponent,
                        [&](const lighting::Accuracy& accuracy, int fetches) {
                            setLine(work, line, accuracy, fetches);
                        });
        }
        lighting::DayLookup fitted(subject.lights, lighting::kRsrm, kernels_);
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
        const Subject& now = work_->subject;
        if (now.material == subject.material && now.exponent == subject.exponent &&
            now.light == subject.light && now.hour == subject.hour && now.rows == subject.rows &&
            now.environment == subject.environment) {
            if (now.used != subject.used) {
                const std::lock_guard lock(work_->mutex);
                work_->subject.used = subject.used;
                for (ui::EstimateLine& line : work_->view.lines) {
                    line.used = line.name == subject.used;
                }
                work_->news = true;
            }
            return;
        }
    }
    cancel();
    auto work = std::make_shared<Work>();
    ui::AccuracyView& view = work->view;
    view.material = subject.material;
    view.exponent = lookupExponent(subject.exponent);
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
        for (int row = 0; subject.rows && row < lighting::kRsrm.rows; ++row) {
            view.rows.push_back({.exponent = lighting::rowExponent(lighting::kRsrm, row),
                                 .between = row + 1 < lighting::kRsrm.rows
                                                ? lighting::rowExponent(lighting::kRsrm, row + 0.5)
                                                : 0.0});
        }
    }
    for (ui::EstimateLine& line : view.lines) {
        line.used = line.name == subject.used;
    }
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
    CostedLookup lookup{work_->view.lines[line].name, lighting::Term::Glossy, {}, nullptr};
    if (!work_->subject.environment) {
        lookup.layout = lighting::rsrmLayoutNamed(lookup.name);
        prepared_ = nullptr;
    } else {
        const std::string& chosen = work_->view.lines[line].chosen;
        lookup.estimator = *lighting::parseEstimator(chosen.empty() ? lookup.name : chosen,
                                                     lighting::Term::Glossy);
        if (prepared_ == work_->subject.environment) {
            shading_->use(lookup); // all of them read tent mips
            return {};
        }
        prepared_ = work_->subject.environment;
    }
    const lighting::Cubemap none;
    auto made = shading_->prepare(lookup, prepared_ ? *prepared_ : none);
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
    const auto ms = shading_->slice(work_->subject.exponent, rows_);
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
