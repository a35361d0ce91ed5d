// SPDX-License-Identifier: MIT
#include "ui/studio.h"

#include <algorithm>

#include <imgui_internal.h>

#include "lighting/day.h"

namespace lodestar::ui {

std::optional<model::Outcome> Studio::run(const model::Command& command) {
    const ImGuiID holder = ImGui::GetCurrentContext()->ActiveId;
    if (holder != holder_ || token_ == 0) {
        token_ = model.newToken();
        holder_ = holder;
    }
    auto outcome = model.execute(command, token_);
    if (!outcome) {
        say(outcome.error().message(), true);
        return std::nullopt;
    }
    return *outcome;
}

std::optional<model::Outcome> Studio::runOnce(const model::Command& command) {
    token_ = 0;
    auto outcome = model.execute(command);
    if (!outcome) {
        say(outcome.error().message(), true);
        return std::nullopt;
    }
    return *outcome;
}

void Studio::say(std::string text, bool isError) {
    constexpr std::size_t kMost = 200;
    if (!log.empty() && log.back().text == text) {
        return; // a drag over what is refused says so once
    }
    log.push_back({std::move(text), isError});
    if (log.size() > kMost) {
        log.pop_front();
    }
}

bool Studio::down(Key key) const {
    return ImGui::IsKeyDown(around.placeOfKey != nullptr ? around.placeOfKey(key)
                                                         : static_cast<int>(key));
}

bool Studio::pressed(Key key, bool repeats) const {
    return ImGui::IsKeyPressed(
        around.placeOfKey != nullptr ? around.placeOfKey(key) : static_cast<int>(key), repeats);
}

void Studio::give(const glm::dvec3& radiance) {
    if (view.brush) {
        view.brushSettings.color = radiance;
    } else if (model.selection().stops.empty()) {
        say("no stop is selected to get the radiance", true);
    } else {
        const lighting::GradientStop picked = model::stopOf(0.0, radiance);
        (void)run(model::SetStops{model.selection().stops, {}, picked.color, picked.ev});
    }
}

void Studio::mark(const std::string& name) {
    mark(name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
}

void Studio::mark(const std::string& name, const ImVec2& low, const ImVec2& high) {
    const ImGuiWindow& window = *ImGui::GetCurrentWindowRead();
    marks[name] = {
        low, high, window.ClipRect.Min, window.ClipRect.Max, window.ScrollMax.y > 0.0f, window.ID};
}

model::Id Studio::chosenLight() const {
    const model::Id selected = model.selection().light;
    if (selected != model::Id::None || model.ids().lights.empty()) {
        return selected;
    }
    return model.ids().lights.front().id;
}

model::Id Studio::chosenKey() const {
    const model::Id selected = model.selection().key;
    const auto light = model::findLight(model.ids(), chosenLight());
    if (selected != model::Id::None || !light) {
        return selected;
    }
    const std::vector<document::Key>& keys = model.document().lights[*light].keys;
    // The last key at or before the hour, across midnight too; a document's may stand in any order.
    std::size_t best = 0;
    double least = 25.0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const double before = lighting::wrappedHour(view.hour - keys[i].hour);
        if (before < least) {
            least = before;
            best = i;
        }
    }
    return keys.empty() ? model::Id::None : model.ids().lights[*light].keys[best].id;
}

} // namespace lodestar::ui
