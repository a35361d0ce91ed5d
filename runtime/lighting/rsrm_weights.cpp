// SPDX-License-Identifier: MIT
#include "lighting/rsrm_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/contract.h"
#include "core/quadrature.h"
#include "lighting/vector_clones.h"
#include "lighting/zonal.h"

namespace lodestar::lighting {

namespace {

constexpr double kPi = std::numbers::pi;
/// The lobe's part below e^-45 of its value at the cap's edge is left out: 3e-20.
constexpr double kCut = 45.0;

struct FixedRule {
    std::array<double, 64> nodes, weights;
};

/// Gauss nodes are shared by all calls; built on first use, in memory that is nobody's.
const FixedRule& rule() {
    static const FixedRule shared = [] {
        const core::GaussRule made = core::gaussLegendre(64);
        FixedRule fixed{};
        std::copy(made.nodes.begin(), made.nodes.end(), fixed.nodes.begin());
        std::copy(made.weights.begin(), made.weights.end(), fixed.weights.begin());
        return fixed;
    }();
    return shared;
}

/// cos^s a with 0^0 = 1.
double power(double logCosine, double s) {
    return s == 0.0 ? 1.0 : std::exp(s * logCosine);
}

/// Sine and cosine of an angle.
struct Turn {
    double sine, cosine;
    explicit Turn(double angle) : sine(std::sin(angle)), cosine(std::cos(angle)) {}
    Turn(double itsSine, double itsCosine) : sine(itsSine), cosine(itsCosine) {}
    [[nodiscard]] Turn plus(const Turn& by) const {
        return {sine * by.cosine + cosine * by.sine, cosine * by.cosine - sine * by.sine};
    }
    [[nodiscard]] Turn minus(const Turn& by) const {
        return {sine * by.cosine - cosine * by.sine, cosine * by.cosine + sine * by.sine};
    }
};

/// (sin psi - psi cos psi) / psi, by its series where the difference cancels.
double excessOfShare(double psi) {
    if (psi < 0.3) {
        const double p = psi * psi;
        return p / 3.0 * (1.0 - p / 10.0 * (1.0 - p / 28.0 * (1.0 - p / 54.0)));
    }
    return std::sin(psi) / psi - std::cos(psi);
}

/// log cos a with its digits about 0, -infinity where rounding puts a at pi / 2.
/// @param half sin(a / 2), a in [0, pi / 2]
double logCosine(double half) {
    return std::log1p(-std::min(2.0 * half * half, 1.0));
}

/// The angle beyond which the lobe is below e^-45 of what it is at angle a1.
double cutAngle(double a1, double s) {
    const double v = -std::expm1(logCosine(std::sin(0.5 * a1)) - kCut / (s + 1.0));
    return 2.0 * std::asin(std::sqrt(std::min(0.5 * v, 1.0)));
}

constexpr std::size_t kStrip = 8; ///< degrees added at once

LODESTAR_VECTOR_CLONES void addStrip(double* __restrict out, const double* __restrict steps,
                                     const double* __restrict factors, std::size_t count) {
    for (std::size_t j = 0; j < count; ++j) {
        double sum = out[j];
        for (std::size_t k = 0; k < kStrip; ++k) {
            sum += factors[k] * steps[k * count + j];
        }
        out[j] = sum;
    }
}

void clipAndNormalise(std::span<double> weights) {
    double sum = 0.0;
    for (double& weight : weights) {
        weight = std::max(weight, 0.0);
        sum += weight;
    }
    for (double& weight : weights) {
        weight /= sum;
    }
}

} // namespace

CapIntegral::CapIntegral(double thetaO, double thetaB, double s)
    : thetaO_(thetaO), thetaB_(thetaB) {
    LODESTAR_EXPECT(thetaO >= thetaB, "r lies outside the cap");
    const double a1 = thetaO - thetaB;
    const double sum = thetaO + thetaB;
    const double a2 = std::min(sum, 2.0 * kPi - sum);
    fullRings_ = sum > kPi && a2 < 0.5 * kPi ? std::cos(a2) : 0.0;
    if (a1 >= 0.5 * kPi || a2 <= a1) {
        return;
    }
    const double sharp = s >= kSharedNodes ? cutAngle(a1, s) : kPi;
    const double end = std::min({a2, 0.5 * kPi, sharp});
    // a = a1 + (a2 - a1) sin^2(pi x / 2) takes the square roots off both ends; where the lobe's own
    // end at pi / 2 is the nearer one, x = end (1 - (1 - y)^3) smooths its power too (RSRM-3).
    const bool cubic = s < kSharedNodes && a2 > 0.5 * kPi;
    // Just below pi / 2 rounding may put the end before a1.
    const double covered = std::max(end - a1, 0.0);
    const double xEnd = end >= a2 ? 1.0 : 2.0 / kPi * std::asin(std::sqrt(covered / (a2 - a1)));
    // Sines of sums from a node's one angle: most of a kernel's time would be sines otherwise.
    const Turn halfNear(0.5 * a1);
    const Turn halfWidth(0.5 * (a2 - a1));
    const Turn outer(sum <= kPi ? thetaO : thetaB);
    count_ = kNodes;
    for (std::size_t i = 0; i < kNodes; ++i) {
        const double y = rule().nodes[i];
        const double x = cubic ? xEnd * (1.0 - (1.0 - y) * (1.0 - y) * (1.0 - y)) : xEnd * y;
        const double dx = cubic ? 3.0 * xEnd * (1.0 - y) * (1.0 - y) : xEnd;
        const Turn place(0.5 * kPi * x);
        const double fromNear = (a2 - a1) * place.sine * place.sine; // a - a1, not subtracted
        const double toFar = (a2 - a1) * place.cosine * place.cosine;
        // Of half of each the smaller is taken itself, so that neither's sine cancels.
        const Turn smaller(0.5 * std::min(fromNear, toFar));
        const Turn other = halfWidth.minus(smaller);
        const Turn& near = fromNear < toFar ? smaller : other;
        const Turn& far = fromNear < toFar ? other : smaller;
        const Turn half = halfNear.plus(near); // a / 2
        // One of sin((sum - a) / 2) and sin((sum + a) / 2) vanishes at a2.
        const double less = sum <= kPi ? far.sine : outer.minus(near).sine;
        const double more = sum <= kPi ? outer.plus(near).sine : far.sine;
        psi_[i] = 2.0 * std::atan2(std::sqrt(near.sine * less),
                                   std::sqrt(more * half.plus(halfNear).sine));
        sine_[i] = 2.0 * half.sine * half.cosine;
        const double da = (a2 - a1) * kPi * place.sine * place.cosine * dx;
        share_[i] = rule().weights[i] * psi_[i] / kPi * sine_[i] * da;
        logCosine_[i] = logCosine(half.sine);
    }
}

double CapIntegral::mass(double s) const {
    double sum = 0.0;
    for (int i = 0; i < count_; ++i) {
        sum += share_[i] * power(logCosine_[i], s);
    }
    return (s + 1.0) * sum + (fullRings_ > 0.0 ? std::pow(fullRings_, s + 1.0) : 0.0);
}

double CapIntegral::firstExcess(double s) const {
    double sum = 0.0;
    for (int i = 0; i < count_; ++i) {
        sum += share_[i] * sine_[i] * excessOfShare(psi_[i]) * power(logCosine_[i], s);
    }
    sum *= std::sin(thetaO_);
    const double rings =
        fullRings_ > 0.0
            ? std::pow(fullRings_, s + 1.0) *
                  (std::cos(thetaO_) * (s + 1.0) / (s + 2.0) * fullRings_ - std::cos(thetaB_))
            : 0.0;
    return (s + 1.0) * sum + rings;
}

CapIntegral smallSide(double thetaO, double thetaB, double s) {
    return thetaO >= thetaB ? CapIntegral(thetaO, thetaB, s)
                            : CapIntegral(kPi - thetaO, kPi - thetaB, s);
}

double capMass(double thetaO, double thetaB, double s) {
    return thetaO >= thetaB ? CapIntegral(thetaO, thetaB, s).mass(s)
                            : 1.0 - CapIntegral(kPi - thetaO, kPi - thetaB, s).mass(s);
}

double capFirstExcess(double thetaO, double thetaB, double s) {
    if (thetaO >= thetaB) {
        return CapIntegral(thetaO, thetaB, s).firstExcess(s);
    }
    return std::cos(thetaO) * (s + 1.0) / (s + 2.0) - std::cos(thetaB) +
           CapIntegral(kPi - thetaO, kPi - thetaB, s).firstExcess(s);
}

std::vector<double> funkHeckeEigenvalues(double s, int degree) {
    LODESTAR_EXPECT(degree >= 1, "there are eigenvalues of degrees 0 and 1 at least");
    std::vector<double> lambda(static_cast<std::size_t>(degree) + 1);
    lambda[0] = 1.0;
    lambda[1] = (s + 1.0) / (s + 2.0);
    for (std::size_t l = 0; l + 2 < lambda.size(); ++l) {
        const auto order = static_cast<double>(l);
        lambda[l + 2] = lambda[l] * (s - order) / (s + order + 3.0);
    }
    return lambda;
}

std::vector<double> weightsFromSmallSides(double thetaO, std::span<const double> edges,
                                          std::span<const double> small) {
    std::vector<double> weights(edges.size() - 1);
    double others = 0.0;
    std::size_t own = 0;
    for (std::size_t j = 0; j + 1 < edges.size(); ++j) {
        const bool above = edges[j + 1] <= thetaO;
        const bool below = edges[j] > thetaO;
        if (!above && !below) {
            own = j;
            continue;
        }
        weights[j] = std::max(above ? small[j + 1] - small[j] : small[j] - small[j + 1], 0.0);
        others += weights[j];
    }
    if (thetaO >= edges.back()) {
        own = weights.size() - 1; // r at the far pole lies on the last zone's far edge
        others -= weights[own];
    }
    weights[own] = std::max(1.0 - others, 0.0);
    return weights;
}

std::vector<double> ringWeights(double thetaO, std::span<const double> edges, double s) {
    LODESTAR_EXPECT(edges.size() >= 2, "a map has a zone");
    std::vector<double> small(edges.size());
    for (std::size_t j = 0; j < edges.size(); ++j) {
        small[j] = smallSide(thetaO, edges[j], s).mass(s);
    }
    return weightsFromSmallSides(thetaO, edges, small);
}

int legendreDegree(double s) {
    return std::max(512, static_cast<int>(std::ceil(9.0 * std::sqrt(s + 1.0))));
}

std::vector<double> legendreWeights(double thetaO, std::span<const double> edges, double s) {
    const LegendreZones zones(edges, legendreDegree(s));
    std::vector<double> weights(edges.size() - 1);
    zones.weights(LegendreZones::polynomials(thetaO, zones.degree()),
                  funkHeckeEigenvalues(s, zones.degree()), weights);
    return weights;
}

std::vector<double> nodeWeights(double thetaO, std::span<const double> nodes, double s) {
    LODESTAR_EXPECT(nodes.size() >= 2, "radiance is linear between two nodes at least");
    // Between nodes i and i + 1 the mean of F over z is (Q_{i+1} - Q_i) / (z_i - z_{i+1}); a hat is
    // the difference of two such means (RSRM-4).
    std::vector<double> weights(nodes.size());
    double before = 0.0;
    double excess = capFirstExcess(thetaO, nodes[0], s);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const double next = capFirstExcess(thetaO, nodes[i + 1], s);
        const double mean = (next - excess) / (2.0 * ringArea(nodes[i], nodes[i + 1]));
        weights[i] = mean - before;
        before = mean;
        excess = next;
    }
    weights.back() = 1.0 - before;
    return weights;
}

LegendreZones::LegendreZones(std::span<const double> edges, int degree)
    : degree_(degree), zones_(edges.size() - 1), areas_(zones_),
      steps_((static_cast<std::size_t>(degree) + 1 + kStrip) * zones_) {
    LODESTAR_EXPECT(edges.size() >= 2 && degree >= 1, "a map has a zone and a degree");
    for (std::size_t j = 0; j < zones_; ++j) {
        areas_[j] = ringArea(edges[j], edges[j + 1]);
    }
    // (P_{l-1} - P_{l+1}) / 2 is the integral of (2 l + 1) / 2 P_l from z to 1; 0 at both poles.
    for (std::size_t j = 1; j < zones_; ++j) {
        const std::vector<double> p = polynomials(edges[j], degree + 1);
        for (std::size_t l = 1; l <= static_cast<std::size_t>(degree); ++l) {
            const double cap = 0.5 * (p[l - 1] - p[l + 1]);
            steps_[l * zones_ + j - 1] += cap;
            steps_[l * zones_ + j] -= cap;
        }
    }
}

std::vector<double> LegendreZones::polynomials(double thetaO, int degree) {
    std::vector<double> p(static_cast<std::size_t>(degree) + 1);
    const double z = std::cos(thetaO);
    p[0] = 1.0;
    p[1] = z;
    for (std::size_t l = 1; l + 1 < p.size(); ++l) {
        const auto order = static_cast<double>(l);
        p[l + 1] = ((2.0 * order + 1.0) * z * p[l] - order * p[l - 1]) / (order + 1.0);
    }
    return p;
}

void LegendreZones::weights(std::span<const double> polynomials,
                            std::span<const double> eigenvalues, std::span<double> weights) const {
    const std::size_t terms = static_cast<std::size_t>(degree_) + 1;
    const std::size_t rows = weights.size() / zones_;
    LODESTAR_EXPECT(polynomials.size() == terms && eigenvalues.size() == rows * terms &&
                        weights.size() == rows * zones_,
                    "one polynomial and eigenvalue a degree, one weight a zone");
    for (std::size_t row = 0; row < rows; ++row) {
        std::copy(areas_.begin(), areas_.end(),
                  weights.begin() + static_cast<std::ptrdiff_t>(row * zones_));
    }
    // Eight degrees of one row at a time, so that its weights stay in the registers' reach.
    for (std::size_t l = 1; l < terms; l += kStrip) {
        const std::size_t end = std::min(l + kStrip, terms);
        for (std::size_t row = 0; row < rows; ++row) {
            double largest = 0.0;
            double factors[kStrip] = {};
            for (std::size_t k = l; k < end; ++k) {
                factors[k - l] = eigenvalues[row * terms + k] * polynomials[k];
                largest = std::max(largest, std::abs(factors[k - l]));
            }
            if (largest > 1e-18) {
                addStrip(weights.data() + row * zones_, steps_.data() + l * zones_, factors,
                         zones_);
            }
        }
    }
    for (std::size_t row = 0; row < rows; ++row) {
        clipAndNormalise(weights.subspan(row * zones_, zones_));
    }
}

std::vector<double> publishedWeights(double thetaO, int zones, int azimuths, double s) {
    LODESTAR_EXPECT(zones >= 1 && azimuths >= 1, "there are zones and azimuths");
    std::vector<double> weights(static_cast<std::size_t>(zones));
    const double sine = std::sin(thetaO);
    const double cosine = std::cos(thetaO);
    for (std::size_t j = 0; j < weights.size(); ++j) {
        const double z = 1.0 - (2.0 * static_cast<double>(j) + 1.0) / zones;
        const double across = sine * std::sqrt(1.0 - z * z);
        double sum = 0.0;
        for (int m = 0; m < azimuths; ++m) {
            const double x = cosine * z + across * std::cos(kPi * (m + 0.5) / azimuths);
            sum += x > 0.0 ? std::pow(x, s) : 0.0;
        }
        weights[j] = 2.0 * (s + 1.0) / (static_cast<double>(zones) * azimuths) * sum;
    }
    return weights;
}

} // namespace lodestar::lighting
