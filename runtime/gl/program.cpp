// SPDX-License-Identifier: MIT
#include "gl/program.h"

#include <utility>

#include <epoxy/gl.h>

namespace lodestar::gl {
namespace {

core::Result<unsigned> compile(Device& device, GLenum stage, const std::string& text,
                               const std::string& label) {
    const GLuint shader = glCreateShader(stage);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    ++device.counters().shaderCompilations;
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) {
        return shader;
    }
    std::string log(2048, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    glDeleteShader(shader);
    return core::Error{
        core::ErrorCode::Internal, "the driver refuses the shader: " + log, label, {}};
}

} // namespace

Program::Program(Program&& other) noexcept {
    *this = std::move(other);
}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(id_, other.id_);
    return *this;
}

Program::~Program() {
    if (id_ != 0) {
        device_->forgetProgram(id_);
        glDeleteProgram(id_);
    }
}

core::Result<Program> Program::make(Device& device, std::string_view vertexFile,
                                    std::string_view fragmentFile, const Defines& defines) {
    auto vertex = assembleShader(vertexFile, 330, defines);
    if (!vertex) {
        return vertex.error();
    }
    auto fragment = assembleShader(fragmentFile, 330, defines);
    if (!fragment) {
        return fragment.error();
    }
    return makeFromText(device, *vertex, *fragment, std::string(fragmentFile));
}

core::Result<Program> Program::makeFromText(Device& device, const std::string& vertex,
                                            const std::string& fragment, const std::string& label) {
    auto vertexShader = compile(device, GL_VERTEX_SHADER, vertex, label + " (vertex)");
    if (!vertexShader) {
        return vertexShader.error();
    }
    auto fragmentShader = compile(device, GL_FRAGMENT_SHADER, fragment, label);
    if (!fragmentShader) {
        glDeleteShader(*vertexShader);
        return fragmentShader.error();
    }
    Program program;
    program.device_ = &device;
    program.id_ = glCreateProgram();
    glAttachShader(program.id_, *vertexShader);
    glAttachShader(program.id_, *fragmentShader);
    glLinkProgram(program.id_);
    glDeleteShader(*vertexShader);
    glDeleteShader(*fragmentShader);
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id_, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        std::string log(2048, '\0');
        GLsizei length = 0;
        glGetProgramInfoLog(program.id_, static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        return core::Error{
            core::ErrorCode::Internal, "the driver does not link the program: " + log, label, {}};
    }
    if (device.capabilities().debugOutput) {
        constexpr std::size_t kMostLabel = 255; // every driver takes as many
        glObjectLabel(GL_PROGRAM, program.id_, -1, label.substr(0, kMostLabel).c_str());
    }
    return program;
}

void Program::use() const {
    device_->useProgram(id_);
}

int Program::uniform(const char* name) const {
    return glGetUniformLocation(id_, name);
}

void Program::setSampler(const char* name, int unit) const {
    if (const int location = uniform(name); location >= 0) {
        use();
        glUniform1i(location, unit);
    }
}

void Program::setBlock(const char* name, unsigned binding) const {
    const GLuint index = glGetUniformBlockIndex(id_, name);
    if (index != GL_INVALID_INDEX) {
        glUniformBlockBinding(id_, index, binding);
    }
}

} // namespace lodestar::gl
