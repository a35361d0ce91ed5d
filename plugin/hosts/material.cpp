// SPDX-License-Identifier: MIT
#include "hosts/material.h"

#include <string>

namespace lodestar::hosts {
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
    material.has_dielectric = 1;
    material.ior = from.ior;
    material.specular = from.specular;
    put(from.specularColor, material.specular_color);
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

io::GltfMaterial materialAt(const io::GltfFile& file, int index) {
    return index == io::kNone ? io::GltfMaterial{}
                              : file.materials[static_cast<std::size_t>(index)];
}

} // namespace

bool packMaterial(const LitContext& lit, const io::GltfFile& file, int index, float packed[8]) {
    const io::GltfMaterial from = materialAt(file, index);
    LodestarMaterial material = materialOf(from);
    if (index != io::kNone) {
        for (const std::string& name : {"#" + std::to_string(index), from.name}) {
            if (!name.empty() &&
                lit.api().document_material(lit.get(), lit.document(), name.c_str(), &material) !=
                    LODESTAR_OK) {
                return false;
            }
        }
    }
    return lit.api().material_pack(&material, packed) == LODESTAR_OK;
}

core::Tally leftOut(const io::GltfFile& file) {
    core::Tally tally;
    for (const io::GltfMaterial& material : file.materials) {
        const io::GltfTextureRef exponents =
            material.blinnPhong ? material.blinnPhong->exponentTexture : io::GltfTextureRef{};
        for (const io::GltfTextureRef& texture :
             {material.baseColorTexture, material.metallicRoughnessTexture, material.normalTexture,
              material.occlusionTexture, material.emissiveTexture, material.specularTexture,
              material.specularColorTexture, exponents}) {
            tally.add("texture, left out", texture.texture != io::kNone ? 1 : 0);
        }
        tally.add("material that is masked or blended, drawn opaque",
                  material.alphaMode != io::AlphaMode::Opaque ? 1 : 0);
        tally.add("unlit material, drawn lit", material.unlit ? 1 : 0);
        tally.add("emission, left out", material.emissive != glm::vec3(0.0f) ? 1 : 0);
    }
    for (const io::GltfMesh& mesh : file.meshes) {
        for (const io::GltfPrimitive& primitive : mesh.primitives) {
            tally.add("points or lines, left out",
                      primitive.topology != io::Topology::Triangles ? 1 : 0);
            tally.add("vertex colours, left out", primitive.colors.empty() ? 0 : 1);
            tally.add("morph targets, left out", primitive.targets.empty() ? 0 : 1);
        }
    }
    tally.add("skin, left out", file.skins.size());
    tally.add("punctual light, left out", file.lights.size());
    return tally;
}

bool isDoubleSided(const io::GltfFile& file, int index) {
    return materialAt(file, index).doubleSided;
}

} // namespace lodestar::hosts
