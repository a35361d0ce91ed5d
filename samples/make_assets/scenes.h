// SPDX-License-Identifier: MIT
//
// The demo's scenes. Each writes its glTF file, and the textures that it alone uses, into a folder.
#pragma once

#include <filesystem>

#include "core/result.h"

namespace lodestar::samples {

/// A row of seven ewers, Blinn-Phong exponents 1 to 1024 and a mirror.
[[nodiscard]] core::Result<void> writeFigure1(const std::filesystem::path& folder);

/// Spheres: exponents across, reflectances down.
[[nodiscard]] core::Result<void> writeFigure2(const std::filesystem::path& folder);

/// A wooden crate on a slab: figure3.gltf with its normal map, figure3_flat.gltf without.
[[nodiscard]] core::Result<void> writeFigure3(const std::filesystem::path& folder);

/// One ewer of polished metal, for the least mip levels of Ashikhmin and Ghosh.
[[nodiscard]] core::Result<void> writeAshikhmin(const std::filesystem::path& folder);

/// Five spheres of exponents 2 to 2048, to compare estimators.
[[nodiscard]] core::Result<void> writeEstimators(const std::filesystem::path& folder);

/// Five dark spheres of exponents 1 to 256 under two lamps, to compare forms of the lobe.
[[nodiscard]] core::Result<void> writeLamps(const std::filesystem::path& folder);

/// A still life on a terrace; cameras "terrace", "table" and "steps".
[[nodiscard]] core::Result<void> writeTerrace(const std::filesystem::path& folder);

/// A courtyard, a hall with a lift, a store: for light probes. Cameras "courtyard", "hall", "lift"
/// and "Walker", which the animation "walk" moves, and the lift with it. It uses the terrace's
/// textures.
[[nodiscard]] core::Result<void> writeLift(const std::filesystem::path& folder);

} // namespace lodestar::samples
