// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/trigonometric.hpp>

#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

/// "118, 28 April", as a format for the number. @param day of the year, [1, 366]; the last of a
/// leap year is shown as another year's
std::string dateFormat(int day) {
    constexpr std::pair<const char*, int> kMonths[] = {
        {"January", 31},   {"February", 28}, {"March", 31},    {"April", 30},
        {"May", 31},       {"June", 30},     {"July", 31},     {"August", 31},
        {"September", 30}, {"October", 31},  {"November", 30}, {"December", 31}};
    int left = std::clamp(day, 1, 365);
    for (const auto& [name, days] : kMonths) {
        if (left <= days) {
            return "%.0f, " + std::to_string(left) + " " + name;
        }
        left -= days;
    }
    return "%.0f";
}

void drawPath(Studio& studio, model::Id id, lighting::SunPath path) {
    const glm::dvec2 north = degreesOfAxis(path.north);
    bool changed = false;
    label("latitude");
    if (const auto value = numberField("##latitude", glm::degrees(path.latitude), 0.1f, -90.0, 90.0,
                                       "%.5g\xc2\xb0")) {
        path.latitude = glm::radians(*value);
        changed = true;
    }
    studio.mark("latitude");
    label("day of year");
    if (const auto value = numberField("##day", path.dayOfYear, 0.2f, 1.0, 366.0,
                                       dateFormat(path.dayOfYear).c_str())) {
        path.dayOfYear = static_cast<int>(std::lround(*value));
        changed = true;
    }
    studio.mark("day of year");
    label("north");
    if (const auto value = numberField("##north", north.x, 0.2f, 0.0, 360.0, "%.5g\xc2\xb0")) {
        path.north = axisOfDegrees({*value, 0.0});
        changed = true;
    }
    if (changed) {
        model::SetLight set;
        set.light = id;
        set.path.emplace(path);
        studio.run(set);
    }
}

/// The key's own axis where it has one, else the light's.
void drawAxis(Studio& studio, const document::Light& light, model::Id id, model::Id keyId) {
    const document::Key* key = studio.model.key(keyId);
    const bool ofKey = key != nullptr && key->axis.has_value();
    const glm::dvec3 axis = ofKey ? *key->axis : light.axis.value_or(glm::dvec3(0.0, 1.0, 0.0));
    glm::dvec2 degrees = degreesOfAxis(axis);
    label("azimuth");
    const auto azimuth = numberField("##azimuth", degrees.x, 0.2f, 0.0, 360.0, "%.5g\xc2\xb0");
    studio.mark("azimuth");
    label("elevation");
    const auto elevation = numberField("##elevation", degrees.y, 0.1f, -89.9, 89.9, "%.5g\xc2\xb0");
    studio.mark("axis elevation");
    if (!azimuth && !elevation) {
        return;
    }
    degrees = {azimuth.value_or(degrees.x), elevation.value_or(degrees.y)};
    if (ofKey) {
        model::SetKey set;
        set.key = keyId;
        set.axis.emplace(axisOfDegrees(degrees));
        studio.run(set);
    } else {
        model::SetLight set;
        set.light = id;
        set.axis.emplace(axisOfDegrees(degrees));
        studio.run(set);
    }
}

void drawSun(Studio& studio, const document::Light& light, model::Id id, model::Id keyId) {
    bool follows = light.path.has_value();
    label("path");
    if (ImGui::Checkbox("by place and date", &follows)) {
        model::SetLight set;
        set.light = id;
        set.path.emplace(
            follows ? std::optional(lighting::SunPath{glm::radians(45.0), 172, {0.0, 0.0, -1.0}})
                    : std::nullopt);
        studio.runOnce(set);
        return; // the light is another now
    }
    studio.mark("by place and date");
    if (light.path) {
        drawPath(studio, id, *light.path);
    } else {
        drawAxis(studio, light, id, keyId);
    }
}

} // namespace

void drawLightPanel(Studio& studio) {
    heading("Light");
    drawPresets(studio);
    const auto index = model::findLight(studio.model.ids(), studio.chosenLight());
    if (!index) {
        ImGui::TextColored(kDimText, "No light: choose a preset, or add one at the left.");
        return;
    }
    const document::Light light = studio.model.document().lights[*index];
    const model::Id id = studio.model.ids().lights[*index].id;
    if (light.kind == lighting::LightKind::Sun) {
        drawSun(studio, light, id, studio.chosenKey());
    }
    const model::Id keyId = studio.chosenKey();
    if (const document::Key* key = studio.model.key(keyId)) {
        label("key's tint");
        if (const auto tint = colorField("tint", key->tint, 1e9, 1.0)) {
            model::SetKey set;
            set.key = keyId;
            set.tint = *tint;
            studio.run(set);
        }
        studio.mark("tint");
    }
}

} // namespace lodestar::ui
