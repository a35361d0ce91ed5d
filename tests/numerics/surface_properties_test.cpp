// SPDX-License-Identifier: MIT
//
// What holds of lodestar_environment and of the weights of light probes, for every valid surface
// and every place. u below is 2^-23; bounds count roundings of u / 2.
#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "lodestar/cube.glsl"
#include "lodestar/lobes.glsl"
#include "lodestar/probes.glsl"
#include "lodestar/taps.glsl"
#include "numerics/property_inputs.h"

namespace lodestar::shader {

/// A host whose light is base + slope . d, flatter by half a level on: within base -+ |slope|.
class LinearHost {
public:
    LinearHost(float base, const vec3& slope) : base_(base), slope_(slope) {}
    vec4 lodestar_host_cube(int, vec3 direction, Real level) {
        lowest_ = std::min(lowest_, level);
        highest_ = std::max(highest_, level);
        const vec3 d = lodestar_safeNormalize(direction, vec3(0.0f));
        return vec4(vec3(base_ + exp2(-0.5f * level) * dot(slope_, d)), 1.0f);
    }
    vec3 lodestar_host_irradiance(int, vec3 normal) {
        return vec3(base_ + LODESTAR_LITERAL(0.5) * dot(slope_, normal));
    }
#define LODESTAR_HOST_CLASS
#include "lodestar/environment.glsl"
#undef LODESTAR_HOST_CLASS
    [[nodiscard]] bool readWithin(float maxLevel) const {
        return lowest_ >= 0.0f && highest_ <= maxLevel;
    }

private:
    float base_;
    vec3 slope_;
    float lowest_ = 0.0f;
    float highest_ = 0.0f;
};

} // namespace lodestar::shader

namespace lodestar::testing {

namespace {

using namespace shader;

constexpr float u = 0x1p-23f;

struct Lit {
    vec3 n, v, f0, dx, dy;
    float exponent, width, maxLevel;
};

/// Seen from before and from behind, at rest and beside derivatives of any size.
rc::Gen<Lit> lit() {
    return rc::gen::exec([] {
        const float maxLevel = static_cast<float>(*rc::gen::inRange(0, 12));
        const float step = *rc::gen::oneOf(rc::gen::just(0.0f), logarithmic(1e-6f, 10.0f));
        return Lit{
            *direction(),        *direction(), vec3(*uniform(0.0f, 1.0f)), step * *direction(),
            step * *direction(), *exponent(),  std::exp2(maxLevel),        maxLevel};
    });
}

float reflected(LinearHost& host, const Lit& lit, float kL, float occlusion,
                const glm::mat3& turn) {
    const LinearHost::LodestarSurface surface{turn * lit.n, turn * lit.v, vec3(kL),
                                              lit.f0,       lit.exponent, occlusion};
    return host
        .lodestar_environment({0, lit.width, lit.maxLevel, 0.0f}, surface, turn * lit.dx,
                              turn * lit.dy)
        .x;
}

LodestarVolume volume() {
    const vec3 half(*uniform(0.1f, 10.0f), *uniform(0.1f, 10.0f), *uniform(0.1f, 10.0f));
    const auto blend = [&] {
        return vec3(*uniform(0.0f, half.x), *uniform(0.0f, half.y), *uniform(0.0f, half.z));
    };
    const float outward = static_cast<float>(*rc::gen::inRange(0, 2));
    return {vec4(1, 0, 0, 0),
            vec4(0, 1, 0, 0),
            vec4(0, 0, 1, 0),
            half,
            blend(),
            blend(),
            static_cast<float>(*rc::gen::inRange(0, 2)),
            outward};
}

vec3 place(float far) {
    return vec3(*uniform(-far, far), *uniform(-far, far), *uniform(-far, far));
}

} // namespace

// A white surface shows a mean of light: k_L = 1 leaves what Fresnel reflects to the other term.
// Light by 8 roundings, F's parts and their sum by 40.
RC_GTEST_PROP(Environment, AWhiteSurfaceShowsNoMoreThanThereIs, ()) {
    const Lit given = *lit();
    const float base = *logarithmic(1e-3f, 1e8f);
    const float slope = *uniform(0.0f, 1.0f);
    LinearHost host(base, base * slope * *direction());
    const float shown = reflected(host, given, 1.0f, 1.0f, glm::mat3(1.0f));
    RC_ASSERT(shown >= base * (1.0f - slope) - 48.0f * u * base);
    RC_ASSERT(shown <= base * (1.0f + slope) + 48.0f * u * base);
    RC_ASSERT(host.readWithin(given.maxLevel));
    const float darker =
        reflected(host, given, *uniform(0.0f, 1.0f), *uniform(0.0f, 1.0f), glm::mat3(1.0f));
    RC_ASSERT(darker >= -48.0f * u * base && darker <= shown + 48.0f * u * base);
}

// Powers of two round nothing.
RC_GTEST_PROP(Environment, IsLinearInRadiance, ()) {
    const Lit given = *lit();
    const vec3 slope = 0.9f * *direction();
    LinearHost one(1.0f, slope);
    LinearHost bright(0x1p29f, 0x1p29f * slope);
    RC_ASSERT(reflected(bright, given, 0.7f, 0.5f, glm::mat3(1.0f)) ==
              0x1p29f * reflected(one, given, 0.7f, 0.5f, glm::mat3(1.0f)));
}

// Sums of three products in another order: n.v, the reflection and the light by 8 u; a level by 48,
// of which exp2(-level / 2) takes 0.35; n.v through the fifth power.
RC_GTEST_PROP(Environment, TurnsWithItsLight, ()) {
    const Lit given = *lit();
    const vec3 slope = *direction();
    const glm::mat3 turn = cubeRotation(*rc::gen::inRange(0, 24));
    LinearHost host(1.0f, slope);
    LinearHost turned(1.0f, turn * slope);
    // At a face's edge a footprint has the one or the other face's level.
    const vec3 d = glm::abs(2.0f * glm::dot(given.n, given.v) * given.n - given.v);
    const float near = 1e-5f;
    RC_PRE(given.dx == vec3(0.0f) || (std::abs(d.x - d.y) > near && std::abs(d.y - d.z) > near &&
                                      std::abs(d.x - d.z) > near));
    const float difference = reflected(turned, given, 0.8f, 1.0f, turn) -
                             reflected(host, given, 0.8f, 1.0f, glm::mat3(1.0f));
    RC_ASSERT(std::abs(difference) <= 100.0f * u);
}

RC_GTEST_PROP(Probes, SharesAreNeverNegativeAndSumToOne, ()) {
    const LodestarShares shares =
        lodestar_probeShares(*uniform(0.0f, 1.0f), *uniform(0.0f, 1.0f), *uniform(0.0f, 1.0f),
                             *uniform(0.0f, 1.0f), *uniform(0.0f, 1.0f));
    RC_ASSERT(shares.first >= 0.0f && shares.second >= 0.0f && shares.environment >= 0.0f);
    // Nine products and sums of at most 1.
    RC_ASSERT(std::abs(shares.first + shares.second + shares.environment - 1.0f) <= 6.0f * u);
}

RC_GTEST_PROP(Probes, AWeightFallsFromTheMiddleOut, ()) {
    const LodestarVolume box = volume();
    const vec3 out = place(12.0f);
    const float t = *uniform(0.0f, 1.0f);
    const float here = lodestar_volumeWeight(box, out);
    RC_ASSERT(here >= 0.0f && here <= 1.0f);
    // Six fades of 6 u each.
    RC_ASSERT(lodestar_volumeWeight(box, t * out) >= here - 36.0f * u);
    RC_ASSERT(lodestar_volumeWeight(box, vec3(1000.0f)) == 0.0f);
}

// Seen from where it was captured, a ray's end lies along the ray; from elsewhere, on the volume's
// surface, to 12 m of roundings over the direction's greatest part.
RC_GTEST_PROP(Probes, ARayEndsOnTheVolumesSurface, ()) {
    const LodestarVolume box = volume();
    const vec3 h = box.halfExtents;
    const bool sphere = box.sphere > 0.5f;
    const float reach = sphere ? h.x / std::sqrt(3.0f) : 1.0f;
    const vec3 inside = sphere ? vec3(0.9f * reach) * place(1.0f) : h * 0.9f * place(1.0f);
    const vec3 d = *direction();
    const vec3 end = lodestar_parallax(box, vec3(0.0f), inside, d);
    const float size = glm::length(h);
    if (sphere) {
        RC_ASSERT(std::abs(glm::length(end) - h.x) <= 32.0f * u * h.x);
    } else {
        const vec3 share = glm::abs(end) / h;
        RC_ASSERT(std::abs(std::max({share.x, share.y, share.z}) - 1.0f) <=
                  16.0f * u * size / std::min({h.x, h.y, h.z}));
    }
    const vec3 own = lodestar_parallax(box, inside, inside, d);
    RC_ASSERT(glm::distance(glm::normalize(own), d) <= 64.0f * u * size / glm::length(own));
}

} // namespace lodestar::testing
