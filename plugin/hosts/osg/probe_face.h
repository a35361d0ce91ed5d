// SPDX-License-Identifier: MIT
//
// A face of a light probe as a camera of OpenSceneGraph's that draws before the picture.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include <osg/Camera>
#include <osg/Image>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osgUtil/CullVisitor>

#include <lodestar/lodestar_probes.h>

namespace lodestar::osghost {

/// What each draw of a scene is drawn by; null: it has none.
using DrawStates = std::vector<osg::ref_ptr<osg::StateSet>>;

/// Taken by an update, culled once, drawn once; then its pixels are read.
class ProbeFace : public osg::Camera {
public:
    enum Stage { Waits, Culled, Drawn };
    /// Culls what the face shows.
    using Cull = std::function<void(osgUtil::CullVisitor&, const DrawStates&)>;

    /// @param width texels
    ProbeFace(unsigned width, Cull cull);

    /// A job of a plan's, drawn by these states.
    void take(LodestarPlan plan, const LodestarProbeJob& job, DrawStates states);
    [[nodiscard]] LodestarPlan plan() const { return plan_; }
    [[nodiscard]] const LodestarProbeJob& job() const { return job_; }
    [[nodiscard]] bool isDrawn() const { return stage_ == Drawn; }
    /// RGBA, row 0 first. @pre drawn
    [[nodiscard]] const float* pixels() const;
    /// Updates since it was taken, this one too.
    [[nodiscard]] int countUpdate() { return ++updates_; }
    /// @return whether it is this call that is to cull it
    [[nodiscard]] bool beginCull();
    void forgetStates() { states_.clear(); }
    /// Whether no cull or draw thread holds it any more.
    [[nodiscard]] bool isLeft() const { return referenceCount() == 1 && stage_ != Culled; }

    /// In place of children.
    void traverse(osg::NodeVisitor& visitor) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~ProbeFace() override = default;

private:
    struct Begun;
    struct Done;

    Cull cull_;
    LodestarPlan plan_ = 0;
    LodestarProbeJob job_{};
    DrawStates states_;
    int updates_ = 0;
    std::atomic<int> stage_{Waits};
    osg::ref_ptr<osg::Texture2D> texture_;
    osg::ref_ptr<osg::Image> image_;
};

} // namespace lodestar::osghost
