// SPDX-License-Identifier: MIT
//
// Exact zone weights of the cosine lobe: two algorithms against each other and against the oracles.
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "core/quadrature.h"
#include "lighting/rsrm_weights.h"
#include "lighting/zonal.h"
#include "numerics/oracles.h"

namespace lodestar::lighting {
namespace {

using testing::oracleCases;

constexpr double kPi = std::numbers::pi;
/// What the goals demand of F, Q and weights.
constexpr double kMass = 1e-9;

double number(const nlohmann::json& value) {
    return value.get<double>();
}

std::vector<double> anglesOf(const nlohmann::json& heights) {
    std::vector<double> angles;
    for (const auto& z : heights) {
        angles.push_back(std::acos(number(z)));
    }
    return angles;
}

double sumOf(const std::vector<double>& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

} // namespace

TEST(Quadrature, GaussRulesIntegratePolynomialsAndSumToOne) {
    for (const int n : {1, 2, 8, 64, 257}) {
        const core::GaussRule rule = core::gaussLegendre(n);
        double sum = 0.0;
        double power = 0.0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            sum += rule.weights[i];
            power += rule.weights[i] * std::pow(rule.nodes[i], 2 * n - 1);
        }
        EXPECT_NEAR(sum, 1.0, 1e-13) << n;
        EXPECT_NEAR(power, 1.0 / (2.0 * n), 1e-13) << n;
    }
}

TEST(RsrmOracles, CapMass) {
    for (const auto& one : oracleCases("rsrm_cap_mass")) {
        const auto& in = one["in"];
        const double f = number(one["out"]["F"]);
        const double got = capMass(number(in["theta_o"]), number(in["theta_b"]), number(in["s"]));
        EXPECT_NEAR(got, f, kMass) << in;
        if (f < 0.5) { // the small side keeps its own digits
            EXPECT_NEAR(got, f, 1e-8 * f) << in;
        }
    }
}

TEST(RsrmOracles, CapFirstExcess) {
    for (const auto& one : oracleCases("rsrm_cap_first_excess")) {
        const auto& in = one["in"];
        EXPECT_NEAR(capFirstExcess(number(in["theta_o"]), number(in["theta_b"]), number(in["s"])),
                    number(one["out"]["Q"]), kMass)
            << in;
    }
}

TEST(RsrmOracles, PoleMassHasAClosedForm) {
    for (const auto& one : oracleCases("rsrm_pole_mass")) {
        const auto& in = one["in"];
        EXPECT_NEAR(capMass(0.0, std::acos(number(in["z_b"])), number(in["s"])),
                    number(one["out"]["F"]), kMass)
            << in;
    }
}

TEST(RsrmOracles, ZoneDensityIsTheWeightOfANarrowZone) {
    for (const auto& one : oracleCases("rsrm_zone_density")) {
        const auto& in = one["in"];
        const double thetaO = std::acos(number(in["z_o"]));
        const double theta = std::acos(number(in["z"]));
        const double s = number(in["s"]);
        // Central differences at two steps, extrapolated: fourth order. The lobe is 1 / sqrt(s)
        // wide; at 1/200 of that the rest is 1e-8 and rounding 1e-9 of the density.
        const auto slope = [&](double h) {
            return (capMass(thetaO, theta + h, s) - capMass(thetaO, theta - h, s)) /
                   (2.0 * h * std::sin(theta));
        };
        const double h = 0.005 / std::sqrt(s + 1.0);
        const double density = number(one["out"]["w"]);
        EXPECT_NEAR((4.0 * slope(h) - slope(2.0 * h)) / 3.0, density, 1e-5 * density) << in;
    }
}

TEST(RsrmOracles, ZoneWeight) {
    for (const auto& one : oracleCases("rsrm_zone_weight")) {
        const auto& in = one["in"];
        const double s = number(in["s"]);
        const auto edges = zoneEdges({ZoneSpacing::EqualHeight, in["N"].get<int>()});
        const auto j = in["j"].get<std::size_t>();
        const double thetaO = std::acos(number(in["z_o"]));
        EXPECT_NEAR(ringWeights(thetaO, edges, s)[j], number(one["out"]["W"]), kMass) << in;
        if (s >= 2.0) {
            EXPECT_NEAR(legendreWeights(thetaO, edges, s)[j], number(one["out"]["W"]), 1e-7) << in;
        }
    }
}

TEST(RsrmOracles, FilteredConstantZones) {
    for (const auto& one : oracleCases("rsrm_filtered_constant")) {
        const auto& in = one["in"];
        const auto means = in["L"].get<std::vector<double>>();
        const auto edges = zoneEdges({ZoneSpacing::EqualHeight, static_cast<int>(means.size())});
        const auto weights = ringWeights(std::acos(number(in["z_o"])), edges, number(in["s"]));
        EXPECT_NEAR(std::inner_product(means.begin(), means.end(), weights.begin(), 0.0),
                    number(one["out"]["L_o"]), 100.0 * kMass)
            << in;
    }
}

TEST(RsrmOracles, FilteredLinearNodes) {
    for (const auto& one : oracleCases("rsrm_filtered_linear")) {
        const auto& in = one["in"];
        const auto values = in["L"].get<std::vector<double>>();
        const auto weights =
            nodeWeights(std::acos(number(in["z_o"])), anglesOf(in["z"]), number(in["s"]));
        EXPECT_NEAR(std::inner_product(values.begin(), values.end(), weights.begin(), 0.0),
                    number(one["out"]["L_o"]), 20.0 * kMass)
            << in;
    }
}

TEST(RsrmOracles, Eigenvalues) {
    for (const auto& one : oracleCases("funk_hecke_eigenvalue")) {
        const auto l = one["in"]["l"].get<int>();
        EXPECT_NEAR(funkHeckeEigenvalues(number(one["in"]["s"]),
                                         std::max(l, 1))[static_cast<std::size_t>(l)],
                    number(one["out"]["lam"]), 1e-12)
            << one["in"];
    }
}

TEST(RsrmOracles, PublishedRowSumsAtThePole) {
    for (const auto& one : oracleCases("rsrm_paper_rowsum_pole")) {
        const auto& in = one["in"];
        EXPECT_NEAR(sumOf(publishedWeights(0.0, in["N"].get<int>(), 2, number(in["s"]))),
                    number(one["out"]["sum"]), 1e-12)
            << in;
    }
}

// Rings of constant angle to r and Legendre series share nothing but the lobe.
TEST(RsrmWeights, TheTwoAlgorithmsAgree) {
    for (const ZoneSpacing spacing : {ZoneSpacing::EqualHeight, ZoneSpacing::Quartic}) {
        const auto edges = zoneEdges({spacing, 64});
        for (const double s : {2.0, 3.7, 16.0, 100.0, 2048.0, 20000.0}) {
            for (int i = 0; i <= 20; ++i) {
                const double thetaO = kPi * i / 20.0;
                const auto rings = ringWeights(thetaO, edges, s);
                const auto series = legendreWeights(thetaO, edges, s);
                for (std::size_t j = 0; j < rings.size(); ++j) {
                    ASSERT_NEAR(rings[j], series[j], 1e-7)
                        << "s " << s << " theta " << thetaO << " zone " << j;
                }
            }
        }
    }
}

TEST(RsrmWeights, RowsSumToOneAndAreNeverNegative) {
    for (const ZoneSpacing spacing : {ZoneSpacing::EqualHeight, ZoneSpacing::Quartic}) {
        const auto edges = zoneEdges({spacing, 256});
        for (const double s : {0.0, 0.5, 1.0, 2.0, 64.0, 2048.0, 1e6}) {
            for (const double thetaO : {0.0, 1e-4, 0.3, edges[77], kPi / 2.0, 2.9, kPi}) {
                const auto weights = ringWeights(thetaO, edges, s);
                EXPECT_NEAR(sumOf(weights), 1.0, 1e-12) << s << " " << thetaO;
                EXPECT_GE(*std::min_element(weights.begin(), weights.end()), 0.0);
                if (s >= 2.0 && s <= 2048.0) {
                    const auto series = legendreWeights(thetaO, edges, s);
                    EXPECT_NEAR(sumOf(series), 1.0, 1e-12) << s << " " << thetaO;
                    EXPECT_GE(*std::min_element(series.begin(), series.end()), 0.0);
                }
            }
        }
    }
}

// The cap begins where the lobe ends, a1 = pi / 2 less a few roundings: cos a1 is at most 2e-15,
// and no more than cos^{s+1} a1 is in the cap, at a height above its edge of at most 2.
TEST(RsrmWeights, ACapThatTouchesTheLobesEdgeIsEmpty) {
    const auto expectEmpty = [](double thetaO, double thetaB, double s) {
        const CapIntegral cap = smallSide(thetaO, thetaB, s);
        EXPECT_GE(cap.mass(s), 0.0) << thetaO << " " << thetaB << " " << s;
        EXPECT_LE(cap.mass(s), 2e-15) << thetaO << " " << thetaB << " " << s;
        EXPECT_LE(std::abs(cap.firstExcess(s)), 4e-15) << thetaO << " " << thetaB << " " << s;
        const auto weights = ringWeights(thetaO, std::vector<double>{0.0, thetaB, kPi}, s);
        EXPECT_LE(weights[0], 2e-15);
        EXPECT_EQ(weights[1], 1.0 - weights[0]);
    };
    for (const double s : {0.0, 0.5, 2.0, 16.0, 2048.0, 2e4, 1e6, 1e7}) {
        expectEmpty(2.0041751594432746, 0.43337883264838345, s);
        for (int i = 0; i < 200; ++i) {
            const double thetaO = kPi * (0.5 + (i + 0.5) / 400.0);
            double thetaB = thetaO - 0.5 * kPi;
            for (int ulp = 0; ulp < 4; ++ulp) {
                expectEmpty(thetaO, thetaB, s);
                thetaB = std::nextafter(thetaB, kPi);
            }
        }
    }
}

// A linear gradient a + b z is filtered to a + b lambda_1 z_o.
TEST(RsrmWeights, LinearRadianceIsExact) {
    const std::vector<double> nodes = {0.0, 0.4, 1.1, kPi / 2.0, 2.2, kPi};
    for (const double s : {0.0, 1.0, 7.25, 512.0, 1e5}) {
        for (const double thetaO : {0.0, 0.2, 1.3, 1.8, 3.0, kPi}) {
            const auto weights = nodeWeights(thetaO, nodes, s);
            double sum = 0.0;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                sum += weights[i] * (2.0 + std::cos(nodes[i]));
            }
            EXPECT_NEAR(sum, 2.0 + (s + 1.0) / (s + 2.0) * std::cos(thetaO), 1e-9)
                << s << " " << thetaO;
        }
    }
}

// A disc of 0.27 degrees about the axis: the weights keep 1e-7 of themselves where they are tiny.
TEST(RsrmWeights, ASunsDiscHasItsClosedFormAtTheAxis) {
    const std::vector<double> edges = {0.0, 0.27 * kPi / 180.0, kPi};
    for (const double s : {0.0, 1.0, 8.0, 2048.0, 1e6}) {
        const double half = std::sin(0.5 * edges[1]);
        const double exact = -std::expm1((s + 1.0) * std::log1p(-2.0 * half * half));
        EXPECT_NEAR(ringWeights(0.0, edges, s)[0], exact, 1e-9 * exact + 1e-12) << s;
        EXPECT_NEAR(ringWeights(1e-9, edges, s)[0], exact, 1e-6 * exact) << s;
    }
}

} // namespace lodestar::lighting
