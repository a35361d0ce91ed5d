// SPDX-License-Identifier: MIT
//
// Exact weights of zones under the clamped cosine lobe K(x) = (s + 1) / (2 pi) max(x, 0)^s: the
// share of the lobe about r that falls into each ring of directions about an axis. Two independent
// routes, by rings of constant angle to r and by Legendre series (docs/derivations/rsrm.md).
// Angles are polar, in radians [0, pi]; theta_o is r's; s is a Phong exponent, [0, 1e7].
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lodestar::lighting {

/// F: lobe mass inside the polar cap theta <= thetaB (RSRM-2). Within 1e-9, and to 1e-8 of itself
/// where it is the smaller side.
[[nodiscard]] double capMass(double thetaO, double thetaB, double s);

/// Q: the mean of max(z - cos(thetaB), 0) under the lobe (RSRM-4), the basis for radiance that is
/// linear in z between nodes. Within 1e-9.
[[nodiscard]] double capFirstExcess(double thetaO, double thetaB, double s);

/// Funk-Hecke eigenvalues of the lobe for degrees 0 to degree (RSRM-5). @pre degree >= 1
[[nodiscard]] std::vector<double> funkHeckeEigenvalues(double s, int degree);

/// Weights of the zones between edges (ascending, from 0 to pi), by rings: >= 0, sum 1 to 1e-12.
/// A zone holds its far edge.
[[nodiscard]] std::vector<double> ringWeights(double thetaO, std::span<const double> edges,
                                              double s);

/// The same by Legendre series, within 1e-7 for s >= 2. Clipped at 0 and made to sum to 1.
[[nodiscard]] std::vector<double> legendreWeights(double thetaO, std::span<const double> edges,
                                                  double s);

/// Weights of radiance at nodes (ascending, from 0 to pi), linear in z between them: sum 1.
[[nodiscard]] std::vector<double> nodeWeights(double thetaO, std::span<const double> nodes,
                                              double s);

/// The degree at which the series for s may end: max(512, 9 sqrt(s + 1)).
[[nodiscard]] int legendreDegree(double s);

/// Nodes of the ring integral over one cap, which exponents below kSharedNodes have in common:
/// the angle psi that the cap covers of each ring does not depend on s.
class CapIntegral {
public:
    static constexpr double kSharedNodes = 16.0;

    /// @pre thetaO >= thetaB  @param s the exponent, or anything below kSharedNodes for all those
    CapIntegral(double thetaO, double thetaB, double s);

    [[nodiscard]] double mass(double s) const;
    [[nodiscard]] double firstExcess(double s) const;

private:
    static constexpr int kNodes = 64;

    double thetaO_;
    double thetaB_;
    double fullRings_; ///< cos of the angle from which whole rings lie in the cap, 0 where none do
    int count_ = 0;
    double share_[kNodes];     ///< quadrature weight x (psi / pi) sin a
    double psi_[kNodes];       ///< half of the ring's part inside the cap, radians
    double sine_[kNodes];      ///< sin a
    double logCosine_[kNodes]; ///< log cos a
};

/// The integral over the cap's smaller side: the cap where r lies outside it, else its complement.
[[nodiscard]] CapIntegral smallSide(double thetaO, double thetaB, double s);

/// Zone weights from the masses of every edge's smaller side: differences where both are on one
/// side of r, what is left for the zone that holds r.
[[nodiscard]] std::vector<double>
weightsFromSmallSides(double thetaO, std::span<const double> edges, std::span<const double> small);

/// Stone's eq. 1 with its clamp and solid angle put right: the lobe sampled at the centres of zones
/// of equal height and at azimuths on half a circle, times 4 pi / (zones azimuths). Rows do not sum
/// to 1 where the lobe is narrower than a zone.
[[nodiscard]] std::vector<double> publishedWeights(double thetaO, int zones, int azimuths,
                                                   double s);

/// Legendre polynomials of the zones between edges, and rows of weights from them: what a kernel of
/// many rows shares.
class LegendreZones {
public:
    LegendreZones(std::span<const double> edges, int degree);

    [[nodiscard]] int degree() const { return degree_; }
    /// P_l(cos thetaO) for l from 0 to degree.
    [[nodiscard]] static std::vector<double> polynomials(double thetaO, int degree);
    /// Weights for r with these polynomials, clipped and normalised, a row an exponent.
    /// @param eigenvalues [row][degree + 1]  @param weights out, [row][zone]
    void weights(std::span<const double> polynomials, std::span<const double> eigenvalues,
                 std::span<double> weights) const;

private:
    int degree_;
    std::size_t zones_;
    std::vector<double> areas_; ///< half heights
    std::vector<double> steps_; ///< [degree][zone]: the zone's part of (P_{l-1} - P_{l+1}) / 2
};

} // namespace lodestar::lighting
