// SPDX-License-Identifier: MIT
//
// The distant environment on the GPU: the parts that plans have asked for so far.
#pragma once

#include <future>
#include <string>

#include "gl/texture.h"
#include "host/blocks.glsl"
#include "lighting/environment.h"
#include "lighting/error_forecast.h"
#include "scene/renderer.h"

namespace lodestar::scene {

class GpuEnvironment {
public:
    GpuEnvironment() = default;
    GpuEnvironment(std::string source, lighting::Cubemap base);

    [[nodiscard]] bool empty() const { return base_.empty(); }
    /// What the planner is told of it.
    [[nodiscard]] plan::EnvironmentView view() const;
    [[nodiscard]] const lighting::PreparedParts& prepared() const { return prepared_; }
    /// Mean radiance over the sphere, and the greatest.
    [[nodiscard]] const glm::dvec3& mean() const { return mean_; }
    [[nodiscard]] double brightest() const { return brightest_; }
    /// Tells maps apart by their texels, one value in 2^64 aside.
    [[nodiscard]] std::uint64_t content() const { return content_; }

    /// What errors the estimators will make on it, measured on another thread from the first call
    /// on; null until they are. @param wait until they are
    [[nodiscard]] const lighting::ErrorForecast* forecast(bool wait);

    /// Makes and uploads parts. @errors NoOpenGl if the driver has no memory for one
    [[nodiscard]] core::Result<void> prepare(gl::Device& device,
                                             const lighting::PreparedParts& parts);
    /// Uploads parts that were made of its map, by whatever thread. @errors as prepare
    [[nodiscard]] core::Result<void> upload(gl::Device& device,
                                            const lighting::PreparedEnvironment& made,
                                            const lighting::PreparedParts& parts);

    /// Fills the block's part that describes the cubes the settings read.
    void describe(const RenderSettings& settings, blocks::LodestarFrame& block) const;
    /// Binds those cubes to their units.
    void bind(const RenderSettings& settings) const;

    /// Makes and uploads what pictures by many taps read: tent mips, irradiance of 64 texels a
    /// side, and so many texels drawn by their light. @errors as prepare
    [[nodiscard]] core::Result<void> prepareReference(gl::Device& device, int taps);
    /// As describe and bind, of those. @pre prepared
    void describeReference(blocks::LodestarFrame& block) const;
    void bindReference() const;

private:
    [[nodiscard]] const gl::Texture& glossyCube(const RenderSettings& settings) const;
    [[nodiscard]] const gl::Texture* diffuseCube(const RenderSettings& settings) const;

    std::string source_;
    lighting::Cubemap base_;
    glm::dvec3 mean_{0.0};
    double brightest_ = 0.0;
    std::uint64_t content_ = 0;
    std::shared_future<lighting::ErrorForecast> forecast_;
    lighting::PreparedParts prepared_;
    lighting::Sh9Coefficients sh9_{};
    gl::Texture tentMips_, boxMips_, prefilteredMips_, irradiance_;
    gl::Texture fineIrradiance_, drawnTexels_; ///< for references
};

} // namespace lodestar::scene
