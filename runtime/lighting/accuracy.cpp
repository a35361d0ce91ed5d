// SPDX-License-Identifier: MIT
#include "lighting/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/contract.h"
#include "core/parallel.h"
#include "lighting/lookup.h"
#include "lighting/mips.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {
namespace {

/// The n-th of points that fill the square evenly (Roberts 2018, R2).
glm::dvec2 evenly(std::size_t n) {
    const double x = 0.5 + 0.7548776662466927 * static_cast<double>(n);
    const double y = 0.5 + 0.5698402909980532 * static_cast<double>(n);
    return {x - std::floor(x), y - std::floor(y)};
}

/// Texels as radiance^2 x solid angle, summed up in order.
class Brightness {
public:
    explicit Brightness(const Cubemap& base) : base_(base), width_(base.width()) {
        const std::vector<double> solidAngles = texelSolidAngles(width_);
        double sum = 0.0;
        for (std::size_t i = 0; i < base.level(0).size(); ++i) {
            sum += squared(i) * solidAngles[i % solidAngles.size()];
            sums_.push_back(sum);
        }
    }
    [[nodiscard]] double total() const { return sums_.back(); }
    /// The texel that holds a share of the total.
    [[nodiscard]] std::size_t at(double share) const {
        const auto found = std::upper_bound(sums_.begin(), sums_.end(), share * sums_.back());
        return std::min(static_cast<std::size_t>(found - sums_.begin()), sums_.size() - 1);
    }
    [[nodiscard]] double squared(std::size_t texel) const {
        const glm::dvec3 radiance(base_.level(0)[texel]);
        return glm::dot(radiance, radiance);
    }
    /// @param in where in the texel, [0, 1)^2
    [[nodiscard]] glm::dvec3 direction(std::size_t texel, const glm::dvec2& in) const {
        const std::size_t face = texel / (sums_.size() / 6);
        const std::size_t inFace = texel % (sums_.size() / 6);
        const auto width = static_cast<std::size_t>(width_);
        const glm::dvec2 at((static_cast<double>(inFace % width) + in.x) * 2.0 / width_ - 1.0,
                            (static_cast<double>(inFace / width) + in.y) * 2.0 / width_ - 1.0);
        return glm::normalize(glm::dvec3(shader::lodestar_cubeDirection(
            static_cast<int>(face), static_cast<float>(at.x), static_cast<float>(at.y))));
    }
    [[nodiscard]] std::size_t texelOf(const glm::dvec3& direction) const {
        const glm::vec3 d(direction);
        const int face = shader::lodestar_cubeFace(d);
        const glm::vec2 uv = shader::lodestar_cubeCoordinates(d);
        const auto index = [&](float c) {
            return std::clamp(static_cast<int>((c + 1.0f) * 0.5f * static_cast<float>(width_)), 0,
                              width_ - 1);
        };
        return static_cast<std::size_t>((face * width_ + index(uv.y)) * width_ + index(uv.x));
    }

private:
    const Cubemap& base_;
    int width_;
    std::vector<double> sums_;
};

/// The variance that texels of a face of so many add to a lobe's, as a share of it: a texel of side
/// H = 2 / W adds H^2 / 12 along each axis to 1 / s (docs/derivations/mip.md).
double varianceOf(int width, double exponent) {
    return exponent / (3.0 * width * width);
}

} // namespace

std::vector<MeasuredDirection> measuredDirections(const Cubemap& base, int count) {
    LODESTAR_EXPECT(!base.empty() && count >= 2, "a map and directions to measure it at");
    const Brightness brightness(base);
    const bool dark = !(brightness.total() > 0.0);
    const int even = dark ? count : count - count / 2;
    std::vector<MeasuredDirection> directions;
    for (int i = 0; i < even; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / even;
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
        directions.push_back({{r * std::cos(angle), z, r * std::sin(angle)}, 0.0});
    }
    for (int i = 0; i < count - even; ++i) {
        const std::size_t texel = brightness.at((i + 0.5) / (count - even));
        directions.push_back(
            {brightness.direction(texel, evenly(static_cast<std::size_t>(i))), 0.0});
    }
    double sum = 0.0;
    for (MeasuredDirection& measured : directions) {
        double density = even / (4.0 * std::numbers::pi);
        if (!dark) {
            density += (count - even) * brightness.squared(brightness.texelOf(measured.direction)) /
                       brightness.total();
        }
        measured.weight = 1.0 / density;
        sum += measured.weight;
    }
    for (MeasuredDirection& measured : directions) {
        measured.weight /= sum;
    }
    return directions;
}

LobeMeans::LobeMeans(const Cubemap& base, double addedVariance) : addedVariance_(addedVariance) {
    const Cubemap chain = solidAngleMips(base);
    for (int level = 0; level < chain.levelCount(); ++level) {
        Cubemap map(chain.width(level));
        map.level(0) = chain.level(level);
        maps_.push_back(std::move(map));
    }
}

glm::dvec3 LobeMeans::operator()(const glm::dvec3& direction, double exponent) const {
    std::size_t level = 0;
    while (level + 1 < maps_.size() && maps_[level + 1].width() >= 16 &&
           varianceOf(maps_[level + 1].width(), std::max(exponent, 1.0)) <= addedVariance_) {
        ++level;
    }
    return referencePhong(maps_[level], direction, exponent);
}

std::vector<glm::dvec3> lobeMeans(const Cubemap& base, std::span<const glm::dvec3> directions,
                                  std::span<const double> exponents,
                                  const std::function<void(std::size_t)>& progress) {
    const LobeMeans means(base);
    std::vector<glm::dvec3> all(directions.size() * exponents.size());
    core::inParallel(
        directions.size(),
        [&](std::size_t d) {
            for (std::size_t e = 0; e < exponents.size(); ++e) {
                all[d * exponents.size() + e] = means(directions[d], exponents[e]);
            }
        },
        progress);
    return all;
}

Accuracy accuracyOf(std::span<const MeasuredDirection> directions,
                    std::span<const glm::dvec3> truths, std::span<const glm::dvec3> answers) {
    double off = 0.0;
    double norm = 0.0;
    double worst = 0.0;
    for (std::size_t d = 0; d < directions.size(); ++d) {
        const glm::dvec3 difference = answers[d] - truths[d];
        const double squared = glm::dot(difference, difference);
        off += directions[d].weight * squared;
        norm += directions[d].weight * glm::dot(truths[d], truths[d]);
        worst = std::max(worst, squared);
    }
    if (off == 0.0) {
        return {};
    }
    return {std::sqrt(off / norm), std::sqrt(worst / norm)};
}

} // namespace lodestar::lighting
