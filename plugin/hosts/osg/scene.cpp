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

#include "hosts/osg/lights.h"

namespace lodestar::osghost {
namespace {

template <class Vector>
void put(const Vector& from, double into[3]) {
    for (int i = 0; i < 3; ++i) {
        into[i] = from[i];
    }
}

LodestarMaterial materialOf(const io::GltfMaterial& from) {
    LodestarMaterial material{};
    material.struct_size = sizeof material;
    put(from.baseColor, material.base_color);
    material.metallic = from.metallic;
    material.roughness = from.roughness;
    if (from.blinnPhong) {
        // Given at all, even empty, they win: one that is there is named.
        material.given = LODESTAR_MATERIAL_EXPONENT;
        material.exponent = from.blinnPhong->exponent.value_or(0.0f);
        if (from.blinnPhong->diffuse) {
            material.given |= LODESTAR_MATERIAL_DIFFUSE;
            put(*from.blinnPhong->diffuse, material.diffuse);
        }
        if (from.blinnPhong->f0) {
            material.given |= LODESTAR_MATERIAL_F0;
            put(*from.blinnPhong->f0, material.f0);
        }
    }
    return material;
}

/// @param index of the material in its file; io::kNone for that of primitives without one
bool setMaterial(const io::GltfMaterial& from, int index, const Lighting& lighting,
                 osg::StateSet& state) {
    LodestarMaterial material = materialOf(from);
    if (index != io::kNone) {
        for (const std::string& name : {"#" + std::to_string(index), from.name}) {
            if (!name.empty() &&
                lighting.api.document_material(lighting.context, lighting.document, name.c_str(),
                                               &material) != LODESTAR_OK) {
                return false;
            }
        }
    }
    float packed[8];
    if (lighting.api.material_pack(&material, packed) != LODESTAR_OK) {
        return false;
    }
    state.addUniform(new osg::Uniform("material_diffuse",
                                      osg::Vec4(packed[0], packed[1], packed[2], packed[3])));
    state.addUniform(
        new osg::Uniform("material_f0", osg::Vec4(packed[4], packed[5], packed[6], packed[7])));
    if (!from.doubleSided) {
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

osg::ref_ptr<osg::Node> nodeOf(const io::GltfFile& file, int index, const Lighting& lighting) {
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
            const int material = primitive.material;
            if (!setMaterial(material == io::kNone
                                 ? io::GltfMaterial{}
                                 : file.materials[static_cast<std::size_t>(material)],
                             material, lighting, *geometry->getOrCreateStateSet())) {
                return nullptr;
            }
            geode->addDrawable(geometry);
        }
        transform->addChild(geode);
    }
    for (const int child : node.children) {
        const osg::ref_ptr<osg::Node> made = nodeOf(file, child, lighting);
        if (!made) {
            return nullptr;
        }
        transform->addChild(made);
    }
    return transform;
}

std::string textOf(const LodestarApi& api, const char* file) {
    LodestarDialect dialect{};
    dialect.struct_size = sizeof dialect;
    dialect.version = 330;
    dialect.profile = LODESTAR_PROFILE_COMPATIBILITY;
    dialect.without_version_line = 1;
    std::size_t size = 0;
    api.glsl_text(file, &dialect, nullptr, &size);
    std::string text(size, '\0');
    api.glsl_text(file, &dialect, text.data(), &size);
    text.resize(size > 0 ? size - 1 : 0);
    return text;
}

} // namespace

osg::ref_ptr<osg::Group> sceneOf(const io::GltfFile& file, const Lighting& lighting) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    if (file.defaultScene != io::kNone) {
        for (const int index : file.scenes[static_cast<std::size_t>(file.defaultScene)].roots) {
            const osg::ref_ptr<osg::Node> made = nodeOf(file, index, lighting);
            if (!made) {
                return nullptr;
            }
            root->addChild(made);
        }
    }
    return root;
}

osg::ref_ptr<osg::Program> programOf(const LodestarApi& api) {
    const std::string version = "#version 330 compatibility\n";
    const std::string vertex = version + R"(
uniform mat4 osg_ViewMatrixInverse;
out vec3 vPosition;
out vec3 vNormal;
void main() {
    vPosition = vec3(osg_ViewMatrixInverse * (gl_ModelViewMatrix * gl_Vertex));
    vNormal = mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal);
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";
    // The environment's own hooks are not asked for here.
    const std::string fragment = version + textOf(api, "lodestar/environment.glsl") +
                                 textOf(api, "lodestar/rsrm.glsl") +
                                 textOf(api, "lodestar/display.glsl") + R"(
vec4 lodestar_host_cube(int slot, vec3 direction, float level) { return vec4(0.0); }
vec3 lodestar_host_irradiance(int slot, vec3 normal) { return vec3(0.0); }
)" + Lights::shaderText() + R"(
uniform mat4 osg_ViewMatrixInverse;
uniform vec4 material_diffuse;
uniform vec4 material_f0;
in vec3 vPosition;
in vec3 vNormal;
void main() {
    LodestarSurface here;
    here.view = normalize(osg_ViewMatrixInverse[3].xyz - vPosition);
    here.normal = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
    here.diffuse = material_diffuse.rgb;
    here.f0 = material_f0.rgb;
    here.exponent = material_diffuse.w;
    here.occlusion = 1.0;
    vec3 radiance = lodestar_lights(here);
    gl_FragColor = vec4(lodestar_srgbFromLinear(lodestar_filmic(radiance.r)),
                        lodestar_srgbFromLinear(lodestar_filmic(radiance.g)),
                        lodestar_srgbFromLinear(lodestar_filmic(radiance.b)), 1.0);
})";
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return program;
}

} // namespace lodestar::osghost
