// SPDX-License-Identifier: MIT
//
// Plain materials of a glTF file as a host's uniform data.
#pragma once

#include "core/tally.h"
#include "hosts/lit_context.h"
#include "io/gltf.h"

namespace lodestar::hosts {

/// A material's factors under what a document says of it by number and name, as
/// LodestarApi::material_pack lays them out. @param index into the file's materials, or io::kNone
/// @return false where the library refuses one, as LitContext::refusal says
[[nodiscard]] bool packMaterial(const LitContext& lit, const io::GltfFile& file, int index,
                                float packed[8]);
/// What of a file plain materials and still triangles do not show, counted.
[[nodiscard]] core::Tally leftOut(const io::GltfFile& file);
[[nodiscard]] bool isDoubleSided(const io::GltfFile& file, int index);

} // namespace lodestar::hosts
