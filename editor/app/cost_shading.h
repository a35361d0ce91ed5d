// SPDX-License-Identifier: MIT
//
// How long lookups take on the GPU that is there: a tile of balls is shaded by each, in turn.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/cost_estimates.h"
#include "core/result.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/timer.h"
#include "scene/gpu_environment.h"
#include "scene/gpu_lights.h"
#include "scene/renderer.h"
#include "scene/uniform_block.h"

namespace lodestar::app {

class CostShading {
public:
    /// Rows of the tile.
    static constexpr int kTileSide = 1024;

    /// @param kernels to share with others that bake maps; null: its own
    /// @errors NoOpenGl if the driver has no memory for the tile
    [[nodiscard]] static core::Result<std::unique_ptr<CostShading>>
    make(gl::Device& device, std::shared_ptr<lighting::RsrmKernels> kernels = nullptr);

    /// Uploads what a lookup reads, in place of what was there. @return bytes of its textures
    /// @param made its parts of `base`, where another thread has made them already; null: made here
    /// @errors NoOpenGl
    [[nodiscard]] core::Result<std::uint64_t>
    prepare(const CostedLookup& lookup, const lighting::Cubemap& base,
            const lighting::PreparedEnvironment* made = nullptr);
    /// The same of all skies and suns that shine at an hour, as a frame is lit by them.
    /// @param lights as lighting::repaired leaves them  @param layout of their maps  @errors
    /// NoOpenGl
    [[nodiscard]] core::Result<void> prepare(const std::vector<lighting::DayLight>& lights,
                                             const lighting::RsrmLayout& layout, double hour);
    /// Shades by another lookup that reads what the last one prepared: an estimator over the same
    /// mips.
    void use(const CostedLookup& lookup) { lookup_ = lookup; }
    /// Milliseconds a megapixel of one drawing of the tile's lowest rows, in which a frame's time
    /// is spent no longer than it may. @param rows [1, kTileSide]  @errors as milliseconds
    [[nodiscard]] core::Result<double> slice(double exponent, int rows);
    /// Milliseconds a megapixel of a tile shaded by what was prepared last: the least of a few
    /// repeats. @param exponent Blinn-Phong  @errors Internal (a shader that the driver refuses)
    [[nodiscard]] core::Result<double> milliseconds(double exponent, int repeats);
    /// The same of a tile lit directly by kCostedLights lights. @pre prepare
    [[nodiscard]] core::Result<double> lobeMilliseconds(lighting::LobeForm lobes,
                                                        lighting::FresnelForm fresnel,
                                                        double exponent, int repeats);
    /// The same of a tile without a lookup.
    [[nodiscard]] core::Result<double> emptyMilliseconds(int repeats);

private:
    explicit CostShading(gl::Device& device);
    [[nodiscard]] core::Result<const gl::Program*> program(const gl::Defines& defines);
    [[nodiscard]] gl::Defines definesFor(double exponent) const;
    /// A frame of a ball under the maps.
    [[nodiscard]] plan::EffectPlan planned(double exponent) const;
    [[nodiscard]] core::Result<double> timed(const gl::Defines& defines, double exponent,
                                             int repeats);
    /// Milliseconds of one drawing.
    [[nodiscard]] core::Result<double> drawn(const gl::Defines& defines, double exponent, int rows);

    gl::Device& device_;
    gl::Framebuffer target_;
    gl::VertexArray vertices_;
    gl::Timer timer_;
    std::map<gl::Defines, gl::Program> programs_;
    scene::UniformBlock<scene::blocks::LodestarFrame> frameBlock_;
    scene::UniformBlock<scene::blocks::LodestarRsrmLights> lightBlock_;
    scene::GpuEnvironment environment_;
    std::shared_ptr<lighting::RsrmKernels> kernels_ = std::make_shared<lighting::RsrmKernels>();
    scene::GpuLights lights_; ///< empty: the environment is read
    std::vector<plan::RsrmLightView> views_;
    CostedLookup lookup_;
};

} // namespace lodestar::app
