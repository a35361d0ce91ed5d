// SPDX-License-Identifier: MIT
//
// A probe's mips and irradiance as passes make them, against the CPU's.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>

#include "gl/probe_filter.h"
#include "lighting/environment.h"
#include "lighting/mips.h"
#include "support/cubes.h"
#include "support/gl_fixture.h"

namespace lodestar {
namespace {

using lighting::Cubemap;

class ProbeFilterTest : public testing::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        auto made = gl::ProbeFilter::make(device());
        ASSERT_TRUE(made.ok()) << made.error().message();
        filter_.emplace(std::move(*made));
        auto atlas = gl::IrradianceAtlas::make(device());
        ASSERT_TRUE(atlas.ok());
        atlas_ = std::move(*atlas);
        glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    }
    void TearDown() override {
        filter_.reset();
        atlas_ = {};
        GlTest::TearDown();
    }
    /// A target that holds a level 0.
    gl::Texture targetOf(const Cubemap& base) {
        auto target = gl::Texture::makeCubeTarget(device(), base.width(),
                                                  lighting::fullLevelCount(base.width()), "cube");
        EXPECT_TRUE(target.ok());
        target->bind(0);
        const std::size_t face = base.level(0).size() / 6;
        for (std::size_t i = 0; i < 6; ++i) {
            glTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(i), 0, 0, 0,
                            base.width(), base.width(), GL_RGBA, GL_FLOAT,
                            base.level(0).data() + i * face);
        }
        return std::move(*target);
    }
    Cubemap read(const gl::Texture& cube, int levels) {
        Cubemap map(cube.width(), levels);
        cube.bind(0);
        for (int level = 0; level < levels; ++level) {
            const std::size_t face = map.level(level).size() / 6;
            for (std::size_t i = 0; i < 6; ++i) {
                glGetTexImage(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(i), level,
                              GL_RGBA, GL_FLOAT, map.level(level).data() + i * face);
            }
        }
        return map;
    }
    Cubemap filtered(const Cubemap& base) {
        const gl::Texture cube = targetOf(base);
        filter_->fillMips(cube, cube.levelCount() - 1);
        return read(cube, cube.levelCount());
    }

    std::optional<gl::ProbeFilter> filter_;
    gl::IrradianceAtlas atlas_;
};

Cubemap constant(const glm::vec3& radiance, int width) {
    return lighting::cubeFromAnalytic(lighting::ConstantEnvironment{glm::dvec3(radiance)}, width);
}

/// A lamp about a direction, of 5 degrees' radius, 100 times the rest.
Cubemap lamp(const glm::dvec3& axis, int width) {
    return lighting::cubeFromAnalytic(lighting::DiscEnvironment{glm::normalize(axis), 0.0873,
                                                                glm::dvec3(100.0),
                                                                glm::dvec3(0.05)},
                                      width);
}

// Half floats hold 11 bits: a texel that is rounded once is 2^-11 off at most, and a value that is
// made of equal ones is rounded once more.
TEST_F(ProbeFilterTest, AConstantStaysConstant) {
    for (const int width : {1, 2, 3, 8, 16, 32, 100, 128}) {
        const Cubemap map = filtered(constant(glm::vec3(0.7f, 1.0f, 40.0f), width));
        for (int level = 0; level < map.levelCount(); ++level) {
            if (width == 128) {
                const auto mm = std::minmax_element(
                    map.level(level).begin(), map.level(level).end(),
                    [](const glm::vec4& a, const glm::vec4& b) { return a.g < b.g; });
                std::printf("minmax %.6f %.6f at %zu\n", mm.first->g, mm.second->g,
                            static_cast<std::size_t>(mm.first - map.level(level).begin()));
                std::printf("%d %u: %d: %.6f %.6f %.6f\n", width, filter_->halfStep(), level,
                            map.level(level)[0].r, map.level(level)[0].g, map.level(level)[0].b);
            }
            for (const glm::vec4& texel : map.level(level)) {
                ASSERT_NEAR(texel.r, 0.7f, 0.7f * 0.001f) << width << " level " << level;
                ASSERT_NEAR(texel.g, 1.0f, 0.001f) << width << " level " << level;
                ASSERT_NEAR(texel.b, 40.0f, 40.0f * 0.001f) << width << " level " << level;
            }
        }
    }
}

TEST_F(ProbeFilterTest, EveryLevelKeepsTheMean) {
    for (const glm::dvec3& axis : {glm::dvec3(1, 1, 1), glm::dvec3(1, 0, 0),
                                   glm::dvec3(1, 0.9, 0.1), glm::dvec3(0.3, -1, 0.4)}) {
        const Cubemap map = filtered(lamp(axis, 128));
        const glm::dvec4 truth = lighting::sphereMean(map, 0);
        for (int level = 1; level < map.levelCount(); ++level) {
            const glm::dvec4 mean = lighting::sphereMean(map, level);
            std::printf("(%g %g %g) level %d: mean %+.4f\n", axis.x, axis.y, axis.z, level,
                        mean.g / truth.g - 1.0);
        }
    }
}

} // namespace
} // namespace lodestar
