// SPDX-License-Identifier: MIT
//
// lodestar-host-osg: a glTF scene drawn by OpenSceneGraph, lit by a lighting document through
// lodestar/lodestar.h, without a display.
#include <glm/gtc/type_ptr.hpp>

#include "call.h"
#include "hosts/material.h"
#include "hosts/osg/headless.h"
#include "hosts/osg/lights.h"
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
    root->getOrCreateStateSet()->setAttributeAndModes(osghost::programOf(lit->api()));
    osghost::Lights lights(lit->api(), lit->get(), *root->getStateSet(), 0);
    if (lights.update(call.hour) != LODESTAR_OK) {
        return lit->refusal();
    }
    const osg::ref_ptr<osg::Image> image =
        osghost::drawOnce(*root, matrixOf(loaded.view.cameraFromWorld),
                          matrixOf(loaded.view.clipFromCamera), call.width, call.height);
    return pictureOf(call, image->data());
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    return lodestar::samples::runHost("lodestar-host-osg", argc, argv, lodestar::samples::draw);
}
