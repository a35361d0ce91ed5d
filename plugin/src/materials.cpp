// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "context.h"
#include "lodestar/lobes.glsl"

namespace lodestar::plugin {
namespace {

bool isReflectance(double value) {
    return value >= 0.0 && value <= 1.0; // false for what is no number
}

bool areReflectances(const double values[3]) {
    return std::all_of(values, values + 3, isReflectance);
}

glm::vec3 vec3Of(const double v[3]) {
    return glm::vec3(glm::dvec3(v[0], v[1], v[2]));
}

void put(const glm::dvec3& from, double into[3]) {
    for (int i = 0; i < 3; ++i) {
        into[i] = from[i];
    }
}

/// Whether what is said of the dielectric is in range.
bool isDielectric(const LodestarMaterial& material) {
    const double* color = material.specular_color;
    return material.has_dielectric == 0 ||
           ((material.ior == 0.0 || material.ior >= 1.0) && std::isfinite(material.ior) &&
            isReflectance(material.specular) && std::all_of(color, color + 3, [](double value) {
                return value >= 0.0 && std::isfinite(value);
            }));
}

glm::vec3 dielectricF0(const LodestarMaterial& material) {
    return material.has_dielectric == 0
               ? shader::lodestar_f0FromMetallic(glm::vec3(0.0f), 0.0f)
               : shader::lodestar_f0OfDielectric(static_cast<float>(material.ior),
                                                 vec3Of(material.specular_color),
                                                 static_cast<float>(material.specular));
}

} // namespace

bool packMaterial(const LodestarMaterial& material, float packed[8]) {
    constexpr std::uint32_t kAll =
        LODESTAR_MATERIAL_DIFFUSE | LODESTAR_MATERIAL_F0 | LODESTAR_MATERIAL_EXPONENT;
    const std::uint32_t given = material.given;
    if ((given & ~kAll) != 0 || !areReflectances(material.base_color) ||
        !isReflectance(material.metallic) || !isReflectance(material.roughness) ||
        !areReflectances(material.diffuse) || !areReflectances(material.f0) ||
        !(material.exponent >= 0.0) || !isDielectric(material)) {
        return false;
    }
    const glm::vec3 base = vec3Of(material.base_color);
    const auto metallic = static_cast<float>(material.metallic);
    glm::vec3 diffuse = shader::lodestar_diffuseFromMetallic(base, metallic);
    glm::vec3 f0 = glm::mix(dielectricF0(material), base, metallic);
    float exponent = shader::lodestar_exponentFromRoughness(static_cast<float>(material.roughness));
    if (given != 0) { // as extras.lodestar of a glTF: metallic and roughness say nothing then
        const auto has = [&](std::uint32_t bit) { return (given & bit) != 0; };
        diffuse = has(LODESTAR_MATERIAL_DIFFUSE) ? vec3Of(material.diffuse) : base;
        f0 = has(LODESTAR_MATERIAL_F0) ? vec3Of(material.f0)
                                       : shader::lodestar_f0FromMetallic(base, 0.0f);
        const double most = double{shader::LODESTAR_MAX_EXPONENT};
        exponent = has(LODESTAR_MATERIAL_EXPONENT)
                       ? static_cast<float>(std::min(material.exponent, most))
                       : 0.0f;
    }
    const float values[8] = {diffuse.r, diffuse.g, diffuse.b, exponent, f0.r, f0.g, f0.b, 1.0f};
    std::copy(std::begin(values), std::end(values), packed);
    return true;
}

void standOver(const document::Material& from, LodestarMaterial& material, core::Tally& warnings) {
    float packed[8];
    if ((from.diffuse || from.f0 || from.exponent) && material.given == 0 &&
        packMaterial(material, packed)) {
        // What metallic and roughness make of it stays, but for what the document says.
        put(glm::vec3(packed[0], packed[1], packed[2]), material.diffuse);
        put(glm::vec3(packed[4], packed[5], packed[6]), material.f0);
        material.exponent = static_cast<double>(packed[3]);
        material.given =
            LODESTAR_MATERIAL_DIFFUSE | LODESTAR_MATERIAL_F0 | LODESTAR_MATERIAL_EXPONENT;
    }
    if (from.diffuse) {
        put(*from.diffuse, material.diffuse);
        material.given |= LODESTAR_MATERIAL_DIFFUSE;
    }
    if (from.f0) {
        put(*from.f0, material.f0);
        material.given |= LODESTAR_MATERIAL_F0;
    }
    if (from.exponent) {
        material.exponent = *from.exponent;
        material.given |= LODESTAR_MATERIAL_EXPONENT;
    }
    warnings.add("estimator of one material, left out: the host chooses it for all",
                 from.specular || from.tolerance ? 1 : 0);
}

} // namespace lodestar::plugin
