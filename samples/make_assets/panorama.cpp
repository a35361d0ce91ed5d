// SPDX-License-Identifier: MIT
#include "panorama.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>

#include "noise.h"

namespace lodestar::samples {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// The direction of a place in a lat-long map; x and y in [0, 1] from the top left.
glm::vec3 directionOf(float x, float y) {
    const float azimuth = (x - 0.5f) * 2.0f * kPi; // from -Z towards +X
    const float polar = y * kPi;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar),
            -std::sin(polar) * std::cos(azimuth)};
}

/// Rows of an image shared out over the machine's cores.
template <class Row>
void forEachRow(int height, const Row& row) {
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int y = next++; y < height; y = next++) {
            row(y);
        }
    };
    std::vector<std::thread> helpers;
    const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1u, 16u);
    for (unsigned i = 1; i < count; ++i) {
        helpers.emplace_back(work);
    }
    work();
    for (std::thread& helper : helpers) {
        helper.join();
    }
}

/// A glowing rectangle facing the centre, for the studio.
struct SoftBox {
    glm::vec3 centre;
    glm::vec3 right; ///< half extent
    glm::vec3 up;    ///< half extent
    glm::vec3 radiance;
};

/// How much of a soft box a ray from the centre sees: 1 inside, falling over its rim.
float softBoxCover(const SoftBox& box, const glm::vec3& direction) {
    const glm::vec3 normal = glm::cross(box.right, box.up);
    const float facing = glm::dot(direction, normal);
    const float t = glm::dot(box.centre, normal) / facing;
    if (!(t > 0.0f) || !std::isfinite(t)) {
        return 0.0f;
    }
    const glm::vec3 offset = direction * t - box.centre;
    const float u = std::abs(glm::dot(offset, box.right)) / glm::dot(box.right, box.right);
    const float v = std::abs(glm::dot(offset, box.up)) / glm::dot(box.up, box.up);
    // Brighter in the middle, as a lamp behind cloth is.
    const float glow = 1.0f - 0.35f * (u * u + v * v) * 0.5f;
    return smoothStep(1.0f, 0.8f, u) * smoothStep(1.0f, 0.8f, v) * glow;
}

constexpr int kGlyphWidth = 7;
constexpr int kGlyphHeight = 7;

/// The six names as pictures of 7x7 dots: sign and axis.
const char* const kFaceNames[6][kGlyphHeight] = {
    {".......", ".#..#.#", "###.#.#", ".#...#.", "....#.#", "....#.#", "......."}, // +X
    {".......", "....#.#", "###.#.#", ".....#.", "....#.#", "....#.#", "......."}, // -X
    {".......", ".#..#.#", "###.#.#", ".#...#.", ".....#.", ".....#.", "......."}, // +Y
    {".......", "....#.#", "###.#.#", ".....#.", ".....#.", ".....#.", "......."}, // -Y
    {".......", ".#..###", "###...#", ".#...#.", "....#..", "....###", "......."}, // +Z
    {".......", "....###", "###...#", ".....#.", "....#..", "....###", "......."}, // -Z
};

/// The face a direction leaves through, and where, x to the right and y down as seen from inside
/// with the head up (+Y; for the poles: up is -Z below and +Z above, as turning the head from -Z
/// gives).
int faceOf(const glm::vec3& d, float& x, float& y) {
    const glm::vec3 a{std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    if (a.x >= a.y && a.x >= a.z) {
        x = d.x > 0.0f ? d.z / a.x : -d.z / a.x;
        y = -d.y / a.x;
        return d.x > 0.0f ? 0 : 1;
    }
    if (a.y >= a.z) {
        x = d.x / a.y;
        y = d.y > 0.0f ? -d.z / a.y : d.z / a.y;
        return d.y > 0.0f ? 2 : 3;
    }
    x = d.z > 0.0f ? -d.x / a.z : d.x / a.z;
    y = -d.y / a.z;
    return d.z > 0.0f ? 4 : 5;
}

} // namespace

core::Image renderPanorama(const Radiance& radiance, int height, int samples) {
    const int width = 2 * height;
    core::Image image(width, height, 3);
    forEachRow(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            glm::vec3 sum{0.0f};
            for (int j = 0; j < samples; ++j) {
                for (int i = 0; i < samples; ++i) {
                    const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
                    const float v = (static_cast<float>(j) + 0.5f) / static_cast<float>(samples);
                    sum += radiance(
                        directionOf((static_cast<float>(x) + u) / static_cast<float>(width),
                                    (static_cast<float>(y) + v) / static_cast<float>(height)));
                }
            }
            sum /= static_cast<float>(samples * samples);
            std::copy_n(&sum.x, 3, image.at(x, y));
        }
    });
    return image;
}

void addSun(core::Image& panorama, const SunDisc& sun) {
    constexpr int kSamples = 24;
    const float cosRadius = std::cos(sun.radius);
    forEachRow(panorama.height(), [&](int y) {
        for (int x = 0; x < panorama.width(); ++x) {
            const auto at = [&](float u, float v) {
                return directionOf(
                    (static_cast<float>(x) + u) / static_cast<float>(panorama.width()),
                    (static_cast<float>(y) + v) / static_cast<float>(panorama.height()));
            };
            // Texels further off than two of their own widths cannot touch the disc.
            const float reach = sun.radius + 2.0f * kPi / static_cast<float>(panorama.height());
            if (glm::dot(at(0.5f, 0.5f), sun.direction) < std::cos(reach)) {
                continue;
            }
            int inside = 0;
            for (int s = 0; s < kSamples * kSamples; ++s) {
                const int row = s / kSamples;
                const float u = (static_cast<float>(s % kSamples) + 0.5f) / kSamples;
                const float v = (static_cast<float>(row) + 0.5f) / kSamples;
                inside += glm::dot(at(u, v), sun.direction) >= cosRadius ? 1 : 0;
            }
            const float share = static_cast<float>(inside) / (kSamples * kSamples);
            for (int c = 0; c < 3; ++c) {
                panorama.at(x, y)[c] += share * sun.radiance[c];
            }
        }
    });
}

glm::vec3 studioRadiance(const glm::vec3& direction) {
    static const SoftBox kBoxes[] = {
        {{-2.2f, 1.9f, 3.2f}, {0.78f, 0.0f, 0.54f}, {0.18f, 0.63f, -0.25f}, {11.0f, 9.6f, 8.0f}},
        {{3.2f, 0.9f, 0.8f}, {0.08f, 0.0f, -0.30f}, {0.0f, 1.9f, 0.0f}, {3.2f, 6.4f, 12.0f}},
        {{0.4f, 3.4f, -1.8f}, {1.5f, 0.0f, 0.0f}, {0.0f, 0.15f, 0.28f}, {7.0f, 7.0f, 7.4f}},
        {{-3.2f, 0.2f, -2.2f}, {0.25f, 0.0f, -0.36f}, {0.0f, 0.8f, 0.0f}, {9.0f, 2.2f, 1.0f}},
        {{1.3f, 0.5f, 3.4f}, {-0.42f, 0.0f, 0.16f}, {0.0f, 0.42f, 0.0f}, {2.4f, 8.0f, 3.4f}},
    };
    // A grey sweep: floor lighter than the walls, so that shapes have an underside.
    const float height = direction.y;
    const float wall = 0.035f + 0.05f * smoothStep(-0.9f, 0.2f, -std::abs(height));
    glm::vec3 radiance = height < -0.12f ? glm::vec3(0.16f, 0.15f, 0.14f) * (0.4f - height)
                                         : glm::vec3(wall, wall, wall * 1.12f);
    const float horizon = smoothStep(-0.16f, -0.12f, height);
    radiance = radiance * (0.7f + 0.3f * horizon);
    for (const SoftBox& box : kBoxes) {
        const float cover = softBoxCover(box, direction);
        radiance = radiance * (1.0f - cover) + box.radiance * cover;
    }
    return radiance;
}

glm::vec3 facesRadiance(const glm::vec3& direction) {
    static const glm::vec3 kColours[6] = {
        {0.90f, 0.12f, 0.08f}, {0.05f, 0.55f, 0.62f}, {0.10f, 0.45f, 0.95f},
        {0.35f, 0.22f, 0.10f}, {0.95f, 0.70f, 0.08f}, {0.16f, 0.60f, 0.14f},
    };
    float x = 0.0f;
    float y = 0.0f;
    const int face = faceOf(direction, x, y);
    const float rim = std::max(std::abs(x), std::abs(y));
    glm::vec3 colour = kColours[face] * (rim > 0.9f ? 0.45f : 1.0f);
    const int column = static_cast<int>(std::floor((x / 0.8f + 1.0f) * 0.5f * kGlyphWidth));
    const int row = static_cast<int>(std::floor((y / 0.8f + 1.0f) * 0.5f * kGlyphHeight));
    if (column >= 0 && column < kGlyphWidth && row >= 0 && row < kGlyphHeight &&
        kFaceNames[face][row][column] == '#') {
        colour = glm::vec3(2.2f);
    }
    return colour;
}

} // namespace lodestar::samples
