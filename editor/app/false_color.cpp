// SPDX-License-Identifier: MIT
#include "app/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

namespace lodestar::app {

glm::vec3 falseColor(double share) {
    // CIE lightness rises in equal steps, 3 to 97.
    static const std::array<glm::vec3, 7> kStops{{{0.020f, 0.020f, 0.060f},
                                                  {0.110f, 0.130f, 0.430f},
                                                  {0.430f, 0.130f, 0.560f},
                                                  {0.790f, 0.230f, 0.420f},
                                                  {0.960f, 0.470f, 0.240f},
                                                  {0.990f, 0.760f, 0.350f},
                                                  {0.985f, 0.985f, 0.850f}}};
    const double at = (share > 0.0 ? std::min(share, 1.0) : 0.0) * (kStops.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    return glm::mix(kStops[low], kStops[low + 1],
                    static_cast<float>(at - static_cast<double>(low)));
}

core::Image falseColorPicture(const core::Image& values, double most) {
    core::Image picture(values.width(), values.height(), 4);
    for (int y = 0; y < values.height(); ++y) {
        for (int x = 0; x < values.width(); ++x) {
            const glm::vec3 color = falseColor(static_cast<double>(values.at(x, y)[0]) / most);
            float* pixel = picture.at(x, y);
            pixel[0] = color.r;
            pixel[1] = color.g;
            pixel[2] = color.b;
            pixel[3] = 1.0f;
        }
    }
    return picture;
}

} // namespace lodestar::app
