// SPDX-License-Identifier: MIT
//
// A host with OpenGL in tests: its calls counted, its state compared.
#pragma once

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "lodestar/lodestar.h"
#include "support/gl_fixture.h"

namespace lodestar::testing {

inline void* procedure(const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

/// Calls that the library made, by kind.
struct Calls {
    int queries = 0, changes = 0, uploads = 0;
};
inline Calls calls;

/// As procedure, with the calls counted.
inline void* countedProcedure(const char* name) {
    const auto as = [](auto* function) { return reinterpret_cast<void*>(function); };
    const std::string wanted(name);
    if (wanted == "glGetIntegerv") {
        return as(+[](GLenum what, GLint* value) { ++calls.queries, glGetIntegerv(what, value); });
    }
    if (wanted == "glBindTexture") {
        return as(+[](GLenum to, GLuint texture) { ++calls.changes, glBindTexture(to, texture); });
    }
    if (wanted == "glBindBuffer") {
        return as(+[](GLenum to, GLuint buffer) { ++calls.changes, glBindBuffer(to, buffer); });
    }
    if (wanted == "glPixelStorei") {
        return as(+[](GLenum what, GLint value) { ++calls.changes, glPixelStorei(what, value); });
    }
    if (wanted == "glTexSubImage3D") {
        return as(+[](GLenum to, GLint level, GLint x, GLint y, GLint z, GLsizei width,
                      GLsizei height, GLsizei depth, GLenum format, GLenum type,
                      const void* texels) {
            ++calls.uploads;
            glTexSubImage3D(to, level, x, y, z, width, height, depth, format, type, texels);
        });
    }
    return procedure(name);
}

/// A sky of one key, and a sun that has set at night.
struct TwoLights {
    LodestarStop sky[2] = {{90, {0.1, 0.3, 0.6}, 0}, {-90, {0.8, 0.7, 0.5}, 0}};
    LodestarStop sun[2] = {{0, {1, 0.9, 0.8}, 10}, {3, {1, 0.9, 0.8}, 10}};
    LodestarLight skyLight = 0, sunLight = 0;

    void make(const LodestarApi& api, LodestarContext* context) {
        LodestarKey key{};
        key.struct_size = sizeof key;
        key.stops = sky;
        key.stop_count = 2;
        key.hour = 12.0;
        key.tint[0] = key.tint[1] = key.tint[2] = 1.0;
        LodestarLightDesc desc{};
        desc.struct_size = sizeof desc;
        desc.axis[1] = 1.0;
        desc.key_count = 1;
        desc.key_stride = sizeof key;
        desc.keys = &key;
        ASSERT_EQ(api.light_create(context, &desc, &skyLight), LODESTAR_OK);
        key.stops = sun;
        desc.kind = LODESTAR_SUN;
        desc.has_path = 1;
        desc.day_of_year = 81;
        desc.north[2] = -1.0;
        ASSERT_EQ(api.light_create(context, &desc, &sunLight), LODESTAR_OK);
    }
};

/// The state that a host may rely on (what a guard would have to save if a library drew), by name.
/// Floats as their bits.
using State = std::vector<std::pair<GLenum, std::vector<GLint>>>;

inline void addIntegers(State& state) {
    constexpr GLenum kNames[] = {GL_CURRENT_PROGRAM,
                                 GL_PROGRAM_PIPELINE_BINDING,
                                 GL_ACTIVE_TEXTURE,
                                 GL_VERTEX_ARRAY_BINDING,
                                 GL_ARRAY_BUFFER_BINDING,
                                 GL_UNIFORM_BUFFER_BINDING,
                                 GL_PIXEL_PACK_BUFFER_BINDING,
                                 GL_PIXEL_UNPACK_BUFFER_BINDING,
                                 GL_DRAW_FRAMEBUFFER_BINDING,
                                 GL_READ_FRAMEBUFFER_BINDING,
                                 GL_RENDERBUFFER_BINDING,
                                 GL_VIEWPORT,
                                 GL_SCISSOR_BOX,
                                 GL_BLEND_SRC_RGB,
                                 GL_BLEND_DST_RGB,
                                 GL_BLEND_SRC_ALPHA,
                                 GL_BLEND_DST_ALPHA,
                                 GL_BLEND_EQUATION_RGB,
                                 GL_BLEND_EQUATION_ALPHA,
                                 GL_DEPTH_FUNC,
                                 GL_DEPTH_WRITEMASK,
                                 GL_STENCIL_FUNC,
                                 GL_STENCIL_REF,
                                 GL_STENCIL_VALUE_MASK,
                                 GL_STENCIL_FAIL,
                                 GL_STENCIL_PASS_DEPTH_FAIL,
                                 GL_STENCIL_PASS_DEPTH_PASS,
                                 GL_STENCIL_WRITEMASK,
                                 GL_STENCIL_BACK_FUNC,
                                 GL_STENCIL_BACK_REF,
                                 GL_STENCIL_BACK_VALUE_MASK,
                                 GL_STENCIL_BACK_FAIL,
                                 GL_STENCIL_BACK_PASS_DEPTH_FAIL,
                                 GL_STENCIL_BACK_PASS_DEPTH_PASS,
                                 GL_STENCIL_BACK_WRITEMASK,
                                 GL_CULL_FACE_MODE,
                                 GL_FRONT_FACE,
                                 GL_POLYGON_MODE,
                                 GL_COLOR_WRITEMASK,
                                 GL_STENCIL_CLEAR_VALUE,
                                 GL_PACK_ALIGNMENT,
                                 GL_PACK_ROW_LENGTH,
                                 GL_PACK_IMAGE_HEIGHT,
                                 GL_PACK_SKIP_ROWS,
                                 GL_PACK_SKIP_PIXELS,
                                 GL_PACK_SKIP_IMAGES,
                                 GL_PACK_SWAP_BYTES,
                                 GL_PACK_LSB_FIRST,
                                 GL_UNPACK_ALIGNMENT,
                                 GL_UNPACK_ROW_LENGTH,
                                 GL_UNPACK_IMAGE_HEIGHT,
                                 GL_UNPACK_SKIP_ROWS,
                                 GL_UNPACK_SKIP_PIXELS,
                                 GL_UNPACK_SKIP_IMAGES,
                                 GL_UNPACK_SWAP_BYTES,
                                 GL_UNPACK_LSB_FIRST,
                                 GL_BLEND,
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
                                 GL_CLIP_DISTANCE5};
    for (const GLenum name : kNames) {
        std::vector<GLint> values(4, -7);
        glGetIntegerv(name, values.data());
        state.emplace_back(name, values);
    }
}

inline void addFloats(State& state) {
    constexpr GLenum kNames[] = {GL_COLOR_CLEAR_VALUE, GL_DEPTH_CLEAR_VALUE, GL_DEPTH_RANGE,
                                 GL_POLYGON_OFFSET_FACTOR, GL_POLYGON_OFFSET_UNITS};
    for (const GLenum name : kNames) {
        GLfloat values[4] = {-7.0f, -7.0f, -7.0f, -7.0f};
        glGetFloatv(name, values);
        std::vector<GLint> bits(4);
        std::memcpy(bits.data(), values, sizeof values);
        state.emplace_back(name, bits);
    }
}

inline void addIndexed(State& state) {
    for (GLuint i = 0; i < 8; ++i) {
        constexpr GLenum kNames[] = {GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
                                     GL_UNIFORM_BUFFER_SIZE};
        for (const GLenum name : kNames) {
            GLint64 value = -7;
            glGetInteger64i_v(name, i, &value);
            state.emplace_back(
                name, std::vector<GLint>{static_cast<GLint>(i), static_cast<GLint>(value)});
        }
    }
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLenum unit = 0; unit < 16; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        constexpr GLenum kBindings[] = {GL_TEXTURE_BINDING_2D,
                                        GL_TEXTURE_BINDING_CUBE_MAP,
                                        GL_TEXTURE_BINDING_CUBE_MAP_ARRAY,
                                        GL_TEXTURE_BINDING_2D_ARRAY,
                                        GL_TEXTURE_BINDING_1D,
                                        GL_SAMPLER_BINDING};
        for (const GLenum name : kBindings) {
            GLint value = -7;
            glGetIntegerv(name, &value);
            state.emplace_back(name, std::vector<GLint>{static_cast<GLint>(unit), value});
        }
    }
    glActiveTexture(static_cast<GLenum>(active));
}

inline State stateOf() {
    State state;
    addIntegers(state);
    addFloats(state);
    addIndexed(state);
    return state;
}

class AbiGl : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        api.struct_size = sizeof api;
        ASSERT_EQ(lodestar_get_api(LODESTAR_ABI_VERSION, &api), LODESTAR_OK);
        gl = static_cast<const LodestarGlApi*>(api.get_extension(LODESTAR_EXTENSION_GL));
        ASSERT_NE(gl, nullptr);
        EXPECT_EQ(api.get_extension("lodestar.vulkan"), nullptr);
        ASSERT_EQ(api.context_create(nullptr, &context), LODESTAR_OK);
    }
    void TearDown() override {
        EXPECT_EQ(api.context_destroy(context), LODESTAR_OK);
        GlTest::TearDown();
    }
    /// Plans an hour for all that a host may draw. @return the plan
    LodestarPlan planned(double hour) {
        LodestarFrame frame{};
        frame.struct_size = sizeof frame;
        frame.hour = hour;
        LodestarPlan plan = 0;
        EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_OK) << api.last_error(context);
        return plan;
    }
    LodestarStatus update(double hour) { return gl->execute(context, planned(hour)); }
    /// The layer of a light in a plan; -1: the frame is not lit by it.
    int layerOf(LodestarLight light, LodestarPlan plan) {
        std::size_t count = 0;
        EXPECT_GE(api.plan_lights(context, plan, nullptr, &count), LODESTAR_OK);
        std::vector<LodestarPlannedLight> lit(count);
        for (LodestarPlannedLight& one : lit) {
            one.struct_size = sizeof one;
        }
        EXPECT_EQ(api.plan_lights(context, plan, lit.data(), &count), LODESTAR_OK);
        for (const LodestarPlannedLight& one : lit) {
            if (one.light == light) {
                return static_cast<int>(one.layer);
            }
        }
        return -1;
    }
    [[nodiscard]] LodestarGlTexture texture(int which) const {
        LodestarGlTexture texture{};
        texture.struct_size = sizeof texture;
        EXPECT_EQ(gl->texture(context, which, &texture), LODESTAR_OK);
        return texture;
    }
    LodestarApi api{};
    const LodestarGlApi* gl = nullptr;
    LodestarContext* context = nullptr;
    TwoLights lights;
};

} // namespace lodestar::testing
