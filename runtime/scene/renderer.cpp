// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>

#include <epoxy/gl.h>

#include "scene/draw_list.h"
#include "scene/frame_parts.h"
#include "scene/renderer_state.h"

namespace lodestar::scene {
namespace {

using Clock = std::chrono::steady_clock;

/// Largest side of a tile, in samples: 2048^2 of colour and depth are 80 MiB.
constexpr int kTileSide = 2048;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

} // namespace

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
        drawer.begin();
        drawer.drawCasters(plan, input, settings);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }
    blocks::LodestarRsrmLights block{};
    lights.describe(plan, block);
    shadows.describe(plan, block);
    lightBlock.set(block);
    return {};
}

/// What all passes that shade read and set.
void Renderer::State::bindLight(const RenderSettings& settings,
                                const blocks::LodestarFrame& block) {
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
    drawer.begin();
}

blocks::LodestarFrame Renderer::State::frameBlockFor(const RenderSettings& settings,
                                                     const glm::vec4& camera) const {
    blocks::LodestarFrame block{};
    block.cameraPosition = camera;
    block.written = {1.0f, std::numeric_limits<float>::max(), 0.0f, 0.0f};
    environment.describe(settings, block);
    setPunctualLights(scene, block);
    return block;
}

/// The faces that the plan draws, and what it makes of them.
core::Result<void> Renderer::State::drawProbes(const plan::EffectPlan& plan,
                                               const RenderSettings& settings,
                                               const plan::PlanInput& input) {
    if (observer.empty()) {
        return {};
    }
    if (auto made = probes.prepare(device, observer, plan, probeWarnings); !made) {
        return made;
    }
    probes.setSkyFactors(input);
    probes.describe(device, observer, input);
    constexpr float kGreatestHalf = 65504.0f;
    for (std::size_t i = 0; i < plan.probeFaces.size(); ++i) {
        const plan::ProbeFace& face = plan.probeFaces[i];
        const FaceView view = faceView(input.probes[face.probe], face.face);
        blocks::LodestarFrame block = frameBlockFor(settings, glm::vec4(view.position, 1.0f));
        block.written = {probes.written(), kGreatestHalf, 0.0f, 0.0f};
        block.clipFromWorld = view.clipFromWorld;
        probes.beginFace(face);
        bindLight(settings, block);
        drawer.drawFace(plan, i, settings, probes);
        probes.endFace(face);
        const bool last =
            i + 1 == plan.probeFaces.size() || plan.probeFaces[i + 1].probe != face.probe;
        if (last && publishes(plan, face.probe)) {
            probes.publish(face.probe);
        }
    }
    if (!plan.probeWork.empty()) {
        blocks::LodestarFrame block = frameBlockFor(settings, glm::vec4(0.0f));
        block.written = {probes.written(), kGreatestHalf, 0.0f, 0.0f};
        bindLight(settings, block);
        probes.work(plan, drawer.programs(), observer);
        probes.describe(device, observer, input); // levels have been made
    }
    return {};
}

/// What `auto` stands for; where nothing is foreseen yet draws are described again in the next
/// frame.
void Renderer::State::chooseEstimators(bool wait, plan::PlanInput& input) {
    const bool wanted = input.environment.present && hasChoices(input);
    const lighting::ErrorForecast* forecast = wanted ? environment.forecast(wait) : nullptr;
    forecastAwaited = wanted && forecast == nullptr;
    if (forecast != nullptr) {
        scene::chooseEstimators(*forecast, input);
    }
}

std::shared_ptr<const plan::EffectPlan> Renderer::State::planFrame(const View& view,
                                                                   const RenderSettings& settings) {
    GpuDeformation& deformation = drawer.deformation();
    if (forecastAwaited) {
        planner.forgetDraws();
    }
    planner.describeDraws(scene, view, settings, deformation.deforms());
    plan::PlanInput& input = planner.input();
    input.environment = beside(environment.view(), lights);
    chooseEstimators(settings.waitForForecast, input);
    input.alreadyPrepared = environment.prepared();
    input.instancesPerPage = GpuInstances::pageSize(device);
    deformation.describe(scene, drawer.items(), input);
    if (lights.shadowCount() != shadowCount) {
        shadows = {};
        shadowCount = lights.shadowCount();
    }
    describeLights(scene, drawer.items(), settings.hour, lights, shadows, input);
    input.faceBudget = settings.faceBudget;
    input.probeBudgetMs = settings.probeBudgetMs;
    if (!observer.empty()) {
        observer.describe(lightState(environment, lights, observer.ratios()), planner.drawsKept(),
                          settings.lightThreshold, input);
        if (std::isfinite(input.probeBudgetMs)) {
            probes.describeTimes(device, input.probes);
        }
    }
    return planner.plan();
}

core::Result<void>
Renderer::State::drawTiles(const View& view, const RenderSettings& settings,
                           blocks::LodestarFrame block,
                           const std::function<void(const blocks::LodestarFrame&)>& drawTile,
                           const TileSink& sink, double& milliseconds) {
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
            target.begin();
            drawTile(block);
            timer.end();
            milliseconds += timer.milliseconds();
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
        drawer.prepare(plan, settings);
        auto made = environment.prepare(device, plan.prepare);
        return made ? lights.prepare(device, plan) : made;
    });
    if (!prepared) {
        return prepared.error();
    }
    auto compiled = timed("compile", [&] { return drawer.compile(input, plan, settings); });
    if (!compiled) {
        return compiled.error();
    }
    auto shadowed = timed("shadows", [&] { return drawShadows(plan, settings, input); });
    if (!shadowed) {
        return shadowed.error();
    }
    auto captured = timed("probes", [&] { return drawProbes(plan, settings, input); });
    if (!captured) {
        return captured.error();
    }
    const auto drawTile = [&](const blocks::LodestarFrame& block) {
        bindLight(settings, block);
        drawer.drawPicture(plan, settings, probes);
    };
    if (auto drawn = drawTiles(view, settings, frameBlockFor(settings, view.viewer()), drawTile,
                               sinkFor(frame), frame.timesMs["draw"]);
        !drawn) {
        return drawn.error();
    }
    if (!observer.empty()) {
        observer.executed(plan);
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

core::Result<Frame> Renderer::draw(const View& view, const RenderSettings& settings, float exposure,
                                   unsigned framebuffer) {
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
            state.presenter->show(state.target, origin, settings.samplesPerSide, exposure,
                                  framebuffer);
        };
    });
}

core::Result<void> Renderer::State::prepareReference(const plan::EffectPlan& plan,
                                                     const RenderSettings& settings, int taps) {
    if (!environment.empty()) {
        if (auto made = environment.prepareReference(device, taps); !made) {
            return made;
        }
    }
    if (auto made = lights.prepareReference(device, plan, taps); !made) {
        return made;
    }
    return drawer.compileReferences(plan, settings);
}

core::Result<core::Image> Renderer::redraw(const View& view, const RenderSettings& given,
                                           const std::optional<ReferenceTaps>& taps) {
    State& state = *state_;
    const std::shared_ptr<const plan::EffectPlan> plan = state.planner.last();
    LODESTAR_EXPECT(plan != nullptr, "a frame is drawn before it is drawn again");
    RenderSettings settings = given;
    settings.samplesPerSide = 1;
    blocks::LodestarFrame block = state.frameBlockFor(settings, view.viewer());
    if (taps) {
        LODESTAR_EXPECT(taps->first >= 0 && taps->step > 0 && taps->first < taps->total &&
                            taps->total <= 16384,
                        "a pass takes some of up to 16384 taps");
        if (auto made = state.prepareReference(*plan, settings, taps->total); !made) {
            return made.error();
        }
        if (!state.environment.empty()) {
            state.environment.describeReference(block);
        }
        const int count = (taps->total - taps->first + taps->step - 1) / taps->step;
        block.referenceTaps = glm::vec4(taps->first, taps->step, count, taps->total);
    }
    core::Image picture(settings.width, settings.height, 4);
    const auto drawTile = [&](const blocks::LodestarFrame& tile) {
        state.bindLight(settings, tile);
        if (taps && !state.environment.empty()) {
            state.environment.bindReference();
        }
        if (taps) {
            state.lights.bindReference();
        }
        state.drawer.drawSurfaces(*plan, settings, state.probes, taps.has_value());
    };
    double milliseconds = 0.0;
    const auto sink = [&](const glm::ivec4& tile) {
        (void)resolve(state.target.read(), 1, {tile.x, tile.y}, picture);
    };
    if (auto drawn = state.drawTiles(view, settings, block, drawTile, sink, milliseconds); !drawn) {
        return drawn.error();
    }
    return picture;
}

} // namespace lodestar::scene
