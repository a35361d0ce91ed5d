// SPDX-License-Identifier: MIT
//
// What a renderer keeps from frame to frame, for its own sources alone.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "gl/timer.h"
#include "scene/frame_planner.h"
#include "scene/gpu_deformation.h"
#include "scene/gpu_environment.h"
#include "scene/gpu_lights.h"
#include "scene/gpu_probes.h"
#include "scene/gpu_scene.h"
#include "scene/light_state.h"
#include "scene/presenter.h"
#include "scene/probe_observer.h"
#include "scene/renderer.h"
#include "scene/scene_drawer.h"
#include "scene/shadow_maps.h"
#include "scene/uniform_block.h"

namespace lodestar::scene {

struct Renderer::State {
    /// What shines from afar, on every renderer that was made beside another.
    struct DistantLight {
        GpuEnvironment environment;
        GpuLights lights;
    };

    State(gl::Device& glDevice, const Scene& drawn, GpuScene uploaded, GpuDeformation deformed,
          std::shared_ptr<DistantLight> light)
        : device(glDevice), scene(drawn),
          drawer(glDevice, drawn, std::move(uploaded), std::move(deformed)), timer(glDevice),
          frameBlock(glDevice), lightBlock(glDevice), distant(std::move(light)),
          environment(distant->environment), lights(distant->lights), observer(drawn) {}

    gl::Device& device;
    const Scene& scene;
    SceneDrawer drawer;
    gl::Timer timer;
    UniformBlock<blocks::LodestarFrame> frameBlock;
    UniformBlock<blocks::LodestarRsrmLights> lightBlock;
    gl::Framebuffer target;
    FramePlanner planner;
    std::optional<Presenter> presenter;

    std::shared_ptr<DistantLight> distant;
    GpuEnvironment& environment; ///< distant's
    GpuLights& lights;           ///< the same
    ShadowMaps shadows;
    int shadowCount = 0; ///< of the lights that these are for
    ProbeObserver observer;
    GpuProbes probes;
    core::Tally probeWarnings;
    bool forecastAwaited = false; ///< some draw's estimator is still to be chosen

    /// What becomes of a tile that `target` holds: x, y, width, height in pixels from the top left.
    using TileSink = std::function<void(const glm::ivec4&)>;
    /// All of a frame but what becomes of its pixels.
    core::Result<Frame> drawFrame(const View& view, const RenderSettings& settings,
                                  const std::function<TileSink(Frame&)>& sinkFor);
    /// Draws into each tile of a picture. @param block of all tiles but for their projection
    /// @param milliseconds of the GPU's time, to be added to
    core::Result<void> drawTiles(const View& view, const RenderSettings& settings,
                                 blocks::LodestarFrame block,
                                 const std::function<void(const blocks::LodestarFrame&)>& drawTile,
                                 const TileSink& sink, double& milliseconds);
    void chooseEstimators(bool wait, plan::PlanInput& input);
    /// Where there are light probes, the factor that their half floats are written with.
    void setWritten() {
        if (!observer.empty()) {
            probes.setWritten(writtenFactor(scene, environment, lights));
        }
    }
    [[nodiscard]] std::shared_ptr<const plan::EffectPlan> planFrame(const View& view,
                                                                    const RenderSettings& settings);
    core::Result<void> drawShadows(const plan::EffectPlan& plan, const RenderSettings& settings,
                                   const plan::PlanInput& input);
    void bindLight(const RenderSettings& settings, const blocks::LodestarFrame& block);
    core::Result<void> drawProbes(const plan::EffectPlan& plan, const RenderSettings& settings,
                                  const plan::PlanInput& input);
    core::Result<void> prepareReference(const plan::EffectPlan& plan,
                                        const RenderSettings& settings, int taps);
    [[nodiscard]] blocks::LodestarFrame frameBlockFor(const RenderSettings& settings,
                                                      const glm::vec4& camera) const;
};

} // namespace lodestar::scene
