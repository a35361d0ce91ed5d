// SPDX-License-Identifier: MIT
//
// OpenSceneGraph without a display: a context of EGL's, and one picture by a camera that has its
// own framebuffer.
#pragma once

#include <osg/Group>
#include <osg/Image>
#include <osg/Matrixd>

namespace lodestar::osghost {

/// Makes a compatibility context without a surface current, which Debian's OpenSceneGraph draws
/// with: a new one at each call. It lasts to the end of the program. @return false where there is
/// none
[[nodiscard]] bool makeContextCurrent();

/// Draws a scene once, by the first viewer of a context: RGBA of 8 bits, row 0 at the bottom; what
/// nothing covers is 0. @param frames that are drawn; the last is the picture
[[nodiscard]] osg::ref_ptr<osg::Image> drawOnce(osg::Group& root, const osg::Matrixd& view,
                                                const osg::Matrixd& projection, int width,
                                                int height, int frames = 1);

} // namespace lodestar::osghost
