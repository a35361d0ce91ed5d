// SPDX-License-Identifier: MIT
#include "scene/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <span>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "gl/timer.h"
#include "scene/draw_list.h"
#include "scene/gpu_deformation.h"
#include "scene/gpu_environment.h"
#include "scene/gpu_scene.h"
#include "scene/presenter.h"

namespace lodestar::scene {
namespace {

using lighting::EstimatorKind;
using Clock = std::chrono::steady_clock;

/// Largest side of a tile, in samples: 2048^2 of colour and depth are 80 MiB.
constexpr int kTileSide = 2048;

enum Binding : unsigned { kFrameBinding, kDrawBinding, kMaterialBinding };

template <class Block>
std::span<const std::byte> bytesOf(const Block& block) {
    return std::as_bytes(std::span(&block, 1));
}

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

int specularMacro(EstimatorKind kind) {
    switch (kind) {
    case EstimatorKind::Mip:
        return 0;
    case EstimatorKind::MipFloor:
        return 1;
    case EstimatorKind::Bias:
    case EstimatorKind::BiasVertex:
        return 2;
    default:
        return 3;
    }
}

int diffuseMacro(EstimatorKind kind) {
    switch (kind) {
    case EstimatorKind::Sh9:
        return 1;
    case EstimatorKind::LowestMip:
        return 2;
    case EstimatorKind::Bias:
    case EstimatorKind::BiasVertex:
        return 3;
    default:
        return 0;
    }
}

gl::Defines definesFor(plan::Features features, const RenderSettings& settings) {
    using plan::Feature;
    gl::Defines defines;
    const std::pair<const char*, Feature> macros[] = {
        {"LODESTAR_NORMALS", Feature::Normals},
        {"LODESTAR_TANGENTS", Feature::Tangents},
        {"LODESTAR_VERTEX_COLORS", Feature::VertexColors},
        {"LODESTAR_BASE_COLOR_TEXTURE", Feature::BaseColorTexture},
        {"LODESTAR_METALLIC_ROUGHNESS_TEXTURE", Feature::MetallicRoughnessTexture},
        {"LODESTAR_NORMAL_TEXTURE", Feature::NormalTexture},
        {"LODESTAR_OCCLUSION_TEXTURE", Feature::OcclusionTexture},
        {"LODESTAR_EMISSIVE_TEXTURE", Feature::EmissiveTexture},
        {"LODESTAR_BLINN_PHONG", Feature::BlinnPhong},
        {"LODESTAR_EXPONENT_TEXTURE", Feature::ExponentTexture},
        {"LODESTAR_ALPHA_MASK", Feature::AlphaMask},
        {"LODESTAR_ALPHA_BLEND", Feature::AlphaBlend},
        {"LODESTAR_PUNCTUAL_LIGHTS", Feature::PunctualLights},
        {"LODESTAR_ENVIRONMENT", Feature::Environment},
        {"LODESTAR_TEXTURE_TRANSFORM", Feature::TextureTransform},
        {"LODESTAR_UNLIT", Feature::Unlit},
        {"LODESTAR_SPECULAR_TEXTURE", Feature::SpecularTexture},
        {"LODESTAR_SPECULAR_COLOR_TEXTURE", Feature::SpecularColorTexture},
        {"LODESTAR_SKINNING", Feature::Skinning},
        {"LODESTAR_SECOND_JOINTS", Feature::SecondJoints},
    };
    for (const auto& [name, feature] : macros) {
        defines.emplace_back(name, plan::has(features, feature) ? "1" : "0");
    }
    defines.emplace_back("LODESTAR_SPECULAR",
                         std::to_string(specularMacro(settings.specular.kind)));
    defines.emplace_back("LODESTAR_DIFFUSE", std::to_string(diffuseMacro(settings.diffuse.kind)));
    defines.emplace_back("LODESTAR_BIAS_VERTEX",
                         settings.specular.kind == EstimatorKind::BiasVertex ? "1" : "0");
    return defines;
}

void setLights(const Scene& scene, blocks::LodestarFrame& block) {
    int count = 0;
    for (const PlacedLight& placed : placedLights(scene)) {
        if (count == LODESTAR_MAX_LIGHTS) {
            break;
        }
        const io::GltfLight& light = *placed.light;
        const glm::mat4& world = placed.node->worldFromNode;
        const glm::vec3 z(world[2]);
        const float length = glm::length(z);
        const glm::vec3 back = length > 0.0f ? z / length : glm::vec3(0.0f, 0.0f, 1.0f);
        const bool directional = light.kind == io::LightKind::Directional;
        block.lightPosition[count] =
            directional ? glm::vec4(back, 0.0f) : glm::vec4(glm::vec3(world[3]), 1.0f);
        const float inverseRange = std::isfinite(light.range) ? 1.0f / light.range : 0.0f;
        block.lightColor[count] = {light.color * light.intensity, inverseRange * inverseRange};
        block.lightDirection[count] = {-back, 0.0f};
        block.lightCone[count] = {0.0f, 1.0f, 0.0f, 0.0f};
        if (light.kind == io::LightKind::Spot) {
            const float outer = std::cos(light.outerConeAngle);
            const float scale = 1.0f / std::max(0.001f, std::cos(light.innerConeAngle) - outer);
            block.lightCone[count] = {scale, -outer * scale, 0.0f, 0.0f};
        }
        ++count;
    }
    block.lightCount = glm::vec4(static_cast<float>(count));
}

/// The part of clip space that a tile shows, stretched over the whole of it.
glm::mat4 tileFromClip(const glm::ivec4& tile, int width, int height) {
    const glm::vec2 size(static_cast<float>(width), static_cast<float>(height));
    const glm::vec2 extent(static_cast<float>(tile.z), static_cast<float>(tile.w));
    const glm::vec2 center =
        (glm::vec2(static_cast<float>(tile.x), static_cast<float>(tile.y)) + 0.5f * extent) / size;
    const glm::vec2 ndc(2.0f * center.x - 1.0f, 1.0f - 2.0f * center.y);
    return glm::scale(glm::mat4(1.0f), glm::vec3(size / extent, 1.0f)) *
           glm::translate(glm::mat4(1.0f), glm::vec3(-ndc, 0.0f));
}

/// Averages a tile's samples into the picture; pixels that are not finite become 0 and are counted.
std::uint64_t resolve(const core::Image& samples, int perSide, const glm::ivec2& at,
                      core::Image& out) {
    std::uint64_t repaired = 0;
    const float weight = 1.0f / static_cast<float>(perSide * perSide);
    for (int y = 0; y < samples.height() / perSide; ++y) {
        for (int x = 0; x < samples.width() / perSide; ++x) {
            glm::vec4 sum(0.0f);
            for (int j = 0; j < perSide; ++j) {
                for (int i = 0; i < perSide; ++i) {
                    const float* s = samples.at(x * perSide + i, y * perSide + j);
                    sum += glm::vec4(s[0], s[1], s[2], s[3]);
                }
            }
            sum *= weight;
            if (!std::isfinite(sum.x) || !std::isfinite(sum.y) || !std::isfinite(sum.z) ||
                !std::isfinite(sum.w)) {
                sum = glm::vec4(0.0f);
                ++repaired;
            }
            std::memcpy(out.at(at.x + x, at.y + y), &sum, sizeof sum);
        }
    }
    return repaired;
}

} // namespace

struct Renderer::State {
    State(gl::Device& glDevice, const Scene& drawn, GpuScene uploaded, GpuDeformation deformed)
        : device(glDevice), scene(drawn), gpu(std::move(uploaded)), items(drawItems(drawn)),
          deformation(std::move(deformed)), fullScreen(glDevice), timer(glDevice) {}

    gl::Device& device;
    const Scene& scene;
    GpuScene gpu;
    std::vector<DrawItem> items;
    GpuDeformation deformation;
    gl::VertexArray fullScreen;
    gl::Timer timer;
    gl::Buffer frameBuffer, drawBuffer, materialBuffer;
    gl::Framebuffer target;
    std::map<gl::Defines, gl::Program> programs;
    gl::Program backdrop;
    std::optional<Presenter> presenter;

    GpuEnvironment environment;

    core::Result<void> compilePrograms(const plan::EffectPlan& plan,
                                       const RenderSettings& settings);
    core::Result<const gl::Program*> program(const gl::Defines& defines);
    /// What becomes of a tile that `target` holds: x, y, width, height in pixels from the top left.
    using TileSink = std::function<void(const glm::ivec4&)>;
    /// All of a frame but what becomes of its pixels.
    core::Result<Frame> drawFrame(const View& view, const RenderSettings& settings,
                                  const std::function<TileSink(Frame&)>& sinkFor);
    core::Result<void> drawPicture(const View& view, const RenderSettings& settings, Frame& frame,
                                   const TileSink& sink);
    void drawTile(const plan::EffectPlan& plan, const RenderSettings& settings,
                  const blocks::LodestarFrame& block);
    void drawBackdrop();
    blocks::LodestarDraw drawBlock(const DrawItem& item, plan::Features features) const;
    void drawItem(std::size_t index, plan::Features features, const RenderSettings& settings);
};

core::Result<const gl::Program*> Renderer::State::program(const gl::Defines& defines) {
    auto found = programs.find(defines);
    if (found == programs.end()) {
        auto made = gl::Program::make(device, "host/mesh.vert", "host/mesh.frag", defines);
        if (!made) {
            return made.error();
        }
        for (std::size_t unit = 0; unit < kSamplerNames.size(); ++unit) {
            made->setSampler(kSamplerNames[unit], static_cast<int>(unit));
        }
        made->setBlock("LodestarFrame", kFrameBinding);
        made->setBlock("LodestarDraw", kDrawBinding);
        made->setBlock("LodestarMaterial", kMaterialBinding);
        found = programs.emplace(defines, std::move(*made)).first;
    }
    return &found->second;
}

core::Result<void> Renderer::State::compilePrograms(const plan::EffectPlan& plan,
                                                    const RenderSettings& settings) {
    for (plan::Features features : plan.drawFeatures) {
        if (auto made = program(definesFor(features, settings)); !made) {
            return made.error();
        }
    }
    if (plan.backdrop && !backdrop) {
        auto made = gl::Program::make(device, "host/backdrop.vert", "host/backdrop.frag", {});
        if (!made) {
            return made.error();
        }
        backdrop = std::move(*made);
        backdrop.setSampler("uEnvironment", kEnvironmentUnit);
        backdrop.setBlock("LodestarFrame", kFrameBinding);
    }
    return {};
}

void Renderer::State::drawBackdrop() {
    backdrop.use();
    fullScreen.bind();
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_FALSE);
    gl::drawFullScreen(device);
    glDepthMask(GL_TRUE);
}

blocks::LodestarDraw Renderer::State::drawBlock(const DrawItem& item,
                                                plan::Features features) const {
    const Node& node = scene.nodes[static_cast<std::size_t>(item.node)];
    blocks::LodestarDraw draw{};
    draw.worldFromModel = node.worldFromNode;
    // The adjugate's transpose stands for the inverse transpose: it exists for singular transforms,
    // and its sign follows the determinant's, which the front-face rule undoes.
    const glm::mat3 m(node.worldFromNode);
    float sign = glm::determinant(m) < 0.0f ? -1.0f : 1.0f;
    draw.normalFromModel = glm::mat4(
        sign * glm::mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])));
    if (plan::has(features, plan::Feature::Skinning)) {
        const int skin =
            std::get<MeshComponent>(node.components[static_cast<std::size_t>(item.component)]).skin;
        draw.skin.x = deformation.firstTexel(skin);
        sign = deformation.mirrored(skin) ? -1.0f : 1.0f;
    }
    draw.skin.w = sign;
    return draw;
}

void Renderer::State::drawItem(std::size_t index, plan::Features features,
                               const RenderSettings& settings) {
    const DrawItem& item = items[index];
    const GpuPrimitive& part = gpu.primitive(item.mesh, item.primitive);
    const io::GltfMaterial& material =
        materialOf(scene, scene.meshes[static_cast<std::size_t>(item.mesh)]
                              .primitives[static_cast<std::size_t>(item.primitive)]);
    programs.at(definesFor(features, settings)).use();
    const blocks::LodestarDraw draw = drawBlock(item, features);
    drawBuffer.update(bytesOf(draw));
    drawBuffer.bindBlock(kDrawBinding);
    const blocks::LodestarMaterial block = materialBlock(material, settings.materialOverride);
    materialBuffer.update(bytesOf(block));
    materialBuffer.bindBlock(kMaterialBinding);
    gpu.bindTextures(material);
    const bool twoSided = material.doubleSided || part.mode != gl::DrawMode::Triangles;
    twoSided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    glFrontFace(draw.skin.w < 0.0f ? GL_CW : GL_CCW);
    const bool blended = plan::has(features, plan::Feature::AlphaBlend);
    blended ? glEnable(GL_BLEND) : glDisable(GL_BLEND);
    glDepthMask(blended ? GL_FALSE : GL_TRUE);
    const gl::VertexArray* morphed = deformation.vertices(index);
    (morphed != nullptr ? *morphed : part.vertices).bind();
    gl::drawIndexed(device, part.mode, part.indexCount);
}

void Renderer::State::drawTile(const plan::EffectPlan& plan, const RenderSettings& settings,
                               const blocks::LodestarFrame& block) {
    target.begin();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glCullFace(GL_BACK);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_PROGRAM_POINT_SIZE);
    settings.seamless ? glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS)
                      : glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    frameBuffer.update(bytesOf(block));
    frameBuffer.bindBlock(kFrameBinding);
    environment.bind(settings);
    deformation.bind();
    bool backdropDrawn = !plan.backdrop;
    for (std::size_t i = 0; i < plan.drawOrder.size(); ++i) {
        const plan::Features features = plan.drawFeatures[i];
        if (!backdropDrawn && plan::has(features, plan::Feature::AlphaBlend)) {
            drawBackdrop();
            backdropDrawn = true;
        }
        drawItem(plan.drawOrder[i], features, settings);
    }
    if (!backdropDrawn) {
        drawBackdrop();
    }
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() = default;

core::Result<std::unique_ptr<Renderer>> Renderer::make(gl::Device& device, const Scene& scene) {
    auto uploaded = GpuScene::make(device, scene);
    if (!uploaded) {
        return uploaded.error();
    }
    auto deformation = GpuDeformation::make(device, scene, drawItems(scene));
    if (!deformation) {
        return deformation.error();
    }
    auto state =
        std::make_unique<State>(device, scene, std::move(*uploaded), std::move(*deformation));
    state->frameBuffer =
        gl::Buffer(device, gl::BufferKind::Uniform, bytesOf(blocks::LodestarFrame{}));
    state->drawBuffer =
        gl::Buffer(device, gl::BufferKind::Uniform, bytesOf(blocks::LodestarDraw{}));
    state->materialBuffer =
        gl::Buffer(device, gl::BufferKind::Uniform, bytesOf(blocks::LodestarMaterial{}));
    return std::unique_ptr<Renderer>(new Renderer(std::move(state)));
}

void Renderer::setEnvironment(std::string source, lighting::Cubemap base) {
    state_->environment = GpuEnvironment(std::move(source), std::move(base));
}

core::Result<void> Renderer::State::drawPicture(const View& view, const RenderSettings& settings,
                                                Frame& frame, const TileSink& sink) {
    blocks::LodestarFrame block{};
    block.cameraPosition =
        view.perspective ? glm::vec4(view.position, 1.0f) : glm::vec4(view.towardsViewer, 0.0f);
    environment.describe(settings, block);
    setLights(scene, block);
    const int side = std::max(1, kTileSide / settings.samplesPerSide);
    for (int y = 0; y < settings.height; y += side) {
        for (int x = 0; x < settings.width; x += side) {
            const glm::ivec4 tile(x, y, std::min(side, settings.width - x),
                                  std::min(side, settings.height - y));
            const glm::ivec2 samples = glm::ivec2(tile.z, tile.w) * settings.samplesPerSide;
            if (target.width() != samples.x || target.height() != samples.y) {
                auto made = gl::Framebuffer::make(device, samples.x, samples.y);
                if (!made) {
                    return made.error();
                }
                target = std::move(*made);
            }
            block.clipFromWorld =
                tileFromClip(tile, settings.width, settings.height) * view.clipFromWorld();
            block.worldFromClip = glm::mat4(glm::inverse(glm::dmat4(block.clipFromWorld)));
            timer.begin();
            drawTile(frame.plan, settings, block);
            timer.end();
            frame.timesMs["draw"] += timer.milliseconds();
            sink(tile);
        }
    }
    return {};
}

core::Result<Frame> Renderer::State::drawFrame(const View& view, const RenderSettings& settings,
                                               const std::function<TileSink(Frame&)>& sinkFor) {
    LODESTAR_EXPECT(!environment.empty(), "an environment is set before a frame is drawn");
    LODESTAR_EXPECT(settings.width > 0 && settings.height > 0 && settings.samplesPerSide > 0,
                    "a picture has a size");
    Frame frame;
    const gl::WorkCounters before = device.counters();
    const auto timed = [&frame](const char* step, auto&& work) {
        const auto start = Clock::now();
        auto result = work();
        frame.timesMs[step] = millisecondsSince(start);
        return result;
    };
    frame.plan = timed("plan", [&] {
        plan::PlanInput input = planInput(scene, view, settings, environment.view());
        input.alreadyPrepared = environment.prepared();
        deformation.describe(scene, items, input);
        return plan::plan(input);
    });
    auto prepared = timed("prepare", [&] {
        deformation.prepare(device, scene, items, gpu, frame.plan);
        return environment.prepare(device, frame.plan.prepare);
    });
    if (!prepared) {
        return prepared.error();
    }
    auto compiled = timed("compile", [&] { return compilePrograms(frame.plan, settings); });
    if (!compiled) {
        return compiled.error();
    }
    if (auto drawn = drawPicture(view, settings, frame, sinkFor(frame)); !drawn) {
        return drawn.error();
    }
    frame.counters = gl::difference(device.counters(), before);
    return frame;
}

core::Result<Frame> Renderer::render(const View& view, const RenderSettings& settings) {
    State& state = *state_;
    return state.drawFrame(view, settings, [&](Frame& frame) -> State::TileSink {
        frame.radiance = core::Image(settings.width, settings.height, 4);
        return [&](const glm::ivec4& tile) {
            const auto start = Clock::now();
            frame.repairedPixels += resolve(state.target.read(), settings.samplesPerSide,
                                            {tile.x, tile.y}, frame.radiance);
            frame.timesMs["read"] += millisecondsSince(start);
        };
    });
}

core::Result<Frame> Renderer::draw(const View& view, const RenderSettings& settings,
                                   float exposure) {
    State& state = *state_;
    LODESTAR_EXPECT(exposure > 0.0f, "an exposure is a factor above 0");
    if (!state.presenter) {
        auto presenter = Presenter::make(state.device);
        if (!presenter) {
            return presenter.error();
        }
        state.presenter.emplace(std::move(*presenter));
    }
    return state.drawFrame(view, settings, [&](Frame&) -> State::TileSink {
        return [&](const glm::ivec4& tile) {
            const glm::ivec2 origin(tile.x, settings.height - tile.y - tile.w);
            state.presenter->show(state.target, origin, settings.samplesPerSide, exposure);
        };
    });
}

} // namespace lodestar::scene
