// SPDX-License-Identifier: MIT
//
// A glTF file as OpenSceneGraph's nodes: it has no reader for one. Triangles, factors of materials;
// no textures, skins or morphs.
#pragma once

#include <osg/Group>
#include <osg/Program>

#include "hosts/lit_context.h"
#include "io/gltf.h"

namespace lodestar::osghost {

/// The default scene of a file, Y up. Each geometry's StateSet has the uniforms `material_diffuse`
/// (w: Blinn-Phong exponent) and `material_f0`, the document's standing over the file's. Null if
/// the library refuses a material, as LitContext::refusal says.
[[nodiscard]] osg::ref_ptr<osg::Group> sceneOf(const io::GltfFile& file,
                                               const hosts::LitContext& lit);

/// What shades it: hosts::shadingText over the uniforms of `Lights`, filmic curve and sRGB as
/// `lodestar render` shows them.
[[nodiscard]] osg::ref_ptr<osg::Program> programOf(const LodestarApi& api);

/// The same with two light probes, as `Probes` sets them.
[[nodiscard]] osg::ref_ptr<osg::Program> probeProgramOf(const LodestarApi& api);
/// What a light probe captures: linear radiance, coverage 1.
[[nodiscard]] osg::ref_ptr<osg::Program> faceProgramOf(const LodestarApi& api);

} // namespace lodestar::osghost
