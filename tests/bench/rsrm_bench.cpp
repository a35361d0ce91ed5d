// SPDX-License-Identifier: MIT
//
// What a radially symmetric reflection map costs on one core: its kernel once, then every edit
// (zone means, bake, texels) and every frame of a day (blend, texels). CPU time. build/bench-rsrm
#include <benchmark/benchmark.h>

#include "lighting/day.h"
#include "lighting/rsrm.h"
#include "lighting/rsrm_weights.h"

namespace {

using namespace lodestar::lighting;

const RsrmLayout& layoutOf(const benchmark::State& state) {
    return state.range(0) == 0 ? kRsrm : kRsrmSmall;
}

LightKind kindOf(const benchmark::State& state) {
    return state.range(1) == 0 ? LightKind::Sky : LightKind::Sun;
}

/// A sky of five stops with a step at the horizon; a sun's disc with a glow over all of it.
Gradient gradientOf(LightKind kind) {
    if (kind == LightKind::Sky) {
        return {{{90, {0.1, 0.2, 0.5}, 0},
                 {30, {0.3, 0.4, 0.6}, 0},
                 {0, {1.0, 0.9, 0.8}, 0},
                 {0, {0.1, 0.1, 0.1}, 0},
                 {-90, {0.05, 0.05, 0.05}, 0}},
                GradientInterpolation::Smooth,
                GradientSpace::Oklab};
    }
    return {
        {{0, {1, 1, 1}, 16}, {0.27, {1, 1, 1}, 16}, {0.27, {1, 0.5, 0.2}, 2}, {180, {0, 0, 0}, 0}}};
}

const RsrmKernel& kernelOf(const benchmark::State& state) {
    static RsrmKernels kernels;
    return *kernels.get(layoutOf(state), kindOf(state));
}

void kernel(benchmark::State& state) {
    for (auto _ : state) {
        RsrmKernels kernels;
        benchmark::DoNotOptimize(kernels.get(layoutOf(state), kindOf(state)));
    }
}

void rebake(benchmark::State& state) {
    const RsrmKernel& own = kernelOf(state);
    const RadianceProfile profile(gradientOf(kindOf(state)), kindOf(state));
    for (auto _ : state) {
        const ZonalRadiance zonal = zonalRadiance(profile, own.zones());
        benchmark::DoNotOptimize(own.bake(zonal));
    }
}

/// Eq. 1 of the paper, literally, into a map of the published size.
void literal(benchmark::State& state) {
    const Zones zones = zonesFor(kRsrmPublished, kindOf(state));
    const ZonalRadiance zonal =
        zonalRadiance(RadianceProfile(gradientOf(kindOf(state)), kindOf(state)), zones);
    const std::vector<double> angles =
        columnAngles(kRsrmPublished.columnMap, kRsrmPublished.columns);
    for (auto _ : state) {
        for (const double exponent : bakedExponents(kRsrmPublished)) {
            for (const double angle : angles) {
                const auto weights = publishedWeights(angle, zones.count, 128, exponent);
                glm::dvec3 sum(0.0);
                for (std::size_t j = 0; j < weights.size(); ++j) {
                    sum += weights[j] * zonal.means[j];
                }
                benchmark::DoNotOptimize(sum);
            }
        }
    }
}

void texels(benchmark::State& state) {
    const RadianceProfile profile(gradientOf(kindOf(state)), kindOf(state));
    const RsrmBake bake = kernelOf(state).bake(zonalRadiance(profile, kernelOf(state).zones()));
    for (auto _ : state) {
        benchmark::DoNotOptimize(encode(layoutOf(state), bake));
    }
}

void blend(benchmark::State& state) {
    const RadianceProfile profile(gradientOf(kindOf(state)), kindOf(state));
    const RsrmBake bake = kernelOf(state).bake(zonalRadiance(profile, kernelOf(state).zones()));
    for (auto _ : state) {
        benchmark::DoNotOptimize(blended(bake, bake, 0.3));
    }
}

// The layout (0 rsrm, 1 small), the kind (0 sky, 1 sun).
BENCHMARK(kernel)->ArgsProduct({{0, 1}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(rebake)->ArgsProduct({{0, 1}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(literal)->ArgsProduct({{0}, {0}})->Unit(benchmark::kMillisecond);
BENCHMARK(texels)->ArgsProduct({{0, 1}, {0}})->Unit(benchmark::kMillisecond);
BENCHMARK(blend)->ArgsProduct({{0, 1}, {0}})->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
