// SPDX-License-Identifier: MIT
#include "hosts/osg/headless.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <osg/Camera>
#include <osg/Texture2D>
#include <osgViewer/Viewer>

namespace lodestar::osghost {

bool makeContextCurrent() {
    const auto platformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (platformDisplay == nullptr) {
        return false;
    }
    EGLDisplay display =
        platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) ||
        !eglBindAPI(EGL_OPENGL_API)) {
        return false;
    }
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             3,
                             EGL_CONTEXT_MINOR_VERSION,
                             3,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                             EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    return context != EGL_NO_CONTEXT &&
           eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
}

osg::ref_ptr<osg::Image> drawOnce(osg::Group& root, const osg::Matrixd& view,
                                  const osg::Matrixd& projection, int width, int height,
                                  int frames) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    osgViewer::Viewer viewer;
    osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window =
        viewer.setUpViewerAsEmbeddedInWindow(0, 0, width, height);
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    // Everything is drawn by a camera of its own: there is no framebuffer 0.
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setViewport(0, 0, width, height);
    camera->setClearColor(osg::Vec4(0, 0, 0, 0));
    camera->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setViewMatrix(view);
    camera->setProjectionMatrix(projection);
    camera->attach(osg::Camera::COLOR_BUFFER, image);
    // Inside nested cameras OpenSceneGraph's own uniform is the main camera's.
    camera->getOrCreateStateSet()->addUniform(
        new osg::Uniform("osg_ViewMatrixInverse", osg::Matrixf(osg::Matrixd::inverse(view))),
        osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
    camera->addChild(&root);
    osg::ref_ptr<osg::Group> top = new osg::Group;
    top->addChild(camera);
    viewer.setSceneData(top);
    viewer.getCamera()->setClearMask(0);
    viewer.realize();
    for (int frame = 0; frame < frames; ++frame) {
        viewer.frame();
    }
    top->releaseGLObjects(window->getState()); // it may be drawn again, in another context
    return image;
}

} // namespace lodestar::osghost
