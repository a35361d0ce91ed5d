// SPDX-License-Identifier: MIT
#include "lighting/lookup.h"

#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lodestar/cube.glsl"
#include "lodestar/lobes.glsl"
#include "lodestar/sh9.glsl"
#include "lodestar/taps.glsl"

namespace lodestar::shader {

namespace {

/// A host of the shading text over CPU images: the text becomes its member functions, so that a
/// lookup here runs the statements that the GPU runs.
class CpuHost {
public:
    CpuHost(const lighting::Cubemap* cube, const lighting::Cubemap* irradiance)
        : cube_(cube), irradiance_(irradiance) {}

    // The hooks that the text calls. There is one environment, so the slot says nothing.
    vec4 lodestar_host_cube(int, vec3 direction, Real level) {
        fetches_ += 1;
        level_ = level;
        return cube_->sample(direction, level);
    }
    vec3 lodestar_host_irradiance(int, vec3 normal) {
        fetches_ += 1;
        return vec3(irradiance_->sampleLevel(normal, 0));
    }

#define LODESTAR_HOST_CLASS
#include "lodestar/environment.glsl"
#undef LODESTAR_HOST_CLASS

    [[nodiscard]] int fetches() const {
        return fetches_;
    }
    /// The level fetched; negative if the cube was not, or more than once.
    [[nodiscard]] double level() const {
        return fetches_ == 1 ? level_ : -1.0;
    }

private:
    const lighting::Cubemap* cube_;
    const lighting::Cubemap* irradiance_;
    int fetches_ = 0;
    double level_ = -1.0;
};

} // namespace

} // namespace lodestar::shader

namespace lodestar::lighting {

namespace {

/// No pixel footprint on the CPU: a floor below every level.
constexpr float kNoFootprint = -std::numeric_limits<float>::infinity();

const Cubemap& mipsFor(const PreparedEnvironment& environment, EstimatorKind kind) {
    if (kind == EstimatorKind::Prefiltered) {
        return environment.prefilteredMips;
    }
    return readsTentMips(kind) ? environment.tentMips : environment.boxMips;
}

glm::dvec3 referenceRadiance(const PreparedEnvironment& environment, const LookupRequest& request,
                             const ReferenceRun& run) {
    switch (request.lobe) {
    case Lobe::Phong:
        return referencePhong(environment.base, request.direction, request.exponent, run);
    case Lobe::BlinnPhong:
        return referenceBlinnPhong(environment.base, request.direction, request.direction,
                                   request.exponent, run);
    case Lobe::Lambert:
        break;
    }
    return referencePhong(environment.base, request.direction, 1.0, run); // the cosine lobe
}

LookupAnswer lookupReference(const PreparedEnvironment& environment, const LookupRequest& request,
                             const ReferenceRun& run) {
    const int width = environment.base.width();
    return {referenceRadiance(environment, request, run), -1.0, 6 * width * width};
}

LookupAnswer lookupSh9(const PreparedEnvironment& environment, const glm::vec3& normal) {
    const Sh9Coefficients& c = environment.sh9;
    return {glm::dvec3(
                shader::lodestar_sh9(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], normal)),
            -1.0, 0};
}

/// A Phong lobe about a direction.
glm::vec3 fetchLobe(shader::CpuHost& host, const shader::CpuHost::LodestarCube& cube,
                    const Estimator& estimator, const glm::vec3& direction, float exponent) {
    switch (estimator.kind) {
    case EstimatorKind::Ring3:
        return host.lodestar_specularRing(cube, direction, exponent, kNoFootprint, 3);
    case EstimatorKind::Ring7:
        return host.lodestar_specularRing(cube, direction, exponent, kNoFootprint, 7);
    case EstimatorKind::Taps:
        return host.lodestar_specularTaps(cube, direction, exponent, kNoFootprint, estimator.taps);
    case EstimatorKind::Prefiltered:
        return host.lodestar_specularPrefiltered(cube, direction, exponent, kNoFootprint);
    default:
        return host.lodestar_specularTent(cube, direction, exponent, kNoFootprint);
    }
}

/// The estimators that fetch, by the shading text.
glm::vec3 fetch(shader::CpuHost& host, const shader::CpuHost::LodestarCube& cube,
                const LookupRequest& request, const glm::vec3& direction) {
    const float exponent = static_cast<float>(request.exponent);
    switch (request.estimator.kind) {
    case EstimatorKind::Mip:
        return host.lodestar_specularMip(cube, direction, exponent);
    case EstimatorKind::MipFloor:
        return host.lodestar_specularMipFloor(cube, direction, exponent, kNoFootprint);
    case EstimatorKind::Bias:
    case EstimatorKind::BiasVertex: // seen along the normal the vertex's level is the object's
        return host.lodestar_specularBias(cube, direction, kNoFootprint);
    case EstimatorKind::Tent:
    case EstimatorKind::Ring3:
    case EstimatorKind::Ring7:
    case EstimatorKind::Taps:
    case EstimatorKind::Prefiltered: {
        if (request.lobe == Lobe::Phong) {
            return fetchLobe(host, cube, request.estimator, direction, exponent);
        }
        const auto converted = host.lodestar_lookup(direction, direction, exponent);
        return fetchLobe(host, cube, request.estimator, converted.direction, converted.exponent);
    }
    case EstimatorKind::LowestMip:
        return glm::vec3(host.lodestar_host_cube(cube.slot, direction, cube.maxLevel));
    case EstimatorKind::Irradiance:
        return host.lodestar_host_irradiance(cube.slot, direction);
    default:
        core::contractViolated("kind fetches", "the estimator fetches nothing", __FILE__, __LINE__);
    }
}

} // namespace

PreparedParts partsFor(const Estimator& estimator) {
    PreparedParts parts;
    switch (estimator.kind) {
    case EstimatorKind::Mip:
    case EstimatorKind::MipFloor:
    case EstimatorKind::Bias:
    case EstimatorKind::BiasVertex:
    case EstimatorKind::LowestMip:
        parts.boxMips = true;
        break;
    case EstimatorKind::Tent:
    case EstimatorKind::Ring3:
    case EstimatorKind::Ring7:
    case EstimatorKind::Taps:
    case EstimatorKind::Auto:
        parts.tentMips = true;
        break;
    case EstimatorKind::Prefiltered:
        parts.prefilteredMips = true;
        break;
    case EstimatorKind::Sh9:
        parts.sh9 = true;
        break;
    case EstimatorKind::Irradiance:
        parts.irradiance = true;
        break;
    case EstimatorKind::Reference:
        break;
    }
    return parts;
}

LookupAnswer lookup(const PreparedEnvironment& environment, const LookupRequest& request,
                    const ReferenceRun& run) {
    const EstimatorKind kind = request.estimator.kind;
    LODESTAR_EXPECT(serves(kind, request.lobe == Lobe::Lambert ? Term::Diffuse : Term::Glossy),
                    "the estimator serves the lobe's term");
    if (kind == EstimatorKind::Reference) {
        return lookupReference(environment, request, run);
    }
    const glm::vec3 direction =
        shader::lodestar_safeNormalize(glm::vec3(request.direction), glm::vec3(0.0f, 0.0f, 1.0f));
    if (kind == EstimatorKind::Sh9) {
        return lookupSh9(environment, direction);
    }
    const bool irradiance = kind == EstimatorKind::Irradiance;
    const Cubemap& mips = mipsFor(environment, kind);
    LODESTAR_EXPECT(irradiance ? !environment.irradiance.empty() : !mips.empty(),
                    "the environment holds the parts that the estimator needs");
    shader::CpuHost host(&mips, &environment.irradiance);
    const shader::CpuHost::LodestarCube cube{
        0, irradiance ? 0.0f : static_cast<float>(mips.width()),
        irradiance ? 0.0f : static_cast<float>(mips.levelCount() - 1),
        request.estimator.leastLevel};
    const glm::dvec3 radiance(fetch(host, cube, request, direction));
    return {radiance, host.level(), host.fetches()};
}

} // namespace lodestar::lighting
