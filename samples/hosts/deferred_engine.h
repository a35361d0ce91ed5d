// SPDX-License-Identifier: MIT
//
// A small engine that knows nothing of Lodestar: deferred shading in OpenGL 3.3. Its geometry pass
// writes what a pixel's surface is, its lighting pass runs whatever text it is given over that.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lodestar::samples {

/// What is drawn. The engine keeps vertices and indices on the GPU.
struct EngineMesh {
    std::span<const glm::vec3> positions, normals;
    std::span<const std::uint32_t> indices;
    glm::mat4 worldFromMesh{1.0f};
    glm::vec4 surface[2]; ///< carried through the G-buffer untouched
    bool doubleSided = false;
};

class DeferredEngine {
public:
    /// @pre a context of OpenGL 3.3 or later is current, now and in all calls
    DeferredEngine(int width, int height);
    ~DeferredEngine();
    DeferredEngine(const DeferredEngine&) = delete;
    DeferredEngine& operator=(const DeferredEngine&) = delete;

    void add(const EngineMesh& mesh);
    /// GLSL 330 without a version line that defines `vec3 lighting(EnginePixel pixel)`: position,
    /// normal, surface0, surface1, and screen derivatives of the first two.
    /// @return the compiler's words, "" if it took the text
    [[nodiscard]] std::string setLighting(const std::string& text);
    /// For its uniforms; 0 before setLighting.
    [[nodiscard]] GLuint lightingProgram() const { return lighting_; }
    /// Draws the picture; leaves its framebuffer bound.
    void draw(const glm::mat4& clipFromWorld) const;
    /// The picture as a texture, bottom row first.
    [[nodiscard]] GLuint picture() const { return picture_; }
    /// The picture, RGBA bytes, bottom row first.
    [[nodiscard]] std::vector<std::uint8_t> read() const;

private:
    struct Item {
        GLuint vertexArray, buffers[3];
        GLsizei count;
        glm::mat4 worldFromMesh;
        glm::vec4 surface[2];
        bool doubleSided;
    };
    void drawGeometry(const glm::mat4& clipFromWorld) const;
    void drawLighting() const;

    static constexpr int kTargets = 8;
    int width_, height_;
    GLuint geometryTarget_ = 0, lightingTarget_ = 0, depth_ = 0, picture_ = 0, empty_ = 0;
    GLuint targets_[kTargets] = {};
    GLuint geometry_ = 0, lighting_ = 0;
    std::vector<Item> items_;
};

} // namespace lodestar::samples
