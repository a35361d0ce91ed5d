// SPDX-License-Identifier: MIT
#include "scene/gpu_lights.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/contract.h"
#include "lighting/drawn_light.h"
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

void GpuLights::keep(GpuLights&& before) {
    paintings_ = before.paintings_;
    const bool fits = layout_ == before.layout_;
    const bool sameTexels =
        layout_.rows == before.layout_.rows && layout_.columns == before.layout_.columns &&
        layout_.encoding == before.layout_.encoding && layout_.fitted == before.layout_.fitted;
    if (sameTexels && lights_.size() == before.lights_.size()) {
        maps_ = std::move(before.maps_);
        lamberts_ = std::move(before.lamberts_);
        gradients_ = std::move(before.gradients_);
    }
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        Light& light = lights_[i];
        const bool painted =
            !fits || i >= before.lights_.size() || !light.map.keep(before.lights_[i].map);
        light.painting = painted ? ++paintings_ : before.lights_[i].painting;
        if (!painted && maps_) {
            light.uploaded = before.lights_[i].uploaded;
            light.scale = before.lights_[i].scale;
            light.spread = before.lights_[i].spread;
        }
        if (!painted) {
            light.facing = std::move(before.lights_[i].facing);
        }
    }
}

int GpuLights::shadowCount() const {
    return static_cast<int>(std::count_if(lights_.begin(), lights_.end(),
                                          [](const Light& light) { return light.shadow >= 0; }));
}

bool GpuLights::published() const {
    return layout_.columnMap == lighting::RsrmColumns::UniformHeight;
}

std::string GpuLights::replacement() const {
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const lighting::DayLight& day = lights_[i].map.day();
        if (lighting::replacesEnvironment(day)) {
            return day.name.empty() ? "light " + std::to_string(i) : day.name;
        }
    }
    return {};
}

std::vector<plan::RsrmLightView> GpuLights::describe(double hour) {
    std::vector<plan::RsrmLightView> views;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        Light& light = lights_[i];
        light.moment = lighting::momentAt(light.map.day(), hour);
        plan::RsrmLightView view;
        view.subject =
            light.map.day().name.empty() ? "light " + std::to_string(i) : light.map.day().name;
        view.shines = shines(light.moment);
        view.changed = light.uploaded != lighting::LightMap::contentOf(light.moment);
        view.texels = light.map.uploadTexels();
        view.uploadBytes = light.map.uploadBytes();
        view.sky = isSky(i);
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
        gl::Texture::makeLineArray(device, lighting::lambertColumns(layout_), layers,
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
    light.spread = blend.spread;
    maps_.updateLayer(static_cast<int>(index), blend.texels.bytes);
    lamberts_.updateLayer(static_cast<int>(index), lighting::LightMap::lambertTexels(blend));
    gradients_.updateLayer(static_cast<int>(index), lighting::LightMap::gradientTexels(blend));
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
    const float line = static_cast<float>(lighting::lambertColumns(layout_));
    block.rsrmRows = {static_cast<float>(lighting::firstOctave(layout_)),
                      static_cast<float>(lighting::rowsPerOctave(layout_)),
                      published() ? 1.0f : (line - 1.0f) / line, published() ? 0.0f : 0.5f / line};
    if (lighting::hasOwnRows(layout_)) {
        const auto octaves = lighting::rowOctaves(layout_);
        static_assert(sizeof octaves == sizeof block.rsrmOctaves);
        std::memcpy(block.rsrmOctaves, octaves.data(), sizeof octaves);
    }
    for (std::size_t i = 0; i < plan.rsrmLights.size(); ++i) {
        const plan::LitLight& lit = plan.rsrmLights[i];
        const Light& light = lights_[lit.light];
        block.rsrmAxis[i] = glm::vec4(light.moment.axis, static_cast<float>(lit.light));
        block.rsrmShadow[i].x = static_cast<float>(lit.shadow);
        block.rsrmScale[i].x = light.scale;
        block.rsrmScale[i].y = static_cast<float>(light.spread);
    }
}

glm::dvec3 GpuLights::facingIrradiance(std::size_t index) {
    Light& light = lights_[index];
    const lighting::DayLight& day = light.map.day();
    for (std::size_t key = light.facing.size(); key < day.keys.size(); ++key) {
        light.facing.push_back(lighting::facingIrradiance(
            lighting::keyRadiance(day, key, lighting::zonesFor(day.kind))));
    }
    const auto content = lighting::LightMap::contentOf(light.moment);
    return content.factor *
           ((1.0 - content.t) * light.facing[content.from] + content.t * light.facing[content.to]);
}

bool GpuLights::isSky(std::size_t light) const {
    return lights_[light].map.day().kind == lighting::LightKind::Sky;
}

lighting::LightMap::Content GpuLights::content(std::size_t light) const {
    return lighting::LightMap::contentOf(lights_[light].moment);
}

std::vector<glm::vec3> GpuLights::gradient(std::size_t light) const {
    const lighting::DayLight& day = lights_[light].map.day();
    const lighting::LightMap::Content now = content(light);
    return lighting::blended(lighting::keyGradient(day, now.from),
                             lighting::keyGradient(day, now.to), now.t, now.factor);
}

double GpuLights::brightest() const {
    double sum = 0.0;
    for (const Light& light : lights_) {
        double most = 0.0;
        for (std::size_t key = 0; key < light.map.day().keys.size(); ++key) {
            for (const glm::vec3& radiance : lighting::keyGradient(light.map.day(), key)) {
                most = std::max({most, static_cast<double>(radiance.r),
                                 static_cast<double>(radiance.g), static_cast<double>(radiance.b)});
            }
        }
        sum += most;
    }
    return sum;
}

core::Result<void> GpuLights::prepareReference(gl::Device& device, const plan::EffectPlan& plan,
                                               int taps) {
    if (plan.rsrmLights.empty()) {
        return {};
    }
    if (drawn_.width() != taps) {
        auto made = gl::Texture::makeArray(device, taps, 2, static_cast<int>(lights_.size()),
                                           gl::ArrayFormat::Rgba32F, "points drawn by the lights");
        if (!made) {
            return made.error();
        }
        drawn_ = std::move(*made);
        for (Light& light : lights_) {
            light.drawn.reset();
        }
    }
    for (const plan::LitLight& lit : plan.rsrmLights) {
        Light& light = lights_[lit.light];
        const DrawnAt wanted{lighting::LightMap::contentOf(light.moment), light.moment.axis};
        if (light.drawn == wanted) {
            continue;
        }
        const lighting::DrawnLight drawn =
            lighting::drawnLight(light.map.day(), light.moment, taps);
        // Of a black light none is drawn: what is read there is 0.
        std::vector<glm::vec4> rows(2 * static_cast<std::size_t>(taps), glm::vec4(0.0f));
        std::fill(rows.begin(), rows.begin() + taps, glm::vec4(light.moment.axis, 1.0f));
        for (std::size_t i = 0; i < drawn.points.size(); ++i) {
            rows[i] = glm::vec4(drawn.points[i].direction, static_cast<float>(drawn.sum));
            rows[static_cast<std::size_t>(taps) + i] =
                glm::vec4(drawn.points[i].radianceOverDensity, 0.0f);
        }
        drawn_.updateLayer(
            static_cast<int>(lit.light),
            {reinterpret_cast<const std::uint8_t*>(rows.data()), rows.size() * sizeof(glm::vec4)});
        light.drawn = wanted;
    }
    return {};
}

void GpuLights::bindReference() const {
    if (drawn_) {
        drawn_.bind(kReferenceLightsUnit);
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
