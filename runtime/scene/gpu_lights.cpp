// SPDX-License-Identifier: MIT
#include "scene/gpu_lights.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "core/contract.h"
#include "core/half.h"
#include "scene/gpu_scene.h"

namespace lodestar::scene {
namespace {

/// Where the unfiltered gradient is sampled, in every layout.
lighting::RsrmLayout gradientLayout() {
    lighting::RsrmLayout layout = lighting::kRsrm;
    layout.columns = kGradientColumns;
    return layout;
}

gl::ArrayFormat formatOf(lighting::RsrmEncoding encoding) {
    switch (encoding) {
    case lighting::RsrmEncoding::Unorm8:
        return gl::ArrayFormat::Rgba8;
    case lighting::RsrmEncoding::Unorm10:
        return gl::ArrayFormat::Rgb10A2;
    case lighting::RsrmEncoding::Half:
        return gl::ArrayFormat::Rgba16F;
    case lighting::RsrmEncoding::Float:
        break;
    }
    return gl::ArrayFormat::Rgba32F;
}

/// Square roots as half floats: sqrt(1e9) is within their range, and 11 bits of a root leave the
/// radiance 1e-3.
std::vector<std::uint8_t> rootsOf(const std::vector<glm::vec3>& gradient) {
    std::vector<std::uint8_t> bytes(gradient.size() * 8);
    std::size_t at = 0;
    for (const glm::vec3& radiance : gradient) {
        const float values[] = {radiance.r, radiance.g, radiance.b, 1.0f};
        for (const float value : values) {
            const std::uint16_t half = core::halfFromFloat(std::sqrt(value));
            std::memcpy(bytes.data() + at, &half, sizeof half);
            at += sizeof half;
        }
    }
    return bytes;
}

bool shines(const lighting::DayMoment& moment) {
    return moment.visibility > 0.0;
}

} // namespace

GpuLights::GpuLights(std::vector<lighting::DayLight> lights, const lighting::RsrmLayout& layout,
                     std::shared_ptr<lighting::RsrmKernels> kernels)
    : layout_(layout), kernels_(std::move(kernels)) {
    LODESTAR_EXPECT(layout.rows <= LODESTAR_MAX_RSRM_ROWS, "the block holds a scale a row");
    int shadows = 0;
    for (lighting::DayLight& day : lights) {
        if (lights_.size() == LODESTAR_MAX_RSRM_LIGHTS) {
            warnings_.add("light beyond the " + std::to_string(LODESTAR_MAX_RSRM_LIGHTS) +
                          " that a frame holds, left out");
            continue;
        }
        Light light;
        light.keys.resize(day.keys.size());
        if (day.kind == lighting::LightKind::Sun && day.visibility) {
            if (shadows < LODESTAR_MAX_SHADOWS) {
                light.shadow = shadows++;
            } else {
                warnings_.add("sun beyond the " + std::to_string(LODESTAR_MAX_SHADOWS) +
                              " that cast shadows, casts none");
            }
        }
        light.day = std::move(day);
        lights_.push_back(std::move(light));
    }
}

std::string GpuLights::replacement() const {
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const lighting::DayLight& day = lights_[i].day;
        if (day.kind == lighting::LightKind::Sky && !day.add) {
            return day.name.empty() ? "light " + std::to_string(i) : day.name;
        }
    }
    return {};
}

GpuLights::Content GpuLights::contentOf(const Light& light) {
    const lighting::KeyBlend& keys = light.moment.keys;
    return {keys.from, keys.to, keys.t, light.moment.visibility};
}

std::vector<plan::RsrmLightView> GpuLights::describe(double hour) {
    std::vector<plan::RsrmLightView> views;
    const auto columns = static_cast<std::uint64_t>(layout_.columns);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        Light& light = lights_[i];
        light.moment = lighting::momentAt(light.day, hour);
        plan::RsrmLightView view;
        view.subject = light.day.name.empty() ? "light " + std::to_string(i) : light.day.name;
        view.shines = shines(light.moment);
        view.changed = light.uploaded != contentOf(light);
        view.texels = columns * static_cast<std::uint64_t>(layout_.rows) + kGradientColumns;
        view.uploadBytes = lighting::texelBytes(layout_) + std::size_t{8} * kGradientColumns;
        view.shadow = light.shadow;
        views.push_back(std::move(view));
    }
    return views;
}

const GpuLights::Key& GpuLights::key(Light& light, std::size_t index) {
    std::optional<Key>& key = light.keys[index];
    if (!key) {
        const auto kernel = kernels_->get(layout_, light.day.kind);
        key = Key{kernel->bake(lighting::keyRadiance(light.day, index, kernel->zones())),
                  lighting::keyGradient(light.day, index, gradientLayout())};
    }
    return *key;
}

core::Result<void> GpuLights::allocate(gl::Device& device) {
    const int layers = static_cast<int>(lights_.size());
    auto maps = gl::Texture::makeArray(device, layout_.columns, layout_.rows, layers,
                                       formatOf(layout_.encoding), "filtered maps of the lights");
    if (!maps) {
        return maps.error();
    }
    auto gradients = gl::Texture::makeArray(device, kGradientColumns, 1, layers,
                                            gl::ArrayFormat::Rgba16F, "gradients of the lights");
    if (!gradients) {
        return gradients.error();
    }
    maps_ = std::move(*maps);
    gradients_ = std::move(*gradients);
    return {};
}

void GpuLights::upload(std::size_t index) {
    Light& light = lights_[index];
    const Content content = contentOf(light);
    const Key& from = key(light, content.from);
    const Key& to = key(light, content.to);
    // The texels' own gradient is not read: the finer one stands in its place.
    const lighting::RsrmTexels texels =
        lighting::encode(layout_, lighting::blended(from.bake, to.bake, content.t, content.factor),
                         std::vector<glm::vec3>(static_cast<std::size_t>(layout_.columns)));
    light.logScales = texels.logScales;
    maps_.updateLayer(static_cast<int>(index), texels.bytes);
    gradients_.updateLayer(
        static_cast<int>(index),
        rootsOf(lighting::blended(from.gradient, to.gradient, content.t, content.factor)));
    light.uploaded = content;
}

core::Result<void> GpuLights::prepare(gl::Device& device, const plan::EffectPlan& plan) {
    for (const plan::LitLight& lit : plan.rsrmLights) {
        if (!lit.blend) {
            continue;
        }
        if (!maps_) {
            if (auto allocated = allocate(device); !allocated) {
                return allocated;
            }
        }
        upload(lit.light);
    }
    return {};
}

void GpuLights::describe(const plan::EffectPlan& plan, blocks::LodestarRsrmLights& block) const {
    const bool published = layout_.columnMap == lighting::RsrmColumns::UniformHeight;
    block.rsrmLightCount = {static_cast<float>(plan.rsrmLights.size()), published ? 1.0f : 0.0f,
                            0.0f, 0.0f};
    block.rsrmMap = {static_cast<float>(layout_.columns), static_cast<float>(layout_.rows),
                     static_cast<float>(layout_.leastExponent),
                     static_cast<float>(layout_.greatestExponent)};
    for (std::size_t i = 0; i < plan.rsrmLights.size(); ++i) {
        const plan::LitLight& lit = plan.rsrmLights[i];
        const Light& light = lights_[lit.light];
        block.rsrmAxis[i] = glm::vec4(light.moment.axis, static_cast<float>(lit.light));
        block.rsrmShadow[i].x = static_cast<float>(lit.shadow);
        for (std::size_t row = 0; row < light.logScales.size(); ++row) {
            const std::size_t at = lit.light * LODESTAR_MAX_RSRM_ROWS + row;
            block.rsrmLogScales[at / 4][static_cast<int>(at % 4)] = light.logScales[row];
        }
    }
}

void GpuLights::bind() const {
    if (maps_) {
        maps_.bind(kRsrmMapUnit);
        gradients_.bind(kRsrmGradientUnit);
    }
}

} // namespace lodestar::scene
