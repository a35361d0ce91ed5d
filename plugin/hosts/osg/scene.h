// SPDX-License-Identifier: MIT
//
// A glTF file as OpenSceneGraph's nodes: it has no reader for one. Triangles, factors of materials;
// no textures, skins or morphs.
#pragma once

#include <osg/Group>

#include "io/gltf.h"

namespace lodestar::osghost {

/// The default scene of a file, Y up. Each geometry's StateSet has the uniforms `material_diffuse`,
/// `material_f0` (w: Blinn-Phong exponent).
[[nodiscard]] osg::ref_ptr<osg::Group> sceneOf(const io::GltfFile& file);

} // namespace lodestar::osghost
