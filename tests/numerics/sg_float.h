// SPDX-License-Identifier: MIT
//
// The float compilation of lodestar/sg.glsl for tests that hold it against the double one: a
// translation unit sees one of the two.
#pragma once

#include <tuple>

#include <glm/vec3.hpp>

namespace lodestar::testing::sg {

[[nodiscard]] float lobe(float d, float sharpness);
[[nodiscard]] float between(const glm::vec3& a, const glm::vec3& b, float sharpness);
[[nodiscard]] float integral(float sharpness);
[[nodiscard]] float vonMisesFisher(float d, float concentration);
/// Sharpness, amplitude and axis.
[[nodiscard]] std::tuple<float, float, glm::vec3> product(const glm::vec3& a, float sharpnessOfA,
                                                          const glm::vec3& b, float sharpnessOfB);
[[nodiscard]] float productIntegral(const glm::vec3& a, float sharpnessOfA, const glm::vec3& b,
                                    float sharpnessOfB);
[[nodiscard]] float fresnelWeight(float cosine);
/// Direct light of a mirror's reflectance, F0 = 1, k_L = 0. @param lobes, fresnel LODESTAR_LOBES_*,
/// LODESTAR_FRESNEL_*
[[nodiscard]] float direct(const glm::vec3& n, const glm::vec3& v, const glm::vec3& l,
                           float exponent, int lobes, int fresnel);

} // namespace lodestar::testing::sg
