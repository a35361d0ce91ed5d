// SPDX-License-Identifier: MIT
//
// Analytic environments as functions of direction and as the texel means of a cube.
#define LODESTAR_DOUBLE_PRECISION
#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include <glm/geometric.hpp>

#include "core/contract.h"
#include "lighting/clear_sky.h"
#include "lighting/environment.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;
constexpr double kPi = std::numbers::pi;

/// From this width on two Gauss points an axis integrate a smooth function over a texel to 1e-9;
/// coarser texels are first cut to this size.
constexpr int kFineWidth = 64;

/// A rectangle of a face, in the coordinates of lodestar_cubeDirection.
struct Cell {
    int face;
    double u;        ///< centre
    double v;        ///< centre
    double halfSide; ///< half of its side
};

glm::dvec3 directionOf(int face, double u, double v) {
    return glm::normalize(shader_double::lodestar_cubeDirection(face, u, v));
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Calls f(u, v, 1 / length, weight) at the 2x2 Gauss points of a cell; the weights are the solid
/// angle.
template <class Function>
void eachGaussPoint(const Cell& cell, const Function& f) {
    const double offset = cell.halfSide * 0.57735026918962576;
    for (int s = 0; s < 4; ++s) {
        const double u = cell.u + ((s & 1) == 0 ? -offset : offset);
        const double v = cell.v + ((s & 2) == 0 ? -offset : offset);
        const double inverse = 1.0 / std::sqrt(1.0 + u * u + v * v);
        f(u, v, inverse, inverse * inverse * inverse * cell.halfSide * cell.halfSide);
    }
}

/// Sums f(direction) times the solid angle over a cell, and the solid angle.
template <class Function>
void addGauss(const Cell& cell, const Function& f, glm::dvec3& sum, double& solidAngle) {
    eachGaussPoint(cell, [&](double u, double v, double inverse, double weight) {
        sum += weight * f(shader_double::lodestar_cubeDirection(cell.face, u, v) * inverse);
        solidAngle += weight;
    });
}

/// Of a cell at most 2 / kFineWidth wide, to 1e-8.
double solidAngleOf(const Cell& cell) {
    double sum = 0.0;
    eachGaussPoint(cell, [&](double, double, double, double weight) { sum += weight; });
    return sum;
}

/// The mean of a smooth function over a texel.
template <class Function>
glm::dvec3 smoothMean(const Cell& texel, int cuts, const Function& f) {
    glm::dvec3 sum(0.0);
    double solidAngle = 0.0;
    const double half = texel.halfSide / cuts;
    for (int b = 0; b < cuts; ++b) {
        for (int a = 0; a < cuts; ++a) {
            addGauss({texel.face, texel.u - texel.halfSide + (2 * a + 1) * half,
                      texel.v - texel.halfSide + (2 * b + 1) * half, half},
                     f, sum, solidAngle);
        }
    }
    return sum / solidAngle;
}

/// The share of the square [-1/2, 1/2]^2 where d + gx x + gy y > 0.
double halfPlaneShare(double d, double gx, double gy) {
    const double large = std::max(std::abs(gx), std::abs(gy));
    const double small = std::min(std::abs(gx), std::abs(gy));
    const double outer = 0.5 * (large + small); // |d| where the line leaves the square
    const double inner = 0.5 * (large - small); // |d| up to which it crosses two opposite sides
    const double distance = std::abs(d);
    double share = 1.0;
    if (distance < inner || small == 0.0) {
        share = large > 0.0 ? std::min(0.5 + distance / large, 1.0) : 1.0;
    } else if (distance < outer) {
        const double corner = outer - distance;
        share = 1.0 - corner * corner / (2.0 * large * small);
    }
    return d >= 0.0 ? share : 1.0 - share;
}

/// A cap of directions, and how much of a cell it covers.
class Cap {
public:
    Cap(const glm::dvec3& axis, double angularRadius) : axis_(axis), radius_(angularRadius) {}

    /// The share of a cell's solid angle inside the cap.
    [[nodiscard]] double coverage(const Cell& cell) const {
        const Relation relation = relationTo(cell);
        if (relation != Relation::Crossed) {
            return relation == Relation::Inside ? 1.0 : 0.0;
        }
        double covered = 0.0;
        double solidAngle = 0.0;
        add(cell, 0, covered, solidAngle);
        return covered / solidAngle;
    }

private:
    enum class Relation { Inside, Outside, Crossed };

    /// Deep enough for a rim of 1e-7 degrees in a whole face.
    static constexpr int kMaxDepth = 34;
    /// The rim is taken as its tangent in cells whose half diagonal is at most the radius over
    /// this. It bends away from the tangent by x^2 / 2r, on average by a^2 / 24r over a cell of
    /// side a, so that the cap's area pi r^2 is in error by at most a^2 / 12r^2: 7e-5, with a =
    /// sqrt 2 r / 48.
    static constexpr double kCellsPerRadius = 48.0;

    [[nodiscard]] double bound(const Cell& cell) const {
        // The half diagonal seen from the origin; the plane is at least as far away as 1.
        return std::atan(cell.halfSide * std::numbers::sqrt2);
    }

    [[nodiscard]] Relation relationTo(const Cell& cell) const {
        const double angle = angleBetween(directionOf(cell.face, cell.u, cell.v), axis_);
        const double reach = bound(cell);
        if (angle + reach <= radius_ || radius_ >= kPi) {
            return Relation::Inside;
        }
        return angle - reach >= radius_ ? Relation::Outside : Relation::Crossed;
    }

    void add(const Cell& cell, int depth, double& covered, double& solidAngle) const {
        const Relation relation = relationTo(cell);
        const double rim = std::min(radius_, kPi - radius_);
        const bool coarse = cell.halfSide > 1.0 / kFineWidth || depth < 2;
        const bool curved = relation == Relation::Crossed && bound(cell) * kCellsPerRadius > rim;
        if ((coarse || curved) && depth < kMaxDepth) {
            const double half = 0.5 * cell.halfSide;
            for (int s = 0; s < 4; ++s) {
                add({cell.face, cell.u + ((s & 1) == 0 ? -half : half),
                     cell.v + ((s & 2) == 0 ? -half : half), half},
                    depth + 1, covered, solidAngle);
            }
            return;
        }
        const double weight = solidAngleOf(cell);
        solidAngle += weight;
        if (relation == Relation::Crossed) {
            covered += weight * rimShare(cell);
        } else if (relation == Relation::Inside) {
            covered += weight;
        }
    }

    /// The share of a cell that a straight piece of rim leaves inside.
    [[nodiscard]] double rimShare(const Cell& cell) const {
        const auto inside = [&](double u, double v) {
            return radius_ - angleBetween(directionOf(cell.face, u, v), axis_);
        };
        const double h = cell.halfSide;
        return halfPlaneShare(inside(cell.u, cell.v),
                              inside(cell.u + h, cell.v) - inside(cell.u - h, cell.v),
                              inside(cell.u, cell.v + h) - inside(cell.u, cell.v - h));
    }

    glm::dvec3 axis_;
    double radius_;
};

template <class MeanOf>
Cubemap filled(int width, const MeanOf& meanOf) {
    Cubemap cube(width);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < width; ++y) {
            for (int x = 0; x < width; ++x) {
                const Cell texel{face, (2.0 * x + 1.0) / width - 1.0, (2.0 * y + 1.0) / width - 1.0,
                                 1.0 / width};
                cube.texel(face, x, y) = glm::vec4(glm::vec3(meanOf(texel)), 1.0f);
            }
        }
    }
    return cube;
}

int cutsFor(int width) {
    return (kFineWidth + width - 1) / width;
}

glm::dvec3 at(const ConstantEnvironment& e, const glm::dvec3&) {
    return e.radiance;
}

glm::dvec3 at(const GradientEnvironment& e, const glm::dvec3& d) {
    const double t = std::clamp(0.5 + 0.5 * d.y, 0.0, 1.0);
    return e.down * (1.0 - t) + e.up * t;
}

glm::dvec3 at(const DiscEnvironment& e, const glm::dvec3& d) {
    return angleBetween(d, e.axis) <= e.angularRadius ? e.inside : e.outside;
}

glm::dvec3 at(const FacesEnvironment& e, const glm::dvec3& d) {
    return e.radiance[static_cast<std::size_t>(shader_double::lodestar_cubeFace(d))];
}

glm::dvec3 at(const ClearSkyEnvironment&, const glm::dvec3& d) {
    const bool sun = angleBetween(d, clearSkySunDirection()) <= clearSkySunRadius();
    return clearSkyRadiance(d) + (sun ? clearSkySunRadiance() : glm::dvec3(0.0));
}

Cubemap cubeOf(const ConstantEnvironment& e, int width) {
    return filled(width, [&](const Cell&) { return e.radiance; });
}

Cubemap cubeOf(const GradientEnvironment& e, int width) {
    return filled(width, [&](const Cell& texel) {
        return smoothMean(texel, cutsFor(width), [&](const glm::dvec3& d) { return at(e, d); });
    });
}

Cubemap cubeOf(const DiscEnvironment& e, int width) {
    const Cap cap(e.axis, e.angularRadius);
    return filled(width, [&](const Cell& texel) {
        const double t = cap.coverage(texel);
        return e.outside * (1.0 - t) + e.inside * t;
    });
}

Cubemap cubeOf(const FacesEnvironment& e, int width) {
    return filled(
        width, [&](const Cell& texel) { return e.radiance[static_cast<std::size_t>(texel.face)]; });
}

/// Whether one point in the middle of a texel stands for all of it to 1e-4: where the sky varies
/// over no less than a tenth of a radian, away from the sun and from the haze just below the
/// horizon.
bool isEven(const glm::dvec3& d, double cosineToSun, double halfSide) {
    return halfSide <= 1.0 / 128.0 && cosineToSun < 0.96 && (d.y > 0.01 || d.y < -0.2);
}

Cubemap cubeOf(const ClearSkyEnvironment&, int width) {
    const glm::dvec3 towardsSun = clearSkySunDirection();
    const glm::dvec3 sunRadiance = clearSkySunRadiance();
    const Cap sun(towardsSun, clearSkySunRadius());
    const int cuts = cutsFor(width);
    return filled(width, [&](const Cell& texel) {
        const glm::dvec3 d = directionOf(texel.face, texel.u, texel.v);
        if (isEven(d, glm::dot(d, towardsSun), texel.halfSide)) {
            return clearSkyRadiance(d);
        }
        return smoothMean(texel, cuts, clearSkyRadiance) + sunRadiance * sun.coverage(texel);
    });
}

} // namespace

glm::dvec3 radiance(const AnalyticEnvironment& environment, const glm::dvec3& direction) {
    return std::visit([&](const auto& e) { return at(e, direction); }, environment);
}

Cubemap cubeFromAnalytic(const AnalyticEnvironment& environment, int width) {
    LODESTAR_EXPECT(width >= 1 && width <= 4096,
                    "a cube made from an analytic environment has a width in [1, 4096]");
    return std::visit([&](const auto& e) { return cubeOf(e, width); }, environment);
}

} // namespace lodestar::lighting
