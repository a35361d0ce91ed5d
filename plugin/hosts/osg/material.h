// SPDX-License-Identifier: MIT
//
// A material as uniforms of a StateSet, which OpenSceneGraph's own formats keep.
#pragma once

#include <optional>

#include <osg/StateSet>
#include <osg/Vec3>

namespace lodestar::osghost {

/// GLSL's LodestarSurface without what a vertex says: reflectances in [0, 1], linear Rec. 709.
struct Material {
    osg::Vec3 diffuse{1.0f, 1.0f, 1.0f};
    osg::Vec3 f0{0.04f, 0.04f, 0.04f};
    float exponent = 0.0f; ///< Blinn-Phong, at least 0; above 1e7 a mirror
};

/// What LodestarApi::material_pack lays out.
[[nodiscard]] Material materialOf(const float packed[8]);

/// Sets `material_diffuse` (w: exponent) and `material_f0`.
void setMaterial(osg::StateSet& state, const Material& material);
/// Nothing where a StateSet lacks either.
[[nodiscard]] std::optional<Material> materialOf(const osg::StateSet& state);

} // namespace lodestar::osghost
