// SPDX-License-Identifier: MIT
//
// The viewer's answers to keys, pointer and dropped files.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <glm/gtc/constants.hpp>

#include "app/viewer.h"

namespace lodestar::app {
namespace {

using platform::Key;
using platform::PointerButton;

constexpr double kExposureStep = 0.25; ///< stops
constexpr double kMostExposure = 20.0; ///< stops, either way
/// The longest time a flight goes on in one step: a slow frame must not throw the camera far.
constexpr double kLongestStep = 0.1;

bool isScene(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".gltf" || extension == ".glb";
}

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

/// Of a key that scrubs, seconds.
constexpr double kHourStep = 0.25;
constexpr double kScrubStep = 0.05;

} // namespace

void Viewer::handle(const platform::Event& event) {
    std::visit(
        Overloaded{
            [&](const platform::KeyEvent& key) {
                if (key.down) {
                    keys_.insert(key.key);
                    press(key);
                } else {
                    keys_.erase(key.key);
                }
            },
            [](const platform::TextEvent&) {},
            [&](const platform::ButtonEvent& button) {
                button.down ? (void)buttons_.insert(button.button)
                            : (void)buttons_.erase(button.button);
                panning_ = held(PointerButton::Middle) ||
                           (held(PointerButton::Left) && button.modifiers.shift);
            },
            [&](const platform::MotionEvent& motion) {
                drag(static_cast<float>(motion.x), static_cast<float>(motion.y));
            },
            [&](const platform::WheelEvent& turned) { wheel(static_cast<float>(turned.steps)); },
            [&](const platform::DropEvent& drop) {
                for (const std::string& path : drop.paths) {
                    isScene(path) ? openScene(path, {}) : openEnvironment(path);
                }
            },
            [&](const platform::DamageEvent&) { changed(false); },
            [&](const platform::FocusLostEvent&) {
                keys_.clear();
                buttons_.clear();
                panning_ = false;
            },
            [&](const platform::CloseEvent&) { closing_ = true; },
        },
        event);
}

scene::CameraPose& Viewer::moved() {
    if (!pose_) {
        pose_ = scene::poseFromView(view(), document_.bounds);
    }
    lastMotion_ = Clock::now();
    changed(false);
    return *pose_;
}

void Viewer::drag(float x, float y) {
    const glm::vec2 at(x, y);
    const glm::vec2 pixels = pointer_ ? at - *pointer_ : glm::vec2(0.0f);
    pointer_ = at;
    if (buttons_.empty() || pixels == glm::vec2(0.0f)) {
        return;
    }
    const auto height = static_cast<float>(std::max(settings_.height, 1));
    const glm::vec2 radians = pixels * (glm::pi<float>() / height);
    if (panning_) {
        scene::pan(moved(), pixels, height);
    } else if (held(PointerButton::Right)) {
        scene::look(moved(), {0.5f * radians.x, -0.5f * radians.y});
    } else if (held(PointerButton::Left)) {
        scene::orbit(moved(), radians);
    }
}

void Viewer::wheel(float steps) {
    if (std::isfinite(steps) && steps != 0.0f) {
        scene::dolly(moved(), std::clamp(steps, -50.0f, 50.0f), document_.bounds);
    }
}

glm::vec3 Viewer::flyDirection() const {
    if (!held(PointerButton::Right)) {
        return glm::vec3(0.0f);
    }
    const auto along = [&](Key positive, Key negative) {
        return (held(positive) ? 1.0f : 0.0f) - (held(negative) ? 1.0f : 0.0f);
    };
    return {along(Key::D, Key::A), along(Key::E, Key::Q), along(Key::W, Key::S)};
}

void Viewer::advance(double seconds) {
    advanceAnimation(seconds);
    advanceDay(seconds);
    if (const glm::vec3 direction = flyDirection(); direction != glm::vec3(0.0f)) {
        const float metres = scene::flySpeed(document_.bounds, held(Key::Shift)) *
                             static_cast<float>(std::min(seconds, kLongestStep));
        scene::fly(moved(), glm::normalize(direction) * metres);
    }
}

void Viewer::press(const platform::KeyEvent& event) {
    const std::optional<KeyBinding> binding = bindingOf(event);
    if (!binding) {
        return;
    }
    const bool repeats = binding->action == Action::Brighter || binding->action == Action::Darker ||
                         binding->action == Action::Earlier || binding->action == Action::Later ||
                         binding->action == Action::HourEarlier ||
                         binding->action == Action::HourLater;
    if (!event.repeat || repeats) {
        perform(*binding);
    }
}

void Viewer::perform(const KeyBinding& binding) {
    switch (binding.action) {
    case Action::FrameAll:
        scene::frameAll(moved(), document_.bounds, aspect());
        break;
    case Action::ResetCamera:
        pose_.reset();
        changed(false);
        break;
    case Action::NextCamera:
        chooseCamera(1);
        break;
    case Action::PreviousCamera:
        chooseCamera(-1);
        break;
    case Action::NextScene:
        chooseScene(1);
        break;
    case Action::PreviousScene:
        chooseScene(-1);
        break;
    case Action::Play:
        play();
        break;
    case Action::Earlier:
    case Action::Later:
        scrub(binding.action == Action::Later ? kScrubStep : -kScrubStep);
        break;
    case Action::HourEarlier:
    case Action::HourLater:
        dayPlaying_ = false;
        moveHour(binding.action == Action::HourLater ? kHourStep : -kHourStep);
        break;
    case Action::PlayDay:
        playDay();
        break;
    case Action::DaySpeed:
        nextDaySpeed();
        break;
    case Action::NextAnimation:
        chooseAnimation(animation_ + 1);
        break;
    case Action::Brighter:
    case Action::Darker:
        exposure_ += binding.action == Action::Brighter ? kExposureStep : -kExposureStep;
        exposure_ = std::clamp(exposure_, -kMostExposure, kMostExposure);
        changed(false);
        break;
    case Action::ChooseSpecular:
    case Action::ChooseDiffuse:
    case Action::ChooseForms:
        chooseEstimator(binding);
        break;
    case Action::ErrorView:
        toggleErrorView();
        break;
    case Action::Screenshot:
        saveScreenshot();
        break;
    case Action::Help:
        help_ = !help_;
        changed(false);
        break;
    case Action::Text:
        textShown_ = !textShown_;
        changed(false);
        break;
    case Action::FullScreen:
        fullScreen_ = !fullScreen_;
        changed(true);
        break;
    case Action::Close:
        closing_ = true;
        break;
    }
}

void Viewer::chooseCamera(int step) {
    const std::vector<std::string> names = scene::cameraNames(*document_.scene);
    const int count = static_cast<int>(names.size());
    if (count == 0) {
        say("the scene has no cameras", false);
        return;
    }
    // From a view that is no camera's, forwards begins with the first.
    const bool fromNone = request_.eye || request_.target;
    cameraIndex_ = fromNone ? (step > 0 ? 0 : count - 1) : (cameraIndex_ + step + count) % count;
    const std::optional<float> fov = request_.verticalFov;
    request_ = {};
    request_.number = cameraIndex_;
    request_.verticalFov = fov;
    pose_.reset();
    const std::string& name = names[static_cast<std::size_t>(cameraIndex_)];
    say("camera " + std::to_string(cameraIndex_) + (name.empty() ? "" : ": " + name), false);
}

void Viewer::chooseScene(int step) {
    const int from = std::max(sceneIndex_, 0);
    openScene(document_.path, (from + step + sceneCount_) % sceneCount_);
}

void Viewer::chooseEstimator(const KeyBinding& binding) {
    if (binding.action == Action::ChooseForms) {
        using lighting::FresnelForm, lighting::LobeForm;
        if (binding.choice == 0) {
            settings_.lobes = settings_.lobes == LobeForm::Sg ? LobeForm::Power : LobeForm::Sg;
        } else {
            settings_.fresnel =
                settings_.fresnel == FresnelForm::Sg ? FresnelForm::Schlick : FresnelForm::Sg;
        }
        changed(true);
        return;
    }
    constexpr const char* kOfLights[] = {"rsrm", "rsrm-published", "rsrm-published-columns"};
    if (onlyLights()) {
        if (binding.choice < static_cast<int>(std::size(kOfLights))) {
            lightsEstimator_ = kOfLights[binding.choice];
            takeLights(std::move(lights_));
            changed(true);
        }
        return;
    }
    const bool glossy = binding.action == Action::ChooseSpecular;
    const auto choices =
        estimatorChoices(glossy ? lighting::Term::Glossy : lighting::Term::Diffuse);
    (glossy ? settings_.specular : settings_.diffuse) =
        choices[static_cast<std::size_t>(binding.choice)];
    changed(true);
}

} // namespace lodestar::app
