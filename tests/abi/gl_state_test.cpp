// SPDX-License-Identifier: MIT
//
// Whatever a host has set, it finds again; and what it has set does not change what is uploaded or
// read.
#include <array>
#include <random>

#include "gl_host.h"

namespace lodestar::testing {
namespace {

/// A host that leaves its context in any state there is.
class Untidy {
public:
    Untidy() {
        glGenBuffers(kEach, buffers_);
        glGenTextures(kEach, textures_);
        glGenTextures(kEach, cubes_);
        glGenTextures(kEach, arrays_);
        glGenSamplers(kEach, samplers_);
        glGenVertexArrays(kEach, vertexArrays_);
        glGenFramebuffers(kEach, framebuffers_);
        glGenRenderbuffers(kEach, renderbuffers_);
        for (const GLuint buffer : buffers_) {
            glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
            glBufferData(GL_PIXEL_UNPACK_BUFFER, 1 << 20, nullptr, GL_STATIC_DRAW);
        }
        program_ = glCreateProgram();
        const char* text = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }";
        const GLuint shader = glCreateShader(GL_VERTEX_SHADER);
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program_, shader);
        glLinkProgram(program_);
        glDeleteShader(shader);
    }
    Untidy(const Untidy&) = delete;
    Untidy& operator=(const Untidy&) = delete;
    ~Untidy() {
        glUseProgram(0);
        glDeleteProgram(program_);
        glDeleteBuffers(kEach, buffers_);
        glDeleteTextures(kEach, textures_);
        glDeleteTextures(kEach, cubes_);
        glDeleteTextures(kEach, arrays_);
        glDeleteSamplers(kEach, samplers_);
        glDeleteVertexArrays(kEach, vertexArrays_);
        glDeleteFramebuffers(kEach, framebuffers_);
        glDeleteRenderbuffers(kEach, renderbuffers_);
    }
    void scramble() {
        bindings();
        pixels();
        tests();
        enables();
    }

private:
    GLint upTo(int most) { return static_cast<GLint>(random_() % static_cast<unsigned>(most)); }
    GLuint any(const GLuint* names) { return upTo(3) == 0 ? 0 : names[upTo(kEach)]; }
    GLenum one(std::initializer_list<GLenum> of) {
        return *(of.begin() + upTo(static_cast<int>(of.size())));
    }
    void bindings() {
        for (GLenum unit = 0; unit < 16; ++unit) {
            glActiveTexture(GL_TEXTURE0 + unit);
            glBindTexture(GL_TEXTURE_2D, any(textures_));
            glBindTexture(GL_TEXTURE_CUBE_MAP, any(cubes_));
            glBindTexture(GL_TEXTURE_2D_ARRAY, any(arrays_));
            glBindSampler(unit, any(samplers_));
        }
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(upTo(16)));
        glBindVertexArray(any(vertexArrays_));
        for (const int target : {GL_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER}) {
            glBindBuffer(static_cast<GLenum>(target), any(buffers_));
        }
        for (GLuint i = 0; i < 8; ++i) {
            glBindBufferRange(GL_UNIFORM_BUFFER, i, buffers_[upTo(kEach)], 256 * upTo(4), 256);
        }
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, any(framebuffers_));
        glBindFramebuffer(GL_READ_FRAMEBUFFER, any(framebuffers_));
        glBindRenderbuffer(GL_RENDERBUFFER, any(renderbuffers_));
        glUseProgram(upTo(2) != 0 ? program_ : 0);
    }
    void pixels() {
        constexpr std::array<std::array<GLenum, 8>, 2> kStores = {
            {{GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT,
              GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES,
              GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST},
             {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_ROWS,
              GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES, GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST}}};
        for (const auto& stores : kStores) {
            glPixelStorei(stores[0], 1 << upTo(4));
            glPixelStorei(stores[1], 300 * upTo(3));
            glPixelStorei(stores[2], 40 * upTo(3));
            for (std::size_t i = 3; i < 8; ++i) {
                glPixelStorei(stores[i], i < 6 ? upTo(3) : upTo(2));
            }
        }
        glColorMask(upTo(2) != 0, upTo(2) != 0, upTo(2) != 0, upTo(2) != 0);
        glClearColor(0.1f * static_cast<float>(upTo(9)), 0.2f, 0.3f, 0.4f);
        glClearDepth(0.1 * upTo(9));
        glClearStencil(upTo(9));
        glViewport(upTo(9), upTo(9), 30, 20);
        glScissor(upTo(9), upTo(9), 30, 20);
    }
    void tests() {
        glBlendFuncSeparate(one({GL_ONE, GL_ZERO, GL_SRC_ALPHA}), one({GL_ONE, GL_ZERO}),
                            one({GL_ONE, GL_DST_ALPHA}), one({GL_ONE, GL_ZERO}));
        glBlendEquationSeparate(one({GL_FUNC_ADD, GL_MIN}), one({GL_FUNC_ADD, GL_MAX}));
        glDepthFunc(one({GL_LESS, GL_ALWAYS, GL_GEQUAL}));
        glDepthMask(upTo(2) != 0);
        glDepthRange(0.1 * upTo(5), 1.0);
        for (const int face : {GL_FRONT, GL_BACK}) {
            glStencilFuncSeparate(static_cast<GLenum>(face), one({GL_EQUAL, GL_NEVER}), upTo(9),
                                  0xf0u);
            glStencilOpSeparate(static_cast<GLenum>(face), one({GL_KEEP, GL_INCR}),
                                one({GL_KEEP, GL_ZERO}), GL_INVERT);
            glStencilMaskSeparate(static_cast<GLenum>(face), static_cast<GLuint>(upTo(255)));
        }
        glCullFace(one({GL_FRONT, GL_BACK, GL_FRONT_AND_BACK}));
        glFrontFace(one({GL_CW, GL_CCW}));
        glPolygonMode(GL_FRONT_AND_BACK, one({GL_FILL, GL_LINE}));
        glPolygonOffset(static_cast<float>(upTo(3)), static_cast<float>(upTo(3)));
    }
    void enables() {
        for (const int what : {GL_BLEND,
                               GL_CULL_FACE,
                               GL_DEPTH_TEST,
                               GL_SCISSOR_TEST,
                               GL_STENCIL_TEST,
                               GL_TEXTURE_CUBE_MAP_SEAMLESS,
                               GL_FRAMEBUFFER_SRGB,
                               GL_POLYGON_OFFSET_FILL,
                               GL_MULTISAMPLE,
                               GL_SAMPLE_ALPHA_TO_COVERAGE,
                               GL_RASTERIZER_DISCARD,
                               GL_DEPTH_CLAMP,
                               GL_PRIMITIVE_RESTART,
                               GL_COLOR_LOGIC_OP,
                               GL_DITHER,
                               GL_CLIP_DISTANCE0,
                               GL_CLIP_DISTANCE1,
                               GL_CLIP_DISTANCE2,
                               GL_CLIP_DISTANCE3,
                               GL_CLIP_DISTANCE4,
                               GL_CLIP_DISTANCE5}) {
            upTo(2) != 0 ? glEnable(static_cast<GLenum>(what))
                         : glDisable(static_cast<GLenum>(what));
        }
    }

    static constexpr int kEach = 3;
    std::mt19937 random_{5u};
    GLuint buffers_[kEach], textures_[kEach], cubes_[kEach], arrays_[kEach], samplers_[kEach],
        vertexArrays_[kEach], framebuffers_[kEach], renderbuffers_[kEach], program_ = 0;
};

class AbiGlState : public AbiGl {
protected:
    LodestarEnvironment environment(const char* analytic) {
        LodestarEnvironmentDesc desc{};
        desc.struct_size = sizeof desc;
        desc.layout = LODESTAR_ANALYTIC;
        desc.analytic = analytic;
        desc.face_width = 8;
        LodestarEnvironment made = 0;
        EXPECT_EQ(api.environment_create(context, &desc, &made), LODESTAR_OK);
        return made;
    }
    /// What the library has uploaded of a light's map is what it says of it.
    void expectMap(LodestarLight light, LodestarPlan plan) {
        const LodestarGlTexture map = texture(LODESTAR_TEXELS_MAP);
        const auto layer = static_cast<std::size_t>(layerOf(light, plan));
        std::size_t size = 0;
        api.light_texels(context, light, LODESTAR_TEXELS_MAP, nullptr, &size);
        std::vector<unsigned char> expected(size), got(map.layers * size);
        ASSERT_EQ(api.light_texels(context, light, LODESTAR_TEXELS_MAP, expected.data(), &size),
                  LODESTAR_OK);
        glBindTexture(map.target, map.name);
        glGetTexImage(map.target, 0, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, got.data());
        EXPECT_EQ(std::memcmp(got.data() + layer * size, expected.data(), size), 0);
    }
    void tidy() {
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        for (const int store :
             {GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
              GL_PACK_SKIP_IMAGES, GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST}) {
            glPixelStorei(static_cast<GLenum>(store), 0);
        }
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
    }
};

TEST_F(AbiGlState, StaysAtEveryHook) {
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    lights.make(api, context);
    GLuint cube = 0; // the host's own, to be read
    glGenTextures(1, &cube);
    glBindTexture(GL_TEXTURE_CUBE_MAP, cube);
    std::vector<float> faces(6 * 4 * 4 * 4);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        faces[i] = 0.25f * static_cast<float>(i);
    }
    for (GLenum face = 0; face < 6; ++face) {
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA32F, 4, 4, 0, GL_RGBA,
                     GL_FLOAT, &faces[face * 64]);
    }
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    Untidy host;
    LodestarPlan plan = 0;
    for (int round = 0; round < 60; ++round) {
        // Every round something is uploaded, in some all is made anew.
        if (round % 10 == 9) {
            ASSERT_EQ(api.light_destroy(context, lights.skyLight), LODESTAR_OK);
            ASSERT_EQ(api.light_destroy(context, lights.sunLight), LODESTAR_OK);
            lights.make(api, context);
        }
        if (round % 7 == 3) { // beside no sky: there is none in the odd ones
            ASSERT_EQ(api.light_destroy(context, lights.skyLight), LODESTAR_OK);
            ASSERT_EQ(api.set_environment(context, environment("gradient:0.1,3")), LODESTAR_OK);
        }
        host.scramble();
        const State before = stateOf();
        plan = planned(6.0 + 0.1 * round);
        ASSERT_EQ(gl->execute(context, plan), LODESTAR_OK);
        ASSERT_EQ(stateOf(), before) << "execute, round " << round;
        std::vector<float> read(faces.size());
        std::size_t size = read.size() * sizeof(float);
        ASSERT_EQ(gl->read_cube(context, cube, read.data(), &size), LODESTAR_OK);
        ASSERT_EQ(stateOf(), before) << "read_cube, round " << round;
        ASSERT_EQ(read, faces) << round;
        if (round % 7 == 3) {
            ASSERT_EQ(api.light_destroy(context, lights.sunLight), LODESTAR_OK);
            lights.make(api, context);
        }
    }
    tidy();
    ASSERT_EQ(update(11.95), LODESTAR_OK);
    expectMap(lights.skyLight, planned(11.95));
    host.scramble();
    const State before = stateOf();
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
    EXPECT_EQ(stateOf(), before) << "detach";
    glDeleteTextures(1, &cube);
}

// Without the guard the same states are not what they were: the test can fail.
TEST_F(AbiGlState, AHostThatResetsMustResetItself) {
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    ASSERT_EQ(gl->set_host_resets(context, 1), LODESTAR_OK);
    Untidy host;
    int changed = 0;
    for (int round = 0; round < 10; ++round) {
        lights.make(api, context);
        host.scramble();
        const State before = stateOf();
        ASSERT_EQ(update(12.0), LODESTAR_OK);
        changed += stateOf() == before ? 0 : 1;
    }
    EXPECT_GE(changed, 9);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
}

} // namespace
} // namespace lodestar::testing
