// SPDX-License-Identifier: MIT
#include "scene/renderer.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <span>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_inverse.hpp>

#include "gl/timer.h"
#include "scene/draw_list.h"
#include "scene/frame_parts.h"
#include "scene/gpu_deformation.h"
#include "scene/gpu_environment.h"
#include "scene/gpu_scene.h"
#include "scene/presenter.h"
#include "scene/programs.h"

namespace lodestar::scene {
namespace {

using Clock = std::chrono::steady_clock;

/// Largest side of a tile, in samples: 2048^2 of colour and depth are 80 MiB.
constexpr int kTileSide = 2048;

template <class Block>
std::span<const std::byte> bytesOf(const Block& block) {
    return std::as_bytes(std::span(&block, 1));
}

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

} // namespace

struct Renderer::State {
    State(gl::Device& glDevice, const Scene& drawn, GpuScene uploaded, GpuDeformation deformed)
        : device(glDevice), scene(drawn), gpu(std::move(uploaded)), items(drawItems(drawn)),
          deformation(std::move(deformed)), fullScreen(glDevice), timer(glDevice),
          programs(glDevice) {}

    gl::Device& device;
    const Scene& scene;
    GpuScene gpu;
    std::vector<DrawItem> items;
    GpuDeformation deformation;
    gl::VertexArray fullScreen;
    gl::Timer timer;
    gl::Buffer frameBuffer, drawBuffer, materialBuffer;
    gl::Framebuffer target;
    Programs programs;
    std::optional<Presenter> presenter;

    GpuEnvironment environment;

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

void Renderer::State::drawBackdrop() {
    programs.backdrop().use();
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
    programs.mesh(features, settings).use();
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
    setPunctualLights(scene, block);
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
    auto compiled = timed("compile", [&] { return programs.compile(frame.plan, settings); });
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
