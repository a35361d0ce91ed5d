// SPDX-License-Identifier: MIT
#include "lighting/zonal_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/contract.h"
#include "core/quadrature.h"

namespace lodestar::lighting {
namespace {

constexpr double kPi = std::numbers::pi;

/// Half the arc of the circle of colatitude t that lies within an angle of an axis of colatitude
/// alpha, by the half-angle formula of docs/derivations/rsrm.md. [0, pi]
double halfArc(double t, double alpha, double angle) {
    if (angle <= std::abs(t - alpha)) {
        return 0.0;
    }
    if (angle >= std::min(t + alpha, 2.0 * kPi - t - alpha)) {
        return kPi;
    }
    const double inside = std::sin(0.5 * (t - alpha + angle)) * std::sin(0.5 * (alpha - t + angle));
    const double outside =
        std::sin(0.5 * (alpha + t + angle)) * std::sin(0.5 * (alpha + t - angle));
    return 2.0 * std::atan2(std::sqrt(std::max(inside, 0.0)), std::sqrt(std::max(outside, 0.0)));
}

/// A panorama's grid about an axis. A texel's cell lies between two colatitudes and two azimuths
/// from the axis', the latter in columns within [-width / 2, width / 2 + 1).
class PanoramaGrid {
public:
    PanoramaGrid(int width, int height, const glm::dvec3& axis)
        : width_(width), height_(height), alpha_(std::atan2(std::hypot(axis.x, axis.z), axis.y)),
          centre_(std::atan2(axis.x, -axis.z) * width / (2.0 * kPi) + 0.5 * width) {}

    [[nodiscard]] double colatitude(double row) const { return kPi * row / height_; }
    [[nodiscard]] double area(int row) const {
        return ringArea(colatitude(row), colatitude(row + 1)) / width_;
    }
    /// The azimuth of a cell's left side, in columns.
    [[nodiscard]] double left(int column) const {
        const double from = column - centre_;
        return from - width_ * std::floor(from / width_ + 0.5);
    }
    /// The angle from the axis of a colatitude and an azimuth in columns.
    [[nodiscard]] double angle(double t, double columns) const {
        const double across = std::sin(0.5 * (t - alpha_));
        const double around = std::sin(kPi * columns / width_);
        const double h = across * across + std::sin(t) * std::sin(alpha_) * around * around;
        return 2.0 * std::asin(std::sqrt(std::clamp(h, 0.0, 1.0)));
    }

    /// The share of the sphere that lies in a cell and within an angle of the axis: an integral
    /// over colatitude, split where the circle of that angle enters and leaves the cell's sides and
    /// where it turns back, with nodes dense at both ends of a piece, where its arc grows as a
    /// square root.
    [[nodiscard]] double within(double edge, int row, double left) const {
        const double top = colatitude(row);
        const double bottom = colatitude(row + 1);
        std::array<double, 8> breaks{top, bottom, std::abs(alpha_ - edge),
                                     std::min(alpha_ + edge, 2.0 * kPi - alpha_ - edge)};
        for (std::size_t side = 0; side < 2; ++side) {
            // cos edge = R cos(t - t0) along a meridian; of the roots the two that can lie in [0,
            // pi].
            const double phi = (left + static_cast<double>(side)) * 2.0 * kPi / width_;
            const double x = std::cos(alpha_);
            const double y = std::sin(alpha_) * std::cos(phi);
            const double t0 = std::atan2(y, x);
            const double away = std::acos(
                std::clamp(std::cos(edge) / std::max(std::hypot(x, y), 1e-300), -1.0, 1.0));
            breaks[4 + 2 * side] = t0 + away;
            breaks[5 + 2 * side] = t0 - away + (t0 < 0.0 ? 2.0 * kPi : 0.0);
        }
        for (double& at : breaks) {
            at = std::clamp(at, top, bottom);
        }
        std::sort(breaks.begin(), breaks.end());
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            sum += breaks[i + 1] > breaks[i] ? piece(edge, left, breaks[i], breaks[i + 1]) : 0.0;
        }
        return sum;
    }

private:
    [[nodiscard]] double piece(double edge, double left, double from, double to) const {
        static const core::GaussRule rule = core::gaussLegendre(10);
        double sum = 0.0;
        double weights = 0.0;
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            const double t =
                from + (to - from) * std::pow(std::sin(0.5 * kPi * rule.nodes[k]), 2.0);
            const double weight = rule.weights[k] * std::sin(kPi * rule.nodes[k]) * std::sin(t);
            const double arc = halfArc(t, alpha_, edge) * width_ / (2.0 * kPi);
            const double near = std::min(left + 1.0, arc) - std::max(left, -arc);
            const double behind = left + 1.0 - std::max(left, width_ - arc);
            sum += weight * (std::max(near, 0.0) + std::max(behind, 0.0));
            weights += weight;
        }
        return weights > 0.0 ? ringArea(from, to) * sum / weights / width_ : 0.0;
    }

    double width_, height_;
    double alpha_;  ///< the axis' colatitude
    double centre_; ///< its column
};

/// Shares the sphere out among texels and zones: visit(zone, texel, share).
template <class Visit>
void shareOut(const core::Image& panorama, const glm::dvec3& axis, const std::vector<double>& edges,
              Visit&& visit) {
    const PanoramaGrid grid(panorama.width(), panorama.height(), axis);
    for (int row = 0; row < panorama.height(); ++row) {
        const double t = grid.colatitude(row + 0.5);
        const double area = grid.area(row);
        // No point of a cell is farther from its middle than a way along its middle's meridian and
        // one along a parallel, which is longest on the cell's side towards the equator.
        const double reach = grid.colatitude(0.5) +
                             grid.colatitude(0.5) * 2.0 * panorama.height() / panorama.width() *
                                 std::min(std::sin(t) + grid.colatitude(0.5), 1.0);
        for (int column = 0; column < panorama.width(); ++column) {
            const double left = grid.left(column);
            const double middle = grid.angle(t, left + 0.5);
            const float* texel = panorama.at(column, row);
            const auto first = std::upper_bound(edges.begin() + 1, edges.end() - 1, middle - reach);
            const auto last = std::lower_bound(first, edges.end() - 1, middle + reach);
            double before = 0.0;
            for (auto edge = first; edge != last; ++edge) {
                const double inside = std::clamp(grid.within(*edge, row, left), before, area);
                visit(static_cast<std::size_t>(edge - edges.begin()) - 1, texel, inside - before);
                before = inside;
            }
            visit(static_cast<std::size_t>(last - edges.begin()) - 1, texel, area - before);
        }
    }
}

} // namespace

double luminance(const glm::dvec3& radiance) {
    return glm::dot(radiance, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 latLongDirection(double x, double y, const core::Image& panorama) {
    const double theta = y / panorama.height() * kPi;
    const double phi = (x / panorama.width() - 0.5) * 2.0 * kPi;
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

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
    PanoramaZones result{{zones, std::vector<glm::dvec3>(edges.size() - 1)}, 0.0};
    std::vector<glm::dvec3>& means = result.radiance.means;
    std::vector<double> areas(means.size());
    shareOut(panorama, axis, edges, [&](std::size_t zone, const float* texel, double share) {
        means[zone] += share * glm::dvec3(texel[0], texel[1], texel[2]);
        areas[zone] += share;
    });
    double whole = 0.0;
    for (std::size_t j = 0; j < means.size(); ++j) {
        whole += luminance(means[j]);
        means[j] /= areas[j];
    }
    double moved = 0.0;
    shareOut(panorama, axis, edges, [&](std::size_t zone, const float* texel, double share) {
        const glm::dvec3 radiance(texel[0], texel[1], texel[2]);
        moved += 0.5 * share * std::abs(luminance(radiance) - luminance(means[zone]));
    });
    result.residual = whole > 0.0 ? moved / whole : 0.0;
    return result;
}

} // namespace lodestar::lighting
