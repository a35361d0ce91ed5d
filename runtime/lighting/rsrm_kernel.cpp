// SPDX-License-Identifier: MIT
#include "lighting/rsrm_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
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

constexpr int kLowExponents = 14; ///< 8.7e-9 of the lobe's peak between them (RSRM-14)
constexpr double kLowEnd = 8.0;   ///< from here on series

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
      weights_(exponents_.size()) {}

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

RsrmKernel::RsrmKernel(const RsrmKernel& low, const std::vector<double>& thetas,
                       std::vector<double> exponents, const Others& others)
    : RsrmKernel(low.zones_, thetas.size(), std::move(exponents)) {
    std::vector<std::size_t> series;
    for (std::size_t i = 0; i < exponents_.size(); ++i) {
        for (std::size_t k = 0; k < others.size() && !weights_[i]; ++k) {
            weights_[i] = others[k]->find(exponents_[i]);
        }
        if (!weights_[i] && exponents_[i] < kLowEnd) {
            weights_[i] = low.between(exponents_[i]);
        } else if (!weights_[i]) {
            series.push_back(i);
        }
    }
    if (!series.empty()) {
        buildBySeries(thetas, zoneEdges(zones_), series);
    }
}

std::vector<double> RsrmKernel::lowExponents() {
    std::vector<double> exponents;
    for (int k = 0; k < kLowExponents; ++k) {
        const double x = std::cos(std::numbers::pi * (k + 0.5) / kLowExponents);
        exponents.push_back(2.0 * std::pow(0.5 * (kLowEnd + 1.0), 0.5 * (1.0 + x)) - 1.0);
    }
    return exponents;
}

/// Lagrange's polynomial in log(s + 1) through the weights of lowExponents(), by its barycentric
/// form: the weights of Chebyshev's points are (-1)^k sin.
std::shared_ptr<RsrmKernel::Weights> RsrmKernel::between(double exponent) const {
    if (auto own = find(exponent)) {
        return own;
    }
    std::vector<double> shares;
    double sum = 0.0;
    for (int k = 0; k < kLowExponents; ++k) {
        const double sine = std::sin(std::numbers::pi * (k + 0.5) / kLowExponents);
        const double apart =
            std::log((exponent + 1.0) / (exponents_[static_cast<std::size_t>(k)] + 1.0));
        shares.push_back((k % 2 == 0 ? sine : -sine) / apart);
        sum += shares.back();
    }
    auto weights = std::make_shared<Weights>(weights_.front()->size());
    for (std::size_t k = 0; k < shares.size(); ++k) {
        const auto share = static_cast<float>(shares[k] / sum);
        for (std::size_t i = 0; i < weights->size(); ++i) {
            (*weights)[i] += share * (*weights_[k])[i];
        }
    }
    for (float& weight : *weights) {
        weight = std::max(weight, 0.0f);
    }
    return weights;
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

std::shared_ptr<RsrmKernel::Weights> RsrmKernel::find(double exponent) const {
    const auto at = std::find(exponents_.begin(), exponents_.end(), exponent);
    return at == exponents_.end() ? nullptr
                                  : weights_[static_cast<std::size_t>(at - exponents_.begin())];
}

void RsrmKernel::store(std::size_t exponent, std::size_t column, const double* weights) {
    std::shared_ptr<Weights>& made = weights_[exponent];
    if (!made) {
        made = std::make_shared<Weights>(paddedZones(zones_) * columns_);
    }
    float* out = made->data() + column;
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
        // Each series ends at its own degree, so that its weights do not depend on the others.
        std::vector<double> one =
            funkHeckeEigenvalues(exponents_[e], legendreDegree(exponents_[e]));
        one.resize(static_cast<std::size_t>(degree) + 1);
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

void RsrmKernel::addLambert(const RsrmKernel& other) {
    LODESTAR_EXPECT(other.lambert_ && other.zones_ == zones_, "the other has Lambert's weights");
    lambert_ = other.lambert_;
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
        const float* weights = weights_[e]->data();
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

std::shared_ptr<const RsrmKernel> RsrmKernels::made(const RsrmLayout& layout, const Zones& zones) {
    const std::vector<double> thetas = columnAngles(layout.columnMap, layout.columns);
    const std::vector<double> exponents = bakedExponents(layout);
    auto kernel = std::make_shared<RsrmKernel>(
        layout.sampledWeights ? RsrmKernel::published(zones.count, thetas, exponents)
                              : RsrmKernel(zones, thetas, exponents));
    if (layout.fitted) {
        kernel->addLambert();
    }
    return kernel;
}

std::shared_ptr<const RsrmKernel> RsrmKernels::withOwnRows(const RsrmLayout& layout,
                                                           const Zones& zones) {
    const std::vector<double> thetas = columnAngles(layout.columnMap, layout.columns);
    const auto fits = [&](const RsrmKernel& kernel) {
        return kernel.zones() == zones && kernel.columns() == thetas.size();
    };
    auto low = std::find_if(low_.begin(), low_.end(), [&](const auto& one) { return fits(*one); });
    if (low == low_.end()) {
        auto made = std::make_shared<RsrmKernel>(zones, thetas, RsrmKernel::lowExponents());
        made->addLambert();
        low = low_.insert(low, std::move(made));
    }
    RsrmKernel::Others others;
    for (const Entry& entry : entries_) {
        if (hasOwnRows(entry.layout) && fits(*entry.kernel)) {
            others.push_back(entry.kernel);
        }
    }
    auto kernel = std::make_shared<RsrmKernel>(**low, thetas, bakedExponents(layout), others);
    kernel->addLambert(**low);
    return kernel;
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
    const bool own = hasOwnRows(layout);
    const auto kernel = own ? withOwnRows(layout, zones) : made(layout, zones);
    entries_.push_back({layout, zones, kernel});
    const auto isOwn = [](const Entry& entry) { return hasOwnRows(entry.layout); };
    if (own && std::count_if(entries_.begin(), entries_.end(), isOwn) > kKeptOwn) {
        entries_.erase(std::find_if(entries_.begin(), entries_.end(), isOwn));
    }
    return kernel;
}

} // namespace lodestar::lighting
