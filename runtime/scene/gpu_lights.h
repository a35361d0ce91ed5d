// SPDX-License-Identifier: MIT
//
// Skies and suns on the GPU: each light's filtered map is a layer of one texture array, its means
// over Lambert's lobe and its unfiltered gradient are layers of two more. Keys are baked once; a
// frame whose hour lies elsewhere between them blends the bakes, which is exact, encodes and
// uploads.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/tally.h"
#include "gl/texture.h"
#include "host/blocks.glsl"
#include "lighting/light_map.h"
#include "plan/effect_plan.h"

namespace lodestar::scene {

class GpuLights {
public:
    GpuLights() = default;
    /// @param lights as `repaired` leaves them; those beyond LODESTAR_MAX_RSRM_LIGHTS are left out
    /// and counted, so are shadows beyond LODESTAR_MAX_SHADOWS
    /// @param kernels that bake the keys, half a second each to build: shared with the lights
    /// before
    GpuLights(std::vector<lighting::DayLight> lights, const lighting::RsrmLayout& layout,
              std::shared_ptr<lighting::RsrmKernels> kernels);
    [[nodiscard]] const std::shared_ptr<lighting::RsrmKernels>& kernels() const { return kernels_; }
    /// Takes over what is the same in the lights before these: bakes of equal keys, the textures of
    /// as many maps, and what of them is uploaded.
    void keep(GpuLights&& before);
    /// How many have a shadow map.
    [[nodiscard]] int shadowCount() const;
    /// Another number for another painting of a light, in the lights that these took over from too.
    [[nodiscard]] std::uint64_t painting(std::size_t light) const {
        return lights_[light].painting;
    }

    [[nodiscard]] bool empty() const { return lights_.empty(); }
    /// Whether the maps have the published columns and rows.
    [[nodiscard]] bool published() const;
    /// How the maps are stored.
    [[nodiscard]] const lighting::RsrmLayout& layout() const { return layout_; }
    /// The name of a sky that stands in the environment's place; empty if none does.
    [[nodiscard]] std::string replacement() const;
    [[nodiscard]] const core::Tally& warnings() const { return warnings_; }

    /// What the planner is told of the lights at an hour. @param hour finite
    [[nodiscard]] std::vector<plan::RsrmLightView> describe(double hour);
    /// Blends, encodes and uploads what the plan says, for the hour last described.
    /// @errors NoOpenGl if the driver has no memory for the maps
    [[nodiscard]] core::Result<void> prepare(gl::Device& device, const plan::EffectPlan& plan);

    /// Fills the block but for its shadows.
    void describe(const plan::EffectPlan& plan, blocks::LodestarRsrmLights& block) const;
    /// The axis of a light at the hour last described, unit.
    [[nodiscard]] glm::dvec3 axis(std::size_t light) const { return lights_[light].moment.axis; }
    /// Irradiance over pi about the axis of a light at the hour last described, were nothing in the
    /// way.
    [[nodiscard]] glm::dvec3 facingIrradiance(std::size_t light);
    /// Whether a light is a sun that hides nothing in a shadow map.
    [[nodiscard]] bool isBareSun(std::size_t light) const {
        return !isSky(light) && lights_[light].shadow < 0;
    }
    /// Whether a light is a sky; what of it a blend depends on.
    [[nodiscard]] bool isSky(std::size_t light) const;
    [[nodiscard]] lighting::LightMap::Content content(std::size_t light) const;
    /// Its unfiltered gradient at the hour last described.
    [[nodiscard]] std::vector<glm::vec3> gradient(std::size_t light) const;
    [[nodiscard]] std::size_t count() const { return lights_.size(); }
    /// The greatest sum over lights of radiance that any of their keys has.
    [[nodiscard]] double brightest() const;
    void bind() const;

    /// Makes and uploads what pictures by many taps read: points drawn by the light of each light
    /// of the plan, for the hour last described. @errors as prepare
    [[nodiscard]] core::Result<void> prepareReference(gl::Device& device,
                                                      const plan::EffectPlan& plan, int taps);
    void bindReference() const;

private:
    /// What drawn points depend on.
    struct DrawnAt {
        lighting::LightMap::Content content;
        glm::dvec3 axis{0.0};
        bool operator==(const DrawnAt&) const = default;
    };
    struct Light {
        lighting::LightMap map;
        int shadow = -1; ///< its layer of the shadow maps
        lighting::DayMoment moment{};
        std::optional<lighting::LightMap::Content> uploaded{};
        float scale = 1.0f;               ///< of the uploaded map
        double spread = 0.0;              ///< how wide what is uploaded is
        std::vector<glm::dvec3> facing{}; ///< facingIrradiance of its keys, made when asked for
        std::uint64_t painting = 0;
        std::optional<DrawnAt> drawn{}; ///< what its drawn points are of
    };

    [[nodiscard]] core::Result<void> allocate(gl::Device& device);
    void upload(std::size_t index);

    lighting::RsrmLayout layout_ = lighting::kRsrm;
    std::vector<Light> lights_;
    core::Tally warnings_;
    std::shared_ptr<lighting::RsrmKernels> kernels_ = std::make_shared<lighting::RsrmKernels>();
    std::uint64_t paintings_ = 0; ///< numbers given so far
    gl::Texture maps_, lamberts_, gradients_;
    gl::Texture drawn_; ///< for references
};

} // namespace lodestar::scene
