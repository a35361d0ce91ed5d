// SPDX-License-Identifier: MIT
//
// The extension "lodestar.gl" in a host's context: the texels arrive, the host's state stays.
#include <cstring>
#include <vector>

#include "gl_host.h"

namespace lodestar::testing {
namespace {

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
