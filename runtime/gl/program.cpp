// SPDX-License-Identifier: MIT
#include "gl/program.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

#include "gl/embedded_shaders.h"

namespace lodestar::gl {
namespace {

constexpr std::string_view kInclude = "#include \"";

std::string_view folderOf(std::string_view name) {
    const std::size_t slash = name.rfind('/');
    return slash == std::string_view::npos ? std::string_view{} : name.substr(0, slash + 1);
}

/// Appends a file's lines, replacing includes; `done` holds the files in the order of their
/// numbers.
core::Result<void> append(std::string_view name, std::vector<std::string>& done, std::string& out) {
    if (std::find(done.begin(), done.end(), name) != done.end()) {
        return {};
    }
    std::string_view text = shaderFile(name);
    if (text.empty()) {
        return core::Error{
            core::ErrorCode::Internal, "no such shader file is built in", std::string(name), {}};
    }
    const std::size_t number = done.size();
    done.emplace_back(name);
    out += "#line 1 " + std::to_string(number) + "\n";
    int line = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view current = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line;
        if (current.substr(0, kInclude.size()) != kInclude) {
            out.append(current).append("\n");
            continue;
        }
        const std::string_view target =
            current.substr(kInclude.size(), current.rfind('"') - kInclude.size());
        std::string resolved = std::string(folderOf(name)) + std::string(target);
        if (shaderFile(resolved).empty()) {
            resolved = target;
        }
        if (auto included = append(resolved, done, out); !included) {
            return included;
        }
        out += "#line " + std::to_string(line + 1) + " " + std::to_string(number) + "\n";
    }
    return {};
}

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

std::string_view shaderFile(std::string_view name) {
    for (const EmbeddedShader& shader : kEmbeddedShaders) {
        if (shader.name == name) {
            return shader.text;
        }
    }
    return {};
}

std::vector<std::string_view> shaderFileNames() {
    std::vector<std::string_view> names;
    for (const EmbeddedShader& shader : kEmbeddedShaders) {
        names.push_back(shader.name);
    }
    return names;
}

core::Result<std::string> assembleShader(std::string_view name, int version,
                                         const Defines& defines) {
    std::string text = "#version " + std::to_string(version) + " core\n";
    for (const auto& [macro, value] : defines) {
        text += "#define " + macro + " " + value + "\n";
    }
    std::vector<std::string> done;
    if (auto appended = append(name, done, text); !appended) {
        return appended.error();
    }
    return text;
}

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
        glObjectLabel(GL_PROGRAM, program.id_, -1, label.c_str());
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
