// SPDX-License-Identifier: MIT
#include "shader_text.h"

#include <span>

#include <epoxy/gl.h>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"

namespace lodestar::testing {

std::vector<glm::vec4> fetchCube(gl::Device& device, const lighting::Cubemap& map,
                                 const std::vector<glm::vec4>& lookups) {
    // One point a lookup, each at its own pixel of a row.
    const char* vertex = R"(#version 330 core
layout(location = 0) in vec4 aLookup;
uniform float uCount;
flat out vec4 vLookup;
void main() {
    vLookup = aLookup;
    gl_Position = vec4((float(gl_VertexID) + 0.5) / uCount * 2.0 - 1.0, 0.0, 0.0, 1.0);
})";
    const char* fragment = R"(#version 330 core
uniform samplerCube uMap;
flat in vec4 vLookup;
layout(location = 0) out vec4 oValue;
void main() { oValue = textureLod(uMap, vLookup.xyz, vLookup.w); })";
    auto program = gl::Program::makeFromText(device, vertex, fragment, "fetchCube");
    auto texture = gl::Texture::makeCube(device, map, "fetchCube");
    auto target = gl::Framebuffer::make(device, static_cast<int>(lookups.size()), 1);
    if (!program || !texture || !target) {
        return {};
    }
    gl::Buffer buffer(device, gl::BufferKind::Vertex, std::as_bytes(std::span(lookups)));
    gl::VertexArray vertices(device);
    vertices.setAttribute(gl::Attribute::Position, buffer, 4);
    program->use();
    glUniform1f(program->uniform("uCount"), static_cast<float>(lookups.size()));
    program->setSampler("uMap", 0);
    target->begin();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    texture->bind(0);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(lookups.size()));
    const core::Image image = target->read();
    std::vector<glm::vec4> values(lookups.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float* pixel = image.at(static_cast<int>(i), 0);
        values[i] = glm::vec4(pixel[0] * texture->scale(), pixel[1] * texture->scale(),
                              pixel[2] * texture->scale(), pixel[3]);
    }
    return values;
}

} // namespace lodestar::testing
