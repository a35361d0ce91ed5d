// SPDX-License-Identifier: MIT
//
// What a lit pixel costs: one directional light plus environment light by each estimator, against
// the same light plus a split-sum pixel (one prefiltered cube fetch, one table fetch, nine
// coefficients). One full-screen triangle a variant, all variants in turn; CPU time of the process
// (a software rasteriser's threads are in it), the ratio to split-sum formed repeat by repeat.
//
//   build/bench-shading [repeats]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include "bench/shading_front.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "lighting/environment.h"
#include "platform/headless_context.h"

namespace {

using namespace lodestar;
using namespace lodestar::testing;

constexpr int kCubeWidth = 128;

/// A grid of 4x4 balls with exact normals; uniforms so that nothing folds to a constant.
const char* kFront = R"(
uniform vec4 uCube;       // width, last level
uniform vec4 uSh9[9];
uniform samplerCube uEnvironment;
uniform samplerCube uIrradiance;
uniform sampler2D uTable;
layout(location = 0) out vec4 oColor;

vec4 lodestar_host_cube(int slot, vec3 direction, float level) {
    return textureLod(uEnvironment, direction, level);
}

vec3 sphericalHarmonics(vec3 n) {
    return lodestar_sh9(uSh9[0].rgb, uSh9[1].rgb, uSh9[2].rgb, uSh9[3].rgb, uSh9[4].rgb, uSh9[5].rgb,
                        uSh9[6].rgb, uSh9[7].rgb, uSh9[8].rgb, n);
}

vec3 lodestar_host_irradiance(int slot, vec3 n) {
#if DIFFUSE == 0
    return textureLod(uIrradiance, n, uCube.y).rgb;
#elif DIFFUSE == 1
    return sphericalHarmonics(n);
#else
    return textureLod(uIrradiance, n, 0.0).rgb;
#endif
}
)";

const char* kNull = "void main() { LodestarSurface s = here(); oColor = vec4(s.normal * 0.5 + "
                    "s.view * 0.1, 1.0); }";
const char* kDirect = "void main() { oColor = vec4(direct(here()), 1.0); }";
const char* kSplitSum = R"(
void main() {
    LodestarSurface s = here();
    vec3 r = reflect(-s.view, s.normal);
    float nDotV = max(dot(s.normal, s.view), 1e-3);
    float roughness = sqrt(sqrt(2.0 / (s.exponent + 2.0)));
    vec2 scaleBias = textureLod(uTable, vec2(nDotV, roughness), 0.0).rg;
    vec3 glossy = textureLod(uEnvironment, r, roughness * uCube.y).rgb;
    oColor = vec4(direct(s) + s.diffuse * sphericalHarmonics(s.normal) * s.occlusion +
                  (s.f0 * scaleBias.x + scaleBias.y) * glossy, 1.0);
})";
const char* kListing = R"(
void main() {
    LodestarSurface s = here();
    LodestarCube cube = LodestarCube(0, uCube.x, uCube.y, 0.0);
    vec3 r = reflect(-s.view, s.normal);
    oColor = vec4(direct(s) + s.diffuse * lodestar_host_irradiance(0, s.normal) +
                  s.f0 * lodestar_specularMip(cube, r, s.exponent), 1.0);
})";
const char* kEntry = R"(
void main() {
    LodestarSurface s = here();
    LodestarCube cube = LodestarCube(0, uCube.x, uCube.y, 2.0);
    vec3 r = reflect(-s.view, s.normal);
    oColor = vec4(direct(s) + lodestar_environment(cube, s, dFdx(r), dFdy(r)), 1.0);
})";

struct Variant {
    const char* name;
    const char* note;
    int specular; ///< LODESTAR_SPECULAR
    int diffuse;  ///< 0 lowest mip, 1 sh9, 2 irradiance cube
    const char* main;
    std::vector<double> cpu{};
    gl::Program program{};
};

std::string fragmentText(const Variant& variant) {
    const gl::Defines defines = {{"LODESTAR_SPECULAR", std::to_string(variant.specular)},
                                 {"DIFFUSE", std::to_string(variant.diffuse)}};
    std::string text = *gl::assembleShader("lodestar/environment.glsl", 330, defines);
    const std::string sh9 = *gl::assembleShader("lodestar/sh9.glsl", 330, {});
    // The second text repeats the version and the macros of the first, whose guards skip the rest.
    return text + sh9.substr(sh9.find('\n') + 1) + kFront + kSurface + variant.main;
}

void setUniforms(const gl::Program& program) {
    program.use();
    const auto set = [&](const char* name, float x, float y, float z, float w) {
        glUniform4f(program.uniform(name), x, y, z, w);
    };
    set("uLight", 0.6f, 0.64f, 0.48f, 0.0f);
    set("uLightColor", 3.0f, 2.8f, 2.5f, 0.0f);
    set("uDiffuse", 0.3f, 0.25f, 0.2f, 32.0f);
    set("uF0", 0.2f, 0.2f, 0.2f, 1.0f);
    set("uCube", static_cast<float>(kCubeWidth), std::log2(static_cast<float>(kCubeWidth)), 0.0f,
        0.0f);
    for (int i = 0; i < 9; ++i) {
        const std::string name = "uSh9[" + std::to_string(i) + "]";
        set(name.c_str(), 0.5f / static_cast<float>(i + 1), 0.4f / static_cast<float>(i + 1), 0.3f,
            0.0f);
    }
    program.setSampler("uEnvironment", 0);
    program.setSampler("uIrradiance", 1);
    program.setSampler("uTable", 2);
}

int fail(const core::Error& error) {
    std::fprintf(stderr, "bench-shading: %s\n", error.message().c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    const int repeats = argc > 1 ? std::atoi(argv[1]) : 31;
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto device = gl::Device::create();
    if (!device) {
        return fail(device.error());
    }
    const lighting::PreparedEnvironment environment =
        lighting::prepare(lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, kCubeWidth),
                          {true, false, false, true});
    auto cube = gl::Texture::makeCube(**device, environment.boxMips, "environment");
    auto irradiance = gl::Texture::makeCube(**device, environment.irradiance, "irradiance");
    core::Texels half(128, 128);
    std::fill(half.bytes().begin(), half.bytes().end(), static_cast<unsigned char>(128));
    gl::SamplerState tableSampler{
        gl::Wrap::ClampToEdge, gl::Wrap::ClampToEdge, true, true, false, false};
    auto table =
        gl::Texture::make2D(**device, half, gl::TexelEncoding::Linear, tableSampler, "table");
    auto target = gl::Framebuffer::make(**device, kSide, kSide);
    if (!cube || !irradiance || !table || !target) {
        return fail({core::ErrorCode::NoOpenGl, "no memory for the benchmark's textures", {}, {}});
    }
    std::vector<Variant> variants;
    variants.push_back(
        {"split-sum", "directional + prefiltered cube + table + sh9", 0, 1, kSplitSum});
    variants.push_back({"null", "normal and view only", 0, 1, kNull});
    variants.push_back({"direct", "directional light alone", 0, 1, kDirect});
    variants.push_back({"listing-1", "the report's two fetches, no Fresnel", 0, 0, kListing});
    variants.push_back({"mip/lowest-mip", "entry point, as published, with Fresnel", 0, 0, kEntry});
    variants.push_back({"mip/sh9", "entry point", 0, 1, kEntry});
    variants.push_back({"tent/sh9", "entry point, pixel footprint as floor", 3, 1, kEntry});
    variants.push_back({"tent/irradiance", "entry point, the default", 3, 2, kEntry});
    variants.push_back({"bias/irradiance", "entry point", 2, 2, kEntry});
    for (Variant& variant : variants) {
        auto program =
            gl::Program::makeFromText(**device, kVertex, fragmentText(variant), variant.name);
        if (!program) {
            return fail(program.error());
        }
        variant.program = std::move(*program);
        setUniforms(variant.program);
    }
    gl::VertexArray vertices(**device);
    vertices.bind();
    target->begin();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    cube->bind(0);
    table->bind(2);
    for (int repeat = -2; repeat < repeats; ++repeat) {
        for (Variant& variant : variants) {
            (variant.diffuse == 0 ? *cube : *irradiance).bind(1);
            variant.program.use();
            glFinish();
            const double start = cpuMilliseconds();
            gl::drawFullScreen(**device);
            glFinish();
            if (repeat >= 0) {
                variant.cpu.push_back(cpuMilliseconds() - start);
            }
        }
    }
    std::printf("%s, %dx%d, float target, cube %d\n%-16s %10s %8s %6s\n",
                (*device)->capabilities().renderer.c_str(), kSide, kSide, kCubeWidth, "variant",
                "cpu ms/Mpx", "ratio", "net");
    const std::vector<double>& base = variants[0].cpu;
    const double empty = median(variants[1].cpu);
    for (const Variant& variant : variants) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < base.size(); ++i) {
            ratios.push_back(variant.cpu[i] / base[i]);
        }
        std::printf("%-16s %10.2f %8.3f %6.3f  %s\n", variant.name,
                    median(variant.cpu) / (kSide * kSide / 1e6), median(ratios),
                    (median(variant.cpu) - empty) / (median(base) - empty), variant.note);
    }
    return 0;
}
