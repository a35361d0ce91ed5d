// SPDX-License-Identifier: MIT
#include "deferred_engine.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

namespace lodestar::samples {
namespace {

constexpr const char* kVersion = "#version 330 core\n";

constexpr const char* kMeshVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clipFromWorld;
uniform mat4 worldFromMesh;
uniform mat3 normalFromMesh;
out vec3 vPosition;
out vec3 vNormal;
void main() {
    vec4 world = worldFromMesh * vec4(position, 1.0);
    vPosition = world.xyz;
    vNormal = normalFromMesh * normal;
    gl_Position = clipFromWorld * world;
})";

constexpr const char* kMeshFragment = R"(
uniform vec4 surface0;
uniform vec4 surface1;
in vec3 vPosition;
in vec3 vNormal;
layout(location = 0) out vec4 outPosition; // w: covered
layout(location = 1) out vec4 outNormal;
layout(location = 2) out vec4 outSurface0;
layout(location = 3) out vec4 outSurface1;
layout(location = 4) out vec4 outPositionDx;
layout(location = 5) out vec4 outPositionDy;
layout(location = 6) out vec4 outNormalDx;
layout(location = 7) out vec4 outNormalDy;
void main() {
    vec3 normal = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
    outPosition = vec4(vPosition, 1.0);
    outNormal = vec4(normal, 0.0);
    outSurface0 = surface0;
    outSurface1 = surface1;
    outPositionDx = vec4(dFdx(vPosition), 0.0);
    outPositionDy = vec4(dFdy(vPosition), 0.0);
    outNormalDx = vec4(dFdx(normal), 0.0);
    outNormalDy = vec4(dFdy(normal), 0.0);
})";

constexpr const char* kScreenVertex = R"(
void main() {
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
})";

// What the geometry pass has written of a pixel; derivatives are those of its own triangle.
constexpr const char* kPixel = R"(
struct EnginePixel {
    vec3 position, normal;
    vec4 surface0, surface1;
    vec3 positionDx, positionDy, normalDx, normalDy;
};
)";

constexpr const char* kScreenMain = R"(
uniform sampler2D engineTargets[8];
out vec4 outColor;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(engineTargets[0], at, 0);
    if (position.w == 0.0) {
        discard;
    }
    EnginePixel pixel;
    pixel.position = position.xyz;
    pixel.normal = texelFetch(engineTargets[1], at, 0).xyz;
    pixel.surface0 = texelFetch(engineTargets[2], at, 0);
    pixel.surface1 = texelFetch(engineTargets[3], at, 0);
    pixel.positionDx = texelFetch(engineTargets[4], at, 0).xyz;
    pixel.positionDy = texelFetch(engineTargets[5], at, 0).xyz;
    pixel.normalDx = texelFetch(engineTargets[6], at, 0).xyz;
    pixel.normalDy = texelFetch(engineTargets[7], at, 0).xyz;
    outColor = vec4(lighting(pixel), 1.0);
})";

std::string logOf(GLuint object, bool isProgram) {
    char text[4096] = "";
    if (isProgram) {
        glGetProgramInfoLog(object, sizeof text, nullptr, text);
    } else {
        glGetShaderInfoLog(object, sizeof text, nullptr, text);
    }
    return text[0] == '\0' ? "no word of the compiler" : text;
}

/// @return 0 where it was not made; `words` say why
GLuint link(const std::string& vertex, const std::string& fragment, std::string& words) {
    const GLuint program = glCreateProgram();
    bool made = true;
    for (const auto& [stage, body] :
         {std::pair{GL_VERTEX_SHADER, &vertex}, std::pair{GL_FRAGMENT_SHADER, &fragment}}) {
        const GLuint shader = glCreateShader(static_cast<GLenum>(stage));
        const std::string whole = kVersion + *body;
        const char* text = whole.c_str();
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        GLint compiled = 0;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
        if (compiled == 0) {
            words = logOf(shader, false);
            made = false;
        }
        glAttachShader(program, shader);
        glDeleteShader(shader); // with the program
    }
    if (made) {
        GLint linked = 0;
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
        if (linked == 0) {
            words = logOf(program, true);
            made = false;
        }
    }
    if (!made) {
        glDeleteProgram(program);
    }
    return made ? program : 0;
}

GLuint makeTexture(GLint format, int width, int height) {
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

template <class T>
void fillBuffer(GLenum target, GLuint buffer, std::span<const T> values) {
    glBindBuffer(target, buffer);
    glBufferData(target, static_cast<GLsizeiptr>(values.size_bytes()), values.data(),
                 GL_STATIC_DRAW);
}

} // namespace

DeferredEngine::DeferredEngine(int width, int height) : width_(width), height_(height) {
    std::string words;
    geometry_ = link(kMeshVertex, kMeshFragment, words);
    glGenFramebuffers(1, &geometryTarget_);
    glBindFramebuffer(GL_FRAMEBUFFER, geometryTarget_);
    GLenum attachments[kTargets];
    for (int i = 0; i < kTargets; ++i) {
        attachments[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        targets_[i] = makeTexture(GL_RGBA32F, width, height);
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, targets_[i], 0);
    }
    glDrawBuffers(kTargets, attachments);
    glGenRenderbuffers(1, &depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    glGenFramebuffers(1, &lightingTarget_);
    glBindFramebuffer(GL_FRAMEBUFFER, lightingTarget_);
    picture_ = makeTexture(GL_RGBA8, width, height);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture_, 0);
    glGenVertexArrays(1, &empty_);
}

DeferredEngine::~DeferredEngine() {
    for (const Item& item : items_) {
        glDeleteBuffers(3, item.buffers);
        glDeleteVertexArrays(1, &item.vertexArray);
    }
    const GLuint framebuffers[] = {geometryTarget_, lightingTarget_};
    glDeleteFramebuffers(2, framebuffers);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteTextures(kTargets, targets_);
    glDeleteTextures(1, &picture_);
    glDeleteVertexArrays(1, &empty_);
    glDeleteProgram(geometry_);
    glDeleteProgram(lighting_);
}

void DeferredEngine::add(const EngineMesh& mesh) {
    Item item{};
    item.count = static_cast<GLsizei>(mesh.indices.size());
    item.worldFromMesh = mesh.worldFromMesh;
    item.surface[0] = mesh.surface[0];
    item.surface[1] = mesh.surface[1];
    item.doubleSided = mesh.doubleSided;
    glGenVertexArrays(1, &item.vertexArray);
    glGenBuffers(3, item.buffers);
    glBindVertexArray(item.vertexArray);
    fillBuffer(GL_ARRAY_BUFFER, item.buffers[0], mesh.positions);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    fillBuffer(GL_ARRAY_BUFFER, item.buffers[1], mesh.normals);
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    fillBuffer(GL_ELEMENT_ARRAY_BUFFER, item.buffers[2], mesh.indices);
    glBindVertexArray(0);
    items_.push_back(item);
}

std::string DeferredEngine::setLighting(const std::string& text) {
    std::string words;
    const GLuint made = link(kScreenVertex, kPixel + text + kScreenMain, words);
    if (made != 0) {
        glDeleteProgram(lighting_);
        lighting_ = made;
    }
    return words;
}

void DeferredEngine::drawGeometry(const glm::mat4& clipFromWorld) const {
    glBindFramebuffer(GL_FRAMEBUFFER, geometryTarget_);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(geometry_);
    const auto at = [&](const char* name) { return glGetUniformLocation(geometry_, name); };
    glUniformMatrix4fv(at("clipFromWorld"), 1, GL_FALSE, glm::value_ptr(clipFromWorld));
    for (const Item& item : items_) {
        const glm::mat3 linear(item.worldFromMesh);
        const bool mirrored = glm::determinant(linear) < 0.0f;
        const glm::mat3 normalFromMesh = glm::transpose(glm::inverse(linear));
        (item.doubleSided ? glDisable : glEnable)(GL_CULL_FACE);
        glFrontFace(mirrored ? GL_CW : GL_CCW);
        glUniformMatrix4fv(at("worldFromMesh"), 1, GL_FALSE, glm::value_ptr(item.worldFromMesh));
        glUniformMatrix3fv(at("normalFromMesh"), 1, GL_FALSE, glm::value_ptr(normalFromMesh));
        glUniform4fv(at("surface0"), 1, glm::value_ptr(item.surface[0]));
        glUniform4fv(at("surface1"), 1, glm::value_ptr(item.surface[1]));
        glBindVertexArray(item.vertexArray);
        glDrawElements(GL_TRIANGLES, item.count, GL_UNSIGNED_INT, nullptr);
    }
}

void DeferredEngine::drawLighting() const {
    glBindFramebuffer(GL_FRAMEBUFFER, lightingTarget_);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glClear(GL_COLOR_BUFFER_BIT);
    glUseProgram(lighting_);
    GLint units[kTargets];
    for (int i = 0; i < kTargets; ++i) {
        units[i] = i;
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        glBindTexture(GL_TEXTURE_2D, targets_[i]);
    }
    glUniform1iv(glGetUniformLocation(lighting_, "engineTargets"), kTargets, units);
    glBindVertexArray(empty_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void DeferredEngine::draw(const glm::mat4& clipFromWorld) const {
    glViewport(0, 0, width_, height_);
    drawGeometry(clipFromWorld);
    drawLighting();
}

std::vector<std::uint8_t> DeferredEngine::read() const {
    std::vector<std::uint8_t> picture(4 * static_cast<std::size_t>(width_) *
                                      static_cast<std::size_t>(height_));
    glBindFramebuffer(GL_FRAMEBUFFER, lightingTarget_);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, picture.data());
    return picture;
}

} // namespace lodestar::samples
