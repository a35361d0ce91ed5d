// SPDX-License-Identifier: MIT
#include "numerics/sg_float.h"

#include "lodestar/lobes.glsl"

namespace lodestar::testing::sg {

using namespace shader;

float lobe(float d, float sharpness) {
    return lodestar_sg(d, sharpness);
}
float between(const glm::vec3& a, const glm::vec3& b, float sharpness) {
    return lodestar_sgBetween(a, b, sharpness);
}
float integral(float sharpness) {
    return lodestar_sgIntegral(sharpness);
}
float vonMisesFisher(float d, float concentration) {
    return lodestar_vonMisesFisher(d, concentration);
}
std::tuple<float, float, glm::vec3> product(const glm::vec3& a, float sharpnessOfA,
                                            const glm::vec3& b, float sharpnessOfB) {
    const LodestarSg made = lodestar_sgProduct(a, sharpnessOfA, b, sharpnessOfB);
    return {made.sharpness, made.amplitude, made.axis};
}
float productIntegral(const glm::vec3& a, float sharpnessOfA, const glm::vec3& b,
                      float sharpnessOfB) {
    return lodestar_sgProductIntegral(a, sharpnessOfA, b, sharpnessOfB);
}
float fresnelWeight(float cosine) {
    return lodestar_sgFresnelWeight(cosine);
}
float direct(const glm::vec3& n, const glm::vec3& v, const glm::vec3& l, float exponent, int lobes,
             int fresnel) {
    return lodestar_directReflectanceBy(n, v, l, vec3(0.0f), vec3(1.0f), exponent, lobes, fresnel)
        .x;
}

} // namespace lodestar::testing::sg
