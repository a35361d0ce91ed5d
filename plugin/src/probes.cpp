// SPDX-License-Identifier: MIT
#include "probes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "lighting/environment.h"
#include "lighting/mips.h"
#include "lodestar/cube.glsl"
#include "lodestar/sh9.glsl"

namespace lodestar::plugin {
namespace {

constexpr int kDefaultWidth = 128;
/// Wider faces are of no use to a probe.
constexpr int kWidest = 2048;
/// Levels of tents are wider; coarser ones are means over round lobes, too blunt for irradiance.
constexpr int kWidestRound = 16;
constexpr double kGreatest = 1e9;
/// Texels of a face of irradiance: odd, so that normals along the axes lie on texels' centres.
constexpr int kIrradianceWidth = 17;

core::Error refusal(const char* what, const std::string& where) {
    return core::refused(what, where);
}

bool allFinite(const double* values, std::size_t count) {
    return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
}

core::Result<lighting::ProbeVolume> volumeOf(const LodestarProbeVolume& given,
                                             const std::string& at) {
    if (given.shape != LODESTAR_VOLUME_BOX && given.shape != LODESTAR_VOLUME_SPHERE) {
        return refusal("no such shape", at + "/shape");
    }
    if (!allFinite(given.center, 3)) {
        return refusal("a centre is finite", at + "/center");
    }
    lighting::ProbeVolume volume;
    const bool sphere = given.shape == LODESTAR_VOLUME_SPHERE;
    volume.shape = sphere ? lighting::VolumeShape::Sphere : lighting::VolumeShape::Box;
    for (int i = 0; i < 3; ++i) {
        volume.center[i] = given.center[i];
        volume.size[i] = given.size[sphere ? 0 : i];
        if (!(volume.size[i] > 0.0) || !std::isfinite(volume.size[i])) {
            return refusal("a size is above 0 and finite", at + "/size");
        }
    }
    for (std::size_t i = 0; i < 6; ++i) {
        volume.blend[i] = given.blend[i];
        if (!(given.blend[i] >= 0.0) || !std::isfinite(given.blend[i])) {
            return refusal("a blend is at least 0 and finite", at + "/blend");
        }
    }
    return volume;
}

core::Result<lighting::ProbeCapture> captureOf(const LodestarProbeDesc& desc) {
    if (desc.width > static_cast<std::uint32_t>(kWidest)) {
        return refusal("a face is at most 2048 texels wide", "/width");
    }
    if (!(desc.near_plane > 0.0 && desc.far_plane > desc.near_plane &&
          std::isfinite(desc.far_plane))) {
        return refusal("0 < near < far", "/near_plane");
    }
    lighting::ProbeCapture capture;
    capture.resolution = desc.width != 0 ? static_cast<int>(desc.width) : kDefaultWidth;
    capture.nearPlane = desc.near_plane;
    capture.farPlane = desc.far_plane;
    capture.layers = desc.layers != 0 ? desc.layers : 0xffffffffu;
    return capture;
}

core::Result<void> setLight(const LodestarProbeDesc& desc, lighting::Probe& probe) {
    if (desc.update < LODESTAR_UPDATE_ONCE || desc.update > LODESTAR_UPDATE_ON_DEMAND) {
        return refusal("no such update", "/update");
    }
    if (desc.update == LODESTAR_UPDATE_EVERY && (desc.every == 0 || desc.every > 1u << 30)) {
        return refusal("every so many frames, at least 1", "/every");
    }
    for (int i = 0; i < 3; ++i) {
        if (!(desc.tint[i] >= 0.0 && desc.tint[i] <= kGreatest)) {
            return refusal("a tint lies in [0, 1e9]", "/tint");
        }
        probe.tint[i] = desc.tint[i];
    }
    if (!(desc.intensity >= 0.0 && desc.intensity <= kGreatest)) {
        return refusal("an intensity lies in [0, 1e9]", "/intensity");
    }
    constexpr lighting::ProbeUpdate kUpdates[] = {
        lighting::ProbeUpdate::Once, lighting::ProbeUpdate::OnChange, lighting::ProbeUpdate::Every,
        lighting::ProbeUpdate::Always, lighting::ProbeUpdate::OnDemand};
    probe.update = kUpdates[desc.update];
    probe.every = std::max(static_cast<int>(desc.every), 1);
    probe.intensity = desc.intensity;
    probe.priority = desc.priority;
    probe.exterior = desc.interior == 0;
    return {};
}

glm::vec4 repaired(const float* pixel, std::uint64_t& count) {
    glm::vec4 result(0.0f);
    for (int c = 0; c < 4; ++c) {
        const float most = c < 3 ? static_cast<float>(kGreatest) : 1.0f;
        const float value = pixel[c] >= 0.0f ? std::min(pixel[c], most) : 0.0f; // NaN is 0
        count += value == pixel[c] ? 0 : 1;
        result[c] = value;
    }
    return result;
}

/// The coarsest level that is made by tents.
int irradianceLevel(const lighting::Cubemap& chain) {
    int level = 0;
    while (level + 1 < chain.levelCount() && chain.width(level + 1) > kWidestRound) {
        ++level;
    }
    return level;
}

/// Irradiance over pi by nine coefficients, as the built-in renderer's probes have it.
lighting::Cubemap irradianceOf(const lighting::Cubemap& chain) {
    const int level = irradianceLevel(chain);
    lighting::Cubemap source(chain.width(level));
    source.level(0) = chain.level(level);
    const lighting::Sh9Coefficients c = lighting::sh9FromCube(source);
    lighting::Cubemap result(kIrradianceWidth);
    const float step = 2.0f / static_cast<float>(kIrradianceWidth);
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < kIrradianceWidth; ++y) {
            for (int x = 0; x < kIrradianceWidth; ++x) {
                const glm::vec3 n = glm::normalize(shader::lodestar_cubeDirection(
                    face, (static_cast<float>(x) + 0.5f) * step - 1.0f,
                    (static_cast<float>(y) + 0.5f) * step - 1.0f));
                result.texel(face, x, y) = glm::vec4(
                    shader::lodestar_sh9(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], n),
                    1.0f);
            }
        }
    }
    return result;
}

} // namespace

core::Result<PlacedProbe> PlacedProbe::make(const LodestarProbeDesc& desc) {
    PlacedProbe result;
    lighting::Probe& probe = result.probe_;
    probe.name = desc.name != nullptr ? desc.name : "probe";
    auto capture = captureOf(desc);
    if (!capture) {
        return capture.error();
    }
    probe.capture = *capture;
    if (auto good = setLight(desc, probe); !good) {
        return good.error();
    }
    if (!allFinite(desc.position, 3)) {
        return refusal("a position is finite", "/position");
    }
    probe.position = glm::make_vec3(desc.position);
    auto influence = volumeOf(desc.influence, "/influence");
    if (!influence) {
        return influence.error();
    }
    probe.influence = *influence;
    if (desc.proxy.shape != LODESTAR_VOLUME_NONE) {
        auto proxy = volumeOf(desc.proxy, "/proxy");
        if (!proxy) {
            return proxy.error();
        }
        probe.proxy = *proxy;
    }
    const bool given = std::any_of(desc.frame, desc.frame + 16, [](double v) { return v != 0.0; });
    result.frame_ = given ? glm::make_mat4(desc.frame) : glm::dmat4(1.0);
    return result;
}

PlacedProbe::PlacedProbe(lighting::Probe probe, const glm::dmat3& hostFromDocument,
                         core::Tally& warnings)
    : probe_(std::move(probe)) {
    if (probe_.capture.resolution > kWidest) {
        warnings.add("light probe smaller than asked for");
        probe_.capture.resolution = kWidest;
    }
    if (probe_.node.empty()) {
        frame_ = glm::dmat4(hostFromDocument);
    }
}

glm::dvec3 PlacedProbe::position() const {
    return frame_ ? glm::dvec3(*frame_ * glm::dvec4(probe_.position, 1.0)) : glm::dvec3(0.0);
}

std::optional<lighting::PlacedVolume> PlacedProbe::proxy() const {
    return frame_ && probe_.proxy
               ? lighting::place(*probe_.proxy, glm::mat4(glm::translate(*frame_, probe_.position)),
                                 false)
               : std::nullopt;
}

plan::ProbeView PlacedProbe::view() const {
    plan::ProbeView view;
    view.subject = probe_.name;
    const bool nothing = !frame_ || (!probe_.source.empty() && !held_);
    if (!nothing) {
        view.influence =
            lighting::place(probe_.influence, glm::mat4(glm::translate(*frame_, probe_.position)),
                            !probe_.exterior);
    }
    view.position = glm::vec3(position());
    view.capture = probe_.capture;
    view.update = probe_.update;
    view.every = probe_.every;
    view.priority = probe_.priority;
    view.interior = !probe_.exterior;
    view.fromFile = held_ != nullptr;
    return view;
}

void PlacedProbe::hold(lighting::Cubemap base) {
    for (glm::vec4& texel : base.level(0)) {
        texel.a = 1.0f;
    }
    held_ = std::make_shared<const lighting::Cubemap>(std::move(base));
    ProbeState next;
    next.version = state.version;
    next.captured = held_;
    state = std::move(next);
    clearStaged();
}

void PlacedProbe::request() {
    state.history.requested = true;
}

bool PlacedProbe::setFace(LodestarPlan plan, int face, const float* pixels, core::Tally& warnings) {
    const auto index = static_cast<std::size_t>(face);
    if (held_ || state.askedBy[index] != plan) {
        return false;
    }
    const auto width = static_cast<std::size_t>(probe_.capture.resolution);
    std::vector<glm::vec4> texels(width * width);
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] = repaired(pixels + 4 * i, count);
    }
    warnings.add("captured radiance or coverage out of range", count);
    staged_[index] = std::move(texels);
    state.askedBy[index] = 0;
    return true;
}

void PlacedProbe::giveUp(ProbeState& state, LodestarPlan next) {
    for (std::size_t face = 0; face < 6; ++face) {
        if (state.askedBy[face] != 0 && state.askedBy[face] + 3 < next) {
            state.askedBy[face] = 0;
            state.history.drawn[face] = state.history.again[face] = false;
            state.history.stale[face] = true;
        }
    }
}

std::shared_ptr<const lighting::Cubemap> PlacedProbe::published(const ProbeState& from) const {
    auto cube = from.captured ? std::make_shared<lighting::Cubemap>(*from.captured)
                              : std::make_shared<lighting::Cubemap>(probe_.capture.resolution);
    std::vector<glm::vec4>& texels = cube->level(0);
    const std::size_t size = texels.size() / 6;
    for (std::size_t face = 0; face < 6; ++face) {
        if (staged_[face].size() == size) {
            std::copy(staged_[face].begin(), staged_[face].end(),
                      texels.begin() + static_cast<std::ptrdiff_t>(face * size));
        }
    }
    return cube;
}

void PlacedProbe::clearStaged() noexcept {
    for (std::vector<glm::vec4>& face : staged_) {
        std::vector<glm::vec4>().swap(face);
    }
}

void compose(ProbeState& state, const SkyRadiance& sky, int fadeLeft, int lastLevel) {
    const lighting::Cubemap& captured = *state.captured;
    const int width = captured.width();
    lighting::Cubemap base(width);
    const float step = 2.0f / static_cast<float>(width);
    const float share = state.lit ? 1.0f / static_cast<float>(fadeLeft) : 1.0f;
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < width; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::vec4& texel = captured.texel(face, x, y);
                glm::vec3 sum(texel);
                if (texel.a < 1.0f) {
                    sum +=
                        (1.0f - texel.a) * sky(glm::normalize(shader::lodestar_cubeDirection(
                                               face, (static_cast<float>(x) + 0.5f) * step - 1.0f,
                                               (static_cast<float>(y) + 0.5f) * step - 1.0f)));
                }
                const glm::vec4 now(sum, texel.a); // suns shine through what is not covered
                base.texel(face, x, y) =
                    share < 1.0f ? glm::mix(state.lit->texel(face, x, y), now, share) : now;
            }
        }
    }
    auto chain = std::make_shared<const lighting::Cubemap>(lighting::tentMips(base));
    auto texels = std::make_shared<const lighting::CubeTexels>(lighting::cubeTexels(*chain));
    auto irradiance =
        std::make_shared<const lighting::CubeTexels>(lighting::cubeTexels(irradianceOf(*chain)));
    state.lastLevel = std::min(lastLevel, chain->levelCount() - 1);
    state.lit = std::move(chain);
    state.texels[0] = std::move(texels);
    state.texels[1] = std::move(irradiance);
    ++state.version;
}

} // namespace lodestar::plugin
