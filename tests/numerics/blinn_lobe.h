// SPDX-License-Identifier: MIT
//
// The normalised Blinn-Phong lobe as a double-precision quadrature, and the L2 distance of a Phong
// lobe from it (LOOK-1 to LOOK-4): shared by the fit of the lookup conversion and its test.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lodestar::testing {

/// Gauss-Legendre nodes and weights on [0, 1].
struct GaussLegendre {
    std::vector<double> nodes;
    std::vector<double> weights;
    explicit GaussLegendre(int count) {
        for (int i = 0; i < count; ++i) {
            double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
            double derivative = 1.0;
            for (int step = 0; step < 8; ++step) { // Newton converges in 5 for every count used
                double p = 1.0;
                double before = 0.0;
                for (int k = 0; k < count; ++k) {
                    const double next = ((2 * k + 1) * x * p - k * before) / (k + 1);
                    before = p;
                    p = next;
                }
                derivative = count * (x * p - before) / (x * x - 1.0);
                x -= p / derivative;
            }
            nodes.push_back(0.5 * (1.0 - x));
            weights.push_back(1.0 / ((1.0 - x * x) * derivative * derivative));
        }
    }
};

/// T(l) = (n.h)^s (n.l)+ / Z with its integral over l made 1, for one exponent and view angle:
/// points l with weights that integrate f(l) T(l). n = +Z, the view in the plane y = 0.
class BlinnLobe {
public:
    /// @param viewAngle radians from the normal, [0, pi/2)
    BlinnLobe(double exponent, double viewAngle, int radialCount = 64, int azimuthCount = 96)
        : view_(std::sin(viewAngle), 0.0, std::cos(viewAngle)) {
        // Half vectors in polar coordinates about n; y = cos^(s+1) makes the power's mass uniform
        // in y, and dl = 4 (h.v) dh carries it over to l (LOOK-2). The lobe is even in azimuth.
        const GaussLegendre radial(radialCount);
        std::vector<double> densities;
        double mass = 0.0;
        for (std::size_t i = 0; i < radial.nodes.size(); ++i) {
            const double logCosine = std::log(radial.nodes[i]) / (exponent + 1.0);
            const double cosine = std::exp(logCosine);
            const double sine = std::sqrt(-std::expm1(2.0 * logCosine));
            for (int j = 0; j < azimuthCount; ++j) {
                const double azimuth = std::numbers::pi * (j + 0.5) / azimuthCount;
                const glm::dvec3 h(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
                const double hDotV = glm::dot(h, view_);
                const glm::dvec3 l = 2.0 * hDotV * h - view_;
                if (hDotV <= 0.0 || l.z <= 0.0) {
                    continue;
                }
                const double weight = radial.weights[i] / (exponent + 1.0) *
                                      (2.0 * std::numbers::pi / azimuthCount) * 4.0 * hDotV * l.z;
                points_.push_back({l, weight});
                densities.push_back(std::exp(logCosine * exponent) * l.z);
                mass += weight;
            }
        }
        for (std::size_t i = 0; i < points_.size(); ++i) {
            points_[i].weight /= mass;
            squaredNorm_ += points_[i].weight * densities[i] / mass;
        }
        integral_ = mass;
    }

    /// (n.h)^s (n.l), 0 below the horizon: T without its normaliser. @param l, v unit
    static double unnormalised(const glm::dvec3& l, const glm::dvec3& v, double exponent) {
        const glm::dvec3 h = glm::normalize(l + v);
        return l.z > 0.0 && h.z > 0.0 ? std::pow(h.z, exponent) * l.z : 0.0;
    }
    /// Its integral, Z.
    [[nodiscard]] double integral() const { return integral_; }

    /// ||P - T|| / ||T|| over the sphere, P the normalised Phong lobe of an exponent about a unit
    /// direction (LOOK-4).
    [[nodiscard]] double phongError(const glm::dvec3& direction, double phongExponent) const {
        const double s = phongExponent;
        const double norm = (s + 1.0) / (2.0 * std::numbers::pi);
        const double phongSquaredNorm = norm * (s + 1.0) / (2.0 * s + 1.0);
        double product = 0.0;
        for (const Point& point : points_) {
            const glm::dvec3 chord = direction - point.l;
            const double d = 0.5 * glm::dot(chord, chord);
            product += d < 1.0 ? point.weight * std::exp(s * std::log1p(-d)) : 0.0;
        }
        const double squared = phongSquaredNorm - 2.0 * norm * product + squaredNorm_;
        return std::sqrt(std::max(squared / squaredNorm_, 0.0));
    }

    /// The integral of l T(l).
    [[nodiscard]] glm::dvec3 meanDirection() const {
        glm::dvec3 sum(0.0);
        for (const Point& point : points_) {
            sum += point.weight * glm::dvec3(point.l.x, 0.0, point.l.z); // even in y
        }
        return sum;
    }

    [[nodiscard]] glm::dvec3 view() const { return view_; }
    [[nodiscard]] glm::dvec3 reflection() const { return {-view_.x, 0.0, view_.z}; }
    /// The direction at a blend between the normal (0) and the reflection (1).
    [[nodiscard]] glm::dvec3 direction(double blend) const {
        return glm::normalize(glm::mix(glm::dvec3(0.0, 0.0, 1.0), reflection(), blend));
    }

private:
    struct Point {
        glm::dvec3 l;
        double weight;
    };
    glm::dvec3 view_;
    std::vector<Point> points_;
    double integral_ = 0.0;
    double squaredNorm_ = 0.0; ///< of T
};

} // namespace lodestar::testing
