// SPDX-License-Identifier: MIT
//
// What shading reads of a light probe, made from level 0 of its cube in passes, without a
// read-back: tent mips whose coarse levels are round, and a tile of irradiance. Move-only.
#pragma once

#include "gl/buffer.h"
#include "gl/irradiance_atlas.h"
#include "gl/program.h"
#include "gl/texture.h"

namespace lodestar::gl {

class ProbeFilter {
public:
    /// @errors NoOpenGl, Internal (a shader that the driver refuses)
    [[nodiscard]] static core::Result<ProbeFilter> make(Device& device);
    ProbeFilter(ProbeFilter&& other) noexcept;
    ProbeFilter& operator=(ProbeFilter&& other) noexcept;
    ~ProbeFilter();

    /// Fills levels 1 to a last one, as lighting::tentMips makes them but for sampling: for
    /// lodestar_tentLevel. All channels; every value of level 0 is finite. @pre a cube target
    void fillMips(const Texture& cube, int lastLevel);
    /// The same, and a tile of irradiance over pi by nine coefficients of its tents of 16 texels,
    /// or of the coarsest that is made.
    void fill(const Texture& cube, int lastLevel, IrradianceAtlas& atlas, int tile);
    /// The value of the uniform uHalfStep of shaders/host/probe_half.glsl on this driver.
    [[nodiscard]] unsigned halfStep() const { return halfStep_; }

private:
    ProbeFilter() = default;
    struct Pass {
        Program program;
        int widths = -1; ///< uniforms
        int lobe = -1;
    };
    [[nodiscard]] core::Result<void> measureHalfStep();
    [[nodiscard]] core::Result<Pass> makePass(const char* fragment, bool layered) const;
    [[nodiscard]] core::Result<void> makePasses();
    void beginLevel(const Texture& cube, int level);
    void begin(const Texture& cube);
    int makeTents(const Texture& cube, int lastLevel);
    void makeRound(const Texture& cube, int lastLevel);
    void tent(const Texture& cube, int level);
    void fillIrradiance(const Texture& cube, int level, IrradianceAtlas& atlas, int tile);
    void keepMean(const Texture& cube, int reference, int last);
    void round(const Texture& cube, int level, int source);

    Device* device_ = nullptr;
    Pass tent_, round_, all_, sums_, scale_, multiply_, sh9_, sh9Sum_, irradiance_;
    int tileUniform_ = -1;
    unsigned halfStep_ = 0;
    VertexArray fullScreen_;
    unsigned layers_ = 0; ///< framebuffer of a level's faces
    unsigned small_ = 0;  ///< of the small textures
    Texture means_, scales_, parts_, coefficients_;
};

} // namespace lodestar::gl
