// SPDX-License-Identifier: MIT
//
// A fixture that makes what shading reads of a light probe from a cube map, and reads it back.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "gl/probe_filter.h"
#include "support/cubes.h"
#include "support/gl_fixture.h"

namespace lodestar::testing {

/// A tile of irradiance, read as a shader reads it.
struct Tile {
    std::vector<glm::vec4> texels; ///< gl::kTileWidth a row

    [[nodiscard]] glm::vec3 read(const glm::vec3& normal) const {
        const glm::vec2 at = shader::lodestar_irradianceTexel(normal) - 0.5f;
        const glm::ivec2 low(at);
        const glm::vec2 t = at - glm::vec2(low);
        const auto texel = [&](int x, int y) {
            return glm::vec3(
                texels[static_cast<std::size_t>((low.y + y) * gl::kTileWidth + low.x + x)]);
        };
        return glm::mix(glm::mix(texel(0, 0), texel(1, 0), t.x),
                        glm::mix(texel(0, 1), texel(1, 1), t.x), t.y);
    }
};

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
    /// The tile of a probe that holds a level 0.
    Tile irradianceOf(const lighting::Cubemap& base) {
        const gl::Texture cube = targetOf(base);
        const int number = *atlas_.add();
        filter_->fill(cube, cube.levelCount() - 1, atlas_, number);
        return read(number);
    }
    Tile read(int number) {
        const gl::Texture& texture = atlas_.texture();
        std::vector<glm::vec4> all(static_cast<std::size_t>(texture.width() * texture.height()));
        texture.bind(0);
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, all.data());
        const glm::ivec2 first = atlas_.tile(number);
        Tile tile;
        for (int y = 0; y < gl::kTileWidth; ++y) {
            const auto row = all.begin() + (first.y + y) * texture.width() + first.x;
            tile.texels.insert(tile.texels.end(), row, row + gl::kTileWidth);
        }
        return tile;
    }

    std::optional<gl::ProbeFilter> filter_;
    gl::IrradianceAtlas atlas_;
};

} // namespace lodestar::testing
