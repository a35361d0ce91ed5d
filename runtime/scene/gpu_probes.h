// SPDX-License-Identifier: MIT
//
// Light probes on the GPU. Of each: what was captured (a cube, premultiplied by coverage), what
// lights (the same before the sky, with its mips) and a tile of irradiance. Faces that are drawn
// anew wait in a cube that all probes of a size share, until all have been drawn.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "gl/buffer.h"
#include "gl/face_target.h"
#include "gl/probe_filter.h"
#include "host/blocks.glsl"
#include "plan/effect_plan.h"
#include "scene/probe_observer.h"
#include "scene/probe_times.h"
#include "scene/programs.h"

namespace lodestar::scene {

/// How a face of a light probe sees the world.
struct FaceView {
    glm::vec3 position{0.0f};
    glm::mat4 clipFromWorld{1.0f};
};
/// @param face OpenGL's order: the picture is a face of a cube map as it stands
[[nodiscard]] FaceView faceView(const plan::ProbeView& probe, int face);

class GpuProbes {
public:
    /// @param written factor on radiance as it is stored, so that half floats hold it
    void setWritten(float written) { written_ = written; }
    [[nodiscard]] float written() const { return written_; }

    /// Makes what a plan's probes need and is not there. Where the driver has no memory for one, it
    /// is made half as wide, and counted. @errors NoOpenGl where it has none for the smallest
    [[nodiscard]] core::Result<void> prepare(gl::Device& device, const ProbeObserver& observer,
                                             const plan::EffectPlan& plan, core::Tally& warnings);

    /// Puts what is kept in the order of ProbeObserver::rescan; the rest is given up.
    void keep(std::span<const int> which);

    /// Fills in what each probe takes of the GPU's time. Measured from the first call on.
    void describeTimes(gl::Device& device, std::span<plan::ProbeView> probes);

    /// Begins a face's pass; the caller draws, then ends it.
    void beginFace(const plan::ProbeFace& face);
    void endFace(const plan::ProbeFace& face);
    /// The faces drawn since the last take the place of the captured ones: before another probe's
    /// are drawn.
    void publish(std::size_t probe);
    /// Composes and filters as the plan says. @pre the environment, the lights and the
    /// frame's blocks are bound
    void work(const plan::EffectPlan& plan, const Programs& programs,
              const ProbeObserver& observer);

    /// Before the frame's work: the factors of skies that are kept apart.
    void setSkyFactors(const plan::PlanInput& input);
    /// Uploads the blocks of all probes where they have changed.
    void describe(gl::Device& device, const ProbeObserver& observer, const plan::PlanInput& input);
    /// A face of what a probe lights with: radiance, row 0 first as GL has it, level 0 or a mip
    /// that is made; empty where it has none. Waits for the GPU.
    [[nodiscard]] core::Image read(std::size_t probe, int face, int level) const;
    /// Binds the two that hold a draw.
    void bind(const plan::ProbeChoice& choice) const;

private:
    struct Cubes {
        int width = 0; ///< of a face, texels; 0: nothing has been asked of it yet
        gl::Texture captured, lit;
        gl::Texture sky;              ///< its part of the light, where it is kept apart from `lit`
        glm::vec3 skyFactor{1.0f};    ///< on `sky`
        int lastLevel = 0;            ///< of `lit`, that is made
        int tile = 0;                 ///< of the irradiance
        int skyTile = 0;              ///< of the sky's
        std::array<bool, 6> staged{}; ///< faces that wait in the staging cube
    };
    struct Staging {
        gl::FaceTarget target;
        gl::Texture faces;
    };

    [[nodiscard]] core::Result<void> prepareShared(gl::Device& device);
    [[nodiscard]] static core::Result<Cubes> makeCubes(gl::Device& device,
                                                       const ProbeComponent& component, bool ratio,
                                                       core::Tally& warnings);
    [[nodiscard]] core::Result<void> prepareStaging(gl::Device& device, int width);
    void findSuns(const Cubes& cubes, const gl::Program& program);
    void compose(const plan::ProbeWork& work, const gl::Program& program, bool fromFile,
                 CompositionPart part);

    gl::Device* device_ = nullptr;
    float written_ = 1.0f;
    std::optional<ProbeTimes> times_;
    std::optional<gl::ProbeFilter> filter_;
    gl::IrradianceAtlas irradiance_;
    gl::CubeFaces faces_;
    gl::VertexArray fullScreen_;
    std::map<int, Staging> staging_; ///< by width
    std::vector<Cubes> cubes_;       ///< by probe
    std::vector<int> freeTiles_;     ///< of probes that were given up
    /// The first is none's; then each probe's, then each again without its light.
    std::vector<blocks::LodestarProbe> blocks_;
    std::size_t stride_ = 0;
    gl::Buffer blockBuffer_;
};

} // namespace lodestar::scene
