// SPDX-License-Identifier: MIT
#include "scene/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <span>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_inverse.hpp>

#include "gl/timer.h"
#include "scene/draw_list.h"
#include "scene/frame_parts.h"
#include "scene/frame_planner.h"
#include "scene/gpu_batches.h"
#include "scene/gpu_deformation.h"
#include "scene/gpu_environment.h"
#include "scene/gpu_lights.h"
#include "scene/gpu_scene.h"
#include "scene/presenter.h"
#include "scene/programs.h"
#include "scene/shadow_maps.h"
#include "scene/uniform_block.h"

namespace lodestar::scene {
namespace {

using Clock = std::chrono::steady_clock;

/// Largest side of a tile, in samples: 2048^2 of colour and depth are 80 MiB.
constexpr int kTileSide = 2048;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

} // namespace

/// What the batches of a pass have set so far.
struct PassState {
    const MeshProgram* program = nullptr;
    plan::Features features = 0;
    const io::GltfMaterial* material = nullptr;
    const gl::VertexArray* vertices = nullptr;
    std::optional<bool> twoSided, mirrored;
};

struct Renderer::State {
    State(gl::Device& glDevice, const Scene& drawn, GpuScene uploaded, GpuDeformation deformed)
        : device(glDevice), scene(drawn), gpu(std::move(uploaded)), items(drawItems(drawn)),
          deformation(std::move(deformed)), fullScreen(glDevice), timer(glDevice),
          frameBlock(glDevice), lightBlock(glDevice), programs(glDevice) {}

    gl::Device& device;
    const Scene& scene;
    GpuScene gpu;
    std::vector<DrawItem> items;
    GpuDeformation deformation;
    gl::VertexArray fullScreen;
    gl::Timer timer;
    UniformBlock<blocks::LodestarFrame> frameBlock;
    UniformBlock<blocks::LodestarRsrmLights> lightBlock;
    GpuInstances instances;
    GpuMaterials materials;
    gl::Framebuffer target;
    Programs programs;
    FramePlanner planner;
    std::optional<Presenter> presenter;

    GpuEnvironment environment;
    GpuLights lights;
    ShadowMaps shadows;

    /// What becomes of a tile that `target` holds: x, y, width, height in pixels from the top left.
    using TileSink = std::function<void(const glm::ivec4&)>;
    /// All of a frame but what becomes of its pixels.
    core::Result<Frame> drawFrame(const View& view, const RenderSettings& settings,
                                  const std::function<TileSink(Frame&)>& sinkFor);
    core::Result<void> drawPicture(const View& view, const RenderSettings& settings, Frame& frame,
                                   const TileSink& sink);
    void drawTile(const plan::EffectPlan& plan, const RenderSettings& settings,
                  const blocks::LodestarFrame& block);
    [[nodiscard]] std::shared_ptr<const plan::EffectPlan> planFrame(const View& view,
                                                                    const RenderSettings& settings);
    core::Result<void> drawShadows(const plan::EffectPlan& plan, const RenderSettings& settings,
                                   const plan::PlanInput& input);
    void drawBackdrop(const plan::EffectPlan& plan);
    void placeInstances(const plan::EffectPlan& plan);
    void use(const MeshProgram& program, const plan::Batch& batch, std::size_t before);
    void drawBatch(const plan::Batch& batch, const plan::EffectPlan& plan,
                   const RenderSettings& settings, PassState& state);
    void drawCasters(const plan::EffectPlan& plan, const RenderSettings& settings,
                     const plan::PlanInput& input);
    void drawInstances(std::size_t index, const plan::Batch& batch, PassState& state);
};

void Renderer::State::drawBackdrop(const plan::EffectPlan& plan) {
    programs.backdrop(plan).use();
    fullScreen.bind();
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_FALSE);
    gl::drawFullScreen(device);
    glDepthMask(GL_TRUE);
}

/// Where the instances of all batches stand: those of the picture, then the casters.
void Renderer::State::placeInstances(const plan::EffectPlan& plan) {
    std::vector<Instance> placed;
    placed.reserve(plan.drawOrder.size() + plan.casters.size());
    for (const std::vector<std::size_t>* order : {&plan.drawOrder, &plan.casters}) {
        for (const std::size_t index : *order) {
            const DrawItem& item = items[index];
            const Node& node = scene.nodes[static_cast<std::size_t>(item.node)];
            const glm::mat4 rows = glm::transpose(node.worldFromNode);
            const int skin =
                std::get<MeshComponent>(node.components[static_cast<std::size_t>(item.component)])
                    .skin;
            placed.push_back(
                {{rows[0], rows[1], rows[2]}, {deformation.firstTexel(skin), 0.0f, 0.0f, 0.0f}});
        }
    }
    instances.upload(device, placed);
}

/// @param before instances that stand before the order's first
void Renderer::State::use(const MeshProgram& program, const plan::Batch& batch,
                          std::size_t before) {
    program.program.use();
    glUniform1i(program.firstInstance, static_cast<int>(instances.bind(before + batch.first)));
}

/// @param index of the batch's first draw
void Renderer::State::drawInstances(std::size_t index, const plan::Batch& batch, PassState& state) {
    const DrawItem& item = items[index];
    const GpuPrimitive& part = gpu.geometry().primitive(item.mesh, item.primitive);
    const gl::VertexArray* morphed = deformation.vertices(index);
    const gl::VertexArray* vertices =
        morphed != nullptr ? morphed : &gpu.geometry().pool(part).vertices;
    if (state.vertices != vertices) {
        vertices->bind();
        state.vertices = vertices;
    }
    gl::IndexRange indices = part.indices;
    indices.baseVertex = morphed != nullptr ? 0 : indices.baseVertex;
    gl::drawIndexed(device, part.mode, indices, static_cast<int>(batch.count));
}

void Renderer::State::drawBatch(const plan::Batch& batch, const plan::EffectPlan& plan,
                                const RenderSettings& settings, PassState& state) {
    const std::size_t index = plan.drawOrder[batch.first];
    const DrawItem& item = items[index];
    const io::GltfPrimitive& primitive = scene.meshes[static_cast<std::size_t>(item.mesh)]
                                             .primitives[static_cast<std::size_t>(item.primitive)];
    const io::GltfMaterial& material = materialOf(scene, primitive);
    const plan::Features features = plan.drawFeatures[batch.first];
    if (state.program == nullptr || state.features != features) {
        state.program = &programs.mesh(features, plan, settings);
        state.features = features;
        const bool blended = plan::has(features, plan::Feature::AlphaBlend);
        blended ? glEnable(GL_BLEND) : glDisable(GL_BLEND);
        glDepthMask(blended ? GL_FALSE : GL_TRUE);
    }
    use(*state.program, batch, 0);
    if (state.material != &material) {
        state.material = &material;
        materials.bind(primitive.material);
        gpu.bindTextures(material);
    }
    const bool twoSided = material.doubleSided || primitive.topology != io::Topology::Triangles;
    if (state.twoSided != twoSided) {
        state.twoSided = twoSided;
        twoSided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    }
    if (state.mirrored != batch.mirrored) {
        state.mirrored = batch.mirrored;
        glFrontFace(batch.mirrored ? GL_CW : GL_CCW);
    }
    drawInstances(index, batch, state);
}

void Renderer::State::drawCasters(const plan::EffectPlan& plan, const RenderSettings& settings,
                                  const plan::PlanInput& input) {
    PassState state;
    for (const plan::Batch& batch : plan.casterBatches) {
        const std::size_t index = plan.casters[batch.first];
        const plan::Features features = input.draws[index].features;
        if (state.program == nullptr || state.features != features) {
            state.program = &programs.depth(features, plan, settings);
            state.features = features;
        }
        use(*state.program, batch, plan.drawOrder.size());
        if (plan::has(features, plan::Feature::AlphaMask)) {
            const int material = static_cast<int>(input.draws[index].material) - 1;
            materials.bind(material);
            gpu.bindTextures(scene.materials[static_cast<std::size_t>(material)]);
        }
        drawInstances(index, batch, state);
    }
}

/// The maps that the plan draws, and the block that says how all are read.
core::Result<void> Renderer::State::drawShadows(const plan::EffectPlan& plan,
                                                const RenderSettings& settings,
                                                const plan::PlanInput& input) {
    if (plan.rsrmLights.empty()) {
        return {};
    }
    int layers = 0;
    for (const plan::RsrmLightView& light : input.rsrmLights) {
        layers = std::max(layers, light.shadow + 1);
    }
    for (const plan::LitLight& lit : plan.rsrmLights) {
        if (!lit.drawShadow) {
            continue;
        }
        if (auto begun = shadows.begin(device, lit, layers); !begun) {
            return begun;
        }
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glDisable(GL_CULL_FACE); // a sheet casts whichever side the sun sees
        glDisable(GL_BLEND);
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1.5f, 2.0f);
        blocks::LodestarFrame block{};
        block.clipFromWorld = shadows.view(lit.shadow).clipFromWorld;
        frameBlock.set(block);
        frameBlock.bind(kFrameBinding);
        deformation.bind();
        instances.forgetBound();
        drawCasters(plan, settings, input);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }
    blocks::LodestarRsrmLights block{};
    lights.describe(plan, block);
    shadows.describe(plan, block);
    lightBlock.set(block);
    return {};
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
    frameBlock.set(block);
    frameBlock.bind(kFrameBinding);
    environment.bind(settings);
    lights.bind();
    shadows.bind();
    lightBlock.bind(kRsrmBinding);
    deformation.bind();
    instances.forgetBound();
    bool backdropDrawn = !plan.backdrop;
    PassState state;
    for (const plan::Batch& batch : plan.batches) {
        if (!backdropDrawn &&
            plan::has(plan.drawFeatures[batch.first], plan::Feature::AlphaBlend)) {
            drawBackdrop(plan);
            backdropDrawn = true;
            state = {};
        }
        drawBatch(batch, plan, settings, state);
    }
    if (!backdropDrawn) {
        drawBackdrop(plan);
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
    return std::unique_ptr<Renderer>(new Renderer(std::move(state)));
}

void Renderer::setEnvironment(std::string source, lighting::Cubemap base) {
    state_->environment = GpuEnvironment(std::move(source), std::move(base));
}

void Renderer::setLights(std::vector<lighting::DayLight> lights,
                         const lighting::RsrmLayout& layout) {
    state_->lights = GpuLights(std::move(lights), layout, state_->lights.kernels());
    state_->shadows = {};
}

const core::Tally& Renderer::lightWarnings() const {
    return state_->lights.warnings();
}

namespace {

/// A sky that is not added stands in the environment's place.
plan::EnvironmentView beside(plan::EnvironmentView environment, const GpuLights& lights) {
    environment.replacedBy = lights.replacement();
    environment.present = environment.present && environment.replacedBy.empty();
    return environment;
}

void describeLights(const Scene& scene, const std::vector<DrawItem>& items, double hour,
                    GpuLights& lights, ShadowMaps& shadows, plan::PlanInput& input) {
    input.rsrmLights = lights.describe(hour);
    input.rsrmPublished = lights.published();
    input.rsrmGreatestExponent = lights.greatestExponent();
    std::vector<glm::dvec3> axes;
    for (std::size_t i = 0; i < input.rsrmLights.size(); ++i) {
        axes.push_back(lights.axis(i));
    }
    if (!axes.empty()) {
        shadows.describe(scene, items, axes, input);
    }
}

} // namespace

plan::PlanInput planInput(const Scene& scene, const View& view, const RenderSettings& settings,
                          plan::EnvironmentView environment,
                          const std::vector<lighting::DayLight>& lights) {
    GpuLights described(lights, lighting::kRsrm, nullptr); // it bakes nothing
    ShadowMaps shadows;
    plan::PlanInput input =
        planInput(scene, view, settings, beside(std::move(environment), described));
    describeLights(scene, drawItems(scene), settings.hour, described, shadows, input);
    return input;
}

std::shared_ptr<const plan::EffectPlan> Renderer::State::planFrame(const View& view,
                                                                   const RenderSettings& settings) {
    planner.describeDraws(scene, view, settings, deformation.deforms());
    plan::PlanInput& input = planner.input();
    input.environment = beside(environment.view(), lights);
    input.alreadyPrepared = environment.prepared();
    input.instancesPerPage = GpuInstances::pageSize(device);
    deformation.describe(scene, items, input);
    describeLights(scene, items, settings.hour, lights, shadows, input);
    return planner.plan();
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
            drawTile(*frame.plan, settings, block);
            timer.end();
            frame.timesMs["draw"] += timer.milliseconds();
            sink(tile);
        }
    }
    return {};
}

core::Result<Frame> Renderer::State::drawFrame(const View& view, const RenderSettings& settings,
                                               const std::function<TileSink(Frame&)>& sinkFor) {
    LODESTAR_EXPECT(!environment.empty() || !lights.empty(),
                    "an environment or lights are set before a frame is drawn");
    LODESTAR_EXPECT(std::isfinite(settings.hour), "an hour is finite");
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
    frame.plan = timed("plan", [&] { return planFrame(view, settings); });
    const plan::EffectPlan& plan = *frame.plan;
    const plan::PlanInput& input = planner.input();
    auto prepared = timed("prepare", [&] {
        deformation.prepare(device, scene, items, gpu, plan);
        materials.prepare(device, scene, settings.materialOverride);
        placeInstances(plan);
        auto made = environment.prepare(device, plan.prepare);
        return made ? lights.prepare(device, plan) : made;
    });
    if (!prepared) {
        return prepared.error();
    }
    auto compiled = timed("compile", [&] { return programs.compile(input, plan, settings); });
    if (!compiled) {
        return compiled.error();
    }
    auto shadowed = timed("shadows", [&] { return drawShadows(plan, settings, input); });
    if (!shadowed) {
        return shadowed.error();
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
