// SPDX-License-Identifier: MIT
//
// Any ENV of the command line as a cube map.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/image.h"
#include "core/result.h"
#include "core/tally.h"
#include "io/gltf.h"
#include "lighting/cubemap.h"

namespace lodestar::io {

/// A picture of light: linear radiance, 3 channels, repaired. PNG and JPEG are decoded from sRGB.
/// @errors InputRefused
[[nodiscard]] core::Result<core::Image> loadRadiance(const std::filesystem::path& path,
                                                     core::Tally& warnings);

/// How an environment file was understood.
enum class EnvironmentLayout { Analytic, LatLong, Cross, Strip, SixFiles };

struct LoadedEnvironment {
    lighting::Cubemap base; ///< level 0, repaired radiance
    EnvironmentLayout layout = EnvironmentLayout::Analytic;
    core::Tally warnings;
};

/// The face width an environment is resampled to unless one is asked for.
inline constexpr int kDefaultCubeWidth = 256;

/// Loads ENV: an analytic map, a lat-long panorama (width = 2 height), a vertical or horizontal
/// cross (3:4, 4:3), a strip (6:1 or 1:6, GL order; an EXR that declares OpenEXR's cube layout is
/// read by that convention and turned half about +Y, so that it agrees with OpenEXR's lat-long), or
/// six files STEM_{px,nx,py,ny,pz,nz}.EXT, named as STEM_px.EXT or as STEM_.EXT with the `_` left.
/// @errors Usage for a bad analytic text, InputRefused for a bad file
[[nodiscard]] core::Result<LoadedEnvironment> loadEnvironment(const std::string& environment,
                                                              int width = kDefaultCubeWidth);

/// An EXT_lights_image_based of a scene file as a cube map: its first level, sRGB colours over
/// alpha (RGBD) times the intensity, turned by its rotation. @pre environment is an index of the
/// file's, whose images are decoded  @errors InputRefused if the faces are not square and of one
/// size
[[nodiscard]] core::Result<LoadedEnvironment> environmentOf(const GltfFile& file, int environment,
                                                            int width = kDefaultCubeWidth);

} // namespace lodestar::io
