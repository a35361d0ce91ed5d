// SPDX-License-Identifier: MIT
#include "parity/tolerances.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/cube.glsl"
#include "lodestar/lobes.glsl"

#include "parity/prefiltered_tolerances.h"
#include "parity/tap_tolerances.h"

namespace lodestar::testing {
namespace {

constexpr double u = 0x1p-23;
/// Below this a driver may flush a number to zero.
constexpr double kTiny = 1.2e-38;

Tolerance same(double tolerance) {
    return {tolerance, tolerance, tolerance, tolerance};
}
Tolerance relative(const glm::dvec4& value, double units) {
    Tolerance tolerance{};
    for (int k = 0; k < 4; ++k) {
        tolerance[static_cast<std::size_t>(k)] = std::abs(value[k]) * units * u + kTiny;
    }
    return tolerance;
}

double log2Error(double x) {
    return x >= 0.5 && x <= 2.0 ? 0x1p-21 : 3.0 * u * std::abs(std::log2(x));
}
/// The error of a value e^y where y is off by dy and the function by 3 + 2 |y| units.
double powerError(double value, double y, double dy) {
    return value * (std::expm1(std::min(dy, 600.0)) + (3.0 + 2.0 * std::abs(y)) * u) + kTiny;
}
double repaired(float exponent) {
    return shader_double::lodestar_repairExponent(static_cast<double>(exponent));
}
glm::dvec3 vec(const glm::vec4& v) {
    return glm::dvec3(v);
}

/// y = s log(1 - d), with d off by dd. The series adds 8 roundings; the logarithm log2Error and a
/// rounding of 1 - d.
double chordError(double value, double d, double s, double dd) {
    if (d >= 1.0) {
        return kTiny;
    }
    const double logarithm = std::log1p(-d);
    const double logarithmError = d < 0.01 ? 8.0 * u * std::abs(logarithm)
                                           : std::log(2.0) * log2Error(1.0 - d) + u / (1.0 - d);
    const double dy = s * (logarithmError + dd / (1.0 - d)) + u * std::abs(s * logarithm);
    return powerError(value, s * logarithm, dy);
}

/// log2(w sqrt 3) with a rounded argument (1.44 u), half of log2(s + 1) with one (0.72 u), and
/// their difference.
double mipLevelError(double exponent, double width) {
    const double first = std::log2(width * std::sqrt(3.0));
    return log2Error(width * std::sqrt(3.0)) + 0.5 * log2Error(exponent + 1.0) + 2.2 * u +
           u * (std::abs(first) + 0.5 * std::log2(exponent + 1.0));
}

/// p = d / m by 3 u a component, so dot(p, p) >= 1 by 8 u of itself; 0.75 log2 and the sum.
double texelSizeError(const glm::dvec3& d) {
    const double m = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    if (!(m > 0.0)) {
        return 0.0;
    }
    return 0.75 * (log2Error(glm::dot(d / m, d / m)) + 1.45 * 8.0 * u) + u;
}

/// The size term goes in once, and less a share of itself where the level is beyond 32 texels, so
/// that it counts at most once; log2(s + 1) goes in with a half at most; seven sums and products of
/// numbers up to 18.
double tentLevelError(const glm::dvec3& d, double exponent, double width) {
    return mipLevelError(exponent, width) + texelSizeError(d) +
           0.5 * (log2Error(exponent + 1.0) + 1.5 * u) + 7.0 * 18.0 * u;
}

/// px = (dx k - d dx_k) / k^2, each product off by u of |dx| |d|; 1 / k^2 by 4 u; the level is half
/// of log2 of the squared length. @param dd error of d, relative to its length
double footprintError(const glm::dvec3& d, const glm::dvec3& dx, const glm::dvec3& dy, double width,
                      double dd) {
    const double k = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    const double level = shader_double::lodestar_footprintLevel(d, dx, dy, 2.0);
    const double span = std::exp2(level); // the longer of |px| and |py|
    const double logs = log2Error(0.5 * width) + 0.5 * log2Error(span * span) +
                        u * (std::abs(std::log2(0.5 * width)) + std::abs(level));
    if (span <= 1e-15) {
        return logs + 2.0 * u; // the least span, a constant
    }
    const double longest = std::max(glm::length(dx), glm::length(dy)) * glm::length(d);
    // Three components of two products each, and d's own error in both.
    const double error = (6.0 * u + 3.0 * dd) * longest / (k * k) + (5.0 * u + 2.0 * dd) * span;
    return logs - std::log2(std::max(1.0 - error / span, 1e-9)) + 4.0 * u;
}

} // namespace

Tolerance exact(const GlslCase&, const glm::dvec4&, int) {
    return same(0.0);
}
// schlickWeight: 1 - x by u/2, its fifth power by 5 u/2, three products; k_L, F0: two products and
// a sum of numbers in [0, 1]. sgFresnelWeight: y by 1.5 u |y|, of which 2^y leaves 0.6 u; exp2 (3 +
// 2 |y|) 2^y <= 3.
Tolerance absolute6(const GlslCase&, const glm::dvec4&, int) {
    return same(6.0 * u);
}
// specularOcclusion: s / (s + 32) by 3.5 u, mix by 3.
Tolerance absolute7(const GlslCase&, const glm::dvec4&, int) {
    return same(7.0 * u);
}
// fresnel: the weight's 6 and a product and a sum.
Tolerance absolute9(const GlslCase&, const glm::dvec4&, int) {
    return same(9.0 * u);
}
// fresnelEnvironment: roughness 8, its difference 1, the weight 6, a product and two sums.
Tolerance absolute20(const GlslCase&, const glm::dvec4&, int) {
    return same(20.0 * u);
}
// phongNormaliser: a sum, a product of the constant, a quotient.
Tolerance relative5(const GlslCase&, const glm::dvec4& v, int) {
    return relative(v, 5.0);
}
// phongFromBlinnPhong: three positive terms, the quotient's 4.5 and two sums.
Tolerance relative6(const GlslCase&, const glm::dvec4& v, int) {
    return relative(v, 6.0);
}
// roughnessFromExponent: quotient and sum 3.5 under a fourth root, root 4.5 halved, root 4.5.
Tolerance relative8(const GlslCase&, const glm::dvec4& v, int) {
    return relative(v, 8.0);
}
// filmic: two quadratics of positive terms, 3 and 3.5, and a quotient.
Tolerance relative9(const GlslCase&, const glm::dvec4& v, int) {
    return relative(v, 9.0);
}
// blinnPhongNormaliser: exp2(-s/2) is off by (3 + s) 2^(-s/2) <= 4.1 of a denominator >= 1; sums
// and products 5, a quotient 2.5. lookupBlend: odds by 8, o / (1 + o) by 3.5.
Tolerance relative12(const GlslCase&, const glm::dvec4& v, int) {
    return relative(v, 12.0);
}
// lookupExponent: q by 9, the sum under the root by 11 (halved), inversesqrt 2, the exponent 6.
Tolerance relative15(const GlslCase&, const glm::dvec4& v, int) {
    return relative(v, 15.0);
}

Tolerance cosinePowerTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double x = static_cast<double>(p[0].x);
    const double s = static_cast<double>(p[0].y);
    if (x <= 0.0 || s == 0.0) {
        return same(0.0);
    }
    const double y = s * std::log2(x);
    return same(powerError(v.x, y, std::log(2.0) * (s * log2Error(x) + u * std::abs(y))));
}

Tolerance chordTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    return same(chordError(v.x, static_cast<double>(p[0].x), static_cast<double>(p[0].y), 0.0));
}

Tolerance betweenTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    // The difference rounds each component by u/2 of itself; squares and sums 3 u.
    const glm::dvec3 chord = vec(p[0]) - vec(p[1]);
    const double d = 0.5 * glm::dot(chord, chord);
    return same(chordError(v.x, d, static_cast<double>(p[0].w), 4.0 * u * d));
}

Tolerance mixTolerance(const GlslCase&, const glm::dvec4& v, int) {
    // A difference and a product, half a unit each of at most the value, and the sum.
    return relative(v, 2.0);
}

Tolerance normalizeTolerance(const GlslCase&, const glm::dvec4&, int) {
    return same(5.0 * u); // squares and sums 3 (halved), inversesqrt 2, product 1
}

Tolerance divisionTolerance(const GlslCase&, const glm::dvec4& v, int) {
    return relative(v, 2.5);
}

Tolerance mipLevelTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return same(mipLevelError(repaired(p[0].x), static_cast<double>(p[0].y)));
}

Tolerance footprintTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return same(footprintError(vec(p[0]), vec(p[1]), vec(p[2]), static_cast<double>(p[0].w), 0.0));
}

Tolerance texelSizeTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return same(texelSizeError(vec(p[0])));
}

Tolerance tentLevelTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return same(tentLevelError(vec(p[1]), repaired(p[0].x), static_cast<double>(p[0].y)));
}

Tolerance biasTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double cosine = std::clamp(static_cast<double>(p[0].y), 1e-6, 1.0);
    return same(0.5 * log2Error(cosine) + u * (std::abs(v.x) + 2.0));
}

Tolerance texelSolidAngleTolerance(const GlslCase&, const glm::dvec4& v, int) {
    // u and v by 6 each (a quotient of at most 2 and a difference), so 1 + u^2 + v^2 by 9 of
    // itself; inversesqrt 4.5 + 2, cubed 19.5 and two products; 4 / w^2 by 4.
    return relative(v, 26.0);
}

Tolerance exponentFromRoughnessTolerance(const GlslCase&, const glm::dvec4& v, int) {
    // 2 / r^4 by 4 (three products, a quotient); the difference from 2 leaves that absolute.
    return same(5.0 * u * (v.x + 2.0));
}

namespace {

/// exp(-l d), d off by dd: the product by half a unit, the rise to l by one, exp.
double sgError(double value, double d, double sharpness, double dd) {
    const double y = sharpness * d;
    return powerError(value, y, sharpness * dd + 2.0 * u * y);
}

/// A highlight's lobe of two unit vectors, and how far it may be off when h is by dh.
struct Lobe {
    double value = 0.0;
    double error = 0.0;
};
Lobe lobeOf(const glm::dvec3& n, const glm::dvec3& h, double s, double dh, int form) {
    const glm::dvec3 chord = n - h;
    const double d = 0.5 * glm::dot(chord, chord);
    const double dd = glm::length(chord) * (dh + u) + 4.0 * u * d;
    const double value = shader_double::lodestar_highlight(n, h, s, form);
    if (value <= 0.0) {
        return {};
    }
    return {value, form == shader_double::LODESTAR_LOBES_SG
                       ? sgError(value, d, s + shader_double::LODESTAR_SG_SHAPE, dd)
                       : chordError(value, d, s, dd)};
}

/// Both forms of Fresnel's weight have the same bounds: a slope of at most 5, and absolute6.
Tolerance directError(const GlslCase& p, int form) {
    const glm::dvec3 n = vec(p[0]);
    const glm::dvec3 v = vec(p[1]);
    const glm::dvec3 l = vec(p[2]);
    const double s = repaired(p[0].w);
    const glm::dvec3 h = shader_double::lodestar_safeNormalize(l + v, -n);
    const double nDotL = std::clamp(glm::dot(n, l), 0.0, 1.0);
    const double dh = 2.0 * u / std::max(glm::length(l + v), 1e-3) + 5.0 * u;
    const Lobe lobe = lobeOf(n, h, s, dh, form);
    const double normaliser = shader_double::lodestar_blinnPhongNormaliser(s);
    const double fresnelError = 5.0 * (dh + 3.0 * u) + 9.0 * u;
    // Reflectances are at most 1: lambert at most 1 / pi, the highlight normaliser times lobe.
    const double highlight = normaliser * (lobe.value * (fresnelError + 14.0 * u) + lobe.error);
    const double lambert = (fresnelError + 5.0 * u) / std::acos(-1.0);
    return same(nDotL * (highlight + lambert) + 4.0 * u * (normaliser * lobe.value + 0.32) + kTiny);
}

} // namespace

Tolerance directTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return directError(p, shader_double::LODESTAR_LOBES_POWER);
}

Tolerance directBySgTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return directError(p, shader_double::LODESTAR_LOBES_SG);
}

Tolerance highlightTolerance(const GlslCase& p, const glm::dvec4&, int) {
    // The vectors are the case's own, off by nothing; their difference rounds by u/2 of itself.
    const auto error = [&](int form) {
        return lobeOf(vec(p[0]), vec(p[1]), static_cast<double>(p[2].y), -u, form).error;
    };
    return {error(shader_double::LODESTAR_LOBES_SG), error(shader_double::LODESTAR_LOBES_POWER),
            0.0, 0.0};
}

// A sum and a quotient; turns up to 31, two products and a sum, of which the fraction is left.
Tolerance spiralTolerance(const GlslCase&, const glm::dvec4& v, int) {
    return {3.0 * u * v.x, 3.0 * 31.0 * u, 0.0, 0.0};
}

Tolerance tapOfDirectionTolerance(const GlslCase& p, const glm::dvec4& value, int) {
    const glm::dvec3 n = vec(p[0]);
    const glm::dvec3 v = vec(p[1]);
    const glm::dvec3 l = vec(p[2]);
    const double s = repaired(p[0].w);
    const glm::dvec3 h = shader_double::lodestar_safeNormalize(l + v, -n);
    const double dh = 2.0 * u / std::max(glm::length(l + v), 1e-3) + 5.0 * u;
    const double hDotV = std::max(glm::dot(h, v), 0.0);
    const double hDotVError = dh + 3.0 * u;
    const glm::dvec3 chord = n - h;
    const double d = 0.5 * glm::dot(chord, chord);
    const double lobe =
        glm::dot(n, h) > 0.0 ? shader_double::lodestar_cosinePowerFromChord(d, s) : 0.0;
    const double lobeError =
        lobe > 0.0 ? chordError(lobe, d, s, glm::length(chord) * (dh + u) + 4.0 * u * d) : 0.0;
    // s + 1, the product with pi and the quotient 6 u more.
    const double over = (s + 1.0) / (8.0 * std::acos(-1.0));
    const double least = std::max(hDotV - hDotVError, 1e-4);
    const double density = over * lobeError / least + value.y * (hDotVError / least + 6.0 * u);
    return {hDotVError + 3.0 * u * hDotV + u, density + kTiny, 0.0, 0.0};
}

// The point is off by 1.5 u of itself; a sine and a cosine by 2^-11, which is what [Vulkan] allows:
// GLSL says nothing.
Tolerance drawnTapTolerance(const GlslCase& p, const glm::dvec4&, int) {
    const double s = repaired(p[0].w);
    const double y = 0.0005 + 0.999 * static_cast<double>(p[4].y);
    const double x = std::log(y) / (s + 1.0);
    const double dx = (std::log(2.0) * log2Error(y) + 1.5 * u) / (s + 1.0) + 4.0 * u * std::abs(x);
    const double d = -std::expm1(x);
    const double dd = dx + 6.0 * u * d + (x < -0.0099 ? (4.0 + 2.0 * std::abs(x)) * u : 0.0);
    const double sine = std::sqrt(d * (2.0 - d));
    const double dSine = std::min(dd / std::max(sine, 1e-12), std::sqrt(2.0 * dd)) + 4.0 * u * sine;
    // h: its part along n, the sine along two axes, each off by the angle's functions and 8 u.
    const double dh = dd + 1.5 * (dSine + sine * (0x1p-11 + 8.0 * u)) + 4.0 * u;
    // l = 2 (h.v) h - v, made unit.
    const double direction = 4.0 * dh + 20.0 * u;
    return {direction, direction, direction, direction + dh + 8.0 * u};
}

// Products and a quotient 6 u under the logarithm (1.44 of them), then texelSizeLevel and two sums.
Tolerance tapLevelTolerance(const GlslCase& p, const glm::dvec4& v, int k) {
    const double texels = 0.4774648 * 65536.0 / (1024.0 * (0.001 + static_cast<double>(p[4].y)));
    GlslCase direction = p;
    direction[0] = p[2];
    return same(0.5 * (log2Error(texels) + 10.0 * u) + texelSizeTolerance(direction, v, k)[0] +
                2.0 * u * (std::abs(v.x) + 1.0));
}

Tolerance sh9Tolerance(const GlslCase& p, const glm::dvec4&, int) {
    // Each term is a coefficient times at most 2, four roundings (8 u), and eight sums of half a
    // unit of at most twice the coefficients' sum (8 u).
    Tolerance tolerance{};
    for (int k = 0; k < 3; ++k) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 9; ++i) {
            sum += std::abs(static_cast<double>(p[i][k]));
        }
        tolerance[static_cast<std::size_t>(k)] = 16.0 * u * sum;
    }
    return tolerance;
}

Tolerance srgbTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double x = std::clamp(static_cast<double>(p[0].x), 0.0, 1.0);
    if (x <= 0.0031308) {
        return relative(v, 1.5);
    }
    const double y = std::log2(x) / 2.4;
    const double dy = std::log(2.0) * (log2Error(x) / 2.4 + u * std::abs(y));
    return same(1.055 * powerError(std::exp2(y), y, dy) + 2.0 * u);
}

Tolerance linearTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double x = std::clamp(static_cast<double>(p[0].x), 0.0, 1.0);
    if (x <= 0.04045) {
        return relative(v, 1.5);
    }
    const double z = (x + 0.055) / 1.055;
    const double y = 2.4 * std::log2(z);
    const double dy = std::log(2.0) * (2.4 * (log2Error(z) + 1.45 * 2.0 * u) + u * std::abs(y));
    return same(powerError(v.x, y, dy));
}

Tolerance lookupTolerance(const GlslCase&, const glm::dvec4& v, int) {
    // r by 8 u; the blend by 12 u (16 with n.v's own 3 u), times |r - n| <= 2; the sum 3 u: 43 u of
    // a vector no shorter than 0.7 (n.v > 0), then normalised. The exponent: 15, and n.v's 3 u
    // through (n.v^2 + q (1 - n.v^2))^(-1/2), at most 3 / (2 sqrt q) = 7.8.
    return {67.0 * u, 67.0 * u, 67.0 * u, v.w * 23.0 * u};
}

Tolerance lookupAsGivenTolerance(const GlslCase&, const glm::dvec4&, int) {
    return {8.0 * u, 8.0 * u, 8.0 * u, 0.0}; // the exponent is handed on
}

Tolerance reflectedTolerance(const GlslCase&, const glm::dvec4&, int) {
    // Fresnel by 35 as below. Both lights are squares up to 1: u. Lambert's part has 3 more
    // products and 1 - F, the glossy part occlusion's 7 and 2 products; a sum of at most 2.
    return {85.0 * u, 85.0 * u, 85.0 * u, 0.0};
}

Tolerance hookTolerance(const GlslCase&, const glm::dvec4&, int) {
    return {2.0 * u, 2.0 * u, 0.0,
            0.0}; // one product and a sum; the level is selected, not computed
}

Tolerance specularMipTolerance(const GlslCase& p, const glm::dvec4& v, int specular) {
    Tolerance tolerance = hookTolerance(p, v, specular);
    tolerance[2] = mipLevelError(repaired(p[1].w), static_cast<double>(p[0].x));
    return tolerance;
}

Tolerance specularTentTolerance(const GlslCase& p, const glm::dvec4& v, int specular) {
    Tolerance tolerance = hookTolerance(p, v, specular);
    tolerance[2] = tentLevelError(vec(p[1]), repaired(p[1].w), static_cast<double>(p[0].x));
    return tolerance;
}

Tolerance specularTolerance(const GlslCase& p, const glm::dvec4&, int specular) {
    const glm::dvec3 n = vec(p[1]);
    const glm::dvec3 view = vec(p[2]);
    const glm::dvec3 r = 2.0 * glm::dot(n, view) * n - view;
    const double s = repaired(p[1].w);
    const double width = static_cast<double>(p[0].x);
    const double mip = mipLevelError(s, width);
    // r by 8 u, to be seen in red and green, and in the footprint.
    const double footprint = footprintError(r, vec(p[5]), vec(p[6]), width, 8.0 * u);
    if (specular == 0) {
        return {10.0 * u, 10.0 * u, mip, 0.0};
    }
    if (specular == 1) {
        return {10.0 * u, 10.0 * u, std::max(mip, footprint), 0.0};
    }
    if (specular == 2) {
        return {10.0 * u, 10.0 * u, footprint, 0.0};
    }
    if (specular == 7) {
        // The lookup as below: direction by 67 u, exponent by 23 u of itself.
        const double nDotV = std::clamp(glm::dot(n, view), 0.0, 1.0);
        const double level = prefilteredLevelError(shader_double::lodestar_lookupExponent(s, nDotV),
                                                   width, static_cast<double>(p[0].y), 23.0 * u);
        return {90.0 * u, 70.0 * u, std::max(level, footprint), 0.0};
    }
    if (specular > 3) {
        // The lookup's direction is off by 67 u, its exponent by 23 u of itself (see below).
        const double blend = shader_double::lodestar_lookupBlend(s, glm::dot(n, view));
        const glm::dvec3 direction = glm::normalize(glm::mix(n, r, blend));
        const TapErrors taps = tapErrors(direction, s, specular == 4 ? 3 : (specular == 5 ? 7 : 16),
                                         width, static_cast<double>(p[0].y), 67.0 * u, 23.0 * u);
        return {1.25 * taps.direction + 2.0 * u, taps.direction + 2.0 * u,
                std::max(taps.level, footprint), 0.0};
    }
    // The tent's lookup: direction by 67 u, through the size term's slope of at most 4; exponent by
    // 23 of itself, through half a logarithm (17) and kappa (5). The lookup's exponent lies in
    // [1, 1.3 s + 1]; a size term's log2 argument in [1, 3].
    const double level = mipLevelError(1.3 * s + 1.0, width) + mip +
                         0.73 * 0.2 * (log2Error(1.3 * s + 2.0) + 0x1p-21) +
                         texelSizeError(glm::dvec3(1.0)) + 0x1p-21 + (42.0 + 268.0 + 22.0) * u;
    return {90.0 * u, 70.0 * u, std::max(level, footprint), 0.0};
}

Tolerance environmentTolerance(const GlslCase& p, const glm::dvec4& v, int specular) {
    // Fresnel by 20, and 15 for n.v through the fifth power: 35. Lambert's part is at most 2, with
    // 3 more products; the glossy part is at most 1.25 in red and green, the last level in blue,
    // with occlusion's 7 and 2 products.
    const Tolerance glossy = specularTolerance(p, v, specular);
    const double lambert = 2.0 * (35.0 + 5.0) * u;
    const double lastLevel = static_cast<double>(p[0].y);
    return {glossy[0] + lambert + 1.25 * 45.0 * u, glossy[1] + lambert + 1.25 * 45.0 * u,
            glossy[2] + lambert + lastLevel * 45.0 * u, 0.0};
}

} // namespace lodestar::testing
