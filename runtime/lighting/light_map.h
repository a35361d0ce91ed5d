// SPDX-License-Identifier: MIT
//
// One light's filtered map at any hour: its keys are baked when they are first asked for, and a
// moment blends the bakes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "lighting/day.h"
#include "lighting/rsrm.h"

namespace lodestar::lighting {

/// Texels of a layout's line of means over Lambert's lobe.
[[nodiscard]] int lambertColumns(const RsrmLayout& layout);

class LightMap {
public:
    /// @param day as `repaired` leaves it  @param kernels shared with other lights; may be null
    /// where nothing is blended
    LightMap(DayLight day, const RsrmLayout& layout, std::shared_ptr<RsrmKernels> kernels);

    /// Takes over another map's bakes of keys that are the same here, wherever they stand.
    /// @return whether all keys are the same in the same order, their hours aside
    /// @pre the layouts are equal
    bool keep(const LightMap& before);

    [[nodiscard]] const DayLight& day() const { return day_; }
    [[nodiscard]] const RsrmLayout& layout() const { return layout_; }

    /// What uploading a blend takes: texels, and bytes of them as below.
    [[nodiscard]] std::uint64_t uploadTexels() const;
    [[nodiscard]] std::uint64_t uploadBytes() const;

    /// What a blend depends on: equal contents are equal maps.
    struct Content {
        std::size_t from = 0, to = 0;
        double t = 0.0, factor = 1.0;
        bool operator==(const Content&) const = default;
    };
    [[nodiscard]] static Content contentOf(const DayMoment& moment);

    /// The map's texels and the unfiltered gradient beside it, at kGradientColumns.
    struct Blend {
        RsrmTexels texels;
        std::vector<glm::vec3> gradient;
        double spread = 0.0; ///< of the gradient, by `spread`
    };
    [[nodiscard]] Blend blend(const Content& content);
    /// The line over Lambert's lobe as RGBA floats.
    [[nodiscard]] static std::vector<std::uint8_t> lambertTexels(const Blend& blend);
    /// Square roots of the gradient as RGBA half floats: sqrt(1e9) is within their range, and 11
    /// bits of a root leave the radiance 1e-3.
    [[nodiscard]] static std::vector<std::uint8_t> gradientTexels(const Blend& blend);

private:
    struct Key {
        RsrmBake bake;
        std::vector<glm::vec3> gradient;
    };
    [[nodiscard]] const Key& key(std::size_t index);

    DayLight day_;
    RsrmLayout layout_;
    std::shared_ptr<RsrmKernels> kernels_;
    std::vector<std::optional<Key>> keys_;
};

} // namespace lodestar::lighting
