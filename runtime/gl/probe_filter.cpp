// SPDX-License-Identifier: MIT
#include "gl/probe_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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

constexpr int kParts = 96;     ///< of a level that is summed up
constexpr int kMostSummed = 8; ///< levels
constexpr int kMostTaps = 64;
/// The tent level that round levels are read from, and that which the last two are.
constexpr int kRoundSource = 16;
constexpr int kSummedSource = 4;
/// Levels of at most so many texels are sums over all texels of the tent level of kSummedSource.
constexpr int kSummedWidth = 2;
constexpr int kCoefficients = 9; ///< of irradiance

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

/// Fetches for a texel of a round level: as many as its lobe has texels of what it reads, but for
/// its skirts.
int roundFetches(int width) {
    return width >= 16 ? 24 : width >= 8 ? 32 : 64;
}

/// One over the sum of a level's weights in shaders/host/probe_sums.frag.
float normOf(int width) {
    double sum = 0.0;
    for (int y = 0; y < width; ++y) {
        for (int x = 0; x < width; ++x) {
            const float u = static_cast<float>(2 * x + 1) / static_cast<float>(width) - 1.0f;
            const float v = static_cast<float>(2 * y + 1) / static_cast<float>(width) - 1.0f;
            sum += static_cast<double>(
                shader::lodestar_meanTexelDensity(u, v, static_cast<float>(width)));
        }
    }
    return static_cast<float>(1.0 / (6.0 * sum));
}

/// Of a cosine lobe the share t lies within the angle whose cosine to s + 1 is 1 - t.
void spiral(double exponent, int count, float* sines) {
    for (int i = 0; i < count; ++i) {
        const double t = (i + 0.5) / count;
        const double cosine = std::pow(1.0 - t, 1.0 / (exponent + 1.0));
        const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        sines[2 * i] = static_cast<float>(sine * std::cos(angle));
        sines[2 * i + 1] = static_cast<float>(sine * std::sin(angle));
    }
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
    glDrawArrays(GL_TRIANGLES, 0, 3); // no frame's work: once a filter
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
    if (const int step = made->uniform("uHalfStep"); step >= 0) {
        made->use();
        glUniform1ui(step, halfStep_);
    }
    Pass pass;
    pass.widths = made->uniform("uWidths");
    pass.lobe = made->uniform("uLobe");
    pass.program = std::move(*made);
    return pass;
}

core::Result<void> ProbeFilter::makePasses() {
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
        {&ProbeFilter::sh9Sum_, "host/probe_sh9_sum.frag", false},
        {&ProbeFilter::irradiance_, "host/probe_irradiance.frag", false},
    };
    for (const Wanted& one : wanted) {
        auto pass = makePass(one.fragment, one.layered);
        if (!pass) {
            return pass.error();
        }
        this->*one.pass = std::move(*pass);
    }
    tileUniform_ = irradiance_.program.uniform("uTile");
    return {};
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
    if (auto made = filter.makePasses(); !made) {
        return made.error();
    }
    struct Small {
        Texture ProbeFilter::*texture;
        int width, height;
    };
    const Small smalls[] = {{&ProbeFilter::means_, kParts, kMostSummed},
                            {&ProbeFilter::scales_, kMostSummed, 1},
                            {&ProbeFilter::parts_, kParts, kCoefficients},
                            {&ProbeFilter::coefficients_, kCoefficients, 1}};
    for (const Small& small : smalls) {
        auto texture = Texture::makeTarget(device, small.width, small.height, ArrayFormat::Rgba32F,
                                           false, "sums of a light probe");
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
          &ProbeFilter::scale_, &ProbeFilter::multiply_, &ProbeFilter::sh9_, &ProbeFilter::sh9Sum_,
          &ProbeFilter::irradiance_}) {
        std::swap(this->*pass, other.*pass);
    }
    std::swap(tileUniform_, other.tileUniform_);
    std::swap(halfStep_, other.halfStep_);
    std::swap(fullScreen_, other.fullScreen_);
    std::swap(layers_, other.layers_);
    std::swap(small_, other.small_);
    for (Texture ProbeFilter::*texture : {&ProbeFilter::means_, &ProbeFilter::scales_,
                                          &ProbeFilter::parts_, &ProbeFilter::coefficients_}) {
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

/// Scales levels, channel by channel, so that their means are that of a finer one. Tents keep the
/// mean by themselves (3e-4 a level at most, a lamp at the cube's corner); spirals do not.
/// @param reference the level before the first that is scaled
void ProbeFilter::keepMean(const Texture& cube, int reference, int last) {
    const int rows = last - reference + 1;
    cube.showLevels(0, cube.levelCount() - 1);
    glBindFramebuffer(GL_FRAMEBUFFER, small_);
    attach(GL_COLOR_ATTACHMENT0, means_);
    glViewport(0, 0, kParts, rows);
    ++device_->counters().passes;
    sums_.program.use();
    float norms[kMostSummed] = {};
    for (int row = 0; row < rows; ++row) {
        norms[row] = normOf(widthOf(cube, reference + std::max(row, 1)));
    }
    glUniform1fv(sums_.program.uniform("uNorms"), rows, norms);
    glUniform2i(sums_.program.uniform("uRange"), reference, cube.width());
    drawFullScreen(*device_);
    attach(GL_COLOR_ATTACHMENT0, scales_);
    glViewport(0, 0, rows, 1);
    ++device_->counters().passes;
    means_.bind(kMeansUnit);
    scale_.program.use();
    drawFullScreen(*device_);
    scales_.bind(kMeansUnit);
    multiply_.program.use();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    for (int row = 1; row < rows; ++row) {
        beginLevel(cube, reference + row);
        glUniform1i(multiply_.program.uniform("uRow"), row);
        drawFullScreen(*device_, 6);
    }
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
    const double hat = 1.0 / 6.0 + 0.25 * ratio * ratio;
    const bool all = width <= kSummedWidth;
    const int fetches = all ? widthOf(cube, source) : roundFetches(static_cast<int>(width));
    const Pass& pass = all ? all_ : round_;
    cube.showLevels(source, source);
    beginLevel(cube, level);
    pass.program.use();
    glUniform4f(pass.lobe, static_cast<float>(width), static_cast<float>(exponent),
                static_cast<float>(hat), static_cast<float>(fetches));
    if (!all) {
        const double texel = 4.0 * std::numbers::pi / (6.0 * width * width);
        const float mean = shader::lodestar_roundExponent(static_cast<float>(exponent),
                                                          static_cast<float>(hat * texel));
        float sines[2 * kMostTaps] = {};
        spiral(static_cast<double>(mean), fetches, sines);
        glUniform2fv(pass.program.uniform("uSpiral"), fetches, sines);
        glUniform1f(pass.program.uniform("uMeanExponent"), mean);
    }
    drawFullScreen(*device_, 6);
}

void ProbeFilter::begin(const Texture& cube) {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    cube.bind(kCubeUnit);
    fullScreen_.bind();
}

/// Tents as far as something reads them: round levels read those of 16 and 4 texels, the first of
/// them the level before. @return the coarsest of at least 16 texels
int ProbeFilter::makeTents(const Texture& cube, int lastLevel) {
    const int wide = levelOfWidth(cube, kRoundSource);
    const int narrow = levelOfWidth(cube, kSummedSource);
    const bool summed = widthOf(cube, lastLevel) <= kSummedWidth && lastLevel > narrow;
    const int lastTent = summed ? narrow : std::min(lastLevel, wide);
    for (int level = 1; level <= lastTent; ++level) {
        tent(cube, level);
    }
    return std::min(lastTent, wide);
}

void ProbeFilter::makeRound(const Texture& cube, int lastLevel) {
    const int wide = levelOfWidth(cube, kRoundSource);
    const int narrow = levelOfWidth(cube, kSummedSource);
    for (int level = lastLevel; level > wide; --level) {
        round(cube, level, widthOf(cube, level) <= kSummedWidth ? narrow : wide);
    }
    if (wide > 0 && lastLevel >= wide) {
        round(cube, wide, wide - 1);
        keepMean(cube, wide - 1, lastLevel);
    }
    cube.showLevels(0, cube.levelCount() - 1);
}

void ProbeFilter::fillMips(const Texture& cube, int lastLevel) {
    LODESTAR_EXPECT(lastLevel < cube.levelCount(), "a mip level lies within the chain");
    begin(cube);
    makeTents(cube, lastLevel);
    makeRound(cube, lastLevel);
}

void ProbeFilter::fill(const Texture& cube, int lastLevel, IrradianceAtlas& atlas, int tile) {
    LODESTAR_EXPECT(lastLevel < cube.levelCount(), "a mip level lies within the chain");
    begin(cube);
    const int tents = makeTents(cube, lastLevel);
    fillIrradiance(cube, tents, atlas, tile);
    cube.bind(kCubeUnit);
    makeRound(cube, lastLevel);
}

void ProbeFilter::fillIrradiance(const Texture& cube, int level, IrradianceAtlas& atlas, int tile) {
    cube.showLevels(level, level);
    glBindFramebuffer(GL_FRAMEBUFFER, small_);
    attach(GL_COLOR_ATTACHMENT0, parts_);
    glViewport(0, 0, kParts, kCoefficients);
    ++device_->counters().passes;
    sh9_.program.use();
    const int width = widthOf(cube, level);
    glUniform2f(sh9_.widths, static_cast<float>(width), normOf(width));
    drawFullScreen(*device_);
    attach(GL_COLOR_ATTACHMENT0, coefficients_);
    glViewport(0, 0, kCoefficients, 1);
    ++device_->counters().passes;
    parts_.bind(kMeansUnit);
    sh9Sum_.program.use();
    drawFullScreen(*device_);
    atlas.begin(tile);
    coefficients_.bind(kMeansUnit);
    irradiance_.program.use();
    const glm::ivec2 first = atlas.tile(tile);
    glUniform2i(tileUniform_, first.x, first.y);
    drawFullScreen(*device_);
}

} // namespace lodestar::gl
