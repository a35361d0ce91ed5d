// SPDX-License-Identifier: MIT
#include "lighting/environment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contract.h"
#include "lighting/mips.h"
#include "lighting/prefiltered.h"
#include "lighting/solid_angle.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;
constexpr float kMaxRadiance = 1e9f;

/// From this width on the midpoint rule's solid angles are exact to 5e-5 (MATH: (2/n)^2 r^-3), less
/// than the solid angles of neighbouring texels differ.
constexpr int kMidpointWidth = 64;

/// Six images as level 0, as they are.
Cubemap copied(const std::array<core::Image, 6>& faces) {
    const int n = faces[0].width();
    Cubemap cube(n);
    for (int face = 0; face < kFaces; ++face) {
        const float* source = faces[static_cast<std::size_t>(face)].pixels().data();
        glm::vec4* out = &cube.texel(face, 0, 0);
        for (int i = 0; i < n * n; ++i, source += 3) {
            out[i] = {source[0], source[1], source[2], 1.0f};
        }
    }
    return cube;
}

/// The overlap of fine texel k with a coarse texel, as an interval of [-1, 1].
struct Interval {
    double begin;
    double end;
};

Interval overlap(int k, int fine, int i, int coarse) {
    return {std::max(2.0 * k / fine, 2.0 * i / coarse) - 1.0,
            std::min(2.0 * (k + 1) / fine, 2.0 * (i + 1) / coarse) - 1.0};
}

double solidAngle(const Interval& x, const Interval& y, int fine) {
    if (fine < kMidpointWidth) {
        return rectangleSolidAngle(x.begin, y.begin, x.end, y.end);
    }
    const double u = 0.5 * (x.begin + x.end);
    const double v = 0.5 * (y.begin + y.end);
    const double rSquared = 1.0 + u * u + v * v;
    return (x.end - x.begin) * (y.end - y.begin) / (rSquared * std::sqrt(rSquared));
}

/// Means over the fine texels that each texel overlaps, weighted by the overlaps' solid angles.
Cubemap reduced(const Cubemap& fine, int width) {
    const int n = fine.width();
    Cubemap cube(width);
    for (int j = 0; j < width; ++j) {
        for (int i = 0; i < width; ++i) {
            glm::dvec4 sum[kFaces] = {};
            double weights = 0.0;
            for (int y = j * n / width; y * width < (j + 1) * n; ++y) {
                const Interval rows = overlap(y, n, j, width);
                for (int x = i * n / width; x * width < (i + 1) * n; ++x) {
                    const double omega = solidAngle(overlap(x, n, i, width), rows, n);
                    weights += omega;
                    for (int face = 0; face < kFaces; ++face) {
                        sum[face] += omega * glm::dvec4(fine.texel(face, x, y));
                    }
                }
            }
            for (int face = 0; face < kFaces; ++face) {
                cube.texel(face, i, j) = glm::vec4(sum[face] / weights);
            }
        }
    }
    return cube;
}

/// Means over each texel of the seamless bilinear function through coarser texels, at the 2x2
/// points of Gauss, which are exact where the function is one bilinear piece.
Cubemap magnified(const Cubemap& coarse, int width) {
    constexpr float kGauss = 0.577350269f;
    Cubemap cube(width);
    const auto size = static_cast<float>(width);
    for (int face = 0; face < kFaces; ++face) {
        for (int j = 0; j < width; ++j) {
            for (int i = 0; i < width; ++i) {
                glm::vec4 sum(0.0f);
                for (int s = 0; s < 4; ++s) {
                    const float du = (s & 1) == 0 ? -kGauss : kGauss;
                    const float dv = (s & 2) == 0 ? -kGauss : kGauss;
                    const float u = (static_cast<float>(2 * i + 1) + du) / size - 1.0f;
                    const float v = (static_cast<float>(2 * j + 1) + dv) / size - 1.0f;
                    sum += coarse.sampleLevel(shader::lodestar_cubeDirection(face, u, v), 0);
                }
                cube.texel(face, i, j) = sum * 0.25f;
            }
        }
    }
    return cube;
}

} // namespace

void repairRadiance(core::Image& image, core::Tally& warnings) {
    std::uint64_t notANumber = 0;
    std::uint64_t negative = 0;
    std::uint64_t tooLarge = 0;
    for (float& value : image.pixels()) {
        if (value >= 0.0f && value <= kMaxRadiance) {
            continue;
        }
        notANumber += std::isnan(value) ? 1U : 0U;
        negative += value < 0.0f ? 1U : 0U;
        tooLarge += value > kMaxRadiance ? 1U : 0U;
        value = value > kMaxRadiance ? kMaxRadiance : 0.0f;
    }
    warnings.add("radiance not a number, set to 0", notANumber);
    warnings.add("radiance negative, set to 0", negative);
    warnings.add("radiance above 1e9 or infinite, set to 1e9", tooLarge);
}

Cubemap cubeFromFaces(const std::array<core::Image, 6>& faces, int width) {
    const int n = faces[0].width();
    for (const core::Image& face : faces) {
        LODESTAR_EXPECT(face.width() == n && face.height() == n && n >= 1 && face.channels() == 3,
                        "six faces are square, of one size and have three channels");
    }
    LODESTAR_EXPECT(width >= 1 && width <= 4096, "a cube made from faces has a width in [1, 4096]");
    Cubemap cube = copied(faces);
    if (n == width) {
        return cube;
    }
    return n > width ? reduced(cube, width) : magnified(cube, width);
}

/// Lookups a side of a texel when a cube is turned.
constexpr int kLookups = 4;

Cubemap turned(const Cubemap& cube, const glm::quat& worldFromEnvironment) {
    const glm::quat environmentFromWorld = glm::conjugate(worldFromEnvironment);
    const int width = cube.width();
    Cubemap result(width);
    const auto place = [&](int texel, int part) {
        return (static_cast<float>(texel) + (static_cast<float>(part) + 0.5f) / kLookups) /
                   static_cast<float>(width) * 2.0f -
               1.0f;
    };
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < width; ++y) {
            for (int x = 0; x < width; ++x) {
                glm::vec4 sum(0.0f);
                for (int k = 0; k < kLookups * kLookups; ++k) {
                    const glm::vec3 world = shader::lodestar_cubeDirection(
                        face, place(x, k % kLookups), place(y, k / kLookups));
                    sum += cube.sampleLevel(environmentFromWorld * world, 0);
                }
                result.texel(face, x, y) = sum / static_cast<float>(kLookups * kLookups);
            }
        }
    }
    return result;
}

glm::quat aboutUp(double angle) {
    return glm::angleAxis(static_cast<float>(angle), glm::vec3(0.0f, 1.0f, 0.0f));
}

Cubemap placed(Cubemap cube, const glm::quat& worldFromEnvironment, double ev) {
    if (worldFromEnvironment != glm::quat(1.0f, 0.0f, 0.0f, 0.0f)) {
        cube = turned(cube, worldFromEnvironment);
    }
    if (ev != 0.0) {
        const auto factor = static_cast<float>(std::exp2(ev));
        for (glm::vec4& texel : cube.level(0)) {
            texel =
                glm::vec4(glm::min(glm::vec3(texel) * factor, glm::vec3(kMaxRadiance)), texel.a);
        }
    }
    return cube;
}

PreparedEnvironment prepare(Cubemap base, const PreparedParts& parts) {
    PreparedEnvironment environment;
    environment.base = std::move(base);
    if (parts.boxMips) {
        environment.boxMips = boxMips(environment.base);
    }
    if (parts.tentMips) {
        environment.tentMips = tentMips(environment.base);
    }
    if (parts.prefilteredMips) {
        environment.prefilteredMips = prefilteredMips(environment.base);
    }
    if (parts.sh9) {
        environment.sh9 = sh9FromCube(environment.base);
    }
    if (parts.irradiance) {
        environment.irradiance = irradianceCube(environment.base);
    }
    return environment;
}

} // namespace lodestar::lighting
