// SPDX-License-Identifier: MIT
//
// What rows of a map cost and gain: memory, the kernel and a bake, a row that moves, and the error
// at exponents that a scene looks up, for the default rows, for fewer and for rows put where its
// materials are. Usage: bench-rows
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include "numerics/rsrm_sources.h"

#include "lodestar/lobes.glsl"

namespace {

using namespace lodestar;
using namespace lodestar::lighting;
using testing::RsrmSource;

/// Blinn-Phong exponents of materials of the editor's first scene.
constexpr float kMaterials[] = {4.0f, 24.0f, 32.0f, 256.0f, 2048.0f, 16384.0f};
constexpr int kAngles = 300;

/// Of the processor: others keep the machine busy.
template <class Do>
double milliseconds(const Do& work) {
    const std::clock_t start = std::clock();
    work();
    return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Exponents of a material's lookups, from the widest lobe, at the silhouette, to the sharpest.
std::vector<double> lookupsOf(float exponent) {
    std::vector<double> all;
    for (const float nDotV : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
        all.push_back(static_cast<double>(shader::lodestar_lookupExponent(exponent, nDotV)));
    }
    std::sort(all.begin(), all.end());
    return all;
}

/// Radiance of a source in a direction, uniform in u2.
std::vector<glm::vec3> gradientOf(const RsrmSource& source) {
    std::vector<glm::vec3> radiance;
    for (const double theta : columnAngles(RsrmColumns::Refined, kGradientColumns)) {
        const double z = std::cos(theta);
        radiance.emplace_back(source.disc > 0.0 ? (theta <= source.disc ? 1.0 : 0.0)
                              : z > 0.0         ? 1.0 - 0.75 * z
                                                : 0.15 + 0.1 * z);
    }
    return radiance;
}

/// Over the lobe's peak, of an exponent's directions: RMS, worst.
struct Error {
    double squares = 0.0, worst = 0.0;
    int count = 0;
    void add(const RsrmTexels& texels, std::span<const glm::vec3> gradient,
             const RsrmSource& source, double exponent) {
        const double peak = std::max(source.exact(0.0, exponent), source.exact(1.57, exponent));
        for (int i = 0; i <= kAngles; ++i) {
            const double t = static_cast<double>(i) / kAngles;
            const double theta = t * t * std::numbers::pi;
            const auto got = static_cast<double>(rsrmRadiance(texels, gradient, theta, exponent).g);
            const double off = std::abs(got - source.exact(theta, exponent)) / peak;
            squares += off * off;
            worst = std::max(worst, off);
            ++count;
        }
    }
    [[nodiscard]] double rms() const { return std::sqrt(squares / count); }
};

RsrmTexels texelsOf(RsrmKernels& kernels, const RsrmLayout& layout, const RsrmSource& source) {
    const auto kernel = kernels.get(layout, source.kind);
    return encode(layout, kernel->bake(source.zonal(kernel->zones())));
}

void printErrors(RsrmKernels& kernels, const char* name, const RsrmLayout& layout) {
    double kernel = 0.0;
    for (const LightKind kind : {LightKind::Sky, LightKind::Sun}) {
        RsrmKernels anew;
        kernel += 0.5 * milliseconds([&] { (void)anew.get(layout, kind); });
    }
    std::vector<double> bakes;
    for (int i = 0; i < 31; ++i) {
        const auto own = kernels.get(layout, LightKind::Sun);
        const ZonalRadiance zonal = testing::kRsrmSources[0].zonal(own->zones());
        bakes.push_back(milliseconds([&] { (void)encode(layout, own->bake(zonal)); }));
    }
    std::printf("%s: %d rows, %zu bytes, kernel %.0f ms, bake and texels %.2f ms\n", name,
                layout.rows, texelBytes(layout), kernel, median(bakes));
    for (const RsrmSource& source : testing::kRsrmSources) {
        const RsrmTexels texels = texelsOf(kernels, layout, source);
        const std::vector<glm::vec3> gradient = gradientOf(source);
        std::printf("    %-12s", source.name);
        Error all;
        for (const float material : kMaterials) {
            Error own;
            for (const double exponent : lookupsOf(material)) {
                own.add(texels, gradient, source, exponent);
                all.add(texels, gradient, source, exponent);
            }
            std::printf("  %5g: %.4f / %.4f", static_cast<double>(material), own.rms(), own.worst);
        }
        Error others;
        for (int i = 0; i <= 40; ++i) {
            others.add(texels, gradient, source, 2.0 * std::pow(2049.0 / 2.0, i / 40.0) - 1.0);
        }
        std::printf("  all: %.4f / %.4f  1 to 2048: %.4f / %.4f\n", all.rms(), all.worst,
                    others.rms(), others.worst);
    }
}

void printMoves() {
    for (const LightKind kind : {LightKind::Sky, LightKind::Sun}) {
        RsrmKernels kernels;
        const std::vector<double> usual = rowExponents(kRsrm);
        const double first = milliseconds([&] { (void)kernels.get(rsrmWithRows(usual), kind); });
        std::printf("%s: all rows %.0f ms; a row that moves:",
                    kind == LightKind::Sky ? "sky" : "sun", first);
        for (const std::size_t row : {1u, 4u, 8u, 12u, 16u, 20u, 23u}) {
            std::vector<double> times;
            for (int i = 1; i <= 9; ++i) {
                std::vector<double> rows = usual;
                rows[row] *= 1.0 + 0.002 * i;
                times.push_back(milliseconds([&] { (void)kernels.get(rsrmWithRows(rows), kind); }));
            }
            std::printf("  s %.4g %.1f ms", usual[row], median(times));
        }
        std::printf("\n");
    }
}

/// Two rows at the ends of each material's lookups, kept apart.
std::vector<double> atMaterials() {
    std::vector<double> rows;
    for (const float material : kMaterials) {
        const std::vector<double> lookups = lookupsOf(material);
        rows.push_back(std::clamp(lookups.front(), kLeastOwnExponent, kGreatestOwnExponent));
        rows.push_back(std::clamp(lookups.back(), kLeastOwnExponent, kGreatestOwnExponent));
    }
    std::sort(rows.begin(), rows.end());
    for (std::size_t i = 1; i < rows.size(); ++i) {
        rows[i] = std::max(rows[i], 1.0101 * rows[i - 1]);
    }
    rows.back() = std::min(rows.back(), kGreatestOwnExponent);
    return rows;
}

std::vector<double> evenly(int count, double least, double most) {
    std::vector<double> rows;
    for (int i = 0; i < count; ++i) {
        rows.push_back((least + 1.0) * std::pow((most + 1.0) / (least + 1.0),
                                                static_cast<double>(i) / (count - 1)) -
                       1.0);
    }
    rows.front() = least;
    rows.back() = most;
    return rows;
}

} // namespace

int main() {
    RsrmKernels kernels;
    for (const float material : kMaterials) {
        const std::vector<double> lookups = lookupsOf(material);
        std::printf("material %g looks up %.4g to %.4g\n", static_cast<double>(material),
                    lookups.front(), lookups.back());
    }
    std::printf("errors over the lobe's peak, RMS / worst, by material\n");
    printErrors(kernels, "default", kRsrm);
    printErrors(kernels, "12 evenly, 1 to 2048", rsrmWithRows(evenly(12, 1.0, 2048.0)));
    printErrors(kernels, "12 at the materials", rsrmWithRows(atMaterials()));
    printErrors(kernels, "24 evenly, 1 to 8192", rsrmWithRows(evenly(24, 1.0, 8192.0)));
    printErrors(kernels, "24 evenly, 1 to 16384", rsrmWithRows(evenly(24, 1.0, 16384.0)));
    printErrors(kernels, "12 evenly, 1 to 16384", rsrmWithRows(evenly(12, 1.0, 16384.0)));
    printErrors(kernels, "24 evenly, 8 to 512", rsrmWithRows(evenly(24, 8.0, 512.0)));
    printMoves();
    return 0;
}
