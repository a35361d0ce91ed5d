// SPDX-License-Identifier: MIT
//
// The workspace's answers to the keys of the gradient and of what is selected.
#include <algorithm>
#include <cctype>
#include <charconv>

#include "lodestar/display.glsl"
#include "model/clipboard.h"
#include "model/ramp.h"
#include "ui/actions.h"
#include "ui/workspace.h"

namespace lodestar::ui {
namespace {

void selectAllStops(Studio& studio, model::Id key) {
    if (const auto place = model::findKey(studio.model.ids(), key)) {
        model::Selection selection = studio.model.selection();
        selection.key = key;
        selection.stops = studio.model.ids().lights[place->light].keys[place->key].stops;
        studio.model.select(selection);
    }
}

void selectNeighbourLight(Studio& studio, int step) {
    const std::vector<model::LightIds>& lights = studio.model.ids().lights;
    const auto at = model::findLight(studio.model.ids(), studio.chosenLight());
    if (!at) {
        return;
    }
    const auto count = static_cast<std::ptrdiff_t>(lights.size());
    model::Selection selection;
    selection.materials = studio.model.selection().materials;
    selection.light =
        lights[static_cast<std::size_t>((static_cast<std::ptrdiff_t>(*at) + step + count) % count)]
            .id;
    studio.model.select(selection);
}

/// In the middle of the widest gap after the selected stop, or of the whole gradient.
void addStop(Studio& studio, model::Id key) {
    const document::Key* painted = studio.model.key(key);
    const auto place = model::findKey(studio.model.ids(), key);
    if (painted == nullptr || !place || painted->gradient.stops.empty()) {
        return;
    }
    const lighting::LightKind kind = studio.model.document().lights[place->light].kind;
    std::vector<double> places{0.0, 180.0};
    for (const document::Stop& stop : painted->gradient.stops) {
        places.push_back(model::fromAxis(stop.stop.at, kind));
    }
    std::sort(places.begin(), places.end());
    std::size_t widest = 1;
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i] - places[i - 1] > places[widest] - places[widest - 1]) {
            widest = i;
        }
    }
    studio.runOnce(
        model::AddStop{key, model::atFromAxis(0.5 * (places[widest - 1] + places[widest]), kind)});
}

/// Stops if any are selected, else the key that is selected.
void deleteSelected(Studio& studio) {
    const model::Selection& selection = studio.model.selection();
    if (!selection.stops.empty()) {
        studio.runOnce(model::DeleteStops{selection.stops});
    } else if (selection.key != model::Id::None) {
        studio.runOnce(model::DeleteKey{selection.key});
    }
}

/// Stops if any are selected, else the key, else the material that is selected.
/// @return whether there was anything
bool copySelected(Studio& studio) {
    const model::Selection& selection = studio.model.selection();
    core::Result<std::string> text = std::string();
    if (!selection.stops.empty()) {
        text = model::copyStops(studio.model, selection.stops);
    } else if (selection.key != model::Id::None) {
        text = model::copyKey(studio.model, selection.key);
    } else if (!selection.materials.empty()) {
        text = model::copyMaterial(studio.model, selection.materials.front());
    }
    if (!text) {
        studio.say(text.error().message(), true);
        return false;
    }
    if (text->empty()) {
        studio.say("nothing is selected to be copied", true);
        return false;
    }
    ImGui::SetClipboardText(text->c_str());
    return true;
}

/// "#rrggbb", sRGB, as linear colour.
std::optional<glm::dvec3> colorOfText(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
        text.remove_suffix(1);
    }
    unsigned int bytes = 0;
    if (text.size() != 7 || text.front() != '#' ||
        std::from_chars(text.data() + 1, text.data() + 7, bytes, 16).ptr != text.data() + 7) {
        return std::nullopt;
    }
    glm::dvec3 color;
    for (int c = 0; c < 3; ++c) {
        color[c] = static_cast<double>(shader::lodestar_linearFromSrgb(
            static_cast<float>((bytes >> (16 - 8 * c)) & 0xff) / 255.0f));
    }
    return color;
}

void paste(Studio& studio) {
    const char* text = ImGui::GetClipboardText();
    if (const auto color = colorOfText(text != nullptr ? text : "")) {
        studio.give(*color);
        return;
    }
    const model::PasteTarget target{studio.chosenKey(), studio.chosenLight(), studio.view.hour,
                                    studio.model.selection().materials};
    auto command = model::pasteCommand(studio.model, text != nullptr ? text : "", target);
    if (!command) {
        studio.say(command.error().message(), true);
        return;
    }
    studio.runOnce(*command);
}

} // namespace

bool Workspace::performOnGradient(Studio& studio, const Binding& binding) {
    const model::Id key = studio.chosenKey();
    switch (binding.action) {
    case Action::Copy:
        (void)copySelected(studio);
        return true;
    case Action::Cut:
        if (copySelected(studio)) {
            deleteSelected(studio);
        }
        return true;
    case Action::Paste:
        paste(studio);
        return true;
    case Action::Delete:
        deleteSelected(studio);
        return true;
    case Action::SelectAllStops:
        selectAllStops(studio, key);
        return true;
    case Action::PreviousStop:
    case Action::NextStop:
        selectNeighbourStop(studio, binding.action == Action::NextStop ? 1 : -1);
        return true;
    case Action::AddStop:
        addStop(studio, key);
        return true;
    case Action::Reverse:
        studio.runOnce(model::ReverseStops{key});
        return true;
    case Action::Mirror:
        studio.runOnce(model::MirrorStops{key});
        return true;
    case Action::Distribute:
    case Action::DistributeFromLeft:
        studio.runOnce(model::DistributeStops{key, binding.action == Action::DistributeFromLeft});
        return true;
    case Action::Brush:
        view_.brush = !view_.brush;
        return true;
    case Action::Pick:
        view_.picking = !view_.picking;
        return true;
    case Action::PreviousLight:
    case Action::NextLight:
        selectNeighbourLight(studio, binding.action == Action::NextLight ? 1 : -1);
        return true;
    default:
        return false;
    }
}

} // namespace lodestar::ui
