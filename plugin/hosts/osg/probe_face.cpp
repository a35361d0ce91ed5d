// SPDX-License-Identifier: MIT
#include "hosts/osg/probe_face.h"

#include <utility>

#include <osg/GLExtensions>

#ifndef GL_RGBA32F_ARB
#define GL_RGBA32F_ARB 0x8814
#endif

namespace lodestar::osghost {
namespace {

/// Samples of a captured texel, as the built-in renderer takes them.
constexpr unsigned kSamples = 4;
constexpr unsigned kForced =
    osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

/// Allocates a face. OpenSceneGraph's own way gives storage to textures that it takes from those
/// that have ended a second time, which OpenGL refuses where storage is immutable.
struct Allocated : osg::Texture2D::SubloadCallback {
    void load(const osg::Texture2D& texture, osg::State&) const override {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F_ARB, texture.getTextureWidth(),
                     texture.getTextureHeight(), 0, GL_RGBA, GL_FLOAT, nullptr);
    }
    void subload(const osg::Texture2D&, osg::State&) const override {}
};

} // namespace

/// OpenSceneGraph asks the loader alone whether a driver has NVIDIA's samples of coverage; GLVND's
/// has a stub for any name.
struct ProbeFace::Begun : osg::Camera::DrawCallback {
    void operator()(osg::RenderInfo& info) const override {
        const unsigned context = info.getContextID();
        if (!osg::isGLExtensionSupported(context, "GL_NV_framebuffer_multisample_coverage")) {
            osg::GLExtensions::Get(context, true)->glRenderbufferStorageMultisampleCoverageNV =
                nullptr;
        }
    }
};

struct ProbeFace::Done : osg::Camera::DrawCallback {
    void operator()(osg::RenderInfo& info) const override {
        auto* face = dynamic_cast<ProbeFace*>(info.getCurrentCamera());
        if (face == nullptr) {
            return;
        }
        osg::State& state = *info.getState();
        state.setActiveTextureUnit(0);
        state.applyTextureAttribute(0, face->texture_.get());
        face->image_->readImageFromCurrentTexture(state.getContextID(), false, GL_FLOAT);
        face->stage_ = Drawn;
    }
};

ProbeFace::ProbeFace(unsigned width, Cull cull)
    : cull_(std::move(cull)), texture_(new osg::Texture2D), image_(new osg::Image) {
    const int side = static_cast<int>(width);
    image_->allocateImage(side, side, 1, GL_RGBA, GL_FLOAT);
    image_->setInternalTextureFormat(GL_RGBA32F_ARB);
    setRenderOrder(PRE_RENDER);
    setRenderTargetImplementation(FRAME_BUFFER_OBJECT);
    setReferenceFrame(ABSOLUTE_RF);
    setViewport(0, 0, side, side);
    setClearColor(osg::Vec4(0, 0, 0, 0));
    setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    setComputeNearFarMode(DO_NOT_COMPUTE_NEAR_FAR);
    setCullingActive(false);
    setCullMask(
        ~osg::Node::NodeMask{0}); // layers are the plan's, whatever the picture's camera sees
    setInheritanceMask(getInheritanceMask() & ~osg::CullSettings::CULL_MASK);
    setDataVariance(DYNAMIC);
    texture_->setTextureSize(side, side);
    texture_->setInternalFormat(GL_RGBA32F_ARB);
    texture_->setSourceFormat(GL_RGBA);
    texture_->setSourceType(GL_FLOAT);
    texture_->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture_->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    texture_->setSubloadCallback(new Allocated);
    attach(COLOR_BUFFER, texture_.get(), 0, 0, false, kSamples, kSamples);
    setInitialDrawCallback(new Begun);
    setFinalDrawCallback(new Done);
}

void ProbeFace::take(LodestarPlan plan, const LodestarProbeJob& job, DrawStates states) {
    plan_ = plan;
    job_ = job;
    states_ = std::move(states);
    updates_ = 0;
    const osg::Matrixd view(job.view); // both lie column after column for column vectors
    setViewMatrix(view);
    setProjectionMatrix(osg::Matrixd(job.projection));
    // Inside nested cameras OpenSceneGraph's own uniform is the main camera's.
    getOrCreateStateSet()->addUniform(
        new osg::Uniform("osg_ViewMatrixInverse", osg::Matrixf(osg::Matrixd::inverse(view))),
        kForced);
    stage_ = Waits;
}

const float* ProbeFace::pixels() const {
    return reinterpret_cast<const float*>(image_->data());
}

bool ProbeFace::beginCull() {
    int expected = Waits;
    return stage_.compare_exchange_strong(expected, Culled);
}

void ProbeFace::traverse(osg::NodeVisitor& visitor) {
    if (osgUtil::CullVisitor* const cull = visitor.asCullVisitor()) {
        cull_(*cull, states_);
    }
}

void ProbeFace::releaseGLObjects(osg::State* state) const {
    osg::Camera::releaseGLObjects(state);
    texture_->releaseGLObjects(state);
}

} // namespace lodestar::osghost
