// SPDX-License-Identifier: MIT
//
// Fits the lookup conversion of shaders/lodestar/lobes.glsl (docs/derivations/lookup.md): run it to
// get the constants and the error tables again. Takes about a minute.
#define LODESTAR_DOUBLE_PRECISION
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>

#include "lodestar/lobes.glsl"
#include "numerics/blinn_lobe.h"

namespace {

using lodestar::testing::BlinnLobe;

/// Constants of LOOK-7 and LOOK-8.
constexpr std::size_t kCount = 6;
using Constants = std::array<double, kCount>;

double g7(double s) {
    return lodestar::shader_double::lodestar_phongFromBlinnPhong(s);
}

double blend(const Constants& p, double s, double c) {
    const double odds = p[0] * s / std::sqrt(1.0 + p[1] * s) + p[2] * c * s * s / (s + p[3]);
    return odds / (1.0 + odds);
}

double phongExponent(const Constants& p, double s, double c) {
    const double rise = 1.0 + s * p[5];
    const double q = p[4] + (1.0 - p[4]) / (rise * rise);
    return g7(s) / std::sqrt(c * c + q * (1.0 - c * c));
}

struct Case {
    double exponent;
    double degrees;
    BlinnLobe lobe;
    double bestError = 0.0;
    double bestBlend = 0.0;
    double bestFactor = 1.0;
};

double minimise(const std::function<double(double)>& f, double a, double b) {
    constexpr double kGolden = 0.6180339887498949;
    double c = b - kGolden * (b - a);
    double d = a + kGolden * (b - a);
    double fc = f(c);
    double fd = f(d);
    for (int i = 0; i < 40; ++i) {
        if (fc < fd) {
            b = d;
            d = c;
            fd = fc;
            c = b - kGolden * (b - a);
            fc = f(c);
        } else {
            a = c;
            c = d;
            fc = fd;
            d = a + kGolden * (b - a);
            fd = f(d);
        }
    }
    return 0.5 * (a + b);
}

double errorOf(const Constants& p, const Case& item) {
    const double c = std::cos(item.degrees * std::numbers::pi / 180.0);
    return item.lobe.phongError(item.lobe.direction(blend(p, item.exponent, c)),
                                phongExponent(p, item.exponent, c));
}

/// The best blend and exponent of one case by turns; both are smooth and nearly independent.
void findBest(Case& item) {
    const double start = std::log(g7(item.exponent));
    double t = item.exponent / (item.exponent + 4.0);
    double logExponent = start;
    for (int turn = 0; turn < 8; ++turn) {
        const double reach = (1.0 - t) * 0.9 + 1e-9;
        t = minimise(
            [&](double x) {
                return item.lobe.phongError(item.lobe.direction(x), std::exp(logExponent));
            },
            std::max(t - reach, 0.0), std::min(t + reach, 1.0));
        logExponent = minimise(
            [&](double x) { return item.lobe.phongError(item.lobe.direction(t), std::exp(x)); },
            start - 0.2, start + 1.9);
    }
    item.bestBlend = t;
    item.bestFactor = std::exp(logExponent - start);
    item.bestError = item.lobe.phongError(item.lobe.direction(t), std::exp(logExponent));
}

/// Mean over the cases of the squared error: what no conversion can remove stays in, which weighs
/// the cases but does not move the optimum.
double objective(const Constants& p, const std::vector<Case>& cases) {
    double sum = 0.0;
    for (const double x : p) {
        if (!(x > 0.0)) {
            return 1e9;
        }
    }
    for (const Case& item : cases) {
        const double e = errorOf(p, item);
        sum += e * e - item.bestError * item.bestError;
    }
    return sum / static_cast<double>(cases.size());
}

/// Nelder and Mead's simplex, in the logarithms of the constants.
Constants fit(const Constants& start, const std::vector<Case>& cases, int steps) {
    const auto value = [&](const Constants& logs) {
        Constants p{};
        for (std::size_t i = 0; i < kCount; ++i) {
            p[i] = std::exp(logs[i]);
        }
        return objective(p, cases);
    };
    std::vector<std::pair<double, Constants>> simplex;
    Constants logs{};
    for (std::size_t i = 0; i < kCount; ++i) {
        logs[i] = std::log(start[i]);
    }
    simplex.emplace_back(value(logs), logs);
    for (std::size_t i = 0; i < kCount; ++i) {
        Constants moved = logs;
        moved[i] += 0.2;
        simplex.emplace_back(value(moved), moved);
    }
    const auto along = [&](const Constants& centre, const Constants& worst, double k) {
        Constants p{};
        for (std::size_t i = 0; i < kCount; ++i) {
            p[i] = centre[i] + k * (worst[i] - centre[i]);
        }
        return std::pair{value(p), p};
    };
    for (int step = 0; step < steps; ++step) {
        std::sort(simplex.begin(), simplex.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        Constants centre{};
        for (std::size_t v = 0; v < kCount; ++v) {
            for (std::size_t i = 0; i < kCount; ++i) {
                centre[i] += simplex[v].second[i] / static_cast<double>(kCount);
            }
        }
        auto& worst = simplex.back();
        const auto reflected = along(centre, worst.second, -1.0);
        if (reflected.first < simplex.front().first) {
            const auto expanded = along(centre, worst.second, -2.0);
            worst = expanded.first < reflected.first ? expanded : reflected;
        } else if (reflected.first < simplex[kCount - 1].first) {
            worst = reflected;
        } else {
            const auto contracted =
                along(centre, worst.second, reflected.first < worst.first ? -0.5 : 0.5);
            if (contracted.first < worst.first) {
                worst = contracted;
            } else {
                for (std::size_t v = 1; v <= kCount; ++v) {
                    simplex[v] = along(simplex[0].second, simplex[v].second, 0.5);
                }
            }
        }
    }
    std::sort(simplex.begin(), simplex.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    Constants p{};
    for (std::size_t i = 0; i < kCount; ++i) {
        p[i] = std::exp(simplex[0].second[i]);
    }
    return p;
}

constexpr std::array kTableAngles{0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0};
constexpr std::array kTableExponents{0.0,  0.5,  1.0,   2.0,    4.0,     8.0,     16.0,
                                     32.0, 64.0, 256.0, 1024.0, 16384.0, 100000.0};

void printTable(const char* title, const std::function<double(const Case&)>& value,
                bool best = false) {
    std::printf("\n%s\n|      s |", title);
    for (const double degrees : kTableAngles) {
        std::printf(" %4.0f |", degrees);
    }
    std::printf("\n");
    for (const double s : kTableExponents) {
        std::printf("| %6.6g |", s);
        for (const double degrees : kTableAngles) {
            // near the horizon a sharp lobe needs more nodes; these are converged to 1e-3
            Case item{s, degrees, BlinnLobe(s, degrees * std::numbers::pi / 180.0, 96, 160)};
            if (best) {
                findBest(item);
            }
            std::printf(" %.3f |", value(item));
        }
        std::printf("\n");
    }
}

} // namespace

int main() {
    std::vector<Case> cases;
    for (double s = 0.25; s < 1.1e5; s *= 2.0) {
        for (const double degrees :
             {10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0}) {
            cases.push_back({s, degrees, BlinnLobe(s, degrees * std::numbers::pi / 180.0, 32, 48)});
            findBest(cases.back());
        }
    }
    const Constants fitted = fit({0.12, 0.1, 0.24, 10.0, 0.048, 0.4}, cases, 500);
    std::printf("blend: a %.6g d %.6g b %.6g f %.6g   exponent: q %.6g k %.6g\n", fitted[0],
                fitted[1], fitted[2], fitted[3], fitted[4], fitted[5]);
    std::printf("mean excess of the squared error: %.3g\n", objective(fitted, cases));

    namespace shader = lodestar::shader_double;
    printTable("before: about r, exponent s",
               [](const Case& c) { return c.lobe.phongError(c.lobe.reflection(), c.exponent); });
    printTable("about r, exponent by LOOK-5", [](const Case& c) {
        return c.lobe.phongError(c.lobe.reflection(), g7(c.exponent));
    });
    printTable(
        "best possible", [](const Case& c) { return c.bestError; }, true);
    printTable(
        "best blend", [](const Case& c) { return c.bestBlend; }, true);
    printTable(
        "best factor", [](const Case& c) { return c.bestFactor; }, true);
    printTable("this fit", [&](const Case& c) { return errorOf(fitted, c); });
    return 0;
}
