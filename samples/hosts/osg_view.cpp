// SPDX-License-Identifier: MIT
//
// lodestar-host-osg-view: a glTF scene in OpenSceneGraph's viewer below a lodestar::Lighting, whose
// day goes on. Without a display it draws a number of frames by EGL.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <glm/gtc/type_ptr.hpp>

#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>

#include "call.h"
#include "hosts/material.h"
#include "hosts/osg/backdrop.h"
#include "hosts/osg/headless.h"
#include "hosts/osg/hour_keys.h"
#include "hosts/osg/lighting.h"
#include "hosts/osg/scene.h"
#include "hosts/osg/snapshot.h"
#include "io/image_file.h"

namespace lodestar::samples {
namespace {

struct ViewCall {
    HostCall host;
    double rate = 0.5;  ///< hours a second
    int threading = -1; ///< of osgViewer::ViewerBase::ThreadingModel; -1: OpenSceneGraph's choice
    int frames = 0;     ///< 0: until the window is closed
    bool backdrop = true;
};

bool hasDisplay() {
    const char* display = std::getenv("DISPLAY");
    return display != nullptr && *display != '\0';
}

bool takeViewWord(ViewCall& call, const std::string& word, const char* value) {
    char rest = 0;
    if (word == "--hours-per-second") {
        return std::sscanf(value, "%lf%c", &call.rate, &rest) == 1 && std::isfinite(call.rate);
    }
    if (word == "--threading") {
        return std::sscanf(value, "%d%c", &call.threading, &rest) == 1 && call.threading >= 0 &&
               call.threading <= 3;
    }
    if (word == "--frames") {
        return std::sscanf(value, "%d%c", &call.frames, &rest) == 1 && call.frames > 0;
    }
    return takeWord(call.host, word, value);
}

std::optional<ViewCall> parse(int argc, char** argv) {
    ViewCall call;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.empty() || word[0] != '-') {
            call.host.scene = word;
        } else if (word == "--no-backdrop") {
            call.backdrop = false;
        } else if (i + 1 == argc || !takeViewWord(call, word, argv[++i])) {
            return {};
        }
    }
    const bool pictured = call.host.output.empty() || call.frames > 0;
    return call.host.scene.empty() || call.host.lighting.empty() || !pictured ? std::nullopt
                                                                              : std::optional(call);
}

int explain(int argc, char** argv) {
    const bool asked = argc == 2 && std::string(argv[1]) == "--help";
    std::fprintf(
        asked ? stdout : stderr,
        "usage: lodestar-host-osg-view SCENE --lighting FILE [--hour H] [--hours-per-second R]\n"
        "           [--size WxH] [--eye X,Y,Z --target X,Y,Z] [--fov DEGREES]\n"
        "           [--threading 0..3] [--no-backdrop] [--frames N [-o OUT.png]]\n"
        "Shows a glTF scene in OpenSceneGraph under a lighting document whose day goes on.\n"
        "The pointer turns, moves and zooms; left and right: a quarter of an hour, with Shift a\n"
        "minute; P: stop and resume the day; Space: the first view; Escape: end.\n"
        "--threading: 0 single, 1 cull and draw, 2 draw, 3 cull a camera and draw a context.\n"
        "With --frames time goes on by a thirtieth of a second a frame; -o is the last one's.\n"
        "Without a display (DISPLAY) it needs --frames, and draws in one thread.\n");
    return asked ? 0 : 2;
}

osg::Vec3d vectorOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// The view that `lodestar render` takes, turned about what lies in front of it.
void placeCamera(osgViewer::Viewer& viewer, const HostCall& call, const scene::View& view,
                 const osg::BoundingSphere& bound) {
    const glm::dmat4 world = glm::inverse(glm::dmat4(view.cameraFromWorld));
    const osg::Vec3d eye = vectorOf(world[3]);
    const osg::Vec3d forward = -vectorOf(world[2]);
    const double distance = std::max((osg::Vec3d(bound.center()) - eye) * forward,
                                     0.1 * static_cast<double>(bound.radius()));
    const osg::ref_ptr<osgGA::TrackballManipulator> trackball = new osgGA::TrackballManipulator;
    trackball->setAutoComputeHomePosition(false);
    trackball->setHomePosition(eye, eye + forward * distance, vectorOf(world[1]));
    viewer.setCameraManipulator(trackball);
    // As the plain host's, but for near and far, which OpenSceneGraph fits to what is seen.
    const double fov = 2.0 * std::atan(1.0 / static_cast<double>(view.clipFromCamera[1][1]));
    viewer.getCamera()->setProjectionMatrixAsPerspective(
        osg::RadiansToDegrees(fov), static_cast<double>(call.width) / call.height, 0.01, 1000.0);
    viewer.getCamera()->setClearColor(osg::Vec4(0, 0, 0, 1));
}

/// A window, or without a display a framebuffer whose picture is read after each frame.
core::Result<void> openOutput(osgViewer::Viewer& viewer, const HostCall& call, osg::Image& image) {
    if (hasDisplay()) {
        viewer.setUpViewInWindow(32, 32, call.width, call.height);
        return {};
    }
    if (!osghost::makeContextCurrent()) {
        return core::Error{
            core::ErrorCode::NoOpenGl, "no compatibility context without a surface", {}, {}};
    }
    viewer.setUpViewerAsEmbeddedInWindow(0, 0, call.width, call.height);
    image.allocateImage(call.width, call.height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    viewer.getCamera()->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    viewer.getCamera()->attach(osg::Camera::COLOR_BUFFER, &image);
    return {};
}

core::Result<void> show(const ViewCall& call, const HostScene& loaded,
                        osghost::Lighting& lighting) {
    osgViewer::Viewer viewer;
    const osg::ref_ptr<osg::Image> framebuffer = new osg::Image;
    if (const auto opened = openOutput(viewer, call.host, *framebuffer); !opened) {
        return opened.error();
    }
    placeCamera(viewer, call.host, loaded.view, lighting.getBound());
    if (!hasDisplay()) {
        viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    } else if (call.threading >= 0) {
        viewer.setThreadingModel(
            static_cast<osgViewer::ViewerBase::ThreadingModel>(call.threading));
    }
    viewer.setSceneData(&lighting);
    viewer.addEventHandler(new osghost::HourKeys(lighting));
    const osg::ref_ptr<osghost::Snapshot> last =
        new osghost::Snapshot(static_cast<unsigned>(call.frames));
    if (hasDisplay()) {
        viewer.getCamera()->setFinalDrawCallback(last);
    }
    viewer.realize();
    if (!viewer.isRealized()) {
        return core::Error{core::ErrorCode::NoOpenGl, "the display opens no window", {}, {}};
    }
    for (int i = 0; !viewer.done() && (call.frames == 0 || i < call.frames); ++i) {
        viewer.frame(call.frames > 0 ? i / 30.0 : USE_REFERENCE_TIME);
    }
    const bool closed = viewer.done();
    if (call.frames > 0 && hasDisplay() && !closed) {
        last->wait(20.0);
    }
    viewer.stopThreading(); // the picture is the draw thread's until then
    if (call.host.output.empty() || closed) {
        return {};
    }
    const osg::Image& image = hasDisplay() ? last->image() : *framebuffer;
    if (image.data() == nullptr) {
        return core::Error{core::ErrorCode::NoOpenGl, "the last frame was not drawn", {}, {}};
    }
    HostCall drawn = call.host;
    drawn.width = image.s(); // a window manager may have another size in mind
    drawn.height = image.t();
    return io::writeImage(drawn.output, pictureOf(drawn, image.data()));
}

core::Result<void> run(const ViewCall& call) {
    if (!hasDisplay() && (call.frames == 0 || call.threading > 0)) {
        return core::Error{core::ErrorCode::Usage,
                           "without a display (DISPLAY) there are --frames and one thread",
                           {},
                           {}};
    }
    const auto loaded = loadScene(call.host);
    if (!loaded) {
        return loaded.error();
    }
    // What the document says of materials, and whether it is one.
    const auto lit = hosts::LitContext::open(call.host.lighting);
    if (!lit) {
        return lit.error();
    }
    warn("lodestar-host-osg-view", call.host, hosts::leftOut(loaded->file));
    const osg::ref_ptr<osg::Group> scene = osghost::sceneOf(loaded->file, *lit);
    if (!scene) {
        return core::inFile(lit->refusal(), call.host.scene);
    }
    const osg::ref_ptr<osghost::Lighting> lighting = new osghost::Lighting;
    lighting->setFile(call.host.lighting);
    lighting->setHour(call.host.hour);
    lighting->setHoursPerSecond(call.rate);
    lighting->addChild(scene);
    if (call.backdrop) {
        lighting->addChild(osghost::backdrop(lit->api()));
    }
    return show(call, *loaded, *lighting);
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    const auto call = lodestar::samples::parse(argc, argv);
    if (!call) {
        return lodestar::samples::explain(argc, argv);
    }
    const auto done = lodestar::samples::run(*call);
    if (!done) {
        std::fprintf(stderr, "lodestar-host-osg-view: %s\n", done.error().message().c_str());
        return static_cast<int>(done.error().code);
    }
    return 0;
}
