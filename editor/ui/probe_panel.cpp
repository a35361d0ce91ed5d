// SPDX-License-Identifier: MIT
#include "ui/panels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <imgui_stdlib.h>

#include "ui/fields.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

constexpr double kFar = 1e6;       ///< metres that a field reaches
constexpr double kThinnest = 1e-3; ///< metres: a volume has an inside
constexpr double kMostLight = 1e9; ///< of a tint or intensity
constexpr int kWidestCapture = 16384;

/// Three numbers in a row. @return whether one was changed
bool vectorField(Studio& studio, const char* name, glm::dvec3& value, double least, double most) {
    label(name);
    const bool changed =
        numbersField((std::string("##") + name).c_str(), value, 0.02f, least, most);
    studio.mark(std::string("probe ") + name);
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("x, y, z in metres");
    }
    return changed;
}

bool scalarField(Studio& studio, const char* name, double& value, float speed, double least,
                 double most, const char* format) {
    label(name);
    const auto typed =
        numberField((std::string("##") + name).c_str(), value, speed, least, most, format);
    studio.mark(std::string("probe ") + name);
    value = typed.value_or(value);
    return typed.has_value();
}

bool countField(Studio& studio, const char* name, int& value, int least, int most) {
    double number = value;
    const bool changed = scalarField(studio, name, number, 0.2f, least, most, "%.0f");
    value = static_cast<int>(std::lround(number));
    return changed;
}

bool textField(Studio& studio, const char* name, const char* hint, std::string& value) {
    label(name);
    const bool entered = ImGui::InputTextWithHint((std::string("##") + name).c_str(), hint, &value,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    studio.mark(std::string("probe ") + name);
    return entered;
}

/// Which of the scene's named nodes carries it.
bool nodeField(Studio& studio, lighting::Probe& probe) {
    label("at node");
    const bool open =
        ImGui::BeginCombo("##node", probe.node.empty() ? "the world" : probe.node.c_str());
    studio.mark("probe node");
    bool changed = false;
    if (open) {
        if (ImGui::Selectable("the world", probe.node.empty())) {
            probe.node.clear();
            changed = true;
        }
        for (const NodeLine& node : studio.around.nodes) {
            if (node.named && node.holds != "probe" &&
                ImGui::Selectable(node.name.c_str(), node.name == probe.node)) {
                probe.node = node.name;
                changed = true;
            }
        }
        ImGui::EndCombo();
    }
    return changed;
}

bool volumeFields(Studio& studio, const char* name, lighting::ProbeVolume& volume, bool blends) {
    constexpr std::array<const char*, 2> kShapes = {"box", "sphere"};
    ImGui::PushID(name);
    label(name);
    const auto shape =
        choiceField(studio, "##shape", static_cast<std::size_t>(volume.shape), kShapes);
    if (shape) {
        volume.shape = static_cast<lighting::VolumeShape>(*shape);
    }
    bool changed = shape.has_value();
    changed = vectorField(studio, "center", volume.center, -kFar, kFar) || changed;
    if (volume.shape == lighting::VolumeShape::Box) {
        changed = vectorField(studio, "size", volume.size, kThinnest, kFar) || changed;
    } else if (scalarField(studio, "diameter", volume.size.x, 0.02f, kThinnest, kFar, "%.4g m")) {
        volume.size = glm::dvec3(volume.size.x);
        changed = true;
    }
    if (blends && volume.shape == lighting::VolumeShape::Sphere) {
        changed =
            scalarField(studio, "blend", volume.blend[0], 0.01f, 0.0, kFar, "%.4g m") || changed;
    } else if (blends) {
        glm::dvec3 high(volume.blend[0], volume.blend[2], volume.blend[4]);
        glm::dvec3 low(volume.blend[1], volume.blend[3], volume.blend[5]);
        const bool highs = vectorField(studio, "blend at +", high, 0.0, kFar);
        if (vectorField(studio, "blend at -", low, 0.0, kFar) || highs) {
            volume.blend = {high.x, low.x, high.y, low.y, high.z, low.z};
            changed = true;
        }
    }
    ImGui::PopID();
    return changed;
}

bool proxyFields(Studio& studio, lighting::Probe& probe) {
    label("parallax");
    bool corrected = probe.proxy.has_value();
    const bool toggled = ImGui::Checkbox("corrected in a volume", &corrected);
    studio.mark("probe proxy");
    if (toggled) {
        probe.proxy = corrected ? std::optional(probe.influence) : std::nullopt;
        if (probe.proxy) {
            probe.proxy->blend = {};
        }
    }
    return (probe.proxy && volumeFields(studio, "proxy", *probe.proxy, false)) || toggled;
}

bool captureFields(Studio& studio, lighting::Probe& probe) {
    constexpr std::array<const char*, 5> kUpdates = {"once", "on change", "every N frames",
                                                     "always", "on demand"};
    bool changed = textField(studio, "light of", "captured here; or a file", probe.source);
    changed =
        countField(studio, "resolution", probe.capture.resolution, 1, kWidestCapture) || changed;
    if (!probe.source.empty()) {
        return changed;
    }
    label("captured");
    if (const auto update =
            choiceField(studio, "##update", static_cast<std::size_t>(probe.update), kUpdates)) {
        probe.update = static_cast<lighting::ProbeUpdate>(*update);
        changed = true;
    }
    if (probe.update == lighting::ProbeUpdate::Every) {
        changed = countField(studio, "frames", probe.every, 1, 1000000) || changed;
    }
    constexpr std::array<const char*, 2> kRelights = {"composed again", "a factor while shading"};
    label("a tinted sky is");
    if (const auto relight =
            choiceField(studio, "##relight", static_cast<std::size_t>(probe.relight), kRelights)) {
        probe.relight = static_cast<lighting::ProbeRelight>(*relight);
        changed = true;
    }
    const double far = probe.capture.farPlane;
    changed =
        scalarField(studio, "near", probe.capture.nearPlane, 0.005f, 1e-4, 0.999 * far, "%.4g m") ||
        changed;
    return scalarField(studio, "far", probe.capture.farPlane, 1.0f, 1.001 * probe.capture.nearPlane,
                       1e9, "%.4g m") ||
           changed;
}

bool lightFields(Studio& studio, lighting::Probe& probe) {
    bool changed = false;
    label("tint");
    if (const auto tint = colorField("probe tint", probe.tint, kMostLight, 1.0)) {
        probe.tint = *tint;
        changed = true;
    }
    studio.mark("probe tint");
    changed = scalarField(studio, "intensity", probe.intensity, 0.01f, 0.0, kMostLight, "%.4g") ||
              changed;
    changed = countField(studio, "priority", probe.priority, -1000, 1000) || changed;
    label("");
    bool interior = !probe.exterior;
    if (ImGui::Checkbox("interior: no distant light inside", &interior)) {
        probe.exterior = !interior;
        changed = true;
    }
    studio.mark("probe interior");
    return changed;
}

void drawState(Studio& studio, std::size_t index, const lighting::Probe& probe) {
    label("");
    if (index >= studio.around.probes.size() || !studio.around.probes[index].shown) {
        ImGui::TextColored(kWarning, "%s",
                           probe.node.empty() ? "not in the scene yet"
                                              : "the scene has no such node");
        return;
    }
    const ProbeLine& line = studio.around.probes[index];
    if (line.progress < 1.0) {
        ImGui::ProgressBar(static_cast<float>(line.progress), {-1.0f, 0.0f}, "capturing");
    } else if (probe.source.empty()) {
        if (button(studio, "Capture now", "draws its six faces anew")) {
            studio.wishes.captureProbe = index;
        }
        ImGui::SameLine();
        ImGui::TextColored(kDimText, "%s", line.ready ? "it lights" : "nothing needs it");
    } else {
        ImGui::TextColored(kDimText, "%s", line.ready ? "it lights" : "nothing needs it");
    }
}

} // namespace

lighting::Probe firstProbe(const Studio& studio) {
    const glm::dvec3 low(studio.around.low);
    const glm::dvec3 high(studio.around.high);
    lighting::Probe probe;
    probe.name = "probe " + std::to_string(studio.model.document().probes.size() + 1);
    probe.position = 0.5 * (low + high);
    // A little beyond the scene, so that what bounds it is held whole.
    probe.influence.size = 1.2 * glm::max(high - low, glm::dvec3(0.1));
    probe.influence.blend.fill(
        0.1 * std::min({probe.influence.size.x, probe.influence.size.y, probe.influence.size.z}));
    return probe;
}

void drawProbePanel(Studio& studio) {
    const std::vector<model::Id> chosen = studio.model.selection().probes;
    if (chosen.empty()) {
        return;
    }
    const auto index = model::findProbe(studio.model.ids(), chosen.front());
    if (!index) {
        return;
    }
    lighting::Probe probe = studio.model.document().probes[*index].probe;
    heading("Light probe");
    ImGui::PushID("probe");
    bool changed = textField(studio, "name", "", probe.name);
    changed = nodeField(studio, probe) || changed;
    changed = vectorField(studio, "position", probe.position, -kFar, kFar) || changed;
    drawState(studio, *index, probe);
    changed = volumeFields(studio, "influence", probe.influence, true) || changed;
    changed = proxyFields(studio, probe) || changed;
    changed = captureFields(studio, probe) || changed;
    changed = lightFields(studio, probe) || changed;
    ImGui::PopID();
    if (changed) {
        studio.run(model::SetProbe{chosen.front(), probe});
    }
}

} // namespace lodestar::ui
