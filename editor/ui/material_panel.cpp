// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/trigonometric.hpp>

#include "lodestar/lobes.glsl"
#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

constexpr double kMostExponent = 1e7;

/// Degrees from the axis at which cos^s falls to a half: what of a highlight seems its size.
double halfWidth(double exponent) {
    return exponent > 0.0 ? glm::degrees(std::acos(std::exp2(-1.0 / exponent))) : 90.0;
}

/// A number's place on a scale of log2(1 + s), so that Lambert's end is on it too.
float sliderFromExponent(double exponent) {
    return static_cast<float>(std::log2(1.0 + exponent));
}
double exponentFromSlider(float place) {
    return std::clamp(std::exp2(static_cast<double>(place)) - 1.0, 0.0, kMostExponent);
}

void drawExponent(Studio& studio, const MaterialLine& material,
                  const std::vector<std::string>& names) {
    std::optional<double> wanted;
    label("exponent");
    float place = sliderFromExponent(material.exponent);
    if (ImGui::SliderFloat("##slide", &place, 0.0f, sliderFromExponent(kMostExponent), "",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput)) {
        wanted = exponentFromSlider(place);
    }
    studio.mark("exponent slider");
    label("");
    if (const auto typed = numberField("##exponent", material.exponent,
                                       static_cast<float>(0.01 * (1.0 + material.exponent)), 0.0,
                                       kMostExponent, "%.6g")) {
        wanted = *typed;
    }
    studio.mark("exponent");
    if (wanted) {
        model::SetMaterials set;
        set.names = names;
        set.exponent = *wanted;
        studio.run(set);
    }
    label("");
    ImGui::TextColored(kDimText, "roughness %.3f    half-width %.2f\xc2\xb0",
                       static_cast<double>(shader::lodestar_roughnessFromExponent(
                           static_cast<float>(material.exponent))),
                       halfWidth(material.exponent));
}

void drawReflectances(Studio& studio, const MaterialLine& material,
                      const std::vector<std::string>& names) {
    label("diffuse");
    if (const auto value = colorField("diffuse", material.diffuse, 1.0, 1.0)) {
        model::SetMaterials set;
        set.names = names;
        set.diffuse = *value;
        studio.run(set);
    }
    studio.mark("diffuse");
    label("f0");
    if (const auto value = colorField("f0", material.f0, 1.0, 1.0)) {
        model::SetMaterials set;
        set.names = names;
        set.f0 = *value;
        studio.run(set);
    }
    studio.mark("f0");
}

/// The sphere, right of which there is room.
void drawPreview(Studio& studio) {
    if (studio.around.preview == 0) {
        return;
    }
    const float side = 6.0f * ImGui::GetFontSize();
    label("");
    ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(studio.around.preview)),
                 {side, side}, {0.0f, 1.0f}, {1.0f, 0.0f});
    studio.mark("preview");
}

/// What is measured of an estimator, or nothing.
const EstimateLine* lineOf(const Studio& studio, const std::string& name) {
    const std::vector<EstimateLine>& lines = studio.around.accuracy.lines;
    const auto found = std::find_if(lines.begin(), lines.end(),
                                    [&](const EstimateLine& line) { return line.name == name; });
    return found != lines.end() ? &*found : nullptr;
}

/// "error 2.1 %, 34 ms a megapixel", in a row that it has from the first.
void drawMeasured(Studio& studio, const EstimateLine* line, const std::string& of) {
    label("");
    const bool known = line != nullptr && line->error && line->ms;
    elidedText(kDimText,
               of + (known ? "error " + percentText(line->error) + ", " +
                                 millisecondsText(line->ms) + " a megapixel"
                           : std::string("measuring ...")),
               ImGui::GetContentRegionAvail().x);
    studio.mark("measured");
}

void drawChoice(Studio& studio, const std::string& name, bool chosen,
                const std::vector<std::string>& names) {
    const EstimateLine* line = lineOf(studio, name);
    if (ImGui::Selectable(name.c_str(), chosen)) {
        model::SetMaterials set;
        set.names = names;
        set.specular = name;
        studio.runOnce(set);
    }
    studio.mark("estimator/" + name);
    if (line != nullptr) {
        const float em = ImGui::GetFontSize();
        ImGui::SameLine(6.0f * em);
        ImGui::TextColored(kDimText, "%s", percentText(line->error).c_str());
        ImGui::SameLine(9.5f * em);
        ImGui::TextColored(kDimText, "%s", millisecondsText(line->ms).c_str());
    }
}

void drawEstimator(Studio& studio, const MaterialLine& material,
                   const std::vector<std::string>& names) {
    const AccuracyView& accuracy = studio.around.accuracy;
    if (!accuracy.material.empty() && !accuracy.selectable) {
        label("estimator");
        ImGui::PushTextWrapPos();
        ImGui::TextColored(kDimText,
                           "Skies and suns are read from their own maps: no choice here.");
        ImGui::PopTextWrapPos();
        studio.mark("no estimator");
        drawMeasured(studio, lineOf(studio, "rsrm"), {});
        return;
    }
    label("estimator");
    const bool open = ImGui::BeginCombo(
        "##estimator", material.specular.empty() ? "the frame's" : material.specular.c_str());
    studio.mark("estimator");
    if (open) {
        if (ImGui::Selectable("the frame's", material.specular.empty())) {
            studio.runOnce(model::ResetMaterials{names, model::MaterialField::Specular |
                                                            model::MaterialField::Tolerance});
        }
        for (const std::string& name : studio.around.estimators) {
            drawChoice(studio, name, name == material.specular, names);
        }
        ImGui::EndCombo();
    }
    const auto used = std::find_if(accuracy.lines.begin(), accuracy.lines.end(),
                                   [](const EstimateLine& line) { return line.used; });
    const std::string worst = names.size() > 1 ? accuracy.material + ": " : "";
    if (!accuracy.material.empty()) {
        drawMeasured(studio, used != accuracy.lines.end() ? &*used : nullptr, worst);
    }
}

} // namespace

void drawMaterialPanel(Studio& studio) {
    const std::vector<std::string>& names = studio.model.selection().materials;
    if (names.empty()) {
        return;
    }
    const auto& all = studio.around.materials;
    const auto shown = std::find_if(all.begin(), all.end(), [&](const MaterialLine& line) {
        return line.key == names.front();
    });
    if (shown == all.end()) {
        return;
    }
    heading(names.size() == 1
                ? ("Material " + names.front()).c_str()
                : (std::to_string(names.size()) + " materials, shown: " + names.front()).c_str());
    const std::vector<std::string> chosen = names; // a command may change the selection
    drawPreview(studio);
    drawExponent(studio, *shown, chosen);
    drawReflectances(studio, *shown, chosen);
    drawEstimator(studio, *shown, chosen);
    if (studio.model.document().materials.count(shown->key) > 0) {
        label("");
        if (button(studio, "As in the scene's file", "")) {
            studio.runOnce(model::ResetMaterials{chosen});
        }
    }
}

} // namespace lodestar::ui
