// SPDX-License-Identifier: MIT
#include "hosts/osg/scene.h"

#include <string>

#include <osg/CullFace>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "hosts/material.h"
#include "hosts/osg/material.h"
#include "hosts/shading.h"

namespace lodestar::osghost {
namespace {

/// @param index of the material in its file; io::kNone for that of primitives without one
bool dress(const io::GltfFile& file, int index, const hosts::LitContext& lit,
           osg::StateSet& state) {
    float packed[8];
    if (!hosts::packMaterial(lit, file, index, packed)) {
        return false;
    }
    setMaterial(state, materialOf(packed));
    if (!hosts::isDoubleSided(file, index)) {
        state.setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
    }
    return true;
}

osg::ref_ptr<osg::Geometry> geometryOf(const io::GltfPrimitive& primitive) {
    osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::vec3& p = primitive.positions[i];
        const glm::vec3 n = i < primitive.normals.size() ? primitive.normals[i] : glm::vec3(0.0f);
        positions->push_back(osg::Vec3(p.x, p.y, p.z));
        normals->push_back(osg::Vec3(n.x, n.y, n.z));
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(positions);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(new osg::DrawElementsUInt(
        GL_TRIANGLES, static_cast<unsigned>(primitive.indices.size()), primitive.indices.data()));
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    return geometry;
}

osg::Matrixd matrixOf(const io::GltfNode& node) {
    const glm::dmat4 m = node.hasMatrix
                             ? glm::dmat4(node.matrix)
                             : glm::translate(glm::dmat4(1.0), glm::dvec3(node.translation)) *
                                   glm::mat4_cast(glm::dquat(node.rotation)) *
                                   glm::scale(glm::dmat4(1.0), glm::dvec3(node.scale));
    return osg::Matrixd(glm::value_ptr(m)); // both lie column after column for column vectors
}

/// Layers of captures are node masks. What no capture is to see has two that share no bit, and is
/// seen by cameras of a whole mask yet.
osg::ref_ptr<osg::Node> withLayers(osg::Node& node, std::uint32_t layers) {
    if (layers != 0) {
        node.setNodeMask(layers);
        return &node;
    }
    osg::ref_ptr<osg::Group> outer = new osg::Group;
    outer->setNodeMask(1u);
    node.setNodeMask(~1u);
    outer->addChild(&node);
    return outer;
}

osg::ref_ptr<osg::Node> nodeOf(const io::GltfFile& file, int index, const hosts::LitContext& lit) {
    const io::GltfNode& node = file.nodes[static_cast<std::size_t>(index)];
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrixOf(node));
    transform->setName(node.name);
    if (node.mesh != io::kNone) {
        osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        for (const io::GltfPrimitive& primitive :
             file.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
            if (primitive.topology != io::Topology::Triangles) {
                continue;
            }
            osg::ref_ptr<osg::Geometry> geometry = geometryOf(primitive);
            if (!dress(file, primitive.material, lit, *geometry->getOrCreateStateSet())) {
                return nullptr;
            }
            geode->addDrawable(geometry);
        }
        transform->addChild(withLayers(*geode, node.layers));
    }
    for (const int child : node.children) {
        const osg::ref_ptr<osg::Node> made = nodeOf(file, child, lit);
        if (!made) {
            return nullptr;
        }
        transform->addChild(made);
    }
    return transform;
}

constexpr const char* kVersion = "#version 330 compatibility\n";

constexpr const char* kVertex = R"(
uniform mat4 osg_ViewMatrixInverse;
out vec3 vPosition;
out vec3 vNormal;
void main() {
    vPosition = vec3(osg_ViewMatrixInverse * (gl_ModelViewMatrix * gl_Vertex));
    vNormal = mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal);
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";

constexpr const char* kSurface = R"(
uniform mat4 osg_ViewMatrixInverse;
uniform vec4 material_diffuse;
uniform vec4 material_f0;
in vec3 vPosition;
in vec3 vNormal;
vec3 radianceHere() {
    LodestarSurface here;
    here.view = normalize(osg_ViewMatrixInverse[3].xyz - vPosition);
    here.normal = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
    here.diffuse = material_diffuse.rgb;
    here.f0 = material_f0.rgb;
    here.exponent = material_diffuse.w;
    here.occlusion = 1.0;
    vec3 reflection = 2.0 * dot(here.normal, here.view) * here.normal - here.view;
    return lodestar_lightingAt(here, vPosition, dFdx(reflection), dFdy(reflection));
}
)";

constexpr const char* kShown = R"(
void main() {
    vec3 radiance = radianceHere();
    gl_FragColor = vec4(lodestar_srgbFromLinear(lodestar_filmic(radiance.r)),
                        lodestar_srgbFromLinear(lodestar_filmic(radiance.g)),
                        lodestar_srgbFromLinear(lodestar_filmic(radiance.b)), 1.0);
})";

constexpr const char* kCaptured = R"(
void main() {
    gl_FragColor = vec4(radianceHere(), 1.0);
})";

osg::ref_ptr<osg::Program> program(const LodestarApi& api, int probes, const char* end) {
    const std::string fragment =
        std::string(kVersion) + "#define LODESTAR_WITH_PROBES " + std::to_string(probes) + "\n" +
        hosts::shadingText(api, LODESTAR_PROFILE_COMPATIBILITY) + kSurface + end;
    osg::ref_ptr<osg::Program> made = new osg::Program;
    made->addShader(new osg::Shader(osg::Shader::VERTEX, std::string(kVersion) + kVertex));
    made->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return made;
}

} // namespace

osg::ref_ptr<osg::Group> sceneOf(const io::GltfFile& file, const hosts::LitContext& lit) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    if (file.defaultScene != io::kNone) {
        for (const int index : file.scenes[static_cast<std::size_t>(file.defaultScene)].roots) {
            const osg::ref_ptr<osg::Node> made = nodeOf(file, index, lit);
            if (!made) {
                return nullptr;
            }
            root->addChild(made);
        }
    }
    return root;
}

osg::ref_ptr<osg::Program> programOf(const LodestarApi& api) {
    return program(api, 0, kShown);
}

osg::ref_ptr<osg::Program> probeProgramOf(const LodestarApi& api) {
    return program(api, 2, kShown);
}

osg::ref_ptr<osg::Program> faceProgramOf(const LodestarApi& api) {
    return program(api, 2, kCaptured);
}

} // namespace lodestar::osghost
