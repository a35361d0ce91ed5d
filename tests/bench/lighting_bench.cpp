// SPDX-License-Identifier: MIT
//
// What each step from a panorama to usable lighting costs on one core, and one lookup by each
// estimator. build/bench-lighting --benchmark_counters_tabular=true
#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

#include "lighting/environment.h"
#include "lighting/lookup.h"
#include "lighting/mips.h"
#include "lighting/prefiltered.h"
#include "lodestar/cube.glsl"

namespace {

using namespace lodestar;

core::Image panorama() {
    core::Image image(1024, 512, 3);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            float* pixel = image.at(x, y);
            pixel[0] = static_cast<float>((x * 7 + y * 13) % 64) / 32.0f;
            pixel[1] = static_cast<float>(y) / 512.0f;
            pixel[2] = x == 300 && y == 100 ? 20000.0f : 0.5f;
        }
    }
    return image;
}

const lighting::Cubemap& cube() {
    static const lighting::Cubemap map = lighting::cubeFromLatLong(panorama(), 256);
    return map;
}

void cubeFromLatLong(benchmark::State& state) {
    const core::Image image = panorama();
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            lighting::cubeFromLatLong(image, static_cast<int>(state.range(0))));
    }
}
BENCHMARK(cubeFromLatLong)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);

template <auto make>
void step(benchmark::State& state) {
    static_cast<void>(cube());
    for (auto _ : state) {
        benchmark::DoNotOptimize(make(cube()));
    }
}
BENCHMARK(step<&lighting::boxMips>)->Name("boxMips/256")->Unit(benchmark::kMillisecond);
BENCHMARK(step<&lighting::solidAngleMips>)
    ->Name("solidAngleMips/256")
    ->Unit(benchmark::kMillisecond);
BENCHMARK(step<&lighting::tentMips>)->Name("tentMips/256")->Unit(benchmark::kMillisecond);
lighting::Cubemap irradianceCube(const lighting::Cubemap& base) {
    return lighting::irradianceCube(base);
}
BENCHMARK(step<&irradianceCube>)->Name("irradianceCube/256")->Unit(benchmark::kMillisecond);
BENCHMARK(step<&lighting::sh9FromCube>)->Name("sh9FromCube/256")->Unit(benchmark::kMillisecond);

/// On one thread, from means and from the map itself.
lighting::Cubemap prefilteredMips(const lighting::Cubemap& base) {
    return lighting::prefilteredMips(base, {.threads = 1});
}
BENCHMARK(step<&prefilteredMips>)->Name("prefilteredMips/256")->Unit(benchmark::kMillisecond);
lighting::Cubemap prefilteredFromBase(const lighting::Cubemap& base) {
    return lighting::prefilteredMips(base, {.leastSourceWidth = base.width(), .threads = 1});
}
BENCHMARK(step<&prefilteredFromBase>)
    ->Name("prefilteredMips from the map/256")
    ->Unit(benchmark::kMillisecond);

/// The same levels by brute force: each texel's lobe summed over the map's texels.
lighting::Cubemap prefilteredByBruteForce(const lighting::Cubemap& base) {
    lighting::Cubemap mips(base.width(), lighting::fullLevelCount(base.width()));
    for (int level = 1; level < mips.levelCount(); ++level) {
        const int n = mips.width(level);
        const double exponent = static_cast<double>(shader::lodestar_prefilteredExponent(
            static_cast<float>(level), static_cast<float>(base.width())));
        for (int i = 0; i < 6 * n * n; ++i) {
            const auto coordinate = [n](int at) {
                return static_cast<float>(2 * at + 1) / static_cast<float>(n) - 1.0f;
            };
            const glm::dvec3 r = glm::normalize(glm::dvec3(shader::lodestar_cubeDirection(
                i / (n * n), coordinate(i % n), coordinate(i / n % n))));
            mips.level(level)[static_cast<std::size_t>(i)] =
                glm::vec4(glm::vec3(lighting::referencePhong(base, r, exponent)), 1.0f);
        }
    }
    return mips;
}
BENCHMARK(step<&prefilteredByBruteForce>)
    ->Name("prefiltered by brute force/256")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// The sum over all texels: exponent, threads (0: all processors).
void reference(benchmark::State& state) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            lighting::referencePhong(cube(), direction, static_cast<double>(state.range(0)),
                                     {static_cast<std::size_t>(state.range(1))}));
    }
}
BENCHMARK(reference)
    ->Name("reference/256")
    ->ArgsProduct({{1, 64, 1024}, {1, 0}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void lookup(benchmark::State& state, const char* name) {
    lighting::LookupRequest request;
    request.lobe = lighting::Lobe::Phong;
    request.exponent = 64.0;
    request.direction = glm::normalize(glm::dvec3(0.3, 0.5, -0.8));
    request.estimator = *lighting::parseEstimator(name, lighting::Term::Glossy);
    const lighting::PreparedEnvironment environment =
        lighting::prepare(cube(), lighting::partsFor(request.estimator));
    for (auto _ : state) {
        benchmark::DoNotOptimize(lighting::lookup(environment, request));
    }
}
BENCHMARK_CAPTURE(lookup, mip, "mip");
BENCHMARK_CAPTURE(lookup, tent, "tent");
BENCHMARK_CAPTURE(lookup, prefiltered, "prefiltered");
BENCHMARK_CAPTURE(lookup, reference, "reference")->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
