// SPDX-License-Identifier: MIT
#include "gl/probe_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <epoxy/gl.h>

#include "core/contract.h"
#include "lighting/round_fetches.h"
#include "lighting/round_levels.h"
#include "lodestar/cube.glsl"

namespace lodestar::gl {
namespace {

/// Texture units of the passes' own; the renderer binds its own anew.
constexpr int kCubeUnit = 0;
constexpr int kTableUnit = 1;

constexpr int kPartsSide = 4;   ///< parts of a level that is summed up: a square of them
constexpr int kPartColors = 7;  ///< shaders/host/probe_sh9.frag
constexpr int kFetchRows = 256; ///< for the round levels of any width

int widthOf(const Texture& cube, int level) {
    return std::max(cube.width() >> level, 1);
}

/// The finest level that is at most so wide.
int levelOfWidth(const Texture& cube, int width) {
    int level = 0;
    while (level + 1 < cube.levelCount() && widthOf(cube, level) > width) {
        ++level;
    }
    return level;
}

/// The level that a round one reads: the next finer, for the last few that of 8 texels, since four
/// are too few to weigh a lobe with.
int sourceOf(const Texture& cube, int level) {
    constexpr int kSummed = 8;
    return std::min(levelOfWidth(cube, kSummed), level - 1);
}

void attach(GLenum target, const Texture& texture) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, target, GL_TEXTURE_2D, texture.id(), 0);
}

/// So many colours of a framebuffer are drawn.
void drawColors(GLuint framebuffer, int count) {
    GLenum colors[kPartColors] = {};
    for (int i = 0; i < count; ++i) {
        colors[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glDrawBuffers(count, colors);
}

} // namespace

/// OpenGL leaves the rounding of what is drawn into half floats to the driver: draws a value that
/// lies three quarters of a step above one, and looks.
core::Result<void> ProbeFilter::measureHalfStep() {
    const std::string vertex =
        "#version 330 core\nvoid main() { gl_Position = vec4("
        "vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0); }\n";
    const std::string fragment = "#version 330 core\nuniform float uValue;\nout vec4 oValue;\n"
                                 "void main() { oValue = vec4(uValue); }\n";
    auto program = Program::makeFromText(*device_, vertex, fragment, "rounding of half floats");
    if (!program) {
        return program.error();
    }
    auto texel = Texture::makeTarget(*device_, 1, 1, ArrayFormat::Rgba16F, false, "a half float");
    if (!texel) {
        return texel.error();
    }
    constexpr float kStep = 1.0f / 1024.0f; // between 1 and 2
    glBindFramebuffer(GL_FRAMEBUFFER, sums_);
    attach(GL_COLOR_ATTACHMENT0, *texel);
    glViewport(0, 0, 1, 1);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    program->use();
    glUniform1f(program->uniform("uValue"), 1.0f + 0.75f * kStep);
    fullScreen_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3); // no frame's work: once a filter
    float drawn[4] = {};
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, drawn);
    ++device_->counters().stateQueries;
    halfStep_ = drawn[0] < 1.0f + 0.5f * kStep ? 0x1000u : 0u;
    return {};
}

core::Result<ProbeFilter::Pass> ProbeFilter::makePass(const char* fragment, const char* vertex,
                                                      const Defines& defines) const {
    auto made = Program::make(*device_, vertex, fragment, defines);
    if (!made) {
        return made.error();
    }
    made->setSampler("uFirstProbe", kCubeUnit);
    made->setSampler("uFetches", kTableUnit);
    made->setSampler("uParts", kTableUnit);
    if (const int step = made->uniform("uHalfStep"); step >= 0) {
        made->use();
        glUniform1ui(step, halfStep_);
    }
    Pass pass;
    for (const char* name : {"uWidths", "uRows", "uCells", "uTile"}) {
        if (const int uniform = made->uniform(name); uniform >= 0) {
            pass.uniform = uniform;
        }
    }
    pass.program = std::move(*made);
    return pass;
}

core::Result<void> ProbeFilter::makePasses() {
    struct Wanted {
        Pass ProbeFilter::*pass;
        const char* fragment;
        const char* vertex = "host/probe_screen.vert";
        Defines defines = {};
    };
    const Wanted wanted[] = {
        {&ProbeFilter::tent_,
         "host/probe_tent.frag",
         "host/probe_screen.vert",
         {{"LODESTAR_ODD", "0"}}},
        {&ProbeFilter::oddTent_,
         "host/probe_tent.frag",
         "host/probe_screen.vert",
         {{"LODESTAR_ODD", "1"}}},
        {&ProbeFilter::round_, "host/probe_round.frag"},
        {&ProbeFilter::sh9_, "host/probe_sh9.frag"},
        {&ProbeFilter::irradiance_, "host/probe_irradiance.frag", "host/probe_irradiance.vert"},
    };
    for (const Wanted& one : wanted) {
        auto pass = makePass(one.fragment, one.vertex, one.defines);
        if (!pass) {
            return pass.error();
        }
        this->*one.pass = std::move(*pass);
    }
    return {};
}

core::Result<ProbeFilter> ProbeFilter::make(Device& device) {
    ProbeFilter filter;
    filter.device_ = &device;
    filter.fullScreen_ = VertexArray(device);
    glGenFramebuffers(1, &filter.faces_);
    glGenFramebuffers(1, &filter.sums_);
    glGenSamplers(1, &filter.oneLevel_);
    glSamplerParameteri(filter.oneLevel_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(filter.oneLevel_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (auto measured = filter.measureHalfStep(); !measured) {
        return measured.error();
    }
    if (auto made = filter.makePasses(); !made) {
        return made.error();
    }
    auto fetches =
        Texture::makeTarget(device, lighting::kWidestRound * lighting::kWidestRound, kFetchRows,
                            ArrayFormat::Rgba32F, false, "fetches of round levels");
    auto parts = Texture::makeArray(device, kPartsSide, kPartsSide, kPartColors,
                                    ArrayFormat::Rgba32F, "sums of a light probe");
    for (auto* made : {&fetches, &parts}) {
        if (!*made) {
            return made->error();
        }
    }
    filter.fetches_ = std::move(*fetches);
    filter.parts_ = std::move(*parts);
    drawColors(filter.faces_, 6);
    drawColors(filter.sums_, kPartColors);
    for (int k = 0; k < kPartColors; ++k) {
        glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(k),
                                  filter.parts_.id(), 0, k);
    }
    return filter;
}

ProbeFilter::ProbeFilter(ProbeFilter&& other) noexcept {
    *this = std::move(other);
}

ProbeFilter& ProbeFilter::operator=(ProbeFilter&& other) noexcept {
    std::swap(device_, other.device_);
    for (Pass ProbeFilter::*pass :
         {&ProbeFilter::tent_, &ProbeFilter::oddTent_, &ProbeFilter::round_, &ProbeFilter::sh9_,
          &ProbeFilter::irradiance_}) {
        std::swap(this->*pass, other.*pass);
    }
    std::swap(halfStep_, other.halfStep_);
    std::swap(fullScreen_, other.fullScreen_);
    std::swap(faces_, other.faces_);
    std::swap(sums_, other.sums_);
    std::swap(oneLevel_, other.oneLevel_);
    for (Texture ProbeFilter::*texture : {&ProbeFilter::parts_, &ProbeFilter::fetches_}) {
        std::swap(this->*texture, other.*texture);
    }
    std::swap(fetchesWidth_, other.fetchesWidth_);
    std::swap(roundLevels_, other.roundLevels_);
    return *this;
}

ProbeFilter::~ProbeFilter() {
    if (device_ != nullptr) {
        const GLuint framebuffers[] = {faces_, sums_};
        glDeleteFramebuffers(2, framebuffers);
        glDeleteSamplers(1, &oneLevel_);
    }
}

void ProbeFilter::beginLevel(const Texture& cube, int level) {
    const int width = widthOf(cube, level);
    glBindFramebuffer(GL_FRAMEBUFFER, faces_);
    for (GLenum face = 0; face < 6; ++face) {
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + face,
                               GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, cube.id(), level);
    }
    glViewport(0, 0, width, width);
    ++device_->counters().passes;
    device_->counters().texelsWritten +=
        std::uint64_t{6} * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(width);
}

void ProbeFilter::tent(const Texture& cube, int level) {
    cube.showLevels(level - 1, level - 1);
    beginLevel(cube, level);
    const Pass& pass = widthOf(cube, level - 1) % 2 == 0 ? tent_ : oddTent_;
    pass.program.use();
    glUniform2f(pass.uniform, static_cast<float>(widthOf(cube, level)),
                static_cast<float>(widthOf(cube, level - 1)));
    drawFullScreen(*device_);
}

/// The fetches of all round levels of cubes so wide, into the table.
void ProbeFilter::prepareRound(const Texture& cube) {
    if (fetchesWidth_ == cube.width()) {
        return;
    }
    fetchesWidth_ = cube.width();
    roundLevels_.clear();
    fetches_.bind(kTableUnit);
    const int first = std::max(levelOfWidth(cube, lighting::kWidestRound), 1);
    const auto effectiveWidth = [&](int level) {
        return std::ldexp(static_cast<double>(cube.width()), -level);
    };
    int row = 0;
    for (int level = first; level < cube.levelCount(); ++level) {
        const int source = sourceOf(cube, level);
        const auto made = lighting::roundFetches(
            effectiveWidth(level), widthOf(cube, level),
            {effectiveWidth(source), widthOf(cube, source), source >= first});
        LODESTAR_EXPECT(row + made->most <= kFetchRows, "the fetches of all round levels fit");
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, row, made->texels, made->most, GL_RGBA, GL_FLOAT,
                        made->fetches.data());
        roundLevels_.push_back({level, source, row, row + made->most});
        row += made->most;
    }
}

void ProbeFilter::round(const Texture& cube, const RoundLevel& level) {
    cube.showLevels(level.source, level.source);
    beginLevel(cube, level.level);
    round_.program.use();
    glUniform3i(round_.uniform, widthOf(cube, level.level), level.firstRow, level.endRow);
    drawFullScreen(*device_);
}

void ProbeFilter::begin(const Texture& cube) {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    cube.bind(kCubeUnit);
    glBindSampler(kCubeUnit, oneLevel_);
    fullScreen_.bind();
}

void ProbeFilter::end(const Texture& cube) {
    cube.showLevels(0, cube.levelCount() - 1);
    glBindSampler(kCubeUnit, 0);
}

/// Tents as far as round levels read them. @return the coarsest
int ProbeFilter::makeTents(const Texture& cube, int lastLevel) {
    const int wide = levelOfWidth(cube, lighting::kWidestRound);
    const int lastTent = std::min(lastLevel, std::max(wide - 1, 0));
    for (int level = 1; level <= lastTent; ++level) {
        tent(cube, level);
    }
    return lastTent;
}

void ProbeFilter::makeRound(const Texture& cube, int lastLevel) {
    prepareRound(cube);
    cube.bind(kCubeUnit);
    fetches_.bind(kTableUnit);
    glActiveTexture(GL_TEXTURE0 + kCubeUnit);
    for (const RoundLevel& level : roundLevels_) {
        if (level.level <= lastLevel) {
            round(cube, level);
        }
    }
}

void ProbeFilter::fillMips(const Texture& cube, int lastLevel) {
    LODESTAR_EXPECT(lastLevel < cube.levelCount(), "a mip level lies within the chain");
    begin(cube);
    makeTents(cube, lastLevel);
    makeRound(cube, lastLevel);
    end(cube);
}

void ProbeFilter::fill(const Texture& cube, int lastLevel, IrradianceAtlas& atlas, int tile) {
    LODESTAR_EXPECT(lastLevel < cube.levelCount(), "a mip level lies within the chain");
    begin(cube);
    const int tents = makeTents(cube, lastLevel);
    fillIrradiance(cube, tents, atlas, tile);
    makeRound(cube, lastLevel);
    end(cube);
}

void ProbeFilter::fillIrradiance(const Texture& cube, int level, IrradianceAtlas& atlas, int tile) {
    cube.showLevels(level, level);
    glBindFramebuffer(GL_FRAMEBUFFER, sums_);
    glViewport(0, 0, kPartsSide, kPartsSide);
    ++device_->counters().passes;
    device_->counters().texelsWritten += std::uint64_t{kPartsSide * kPartsSide * kPartColors};
    sh9_.program.use();
    const int width = widthOf(cube, level);
    // Four texels of a narrow level are too far apart to be read as one.
    const bool paired = width % 2 == 0 && width > lighting::kWidestRound;
    glUniform2f(sh9_.uniform, static_cast<float>(paired ? width / 2 : width),
                paired ? 1.0f / static_cast<float>(width) : 0.0f);
    drawFullScreen(*device_);
    atlas.begin(tile);
    parts_.bind(kTableUnit);
    irradiance_.program.use();
    const glm::ivec2 first = atlas.tile(tile);
    glUniform2i(irradiance_.uniform, first.x, first.y);
    drawFullScreen(*device_);
}

} // namespace lodestar::gl
