// SPDX-License-Identifier: MIT
#include "lighting/zonal_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/contract.h"

namespace lodestar::lighting {
namespace {

constexpr double kPi = std::numbers::pi;

double luminance(const glm::dvec3& radiance) {
    return glm::dot(radiance, glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// Bilinear, wrapped along the horizon, clamped at the poles.
glm::dvec3 lookup(const core::Image& panorama, const glm::dvec3& direction) {
    const int width = panorama.width();
    const int height = panorama.height();
    const double x =
        std::atan2(direction.x, -direction.z) / (2.0 * kPi) * width + 0.5 * width - 0.5;
    const double y = std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi * height - 0.5;
    const double left = std::floor(x);
    const double top = std::floor(y);
    const auto texel = [&](double column, double row) {
        const int i = (static_cast<int>(column) + width) % width;
        const float* p = panorama.at(i, std::clamp(static_cast<int>(row), 0, height - 1));
        return glm::dvec3(p[0], p[1], p[2]);
    };
    return glm::mix(glm::mix(texel(left, top), texel(left + 1.0, top), x - left),
                    glm::mix(texel(left, top + 1.0), texel(left + 1.0, top + 1.0), x - left),
                    y - top);
}

/// Circles about an axis.
struct Circles {
    glm::dvec3 axis, across, along;

    explicit Circles(const glm::dvec3& about) : axis(about) {
        const glm::dvec3 other =
            std::abs(about.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
        across = glm::normalize(glm::cross(about, other));
        along = glm::cross(about, across);
    }
    [[nodiscard]] glm::dvec3 at(double theta, double phi) const {
        return std::cos(theta) * axis +
               std::sin(theta) * (std::cos(phi) * across + std::sin(phi) * along);
    }
};

/// A circle's mean radiance and the mean absolute deviation of its luminance from it.
struct CircleMean {
    glm::dvec3 mean{0.0};
    double deviation = 0.0;
};

CircleMean meanOf(const core::Image& panorama, const Circles& circles, double theta) {
    // Two lookups a texel, sixteen where the circle is small.
    const auto count = static_cast<std::size_t>(
        std::max(16.0, std::ceil(4.0 * std::sin(theta) * panorama.height())));
    std::vector<glm::dvec3> samples(count);
    CircleMean circle;
    for (std::size_t k = 0; k < count; ++k) {
        const double phi = 2.0 * kPi * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
        samples[k] = lookup(panorama, circles.at(theta, phi));
        circle.mean += samples[k];
    }
    circle.mean /= static_cast<double>(count);
    for (const glm::dvec3& sample : samples) {
        circle.deviation += std::abs(luminance(sample) - luminance(circle.mean));
    }
    circle.deviation /= static_cast<double>(count);
    return circle;
}

} // namespace

ZonalRadiance zonalFromStrip(const std::vector<glm::dvec3>& texels, const Zones& zones) {
    LODESTAR_EXPECT(!texels.empty(), "a strip has texels");
    const std::vector<double> edges = zoneEdges(zones);
    const double each = kPi / static_cast<double>(texels.size());
    ZonalRadiance result{zones, {}};
    for (std::size_t j = 0; j + 1 < edges.size(); ++j) {
        glm::dvec3 sum(0.0);
        for (auto i = static_cast<std::size_t>(edges[j] / each); i < texels.size(); ++i) {
            const double from = std::max(edges[j], each * static_cast<double>(i));
            const double to = std::min(edges[j + 1], each * static_cast<double>(i + 1));
            if (from >= edges[j + 1]) {
                break;
            }
            sum += texels[i] * (to > from ? ringArea(from, to) : 0.0);
        }
        result.means.push_back(sum / ringArea(edges[j], edges[j + 1]));
    }
    return result;
}

PanoramaZones zonalFromPanorama(const core::Image& panorama, const glm::dvec3& axis,
                                const Zones& zones) {
    LODESTAR_EXPECT(!panorama.empty() && panorama.channels() == 3, "a panorama has three channels");
    const std::vector<double> edges = zoneEdges(zones);
    const Circles circles(axis);
    PanoramaZones result{{zones, {}}, 0.0};
    double moved = 0.0;
    double whole = 0.0;
    for (std::size_t j = 0; j + 1 < edges.size(); ++j) {
        const double low = std::pow(std::sin(0.5 * edges[j]), 2.0);
        const double high = std::pow(std::sin(0.5 * edges[j + 1]), 2.0);
        const double rings =
            std::max(1.0, std::ceil(2.0 * (edges[j + 1] - edges[j]) * panorama.height() / kPi));
        glm::dvec3 sum(0.0);
        for (double k = 0.5; k < rings; k += 1.0) {
            const double theta = 2.0 * std::asin(std::sqrt(low + (high - low) * k / rings));
            const CircleMean circle = meanOf(panorama, circles, theta);
            sum += circle.mean;
            moved += 0.5 * circle.deviation * (high - low) / rings;
            whole += luminance(circle.mean) * (high - low) / rings;
        }
        result.radiance.means.push_back(sum / rings);
    }
    result.residual = whole > 0.0 ? moved / whole : 0.0;
    return result;
}

} // namespace lodestar::lighting
