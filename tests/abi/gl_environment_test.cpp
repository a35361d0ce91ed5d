// SPDX-License-Identifier: MIT
//
// Environments as textures of a host's context, its own cubes as environments, and a thread of its
// own for OpenGL.
#include <atomic>
#include <cmath>
#include <thread>

#include "gl_host.h"
#include "platform/headless_context.h"

namespace lodestar::testing {
namespace {

class AbiGlEnvironment : public AbiGl {
protected:
    LodestarEnvironment make(const LodestarEnvironmentDesc& desc) {
        LodestarEnvironment made = 0;
        EXPECT_EQ(api.environment_create(context, &desc, &made), LODESTAR_OK)
            << api.last_error(context);
        return made;
    }
    LodestarEnvironment analytic(const char* text, std::uint32_t width = 8) {
        LodestarEnvironmentDesc desc{};
        desc.struct_size = sizeof desc;
        desc.layout = LODESTAR_ANALYTIC;
        desc.analytic = text;
        desc.face_width = width;
        return make(desc);
    }
    /// A texture of the library's holds what it says an environment has.
    void expectTexels(LodestarEnvironment environment, int which) {
        const LodestarGlTexture made = texture(which);
        LodestarCube cube{};
        cube.struct_size = sizeof cube;
        ASSERT_EQ(api.environment_cube(context, environment, which, &cube), LODESTAR_OK);
        ASSERT_EQ(made.width, cube.width);
        ASSERT_EQ(made.internal_format,
                  static_cast<GLenum>(cube.half_floats != 0 ? GL_RGBA16F : GL_RGBA32F));
        glBindTexture(GL_TEXTURE_CUBE_MAP, made.name);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        for (std::uint32_t level = 0; level < cube.levels; ++level) {
            std::size_t size = 0;
            api.environment_texels(context, environment, which, level, nullptr, &size);
            std::vector<unsigned char> expected(size), got(size);
            ASSERT_EQ(
                api.environment_texels(context, environment, which, level, expected.data(), &size),
                LODESTAR_OK);
            for (GLenum face = 0; face < 6; ++face) {
                glGetTexImage(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, static_cast<GLint>(level),
                              GL_RGBA, cube.half_floats != 0 ? GL_HALF_FLOAT : GL_FLOAT,
                              got.data() + face * (size / 6));
            }
            EXPECT_EQ(got, expected) << "level " << level;
        }
    }
};

TEST_F(AbiGlEnvironment, TexelsArrive) {
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    EXPECT_EQ(texture(LODESTAR_TEXELS_ENVIRONMENT).name, 0u) << "nothing yet";
    for (const char* text : {"gradient:0.1,3", "disc:0,1,0,10,1e6", "disc:0,1,0,10,1e9"}) {
        const LodestarEnvironment environment = analytic(text);
        ASSERT_EQ(api.set_environment(context, environment), LODESTAR_OK);
        ASSERT_EQ(update(12.0), LODESTAR_OK);
        expectTexels(environment, LODESTAR_TEXELS_ENVIRONMENT);
        expectTexels(environment, LODESTAR_TEXELS_IRRADIANCE);
    }
    // Another size, in the same texture.
    const GLuint name = texture(LODESTAR_TEXELS_ENVIRONMENT).name;
    const LodestarEnvironment wide = analytic("gradient:0.1,3", 32);
    ASSERT_EQ(api.set_environment(context, wide), LODESTAR_OK);
    ASSERT_EQ(update(12.0), LODESTAR_OK);
    expectTexels(wide, LODESTAR_TEXELS_ENVIRONMENT);
    EXPECT_EQ(texture(LODESTAR_TEXELS_ENVIRONMENT).name, name);
    const LodestarWork before = [&] {
        LodestarWork work{};
        work.struct_size = sizeof work;
        EXPECT_EQ(gl->work(context, &work), LODESTAR_OK);
        return work;
    }();
    ASSERT_EQ(update(13.0), LODESTAR_OK);
    LodestarWork after{};
    after.struct_size = sizeof after;
    EXPECT_EQ(gl->work(context, &after), LODESTAR_OK);
    EXPECT_EQ(after.uploads, before.uploads) << "a steady frame";
    EXPECT_EQ(after.state_queries, before.state_queries);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
    EXPECT_EQ(glIsTexture(name), GL_FALSE);
}

TEST_F(AbiGlEnvironment, AHostsCubeBecomesOne) {
    ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
    GLuint names[3] = {}; // a cube of halves, a 2-D texture, a cube without texels
    glGenTextures(3, names);
    glBindTexture(GL_TEXTURE_CUBE_MAP, names[0]);
    std::vector<float> face(8 * 8 * 4);
    for (GLenum f = 0; f < 6; ++f) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            face[i] = static_cast<float>(f) + 0.25f * static_cast<float>(i % 7);
        }
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + f, 0, GL_RGBA16F, 8, 8, 0, GL_RGBA, GL_FLOAT,
                     face.data());
    }
    glBindTexture(GL_TEXTURE_CUBE_MAP, names[2]);
    std::size_t size = 0;
    ASSERT_EQ(gl->read_cube(context, names[0], nullptr, &size), LODESTAR_MORE);
    ASSERT_EQ(size, 6u * 8u * 8u * 16u);
    std::vector<float> pixels(size / sizeof(float));
    ASSERT_EQ(gl->read_cube(context, names[0], pixels.data(), &size), LODESTAR_OK);
    EXPECT_EQ(pixels[0], 0.0f);
    EXPECT_EQ(pixels[5 * 256 + 1], 5.25f);
    LodestarEnvironmentDesc desc{};
    desc.struct_size = sizeof desc;
    desc.layout = LODESTAR_CUBE;
    desc.pixels = pixels.data();
    desc.width = desc.face_width = 8;
    desc.height = 48;
    desc.channels = 4;
    const LodestarEnvironment environment = make(desc);
    ASSERT_EQ(api.set_environment(context, environment), LODESTAR_OK);
    ASSERT_EQ(update(12.0), LODESTAR_OK);
    expectTexels(environment, LODESTAR_TEXELS_ENVIRONMENT);
    // What is no such cube.
    for (const GLuint name : {names[1], names[2], 12345u, 0u}) {
        EXPECT_EQ(gl->read_cube(context, name, nullptr, &size), LODESTAR_E_ARG) << name;
    }
    EXPECT_NE(std::string(api.last_error(context)).find("cube"), std::string::npos);
    EXPECT_EQ(gl->read_cube(context, names[0], nullptr, nullptr), LODESTAR_E_ARG);
    ASSERT_EQ(gl->detach(context, 1), LODESTAR_OK);
    glDeleteTextures(3, names);
}

// [main] plans on one thread, [gl] executes on another that has the context, at once.
TEST_F(AbiGlEnvironment, OpenGlMayHaveAThreadOfItsOwn) {
    ASSERT_EQ(api.set_environment(context, analytic("gradient:0.1,3")), LODESTAR_OK);
    lights.make(api, context);
    std::atomic<LodestarPlan> latest = planned(12.0);
    std::atomic<bool> done = false, attached = false;
    std::atomic<int> executed = 0;
    std::string said;
    std::thread graphics([&] {
        auto own = platform::HeadlessContext::create();
        ASSERT_TRUE(own.ok());
        ASSERT_EQ(gl->attach(context, procedure), LODESTAR_OK);
        attached = true;
        while (!done) {
            const LodestarStatus status = gl->execute(context, latest);
            // A plan is stale once four more have been made.
            EXPECT_TRUE(status == LODESTAR_OK || status == LODESTAR_E_ARG);
            executed += status == LODESTAR_OK ? 1 : 0;
        }
        LodestarGlTexture map{};
        map.struct_size = sizeof map;
        EXPECT_EQ(gl->texture(context, LODESTAR_TEXELS_MAP, &map), LODESTAR_OK);
        EXPECT_EQ(map.layers, 2u);
        EXPECT_EQ(gl->execute(context, 0), LODESTAR_E_ARG);
        said = api.last_error(context);
        EXPECT_EQ(gl->detach(context, 1), LODESTAR_OK);
    });
    while (!attached) {
        std::this_thread::yield();
    }
    EXPECT_EQ(gl->execute(context, latest), LODESTAR_E_THREAD);
    EXPECT_EQ(gl->attach(context, procedure), LODESTAR_E_THREAD);
    EXPECT_EQ(gl->detach(context, 1), LODESTAR_E_THREAD);
    for (int i = 0; i < 100 || executed < 20; ++i) {
        latest = planned(0.24 * (i % 100));
    }
    EXPECT_EQ(api.set_hour(context, HUGE_VAL), LODESTAR_E_ARG);
    done = true;
    graphics.join();
    EXPECT_NE(said.find("no such plan"), std::string::npos) << said;
    EXPECT_NE(std::string(api.last_error(context)).find("finite"), std::string::npos)
        << "each thread is told its own";
}

} // namespace
} // namespace lodestar::testing
