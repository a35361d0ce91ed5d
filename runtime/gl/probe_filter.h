// SPDX-License-Identifier: MIT
//
// What shading reads of a light probe, made from level 0 of its cube in passes, without a
// read-back: tent mips whose coarse levels are round, and a tile of irradiance. Move-only.
#pragma once

#include <vector>

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
    /// The same, and a tile of irradiance over pi by nine coefficients of the coarsest of its
    /// tents that is made: of 17 to 32 texels if levels are made so far.
    void fill(const Texture& cube, int lastLevel, IrradianceAtlas& atlas, int tile);
    /// The value of the uniform uHalfStep of shaders/host/probe_half.glsl on this driver.
    [[nodiscard]] unsigned halfStep() const { return halfStep_; }

private:
    ProbeFilter() = default;
    struct Pass {
        Program program;
        int uniform = -1; ///< what a draw gives it
    };
    /// A round level, the level that it is read from, and its rows of fetches_.
    struct RoundLevel {
        int level = 0;
        int source = 0;
        int firstRow = 0;
        int endRow = 0;
    };
    [[nodiscard]] core::Result<void> measureHalfStep();
    [[nodiscard]] core::Result<Pass> makePass(const char* fragment, const char* vertex,
                                              const Defines& defines) const;
    [[nodiscard]] core::Result<void> makePasses();
    void beginLevel(const Texture& cube, int level);
    void begin(const Texture& cube);
    void end(const Texture& cube);
    void prepareRound(const Texture& cube);
    int makeTents(const Texture& cube, int lastLevel);
    void makeRound(const Texture& cube, int lastLevel);
    void tent(const Texture& cube, int level);
    void round(const Texture& cube, const RoundLevel& level);
    void fillIrradiance(const Texture& cube, int level, IrradianceAtlas& atlas, int tile);

    Device* device_ = nullptr;
    Pass tent_, oddTent_, round_, sh9_, irradiance_;
    unsigned halfStep_ = 0;
    VertexArray fullScreen_;
    unsigned faces_ = 0;                  ///< framebuffer of a level's six faces
    unsigned oneLevel_ = 0;               ///< sampler; a driver mixes no levels where one is read
    unsigned sums_ = 0;                   ///< framebuffer of parts_
    Texture parts_;                       ///< of nine coefficients
    Texture fetches_;                     ///< of the round levels of cubes of a width
    int fetchesWidth_ = 0;                ///< that width
    std::vector<RoundLevel> roundLevels_; ///< finest first
};

} // namespace lodestar::gl
