// SPDX-License-Identifier: MIT
//
// What it takes to make a captured cube ready to shade with, both terms, in passes: our tent mips
// and irradiance, the driver's own mipmap call, and a GGX prefilter of 32 samples a texel as other
// engines run it for each level and face; and, for a sky of which only the intensity or tint has
// changed, every level anew as geometry + tint x sky of two chains that were kept. Between two
// glFinish, all in turn: wall time, and the CPU time of all threads of the process, which other
// work on the machine disturbs less and in which a driver that draws by itself does its drawing.
// Ratios are formed repeat by repeat.
//
//   build/bench-probes [repeats]        LP_NUM_THREADS=0: llvmpipe draws on the calling thread
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
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

const char* kVertex = R"(#version 450 core
void main() {
    vec2 p = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(p * 2.0 - 1.0, 0.0, 1.0);
})";

/// Importance sampling of GGX half vectors about n = v, each tap read a level above that of its own
/// solid angle, as engines do it.
const char* kGgx = R"(#version 450 core
layout(location = 0) out vec4 o;
layout(binding = 0) uniform samplerCube uMap;
layout(location = 0) uniform int face;
layout(location = 1) uniform float inv;
layout(location = 2) uniform float a;
layout(location = 3) uniform int n;
layout(location = 4) uniform float width;

float radical(uint b) { return float(bitfieldReverse(b)) * 2.3283064365386963e-10; }

void main() {
    vec2 p = gl_FragCoord.xy * inv * 2.0 - 1.0;
    vec3 d[6] = vec3[](vec3(1, -p.y, -p.x), vec3(-1, -p.y, p.x), vec3(p.x, 1, p.y),
                       vec3(p.x, -1, -p.y), vec3(p.x, -p.y, 1), vec3(-p.x, -p.y, -1));
    vec3 R = normalize(d[face]);
    vec3 T = normalize(abs(R.z) < 0.9 ? cross(R, vec3(0, 0, 1)) : cross(R, vec3(1, 0, 0)));
    vec3 B = cross(R, T);
    vec3 acc = vec3(0);
    float ws = 0.0;
    float lb = 0.5 * log2(6.0 * width * width / float(n) / 12.566371);
    for (uint i = 0u; i < uint(n); ++i) {
        float u1 = (float(i) + 0.5) / float(n), ph = 6.2831853 * radical(i);
        float ch = sqrt((1.0 - u1) / (1.0 + (a * a - 1.0) * u1)), sh = sqrt(1.0 - ch * ch);
        float ct = 2.0 * ch * ch - 1.0, st = 2.0 * ch * sh;
        if (ct <= 0.0) continue;
        float q = ch * ch * (a * a - 1.0) + 1.0;
        float pdf = a * a / (3.14159265 * q * q) * 0.25;
        vec3 l = R * ct + (T * cos(ph) + B * sin(ph)) * st;
        acc += ct * textureLod(uMap, l, max(lb - 0.5 * log2(pdf) + 1.0, 0.0)).rgb;
        ws += ct;
    }
    o = vec4(acc / ws, 1.0);
})";

/// What a piece of work takes, ms.
struct Times {
    double wall = 0.0;
    double cpu = 0.0; ///< of all threads of the process
};

double cpuMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

/// Of the second of two runs: a probe is filtered when its faces have just been written, so that
/// they and the programs are at hand.
Times timesOf(const std::function<void()>& work) {
    work();
    glFinish();
    const double cpu = cpuMilliseconds();
    const auto start = Clock::now();
    work();
    glFinish();
    const double wall = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return {wall, cpuMilliseconds() - cpu};
}

/// A level of two kept chains: what was captured, and the sky between it.
const char* kTintedVertex = R"(#version 330 core
out vec2 vAt;
void main() {
    vAt = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0;
    gl_Position = vec4(vAt, 0.0, 1.0);
})";
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
        glUniform1i(kSamples, 32);
        glUniform1f(kWidth, static_cast<float>(from.width()));
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
            glUniform1f(kInverse, 1.0f / static_cast<float>(side));
            glUniform1f(kAlpha, std::max(roughness * roughness, 0.002f));
            glViewport(0, 0, side, side);
            for (int face = 0; face < 6; ++face) {
                glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                       GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face),
                                       to_.id(), level);
                glUniform1i(kFace, face);
                gl::drawFullScreen(device_);
            }
        }
    }

private:
    enum Uniform { kFace, kInverse, kAlpha, kSamples, kWidth };
    gl::Device& device_;
    const gl::Texture& from_;
    const gl::Texture& to_;
    gl::VertexArray screen_;
    gl::Program program_;
    unsigned framebuffer_ = 0;
};

/// All levels of a map from two others.
class Tinted {
public:
    explicit Tinted(gl::Device& device)
        : device_(device), screen_(device),
          program_(
              std::move(*gl::Program::makeFromText(device, kTintedVertex, kTinted, "tinted"))) {
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
    struct Column {
        const char* name;
        std::function<void()> work;
        std::vector<double> wall{}, cpu{};         ///< ms
        std::vector<double> wallOver{}, cpuOver{}; ///< over the refresh's
    };
    Column columns[] = {
        {"refresh", [&] { filter.fill(ours, levels - 1, atlas, tile); }},
        {"mips alone", [&] { filter.fillMips(ours, levels - 1); }},
        {"mipmap call",
         [&] {
             drivers.bind(0);
             glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
         }},
        {"GGX, 32 samples", [&] { ggx.run(); }},
        {"tinted sum", [&] { tinted.run(ours, drivers, theirs); }},
    };
    for (int i = -1; i < repeats; ++i) { // the first reading holds what the driver put off
        Times refresh;
        for (Column& column : columns) {
            const Times times = timesOf(column.work);
            refresh = &column == columns ? times : refresh;
            if (i >= 0) {
                column.wall.push_back(times.wall);
                column.cpu.push_back(times.cpu);
                column.wallOver.push_back(times.wall / refresh.wall);
                column.cpuOver.push_back(times.cpu / refresh.cpu);
            }
        }
    }
    for (const Column& column : columns) {
        std::printf("%4d  %-16s %8.3f %8.3f   %6.2f %6.2f\n", width, column.name,
                    median(column.wall), median(column.cpu), median(column.wallOver),
                    median(column.cpuOver));
    }
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
    const char* threads = std::getenv("LP_NUM_THREADS");
    std::printf("%s, LP_NUM_THREADS %s; medians of %d\n",
                (*device)->capabilities().renderer.c_str(), threads ? threads : "not set", repeats);
    std::printf("face                    wall ms   cpu ms   over the refresh: wall, cpu\n");
    for (const int width : {64, 128, 256}) {
        measure(**device, *filter, *atlas, width, repeats);
    }
    return 0;
}
