// SPDX-License-Identifier: MIT
#include "hosts/osg/hour_keys.h"

namespace lodestar::osghost {

bool HourKeys::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) {
    if (event.getEventType() != osgGA::GUIEventAdapter::KEYDOWN) {
        return false;
    }
    const bool shift = (event.getModKeyMask() & osgGA::GUIEventAdapter::MODKEY_SHIFT) != 0;
    const double step = shift ? 1.0 / 60.0 : 0.25;
    const double rate = node_->getHoursPerSecond();
    switch (event.getKey()) {
    case osgGA::GUIEventAdapter::KEY_Left:
        node_->setHour(node_->getHour() - step);
        return true;
    case osgGA::GUIEventAdapter::KEY_Right:
        node_->setHour(node_->getHour() + step);
        return true;
    case osgGA::GUIEventAdapter::KEY_P:
        node_->setHoursPerSecond(rate == 0.0 ? resumed_ : 0.0);
        resumed_ = rate;
        return true;
    default:
        return false;
    }
}

} // namespace lodestar::osghost
