// SPDX-License-Identifier: MIT
//
// The renderer's programs, one for each set of features and estimators that a plan has named.
#pragma once

#include <map>

#include "gl/program.h"
#include "plan/effect_plan.h"
#include "scene/renderer.h"

namespace lodestar::scene {

/// Binding points of the uniform blocks, shared by all programs.
enum BlockBinding : unsigned { kFrameBinding, kDrawBinding, kMaterialBinding };

class Programs {
public:
    explicit Programs(gl::Device& device) : device_(&device) {}

    /// Compiles what a plan's draws and backdrop need and is not there yet.
    /// @errors Internal: a shader that the driver refuses
    [[nodiscard]] core::Result<void> compile(const plan::EffectPlan& plan,
                                             const RenderSettings& settings);

    /// @pre compiled
    [[nodiscard]] const gl::Program& mesh(plan::Features features,
                                          const RenderSettings& settings) const;
    [[nodiscard]] const gl::Program& backdrop() const { return backdrop_; }

private:
    [[nodiscard]] core::Result<void> compileMesh(const gl::Defines& defines);

    gl::Device* device_;
    std::map<gl::Defines, gl::Program> meshes_;
    gl::Program backdrop_;
};

} // namespace lodestar::scene
