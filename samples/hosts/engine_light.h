// SPDX-License-Identifier: MIT
//
// What joins the library and the deferred engine: the text of its lighting pass, the textures and
// uniforms that the text reads, materials packed into its G-buffer.
#pragma once

#include <string>

#include "deferred_engine.h"
#include "hosts/lit_context.h"
#include "io/gltf.h"
#include "scene/camera.h"

namespace lodestar::samples {

class EngineLight {
public:
    /// How the host finds OpenGL's functions: eglGetProcAddress, glfwGetProcAddress, ...
    using Loader = void* (*)(const char* name);

    /// Attaches the library's OpenGL extension as long as this lives. @pre a context is current
    EngineLight(const hosts::LitContext& lit, Loader loader);
    EngineLight(const EngineLight&) = delete;
    EngineLight& operator=(const EngineLight&) = delete;
    ~EngineLight();

    /// Gives the engine a scene's triangles and the lighting pass.
    /// @errors NoOpenGl, InputRefused: a material; Internal: the driver refused the text
    [[nodiscard]] core::Result<void> prepare(const io::GltfFile& file,
                                             DeferredEngine& engine) const;
    /// Plans the hour, uploads what is new of it, sets all that the lighting pass reads.
    [[nodiscard]] core::Result<void> set(double hour, const scene::View& view,
                                         const DeferredEngine& engine) const;

private:
    [[nodiscard]] bool addScene(const io::GltfFile& file, DeferredEngine& engine) const;
    [[nodiscard]] bool addPrimitive(const io::GltfFile& file, const glm::mat4& world,
                                    const io::GltfPrimitive& primitive,
                                    DeferredEngine& engine) const;
    [[nodiscard]] bool light(double hour, GLuint program) const;
    [[nodiscard]] bool bindTexture(const LodestarUniform& sampler, GLuint program,
                                   GLuint unit) const;

    const hosts::LitContext& lit_;
    const LodestarGlApi* gl_;
    bool attached_;
};

} // namespace lodestar::samples
