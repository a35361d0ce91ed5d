// SPDX-License-Identifier: MIT
#include "support/glsl_function.h"

#include <utility>

#include <epoxy/gl.h>

#include "gl/buffer.h"
#include "gl/framebuffer.h"

namespace lodestar::testing {
namespace {

/// Row k of the texture holds input k of every case.
unsigned makeInputTexture(const std::vector<GlslCase>& cases) {
    std::vector<glm::vec4> texels;
    texels.reserve(cases.size() * kInputVectors);
    for (std::size_t k = 0; k < kInputVectors; ++k) {
        for (const GlslCase& inputs : cases) {
            texels.push_back(inputs[k]);
        }
    }
    unsigned texture = 0;
    glGenTextures(1, &texture);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, static_cast<GLsizei>(cases.size()),
                 static_cast<GLsizei>(kInputVectors), 0, GL_RGBA, GL_FLOAT, texels.data());
    return texture;
}

} // namespace

core::Result<GlslFunction> GlslFunction::make(gl::Device& device, int version,
                                              const std::string& text,
                                              const std::string& expression) {
    const std::string vertex = "#version " + std::to_string(version) + " core\n" + R"(
void main() {
    gl_Position = vec4(vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0), 0.0, 1.0);
})";
    std::string fragment = text + "\nuniform sampler2D uInputs;\n"
                                  "layout(location = 0) out vec4 oValue;\nvoid main() {\n";
    for (std::size_t k = 0; k < kInputVectors; ++k) {
        const std::string number = std::to_string(k);
        fragment += "    vec4 p" + number + " = texelFetch(uInputs, ivec2(int(gl_FragCoord.x), " +
                    number + "), 0);\n";
    }
    fragment += "    oValue = " + expression + ";\n}\n";
    auto program = gl::Program::makeFromText(device, vertex, fragment, expression);
    if (!program) {
        return program.error();
    }
    GlslFunction function;
    function.device_ = &device;
    function.program_ = std::move(*program);
    return function;
}

std::vector<glm::vec4> GlslFunction::evaluate(const std::vector<GlslCase>& cases) {
    LODESTAR_EXPECT(!cases.empty() && cases.size() <= 4096, "a table has 1 to 4096 cases");
    auto target = gl::Framebuffer::make(*device_, static_cast<int>(cases.size()), 1);
    LODESTAR_EXPECT(target.ok(), "the driver renders to 32-bit float colour");
    gl::VertexArray vertices(*device_);
    const unsigned inputs = makeInputTexture(cases);
    program_.use();
    program_.setSampler("uInputs", 0);
    target->begin();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    vertices.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    const core::Image image = target->read();
    glDeleteTextures(1, &inputs);
    std::vector<glm::vec4> values(cases.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float* pixel = image.at(static_cast<int>(i), 0);
        values[i] = glm::vec4(pixel[0], pixel[1], pixel[2], pixel[3]);
    }
    return values;
}

} // namespace lodestar::testing
