// SPDX-License-Identifier: MIT
//
// The functions that are asked of a host's OpenGL, and the guard that gives a host its state back.
#pragma once

#include <array>
#include <cstdint>

#include <GL/glcorearb.h>

namespace lodestar::plugin {

/// Null where the host's GL has none.
struct GlFunctions {
    PFNGLGETINTEGERVPROC getIntegerv = nullptr;
    PFNGLISTEXTUREPROC isTexture = nullptr;
    PFNGLGENTEXTURESPROC genTextures = nullptr;
    PFNGLDELETETEXTURESPROC deleteTextures = nullptr;
    PFNGLBINDTEXTUREPROC bindTexture = nullptr;
    PFNGLTEXPARAMETERIPROC texParameteri = nullptr;
    PFNGLPIXELSTOREIPROC pixelStorei = nullptr;
    PFNGLTEXIMAGE2DPROC texImage2D = nullptr;
    PFNGLTEXIMAGE3DPROC texImage3D = nullptr;
    PFNGLTEXSUBIMAGE3DPROC texSubImage3D = nullptr;
    PFNGLGETTEXLEVELPARAMETERIVPROC getTexLevelParameteriv = nullptr;
    PFNGLGETTEXIMAGEPROC getTexImage = nullptr;
    PFNGLBINDBUFFERPROC bindBuffer = nullptr;

    /// @return whether all are there, of OpenGL 3.3 at least
    [[nodiscard]] bool load(void* (*procedure)(const char* name));
};

/// Saves what uploads or readings touch, sets what they need, and puts back what was. For a host
/// that resets its own state nothing is asked: OpenGL's initial values are left.
class StateGuard {
public:
    enum class Way { Unpack, Pack }; ///< uploads; readings

    /// @param queries counts what is asked
    StateGuard(const GlFunctions& gl, Way way, bool hostResets, std::uint64_t& queries);
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;
    ~StateGuard();
    /// A texture that is about to be deleted: its name cannot be bound again, so 0 will be, as
    /// OpenGL itself does.
    void forget(GLuint texture);

private:
    struct Saved {
        GLenum name;
        GLint value; ///< the host's; at first OpenGL's
    };
    const GlFunctions& gl_;
    GLenum bufferTarget_;
    GLint array_ = 0, cube_ = 0, buffer_ = 0;
    std::array<Saved, 8> stores_;
};

} // namespace lodestar::plugin
