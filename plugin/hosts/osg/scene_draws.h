// SPDX-License-Identifier: MIT
//
// What a part of a scene draws, and where it is.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <osg/BoundingBox>
#include <osg/Drawable>
#include <osg/Group>
#include <osg/Matrixd>

#include "hosts/osg/material.h"

namespace lodestar::osghost {

/// A drawable at a place.
struct SceneDraw {
    osg::ref_ptr<const osg::Drawable> drawable;
    osg::Matrixd worldFromLocal;
    std::uint64_t id = 0;  ///< the same as long as it is at the same nodes
    osg::BoundingBoxd box; ///< in the world, finite
    Material material;     ///< white where none is set
    /// Bits that the masks of all nodes down to it have in common.
    osg::Node::NodeMask layers = ~osg::Node::NodeMask{0};
};

struct SceneDraws {
    std::vector<SceneDraw> draws;
    std::map<std::string, osg::Matrixd> nodes; ///< world from the first node of each name
};

/// All that is active below a group, but for nested cameras, other lights' nodes and what has no
/// bounds. @param world from the group's frame
[[nodiscard]] SceneDraws collectDraws(osg::Group& group, const osg::Matrixd& world);

} // namespace lodestar::osghost
