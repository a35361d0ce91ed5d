// SPDX-License-Identifier: MIT
#include "lighting/drawn_texels.h"

#include <glm/geometric.hpp>

#include "core/contract.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {
namespace {

double sumOf(const glm::vec4& texel) {
    return static_cast<double>(texel.r) + static_cast<double>(texel.g) +
           static_cast<double>(texel.b);
}

} // namespace

double lightSum(const Cubemap& base) {
    const std::vector<double> solidAngles = texelSolidAngles(base.width());
    double sum = 0.0;
    for (std::size_t i = 0; i < base.level(0).size(); ++i) {
        sum += sumOf(base.level(0)[i]) * solidAngles[i % solidAngles.size()];
    }
    return sum;
}

std::vector<DrawnTexel> drawnTexels(const Cubemap& base, int count) {
    LODESTAR_EXPECT(count >= 0, "no fewer than 0 texels are drawn");
    const double total = lightSum(base);
    std::vector<DrawnTexel> drawn;
    if (!(total > 0.0)) {
        return drawn;
    }
    const std::vector<double> solidAngles = texelSolidAngles(base.width());
    const auto side = static_cast<std::size_t>(base.width());
    double sum = 0.0;
    for (std::size_t i = 0; i < base.level(0).size(); ++i) {
        const glm::vec4& texel = base.level(0)[i];
        const std::size_t inFace = i % solidAngles.size();
        sum += sumOf(texel) * solidAngles[inFace];
        const auto centre = [&](std::size_t k) {
            return (2.0f * static_cast<float>(k) + 1.0f) / static_cast<float>(side) - 1.0f;
        };
        while (static_cast<int>(drawn.size()) < count &&
               (static_cast<double>(drawn.size()) + 0.5) * total <= sum * count) {
            const glm::vec3 direction = glm::normalize(
                shader::lodestar_cubeDirection(static_cast<int>(i / solidAngles.size()),
                                               centre(inFace % side), centre(inFace / side)));
            drawn.push_back(
                {direction, glm::vec3(texel) * static_cast<float>(total / sumOf(texel))});
        }
    }
    return drawn;
}

} // namespace lodestar::lighting
