// SPDX-License-Identifier: MIT
#include "lighting/rsrm_kernel.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/contract.h"
#include "core/shared_memory.h"
#include "lighting/rsrm_weights.h"
#include "lighting/vector_clones.h"

namespace lodestar::lighting {

namespace {

constexpr int kPublishedAzimuths = 128;

/// Below this exponent rings, from it on series. About the axis a sun's zones are so small that the
/// series' cut tail (5e-9 of the lobe at s = 2) is not small beside their weights.
double seriesFrom(ZoneSpacing spacing) {
    return spacing == ZoneSpacing::EqualHeight ? 2.0 : 8.0;
}

/// out += four zones' radiance times their weights; four at once halves the roundings' growth.
LODESTAR_VECTOR_CLONES void addZones(float* __restrict out, const float* __restrict weights,
                                     const float* radiance, std::size_t columns) {
    for (std::size_t i = 0; i < columns; ++i) {
        out[i] += (radiance[0] * weights[i] + radiance[1] * weights[columns + i]) +
                  (radiance[2] * weights[2 * columns + i] + radiance[3] * weights[3 * columns + i]);
    }
}

std::size_t paddedZones(const Zones& zones) {
    return (static_cast<std::size_t>(zones.count) + 3) / 4 * 4;
}

} // namespace

RsrmKernel::RsrmKernel(const Zones& zones, std::size_t columns, std::vector<double> exponents)
    : zones_(zones), columns_(columns), exponents_(std::move(exponents)),
      weights_(exponents_.size() * paddedZones(zones) * columns) {}

RsrmKernel::RsrmKernel(const Zones& zones, const std::vector<double>& thetas,
                       std::vector<double> exponents)
    : RsrmKernel(zones, thetas.size(), std::move(exponents)) {
    const std::vector<double> edges = zoneEdges(zones);
    std::vector<std::size_t> rings;
    std::vector<std::size_t> series;
    for (std::size_t i = 0; i < exponents_.size(); ++i) {
        // A series for a very sharp lobe has more terms than rings have nodes.
        const bool byRings = exponents_[i] < seriesFrom(zones.spacing) || exponents_[i] > 16384.0;
        (byRings ? rings : series).push_back(i);
    }
    buildByRings(thetas, edges, rings);
    if (!series.empty()) {
        buildBySeries(thetas, edges, series);
    }
}

RsrmKernel RsrmKernel::published(int zones, const std::vector<double>& thetas,
                                 std::vector<double> exponents) {
    RsrmKernel kernel({ZoneSpacing::EqualHeight, zones}, thetas.size(), std::move(exponents));
    for (std::size_t e = 0; e < kernel.exponents_.size(); ++e) {
        for (std::size_t i = 0; i < thetas.size(); ++i) {
            kernel.store(
                e, i,
                publishedWeights(thetas[i], zones, kPublishedAzimuths, kernel.exponents_[e])
                    .data());
        }
    }
    return kernel;
}

void RsrmKernel::store(std::size_t exponent, std::size_t column, const double* weights) {
    float* out = weights_.data() + exponent * paddedZones(zones_) * columns_ + column;
    for (std::size_t j = 0; j < static_cast<std::size_t>(zones_.count); ++j) {
        out[j * columns_] = static_cast<float>(weights[j]);
    }
}

void RsrmKernel::buildByRings(const std::vector<double>& thetas, const std::vector<double>& edges,
                              const std::vector<std::size_t>& which) {
    std::vector<std::vector<double>> small(which.size(), std::vector<double>(edges.size()));
    for (std::size_t i = 0; i < thetas.size(); ++i) {
        for (std::size_t j = 0; j < edges.size(); ++j) {
            const CapIntegral shared = smallSide(thetas[i], edges[j], 0.0);
            for (std::size_t k = 0; k < which.size(); ++k) {
                const double s = exponents_[which[k]];
                small[k][j] = s < CapIntegral::kSharedNodes
                                  ? shared.mass(s)
                                  : smallSide(thetas[i], edges[j], s).mass(s);
            }
        }
        for (std::size_t k = 0; k < which.size(); ++k) {
            store(which[k], i, weightsFromSmallSides(thetas[i], edges, small[k]).data());
        }
    }
}

void RsrmKernel::buildBySeries(const std::vector<double>& thetas, const std::vector<double>& edges,
                               const std::vector<std::size_t>& which) {
    int degree = 0;
    for (const std::size_t e : which) {
        degree = std::max(degree, legendreDegree(exponents_[e]));
    }
    std::vector<double> eigenvalues;
    for (const std::size_t e : which) {
        const std::vector<double> one = funkHeckeEigenvalues(exponents_[e], degree);
        eigenvalues.insert(eigenvalues.end(), one.begin(), one.end());
    }
    const LegendreZones series(edges, degree);
    const auto zones = static_cast<std::size_t>(zones_.count);
    std::vector<double> weights(which.size() * zones);
    for (std::size_t i = 0; i < thetas.size(); ++i) {
        series.weights(LegendreZones::polynomials(thetas[i], degree), eigenvalues, weights);
        for (std::size_t k = 0; k < which.size(); ++k) {
            store(which[k], i, weights.data() + k * zones);
        }
    }
}

void RsrmKernel::addLambert() {
    lambert_ =
        std::make_shared<const RsrmKernel>(zones_, lambertAngles(), std::vector<double>{1.0});
}

RsrmBake RsrmKernel::bake(const ZonalRadiance& radiance) const {
    LODESTAR_EXPECT(radiance.zones == zones_ &&
                        radiance.means.size() == static_cast<std::size_t>(zones_.count),
                    "the radiance has the kernel's zones");
    const std::size_t zones = paddedZones(zones_);
    std::vector<float> planar(3 * zones);
    for (std::size_t j = 0; j < radiance.means.size(); ++j) {
        for (std::size_t c = 0; c < 3; ++c) {
            planar[c * zones + j] = static_cast<float>(radiance.means[j][static_cast<int>(c)]);
        }
    }
    RsrmBake bake{exponents_, columns_, std::vector<float>(exponents_.size() * 3 * columns_)};
    if (lambert_) {
        const RsrmBake line = lambert_->bake(radiance);
        for (std::size_t i = 0; i < line.columns; ++i) {
            bake.lambert.emplace_back(line.value(0, 0)[i], line.value(0, 1)[i],
                                      line.value(0, 2)[i]);
        }
    }
    for (std::size_t e = 0; e < exponents_.size(); ++e) {
        const float* weights = weights_.data() + e * zones * columns_;
        for (std::size_t j = 0; j < zones; j += 4) {
            for (std::size_t c = 0; c < 3; ++c) {
                addZones(bake.value(e, c), weights + j * columns_, planar.data() + c * zones + j,
                         columns_);
            }
        }
    }
    return bake;
}

Zones zonesFor(const RsrmLayout& layout, LightKind kind) {
    return layout.columnMap == RsrmColumns::UniformHeight ? Zones{ZoneSpacing::EqualHeight, 256}
                                                          : zonesFor(kind);
}

std::shared_ptr<const RsrmKernel> RsrmKernels::get(const RsrmLayout& layout, LightKind kind) {
    const Zones zones = zonesFor(layout, kind);
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const Entry& entry : entries_) {
        if (entry.layout == layout && entry.zones == zones) {
            return entry.kernel;
        }
    }
    const core::SharedMemory shared;
    const std::vector<double> thetas = columnAngles(layout.columnMap, layout.columns);
    const std::vector<double> exponents = bakedExponents(layout);
    auto kernel = std::make_shared<RsrmKernel>(
        layout.sampledWeights ? RsrmKernel::published(zones.count, thetas, exponents)
                              : RsrmKernel(zones, thetas, exponents));
    if (layout.fitted) {
        kernel->addLambert();
    }
    entries_.push_back({layout, zones, kernel});
    return kernel;
}

} // namespace lodestar::lighting
