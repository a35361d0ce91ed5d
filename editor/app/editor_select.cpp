// SPDX-License-Identifier: MIT
//
// What a click on the editor's picture selects, and where what is selected lies.
#include <algorithm>

#include "app/editor.h"
#include "app/scene_pick.h"

namespace lodestar::app {
namespace {

bool below(const std::vector<scene::Node>& nodes, int node, int ancestor) {
    while (node >= 0 && node != ancestor) {
        node = nodes[static_cast<std::size_t>(node)].parent;
    }
    return node == ancestor;
}

} // namespace

void Editor::select(const glm::ivec2& pixel, bool more) {
    const scene::View seen = view();
    const glm::mat4 worldFromClip = glm::inverse(seen.clipFromWorld());
    const glm::vec2 clip(
        2.0f * (static_cast<float>(pixel.x) + 0.5f) / static_cast<float>(settings_.width) - 1.0f,
        1.0f - 2.0f * (static_cast<float>(pixel.y) + 0.5f) / static_cast<float>(settings_.height));
    const glm::vec4 near = worldFromClip * glm::vec4(clip, -1.0f, 1.0f);
    const glm::vec4 far = worldFromClip * glm::vec4(clip, 1.0f, 1.0f);
    const glm::vec3 from = glm::vec3(near) / near.w;
    const auto met = firstMet(*shown_.scene, from, glm::vec3(far) / far.w - from);
    model::Selection selection = model_.selection();
    std::vector<std::string>& chosen = selection.materials;
    if (!more) {
        chosen.clear();
    }
    const int material = met ? shown_.scene->meshes[static_cast<std::size_t>(met->mesh)]
                                   .primitives[met->primitive]
                                   .material
                             : io::kNone;
    if (material != io::kNone && static_cast<std::size_t>(material) < around_.materials.size()) {
        const std::string& key = around_.materials[static_cast<std::size_t>(material)].key;
        const auto place = std::find(chosen.begin(), chosen.end(), key);
        place == chosen.end() ? void(chosen.push_back(key)) : void(chosen.erase(place));
    }
    workspace_.view().node = met ? static_cast<int>(met->node) : -1;
    model_.select(selection);
    session_.wake();
}

scene::Bounds Editor::selectedBounds() const {
    const model::Selection& selection = model_.selection();
    const int chosen = workspace_.view().node;
    const auto has = [&](int material) {
        return material != io::kNone && chosen < 0 &&
               std::find(selection.materials.begin(), selection.materials.end(),
                         around_.materials[static_cast<std::size_t>(material)].key) !=
                   selection.materials.end();
    };
    scene::Bounds bounds;
    const std::vector<scene::Node>& nodes = shown_.scene->nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const bool inside = chosen >= 0 && below(nodes, static_cast<int>(n), chosen);
        for (const scene::Component& component : nodes[n].components) {
            const auto* mesh = std::get_if<scene::MeshComponent>(&component);
            if (mesh == nullptr) {
                continue;
            }
            const auto& primitives =
                shown_.scene->meshes[static_cast<std::size_t>(mesh->mesh)].primitives;
            for (std::size_t p = 0; p < primitives.size(); ++p) {
                if (inside || has(primitives[p].material)) {
                    bounds.add(scene::primitiveWorldBounds(*shown_.scene, nodes[n], *mesh, p));
                }
            }
        }
    }
    for (const model::Id id : selection.probes) {
        const auto index = model::findProbe(model_.ids(), id);
        if (index && *index < around_.probes.size() && around_.probes[*index].shown) {
            const lighting::Probe& probe = model_.document().probes[*index].probe;
            const auto placed = lighting::place(
                probe.influence, around_.probes[*index].worldFromProbe, !probe.exterior);
            if (placed) {
                bounds.add(scene::Bounds{placed->low, placed->high});
            }
        }
    }
    return bounds.empty() ? shown_.bounds : bounds;
}

} // namespace lodestar::app
