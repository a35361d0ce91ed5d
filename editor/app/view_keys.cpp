// SPDX-License-Identifier: MIT
#include "app/view_keys.h"

#include <algorithm>

namespace lodestar::app {
namespace {

using lighting::EstimatorKind;
using platform::Key;

constexpr platform::Modifiers kNone{};
constexpr platform::Modifiers kShift{true, false, false};
constexpr platform::Modifiers kControl{false, true, false};

constexpr KeyBinding kBindings[] = {
    {Key::F, kNone, Action::FrameAll},
    {Key::Home, kNone, Action::ResetCamera},
    {Key::C, kNone, Action::NextCamera},
    {Key::C, kShift, Action::PreviousCamera},
    {Key::PageDown, kNone, Action::NextScene},
    {Key::PageUp, kNone, Action::PreviousScene},
    {Key::Space, kNone, Action::Play},
    {Key::Comma, kNone, Action::Earlier},
    {Key::Period, kNone, Action::Later},
    {Key::N, kNone, Action::NextAnimation},
    {Key::T, kNone, Action::HourLater},
    {Key::T, kShift, Action::HourEarlier},
    {Key::Y, kNone, Action::PlayDay},
    {Key::Y, kShift, Action::DaySpeed},
    {Key::Plus, kNone, Action::Brighter},
    {Key::Plus, kShift, Action::Brighter}, // a US keyboard's plus is a shifted key
    {Key::Minus, kNone, Action::Darker},
    {Key::Digit1, kNone, Action::ChooseSpecular, 0},
    {Key::Digit2, kNone, Action::ChooseSpecular, 1},
    {Key::Digit3, kNone, Action::ChooseSpecular, 2},
    {Key::Digit4, kNone, Action::ChooseSpecular, 3},
    {Key::Digit5, kNone, Action::ChooseSpecular, 4},
    {Key::Digit6, kNone, Action::ChooseSpecular, 5},
    {Key::Digit7, kNone, Action::ChooseSpecular, 6},
    {Key::Digit8, kNone, Action::ChooseSpecular, 7},
    {Key::Digit9, kNone, Action::ChooseSpecular, 8},
    {Key::Digit0, kNone, Action::ChooseSpecular, 9},
    {Key::Digit1, kShift, Action::ChooseDiffuse, 0},
    {Key::Digit2, kShift, Action::ChooseDiffuse, 1},
    {Key::Digit3, kShift, Action::ChooseDiffuse, 2},
    {Key::Digit4, kShift, Action::ChooseDiffuse, 3},
    {Key::G, kNone, Action::ChooseForms, 0},
    {Key::G, kShift, Action::ChooseForms, 1},
    {Key::V, kNone, Action::ErrorView},
    {Key::P, kNone, Action::Screenshot},
    {Key::F12, kNone, Action::Screenshot},
    {Key::H, kNone, Action::Help},
    {Key::F1, kNone, Action::Help},
    {Key::Tab, kNone, Action::Text},
    {Key::F11, kNone, Action::FullScreen},
    {Key::Escape, kNone, Action::Close},
    {Key::Q, kControl, Action::Close},
};

constexpr HelpLine kHelp[] = {
    {"left drag", "orbit about the point looked at"},
    {"middle drag, shift + left drag", "pan"},
    {"wheel", "go nearer or further"},
    {"right drag + W A S D, Q E", "look and fly; with shift faster"},
    {"F", "frame the whole scene"},
    {"Home", "reset the camera"},
    {"C, shift + C", "next, previous camera of the scene"},
    {"Page Down, Page Up", "next, previous scene of the file, read again"},
    {"Space", "play or pause the animation"},
    {"comma, period", "a twentieth of a second earlier, later"},
    {"N", "next animation of the scene"},
    {"T, shift + T", "the lighting document's day: a quarter of an hour later, earlier"},
    {"Y, shift + Y", "play or pause the day, change its speed"},
    {"+, -", "brighter, darker by a quarter of a stop"},
    {"1 .. 9, 0", "glossy light: tent, mip, mip-floor, bias:2, bias:2:vertex, ring:3, ring:7, "
                  "taps:64, auto:0.05, prefiltered"},
    {"1 .. 3", "under a lighting document alone: rsrm, rsrm-published, rsrm-published-columns"},
    {"shift + 1 .. 4", "diffuse light: irradiance, sh9, lowest-mip, bias:7"},
    {"G, shift + G", "lamps' highlights, Fresnel's reflectance as spherical Gaussians, or exact"},
    {"V", "the picture's error against light by many taps a pixel, in per cent, or the picture"},
    {"P, F12", "picture of the view as a PNG in the current folder"},
    {"drop a file", "show a scene, or light it by a panorama"},
    {"H, F1", "this help"},
    {"Tab", "hide or show all text"},
    {"F11", "full screen"},
    {"Escape, control + Q", "close"},
};

constexpr lighting::Estimator kSpecular[] = {{EstimatorKind::Tent, 0.0f},
                                             {EstimatorKind::Mip, 0.0f},
                                             {EstimatorKind::MipFloor, 0.0f},
                                             {EstimatorKind::Bias, 2.0f},
                                             {EstimatorKind::BiasVertex, 2.0f},
                                             {EstimatorKind::Ring3},
                                             {EstimatorKind::Ring7},
                                             {EstimatorKind::Taps, 0.0f, 64},
                                             {EstimatorKind::Auto, 0.0f, 16, 0.05f},
                                             {EstimatorKind::Prefiltered}};
constexpr lighting::Estimator kDiffuse[] = {{EstimatorKind::Irradiance, 0.0f},
                                            {EstimatorKind::Sh9, 0.0f},
                                            {EstimatorKind::LowestMip, 0.0f},
                                            {EstimatorKind::Bias, 7.0f}};

} // namespace

std::span<const KeyBinding> keyBindings() {
    return kBindings;
}

std::optional<KeyBinding> bindingOf(const platform::KeyEvent& event) {
    const auto found =
        std::find_if(std::begin(kBindings), std::end(kBindings), [&](const KeyBinding& binding) {
            return binding.key == event.key && binding.modifiers == event.modifiers;
        });
    return event.down && found != std::end(kBindings) ? std::optional(*found) : std::nullopt;
}

std::span<const HelpLine> helpLines() {
    return kHelp;
}

std::span<const lighting::Estimator> estimatorChoices(lighting::Term term) {
    return term == lighting::Term::Glossy ? std::span<const lighting::Estimator>(kSpecular)
                                          : std::span<const lighting::Estimator>(kDiffuse);
}

} // namespace lodestar::app
