// SPDX-License-Identifier: MIT
//
// Light probes as textures of a host's OpenGL context: they arrive and go, the host's state stays,
// and a surface is lit by them.
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "gl_host.h"
#include "probe_host.h"
#include "sun.h"
#include "untidy_host.h"

namespace lodestar::testing {
namespace {

class AbiGlProbes : public ProbeHost<AbiGl> {
protected:
    [[nodiscard]] LodestarGlTexture textureOf(LodestarProbe probe, int texels) const {
        LodestarGlTexture made{};
        made.struct_size = sizeof made;
        EXPECT_EQ(probes->probe_texture(context, probe, texels, &made), LODESTAR_OK);
        return made;
    }
    [[nodiscard]] LodestarWork done() const {
        LodestarWork work{};
        work.struct_size = sizeof work;
        EXPECT_EQ(gl->work(context, &work), LODESTAR_OK);
        return work;
    }
    /// Textures hold what a plan says a probe has.
    void expectTexels(LodestarPlan plan, LodestarProbe probe) {
        for (const int which : {LODESTAR_TEXELS_ENVIRONMENT, LODESTAR_TEXELS_IRRADIANCE}) {
            const LodestarGlTexture made = textureOf(probe, which);
            const LodestarCube described = cube(plan, probe, which);
            ASSERT_EQ(made.target, static_cast<GLenum>(GL_TEXTURE_CUBE_MAP));
            ASSERT_EQ(made.width, described.width);
            ASSERT_EQ(made.internal_format, static_cast<GLenum>(GL_RGBA16F));
            glBindTexture(GL_TEXTURE_CUBE_MAP, made.name);
            glPixelStorei(GL_PACK_ALIGNMENT, 1);
            for (std::uint32_t level = 0; level < described.levels; ++level) {
                std::size_t size = 0;
                probes->plan_probe_texels(context, plan, probe, which, level, nullptr, &size);
                std::vector<unsigned char> expected(size), got(size);
                ASSERT_EQ(probes->plan_probe_texels(context, plan, probe, which, level,
                                                    expected.data(), &size),
                          LODESTAR_OK);
                for (GLenum face = 0; face < 6; ++face) {
                    glGetTexImage(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, static_cast<GLint>(level),
                                  GL_RGBA, GL_HALF_FLOAT, got.data() + face * (size / 6));
                }
                EXPECT_EQ(got, expected) << "level " << level;
            }
        }
    }
};

TEST_F(AbiGlProbes, TexelsArriveAndGo) {
    LodestarGlTexture none{};
    none.struct_size = sizeof none;
    const LodestarProbe probe = create(probeDesc());
    EXPECT_EQ(probes->probe_texture(context, probe, LODESTAR_TEXELS_ENVIRONMENT, &none),
              LODESTAR_E_ARG)
        << "not attached";
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    EXPECT_EQ(probes->probe_texture(context, probe, LODESTAR_TEXELS_MAP, &none), LODESTAR_E_ARG);
    setSky("gradient:0.1,3");
    ASSERT_EQ(gl->execute(context, planAndDraw({0.25f, 0.5f, 0.125f, 0.5f})), LODESTAR_OK);
    EXPECT_EQ(textureOf(probe, LODESTAR_TEXELS_ENVIRONMENT).name, 0u) << "it is drawn yet";
    LodestarPlan plan = planned();
    ASSERT_EQ(gl->execute(context, plan), LODESTAR_OK);
    expectTexels(plan, probe);
    const GLuint name = textureOf(probe, LODESTAR_TEXELS_ENVIRONMENT).name;
    const GLuint irradiance = textureOf(probe, LODESTAR_TEXELS_IRRADIANCE).name;
    // Another sky behind it, in the same textures.
    setSky("gradient:0.1,3.05");
    plan = planned();
    ASSERT_EQ(gl->execute(context, plan), LODESTAR_OK);
    expectTexels(plan, probe);
    EXPECT_EQ(textureOf(probe, LODESTAR_TEXELS_ENVIRONMENT).name, name);
    // A plan without boxes shows no probe, and ends none.
    ASSERT_EQ(update(12.0), LODESTAR_OK);
    EXPECT_EQ(glIsTexture(name), GL_TRUE);
    ASSERT_EQ(probes->probe_destroy(context, probe), LODESTAR_OK);
    ASSERT_EQ(gl->execute(context, planned()), LODESTAR_OK);
    EXPECT_EQ(glIsTexture(name), GL_FALSE);
    EXPECT_EQ(glIsTexture(irradiance), GL_FALSE);
    // What is left goes with the attachment.
    const LodestarProbe other = create(probeDesc());
    planAndDraw({1, 1, 1, 1});
    ASSERT_EQ(gl->execute(context, planned()), LODESTAR_OK);
    const GLuint last = textureOf(other, LODESTAR_TEXELS_IRRADIANCE).name;
    EXPECT_EQ(glIsTexture(last), GL_TRUE);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
    EXPECT_EQ(glIsTexture(last), GL_FALSE);
}

// Only what lights something is uploaded, once; plans foresee it.
TEST_F(AbiGlProbes, TheWorkIsForeseen) {
    ASSERT_EQ(gl->attach(context, countedProcedure), LODESTAR_OK);
    create(probeDesc());
    LodestarProbeDesc far = probeDesc();
    far.position[0] = 100.0;
    const LodestarProbe unseen = create(far);
    LodestarEnvironmentDesc held{};
    held.struct_size = sizeof held;
    held.layout = LODESTAR_ANALYTIC;
    held.analytic = "constant:1,1,1";
    held.face_width = 8;
    LodestarEnvironment environment = 0;
    ASSERT_EQ(api.environment_create(context, &held, &environment), LODESTAR_OK);
    ASSERT_EQ(probes->probe_hold(context, unseen, environment), LODESTAR_OK);
    LodestarWork foreseen{};
    for (int i = 0; i < 4; ++i) {
        if (i == 2) {
            setSky("constant:1,2,3");
        }
        const LodestarPlan plan = planAndDraw({0.5f, 0.5f, 0.5f, 0.5f});
        LodestarWork work{};
        work.struct_size = sizeof work;
        ASSERT_EQ(api.plan_work(context, plan, &work), LODESTAR_OK);
        foreseen.uploads += work.uploads;
        foreseen.upload_bytes += work.upload_bytes;
        foreseen.texels_written += work.texels_written;
        ASSERT_EQ(gl->execute(context, plan), LODESTAR_OK);
    }
    const LodestarWork work = done();
    EXPECT_EQ(work.uploads, foreseen.uploads);
    EXPECT_EQ(work.upload_bytes, foreseen.upload_bytes);
    EXPECT_EQ(work.texels_written, foreseen.texels_written);
    EXPECT_EQ(textureOf(unseen, LODESTAR_TEXELS_ENVIRONMENT).name, 0u);
    calls = {};
    for (int i = 0; i < 3; ++i) {
        ASSERT_EQ(gl->execute(context, planned()), LODESTAR_OK);
    }
    EXPECT_EQ(calls.queries + calls.changes, 0) << "a steady frame makes no call";
    EXPECT_EQ(done().uploads, work.uploads);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
}

TEST_F(AbiGlProbes, TheHostsStateStays) {
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    Untidy host;
    std::uint64_t uploads = 0;
    LodestarProbe probe = create(probeDesc());
    for (int round = 0; round < 30; ++round) {
        if (round % 5 == 4) { // its textures end in the next plan, others begin
            ASSERT_EQ(probes->probe_destroy(context, probe), LODESTAR_OK);
            probe = create(probeDesc());
        }
        planAndDraw({0.1f * static_cast<float>(round), 1.0f, 1.0f, 1.0f});
        ASSERT_EQ(probes->probe_request(context, probe), LODESTAR_OK);
        const LodestarPlan plan = planned();
        host.scramble();
        const State before = stateOf();
        ASSERT_EQ(gl->execute(context, plan), LODESTAR_OK);
        ASSERT_EQ(stateOf(), before) << "round " << round;
        uploads += done().uploads;
    }
    EXPECT_GT(uploads, 0u);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
}

/// One texel of a surface that faces up, in the world.
class Surface {
public:
    Surface(const LodestarApi& api, const std::string& defines) : api_(api) {
        const LodestarDialect dialect{sizeof dialect, 330, LODESTAR_PROFILE_CORE, 1, 0, 0};
        std::size_t size = 0;
        EXPECT_EQ(api.glsl_text("plugin/lighting.glsl", &dialect, nullptr, &size), LODESTAR_MORE);
        std::string text(size, '\0');
        EXPECT_EQ(api.glsl_text("plugin/lighting.glsl", &dialect, text.data(), &size), LODESTAR_OK);
        text.resize(size - 1);
        add(GL_VERTEX_SHADER,
            "#version 330 core\nvoid main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, "
            "gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0); }");
        add(GL_FRAGMENT_SHADER, "#version 330 core\n" + defines + text + R"(
uniform vec3 at;
out vec4 oColor;
void main() {
    LodestarSurface here;
    here.normal = here.view = vec3(0.0, 1.0, 0.0);
    here.diffuse = vec3(1.0);
    here.f0 = vec3(0.0);
    here.exponent = 0.0;
    here.occlusion = 1.0;
    oColor = vec4(lodestar_lightingAt(here, at, vec3(0.0), vec3(0.0)), 1.0);
})");
        glLinkProgram(program_);
        GLint linked = GL_FALSE;
        glGetProgramiv(program_, GL_LINK_STATUS, &linked);
        EXPECT_EQ(linked, GL_TRUE);
        glGenFramebuffers(1, &framebuffer_);
        glGenTextures(1, &target_);
        glGenVertexArrays(1, &vertexArray_);
        glBindTexture(GL_TEXTURE_2D, target_);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 1, 1, 0, GL_RGBA, GL_FLOAT, nullptr);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target_, 0);
        glViewport(0, 0, 1, 1);
        glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
        glUseProgram(program_);
    }
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;
    ~Surface() {
        glDeleteProgram(program_);
        glDeleteTextures(1, &target_);
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteVertexArrays(1, &vertexArray_);
    }

    /// The uniforms and textures of a plan that has been executed.
    void setPlan(const LodestarGlApi& gl, LodestarContext* context, LodestarPlan plan) {
        std::size_t size = 0;
        api_.plan_uniforms(context, plan, nullptr, &size);
        std::vector<float> data(size / sizeof(float));
        ASSERT_EQ(api_.plan_uniforms(context, plan, data.data(), &size), LODESTAR_OK);
        LodestarUniform info{};
        info.struct_size = sizeof info;
        for (std::uint32_t i = 0; api_.uniform_info(i, &info) == LODESTAR_OK; ++i) {
            if (info.type == LODESTAR_UNIFORM_VEC4) {
                glUniform4fv(place(info.name), static_cast<GLsizei>(info.count),
                             data.data() + info.offset / sizeof(float));
                continue;
            }
            LodestarGlTexture texture{};
            texture.struct_size = sizeof texture;
            ASSERT_EQ(gl.texture(context, info.texels, &texture), LODESTAR_OK);
            bind(info.name, texture, info.texels);
        }
    }
    void setProbe(const LodestarProbesApi& probes, LodestarContext* context, LodestarPlan plan,
                  const LodestarDrawProbes& draw) {
        float vectors[LODESTAR_PROBE_UNIFORMS][4];
        ASSERT_EQ(probes.plan_probe_uniforms(context, plan, &draw, &vectors[0][0]), LODESTAR_OK);
        glUniform4fv(place("lodestar_probes"), LODESTAR_PROBE_VECTORS, vectors[0]);
        glUniform4fv(place("lodestar_probeFactors"), 1, vectors[LODESTAR_PROBE_UNIFORMS - 1]);
        const std::pair<const char*, int> samplers[] = {
            {"lodestar_probeTexels0", LODESTAR_TEXELS_ENVIRONMENT},
            {"lodestar_probeIrradiance0", LODESTAR_TEXELS_IRRADIANCE}};
        for (const auto& [name, texels] : samplers) {
            LodestarGlTexture texture{};
            texture.struct_size = sizeof texture;
            ASSERT_EQ(probes.probe_texture(context, draw.probe[0], texels, &texture), LODESTAR_OK);
            bind(name, texture, 5 + texels);
        }
    }
    glm::vec3 lit(const glm::vec3& at) {
        glUniform3f(place("at"), at.x, at.y, at.z);
        glBindVertexArray(vertexArray_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        float pixel[4] = {};
        glReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, pixel);
        return {pixel[0], pixel[1], pixel[2]};
    }

private:
    void add(GLenum stage, const std::string& text) {
        const char* source = text.c_str();
        const GLuint shader = glCreateShader(stage);
        glShaderSource(shader, 1, &source, nullptr);
        glCompileShader(shader);
        char log[1024] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        GLint made = GL_FALSE;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &made);
        EXPECT_EQ(made, GL_TRUE) << log;
        glAttachShader(program_, shader);
        glDeleteShader(shader);
    }
    [[nodiscard]] GLint place(const char* name) const {
        return glGetUniformLocation(program_, name);
    }
    void bind(const char* name, const LodestarGlTexture& texture, int unit) const {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(texture.target, texture.name);
        glUniform1i(place(name), unit);
    }

    const LodestarApi& api_;
    GLuint program_ = glCreateProgram(), framebuffer_ = 0, target_ = 0, vertexArray_ = 0;
};

// Half of the directions are covered by 0.25: a sky of 1 shines through by half, so does a sun that
// casts no shadow; one that the host shadows is the host's.
TEST_F(AbiGlProbes, ASurfaceIsLit) {
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    setSky("constant:1,1,1");
    Sun sun;
    sun.stops[0] = {0, {4, 2, 1}, 0};
    sun.stops[1] = {20, {4, 2, 1}, 0};
    LodestarLight light = 0;
    ASSERT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK);
    create(probeDesc());
    planAndDraw({0.25f, 0.25f, 0.25f, 0.5f});
    const LodestarPlan plan = planned();
    ASSERT_EQ(gl->execute(context, plan), LODESTAR_OK);
    const LodestarDrawProbes draw = draws(plan)[0];
    const glm::vec3 outside(9.0f, 0.0f, 0.0f), inside(0.0f);
    constexpr float kHalf = 2e-3f; // steps of half floats, and the means of the mips
    const auto near = [&](const glm::vec3& got, const glm::vec3& wanted) {
        EXPECT_LT(glm::length(got - wanted), kHalf * glm::length(wanted))
            << got.r << " " << got.g << " " << got.b;
    };
    glm::vec3 full(0.0f);
    for (const char* shadow : {"", "1.0", "0.25", "-1.0"}) {
        const std::string hook = "#define LODESTAR_WITH_HOST_VISIBILITY 1\n"
                                 "float lodestar_host_visibility(int light) { return " +
                                 std::string(shadow) + "; }\n";
        Surface surface(api, "#define LODESTAR_WITH_PROBES 1\n" + (*shadow != 0 ? hook : ""));
        surface.setPlan(*gl, context, plan);
        surface.setProbe(*probes, context, plan, draw);
        const float own = *shadow != 0 ? std::stof(shadow) : -1.0f;
        const glm::vec3 there = surface.lit(outside) - glm::vec3(1.0f);
        full = *shadow == 0 ? there : full;
        EXPECT_GT(full.r, 0.3f) << "the sun's";
        near(there, (own < 0.0f ? 1.0f : own) * full);
        near(surface.lit(inside), glm::vec3(0.75f) + (own < 0.0f ? 0.5f : own) * full);
    }
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
}

} // namespace
} // namespace lodestar::testing
