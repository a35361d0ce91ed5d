// SPDX-License-Identifier: MIT
//
// The lights' texels as textures of the host's OpenGL context. Its functions are asked of the host;
// what of its state is touched is put back: the texture bound to the active unit, and how pixels
// are unpacked.
#pragma once

#include <cstdint>
#include <vector>

#include <GL/glcorearb.h>

#include "lodestar/lodestar.h"

namespace lodestar::plugin {

/// Null where the host's GL has none.
struct GlFunctions {
    PFNGLGETINTEGERVPROC getIntegerv = nullptr;
    PFNGLGENTEXTURESPROC genTextures = nullptr;
    PFNGLDELETETEXTURESPROC deleteTextures = nullptr;
    PFNGLBINDTEXTUREPROC bindTexture = nullptr;
    PFNGLTEXPARAMETERIPROC texParameteri = nullptr;
    PFNGLPIXELSTOREIPROC pixelStorei = nullptr;
    PFNGLTEXIMAGE3DPROC texImage3D = nullptr;
    PFNGLTEXSUBIMAGE3DPROC texSubImage3D = nullptr;
    PFNGLBINDBUFFERPROC bindBuffer = nullptr;

    /// @return whether all are there, of OpenGL 3.3 at least
    [[nodiscard]] bool load(void* (*procedure)(const char* name));
};

constexpr int kTexelKinds = 3; // LODESTAR_TEXELS_*

class GlLights {
public:
    explicit GlLights(const GlFunctions& functions) : gl_(functions) {}
    GlLights(const GlLights&) = delete;
    GlLights& operator=(const GlLights&) = delete;

    /// Whether the host resets its state after `update`: then nothing of it is queried.
    void setHostResets(bool resets) { hostResets_ = resets; }
    /// Uploads what has changed at the context's hour.
    void update(LodestarContext& context);
    /// Deletes the textures; the context they are of is current.
    void destroy();
    [[nodiscard]] LodestarGlTexture texture(int which) const;
    /// The layer of a light; -1: it has none yet.
    [[nodiscard]] int layer(LodestarLight light) const;

private:
    struct Layer {
        LodestarLight light = 0;
        std::uint64_t version = 0; ///< uploaded; 0: none
    };
    void allocate(std::size_t layers);
    void upload(int which, std::size_t layer, const void* texels);

    GlFunctions gl_;
    bool hostResets_ = false;
    GLuint names_[kTexelKinds] = {};
    std::vector<Layer> layers_;
};

/// The table of the extension.
[[nodiscard]] const LodestarGlApi* glApi();

} // namespace lodestar::plugin
