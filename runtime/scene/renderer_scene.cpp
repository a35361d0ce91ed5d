// SPDX-License-Identifier: MIT
//
// What a renderer is told of its scene and its light, and what it tells of its light probes.
#include "scene/renderer_state.h"

namespace lodestar::scene {

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() = default;

core::Result<std::unique_ptr<Renderer>> Renderer::make(gl::Device& device, const Scene& scene) {
    auto uploaded = GpuScene::make(device, scene);
    if (!uploaded) {
        return uploaded.error();
    }
    auto deformation = GpuDeformation::make(device, scene, drawItems(scene));
    if (!deformation) {
        return deformation.error();
    }
    auto state =
        std::make_unique<State>(device, scene, std::move(*uploaded), std::move(*deformation),
                                std::make_shared<State::DistantLight>());
    if (!state->observer.empty()) {
        state->probeWarnings.add("material's emission outside [0, 1e9], repaired in light probes",
                                 brokenEmissions(scene));
    }
    return std::unique_ptr<Renderer>(new Renderer(std::move(state)));
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
