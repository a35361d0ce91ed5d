// SPDX-License-Identifier: MIT
//
// The texels of plans as textures of the host's OpenGL context. All of it is the [gl] thread's;
// what of the host's state is touched is put back by a StateGuard.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gl_functions.h"
#include "lodestar/lodestar.h"
#include "plans.h"

namespace lodestar::plugin {

constexpr int kTexelKinds = 5; // LODESTAR_TEXELS_*

class GlTextures {
public:
    explicit GlTextures(const GlFunctions& functions) : gl_(functions) {}
    GlTextures(const GlTextures&) = delete;
    GlTextures& operator=(const GlTextures&) = delete;

    /// Whether the host resets its state: then nothing of it is queried.
    void setHostResets(bool resets) { hostResets_ = resets; }
    /// Uploads what a plan shows and is not held yet.
    void execute(const Packet& packet);
    /// Deletes the textures; the context they are of is current.
    void destroy();
    [[nodiscard]] LodestarGlTexture texture(int texels) const;
    /// Of a probe; its name is 0 where there is none.
    [[nodiscard]] LodestarGlTexture probeTexture(LodestarProbe probe, int texels) const;
    /// Face width of a host's cube; 0: it is none.
    [[nodiscard]] int cubeWidth(GLuint name);
    /// Its six faces. @pre cubeWidth is not 0
    void readCube(GLuint name, int width, float* rgba);
    [[nodiscard]] const LodestarWork& work() const { return work_; }

private:
    struct Layer {
        LodestarLight light = 0;
        std::uint64_t version = 0; ///< uploaded; 0: none
    };
    struct Cube {
        GLuint name = 0;
        LodestarEnvironment of = 0; ///< or a probe
        std::uint64_t version = 0;  ///< uploaded
        LodestarGlTexture described{};
    };
    struct ProbeCubes {
        LodestarProbe of = 0;
        Cube cubes[2]; ///< texels, irradiance
    };
    using Guard = std::optional<StateGuard>;
    void guard(Guard& guard);
    void layOut(const Packet& packet, Guard& guard);
    void uploadLayer(int texels, std::size_t layer, const std::vector<std::uint8_t>& bytes);
    void uploadCube(const Packet::Cube& from, Cube& to, Guard& guard);
    void uploadProbes(const ProbePacket& probes, Guard& guard);
    void count(std::uint64_t uploads, std::uint64_t bytes, std::uint64_t texels);

    GlFunctions gl_;
    bool hostResets_ = false;
    LodestarWork work_{sizeof(LodestarWork), 0, 0, 0, 0, 0};
    GLuint arrays_[3] = {};
    std::vector<Layer> layers_;
    lighting::RsrmLayout maps_ = lighting::kRsrm; ///< of the arrays
    Cube environment_, irradiance_;
    std::vector<ProbeCubes> probes_;
};

/// The table of the extension.
[[nodiscard]] const LodestarGlApi* glApi();

} // namespace lodestar::plugin
