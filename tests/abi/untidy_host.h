// SPDX-License-Identifier: MIT
//
// A host of OpenGL's in tests that leaves any state behind.
#pragma once

#include <array>
#include <initializer_list>
#include <random>

#include <epoxy/gl.h>

namespace lodestar::testing {

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

} // namespace lodestar::testing
