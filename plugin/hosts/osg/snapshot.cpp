// SPDX-License-Identifier: MIT
#include "hosts/osg/snapshot.h"

#include <osg/FrameStamp>
#include <osg/RenderInfo>
#include <osg/State>
#include <osg/Viewport>

namespace lodestar::osghost {

void Snapshot::operator()(osg::RenderInfo& info) const {
    const osg::FrameStamp* const stamp = info.getState()->getFrameStamp();
    const osg::Viewport* const viewport = info.getCurrentCamera()->getViewport();
    if (stamp != nullptr && viewport != nullptr && stamp->getFrameNumber() == frame_) {
        image_->readPixels(static_cast<int>(viewport->x()), static_cast<int>(viewport->y()),
                           static_cast<int>(viewport->width()),
                           static_cast<int>(viewport->height()), GL_RGBA, GL_UNSIGNED_BYTE);
        taken_.release();
    }
}

bool Snapshot::wait(double seconds) const {
    return taken_.block(static_cast<unsigned long>(1000.0 * seconds));
}

} // namespace lodestar::osghost
