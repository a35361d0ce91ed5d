// SPDX-License-Identifier: MIT
#include "lighting/gradient_simplify.h"

#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include <glm/vec3.hpp>

#include "core/contract.h"

namespace lodestar::lighting {
namespace {

/// Three stops' triangle of angle and radiance, all channels.
struct Triangles {
    std::vector<double> angles;
    std::vector<glm::dvec3> radiances;

    [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const {
        const glm::dvec3 twice = (angles[b] - angles[a]) * (radiances[c] - radiances[a]) -
                                 (angles[c] - angles[a]) * (radiances[b] - radiances[a]);
        return 0.5 * (std::abs(twice.x) + std::abs(twice.y) + std::abs(twice.z));
    }
};

} // namespace

std::vector<bool> keptStops(std::span<const GradientStop> stops, std::size_t count) {
    LODESTAR_EXPECT(count >= 2, "a gradient keeps its last two stops");
    Triangles triangles;
    for (const GradientStop& stop : stops) {
        triangles.angles.push_back(stop.at);
        triangles.radiances.push_back(radianceOf(stop));
    }
    const std::size_t n = triangles.angles.size();
    std::vector<std::size_t> before(n), after(n);
    std::vector<double> areas(n, 0.0);
    std::vector<bool> kept(n, true);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> least;
    const auto offer = [&](std::size_t i) {
        areas[i] = triangles.area(before[i], i, after[i]);
        least.emplace(areas[i], i);
    };
    for (std::size_t i = 0; i < n; ++i) {
        before[i] = i == 0 ? 0 : i - 1;
        after[i] = i + 1;
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
        offer(i);
    }
    std::size_t left = n;
    while (left > count) {
        const auto [area, i] = least.top();
        least.pop();
        if (!kept[i] || area != areas[i]) {
            continue; // an entry from before a neighbour went
        }
        kept[i] = false;
        --left;
        after[before[i]] = after[i];
        before[after[i]] = before[i];
        for (const std::size_t neighbour : {before[i], after[i]}) {
            if (neighbour > 0 && neighbour + 1 < n) {
                offer(neighbour);
            }
        }
    }
    return kept;
}

} // namespace lodestar::lighting
