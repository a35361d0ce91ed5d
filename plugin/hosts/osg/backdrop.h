// SPDX-License-Identifier: MIT
//
// What is seen beyond all surfaces: the sky, the suns and the environment that light a scene.
#pragma once

#include <osg/Node>

#include <lodestar/lodestar.h>

namespace lodestar::osghost {

/// A node that fills what nothing covers with lodestar_backdrop, for below a Lighting, or a
/// StateSet of Lights. It has no bounds: near and far are others' business. Filmic curve and sRGB
/// as `programOf`.
[[nodiscard]] osg::ref_ptr<osg::Node> backdrop(const LodestarApi& api);

} // namespace lodestar::osghost
