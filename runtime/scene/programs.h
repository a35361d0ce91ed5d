// SPDX-License-Identifier: MIT
//
// The renderer's programs, one for each set of features and estimators that a plan has named.
#pragma once

#include <map>
#include <vector>

#include "gl/program.h"
#include "plan/effect_plan.h"
#include "scene/renderer.h"

namespace lodestar::scene {

/// Binding points of the uniform blocks, shared by all programs.
enum BlockBinding : unsigned {
    kFrameBinding,
    kMaterialBinding,
    kRsrmBinding,
    kFirstProbeBinding,
    kSecondProbeBinding
};

/// What of a light probe's level 0 a composition writes.
enum class CompositionPart { Whole, Geometry, Sky };

/// The parts of a probe's light. @param ratio the sky's is kept apart
[[nodiscard]] std::vector<CompositionPart> partsOf(bool ratio);

/// A program and where it takes the place of a batch's first instance, -1 where it has none.
struct MeshProgram {
    gl::Program program;
    int firstInstance = -1;
};

/// The macros of shading text by which the two terms are estimated.
[[nodiscard]] gl::Defines estimatorDefines(const lighting::Estimator& specular,
                                           const lighting::Estimator& diffuse);

class Programs {
public:
    explicit Programs(gl::Device& device) : device_(&device) {}

    /// Compiles what a plan's draws and backdrop need and is not there yet.
    /// @errors Internal: a shader that the driver refuses
    /// @param input that the plan was made from
    [[nodiscard]] core::Result<void> compile(const plan::PlanInput& input,
                                             const plan::EffectPlan& plan,
                                             const RenderSettings& settings);

    /// @pre compiled
    [[nodiscard]] const MeshProgram& mesh(plan::Features features, const plan::EffectPlan& plan,
                                          const RenderSettings& settings) const;
    /// The same with the environment by many taps, LODESTAR_REFERENCE.
    [[nodiscard]] const MeshProgram& reference(plan::Features features,
                                               const plan::EffectPlan& plan,
                                               const RenderSettings& settings) const;
    /// Compiles those of a plan's draws. @errors as compile
    [[nodiscard]] core::Result<void> compileReferences(const plan::EffectPlan& plan,
                                                       const RenderSettings& settings);
    [[nodiscard]] const gl::Program& backdrop(const plan::EffectPlan& plan) const;
    /// How much probes see of suns. @pre compiled, where the plan has lights
    [[nodiscard]] const gl::Program& seenSuns() const;
    /// Composes what stands behind a probe's captured geometry.
    [[nodiscard]] const gl::Program& composition(const plan::EffectPlan& plan,
                                                 CompositionPart part) const;
    /// Depth alone, of a caster with these features.
    [[nodiscard]] const MeshProgram& depth(plan::Features features, const plan::EffectPlan& plan,
                                           const RenderSettings& settings) const;

private:
    using Variants = std::map<gl::Defines, MeshProgram>;
    [[nodiscard]] core::Result<void> add(Variants& variants, const char* vertexFile,
                                         const char* fragmentFile, const gl::Defines& defines);

    gl::Device* device_;
    Variants meshes_, references_, depths_, backdrops_, compositions_, suns_;
};

} // namespace lodestar::scene
