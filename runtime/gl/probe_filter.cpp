// SPDX-License-Identifier: MIT
#include "gl/probe_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <epoxy/gl.h>

#include "core/contract.h"
#include "lighting/round_levels.h"
#include "lodestar/cube.glsl"

namespace lodestar::gl {
namespace {

/// Texture units of the passes' own; the renderer binds its own anew.
constexpr int kCubeUnit = 0;
constexpr int kMeansUnit = 1;
constexpr int kFinerUnit = 2;
constexpr int kKeptUnit = 3;

constexpr int kParts = 96; ///< of a level that is summed up
/// The tent level that coarse round levels are read from.
constexpr int kRoundSource = 16;
/// Levels of at most so many texels are sums over all texels of the tent level of kSummedSource.
constexpr int kSummedWidth = 2;
constexpr int kSummedSource = 8;
constexpr int kIrradianceSource = 8;
constexpr GLenum kBoth[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};

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

/// Fetches for a texel of a round level: more where its lobe is many texels of its source wide.
int roundFetches(int width) {
    return width >= 16 ? 20 : width >= 8 ? 32 : width >= 4 ? 48 : 96;
}

/// One over the sums of the two weights of shaders/host/probe_sums.frag.
glm::vec2 normsOf(int width, int finerWidth) {
    glm::dvec2 sums(0.0);
    const auto finer = static_cast<float>(finerWidth);
    for (int y = 0; y < width; ++y) {
        for (int x = 0; x < width; ++x) {
            const float u = static_cast<float>(2 * x + 1) / static_cast<float>(width) - 1.0f;
            const float v = static_cast<float>(2 * y + 1) / static_cast<float>(width) - 1.0f;
            sums +=
                6.0 * glm::dvec2(static_cast<double>(shader::lodestar_meanTexelDensity(
                                     u, v, static_cast<float>(width))),
                                 static_cast<double>(shader::lodestar_tentDensity(u, v, finer)));
        }
    }
    return glm::vec2(1.0 / sums);
}

void attach(GLenum target, const Texture& texture) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, target, GL_TEXTURE_2D, texture.id(), 0);
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
    glBindFramebuffer(GL_FRAMEBUFFER, small_);
    attach(GL_COLOR_ATTACHMENT0, *texel);
    glViewport(0, 0, 1, 1);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    program->use();
    glUniform1f(program->uniform("uValue"), 1.0f + 0.75f * kStep);
    fullScreen_.bind();
    drawFullScreen(*device_);
    float drawn[4] = {};
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, drawn);
    ++device_->counters().stateQueries;
    halfStep_ = drawn[0] < 1.0f + 0.5f * kStep ? 0x1000u : 0u;
    return {};
}

core::Result<ProbeFilter::Pass> ProbeFilter::makePass(const char* fragment, bool layered) const {
    auto made = Program::make(*device_, "host/probe_layers.vert", fragment, {},
                              layered ? "host/probe_layers.geom" : "");
    if (!made) {
        return made.error();
    }
    made->setSampler("uFirstProbe", kCubeUnit);
    made->setSampler("uMeans", kMeansUnit);
    made->setSampler("uCoefficients", kMeansUnit);
    made->setSampler("uFinerMeans", kFinerUnit);
    made->setSampler("uKept", kKeptUnit);
    if (const int step = made->uniform("uHalfStep"); step >= 0) {
        made->use();
        glUniform1ui(step, halfStep_);
    }
    Pass pass;
    pass.widths = made->uniform("uWidths");
    pass.norms = made->uniform("uNorms");
    pass.lobe = made->uniform("uLobe");
    pass.first = made->uniform("uFirst");
    pass.program = std::move(*made);
    return pass;
}

core::Result<ProbeFilter> ProbeFilter::make(Device& device) {
    ProbeFilter filter;
    filter.device_ = &device;
    filter.fullScreen_ = VertexArray(device);
    glGenFramebuffers(1, &filter.layers_);
    glGenFramebuffers(1, &filter.small_);
    if (auto measured = filter.measureHalfStep(); !measured) {
        return measured.error();
    }
    struct Wanted {
        Pass ProbeFilter::*pass;
        const char* fragment;
        bool layered;
    };
    const Wanted wanted[] = {
        {&ProbeFilter::tent_, "host/probe_tent.frag", true},
        {&ProbeFilter::round_, "host/probe_round.frag", true},
        {&ProbeFilter::all_, "host/probe_all.frag", true},
        {&ProbeFilter::multiply_, "host/probe_multiply.frag", true},
        {&ProbeFilter::sums_, "host/probe_sums.frag", false},
        {&ProbeFilter::scale_, "host/probe_scale.frag", false},
        {&ProbeFilter::sh9_, "host/probe_sh9.frag", false},
        {&ProbeFilter::irradiance_, "host/probe_irradiance.frag", false},
    };
    for (const Wanted& one : wanted) {
        auto pass = filter.makePass(one.fragment, one.layered);
        if (!pass) {
            return pass.error();
        }
        filter.*one.pass = std::move(*pass);
    }
    filter.tileUniform_ = filter.irradiance_.program.uniform("uTile");
    struct Small {
        Texture ProbeFilter::*texture;
        int width;
    };
    const Small smalls[] = {{&ProbeFilter::means_, kParts},
                            {&ProbeFilter::finerMeans_, kParts},
                            {&ProbeFilter::scaleTexel_, 1},
                            {&ProbeFilter::kept_, 1},
                            {&ProbeFilter::coefficients_, 9}};
    for (const Small& small : smalls) {
        auto texture = Texture::makeTarget(device, small.width, 1, ArrayFormat::Rgba32F, false,
                                           "sums of a light probe");
        if (!texture) {
            return texture.error();
        }
        filter.*small.texture = std::move(*texture);
    }
    return filter;
}

ProbeFilter::ProbeFilter(ProbeFilter&& other) noexcept {
    *this = std::move(other);
}

ProbeFilter& ProbeFilter::operator=(ProbeFilter&& other) noexcept {
    std::swap(device_, other.device_);
    for (Pass ProbeFilter::*pass :
         {&ProbeFilter::tent_, &ProbeFilter::round_, &ProbeFilter::all_, &ProbeFilter::sums_,
          &ProbeFilter::scale_, &ProbeFilter::multiply_, &ProbeFilter::sh9_,
          &ProbeFilter::irradiance_}) {
        std::swap(this->*pass, other.*pass);
    }
    std::swap(tileUniform_, other.tileUniform_);
    std::swap(halfStep_, other.halfStep_);
    std::swap(fullScreen_, other.fullScreen_);
    std::swap(layers_, other.layers_);
    std::swap(small_, other.small_);
    for (Texture ProbeFilter::*texture :
         {&ProbeFilter::means_, &ProbeFilter::finerMeans_, &ProbeFilter::scaleTexel_,
          &ProbeFilter::kept_, &ProbeFilter::coefficients_}) {
        std::swap(this->*texture, other.*texture);
    }
    return *this;
}

ProbeFilter::~ProbeFilter() {
    if (device_ != nullptr) {
        const GLuint framebuffers[] = {layers_, small_};
        glDeleteFramebuffers(2, framebuffers);
    }
}

void ProbeFilter::beginLevel(const Texture& cube, int level) {
    const int width = widthOf(cube, level);
    glBindFramebuffer(GL_FRAMEBUFFER, layers_);
    glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, cube.id(), level);
    glViewport(0, 0, width, width);
    ++device_->counters().passes;
    device_->counters().texelsWritten +=
        std::uint64_t{6} * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(width);
}

void ProbeFilter::tent(const Texture& cube, int level) {
    cube.showLevels(level - 1, level - 1);
    beginLevel(cube, level);
    tent_.program.use();
    glUniform2f(tent_.widths, static_cast<float>(widthOf(cube, level)),
                static_cast<float>(widthOf(cube, level - 1)));
    drawFullScreen(*device_, 6);
}

/// Sums a level up into the textures of parts. @param finerWidth of the level that it was made from
void ProbeFilter::sumUp(const Texture& cube, int level, int finerWidth) {
    const int width = widthOf(cube, level);
    const glm::vec2 norms = normsOf(width, finerWidth);
    cube.showLevels(level, level);
    glBindFramebuffer(GL_FRAMEBUFFER, small_);
    attach(GL_COLOR_ATTACHMENT0, means_);
    attach(GL_COLOR_ATTACHMENT1, finerMeans_);
    glDrawBuffers(2, kBoth);
    glViewport(0, 0, kParts, 1);
    ++device_->counters().passes;
    sums_.program.use();
    glUniform2f(sums_.widths, static_cast<float>(width), static_cast<float>(finerWidth));
    glUniform2f(sums_.norms, norms.x, norms.y);
    drawFullScreen(*device_);
}

/// Scales a level, channel by channel, so that its mean is that of level 0.
/// @param first whether it is the level whose tents know that mean
void ProbeFilter::keepMean(const Texture& cube, int level, bool first) {
    sumUp(cube, level, first ? widthOf(cube, level - 1) : widthOf(cube, level));
    attach(GL_COLOR_ATTACHMENT0, scaleTexel_);
    attach(GL_COLOR_ATTACHMENT1, kept_);
    glDrawBuffers(first ? 2 : 1, kBoth);
    glViewport(0, 0, 1, 1);
    ++device_->counters().passes;
    means_.bind(kMeansUnit);
    finerMeans_.bind(kFinerUnit);
    kept_.bind(kKeptUnit);
    scale_.program.use();
    glUniform1i(scale_.first, first ? 1 : 0);
    drawFullScreen(*device_);
    glDrawBuffers(1, kBoth);
    beginLevel(cube, level);
    scaleTexel_.bind(kMeansUnit);
    multiply_.program.use();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    drawFullScreen(*device_, 6);
    glDisable(GL_BLEND);
    cube.bind(kCubeUnit);
}

void ProbeFilter::round(const Texture& cube, int level, int source) {
    const double width = widthOf(cube, level);
    const double ratio = width / widthOf(cube, source);
    const double exponent =
        width <= 1.0
            ? 0.0
            : lighting::exponentOfTentLevel(std::ldexp(static_cast<double>(cube.width()), -level));
    const bool all = width <= kSummedWidth;
    const Pass& pass = all ? all_ : round_;
    cube.showLevels(source, source);
    beginLevel(cube, level);
    pass.program.use();
    glUniform4f(
        pass.lobe, static_cast<float>(width), static_cast<float>(exponent),
        static_cast<float>(1.0 / 6.0 + 0.25 * ratio * ratio),
        static_cast<float>(all ? widthOf(cube, source) : roundFetches(static_cast<int>(width))));
    drawFullScreen(*device_, 6);
}

void ProbeFilter::fillMips(const Texture& cube, int lastLevel) {
    LODESTAR_EXPECT(lastLevel < cube.levelCount(), "a mip level lies within the chain");
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glActiveTexture(GL_TEXTURE0 + kCubeUnit);
    cube.bind(kCubeUnit);
    fullScreen_.bind();
    // Tents as far as something reads them: round levels read those of 16 and 8 texels.
    const int wide = levelOfWidth(cube, kRoundSource);
    const int narrow = levelOfWidth(cube, kSummedSource);
    const int lastTent = lastLevel > wide ? narrow : std::min(lastLevel, wide);
    for (int level = 1; level <= lastTent; ++level) {
        tent(cube, level);
        keepMean(cube, level, level == 1);
    }
    for (int level = lastLevel; level > narrow; --level) {
        const bool all = widthOf(cube, level) <= kSummedWidth;
        round(cube, level, all ? narrow : wide);
        if (widthOf(cube, level) > 1 && wide > 0) {
            keepMean(cube, level, false);
        }
    }
    for (int level = std::min(lastLevel, narrow); level >= std::max(wide, 1); --level) {
        if (widthOf(cube, level) <= lighting::kWidestRound) {
            round(cube, level, level == wide ? wide - 1 : wide);
            keepMean(cube, level, false);
        }
    }
    cube.showLevels(0, cube.levelCount() - 1);
}

void ProbeFilter::fillIrradiance(const Texture& cube, IrradianceAtlas& atlas, int tile) {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    cube.bind(kCubeUnit);
    fullScreen_.bind();
    const int level = levelOfWidth(cube, kIrradianceSource);
    cube.showLevels(level, level);
    glBindFramebuffer(GL_FRAMEBUFFER, small_);
    attach(GL_COLOR_ATTACHMENT0, coefficients_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, 0,
                           0); // a smaller one would cut the first
    glDrawBuffers(1, kBoth);
    glViewport(0, 0, 9, 1);
    ++device_->counters().passes;
    sh9_.program.use();
    const auto width = static_cast<float>(widthOf(cube, level));
    glUniform2f(sh9_.widths, width, width);
    drawFullScreen(*device_);
    cube.showLevels(0, cube.levelCount() - 1);
    atlas.begin(tile);
    coefficients_.bind(kMeansUnit);
    irradiance_.program.use();
    const glm::ivec2 first = atlas.tile(tile);
    glUniform2i(tileUniform_, first.x, first.y);
    drawFullScreen(*device_);
}

} // namespace lodestar::gl
