// SPDX-License-Identifier: MIT
//
// lodestar-host-osg: a glTF scene drawn by OpenSceneGraph, lit by a lighting document through
// lodestar/lodestar.h, without a display.
#include <glm/gtc/type_ptr.hpp>

#include "call.h"
#include "hosts/material.h"
#include "hosts/osg/headless.h"
#include "hosts/osg/lighting.h"
#include "hosts/osg/probes.h"
#include "hosts/osg/scene.h"

namespace lodestar::samples {
namespace {

osg::Matrixd matrixOf(const glm::mat4& m) {
    return osg::Matrixd(glm::value_ptr(glm::dmat4(m)));
}

core::Result<core::Image> draw(const HostCall& call, const HostScene& loaded) {
    const auto lit = hosts::LitContext::open(call.lighting);
    if (!lit) {
        return lit.error();
    }
    warn("lodestar-host-osg", call, hosts::leftOut(loaded.file));
    if (!osghost::makeContextCurrent()) {
        return core::Error{
            core::ErrorCode::NoOpenGl, "no compatibility context without a surface", {}, {}};
    }
    osg::ref_ptr<osg::Group> root = osghost::sceneOf(loaded.file, *lit);
    if (!root) {
        return core::inFile(lit->refusal(), call.scene);
    }
    osg::ref_ptr<osghost::Lighting> lighting = new osghost::Lighting;
    lighting->setFile(call.lighting);
    lighting->setHour(call.hour);
    lighting->addChild(root);
    // Light probes are asked for, drawn and shown by three frames.
    const int frames = osghost::Probes::wanted(lit->api(), lit->get()) ? 3 : 1;
    const osg::ref_ptr<osg::Image> image =
        osghost::drawOnce(*lighting, matrixOf(loaded.view.cameraFromWorld),
                          matrixOf(loaded.view.clipFromCamera), call.width, call.height, frames);
    if (lighting->getLightState() == nullptr) {
        return core::Error{
            core::ErrorCode::Internal, "the document cannot be shown", call.lighting, {}};
    }
    return pictureOf(call, image->data());
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    return lodestar::samples::runHost("lodestar-host-osg", argc, argv, lodestar::samples::draw);
}
