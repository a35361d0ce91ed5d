// SPDX-License-Identifier: MIT
//
// What a pixel lit by a sky and a sun costs, layout by layout, against a pixel under one
// directional light: the least there is (Blinn-Phong, k_L + k_G, no Fresnel: column "plain") and
// the renderer's own (Fresnel, energy kept, exponents to 1e7: column "own"). One full-screen
// triangle a variant, all in turn; CPU time of the process, ratios formed repeat by repeat.
//
//   build/bench-rsrm-shading [repeats]
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>

#include <epoxy/gl.h>

#include "bench/shading_front.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "platform/headless_context.h"
#include "scene/gpu_lights.h"
#include "scene/gpu_scene.h"

namespace {

using namespace lodestar;
using namespace lodestar::testing;

const char* kPlain = R"(
void main() {
    LodestarSurface s = here();
    vec3 h = normalize(uLight.xyz + s.view);
    float lobe = (s.exponent + 8.0) * 0.125 * pow(max(dot(s.normal, h), 0.0), s.exponent);
    oColor = vec4(uLightColor.rgb * max(dot(s.normal, uLight.xyz), 0.0) * (s.diffuse + s.f0 * lobe), 1.0);
})";
const char* kDirect = "void main() { oColor = vec4(direct(here()), 1.0); }";
const char* kNull = "void main() { LodestarSurface s = here(); oColor = vec4(s.normal * 0.5 + "
                    "s.view * 0.1, 1.0); }";
/// The maps alone: about the reflection, k_L + k_G, no Fresnel: what `kPlain` is to a light.
const char* kBare = R"(
void main() {
    LodestarSurface s = here();
    vec3 r = 2.0 * dot(s.normal, s.view) * s.normal - s.view;
    float row = lodestar_rsrmRow(rsrmLight(0), s.exponent);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LODESTAR_RSRM_LIGHTS; ++i) {
        LodestarRsrm map = rsrmLight(i);
        sum += s.diffuse * lodestar_rsrmLambert(map, s.normal) + s.f0 * lodestar_rsrm(map, r, row);
    }
    oColor = vec4(sum, 1.0);
})";
/// As the built-in renderer's fragment stage; the first light is the sun.
const char* kLights = R"(
void main() {
    LodestarSurface s = here();
    LodestarLookup lookup = rsrmLookup(s);
    float row = rsrmRow(lookup.exponent);
    vec3 lambert = vec3(0.0);
    vec3 glossy = vec3(0.0);
    for (int i = 0; i < LODESTAR_RSRM_LIGHTS; ++i) {
        lambert += lodestar_rsrmLambert(rsrmLight(i), s.normal);
        glossy += rsrmGlossy(i, s, lookup, row);
    }
    oColor = vec4(lodestar_reflected(s, lambert, glossy), 1.0);
})";

struct Variant {
    const char* name;
    const char* main;
    const lighting::RsrmLayout* layout = nullptr;
    std::size_t lights = 0;
    bool mirror = false; ///< its lobes may be sharper than the last row
    bool round = false;  ///< its sun is read as if lobes were round
    scene::GpuLights gpu{};
    gl::Buffer block{};
    gl::Program program{};
    std::vector<double> cpu{};
};

std::string fragmentText(const Variant& variant) {
    const gl::Defines defines = {
        {"LODESTAR_RSRM_LIGHTS", std::to_string(std::max(variant.lights, std::size_t{1}))},
        {"LODESTAR_RSRM_LAYOUT", variant.gpu.published() ? "1" : "0"},
        {"LODESTAR_RSRM_MIRROR", variant.mirror ? "1" : "0"},
        {"LODESTAR_SUNS", variant.round ? "0" : "1"}};
    std::string text = "#version 330 core\n";
    for (const char* file :
         {"host/blocks.glsl", "lodestar/environment.glsl", "lodestar/rsrm.glsl",
          "lodestar/sun.glsl", "host/rsrm_hooks.glsl", "host/rsrm_lights.glsl"}) {
        const std::string part = *gl::assembleShader(file, 330, defines);
        text += part.substr(part.find('\n') + 1);
    }
    return text + R"(
vec4 lodestar_host_cube(int slot, vec3 direction, float level) { return vec4(1.0); }
vec3 lodestar_host_irradiance(int slot, vec3 normal) { return vec3(1.0); }
layout(location = 0) out vec4 oColor;
)" + kSurface +
           variant.main;
}

std::vector<lighting::DayLight> skyAndSun(std::size_t count) {
    lighting::DayLight sun;
    sun.kind = lighting::LightKind::Sun;
    sun.axis = {0.6, 0.64, 0.48};
    sun.keys = {{12.0,
                 {{{0, {1, 0.9, 0.8}, 15},
                   {0.27, {1, 0.9, 0.8}, 15},
                   {0.27, {1, 1, 1}, 2},
                   {40, {0, 0, 0}, 0}}},
                 glm::dvec3(1.0),
                 {}}};
    lighting::DayLight sky;
    sky.keys = {{12.0,
                 {{{90, {0.1, 0.2, 0.5}, 0}, {0, {1, 0.9, 0.8}, 0}, {-90, {0.1, 0.1, 0.1}, 0}}},
                 glm::dvec3(1.0),
                 {}}};
    std::vector<lighting::DayLight> lights = {sun, sky};
    lights.resize(count);
    core::Tally warnings;
    for (lighting::DayLight& light : lights) {
        light = *lighting::repaired(light, warnings);
    }
    return lights;
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
    program.setBlock("LodestarRsrmLights", 3);
    program.setSampler("uRsrmMaps", scene::kRsrmMapUnit);
    program.setSampler("uRsrmLamberts", scene::kRsrmLambertUnit);
    program.setSampler("uRsrmGradients", scene::kRsrmGradientUnit);
}

core::Result<void> make(gl::Device& device, Variant& variant,
                        const std::shared_ptr<lighting::RsrmKernels>& kernels) {
    scene::blocks::LodestarRsrmLights block{};
    if (variant.layout != nullptr) {
        variant.gpu = scene::GpuLights(skyAndSun(variant.lights), *variant.layout, kernels);
        (void)variant.gpu.describe(12.0);
        plan::EffectPlan plan;
        for (std::size_t i = 0; i < variant.lights; ++i) {
            plan.rsrmLights.push_back({i, true, -1, false});
        }
        if (auto prepared = variant.gpu.prepare(device, plan); !prepared) {
            return prepared;
        }
        variant.gpu.describe(plan, block);
    }
    auto program = gl::Program::makeFromText(device, kVertex, fragmentText(variant), variant.name);
    if (!program) {
        return program.error();
    }
    variant.program = std::move(*program);
    setUniforms(variant.program);
    variant.block =
        gl::Buffer(device, gl::BufferKind::Uniform, std::as_bytes(std::span(&block, 1)));
    return {};
}

void measure(gl::Device& device, std::vector<Variant>& variants, int repeats) {
    for (int repeat = -2; repeat < repeats; ++repeat) {
        for (Variant& variant : variants) {
            variant.gpu.bind();
            variant.block.bindBlock(3);
            variant.program.use();
            glFinish();
            const double start = cpuMilliseconds();
            gl::drawFullScreen(device);
            glFinish();
            if (repeat >= 0) {
                variant.cpu.push_back(cpuMilliseconds() - start);
            }
        }
    }
}

int fail(const core::Error& error) {
    std::fprintf(stderr, "bench-rsrm-shading: %s\n", error.message().c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto device = gl::Device::create();
    if (!device) {
        return fail(device.error());
    }
    std::vector<Variant> variants;
    variants.push_back({"plain", kPlain});
    variants.push_back({"own", kDirect});
    variants.push_back({"null", kNull});
    std::vector<Variant> bare;
    const std::pair<const char*, const lighting::RsrmLayout*> layouts[] = {
        {"rsrm-published", &lighting::kRsrmPublished},
        {"rsrm", &lighting::kRsrm},
        {"small", &lighting::kRsrmSmall}};
    for (const auto& [name, layout] : layouts) {
        for (const std::size_t lights : {std::size_t{1}, std::size_t{2}}) {
            variants.push_back({name, kLights, layout, lights, false});
            bare.push_back({name, kBare, layout, lights, false});
        }
    }
    variants.push_back({"rsrm, mirrors", kLights, &lighting::kRsrm, 1, true});
    variants.push_back({"rsrm, mirrors", kLights, &lighting::kRsrm, 2, true});
    variants.push_back({"rsrm, round", kLights, &lighting::kRsrm, 1, false, true});
    variants.push_back({"rsrm, round", kLights, &lighting::kRsrm, 2, false, true});
    for (Variant& variant : bare) {
        variants.push_back(std::move(variant));
    }
    const auto kernels = std::make_shared<lighting::RsrmKernels>();
    for (Variant& variant : variants) {
        if (auto made = make(**device, variant, kernels); !made) {
            return fail(made.error());
        }
    }
    auto target = gl::Framebuffer::make(**device, kSide, kSide);
    if (!target) {
        return fail(target.error());
    }
    gl::VertexArray vertices(**device);
    vertices.bind();
    target->begin();
    glDisable(GL_DEPTH_TEST);
    measure(**device, variants, argc > 1 ? std::atoi(argv[1]) : 31);
    std::printf("%s, %dx%d\n%-16s %6s %10s %8s %8s\n", (*device)->capabilities().renderer.c_str(),
                kSide, kSide, "variant", "lights", "cpu ms/Mpx", "plain", "own");
    for (const Variant& variant : variants) {
        std::vector<double> ratios[2];
        for (std::size_t i = 0; i < variant.cpu.size(); ++i) {
            ratios[0].push_back(variant.cpu[i] / variants[0].cpu[i]);
            ratios[1].push_back(variant.cpu[i] / variants[1].cpu[i]);
        }
        std::printf("%-16s %6zu %10.2f %8.3f %8.3f%s\n", variant.name, variant.lights,
                    median(variant.cpu) / (kSide * kSide / 1e6), median(ratios[0]),
                    median(ratios[1]), variant.main == kBare ? "  maps alone" : "");
    }
    return 0;
}
