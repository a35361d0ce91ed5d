// SPDX-License-Identifier: MIT
#include "scene/gpu_environment.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>

#include "lighting/drawn_texels.h"
#include "lighting/lookup.h"
#include "lighting/mips.h"
#include "plan/state_hash.h"
#include "scene/gpu_scene.h"

namespace lodestar::scene {

using lighting::EstimatorKind;

GpuEnvironment::GpuEnvironment(std::string source, lighting::Cubemap base)
    : source_(std::move(source)), base_(std::move(base)) {
    if (!base_.empty()) {
        mean_ = glm::dvec3(lighting::sphereMean(base_, 0));
        plan::StateHash content;
        for (const glm::vec4& texel : base_.level(0)) {
            content.fold(std::bit_cast<std::uint64_t>(glm::vec2(texel.r, texel.g)));
            content.fold(std::uint64_t{std::bit_cast<std::uint32_t>(texel.b)});
            brightest_ =
                std::max(brightest_, static_cast<double>(std::max({texel.r, texel.g, texel.b})));
        }
        content_ = content.value();
    }
}

plan::EnvironmentView GpuEnvironment::view() const {
    return {source_, base_.width(), prepared_ == lighting::PreparedParts{}, !empty(), {}};
}

const lighting::ErrorForecast* GpuEnvironment::forecast(bool wait) {
    if (empty()) {
        return nullptr;
    }
    if (!forecast_.valid()) {
        forecast_ = std::async(std::launch::async, [base = base_] {
            return lighting::ErrorForecast(base, lighting::tentMips(base));
        });
    }
    const bool there =
        wait || forecast_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    return there ? &forecast_.get() : nullptr;
}

core::Result<void> GpuEnvironment::prepare(gl::Device& device,
                                           const lighting::PreparedParts& parts) {
    if (parts == lighting::PreparedParts{}) {
        return {};
    }
    return upload(device, lighting::prepare(base_, parts), parts);
}

core::Result<void> GpuEnvironment::upload(gl::Device& device,
                                          const lighting::PreparedEnvironment& made,
                                          const lighting::PreparedParts& parts) {
    struct Upload {
        bool lighting::PreparedParts::*part;
        const lighting::Cubemap& map;
        gl::Texture& texture;
        const char* label;
    };
    const Upload uploads[] = {
        {&lighting::PreparedParts::tentMips, made.tentMips, tentMips_, "tent mips"},
        {&lighting::PreparedParts::boxMips, made.boxMips, boxMips_, "box mips"},
        {&lighting::PreparedParts::prefilteredMips, made.prefilteredMips, prefilteredMips_,
         "prefiltered mips"},
        {&lighting::PreparedParts::irradiance, made.irradiance, irradiance_, "irradiance"},
    };
    for (const Upload& upload : uploads) {
        if (parts.*upload.part) {
            auto cube = gl::Texture::makeCube(device, upload.map, upload.label);
            if (!cube) {
                return cube.error();
            }
            upload.texture = std::move(*cube);
            prepared_.*upload.part = true;
        }
    }
    if (parts.sh9) {
        sh9_ = made.sh9;
        prepared_.sh9 = true;
    }
    return {};
}

/// The chain that the glossy estimator reads; for the backdrop any chain will do.
const gl::Texture& GpuEnvironment::glossyCube(const RenderSettings& settings) const {
    const lighting::PreparedParts parts = lighting::partsFor(settings.specular);
    const gl::Texture& wanted = parts.tentMips          ? tentMips_
                                : parts.prefilteredMips ? prefilteredMips_
                                                        : boxMips_;
    const std::array<const gl::Texture*, 4> cubes = {&wanted, &tentMips_, &boxMips_,
                                                     &prefilteredMips_};
    const auto* there = std::find_if(cubes.begin(), cubes.end() - 1, [](const gl::Texture* cube) {
        return static_cast<bool>(*cube);
    });
    return **there;
}

const gl::Texture* GpuEnvironment::diffuseCube(const RenderSettings& settings) const {
    switch (settings.diffuse.kind) {
    case EstimatorKind::Sh9:
        return nullptr;
    case EstimatorKind::LowestMip:
    case EstimatorKind::Bias:
    case EstimatorKind::BiasVertex:
        return &boxMips_;
    default:
        return &irradiance_;
    }
}

void GpuEnvironment::describe(const RenderSettings& settings, blocks::LodestarFrame& block) const {
    const auto describe = [](const gl::Texture& texture, float leastLevel) {
        return glm::vec4(static_cast<float>(texture.width()),
                         static_cast<float>(texture.levelCount() - 1), leastLevel, texture.scale());
    };
    block.environmentCube = describe(glossyCube(settings), settings.specular.leastLevel);
    if (const gl::Texture* cube = diffuseCube(settings)) {
        block.irradianceCube = describe(*cube, settings.diffuse.leastLevel);
    }
    for (std::size_t i = 0; i < sh9_.size(); ++i) {
        block.sh9[i] = glm::vec4(sh9_[i], 0.0f);
    }
}

void GpuEnvironment::bind(const RenderSettings& settings) const {
    if (const gl::Texture& cube = glossyCube(settings)) {
        cube.bind(kEnvironmentUnit);
    }
    if (const gl::Texture* cube = diffuseCube(settings); cube != nullptr && *cube) {
        cube->bind(kIrradianceUnit);
    }
}

core::Result<void> GpuEnvironment::prepareReference(gl::Device& device, int taps) {
    // Bilinear lookups err by the square of the texel: a sixteenth of what 16 texels a side do.
    constexpr int kFineIrradianceWidth = 4 * lighting::kIrradianceWidth;
    lighting::PreparedParts parts;
    parts.tentMips = !prepared_.tentMips;
    if (auto made = prepare(device, parts); !made) {
        return made;
    }
    if (!fineIrradiance_) {
        auto cube = gl::Texture::makeCube(
            device, lighting::irradianceCube(base_, kFineIrradianceWidth), "fine irradiance");
        if (!cube) {
            return cube.error();
        }
        fineIrradiance_ = std::move(*cube);
    }
    if (drawnTexels_.width() == taps) {
        return {};
    }
    auto texels = gl::Texture::makeArray(device, taps, 2, 1, gl::ArrayFormat::Rgba32F,
                                         "texels drawn by their light");
    if (!texels) {
        return texels.error();
    }
    drawnTexels_ = std::move(*texels);
    const std::vector<lighting::DrawnTexel> drawn = lighting::drawnTexels(base_, taps);
    // Of a black map none is drawn: along +Z there is 0.
    std::vector<glm::vec4> rows(2 * static_cast<std::size_t>(taps), glm::vec4(0, 0, 1, 1));
    std::fill(rows.begin() + taps, rows.end(), glm::vec4(0.0f));
    const auto sum = static_cast<float>(lighting::lightSum(base_));
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        rows[i] = glm::vec4(drawn[i].direction, sum);
        rows[static_cast<std::size_t>(taps) + i] = glm::vec4(drawn[i].radianceOverDensity, 0.0f);
    }
    drawnTexels_.updateLayer(
        0, {reinterpret_cast<const std::uint8_t*>(rows.data()), rows.size() * sizeof(glm::vec4)});
    return {};
}

void GpuEnvironment::describeReference(blocks::LodestarFrame& block) const {
    block.environmentCube = {static_cast<float>(tentMips_.width()),
                             static_cast<float>(tentMips_.levelCount() - 1), 0.0f,
                             tentMips_.scale()};
    block.irradianceCube = {static_cast<float>(fineIrradiance_.width()), 0.0f, 0.0f,
                            fineIrradiance_.scale()};
}

void GpuEnvironment::bindReference() const {
    tentMips_.bind(kEnvironmentUnit);
    fineIrradiance_.bind(kIrradianceUnit);
    drawnTexels_.bind(kReferenceUnit);
}

} // namespace lodestar::scene
