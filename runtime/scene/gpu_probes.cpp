// SPDX-License-Identifier: MIT
#include "scene/gpu_probes.h"

#include <algorithm>
#include <cstring>
#include <numbers>
#include <utility>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/gpu_scene.h"
#include "scene/programs.h"

namespace lodestar::scene {
namespace {

/// Wider faces are of no use to a probe, and six of them take 200 MB.
constexpr int kWidest = 2048;
/// Samples of a captured texel, so that small lamps neither vanish nor flicker.
constexpr int kSamples = 4;

blocks::LodestarProbe blockOf(const plan::ProbeView& view, const lighting::Probe& probe,
                              const std::optional<lighting::PlacedVolume>& placed) {
    blocks::LodestarProbe block{};
    const lighting::PlacedVolume& influence = *view.influence;
    std::copy(influence.rows.begin(), influence.rows.end(), block.influenceRows);
    block.influenceExtents = glm::vec4(influence.halfExtents, influence.sphere ? 1.0f : 0.0f);
    block.influenceHigh = glm::vec4(influence.blendHigh, influence.outward ? 1.0f : 0.0f);
    block.influenceLow = glm::vec4(influence.blendLow, 0.0f);
    block.proxyExtents.w = -1.0f;
    if (placed) {
        std::copy(placed->rows.begin(), placed->rows.end(), block.proxyRows);
        block.proxyExtents = glm::vec4(placed->halfExtents, placed->sphere ? 1.0f : 0.0f);
    }
    block.capturedAt = glm::vec4(view.position, 0.0f);
    block.light = glm::vec4(glm::vec3(probe.tint * probe.intensity), 0.0f);
    return block;
}

} // namespace

FaceView faceView(const plan::ProbeView& probe, int face) {
    constexpr glm::vec3 kForward[] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                      {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    constexpr glm::vec3 kUp[] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1},
                                 {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    const glm::mat4 clip = glm::perspective(std::numbers::pi_v<float> / 2.0f, 1.0f,
                                            static_cast<float>(probe.capture.nearPlane),
                                            static_cast<float>(probe.capture.farPlane));
    return {probe.position,
            clip * glm::lookAt(probe.position, probe.position + kForward[face], kUp[face])};
}

core::Result<void> GpuProbes::prepareShared(gl::Device& device) {
    if (filter_) {
        return {};
    }
    auto filter = gl::ProbeFilter::make(device);
    if (!filter) {
        return filter.error();
    }
    auto atlas = gl::IrradianceAtlas::make(device);
    if (!atlas) {
        return atlas.error();
    }
    device_ = &device;
    filter_.emplace(std::move(*filter));
    irradiance_ = std::move(*atlas);
    faces_ = gl::CubeFaces(device);
    fullScreen_ = gl::VertexArray(device);
    return {};
}

core::Result<GpuProbes::Cubes> GpuProbes::makeCubes(gl::Device& device,
                                                    const ProbeComponent& component, bool ratio,
                                                    core::Tally& warnings) {
    const bool fromFile = component.map != nullptr;
    const int asked = fromFile ? component.map->width() : component.probe.capture.resolution;
    int width = fromFile ? asked : std::min({asked, kWidest, device.capabilities().maxCubeSize});
    for (;; width /= 2) {
        auto captured = fromFile ? gl::Texture::makeCube(device, *component.map, "a probe's file")
                                 : gl::Texture::makeCubeTarget(device, width, 1, "captured light");
        if (captured) {
            auto lit = gl::Texture::makeCubeTarget(device, width, lighting::fullLevelCount(width),
                                                   "light of a probe");
            core::Result<gl::Texture> sky = gl::Texture();
            if (lit && ratio) {
                sky = gl::Texture::makeCubeTarget(device, width, lighting::fullLevelCount(width),
                                                  "sky of a probe");
            }
            if (lit && sky) {
                warnings.add("light probe smaller than asked for", width < asked ? 1 : 0);
                return Cubes{width, std::move(*captured), std::move(*lit), std::move(*sky)};
            }
            captured = lit ? sky.error() : lit.error();
        }
        if (width <= 1 || fromFile) {
            return captured.error();
        }
    }
}

core::Result<void> GpuProbes::prepareStaging(gl::Device& device, int width) {
    if (staging_.contains(width)) {
        return {};
    }
    auto target = gl::FaceTarget::make(device, width, kSamples);
    if (!target) {
        return target.error();
    }
    auto faces = gl::Texture::makeCubeTarget(device, width, 1, "faces drawn anew");
    if (!faces) {
        return faces.error();
    }
    staging_.emplace(width, Staging{std::move(*target), std::move(*faces)});
    return {};
}

core::Result<void> GpuProbes::prepare(gl::Device& device, const ProbeObserver& observer,
                                      const plan::EffectPlan& plan, core::Tally& warnings) {
    if (plan.probeFaces.empty() && plan.probeWork.empty()) {
        return {};
    }
    if (auto shared = prepareShared(device); !shared) {
        return shared;
    }
    cubes_.resize(observer.count());
    std::vector<std::size_t> needed;
    for (const plan::ProbeFace& face : plan.probeFaces) {
        needed.push_back(face.probe);
    }
    for (const plan::ProbeWork& work : plan.probeWork) {
        needed.push_back(work.probe);
    }
    for (const std::size_t index : needed) {
        if (cubes_[index].width > 0) {
            continue;
        }
        auto made = makeCubes(device, observer.component(index), observer.ratio(index), warnings);
        if (!made) {
            return made.error();
        }
        for (int* number : {&made->tile, &made->skyTile}) {
            if (number == &made->skyTile && !made->sky) {
                continue;
            }
            if (freeTiles_.empty()) {
                auto tile = irradiance_.add();
                if (!tile) {
                    return tile.error();
                }
                freeTiles_.push_back(*tile);
            }
            *number = freeTiles_.back();
            freeTiles_.pop_back();
        }
        cubes_[index] = std::move(*made);
    }
    for (const plan::ProbeFace& face : plan.probeFaces) {
        if (auto made = prepareStaging(device, cubes_[face.probe].width); !made) {
            return made;
        }
    }
    return {};
}

void GpuProbes::keep(std::span<const int> which) {
    std::vector<Cubes> cubes = std::exchange(cubes_, {});
    if (!cubes.empty()) {
        cubes_.resize(which.size());
    }
    for (std::size_t i = 0; i < cubes_.size(); ++i) {
        const auto was = static_cast<std::size_t>(which[i]); // none is past all
        if (was < cubes.size()) {
            cubes_[i] = std::exchange(cubes[was], {});
        }
    }
    for (const Cubes& lost : cubes) {
        if (lost.width > 0) {
            freeTiles_.push_back(lost.tile);
        }
        if (lost.width > 0 && lost.sky) {
            freeTiles_.push_back(lost.skyTile);
        }
    }
    times_.reset();
}

void GpuProbes::describeTimes(gl::Device& device, std::span<plan::ProbeView> probes) {
    if (!times_) {
        times_.emplace(device, probes.size());
    }
    times_->describe(probes);
}

void GpuProbes::beginFace(const plan::ProbeFace& face) {
    if (times_) {
        times_->begin(face.probe, face.face);
    }
    staging_.at(cubes_[face.probe].width).target.begin();
}

void GpuProbes::endFace(const plan::ProbeFace& face) {
    Cubes& cubes = cubes_[face.probe];
    Staging& staging = staging_.at(cubes.width);
    staging.target.resolve(staging.faces, face.face);
    cubes.staged[static_cast<std::size_t>(face.face)] = true;
    ++device_->counters().probeFaces;
    if (times_) {
        times_->end();
    }
}

void GpuProbes::publish(std::size_t probe) {
    Cubes& cubes = cubes_[probe];
    for (int face = 0; face < 6; ++face) {
        if (std::exchange(cubes.staged[static_cast<std::size_t>(face)], false)) {
            faces_.copy(staging_.at(cubes.width).faces, cubes.captured, face);
        }
    }
}

void GpuProbes::compose(const plan::ProbeWork& work, const gl::Program& program, bool fromFile,
                        CompositionPart part) {
    const Cubes& cubes = cubes_[work.probe];
    program.use();
    glUniform1ui(program.uniform("uHalfStep"), filter_->halfStep());
    glUniform1f(program.uniform("uWidth"), static_cast<float>(cubes.width));
    glUniform1f(program.uniform("uCapturedScale"),
                fromFile ? cubes.captured.scale() * written_ : 1.0f);
    cubes.captured.bind(kFirstProbeUnit);
    cubes.captured.readNearest(true);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_FALSE);
    work.fadeLeft > 1 ? glEnable(GL_BLEND) : glDisable(GL_BLEND);
    const float share = 1.0f / static_cast<float>(work.fadeLeft);
    const bool sky = part == CompositionPart::Sky;
    // What fades out goes on with its factor, what is written has none.
    const glm::vec3 kept = (1.0f - share) * (sky ? cubes.skyFactor : glm::vec3(1.0f));
    glBlendColor(kept.r, kept.g, kept.b, share);
    glBlendFuncSeparate(GL_CONSTANT_ALPHA, GL_CONSTANT_COLOR, GL_CONSTANT_ALPHA,
                        GL_ONE_MINUS_CONSTANT_ALPHA);
    fullScreen_.bind();
    for (int face = 0; face < 6; ++face) {
        faces_.begin(sky ? cubes.sky : cubes.lit, face);
        glUniform1i(program.uniform("uFace"), face);
        gl::drawFullScreen(*device_);
    }
    glDisable(GL_BLEND);
    cubes.captured.readNearest(false);
}

/// @pre what was captured is bound
void GpuProbes::findSuns(const Cubes& cubes, const gl::Program& program) {
    program.use();
    const glm::ivec2 first = irradiance_.tile(cubes.tile);
    glUniform2i(program.uniform("uTile"), first.x, first.y + gl::kTileWidth);
    irradiance_.beginRows(cubes.tile);
    gl::drawFullScreen(*device_);
}

void GpuProbes::work(const plan::EffectPlan& plan, const Programs& programs,
                     const ProbeObserver& observer) {
    for (const plan::ProbeWork& work : plan.probeWork) {
        Cubes& cubes = cubes_[work.probe];
        if (times_) {
            times_->begin(work.probe, ProbeTimes::kLight);
        }
        if (work.compose) {
            for (const CompositionPart part : partsOf(static_cast<bool>(cubes.sky))) {
                compose(work, programs.composition(plan, part),
                        observer.component(work.probe).map != nullptr, part);
            }
            cubes.skyFactor = glm::vec3(1.0f);
            if (!plan.rsrmLights.empty()) {
                findSuns(cubes, programs.seenSuns());
            }
        }
        cubes.lastLevel = std::min(work.lastLevel, cubes.lit.levelCount() - 1);
        for (const auto& [cube, tile] :
             {std::pair{&cubes.lit, cubes.tile}, std::pair{&cubes.sky, cubes.skyTile}}) {
            if (*cube) {
                work.irradiance ? filter_->fill(*cube, cubes.lastLevel, irradiance_, tile)
                                : filter_->fillMips(*cube, cubes.lastLevel);
            }
        }
        if (times_) {
            times_->end();
        }
    }
}

void GpuProbes::setSkyFactors(const plan::PlanInput& input) {
    for (std::size_t i = 0; i < std::min(cubes_.size(), input.probes.size()); ++i) {
        cubes_[i].skyFactor = input.probes[i].skyFactor;
    }
}

void GpuProbes::describe(gl::Device& device, const ProbeObserver& observer,
                         const plan::PlanInput& input) {
    const auto alignment = static_cast<std::size_t>(device.capabilities().uniformAlignment);
    stride_ = (sizeof(blocks::LodestarProbe) + alignment - 1) / alignment * alignment;
    const std::size_t count = input.probes.size();
    std::vector<blocks::LodestarProbe> blocks(2 * count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        if (!input.probes[i].influence) {
            continue;
        }
        blocks::LodestarProbe& block = blocks[i + 1];
        block = blockOf(input.probes[i], observer.probe(i), observer.proxy(i));
        if (i < cubes_.size() && cubes_[i].width > 0) {
            const Cubes& cubes = cubes_[i];
            block.capturedAt.w = static_cast<float>(cubes.width);
            block.light /= written_;
            block.light.w = static_cast<float>(cubes.lastLevel);
            block.tile = glm::vec4(glm::vec2(irradiance_.tile(cubes.tile)), 0.0f, 0.0f);
            if (cubes.sky) {
                block.sky = glm::vec4(cubes.skyFactor, 1.0f);
                block.tile.z = static_cast<float>(irradiance_.tile(cubes.skyTile).x);
                block.tile.w = static_cast<float>(irradiance_.tile(cubes.skyTile).y);
            }
        }
        blocks[count + i + 1] = block;
        blocks[count + i + 1].light = glm::vec4(0.0f);
    }
    if (blocks.size() == blocks_.size() &&
        std::memcmp(blocks.data(), blocks_.data(), blocks.size() * sizeof blocks[0]) == 0) {
        return;
    }
    std::vector<std::byte> bytes(blocks.size() * stride_);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        std::memcpy(bytes.data() + i * stride_, &blocks[i], sizeof blocks[i]);
    }
    if (blocks_.empty()) {
        blockBuffer_ = gl::Buffer(device, gl::BufferKind::Uniform, bytes);
    } else {
        blockBuffer_.update(bytes);
    }
    blocks_ = std::move(blocks);
}

core::Image GpuProbes::read(std::size_t probe, int face, int level) const {
    if (probe >= cubes_.size() || level > cubes_[probe].lastLevel || cubes_[probe].width == 0) {
        return {};
    }
    const int width = std::max(cubes_[probe].width >> level, 1);
    core::Image image(width, width, 4);
    const auto fetch = [&](const gl::Texture& cube, core::Image& into) {
        cube.bind(kFirstProbeUnit);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glGetTexImage(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level, GL_RGBA,
                      GL_FLOAT, into.pixels().data());
    };
    fetch(cubes_[probe].lit, image);
    if (cubes_[probe].sky) {
        core::Image sky(width, width, 4);
        fetch(cubes_[probe].sky, sky);
        for (std::size_t i = 0; i < sky.pixels().size(); ++i) {
            const auto c = static_cast<int>(i % 4);
            image.pixels()[i] += c < 3 ? cubes_[probe].skyFactor[c] * sky.pixels()[i] : 0.0f;
        }
    }
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        image.pixels()[i] /= i % 4 < 3 ? written_ : 1.0f;
    }
    return image;
}

void GpuProbes::bind(const plan::ProbeChoice& choice) const {
    constexpr int kUnits[] = {kFirstProbeUnit, kSecondProbeUnit};
    constexpr int kSkyUnits[] = {kFirstProbeSkyUnit, kSecondProbeSkyUnit};
    constexpr unsigned kBindings[] = {kFirstProbeBinding, kSecondProbeBinding};
    const std::size_t count = blocks_.size() / 2;
    for (std::size_t slot = 0; slot < 2; ++slot) {
        const int probe = choice.probe[slot];
        const std::size_t block =
            static_cast<std::size_t>(probe + 1) + (choice.dark[slot] ? count : 0); // kNone is -1
        blockBuffer_.bindBlock(kBindings[slot], block * stride_, sizeof(blocks::LodestarProbe));
        if (probe != plan::ProbeChoice::kNone && !choice.dark[slot]) {
            const Cubes& cubes = cubes_[static_cast<std::size_t>(probe)];
            cubes.lit.bind(kUnits[slot]);
            if (cubes.sky) {
                cubes.sky.bind(kSkyUnits[slot]);
            }
        }
    }
    if (irradiance_.texture()) {
        irradiance_.texture().bind(kProbeIrradianceUnit);
    }
}

} // namespace lodestar::scene
