// SPDX-License-Identifier: MIT
#include "hosts/osg/backdrop.h"

#include <string>

#include <osg/Depth>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Program>

#include "hosts/shading.h"

namespace lodestar::osghost {
namespace {

constexpr const char* kVertex = R"(#version 330 compatibility
uniform mat4 osg_ViewMatrixInverse;
out vec3 vDirection;
void main() {
    gl_Position = vec4(gl_Vertex.xy, 1.0, 1.0);
    mat4 cameraFromClip = inverse(gl_ProjectionMatrix);
    // Two points of a pixel's line: in perspective and where all views are parallel.
    vec4 far = cameraFromClip * vec4(gl_Vertex.xy, 1.0, 1.0);
    vec4 near = cameraFromClip * vec4(gl_Vertex.xy, -1.0, 1.0);
    vDirection = mat3(osg_ViewMatrixInverse) * (far.xyz / far.w - near.xyz / near.w);
})";

constexpr const char* kFragment = R"(
in vec3 vDirection;
void main() {
    vec3 radiance = lodestar_backdrop(normalize(vDirection));
    gl_FragColor = vec4(lodestar_srgbFromLinear(lodestar_filmic(radiance.r)),
                        lodestar_srgbFromLinear(lodestar_filmic(radiance.g)),
                        lodestar_srgbFromLinear(lodestar_filmic(radiance.b)), 1.0);
})";

/// No bounds, so that neither the scene's nor near and far grow.
struct Unbounded : osg::Drawable::ComputeBoundingBoxCallback {
    osg::BoundingBox computeBound(const osg::Drawable&) const override { return {}; }
};

} // namespace

osg::ref_ptr<osg::Node> backdrop(const LodestarApi& api) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, kVertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       "#version 330 compatibility\n" +
                                           hosts::shadingText(api, LODESTAR_PROFILE_COMPATIBILITY) +
                                           kFragment));
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (const float x : {-1.0f, 3.0f}) {
        corners->push_back(osg::Vec3(x, -1.0f, 0.0f));
    }
    corners->push_back(osg::Vec3(-1.0f, 3.0f, 0.0f));
    osg::ref_ptr<osg::Geometry> triangle = new osg::Geometry;
    triangle->setVertexArray(corners);
    triangle->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    triangle->setComputeBoundingBoxCallback(new Unbounded);
    triangle->setCullingActive(false);
    triangle->setUseDisplayList(false);
    triangle->setUseVertexBufferObjects(true);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName("backdrop");
    geode->setCullingActive(false);
    geode->addDrawable(triangle);
    osg::StateSet& state = *geode->getOrCreateStateSet();
    state.setAttributeAndModes(program);
    // After all that is opaque, where the depth is still the farthest.
    state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    state.setRenderBinDetails(9, "RenderBin");
    return geode;
}

} // namespace lodestar::osghost
