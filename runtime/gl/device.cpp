// SPDX-License-Identifier: MIT
#include "gl/device.h"

#include <epoxy/gl.h>

namespace lodestar::gl {
namespace {

void GLAPIENTRY onDebugMessage(GLenum, GLenum type, GLuint, GLenum, GLsizei length,
                               const GLchar* message, const void* user) {
    if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) {
        auto* device = static_cast<Device*>(const_cast<void*>(user));
        device->note(std::string(message, static_cast<std::size_t>(length)));
    }
}

std::string text(GLenum name) {
    const auto* value = reinterpret_cast<const char*>(glGetString(name));
    return value != nullptr ? value : "";
}

int integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

} // namespace

WorkCounters difference(const WorkCounters& later, const WorkCounters& earlier) {
    WorkCounters d;
    d.draws = later.draws - earlier.draws;
    d.passes = later.passes - earlier.passes;
    d.texelsWritten = later.texelsWritten - earlier.texelsWritten;
    d.uploads = later.uploads - earlier.uploads;
    d.uploadBytes = later.uploadBytes - earlier.uploadBytes;
    d.programSwitches = later.programSwitches - earlier.programSwitches;
    d.shaderCompilations = later.shaderCompilations - earlier.shaderCompilations;
    d.stateQueries = later.stateQueries - earlier.stateQueries;
    d.probeFaces = later.probeFaces - earlier.probeFaces;
    d.glErrors = later.glErrors - earlier.glErrors;
    d.textureBytes = later.textureBytes;
    return d;
}

core::Result<std::unique_ptr<Device>> Device::create() {
    if (glGetString(GL_VERSION) == nullptr || epoxy_gl_version() < 33) {
        return core::Error{core::ErrorCode::NoOpenGl,
                           "no usable OpenGL: 3.3 core is needed and no such context is current",
                           {},
                           {}};
    }
    std::unique_ptr<Device> device(new Device);
    const std::string renderer = text(GL_RENDERER);
    device->capabilities_ = {epoxy_gl_version(),
                             renderer,
                             text(GL_VENDOR),
                             renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe"),
                             epoxy_gl_version() >= 43 || epoxy_has_gl_extension("GL_KHR_debug"),
                             integer(GL_MAX_TEXTURE_SIZE),
                             integer(GL_MAX_CUBE_MAP_TEXTURE_SIZE),
                             integer(GL_MAX_TEXTURE_BUFFER_SIZE),
                             integer(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT)};
    if (device->capabilities_.debugOutput) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
        glDebugMessageCallback(onDebugMessage, device.get());
    }
    return device;
}

Device::~Device() {
    if (capabilities_.debugOutput && glGetString(GL_VERSION) != nullptr) {
        glDebugMessageCallback(nullptr, nullptr);
    }
}

void Device::useProgram(unsigned program) {
    if (program != boundProgram_) {
        glUseProgram(program);
        boundProgram_ = program;
        ++counters_.programSwitches;
    }
}

void Device::forgetProgram(unsigned program) {
    if (program == boundProgram_) {
        glUseProgram(0);
        boundProgram_ = 0;
    }
}

void Device::note(std::string message) {
    ++counters_.glErrors;
    if (messages_.size() < 64) {
        messages_.push_back(std::move(message));
    }
}

} // namespace lodestar::gl
