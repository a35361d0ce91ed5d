// SPDX-License-Identifier: MIT
//
// A picture of one frame of a window or a pbuffer.
#pragma once

#include <osg/Camera>
#include <osg/Image>

namespace lodestar::osghost {

/// A camera's final draw callback. The picture is read by the draw thread: stop threading, then
/// look at it.
class Snapshot : public osg::Camera::DrawCallback {
public:
    /// @param frame the FrameStamp's number of the frame to take
    explicit Snapshot(unsigned frame) : frame_(frame) {}

    void operator()(osg::RenderInfo& info) const override;
    /// RGBA of 8 bits, row 0 at the bottom; without data until the frame is drawn.
    [[nodiscard]] const osg::Image& image() const { return *image_; }

private:
    unsigned frame_;
    osg::ref_ptr<osg::Image> image_ = new osg::Image;
};

} // namespace lodestar::osghost
