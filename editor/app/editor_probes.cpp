// SPDX-License-Identifier: MIT
//
// How the editor's scene follows the document's light probes, and what the panels see of them.
#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "app/command.h"
#include "app/editor.h"

namespace lodestar::app {
namespace {

/// Which of a document's probes each of a scene's is, in the order of the scene's nodes.
std::vector<int> probesShown(const document::Document& document, const scene::Scene& scene) {
    std::vector<int> shown;
    std::vector<bool> taken(document.probes.size(), false);
    for (const scene::Node& node : scene.nodes) {
        for (const scene::Component& component : node.components) {
            const auto* probe = std::get_if<scene::ProbeComponent>(&component);
            if (probe == nullptr) {
                continue;
            }
            std::size_t i = 0;
            while (i < taken.size() && (taken[i] || document.probes[i].probe != probe->probe)) {
                ++i;
            }
            shown.push_back(i < taken.size() ? static_cast<int>(i) : -1);
            if (i < taken.size()) {
                taken[i] = true;
            }
        }
    }
    return shown;
}

} // namespace

void Editor::syncProbes() {
    core::Tally warnings;
    const OpenedDocument opened{file_.path().string(), model_.document(), {}, {}};
    if (auto set = setDocumentProbes(opened, *shown_.scene, probeMaps_, warnings); !set) {
        workspace_.say(set.error().message(), true);
        return;
    }
    if (warnings.counts() != probeWarnings_.counts()) { // once, not with every step of a drag
        for (const auto& [text, count] : warnings.counts()) {
            workspace_.say(text, true);
        }
        probeWarnings_ = std::move(warnings);
    }
    shown_.renderer->probesChanged();
    shownProbes_ = probesShown(model_.document(), *shown_.scene);
    describeScene();
}

void Editor::describeProbes() {
    const std::vector<document::Probe>& written = model_.document().probes;
    std::vector<ui::ProbeLine> lines(written.size());
    std::size_t next = 0;
    for (const scene::Node& node : shown_.scene->nodes) {
        for (const scene::Component& component : node.components) {
            const auto* probe = std::get_if<scene::ProbeComponent>(&component);
            if (probe == nullptr || next >= shownProbes_.size()) {
                continue;
            }
            const std::size_t index = next++;
            if (shownProbes_[index] < 0) {
                continue;
            }
            ui::ProbeLine& line = lines[static_cast<std::size_t>(shownProbes_[index])];
            line.shown = true;
            line.ready = shown_.renderer->isProbeReady(index);
            line.progress = shown_.renderer->probeProgress(index);
            line.worldFromProbe =
                glm::translate(node.worldFromNode, glm::vec3(probe->probe.position));
        }
    }
    if (lines != around_.probes) {
        around_.probes = std::move(lines);
        session_.wake();
    }
    const glm::mat4 clip = view().clipFromWorld();
    if (clip != around_.clipFromWorld) {
        around_.clipFromWorld = clip;
        session_.wake();
    }
}

} // namespace lodestar::app
