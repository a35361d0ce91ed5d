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

gl::ArrayFormat formatOf(lighting::RsrmEncoding encoding) {
    switch (encoding) {
    case lighting::RsrmEncoding::Unorm8:
        return gl::ArrayFormat::Rgba8;
    case lighting::RsrmEncoding::SharedExponent:
        return gl::ArrayFormat::Rgb9E5;
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

std::vector<std::uint8_t> floatsOf(const std::vector<glm::vec3>& radiance) {
    std::vector<std::uint8_t> bytes(radiance.size() * sizeof(glm::vec4));
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        const glm::vec4 texel(radiance[i], 1.0f);
        std::memcpy(bytes.data() + i * sizeof texel, &texel, sizeof texel);
    }
    return bytes;
}

/// Texels of a layout's line of means over Lambert's lobe.
int lambertColumns(const lighting::RsrmLayout& layout) {
    return layout.fitted ? lighting::kLambertColumns : layout.columns;
}

bool shines(const lighting::DayMoment& moment) {
    return moment.visibility > 0.0;
}

} // namespace

GpuLights::GpuLights(std::vector<lighting::DayLight> lights, const lighting::RsrmLayout& layout,
                     std::shared_ptr<lighting::RsrmKernels> kernels)
    : layout_(layout), kernels_(std::move(kernels)) {
    int shadows = 0;
    for (lighting::DayLight& day : lights) {
        if (lights_.size() == LODESTAR_MAX_RSRM_LIGHTS) {
            warnings_.add("light beyond the " + std::to_string(LODESTAR_MAX_RSRM_LIGHTS) +
                          " that a frame holds, left out");
            continue;
        }
        int shadow = -1;
        if (day.kind == lighting::LightKind::Sun && day.visibility) {
            if (shadows < LODESTAR_MAX_SHADOWS) {
                shadow = shadows++;
            } else {
                warnings_.add("sun beyond the " + std::to_string(LODESTAR_MAX_SHADOWS) +
                              " that cast shadows, casts none");
            }
        }
        lights_.push_back({lighting::LightMap(std::move(day), layout_, kernels_), shadow});
    }
}

bool GpuLights::published() const {
    return layout_.columnMap == lighting::RsrmColumns::UniformHeight;
}

std::string GpuLights::replacement() const {
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const lighting::DayLight& day = lights_[i].map.day();
        if (day.kind == lighting::LightKind::Sky && !day.add) {
            return day.name.empty() ? "light " + std::to_string(i) : day.name;
        }
    }
    return {};
}

std::vector<plan::RsrmLightView> GpuLights::describe(double hour) {
    std::vector<plan::RsrmLightView> views;
    const auto line = static_cast<std::size_t>(lambertColumns(layout_));
    const std::size_t texels =
        static_cast<std::size_t>(layout_.columns) * static_cast<std::size_t>(layout_.rows);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        Light& light = lights_[i];
        light.moment = lighting::momentAt(light.map.day(), hour);
        plan::RsrmLightView view;
        view.subject =
            light.map.day().name.empty() ? "light " + std::to_string(i) : light.map.day().name;
        view.shines = shines(light.moment);
        view.changed = light.uploaded != lighting::LightMap::contentOf(light.moment);
        view.texels = texels + line + lighting::kGradientColumns;
        view.uploadBytes = lighting::texelBytes(layout_) + sizeof(glm::vec4) * line +
                           std::size_t{8} * lighting::kGradientColumns;
        view.shadow = light.shadow;
        views.push_back(std::move(view));
    }
    return views;
}

core::Result<void> GpuLights::allocate(gl::Device& device) {
    const int layers = static_cast<int>(lights_.size());
    auto maps = gl::Texture::makeArray(device, layout_.columns, layout_.rows, layers,
                                       formatOf(layout_.encoding), "filtered maps of the lights");
    if (!maps) {
        return maps.error();
    }
    auto lamberts =
        gl::Texture::makeLineArray(device, lambertColumns(layout_), layers,
                                   gl::ArrayFormat::Rgba32F, "Lambert's means of the lights");
    if (!lamberts) {
        return lamberts.error();
    }
    auto gradients = gl::Texture::makeArray(device, lighting::kGradientColumns, 1, layers,
                                            gl::ArrayFormat::Rgba16F, "gradients of the lights");
    if (!gradients) {
        return gradients.error();
    }
    maps_ = std::move(*maps);
    lamberts_ = std::move(*lamberts);
    gradients_ = std::move(*gradients);
    return {};
}

void GpuLights::upload(std::size_t index) {
    Light& light = lights_[index];
    const auto content = lighting::LightMap::contentOf(light.moment);
    const lighting::LightMap::Blend blend = light.map.blend(content);
    light.scale = blend.texels.scale;
    maps_.updateLayer(static_cast<int>(index), blend.texels.bytes);
    lamberts_.updateLayer(static_cast<int>(index), floatsOf(blend.texels.lambert));
    gradients_.updateLayer(static_cast<int>(index), rootsOf(blend.gradient));
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
    block.rsrmMap = {static_cast<float>(layout_.columns), static_cast<float>(layout_.rows),
                     static_cast<float>(layout_.leastExponent),
                     static_cast<float>(layout_.greatestExponent)};
    block.rsrmTexel = {1.0f / block.rsrmMap.x, 1.0f / block.rsrmMap.y, 0.0f, 0.0f};
    const float line = static_cast<float>(lambertColumns(layout_));
    block.rsrmRows = {static_cast<float>(lighting::firstOctave(layout_)),
                      static_cast<float>(lighting::rowsPerOctave(layout_)),
                      published() ? 1.0f : (line - 1.0f) / line, published() ? 0.0f : 0.5f / line};
    for (std::size_t i = 0; i < plan.rsrmLights.size(); ++i) {
        const plan::LitLight& lit = plan.rsrmLights[i];
        const Light& light = lights_[lit.light];
        block.rsrmAxis[i] = glm::vec4(light.moment.axis, static_cast<float>(lit.light));
        block.rsrmShadow[i].x = static_cast<float>(lit.shadow);
        block.rsrmScale[i].x = light.scale;
    }
}

void GpuLights::bind() const {
    if (maps_) {
        maps_.bind(kRsrmMapUnit);
        lamberts_.bind(kRsrmLambertUnit);
        gradients_.bind(kRsrmGradientUnit);
    }
}

} // namespace lodestar::scene
