// SPDX-License-Identifier: MIT
//
// Draws the batches of a plan: into the picture, a sun's depths, or a face of a light probe.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "plan/effect_plan.h"
#include "scene/draw_list.h"
#include "scene/gpu_batches.h"
#include "scene/gpu_deformation.h"
#include "scene/gpu_scene.h"
#include "scene/programs.h"
#include "scene/renderer.h"

namespace lodestar::scene {

class GpuProbes;

class SceneDrawer {
public:
    SceneDrawer(gl::Device& device, const Scene& scene, GpuScene gpu, GpuDeformation deformation);

    [[nodiscard]] const std::vector<DrawItem>& items() const { return items_; }
    [[nodiscard]] GpuDeformation& deformation() { return deformation_; }
    [[nodiscard]] const GpuScene& uploaded() const { return gpu_; }

    /// Numbers or colours of the scene's materials have changed.
    void forgetMaterials() { materials_.forget(); }
    /// Uploads what a plan's draws need and has changed, and says where their instances stand.
    void prepare(const plan::EffectPlan& plan, const RenderSettings& settings);
    /// @errors Internal: a shader that the driver refuses
    [[nodiscard]] core::Result<void> compile(const plan::PlanInput& input,
                                             const plan::EffectPlan& plan,
                                             const RenderSettings& settings) {
        return programs_.compile(input, plan, settings);
    }

    /// @errors as compile
    [[nodiscard]] core::Result<void> compileReferences(const plan::EffectPlan& plan,
                                                       const RenderSettings& settings) {
        return programs_.compileReferences(plan, settings);
    }

    [[nodiscard]] const Programs& programs() const { return programs_; }

    /// To be called where a pass begins: its target is bound, but no texture and no draw state.
    void begin();
    /// The picture: what is opaque, the backdrop, what is blended.
    void drawPicture(const plan::EffectPlan& plan, const RenderSettings& settings,
                     const GpuProbes& probes);
    /// Its draws without a backdrop. @param reference with the environment by many taps: compiled
    void drawSurfaces(const plan::EffectPlan& plan, const RenderSettings& settings,
                      const GpuProbes& probes, bool reference);
    /// Those that a face of a probe sees. @param face into EffectPlan::probeFaces
    void drawFace(const plan::EffectPlan& plan, std::size_t face, const RenderSettings& settings,
                  const GpuProbes& probes);
    /// The depths of all casters.
    void drawCasters(const plan::EffectPlan& plan, const plan::PlanInput& input,
                     const RenderSettings& settings);

private:
    void drawBackdrop(const plan::EffectPlan& plan);

    /// What a pass draws.
    struct Pass {
        std::span<const std::size_t> order;
        std::span<const plan::Features> features; ///< in its order
        std::span<const plan::ProbeChoice> choices;
        std::size_t before = 0; ///< instances that stand before the order's first
        bool reference = false; ///< by the reference's programs
    };
    /// What it has set so far.
    struct PassState {
        const MeshProgram* program = nullptr;
        plan::Features features = 0;
        const io::GltfMaterial* material = nullptr;
        const gl::VertexArray* vertices = nullptr;
        const plan::ProbeChoice* probes = nullptr; ///< bound
        std::optional<bool> twoSided, mirrored;
    };

    void placeInstances(const plan::EffectPlan& plan);
    void place(std::span<const std::size_t> order, std::span<const plan::ProbeChoice> choices,
               std::vector<Instance>& placed) const;
    void use(const MeshProgram& program, std::size_t instance);
    void drawBatch(const Pass& pass, const plan::Batch& batch, const plan::EffectPlan& plan,
                   const RenderSettings& settings, const GpuProbes& probes, PassState& state);
    void drawInstances(std::size_t index, const plan::Batch& batch, PassState& state);

    gl::Device& device_;
    const Scene& scene_;
    GpuScene gpu_;
    std::vector<DrawItem> items_;
    GpuDeformation deformation_;
    gl::VertexArray fullScreen_;
    GpuInstances instances_;
    GpuMaterials materials_;
    Programs programs_;
    std::vector<std::size_t> firstInstances_; ///< of each of the plan's probe faces
};

} // namespace lodestar::scene
