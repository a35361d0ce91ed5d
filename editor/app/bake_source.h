// SPDX-License-Identifier: MIT
//
// What `lodestar bake` filters: a light of a document, a painted strip, or a panorama's mean over
// azimuth.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/tally.h"
#include "lighting/zonal.h"

namespace lodestar::app {

/// The words as given; those that the source has no use for are refused.
struct BakeSourceOptions {
    std::string source;
    std::string light; ///< of a document: name or number; empty: its first one
    std::optional<double> hour;
    std::string kind; ///< of a picture's map: "sky" or "sun"; empty: sky
    std::string axis; ///< of a panorama; empty: 0,1,0
};

struct BakeSource {
    std::string what; ///< "document", "strip", "panorama"
    lighting::LightKind kind = lighting::LightKind::Sky;
    lighting::ZonalRadiance radiance; ///< in the zones asked for
    std::optional<double> residual;   ///< of a panorama, lighting::PanoramaZones
    std::vector<double> exponents{};  ///< of the rows that a document has of its own
};

/// The zones that a kind of light is averaged in.
using ZonesOfKind = std::function<lighting::Zones(lighting::LightKind)>;

/// @errors Usage for words, InputRefused for the file
[[nodiscard]] core::Result<BakeSource>
loadBakeSource(const BakeSourceOptions& options, const ZonesOfKind& zonesOf, core::Tally& warnings);

} // namespace lodestar::app
