// SPDX-License-Identifier: MIT
//
// The extension "lodestar.gl" in a host's context: the texels arrive, the host's state stays.
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "lodestar/lodestar.h"
#include "support/gl_fixture.h"

namespace lodestar::testing {
namespace {

void* procedure(const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

/// Calls that the library made, by kind.
struct Calls {
    int queries = 0, changes = 0, uploads = 0;
};
Calls calls;

/// As procedure, with the calls counted.
void* countedProcedure(const char* name) {
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

/// All integers of the state that a host may rely on, by name.
std::vector<std::pair<GLenum, std::vector<GLint>>> stateOf() {
    constexpr GLenum kNames[] = {GL_CURRENT_PROGRAM,
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
                                 GL_BLEND_EQUATION_RGB,
                                 GL_DEPTH_FUNC,
                                 GL_DEPTH_WRITEMASK,
                                 GL_STENCIL_FUNC,
                                 GL_STENCIL_WRITEMASK,
                                 GL_CULL_FACE_MODE,
                                 GL_FRONT_FACE,
                                 GL_POLYGON_MODE,
                                 GL_COLOR_WRITEMASK,
                                 GL_PACK_ALIGNMENT,
                                 GL_PACK_ROW_LENGTH,
                                 GL_PACK_SKIP_ROWS,
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
                                 GL_RASTERIZER_DISCARD,
                                 GL_PRIMITIVE_RESTART,
                                 GL_DITHER};
    std::vector<std::pair<GLenum, std::vector<GLint>>> state;
    for (const GLenum name : kNames) {
        std::vector<GLint> values(4, -7);
        glGetIntegerv(name, values.data());
        state.emplace_back(name, values);
    }
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLenum unit = 0; unit < 16; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        constexpr GLenum kBindings[] = {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_CUBE_MAP,
                                        GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_1D,
                                        GL_SAMPLER_BINDING};
        for (const GLenum name : kBindings) {
            GLint value = -7;
            glGetIntegerv(name, &value);
            state.emplace_back(name, std::vector<GLint>{static_cast<GLint>(unit), value});
        }
    }
    glActiveTexture(static_cast<GLenum>(active));
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

TEST_F(AbiGl, TexelsArriveAndGo) {
    lights.make(api, context);
    EXPECT_EQ(update(12.0), LODESTAR_E_ARG) << "not attached";
    EXPECT_EQ(gl->attach(context, nullptr), LODESTAR_E_ARG);
    EXPECT_EQ(gl->attach(context, [](const char*) -> void* { return nullptr; }),
              LODESTAR_E_UNSUPPORTED);
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    EXPECT_EQ(gl->attach(context, procedure), LODESTAR_E_ARG) << "twice";
    EXPECT_EQ(gl->execute(context, 99), LODESTAR_E_ARG) << "no such plan";
    const LodestarPlan plan = planned(12.0);
    ASSERT_EQ(gl->execute(context, plan), LODESTAR_OK);
    for (const LodestarLight light : {lights.skyLight, lights.sunLight}) {
        const auto layer = static_cast<std::size_t>(layerOf(light, plan));
        for (int which = 0; which < 3; ++which) {
            const LodestarGlTexture made = texture(which);
            ASSERT_EQ(made.layers, 2u);
            std::size_t size = 0;
            ASSERT_EQ(api.light_texels(context, light, which, nullptr, &size), LODESTAR_MORE);
            std::vector<unsigned char> expected(size);
            ASSERT_EQ(api.light_texels(context, light, which, expected.data(), &size), LODESTAR_OK);
            std::vector<unsigned char> got(2 * size);
            glBindTexture(made.target, made.name);
            glPixelStorei(GL_PACK_ALIGNMENT, 1);
            const bool shared = made.internal_format == GL_RGB9_E5;
            const GLenum type = shared                               ? GL_UNSIGNED_INT_5_9_9_9_REV
                                : made.internal_format == GL_RGBA16F ? GL_HALF_FLOAT
                                                                     : GL_FLOAT;
            glGetTexImage(made.target, 0, shared ? GL_RGB : GL_RGBA, type, got.data());
            EXPECT_EQ(std::memcmp(got.data() + layer * size, expected.data(), size), 0) << which;
        }
    }
    // At night the sun keeps its layer and is not asked for; names stay.
    const LodestarGlTexture before = texture(LODESTAR_TEXELS_MAP);
    ASSERT_EQ(update(1.0), LODESTAR_OK);
    EXPECT_EQ(texture(LODESTAR_TEXELS_MAP).name, before.name);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
    EXPECT_EQ(glIsTexture(before.name), GL_FALSE);
    EXPECT_EQ(update(1.0), LODESTAR_E_ARG);
    // A context that was lost: nothing is called.
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    ASSERT_EQ(update(12.0), LODESTAR_OK);
    const LodestarGlTexture lost = texture(LODESTAR_TEXELS_MAP);
    ASSERT_EQ(gl->detach(context, 0), LODESTAR_OK);
    EXPECT_EQ(glIsTexture(lost.name), GL_TRUE);
    glDeleteTextures(1, &lost.name);
}

// Whatever a host has set, it finds again; and what it has set does not change what is uploaded.
TEST_F(AbiGl, TheHostsStateStays) {
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    lights.make(api, context);
    GLuint buffer = 0, array = 0, vertices = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    glBufferData(GL_PIXEL_UNPACK_BUFFER, 1 << 20, nullptr, GL_STATIC_DRAW);
    glGenTextures(1, &array);
    glGenVertexArrays(1, &vertices);
    std::mt19937 random(5u);
    const auto one = [&](int most) {
        return static_cast<GLint>(random() % static_cast<unsigned>(most));
    };
    for (int round = 0; round < 60; ++round) {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(one(16)));
        glBindTexture(GL_TEXTURE_2D_ARRAY, one(2) != 0 ? array : 0);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, one(2) != 0 ? buffer : 0);
        glBindVertexArray(one(2) != 0 ? vertices : 0);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1 << one(4));
        glPixelStorei(GL_UNPACK_ROW_LENGTH, one(3) * 300);
        glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, one(3) * 40);
        glPixelStorei(GL_UNPACK_SKIP_ROWS, one(3));
        glPixelStorei(GL_UNPACK_SKIP_PIXELS, one(3));
        glPixelStorei(GL_UNPACK_SKIP_IMAGES, one(2));
        glPixelStorei(GL_UNPACK_SWAP_BYTES, one(2));
        one(2) != 0 ? glEnable(GL_BLEND) : glDisable(GL_BLEND);
        one(2) != 0 ? glEnable(GL_RASTERIZER_DISCARD) : glDisable(GL_RASTERIZER_DISCARD);
        glFrontFace(one(2) != 0 ? GL_CW : GL_CCW);
        glViewport(one(9), one(9), 30, 20);
        const auto before = stateOf();
        // Every round something is uploaded, in some all is made anew.
        if (round % 10 == 9) {
            ASSERT_EQ(api.light_destroy(context, lights.skyLight), LODESTAR_OK);
            ASSERT_EQ(api.light_destroy(context, lights.sunLight), LODESTAR_OK);
            lights.make(api, context);
        }
        ASSERT_EQ(update(6.0 + 0.1 * round), LODESTAR_OK);
        ASSERT_EQ(stateOf(), before) << "round " << round;
    }
    const LodestarGlTexture map = texture(LODESTAR_TEXELS_MAP);
    std::size_t size = 0;
    const auto layer = static_cast<std::size_t>(layerOf(lights.skyLight, planned(11.9)));
    ASSERT_EQ(api.light_texels(context, lights.skyLight, LODESTAR_TEXELS_MAP, nullptr, &size),
              LODESTAR_MORE);
    std::vector<unsigned char> expected(size), got(2 * size);
    ASSERT_EQ(
        api.light_texels(context, lights.skyLight, LODESTAR_TEXELS_MAP, expected.data(), &size),
        LODESTAR_OK);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glBindTexture(map.target, map.name);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(map.target, 0, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, got.data());
    EXPECT_EQ(std::memcmp(got.data() + layer * size, expected.data(), size), 0);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
    glDeleteTextures(1, &array);
    glDeleteBuffers(1, &buffer);
    glDeleteVertexArrays(1, &vertices);
}

TEST_F(AbiGl, ASteadyFrameMakesNoCall) {
    ASSERT_EQ(gl->attach(context, countedProcedure), LODESTAR_OK);
    lights.make(api, context);
    calls = {};
    ASSERT_EQ(update(12.0), LODESTAR_OK);
    EXPECT_EQ(calls.uploads, 6) << "three textures of two lights";
    EXPECT_EQ(calls.queries, 11) << "three bindings and eight ways to unpack";
    calls = {};
    for (int frame = 0; frame < 10; ++frame) { // the sun moves, its texels do not change
        ASSERT_EQ(update(12.0 + 0.01 * frame), LODESTAR_OK);
    }
    EXPECT_EQ(calls.uploads + calls.queries + calls.changes, 0);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
}

TEST_F(AbiGl, AHostThatResetsIsAskedNothing) {
    EXPECT_EQ(gl->set_host_resets(context, 1), LODESTAR_E_ARG) << "not attached";
    ASSERT_EQ(gl->attach(context, countedProcedure), LODESTAR_OK);
    ASSERT_EQ(gl->set_host_resets(context, 1), LODESTAR_OK);
    lights.make(api, context);
    const auto initial = stateOf();
    GLuint array = 0, buffer = 0;
    glGenTextures(1, &array);
    glGenBuffers(1, &buffer);
    glBindTexture(GL_TEXTURE_2D_ARRAY, array);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    constexpr GLenum kLengths[] = {GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT,
                                   GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
                                   GL_UNPACK_SKIP_IMAGES};
    for (const GLenum store : kLengths) {
        glPixelStorei(store, 3);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
    glPixelStorei(GL_UNPACK_SWAP_BYTES, 1);
    glPixelStorei(GL_UNPACK_LSB_FIRST, 1);
    calls = {};
    ASSERT_EQ(update(12.0), LODESTAR_OK);
    EXPECT_EQ(calls.uploads, 6);
    EXPECT_EQ(calls.queries, 0);
    EXPECT_EQ(stateOf(), initial) << "what the header says is left";
    // Without the mode the state is the host's again.
    ASSERT_EQ(gl->set_host_resets(context, 0), LODESTAR_OK);
    glBindTexture(GL_TEXTURE_2D_ARRAY, array);
    ASSERT_EQ(api.light_destroy(context, lights.sunLight), LODESTAR_OK);
    const auto before = stateOf();
    ASSERT_EQ(update(12.0), LODESTAR_OK);
    EXPECT_EQ(stateOf(), before);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
    glDeleteTextures(1, &array);
    glDeleteBuffers(1, &buffer);
}

// The host has a texture of the library's bound while that is made anew: the name that was queried
// is of nothing by then.
TEST_F(AbiGl, AnEndedTextureIsNotBoundAgain) {
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    lights.make(api, context);
    ASSERT_EQ(update(12.0), LODESTAR_OK);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture(LODESTAR_TEXELS_LAMBERT).name);
    ASSERT_EQ(api.light_destroy(context, lights.skyLight), LODESTAR_OK);
    ASSERT_EQ(api.light_destroy(context, lights.sunLight), LODESTAR_OK);
    ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    ASSERT_EQ(update(12.0), LODESTAR_OK); // no lights: the textures end, none is made
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    GLint bound = -1;
    glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &bound);
    EXPECT_EQ(bound, 0);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
}

} // namespace
} // namespace lodestar::testing
