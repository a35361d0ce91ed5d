// SPDX-License-Identifier: MIT
//
// A fixture that makes what shading reads of a light probe from a cube map, and reads it back.
#pragma once

#include <optional>
#include <utility>

#include <epoxy/gl.h>

#include "gl/probe_filter.h"
#include "support/cubes.h"
#include "support/gl_fixture.h"

namespace lodestar::testing {

class ProbeChainTest : public GlTest {
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
    gl::Texture targetOf(const lighting::Cubemap& base) {
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
    lighting::Cubemap read(const gl::Texture& cube, int levels) {
        lighting::Cubemap map(cube.width(), levels);
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
    lighting::Cubemap filtered(const lighting::Cubemap& base) {
        const gl::Texture cube = targetOf(base);
        filter_->fillMips(cube, cube.levelCount() - 1);
        return read(cube, cube.levelCount());
    }

    std::optional<gl::ProbeFilter> filter_;
    gl::IrradianceAtlas atlas_;
};

} // namespace lodestar::testing
