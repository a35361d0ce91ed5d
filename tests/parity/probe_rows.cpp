// SPDX-License-Identifier: MIT
//
// Inputs and bounds of the rows of lodestar/probes.glsl and of what lodestar/cube.glsl has for
// them.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "parity/cases.h"
#include "parity/draw.h"
#include "parity/tolerances.h"

namespace lodestar::testing {
namespace {

constexpr double u = 0x1p-23;
constexpr int kDrawn = 300;

class Draw : public DrawnNumbers {
public:
    using DrawnNumbers::DrawnNumbers;
    /// @param least of each component's size
    glm::vec3 unit(float least = 0.0f) {
        while (true) {
            const glm::vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            const float length = glm::length(v);
            const glm::vec3 unit = v / length;
            const glm::vec3 size = glm::abs(unit);
            if (length > 0.1f && length <= 1.0f && std::min({size.x, size.y, size.z}) >= least) {
                return unit;
            }
        }
    }
};

Tolerance all(double tolerance) {
    return {tolerance, tolerance, tolerance, tolerance};
}

/// What a point's coordinates in the volume are off by: four products and three sums of a row.
double pointError(const GlslCase& inputs) {
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4 row(inputs[i]);
        const glm::dvec3 world(inputs[6]);
        most = std::max(most, glm::dot(glm::abs(row), glm::dvec4(glm::abs(world), 1.0)));
    }
    return 4.0 * u * most;
}

} // namespace

std::vector<GlslCase> facePointCases() {
    std::vector<GlslCase> cases;
    for (const float a : {-1.0f, -0.5f, 0.0f, 1.0f, 1.05f}) {
        for (const float b : {-1.02f, 0.0f, 0.3f, 1.0f}) {
            cases.push_back({glm::vec4(a, b, 8.0f, 0.0f)});
        }
    }
    Draw draw(71);
    for (int i = 0; i < kDrawn; ++i) {
        cases.push_back({glm::vec4(draw.uniform(-1.1f, 1.1f), draw.uniform(-1.1f, 1.1f),
                                   std::floor(draw.uniform(1.0f, 512.0f)), 0.0f)});
    }
    return cases;
}

std::vector<GlslCase> roundLobeCases() {
    std::vector<GlslCase> cases = {{glm::vec4(0.0f, 0.0f, 0.0f, 0.0f)},
                                   {glm::vec4(1.0f, 10.0f, 0.0f, 0.0f)}};
    Draw draw(72);
    for (int i = 0; i < kDrawn; ++i) {
        const float exponent = std::exp2(draw.uniform(-3.0f, 12.0f));
        // At most half of the lobe's spread is the texel's: no digits are lost.
        cases.push_back({glm::vec4(exponent, draw.uniform(0.0f, 0.8f) / (exponent + 2.0f), 0, 0)});
    }
    return cases;
}

std::vector<GlslCase> octahedralCases() {
    std::vector<GlslCase> cases = {
        {glm::vec4(0, 1, 0, 0)}, {glm::vec4(1, 0, 0, 0)}, {glm::vec4(0, 0, 1, 0)}};
    Draw draw(73);
    for (int i = 0; i < kDrawn; ++i) {
        const glm::vec3 d = draw.unit(0.01f); // at a fold either side is right
        cases.push_back({glm::vec4(d, 0.0f), glm::vec4(draw.uniform(0.01f, 0.98f),
                                                       -draw.uniform(0.01f, 0.98f), 0.0f, 0.0f)});
    }
    return cases;
}

std::vector<GlslCase> volumeCases() {
    std::vector<GlslCase> cases;
    Draw draw(74);
    for (int i = 0; i < kDrawn; ++i) {
        const glm::vec3 half(draw.uniform(0.5f, 6.0f), draw.uniform(0.5f, 6.0f),
                             draw.uniform(0.5f, 6.0f));
        const glm::mat4 world = glm::rotate(glm::translate(glm::mat4(1.0f), 5.0f * draw.unit()),
                                            draw.uniform(0.0f, 6.0f), draw.unit());
        const glm::mat4 rows = glm::transpose(glm::inverse(world));
        const bool sphere = i % 3 == 0;
        // Inside, so that a sphere's root keeps its digits: at most nine tenths of the way out.
        const glm::vec3 local =
            sphere ? draw.uniform(0.0f, 0.9f) * half.x * draw.unit()
                   : half * glm::vec3(draw.uniform(-0.9f, 0.9f), draw.uniform(-0.9f, 0.9f),
                                      draw.uniform(-0.9f, 0.9f));
        const glm::vec3 at(world * glm::vec4(local, 1.0f));
        const glm::vec3 high(draw.uniform(0.3f, 1.0f), draw.uniform(0.3f, 1.0f),
                             draw.uniform(0.3f, 1.0f));
        const glm::vec3 direction =
            glm::vec3(world * glm::vec4(draw.unit(0.1f), 0.0f)); // to no face's plane parallel
        cases.push_back({rows[0], rows[1], rows[2],
                         glm::vec4(sphere ? glm::vec3(half.x) : half, sphere ? 1.0f : 0.0f),
                         glm::vec4(high, i % 2 == 0 ? 1.0f : 0.0f), glm::vec4(0.5f * high, 0.0f),
                         glm::vec4(at, 0.0f), glm::vec4(direction, 0.0f),
                         glm::vec4(at + draw.unit(), 0.0f)});
    }
    return cases;
}

std::vector<GlslCase> shareCases() {
    std::vector<GlslCase> cases;
    for (const float w : {0.0f, 1.0f}) {
        for (const float f : {0.0f, 1.0f}) {
            cases.push_back({glm::vec4(w, 1.0f - w, f, 0.0f), glm::vec4(f, 0, 0, 0)});
            cases.push_back({glm::vec4(w, w, f, 1.0f), glm::vec4(1.0f - f, 0, 0, 0)});
        }
    }
    Draw draw(75);
    for (int i = 0; i < kDrawn; ++i) {
        cases.push_back({glm::vec4(draw.uniform(0, 1), draw.uniform(0, 1), draw.uniform(0, 1),
                                   draw.uniform(0, 1)),
                         glm::vec4(draw.uniform(0, 1), 0, 0, 0)});
    }
    return cases;
}

/// A cube of m / sqrt(1 + u^2 + v^2): the sum has three roundings, of which the root takes half;
/// the root 2, the products 3 and their threefold.
Tolerance densityTolerance(const GlslCase&, const glm::dvec4& value, int) {
    return all(16.0 * u * std::abs(value.x));
}

/// Points moved by a rounded step first, on which the density's logarithm leans by 1.5 at most; a
/// mean of four.
Tolerance meanDensityTolerance(const GlslCase&, const glm::dvec4& value, int) {
    return all(26.0 * u * std::abs(value.x));
}

/// 1 / spread - 2, where spread is a difference of which at most half is subtracted: 2.5 units of
/// the first quotient and 2 of the product doubled, 2.5 of the second.
Tolerance roundExponentTolerance(const GlslCase&, const glm::dvec4& value, int) {
    return all(13.0 * u * (std::abs(value.x) + 2.0));
}

/// Coordinates times 12, of which each is off by 8 units, and two sums up to 25.
Tolerance tileTolerance(const GlslCase&, const glm::dvec4&, int) {
    return all((8.0 * 12.0 + 2.0 * 25.0) * u);
}

Tolerance intoVolumeTolerance(const GlslCase& inputs, const glm::dvec4&, int) {
    return all(pointError(inputs) + 1e-30);
}

/// Rows of a turn have length 1: three quotients, products and sums of at most 1 each.
Tolerance outOfVolumeTolerance(const GlslCase&, const glm::dvec4&, int) {
    return all(3.0 * 8.0 * u);
}

/// Six fades, each as steep as 1.5 over its blend, of distances that are off by the point's error
/// and two sums of up to 14 m.
Tolerance volumeWeightTolerance(const GlslCase& inputs, const glm::dvec4&, int) {
    const double distance = pointError(inputs) + 28.0 * u;
    return all(6.0 * (1.5 * distance / 0.15 + 9.0 * u));
}

/// The way to a face is off by the point's error and the face's rounding over the direction's part
/// across it, at least 0.1, and by rounding of itself, at most 12 m / 0.1; to a sphere by as much
/// over the root, at least 0.4 of the radius. Then the sum of three points within 20 m.
Tolerance parallaxTolerance(const GlslCase& inputs, const glm::dvec4&, int) {
    const double distance = pointError(inputs) + 12.0 * u;
    return all(12.0 * distance / 0.1 + 5.0 * u * 120.0 + 60.0 * u);
}

} // namespace lodestar::testing
