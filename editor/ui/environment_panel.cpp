// SPDX-License-Identifier: MIT
#include "ui/panels.h"

#include <algorithm>

#include <glm/trigonometric.hpp>
#include <imgui_stdlib.h>

#include "ui/fields.h"
#include "ui/theme.h"

namespace lodestar::ui {

void drawEnvironmentPanel(Studio& studio) {
    heading("Environment");
    const std::optional<document::Environment>& environment = studio.model.document().environment;
    label("source");
    std::string source = environment ? environment->source : "";
    const bool entered = ImGui::InputTextWithHint("##source", "none; a file beside the document",
                                                  &source, ImGuiInputTextFlags_EnterReturnsTrue);
    studio.mark("environment source");
    if (entered && source.empty()) {
        studio.runOnce(model::RemoveEnvironment{});
        return;
    }
    if (entered) {
        model::SetEnvironment set;
        set.source = source;
        studio.runOnce(set);
    }
    if (!environment) {
        return;
    }
    const std::vector<document::Light>& lights = studio.model.document().lights;
    if (std::any_of(lights.begin(), lights.end(), [](const document::Light& light) {
            return light.kind == lighting::LightKind::Sky && !light.add;
        })) {
        label("");
        ImGui::TextColored(kDimText, "a sky light stands in its place");
    }
    label("rotation");
    if (const auto value = numberField("##rotation", glm::degrees(environment->rotation), 0.5f,
                                       -360.0, 360.0, "%.5g\xc2\xb0")) {
        model::SetEnvironment set;
        set.rotation = glm::radians(*value);
        studio.run(set);
    }
    studio.mark("environment rotation");
    label("exposure");
    if (const auto value =
            numberField("##environment ev", environment->ev, 0.02f, -64.0, 64.0, "%.4g EV")) {
        model::SetEnvironment set;
        set.ev = *value;
        studio.run(set);
    }
    studio.mark("environment ev");
    label("");
    if (button(studio, "Remove environment", "the document's lights alone shine")) {
        studio.runOnce(model::RemoveEnvironment{});
    }
}

} // namespace lodestar::ui
