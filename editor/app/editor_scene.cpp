// SPDX-License-Identifier: MIT
//
// The editor's document, and how its scene follows it.
#include <algorithm>
#include <array>
#include <map>
#include <span>

#include <glm/trigonometric.hpp>

#include "app/command.h"
#include "app/editor.h"
#include "lodestar/lobes.glsl"
#include "model/presets.h"

namespace lodestar::app {
namespace {

constexpr double kFirstHour = 17.5;

/// A preset's light of a kind, or nothing.
const document::Light* lightOf(const char* preset, lighting::LightKind kind) {
    for (const model::Preset& known : model::builtInPresets()) {
        for (const document::Light& light : known.lights) {
            if (known.name == preset && light.kind == kind && !light.keys.empty()) {
                return &light;
            }
        }
    }
    return nullptr;
}

/// A light whose keys are presets.
document::Light dayOf(const char* name, lighting::LightKind kind,
                      std::span<const std::pair<double, const char*>> hours) {
    document::Light day;
    day.name = name;
    day.kind = kind;
    for (const auto& [hour, preset] : hours) {
        if (const document::Light* light = lightOf(preset, kind)) {
            day.keys.push_back(light->keys.front());
            day.keys.back().hour = hour;
            day.keys.back().axis.reset();
        }
    }
    return day;
}

/// What a document that says nothing yet is begun with: a day of the presets.
document::Document firstDocument() {
    constexpr std::pair<double, const char*> kSky[] = {
        {0.0, "Night"},        {4.5, "Night"},       {5.5, "Dusk"},
        {7.0, "Golden hour"},  {10.0, "Clear noon"}, {14.5, "Clear noon"},
        {17.5, "Golden hour"}, {19.25, "Dusk"},      {20.5, "Night"}};
    constexpr std::pair<double, const char*> kSun[] = {
        {6.5, "Golden hour"}, {10.0, "Clear noon"}, {14.5, "Clear noon"}, {17.5, "Golden hour"}};
    document::Document document;
    document.lights = {dayOf("sky", lighting::LightKind::Sky, kSky),
                       dayOf("sun", lighting::LightKind::Sun, kSun)};
    // 48 degrees north at the end of April, the camera looking north-west.
    document.lights.back().path = lighting::SunPath{glm::radians(48.0), 118, {0.8, 0.0, -0.6}};
    return document;
}

std::string holdsOf(const scene::Node& node) {
    static constexpr std::array<const char*, 4> kNames = {"mesh", "camera", "light", "probe"};
    std::string text;
    for (const scene::Component& component : node.components) {
        text += (text.empty() ? "" : ", ") + std::string(kNames[component.index()]);
    }
    return text;
}

/// A material as its three Blinn-Phong numbers, textures aside.
ui::MaterialLine lineOf(const io::GltfMaterial& material, std::size_t index) {
    ui::MaterialLine line;
    line.key =
        material.name.empty() ? std::string("#").append(std::to_string(index)) : material.name;
    const glm::vec3 base(material.baseColor);
    if (material.blinnPhong) {
        const io::GltfBlinnPhong& given = *material.blinnPhong;
        line.exponent = static_cast<double>(given.exponent.value_or(0.0f));
        line.diffuse = given.diffuse.value_or(base);
        line.f0 = given.f0.value_or(glm::vec3(0.04f));
    } else {
        line.exponent = static_cast<double>(
            material.exponent.value_or(shader::lodestar_exponentFromRoughness(material.roughness)));
        line.diffuse = material.diffuse.value_or(
            shader::lodestar_diffuseFromMetallic(base, material.metallic));
        line.f0 = material.f0.value_or(shader::lodestar_f0FromMetallic(base, material.metallic));
    }
    if (material.specularEstimator) {
        line.specular = lighting::estimatorName(*material.specularEstimator);
    }
    return line;
}

} // namespace

core::Result<void> Editor::openLightingFile(const std::filesystem::path& path) {
    if (path.empty()) {
        model_.reset(firstDocument());
        workspace_.view().hour = kFirstHour;
        everSynced_ = false;
        return {};
    }
    core::Tally warnings;
    const bool begins = !std::filesystem::exists(path);
    auto file = model::DocumentFile::open(path, model_, warnings, firstDocument());
    if (!file) {
        return file.error();
    }
    warn(warnings, path.string());
    if (begins) {
        workspace_.view().hour = kFirstHour;
    }
    file_ = std::move(*file);
    if (const auto left = file_.recovery()) {
        if (auto recovered = file_.recover(model_, *left); !recovered) {
            workspace_.say(recovered.error().message(), true);
        } else {
            workspace_.say("recovered what was not saved; undo goes back to the file");
        }
    }
    everSynced_ = false;
    session_.wake();
    return {};
}

void Editor::describeScene() {
    around_.sceneName = scenePath_.empty() ? "built-in spheres"
                                           : std::filesystem::path(scenePath_).filename().string();
    around_.nodes.clear();
    std::vector<int> depths;
    const std::vector<scene::Node>& nodes = shown_.scene->nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        depths.push_back(
            nodes[i].parent < 0 ? 0 : depths[static_cast<std::size_t>(nodes[i].parent)] + 1);
        const bool named = !nodes[i].name.empty();
        around_.nodes.push_back(
            {named ? nodes[i].name : std::string("node ").append(std::to_string(i)), depths.back(),
             holdsOf(nodes[i]), named});
    }
}

void Editor::describeMaterials() {
    around_.materials.clear();
    for (std::size_t i = 0; i < shown_.scene->materials.size(); ++i) {
        around_.materials.push_back(lineOf(shown_.scene->materials[i], i));
    }
}

bool Editor::syncDocument() {
    const model::Revisions& revisions = model_.revisions();
    if (everSynced_ && revisions.document == synced_.document) {
        return false;
    }
    if (!everSynced_ || revisions.probes != synced_.probes) {
        syncProbes();
    }
    if (!everSynced_ || revisions.lights != synced_.lights ||
        revisions.environment != synced_.environment) {
        // Which of the two stands in the other's place, both say.
        if (!everSynced_ || revisions.environment != synced_.environment ||
            model_.document().lights.empty() || hasEnvironment_) {
            syncEnvironment();
        }
        syncLights();
    }
    if (!everSynced_ || revisions.materials != synced_.materials) {
        syncMaterials();
    }
    synced_ = revisions;
    everSynced_ = true;
    session_.wake();
    return true;
}

void Editor::syncEnvironment() {
    const OpenedDocument opened{file_.path().string(), model_.document(), {}, {}};
    const bool named = opened.document.environment.has_value();
    if (!named && !opened.document.lights.empty()) {
        if (hasEnvironment_) {
            shown_.renderer->setEnvironment({}, {});
            hasEnvironment_ = false;
            environment_.reset();
        }
        return;
    }
    const DistantLight* light = &shown_.own;
    core::Result<DistantLight> loaded = DistantLight{};
    if (named) {
        loaded = documentEnvironment(opened, io::kDefaultCubeWidth, read_);
        if (!loaded) {
            workspace_.say(loaded.error().message(), true);
        }
        if (!loaded && (hasEnvironment_ || !opened.document.lights.empty())) {
            return; // what shines goes on
        }
        light = loaded ? &*loaded : light;
    }
    shown_.renderer->setEnvironment(light->name, light->environment.base);
    environment_ = std::make_shared<lighting::Cubemap>(light->environment.base);
    hasEnvironment_ = true;
}

void Editor::syncLights() {
    core::Tally warnings;
    auto lights = document::dayLights(model_.document(), warnings);
    if (!lights) {
        workspace_.say(lights.error().message(), true);
        return;
    }
    shown_.renderer->setLights(std::move(*lights), document::mapLayout(model_.document()));
}

void Editor::syncMaterials() {
    core::Tally warnings;
    shown_.scene->materials = shown_.materials;
    applyMaterials(model_.document(), *shown_.scene, warnings);
    shown_.renderer->materialsChanged();
    describeMaterials();
}

} // namespace lodestar::app
