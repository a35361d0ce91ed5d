// SPDX-License-Identifier: MIT
//
// A picture of one frame of a window or a pbuffer.
#pragma once

#include <OpenThreads/Block>
#include <osg/Camera>
#include <osg/Image>

namespace lodestar::osghost {

/// A camera's final draw callback, called by the draw thread. A viewer that stops threading may
/// leave its last frame undrawn: wait first, then stop, then look at the picture.
class Snapshot : public osg::Camera::DrawCallback {
public:
    /// @param frame the FrameStamp's number of the frame to take; a viewer's first is 1
    explicit Snapshot(unsigned frame) : frame_(frame) {}

    void operator()(osg::RenderInfo& info) const override;
    /// @param seconds at most  @return false where the frame has not been drawn by then
    bool wait(double seconds) const;
    /// RGBA of 8 bits, row 0 at the bottom; without data until the frame is drawn.
    [[nodiscard]] const osg::Image& image() const { return *image_; }

private:
    unsigned frame_;
    osg::ref_ptr<osg::Image> image_ = new osg::Image;
    mutable OpenThreads::Block taken_;
};

} // namespace lodestar::osghost
