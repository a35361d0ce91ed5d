// SPDX-License-Identifier: MIT
#include "textures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lodestar/display.glsl"
#include "noise.h"

namespace lodestar::samples {
namespace {

/// What a texture says at one place; x, y in [0, 1), y downwards.
struct Texel {
    glm::vec3 color{0.5f}; ///< linear
    float height = 0.0f;   ///< in widths of the image
    float exponent = 16.0f;
    float roughness = 0.5f;
    float metallic = 0.0f;
};

using Pattern = std::function<Texel(float x, float y)>;

float encodeExponent(float s) {
    return std::log2(s + 1.0f) / kExponentScale;
}

/// Normals and crevices from heights that tile.
void shapeFromHeights(const std::vector<float>& heights, int size, Material& material) {
    const auto height = [&](int x, int y) {
        const int wrappedX = (x + size) % size;
        const int wrappedY = (y + size) % size;
        return heights[static_cast<std::size_t>(wrappedY * size + wrappedX)] *
               static_cast<float>(size);
    };
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float dx = 0.5f * (height(x + 1, y) - height(x - 1, y));
            const float dy = 0.5f * (height(x, y + 1) - height(x, y - 1));
            const glm::vec3 n = glm::normalize(glm::vec3(-dx, dy, 1.0f)); // up is towards row 0
            for (int c = 0; c < 3; ++c) {
                material.normal.at(x, y)[c] = 0.5f + 0.5f * n[c];
            }
            float above = 0.0f; // how much the surroundings rise over this place
            for (const int step : {2, 5, 9}) {
                for (const auto& [i, j] : {std::pair{step, 0}, {-step, 0}, {0, step}, {0, -step}}) {
                    const float rise = height(x + i, y + j) - height(x, y);
                    above += std::max(rise, 0.0f) / static_cast<float>(step);
                }
            }
            const float open = 1.0f / (1.0f + 0.16f * above);
            std::fill_n(material.occlusion.at(x, y), 3, open);
        }
    }
}

Material paint(int size, const Pattern& pattern) {
    Material material;
    for (core::Image* image : {&material.color, &material.normal, &material.occlusion,
                               &material.exponent, &material.metallicRoughness}) {
        *image = core::Image(size, size, 3);
    }
    std::vector<float> heights(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Texel texel = pattern((static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                                        (static_cast<float>(y) + 0.5f) / static_cast<float>(size));
            for (int c = 0; c < 3; ++c) {
                material.color.at(x, y)[c] = shader::lodestar_srgbFromLinear(texel.color[c]);
            }
            std::fill_n(material.exponent.at(x, y), 3, encodeExponent(texel.exponent));
            material.metallicRoughness.at(x, y)[1] = texel.roughness;
            material.metallicRoughness.at(x, y)[2] = texel.metallic;
            heights[static_cast<std::size_t>(y * size + x)] = texel.height;
        }
    }
    shapeFromHeights(heights, size, material);
    return material;
}

/// Grain of wood running along x; board tells boards apart.
Texel woodTexel(float along, float across, int board) {
    const float warp = fractalNoise(along * 3.0f, across * 8.0f, 3, 200 + board);
    const float rings = fractalNoise(along * 2.0f + 5.0f * latticeValue(board, 1, 2),
                                     across * 46.0f + warp * 7.0f, 4, 220 + board);
    const float fibre = fractalNoise(along * 14.0f, across * 180.0f, 2, 240 + board);
    Texel texel;
    const float tone = 0.75f + 0.5f * latticeValue(board, 3, 4);
    texel.color =
        glm::mix(glm::vec3(0.26f, 0.125f, 0.05f), glm::vec3(0.56f, 0.34f, 0.165f), rings) * tone;
    texel.color *= 0.8f + 0.35f * fibre;
    texel.height = 0.0016f * rings + 0.0008f * fibre;
    const float worn =
        smoothStep(0.42f, 0.62f, fractalNoise(along * 5.0f, across * 5.0f, 4, 260 + board));
    texel.exponent = std::exp2(glm::mix(8.5f, 3.0f, worn)) * (0.6f + 0.6f * rings);
    texel.color = glm::mix(texel.color, texel.color * 1.25f + 0.03f, worn);
    return texel;
}

/// A board's edge: how far down its rounded rim lies. d: distance to the edge.
float rim(float d, float width, float depth) {
    const float t = std::clamp(1.0f - d / width, 0.0f, 1.0f);
    return -depth * t * t;
}

/// An iron corner plate with its nails; true if it covers the place.
bool cornerPlate(float x, float y, Texel& texel) {
    const float u = std::min(x, 1.0f - x);
    const float v = std::min(y, 1.0f - y);
    const float edge = 0.235f - u - v;
    if (edge < 0.0f) {
        return false;
    }
    const float rust = fractalNoise(x * 9.0f, y * 9.0f, 5, 300);
    const float rusty = smoothStep(0.5f, 0.66f, rust);
    texel.color = glm::mix(glm::vec3(0.17f, 0.17f, 0.18f), glm::vec3(0.22f, 0.085f, 0.03f), rusty);
    texel.height = 0.030f + rim(edge, 0.014f, 0.010f) + 0.002f * rust;
    texel.exponent = glm::mix(900.0f, 10.0f, rusty);
    for (const glm::vec2 at :
         {glm::vec2(0.045f, 0.045f), glm::vec2(0.125f, 0.045f), glm::vec2(0.045f, 0.125f)}) {
        const float d = glm::length(glm::vec2(u, v) - at) / 0.017f;
        if (d < 1.0f) {
            texel.height += 0.012f * std::sqrt(1.0f - d * d);
            texel.color = glm::vec3(0.24f, 0.235f, 0.22f);
            texel.exponent = 1500.0f;
        }
    }
    return true;
}

Texel crateTexel(float x, float y) {
    constexpr float kFrame = 0.13f;
    const float u = std::min(x, 1.0f - x);
    const float v = std::min(y, 1.0f - y);
    Texel texel;
    const float diagonal = (x + y - 1.0f) * 0.70710678f;
    if (v < kFrame) { // the frame's upper and lower boards
        texel = woodTexel(x, y, y < 0.5f ? 10 : 11);
        texel.height += 0.024f + rim(std::min(v, kFrame - v), 0.014f, 0.010f);
    } else if (u < kFrame) {
        texel = woodTexel(y, x, x < 0.5f ? 12 : 13);
        texel.height += 0.022f + rim(std::min({u, kFrame - u, v - kFrame}), 0.014f, 0.010f);
    } else if (std::abs(diagonal) < 0.06f) {
        texel = woodTexel((x - y) * 0.7f + 0.5f, diagonal, 14);
        texel.height += 0.018f + rim(0.06f - std::abs(diagonal), 0.014f, 0.010f);
    } else { // five planks
        const float across = (x - kFrame) / (1.0f - 2.0f * kFrame) * 5.0f;
        const int board = std::min(static_cast<int>(across), 4);
        const float f = across - static_cast<float>(board);
        texel = woodTexel(y, x, board);
        texel.height += rim(std::min(f, 1.0f - f) * 0.148f, 0.012f, 0.016f);
        if (std::min(f, 1.0f - f) < 0.035f) {
            texel.color *= 0.25f;
            texel.exponent = 3.0f;
        }
    }
    Texel plate;
    return cornerPlate(x, y, plate) ? plate : texel;
}

Texel stoneTexel(float x, float y) {
    const float u = x * 2.0f;
    const float v = y * 2.0f;
    const int i = static_cast<int>(u);
    const int j = static_cast<int>(v);
    const float edge = std::min({u - static_cast<float>(i), static_cast<float>(i + 1) - u,
                                 v - static_cast<float>(j), static_cast<float>(j + 1) - v});
    const float vein = fractalNoise(x * 6.0f, y * 6.0f, 6, 400, 6);
    const float fine = fractalNoise(x * 40.0f, y * 40.0f, 3, 410, 40);
    Texel texel;
    const bool dark = ((i + j) & 1) != 0;
    const glm::vec3 tone = dark ? glm::vec3(0.29f, 0.17f, 0.115f) : glm::vec3(0.47f, 0.41f, 0.33f);
    texel.color = tone * (0.65f + 0.5f * vein + 0.2f * fine);
    const float worn = smoothStep(0.04f, 0.22f, edge);
    texel.roughness = 0.62f - 0.34f * worn + 0.25f * (fine - 0.5f) + 0.25f * (vein - 0.5f);
    texel.height = 0.0016f * vein + 0.0006f * fine + 0.5f * rim(edge, 0.03f, 0.012f);
    if (edge < 0.012f) {
        texel.color = glm::vec3(0.20f, 0.18f, 0.155f) * (0.7f + 0.5f * fine);
        texel.roughness = 0.95f;
    }
    texel.roughness = std::clamp(texel.roughness, 0.08f, 1.0f);
    return texel;
}

/// Dents of a round hammer: the nearest of scattered centres, one a cell.
float hammerDent(float x, float y, int cells) {
    const float u = x * static_cast<float>(cells);
    const float v = y * static_cast<float>(cells);
    const int i = static_cast<int>(std::floor(u));
    const int j = static_cast<int>(std::floor(v));
    float nearest = 2.0f;
    for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
            const int a = (i + di + cells) % cells;
            const int b = (j + dj + cells) % cells;
            const float cx = static_cast<float>(i + di) + 0.2f + 0.6f * latticeValue(a, b, 500);
            const float cy = static_cast<float>(j + dj) + 0.2f + 0.6f * latticeValue(a, b, 501);
            nearest = std::min(nearest, (u - cx) * (u - cx) + (v - cy) * (v - cy));
        }
    }
    return std::min(nearest, 1.0f) / static_cast<float>(cells);
}

} // namespace

Material crateSide(int size) {
    return paint(size, crateTexel);
}

Material stoneTiles(int size) {
    return paint(size, stoneTexel);
}

Material tableBoards(int size) {
    return paint(size, [](float x, float y) {
        const float across = y * 4.0f;
        const int board = std::min(static_cast<int>(across), 3);
        const float f = across - static_cast<float>(board);
        Texel texel = woodTexel(x, y, 20 + board);
        texel.color = texel.color * glm::vec3(0.50f, 0.40f, 0.36f);
        texel.roughness = std::clamp(0.52f - 0.045f * std::log2(texel.exponent + 1.0f), 0.1f, 0.6f);
        texel.height = 0.2f * texel.height + rim(std::min(f, 1.0f - f) * 0.25f, 0.006f, 0.004f);
        if (std::min(f, 1.0f - f) < 0.012f) {
            texel.color *= 0.35f;
        }
        return texel;
    });
}

Material hammeredMetal(int size, const glm::vec3& color) {
    return paint(size, [&](float x, float y) {
        Texel texel;
        const float dull = smoothStep(0.48f, 0.70f, fractalNoise(x * 5.0f, y * 5.0f, 5, 520, 5));
        texel.color = color * glm::mix(glm::vec3(1.0f), glm::vec3(0.62f, 0.60f, 0.62f), dull);
        texel.metallic = 1.0f;
        texel.roughness =
            0.16f + 0.34f * dull + 0.08f * fractalNoise(x * 60.0f, y * 60.0f, 2, 530, 60);
        texel.height = 0.16f * hammerDent(x, y, 14);
        return texel;
    });
}

Material paintedCeramic(int size) {
    return paint(size, [](float x, float y) {
        Texel texel;
        const glm::vec3 white{0.72f, 0.69f, 0.62f};
        const glm::vec3 blue{0.025f, 0.075f, 0.30f};
        const glm::vec3 ochre{0.62f, 0.26f, 0.035f};
        texel.color = white * (0.92f + 0.12f * fractalNoise(x * 8.0f, y * 8.0f, 4, 600, 8));
        const float wave = 0.025f * std::sin(x * 6.2831853f * 12.0f);
        const float shade = 0.7f + 0.6f * fractalNoise(x * 24.0f, y * 6.0f, 3, 610, 24);
        if (std::abs(y - 0.30f - wave) < 0.028f || std::abs(y - 0.62f + wave) < 0.028f) {
            texel.color = blue * shade;
        }
        if (std::abs(y - 0.16f) < 0.018f || std::abs(y - 0.75f) < 0.018f) {
            texel.color = ochre * shade;
        }
        const float petal = std::abs(std::sin(x * 6.2831853f * 6.0f));
        const float leaf = std::abs(y - 0.46f) / 0.085f;
        if (leaf < petal * petal) {
            texel.color = (petal > 0.93f ? ochre : blue) * shade;
        }
        texel.roughness = 0.13f + 0.10f * fractalNoise(x * 30.0f, y * 30.0f, 3, 620, 30);
        texel.height = 0.0009f * fractalNoise(x * 10.0f, y * 10.0f, 3, 630, 10);
        return texel;
    });
}

Material stripedCloth(int size) {
    return paint(size, [](float x, float y) {
        Texel texel;
        const float phase = std::abs(x - std::round(x * 4.0f) / 4.0f) * 4.0f;
        const bool wide = phase < 0.20f;
        const bool thin = phase > 0.30f && phase < 0.34f;
        texel.color =
            wide || thin ? glm::vec3(0.30f, 0.022f, 0.026f) : glm::vec3(0.66f, 0.58f, 0.45f);
        const float weave = std::sin(x * 6.2831853f * 96.0f) * std::sin(y * 6.2831853f * 96.0f);
        texel.color *= 0.92f + 0.12f * weave;
        texel.height = 0.0008f * weave;
        texel.roughness = 0.86f;
        return texel;
    });
}

core::Image floorOcclusion(int size, const glm::vec2& centre, const glm::vec2& half,
                           const std::vector<Occluder>& occluders) {
    core::Image image(size, size, 3);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(size) * 2.0f - 1.0f;
            const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(size) * 2.0f - 1.0f;
            const glm::vec3 place{centre.x + u * half.x, 0.0f, centre.y + v * half.y};
            float open = 1.0f;
            for (const Occluder& ball : occluders) {
                const glm::vec3 to = ball.centre - place;
                const float d2 = glm::dot(to, to);
                const float radius = std::min(ball.radius, std::sqrt(d2));
                // The share of a cosine-weighted sky that a ball wholly above the horizon hides.
                const float hidden = std::max(to.y, 0.0f) * radius * radius / (d2 * std::sqrt(d2));
                open *= 1.0f - std::min(hidden, 1.0f);
            }
            std::fill_n(image.at(x, y), 3, 0.06f + 0.94f * open);
        }
    }
    return image;
}

} // namespace lodestar::samples
