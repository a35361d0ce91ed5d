// SPDX-License-Identifier: MIT
//
// The shading text that the library gives, in every dialect that it names.
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include "lodestar/lodestar.h"
#include "support/gl_fixture.h"

namespace lodestar::testing {
namespace {

class AbiGlsl : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        api.struct_size = sizeof api;
        ASSERT_EQ(lodestar_get_api(LODESTAR_ABI_VERSION, &api), LODESTAR_OK);
    }
    LodestarApi api{};
};

TEST_F(AbiGlsl, EveryDialectCompiles) {
    const LodestarDialect dialects[] = {
        {sizeof(LodestarDialect), 330, LODESTAR_PROFILE_CORE, 0, 0, 0},
        {sizeof(LodestarDialect), 410, LODESTAR_PROFILE_CORE, 0, 0, 0},
        {sizeof(LodestarDialect), 450, LODESTAR_PROFILE_CORE, 0, 0, 0},
        {sizeof(LodestarDialect), 300, LODESTAR_PROFILE_ES, 0, 0, 0}};
    for (const LodestarDialect& dialect : dialects) {
        std::size_t size = 0;
        ASSERT_EQ(api.glsl_text("lodestar/rsrm.glsl", &dialect, nullptr, &size), LODESTAR_MORE);
        std::string text(size, '\0');
        ASSERT_EQ(api.glsl_text("lodestar/rsrm.glsl", &dialect, text.data(), &size), LODESTAR_OK);
        text.resize(size - 1);
        text += R"(
vec4 lodestar_host_rsrm(float column, float row, int layer) { return vec4(column, row, 0.0, 1.0); }
vec3 lodestar_host_rsrmLambert(float u, int layer) { return vec3(u); }
vec3 lodestar_host_rsrmGradient(float u2, int layer) { return vec3(u2); }
out vec4 oColor;
void main() {
    LodestarRsrm map;
    map.layer = 0;
    map.layoutName = LODESTAR_RSRM_REFINED;
    map.axis = vec3(0.0, 1.0, 0.0);
    map.columns = 170.0;
    map.rows = 24.0;
    map.leastExponent = 1.0;
    map.greatestExponent = 2048.0;
    map.firstOctave = 1.0;
    map.rowsPerOctave = 2.3;
    vec3 r = normalize(gl_FragCoord.xyz + vec3(1.0));
    oColor = vec4(lodestar_rsrm(map, r, lodestar_rsrmRow(map, 8.0)) + lodestar_rsrmLambert(map, r), 1.0);
})";
        const char* source = text.c_str();
        const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER);
        glShaderSource(shader, 1, &source, nullptr);
        glCompileShader(shader);
        GLint compiled = GL_FALSE;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
        char log[1024] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        EXPECT_EQ(compiled, GL_TRUE) << dialect.version << ": " << log;
        glDeleteShader(shader);
    }
}

/// "plugin/lighting.glsl" in a dialect, with a main that uses all of it.
std::string lightingShader(const LodestarApi& api, const LodestarDialect& dialect,
                           const std::string& features) {
    std::size_t size = 0;
    EXPECT_EQ(api.glsl_text("plugin/lighting.glsl", &dialect, nullptr, &size), LODESTAR_MORE);
    std::string text(size, '\0');
    EXPECT_EQ(api.glsl_text("plugin/lighting.glsl", &dialect, text.data(), &size), LODESTAR_OK);
    text.resize(size - 1);
    const std::size_t behindVersion = text.find('\n') + 1;
    text.insert(behindVersion, features);
    return text + R"(
uniform vec4 atX;
out vec4 oColor;
#if LODESTAR_WITH_HOST_VISIBILITY
float lodestar_host_visibility(int light) { return 0.5 + 0.01 * float(light); }
#endif
void main() {
    LodestarSurface here;
    here.normal = normalize(atX.xyz);
    here.view = normalize(gl_FragCoord.xyz);
    here.diffuse = vec3(0.5);
    here.f0 = vec3(0.04);
    here.exponent = atX.w;
    here.occlusion = 1.0;
    vec3 r = 2.0 * dot(here.normal, here.view) * here.normal - here.view;
    oColor = vec4(lodestar_lighting(here, dFdx(r), dFdy(r)) + lodestar_backdrop(r), 1.0);
#if LODESTAR_WITH_PROBES > 0
    oColor.rgb += lodestar_lightingAt(here, gl_FragCoord.xyz, dFdx(r), dFdy(r));
#endif
})";
}

GLuint compiled(GLenum stage, const std::string& text) {
    const char* source = text.c_str();
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint made = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &made);
    char log[1024] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    EXPECT_EQ(made, GL_TRUE) << log;
    return shader;
}

// Each dialect, by a block and by plain uniforms, with every set of features that a plan can name.
TEST_F(AbiGlsl, AllLightingCompiles) {
    int variants = 0;
    for (const std::uint32_t version : {330u, 410u, 450u, 300u}) {
        for (const std::uint32_t block : {0u, 1u}) {
            for (int set = 0; set < 96; ++set) {
                const LodestarDialect dialect{
                    sizeof dialect,
                    version,
                    version == 300 ? LODESTAR_PROFILE_ES : LODESTAR_PROFILE_CORE,
                    0,
                    block,
                    0};
                const auto define = [&](const char* name, int bit) {
                    return std::string("#define ")
                        .append(name)
                        .append((set & bit) != 0 ? " 1\n" : " 0\n");
                };
                const std::string features =
                    define("LODESTAR_WITH_ENVIRONMENT", 1) + define("LODESTAR_WITH_LIGHTS", 2) +
                    define("LODESTAR_RSRM_MIRROR", 4) + define("LODESTAR_WITH_HOST_VISIBILITY", 8) +
                    define("LODESTAR_RSRM_ROWS", 16) + "#define LODESTAR_WITH_PROBES " +
                    std::to_string(set / 32) + "\n";
                SCOPED_TRACE(std::to_string(version) + " block " + std::to_string(block) +
                             " features " + std::to_string(set));
                glDeleteShader(
                    compiled(GL_FRAGMENT_SHADER, lightingShader(api, dialect, features)));
                ++variants;
            }
        }
    }
    EXPECT_EQ(variants, 768);
}

// What uniform_info says is what the driver says.
TEST_F(AbiGlsl, UniformsAreWhereTheyAreSaidToBe) {
    for (const std::uint32_t block : {0u, 1u}) {
        const LodestarDialect dialect{sizeof dialect, 330, LODESTAR_PROFILE_CORE, 0, block, 0};
        const GLuint program = glCreateProgram();
        const GLuint shaders[] = {
            compiled(GL_VERTEX_SHADER,
                     "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }"),
            compiled(GL_FRAGMENT_SHADER, lightingShader(api, dialect, ""))};
        for (const GLuint shader : shaders) {
            glAttachShader(program, shader);
            glDeleteShader(shader);
        }
        glLinkProgram(program);
        LodestarUniform info{};
        info.struct_size = sizeof info;
        std::uint32_t index = 0, bytes = 0;
        for (; api.uniform_info(index, &info) == LODESTAR_OK; ++index) {
            const bool isVec4 = info.type == LODESTAR_UNIFORM_VEC4;
            const std::string name = std::string(info.name) + (info.count > 1 ? "[0]" : "");
            const char* text = name.c_str();
            GLuint found = GL_INVALID_INDEX;
            glGetUniformIndices(program, 1, &text, &found);
            ASSERT_NE(found, GL_INVALID_INDEX) << name;
            GLint type = 0, count = 0, offset = 0;
            glGetActiveUniformsiv(program, 1, &found, GL_UNIFORM_TYPE, &type);
            glGetActiveUniformsiv(program, 1, &found, GL_UNIFORM_SIZE, &count);
            glGetActiveUniformsiv(program, 1, &found, GL_UNIFORM_OFFSET, &offset);
            EXPECT_EQ(type, static_cast<GLint>(isVec4 ? GL_FLOAT_VEC4
                                               : info.type == LODESTAR_UNIFORM_CUBE
                                                   ? GL_SAMPLER_CUBE
                                                   : GL_SAMPLER_2D_ARRAY))
                << name;
            EXPECT_EQ(count, static_cast<GLint>(info.count)) << name;
            if (isVec4) {
                EXPECT_EQ(offset, block != 0 ? static_cast<GLint>(info.offset) : -1) << name;
                bytes = info.offset + 16 * info.count;
            }
        }
        EXPECT_EQ(index, 13u);
        if (block != 0) {
            GLint size = 0;
            glGetActiveUniformBlockiv(program, glGetUniformBlockIndex(program, "LodestarLighting"),
                                      GL_UNIFORM_BLOCK_DATA_SIZE, &size);
            EXPECT_EQ(size, static_cast<GLint>(bytes));
        }
        glDeleteProgram(program);
    }
}

TEST_F(AbiGlsl, WhatIsNotThereIsSaid) {
    const LodestarDialect core{sizeof core, 330, LODESTAR_PROFILE_CORE, 0, 0, 0};
    const LodestarDialect odd{sizeof odd, 120, LODESTAR_PROFILE_CORE, 0, 0, 0};
    const LodestarDialect pasted{sizeof pasted, 450, LODESTAR_PROFILE_COMPATIBILITY, 1, 0, 0};
    std::size_t size = 0;
    EXPECT_EQ(api.glsl_text("lodestar/none.glsl", &core, nullptr, &size), LODESTAR_E_UNSUPPORTED);
    EXPECT_EQ(api.glsl_text("host/mesh.frag", &core, nullptr, &size), LODESTAR_E_UNSUPPORTED);
    EXPECT_EQ(api.glsl_text("lodestar/lobes.glsl", &odd, nullptr, &size), LODESTAR_E_UNSUPPORTED);
    EXPECT_EQ(api.glsl_text(nullptr, &core, nullptr, &size), LODESTAR_E_ARG);
    EXPECT_EQ(api.glsl_text("lodestar/lobes.glsl", nullptr, nullptr, &size), LODESTAR_E_ABI);
    ASSERT_EQ(api.glsl_text("lodestar/lobes.glsl", &pasted, nullptr, &size), LODESTAR_MORE);
    std::string text(size, '\0');
    ASSERT_EQ(api.glsl_text("lodestar/lobes.glsl", &pasted, text.data(), &size), LODESTAR_OK);
    EXPECT_EQ(text.find("#version"), std::string::npos);
    EXPECT_EQ(text.back(), '\0');
}

} // namespace
} // namespace lodestar::testing
