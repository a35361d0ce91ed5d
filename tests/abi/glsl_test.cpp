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
    const LodestarDialect dialects[] = {{sizeof(LodestarDialect), 330, LODESTAR_PROFILE_CORE, 0},
                                        {sizeof(LodestarDialect), 410, LODESTAR_PROFILE_CORE, 0},
                                        {sizeof(LodestarDialect), 450, LODESTAR_PROFILE_CORE, 0},
                                        {sizeof(LodestarDialect), 300, LODESTAR_PROFILE_ES, 0}};
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

TEST_F(AbiGlsl, WhatIsNotThereIsSaid) {
    const LodestarDialect core{sizeof core, 330, LODESTAR_PROFILE_CORE, 0};
    const LodestarDialect odd{sizeof odd, 120, LODESTAR_PROFILE_CORE, 0};
    const LodestarDialect pasted{sizeof pasted, 450, LODESTAR_PROFILE_COMPATIBILITY, 1};
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
