// SPDX-License-Identifier: MIT
//
// Keys that move through the day.
#pragma once

#include <osgGA/GUIEventHandler>

#include "hosts/osg/lighting.h"

namespace lodestar::osghost {

/// Left and right go a quarter of an hour back and on, with Shift a minute; P stops and resumes the
/// day. For a viewer's addEventHandler.
class HourKeys : public osgGA::GUIEventHandler {
public:
    explicit HourKeys(Lighting& node) : node_(&node) {}

    using osgGA::GUIEventHandler::handle;
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

private:
    osg::ref_ptr<Lighting> node_;
    double resumed_ = 1.0; ///< the rate before it was stopped [h/s]
};

} // namespace lodestar::osghost
