// SPDX-License-Identifier: MIT
//
// A glTF file as OpenSceneGraph's nodes: it has no reader for one. Triangles, factors of materials;
// no textures, skins or morphs.
#pragma once

#include <osg/Group>
#include <osg/Program>

#include <lodestar/lodestar.h>

#include "io/gltf.h"

namespace lodestar::osghost {

/// The default scene of a file, Y up. Each geometry's StateSet has the uniforms `material_diffuse`,
/// `material_f0` (w: Blinn-Phong exponent).
[[nodiscard]] osg::ref_ptr<osg::Group> sceneOf(const io::GltfFile& file);

/// What shades it: the lights of `Lights`, filmic curve and sRGB as `lodestar render` shows them.
[[nodiscard]] osg::ref_ptr<osg::Program> programOf(const LodestarApi& api);

} // namespace lodestar::osghost
