// SPDX-License-Identifier: MIT
//
// Whatever a host has set, it finds again; and what it has set does not change what is uploaded or
// read.
#include "gl_host.h"
#include "untidy_host.h"

namespace lodestar::testing {
namespace {

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
