// SPDX-License-Identifier: MIT
//
// How a renderer is made, what it is told of its scene and its light, and what it tells of its
// light probes.
#include "scene/renderer_state.h"

namespace lodestar::scene {

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() = default;

core::Result<std::unique_ptr<Renderer>> Renderer::make(gl::Device& device, const Scene& scene) {
    RendererUpload upload(device, scene);
    for (;;) {
        auto made = upload.step();
        if (!made || *made) {
            return made;
        }
    }
}

struct RendererUpload::Parts {
    Parts(gl::Device& glDevice, const Scene& drawn,
          std::shared_ptr<Renderer::State::DistantLight> light)
        : device(glDevice), scene(drawn), distant(std::move(light)), textures(texturesOf(drawn)) {}

    gl::Device& device;
    const Scene& scene;
    std::shared_ptr<Renderer::State::DistantLight> distant;
    std::vector<TextureUse> textures;
    std::optional<GpuScene> uploaded; ///< once there are its vertices
    std::size_t next = 0;             ///< of the textures
};

RendererUpload::RendererUpload(gl::Device& device, const Scene& scene, const Renderer* light)
    : parts_(std::make_unique<Parts>(device, scene,
                                     light != nullptr
                                         ? light->state_->distant
                                         : std::make_shared<Renderer::State::DistantLight>())) {}
RendererUpload::~RendererUpload() = default;

core::Result<std::unique_ptr<Renderer>> RendererUpload::step() {
    Parts& parts = *parts_;
    if (!parts.uploaded) {
        parts.uploaded.emplace(parts.device, parts.scene);
        return std::unique_ptr<Renderer>();
    }
    if (parts.next < parts.textures.size()) {
        if (auto added =
                parts.uploaded->addTexture(parts.device, parts.scene, parts.textures[parts.next++]);
            !added) {
            return added.error();
        }
        return std::unique_ptr<Renderer>();
    }
    auto deformation = GpuDeformation::make(parts.device, parts.scene, drawItems(parts.scene));
    if (!deformation) {
        return deformation.error();
    }
    using State = Renderer::State;
    auto state = std::make_unique<State>(parts.device, parts.scene, std::move(*parts.uploaded),
                                         std::move(*deformation), parts.distant);
    if (!state->observer.empty()) {
        state->probeWarnings.add("material's emission outside [0, 1e9], repaired in light probes",
                                 brokenEmissions(parts.scene));
    }
    return std::unique_ptr<Renderer>(new Renderer(std::move(state)));
}

double RendererUpload::share() const {
    const std::size_t done = (parts_->uploaded ? 1 : 0) + parts_->next;
    return static_cast<double>(done) / static_cast<double>(parts_->textures.size() + 2);
}

core::Result<std::unique_ptr<Renderer>> Renderer::makeBeside(gl::Device& device, const Scene& scene,
                                                             const Renderer& other) {
    auto deformation = GpuDeformation::make(device, scene, drawItems(scene));
    if (!deformation) {
        return deformation.error();
    }
    GpuScene uploaded = GpuScene::makeBeside(device, scene, other.state_->drawer.uploaded());
    return std::unique_ptr<Renderer>(new Renderer(std::make_unique<State>(
        device, scene, std::move(uploaded), std::move(*deformation), other.state_->distant)));
}

void Renderer::setEnvironment(std::string source, lighting::Cubemap base) {
    state_->environment = GpuEnvironment(std::move(source), std::move(base));
    state_->planner.forgetDraws(); // estimators are chosen for this map
    state_->setWritten();
}

void Renderer::setLights(std::vector<lighting::DayLight> lights,
                         const lighting::RsrmLayout& layout) {
    GpuLights set(std::move(lights), layout, state_->lights.kernels());
    set.keep(std::move(state_->lights));
    state_->lights = std::move(set);
    state_->setWritten();
}

void Renderer::materialsChanged() {
    state_->drawer.forgetMaterials();
    state_->planner.forgetDraws();
    for (std::size_t i = 0; i < state_->observer.count(); ++i) {
        state_->observer.request(i); // what they hold shows the materials as they were
    }
    state_->setWritten();
}

void Renderer::probesChanged() {
    state_->probes.keep(state_->observer.rescan());
    state_->setWritten();
}

const core::Tally& Renderer::lightWarnings() const {
    return state_->lights.warnings();
}

bool Renderer::awaitsForecast() const {
    return state_->forecastAwaited;
}

std::size_t Renderer::probeCount() const {
    return state_->observer.count();
}

const std::string& Renderer::probeName(std::size_t probe) const {
    return state_->observer.probe(probe).name;
}

void Renderer::requestProbe(std::size_t probe) {
    state_->observer.request(probe);
}

bool Renderer::isProbeReady(std::size_t probe) const {
    return state_->observer.isReady(probe);
}

double Renderer::probeProgress(std::size_t probe) const {
    return state_->observer.progress(probe);
}

core::Image Renderer::readProbe(std::size_t probe, int face, int level) const {
    return state_->probes.read(probe, face, level);
}

const core::Tally& Renderer::probeWarnings() const {
    return state_->probeWarnings;
}

} // namespace lodestar::scene
