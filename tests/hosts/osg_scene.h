// SPDX-License-Identifier: MIT
//
// A small scene of OpenSceneGraph's own, and a day for it.
#pragma once

#include <osg/Geode>
#include <osg/MatrixTransform>
#include <osg/Shape>
#include <osg/ShapeDrawable>

#include "hosts/osg/material.h"

namespace lodestar::testing {

/// A sky of two keys and a sun that moves: at each hour of the day, other texels and another axis.
inline constexpr const char* kDay = R"({"lodestar": 1, "lights": [
    {"name": "sky \"painted\"", "kind": "sky", "keys": [
        {"hour": 6, "gradient": {"stops": [{"at": 90, "color": [0.1, 0.25, 0.7]}, {"at": -90, "color": [0.3, 0.2, 0.1]}]}},
        {"hour": 18, "gradient": {"stops": [{"at": 90, "color": [0.9, 0.5, 0.2]}, {"at": -90, "color": [0.05, 0.1, 0.2]}]}}]},
    {"name": "sun", "kind": "sun", "visibility": false, "path": {"latitude": 45, "dayOfYear": 170}, "keys": [
        {"hour": 12, "gradient": {"stops": [{"at": 0, "color": [4, 3.5, 3]}, {"at": 15, "color": [0, 0, 0]}]}}]}]})";

inline osg::ref_ptr<osg::MatrixTransform> ball(const osg::Vec3& at, float radius,
                                               const osghost::Material& material) {
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(), radius)));
    osghost::setMaterial(*geode->getOrCreateStateSet(), material);
    osg::ref_ptr<osg::MatrixTransform> placed =
        new osg::MatrixTransform(osg::Matrix::translate(at));
    placed->addChild(geode);
    return placed;
}

/// Two balls below a group: a red dull one, and a golden one that shines.
inline void addBalls(osg::Group& group) {
    group.addChild(ball({-1.1f, 0, 0}, 1.0f, {.diffuse = {0.7f, 0.2f, 0.1f}}));
    group.addChild(ball({1.1f, 0, 0}, 0.9f,
                        {.diffuse = {0, 0, 0}, .f0 = {1.0f, 0.77f, 0.34f}, .exponent = 150.0f}));
}

inline osg::Matrixd viewOfBalls() {
    return osg::Matrixd::lookAt(osg::Vec3d(0, 1, 6), osg::Vec3d(), osg::Vec3d(0, 1, 0));
}

inline osg::Matrixd projectionOfBalls() {
    return osg::Matrixd::perspective(40.0, 1.5, 0.5, 20.0);
}

} // namespace lodestar::testing
