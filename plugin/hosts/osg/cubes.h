// SPDX-License-Identifier: MIT
//
// The library's texels as OpenSceneGraph's textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <osg/Texture2DArray>
#include <osg/TextureCubeMap>

#include <lodestar/lodestar.h>

namespace lodestar::osghost {

/// Texels as floats. @param bytes of floats, of half floats
[[nodiscard]] std::vector<float> floatsOf(const std::vector<unsigned char>& bytes);
[[nodiscard]] std::vector<float> floatsOfHalves(const std::vector<unsigned char>& bytes);

/// A two-call query of a level's texels.
using ReadLevel = std::function<LodestarStatus(std::uint32_t level, void* bytes, std::size_t*)>;

/// A cube with its levels, filtered linearly. Null where a level is refused.
[[nodiscard]] osg::ref_ptr<osg::TextureCubeMap> cubeTexture(const LodestarCube& described,
                                                            const ReadLevel& read);

/// Uploads an array of textures itself: OpenSceneGraph gives storage to textures that it
/// takes from those that have ended a second time, which OpenGL refuses where storage is immutable.
/// Cubes are uploaded so too. @pre RGBA floats, one level
void uploadAlone(osg::Texture2DArray& texture);

} // namespace lodestar::osghost
