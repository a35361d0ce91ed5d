// SPDX-License-Identifier: MIT
//
// What it takes to make a captured cube ready to shade with, both terms, in passes: our tent mips
// and irradiance, the driver's own mipmap call, and a GGX prefilter of 32 samples a texel as other
// engines run it for each level; and, for a sky of which only the intensity or tint has changed,
// every level anew as geometry + tint x sky of two chains that were kept. Wall time between two
// glFinish, all in turn; ratios are formed repeat by repeat.
//
//   build/bench-probes [repeats]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include "gl/probe_filter.h"
#include "lighting/environment.h"
#include "platform/headless_context.h"

namespace {

using namespace lodestar;
using Clock = std::chrono::steady_clock;

const char* kVertex = R"(#version 330 core
out vec2 vAt;
void main() {
    vec2 p = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0;
    vAt = p;
    gl_Position = vec4(p, 0.0, 1.0);
})";

/// Importance sampling of GGX half vectors about n = v, each read at the level of its own solid
/// angle.
const char* kGgx = R"(#version 330 core
uniform samplerCube uMap;
uniform int uFace;
uniform float uAlpha, uWidth;
in vec2 vAt;
layout(location = 0) out vec4 oColor;

vec3 directionOf(int face, vec2 p) {
    if (face == 0) return vec3(1.0, -p.y, -p.x);
    if (face == 1) return vec3(-1.0, -p.y, p.x);
    if (face == 2) return vec3(p.x, 1.0, p.y);
    if (face == 3) return vec3(p.x, -1.0, -p.y);
    if (face == 4) return vec3(p.x, -p.y, 1.0);
    return vec3(-p.x, -p.y, -1.0);
}

float reversed(uint i) {
    i = (i << 16u) | (i >> 16u);
    i = ((i & 0x55555555u) << 1u) | ((i & 0xAAAAAAAAu) >> 1u);
    i = ((i & 0x33333333u) << 2u) | ((i & 0xCCCCCCCCu) >> 2u);
    i = ((i & 0x0F0F0F0Fu) << 4u) | ((i & 0xF0F0F0F0u) >> 4u);
    i = ((i & 0x00FF00FFu) << 8u) | ((i & 0xFF00FF00u) >> 8u);
    return float(i) * 2.3283064365386963e-10;
}

void main() {
    vec3 n = normalize(directionOf(uFace, vAt));
    vec3 up = abs(n.z) < 0.999 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    vec3 t = normalize(cross(up, n));
    vec3 b = cross(n, t);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 32; ++i) {
        float x = (float(i) + 0.5) / 32.0;
        float a2 = uAlpha * uAlpha;
        float c2 = (1.0 - x) / (1.0 + (a2 - 1.0) * x);
        float c = sqrt(c2);
        float s = sqrt(1.0 - c2);
        float phi = 6.28318530718 * reversed(uint(i));
        vec3 h = s * cos(phi) * t + s * sin(phi) * b + c * n;
        vec3 l = 2.0 * dot(n, h) * h - n;
        float cosine = dot(n, l);
        if (cosine > 0.0) {
            float d = c2 * (a2 - 1.0) + 1.0;
            float density = a2 / (3.14159265359 * d * d) * 0.25;
            float solid = 1.0 / (32.0 * density + 1e-4);
            float texel = 12.5663706 / (6.0 * uWidth * uWidth);
            sum += cosine * textureLod(uMap, l, max(0.5 * log2(solid / texel), 0.0)).rgb;
            weights += cosine;
        }
    }
    oColor = vec4(sum / max(weights, 1e-6), 1.0);
})";

/// A level of two kept chains: what was captured, and the sky between it.
const char* kTinted = R"(#version 330 core
in vec2 vAt;
uniform samplerCube uMap;
uniform samplerCube uSky;
uniform int uFace;
uniform vec3 uTint;
layout(location = 0) out vec4 oColor;

vec3 directionOf(int face, vec2 p) {
    if (face == 0) return vec3(1.0, -p.y, -p.x);
    if (face == 1) return vec3(-1.0, -p.y, p.x);
    if (face == 2) return vec3(p.x, 1.0, p.y);
    if (face == 3) return vec3(p.x, -1.0, -p.y);
    return face == 4 ? vec3(p.x, -p.y, 1.0) : vec3(-p.x, -p.y, -1.0);
}

void main() {
    vec3 d = directionOf(uFace, vAt);
    oColor = vec4(textureLod(uMap, d, 0.0).rgb + uTint * textureLod(uSky, d, 0.0).rgb, 1.0);
})";

double milliseconds(const std::function<void()>& work) {
    glFinish();
    const auto start = Clock::now();
    work();
    glFinish();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The prefilter of all levels below 0 of a map into another.
class Ggx {
public:
    Ggx(gl::Device& device, const gl::Texture& from, const gl::Texture& to)
        : device_(device), from_(from), to_(to), screen_(device),
          program_(std::move(*gl::Program::makeFromText(device, kVertex, kGgx, "ggx"))) {
        glGenFramebuffers(1, &framebuffer_);
        program_.use();
        program_.setSampler("uMap", 0);
        face_ = program_.uniform("uFace");
        alpha_ = program_.uniform("uAlpha");
        glUniform1f(program_.uniform("uWidth"), static_cast<float>(from.width()));
    }
    ~Ggx() { glDeleteFramebuffers(1, &framebuffer_); }
    void run() {
        program_.use();
        screen_.bind();
        from_.bind(0);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        for (int level = 1; level < to_.levelCount(); ++level) {
            const int side = std::max(to_.width() >> level, 1);
            const float roughness =
                static_cast<float>(level) / static_cast<float>(to_.levelCount() - 1);
            glUniform1f(alpha_, roughness * roughness);
            glViewport(0, 0, side, side);
            for (int face = 0; face < 6; ++face) {
                glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                       GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face),
                                       to_.id(), level);
                glUniform1i(face_, face);
                gl::drawFullScreen(device_);
            }
        }
    }

private:
    gl::Device& device_;
    const gl::Texture& from_;
    const gl::Texture& to_;
    gl::VertexArray screen_;
    gl::Program program_;
    unsigned framebuffer_ = 0;
    int face_ = -1, alpha_ = -1;
};

/// All levels of a map from two others.
class Tinted {
public:
    explicit Tinted(gl::Device& device)
        : device_(device), screen_(device),
          program_(std::move(*gl::Program::makeFromText(device, kVertex, kTinted, "tinted"))) {
        glGenFramebuffers(1, &framebuffer_);
        program_.use();
        program_.setSampler("uMap", 0);
        program_.setSampler("uSky", 1);
        glUniform3f(program_.uniform("uTint"), 0.3f, 0.4f, 0.5f);
        face_ = program_.uniform("uFace");
    }
    ~Tinted() { glDeleteFramebuffers(1, &framebuffer_); }
    void run(const gl::Texture& geometry, const gl::Texture& sky, const gl::Texture& to) {
        program_.use();
        screen_.bind();
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        for (int level = 0; level < to.levelCount(); ++level) {
            sky.bind(1);
            sky.showLevels(level, level);
            geometry.bind(0);
            geometry.showLevels(level, level);
            const int side = std::max(to.width() >> level, 1);
            glViewport(0, 0, side, side);
            for (int face = 0; face < 6; ++face) {
                glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                       GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face),
                                       to.id(), level);
                glUniform1i(face_, face);
                gl::drawFullScreen(device_);
            }
        }
        geometry.showLevels(0, geometry.levelCount() - 1);
        sky.bind(0);
        sky.showLevels(0, sky.levelCount() - 1);
    }

private:
    gl::Device& device_;
    gl::VertexArray screen_;
    gl::Program program_;
    unsigned framebuffer_ = 0;
    int face_ = -1;
};

void fill(const gl::Texture& cube) {
    const lighting::Cubemap map =
        lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, cube.width());
    cube.bind(0);
    const std::size_t face = map.level(0).size() / 6;
    for (std::size_t i = 0; i < 6; ++i) {
        glTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(i), 0, 0, 0,
                        cube.width(), cube.width(), GL_RGBA, GL_FLOAT,
                        map.level(0).data() + i * face);
    }
    glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
}

void measure(gl::Device& device, gl::ProbeFilter& filter, gl::IrradianceAtlas& atlas, int width,
             int repeats) {
    const int levels = lighting::fullLevelCount(width);
    const gl::Texture ours = std::move(*gl::Texture::makeCubeTarget(device, width, levels, "ours"));
    const gl::Texture drivers =
        std::move(*gl::Texture::makeCubeTarget(device, width, levels, "driver's"));
    const gl::Texture theirs =
        std::move(*gl::Texture::makeCubeTarget(device, width, levels, "ggx"));
    fill(ours);
    fill(drivers);
    Ggx ggx(device, drivers, theirs);
    Tinted tinted(device);
    const int tile = *atlas.add();
    glDisable(GL_DEPTH_TEST);
    std::vector<double> refresh, mips, mipmap, prefilter, ratio, ofMipmap, tint;
    for (int i = -1; i < repeats; ++i) { // the first reading holds what the driver put off
        const double m = milliseconds([&] { filter.fillMips(ours, levels - 1); });
        const double both = milliseconds([&] { filter.fill(ours, levels - 1, atlas, tile); });
        const double g = milliseconds([&] {
            drivers.bind(0);
            glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
        });
        const double p = milliseconds([&] { ggx.run(); });
        const double t = milliseconds([&] { tinted.run(ours, drivers, theirs); });
        if (i >= 0) {
            tint.push_back(t);
            mips.push_back(m);
            refresh.push_back(both);
            mipmap.push_back(g);
            prefilter.push_back(p);
            ratio.push_back(p / both);
            ofMipmap.push_back(both / g);
        }
    }
    std::printf("%4d   %7.3f (mips %7.3f)  %7.3f  %8.3f   %6.2f   %5.2f   %7.3f\n", width,
                median(refresh), median(mips), median(mipmap), median(prefilter), median(ratio),
                median(ofMipmap), median(tint));
}

} // namespace

int main(int argc, char** argv) {
    const int repeats = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 31;
    auto context = platform::HeadlessContext::create();
    if (!context) {
        std::fprintf(stderr, "%s\n", context.error().message().c_str());
        return 4;
    }
    auto device = gl::Device::create();
    auto filter = gl::ProbeFilter::make(**device);
    auto atlas = gl::IrradianceAtlas::make(**device);
    if (!filter || !atlas) {
        std::fprintf(stderr, "no passes\n");
        return 4;
    }
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    std::printf("%s; medians of %d, ms\n", (*device)->capabilities().renderer.c_str(), repeats);
    std::printf(
        "face   refresh                 mipmap   ggx 32   ggx/refresh  refresh/mipmap  tinted\n");
    for (const int width : {64, 128, 256}) {
        measure(**device, *filter, *atlas, width, repeats);
    }
    return 0;
}
