// SPDX-License-Identifier: MIT
//
// What holds of the functions of shaders/lodestar for every valid input, and for any bits where a
// function repairs them. u below is 2^-23; bounds count roundings of u / 2.
#include <array>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "lodestar/cube.glsl"
#include "lodestar/display.glsl"
#include "lodestar/lobes.glsl"
#include "lodestar/sh9.glsl"
#include "numerics/property_inputs.h"

namespace lodestar::testing {

namespace {

using namespace shader;

constexpr float u = 0x1p-23f;

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool within(float x, float low, float high) {
    return x >= low && x <= high; // false for NaN
}

} // namespace

RC_GTEST_PROP(Power, AnyExponentIsRepaired, ()) {
    const float s = lodestar_repairExponent(*anyFloat());
    RC_ASSERT(within(s, 0.0f, 1e7f));
    RC_ASSERT(lodestar_repairExponent(s) == s);
}

RC_GTEST_PROP(Power, IsBetween0And1AndFallsWithTheExponent, ()) {
    const float x = *rc::gen::oneOf(uniform(-1.0f, 1.0f), logarithmic(1e-30f, 1.0f));
    const float s = lodestar_repairExponent(*exponent());
    const float more = std::min(s * 1.5f + 1.0f, 1e7f);
    RC_ASSERT(within(lodestar_cosinePower(x, s), 0.0f, 1.0f));
    RC_ASSERT(lodestar_cosinePower(x, more) <= lodestar_cosinePower(x, s));
    const float d = 1.0f - x;
    RC_ASSERT(within(lodestar_cosinePowerFromChord(d, s), 0.0f, 1.0f));
    RC_ASSERT(lodestar_cosinePowerFromChord(d, more) <= lodestar_cosinePowerFromChord(d, s));
}

RC_GTEST_PROP(Power, AMixIsBetweenItsEnds, ()) {
    const vec3 a(*radiance());
    const vec3 b(*radiance());
    const float t = *rc::gen::oneOf(rc::gen::element(0.0f, 0.5f, 1.0f), uniform(0.0f, 1.0f));
    const float mixed = lodestar_mix(a, b, t).x;
    const float low = std::min(a.x, b.x);
    const float high = std::max(a.x, b.x);
    RC_ASSERT(within(mixed, low * (1.0f - 2.0f * u), high * (1.0f + 2.0f * u)));
    RC_ASSERT(lodestar_mix(a, b, 0.0f) == a && lodestar_mix(a, b, 1.0f) == b);
}

// Squares, a root and a product: five roundings of the length.
RC_GTEST_PROP(Power, AnyVectorIsMadeUnit, ()) {
    const vec3 v(*anyFloat(), *anyFloat(), *anyFloat());
    const vec3 unit = lodestar_safeNormalize(v, vec3(0.0f, 1.0f, 0.0f));
    RC_ASSERT(within(glm::length(unit), 1.0f - 5.0f * u, 1.0f + 5.0f * u));
}

// Faces as the drawing in cube.glsl has them: centre, and where columns and rows run to.
TEST(Cube, FacesLieAsDrawn) {
    constexpr std::array<std::array<int, 9>, 6> kDrawing{{{1, 0, 0, 0, 0, -1, 0, -1, 0},
                                                          {-1, 0, 0, 0, 0, 1, 0, -1, 0},
                                                          {0, 1, 0, 1, 0, 0, 0, 0, 1},
                                                          {0, -1, 0, 1, 0, 0, 0, 0, -1},
                                                          {0, 0, 1, 1, 0, 0, 0, -1, 0},
                                                          {0, 0, -1, -1, 0, 0, 0, -1, 0}}};
    for (int face = 0; face < 6; ++face) {
        const auto& f = kDrawing[static_cast<std::size_t>(face)];
        const vec3 centre(f[0], f[1], f[2]);
        EXPECT_EQ(lodestar_cubeDirection(face, 0.0f, 0.0f), centre) << face;
        EXPECT_EQ(lodestar_cubeDirection(face, 1.0f, 0.0f), centre + vec3(f[3], f[4], f[5]))
            << face;
        EXPECT_EQ(lodestar_cubeDirection(face, 0.0f, 1.0f), centre + vec3(f[6], f[7], f[8]))
            << face;
    }
}

// A direction is a multiple of its place on its face; the division rounds once.
RC_GTEST_PROP(Cube, PlacesAndDirectionsAreInverse, ()) {
    const vec3 d = *direction();
    const int face = lodestar_cubeFace(d);
    const vec2 place = lodestar_cubeCoordinates(d);
    RC_ASSERT(within(place.x, -1.0f, 1.0f) && within(place.y, -1.0f, 1.0f));
    const vec3 back = lodestar_cubeDirection(face, place.x, place.y);
    const float longest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    RC_ASSERT(glm::distance(back * longest, d) <= 2.0f * u);
}

// The level of a power of two's lobe, up to the roundings of a level of 24 at most (20 u each way).
RC_GTEST_PROP(Cube, LevelsStayInTheChainAndFollowTheLobe, ()) {
    const float maxLevel = static_cast<float>(*whole(rc::gen::inRange(0, 15)));
    const float width = std::exp2(maxLevel);
    const float any = *anyFloat();
    const vec3 d = *direction();
    RC_ASSERT(within(lodestar_mipLevel(any, width, maxLevel), 0.0f, maxLevel));
    RC_ASSERT(within(lodestar_tentLevel(d, any, width, maxLevel), 0.0f, maxLevel));
    const float s = lodestar_repairExponent(*exponent());
    const float more = std::min(s * 1.25f + 0.1f, 1e7f);
    const float slack = 40.0f * u;
    RC_ASSERT(lodestar_mipLevel(more, width, maxLevel) <=
              lodestar_mipLevel(s, width, maxLevel) + slack);
    RC_ASSERT(lodestar_tentLevel(d, more, width, maxLevel) <=
              lodestar_tentLevel(d, s, width, maxLevel) + slack);
    RC_ASSERT(within(lodestar_prefilteredLevel(any, width, maxLevel), 0.0f, maxLevel));
    RC_ASSERT(lodestar_prefilteredLevel(more, width, maxLevel) <=
              lodestar_prefilteredLevel(s, width, maxLevel) + slack);
    // Twice the texels, one level more.
    RC_ASSERT(std::abs(lodestar_mipLevelUnclamped(s, 2.0f * width) -
                       lodestar_mipLevelUnclamped(s, width) - 1.0f) <= slack);
}

RC_GTEST_PROP(Cube, ARaisedLevelIsNeverBelowAndNeverBeyondTheChain, ()) {
    const float level = *uniform(0.0f, 12.0f);
    const float floorLevel = *anyFloat();
    const float raised = lodestar_raiseLevel(level, floorLevel, 12.0f);
    RC_ASSERT(within(raised, level, 12.0f));
    RC_ASSERT(!(floorLevel <= 12.0f) || raised >= floorLevel);
    // A sharper surface reads no coarser level under the same footprint.
    const float lower = *uniform(0.0f, level);
    RC_ASSERT(lodestar_raiseLevel(lower, floorLevel, 12.0f) <= raised);
}

RC_GTEST_PROP(Cube, AVertexsLevelFallsTowardsGrazing, ()) {
    const float least = *uniform(0.0f, 12.0f);
    const float cosine = *uniform(0.0f, 1.0f);
    const float level = lodestar_biasLevelAtVertex(least, cosine);
    RC_ASSERT(within(level, 0.0f, least));
    RC_ASSERT(lodestar_biasLevelAtVertex(least, 0.5f * cosine) <= level);
}

// Squares are summed in another order: 0.75 log2 of a sum by 3 u. A footprint's level is a sum of
// logarithms of up to 40, each rounded by as many u / 2.
RC_GTEST_PROP(Cube, TheTwentyFourRotationsChangeNoLevel, ()) {
    const glm::mat3 turn = cubeRotation(*rc::gen::inRange(0, 24));
    const vec3 d = *direction();
    RC_ASSERT(std::abs(lodestar_texelSizeLevel(turn * d) - lodestar_texelSizeLevel(d)) <= 8.0f * u);
    RC_ASSERT(within(lodestar_texelSizeLevel(d), -0.467001f, 0.722f));
    const float width = 256.0f;
    const vec3 dx = glm::cross(d, *direction()) * *logarithmic(1e-4f, 0.3f);
    const float footprint = lodestar_footprintLevel(d, dx, dx, width);
    const float turned = lodestar_footprintLevel(turn * d, turn * dx, turn * dx, width);
    const bool tie = std::abs(d.x) == std::abs(d.y) || std::abs(d.y) == std::abs(d.z) ||
                     std::abs(d.x) == std::abs(d.z); // the face may be another
    RC_ASSERT(tie || std::abs(turned - footprint) <= 48.0f * u);
}

RC_GTEST_PROP(Cube, SolidAnglesArePositiveAndDensitiesAtMostOne, ()) {
    const float width = static_cast<float>(*whole(rc::gen::inRange(1, 4097)));
    const float i = std::floor(*uniform(0.0f, width - 1.0f));
    const float j = std::floor(*uniform(0.0f, width - 1.0f));
    const float omega = lodestar_texelSolidAngle(width, i, j);
    RC_ASSERT(
        within(omega, 0.19f * 4.0f / (width * width), 4.0f / (width * width) * (1.0f + 8.0f * u)));
    const float x = *uniform(-1.0f, 1.0f);
    const float y = *uniform(-1.0f, 1.0f);
    RC_ASSERT(within(lodestar_texelDensity(x, y), 0.19f, 1.0f + 8.0f * u)); // 3^(-3/2) = 0.192
    RC_ASSERT(within(lodestar_meanTexelDensity(x, y, width), 0.19f, 1.0f + 12.0f * u));
}

RC_GTEST_PROP(Cube, ARoundTexelsLobeIsNoBroaderThanTheOneWanted, ()) {
    const float s = lodestar_repairExponent(*exponent());
    const float hat = *uniform(0.0f, 1.0f);
    const float round = lodestar_roundExponent(s, hat);
    RC_ASSERT(within(round, 0.0f, 1e7f));
    RC_ASSERT(round >= s * (1.0f - 16.0f * u) - 16.0f * u);
}

// A sum, its quotient and the products leave each coordinate 2.5 u; the third is 1 less two, by 6
// u, of a vector that is at least 0.577 long.
RC_GTEST_PROP(Cube, TheOctahedronIsItsOwnInverse, ()) {
    const vec3 d = *direction();
    const vec2 p = lodestar_octahedral(d);
    RC_ASSERT(within(p.x, -1.0f - u, 1.0f + u) && within(p.y, -1.0f - u, 1.0f + u));
    const vec3 back = glm::normalize(lodestar_octahedralDirection(p));
    RC_ASSERT(glm::distance(back, d) <= 16.0f * u);
    const vec2 texel = lodestar_irradianceTexel(d);
    RC_ASSERT(within(texel.x, 0.5f, 24.5f)); // between centres: no other tile is read
    RC_ASSERT(within(texel.y, 0.5f, 24.5f)); // between centres: no other tile is read
}

RC_GTEST_PROP(Lobes, FresnelStaysBetweenF0AndOne, ()) {
    const vec3 f0(*uniform(0.0f, 1.0f));
    const float cosine = *uniform(0.0f, 1.0f);
    const float s = *exponent();
    const float direct = lodestar_fresnel(f0, cosine).x;
    const float whole = lodestar_fresnelEnvironment(f0, cosine, s).x;
    RC_ASSERT(within(direct, f0.x, 1.0f + 2.0f * u));
    RC_ASSERT(within(whole, f0.x, 1.0f + 2.0f * u));
    RC_ASSERT(whole <= direct + 4.0f * u); // rough things rise less
    RC_ASSERT(lodestar_fresnel(f0, 0.5f * cosine).x >= direct - 2.0f * u);
}

// Roughness r gives s + 2 = 2 / r^4 by 4 u, of which the two roots leave a quarter; they and the
// quotient add 1 u.
RC_GTEST_PROP(Lobes, RoughnessAndExponentAreInverse, ()) {
    const float r = *uniform(0.0212f, 1.0f); // below, the exponent is 1e7
    const float s = lodestar_exponentFromRoughness(r);
    RC_ASSERT(std::abs(lodestar_roughnessFromExponent(s) - r) <= 3.0f * u * r);
    RC_ASSERT(within(lodestar_roughnessFromExponent(*anyFloat()), 0.0f, 1.0f));
}

// The normalised lobes' integrals, by the midpoint rule in the cosine z at n = v. Its error is
// n^-2 / 24 of the change of slope over the range, at most s / 2 (s + 8) / 8 for Blinn-Phong and
// s (s + 1) for Phong: 1.2e-5 for s = 16 at n = 1024.
TEST(Lobes, IntegrateToOne) {
    constexpr int kNodes = 1024;
    const vec3 n(0.0f, 0.0f, 1.0f);
    for (const float s : {0.0f, 0.5f, 1.0f, 4.0f, 16.0f}) {
        double phong = 0.0;
        double blinn = 0.0;
        double lambert = 0.0;
        for (int i = 0; i < kNodes; ++i) {
            const float z = (static_cast<float>(i) + 0.5f) / kNodes;
            const vec3 l(std::sqrt(1.0f - z * z), 0.0f, z);
            phong += static_cast<double>(lodestar_phongNormaliser(s) * lodestar_cosinePower(z, s));
            blinn += static_cast<double>(
                lodestar_directReflectance(n, n, l, vec3(0.0f), vec3(1.0f), s).x);
            lambert += static_cast<double>(
                lodestar_directReflectance(n, n, l, vec3(1.0f), vec3(0.0f), s).x);
        }
        const double ring = 2.0 * std::numbers::pi / kNodes;
        // x^s with 0 < s < 1 is steep at 0: the first node's own part, n^-(s + 1).
        EXPECT_NEAR(phong * ring, 1.0, s > 0.0f && s < 1.0f ? 1e-4 : 1.3e-5) << s;
        EXPECT_NEAR(blinn * ring, 1.0, 1.3e-5) << s;
        // Diffuse light and what Fresnel takes of it: F0 = 0 leaves (1 - w) of it, w = (1 - v.h)^5
        // at most (1 - cos 45)^5 = 0.0022; a highlight of as much.
        EXPECT_NEAR(lambert * ring, 1.0, 0.005) << s;
    }
}

RC_GTEST_PROP(Lobes, LookupsAreValidAndSharpenWithTheExponent, ()) {
    const float any = *anyFloat();
    const float cosine = *uniform(0.0f, 1.0f);
    RC_ASSERT(within(lodestar_lookupBlend(any, cosine), 0.0f, 1.0f));
    RC_ASSERT(within(lodestar_lookupExponent(any, cosine), 1.0f - 4.0f * u, 1.3e7f));
    RC_ASSERT(within(lodestar_phongFromBlinnPhong(any), 0.99f, 2.6e6f));
    RC_ASSERT(
        within(lodestar_specularOcclusion(cosine, any), cosine * (1.0f - 2.0f * u), 1.0f + u));
}

RC_GTEST_PROP(Lobes, DirectLightIsFiniteAndLinearInTheReflectance, ()) {
    const vec3 n = *direction();
    const vec3 v = *direction();
    const vec3 l = *direction();
    const vec3 f0(*uniform(0.0f, 1.0f));
    const float s = *exponent();
    const vec3 black = lodestar_directReflectance(n, v, l, vec3(0.0f), f0, s);
    const vec3 half = lodestar_directReflectance(n, v, l, vec3(0.5f), f0, s);
    const vec3 whole = lodestar_directReflectance(n, v, l, vec3(1.0f), f0, s);
    RC_ASSERT(isFinite(whole) && whole.x >= 0.0f && black.x >= 0.0f);
    // Halves are exact, so that only the sums round.
    RC_ASSERT(std::abs(2.0f * (half.x - black.x) - (whole.x - black.x)) <= 4.0f * u * whole.x);
    if (glm::dot(n, l) <= 0.0f) {
        RC_ASSERT(whole.x == 0.0f); // from behind there is none
    }
}

RC_GTEST_PROP(Lobes, MetallicSplitsTheBaseColour, ()) {
    const vec3 base(*uniform(0.0f, 1.0f));
    const float metallic = *uniform(0.0f, 1.0f);
    const float kL = lodestar_diffuseFromMetallic(base, metallic).x;
    const float f0 = lodestar_f0FromMetallic(base, metallic).x;
    RC_ASSERT(within(kL, 0.0f, base.x));
    RC_ASSERT(within(f0, std::min(0.04f, base.x) - u, std::max(0.04f, base.x) + u));
    RC_ASSERT(kL * (1.0f - f0) + f0 <= 1.0f + 2.0f * u);
    const float ior = *rc::gen::oneOf(rc::gen::just(0.0f), uniform(1.0f, 4.0f));
    RC_ASSERT(
        within(lodestar_f0OfDielectric(ior, vec3(*uniform(0.0f, 10.0f)), metallic).x, 0.0f, 1.0f));
}

// Nine terms of products: at most 16 roundings of their sum of sizes.
RC_GTEST_PROP(Sh9, IsLinearWhereItIsNotClampedAndNeverNegative, ()) {
    std::array<vec3, 9> c{};
    float sizes = 0.0f;
    for (vec3& one : c) {
        one = vec3(*uniform(-1.0f, 1.0f));
        sizes += 2.0f * std::abs(one.x);
    }
    const float factor = *logarithmic(1e-3f, 1e9f);
    const vec3 n = *direction();
    const auto at = [&](float k) {
        return lodestar_sh9(c[0] * k, c[1] * k, c[2] * k, c[3] * k, c[4] * k, c[5] * k, c[6] * k,
                            c[7] * k, c[8] * k, n)
            .x;
    };
    RC_ASSERT(at(1.0f) >= 0.0f);
    RC_ASSERT(std::abs(at(factor) - factor * at(1.0f)) <= 16.0f * u * sizes * factor);
    RC_ASSERT(at(0.0f) == 0.0f);
}

RC_GTEST_PROP(Display, RisesFromNoneToOne, ()) {
    const float a = *radiance();
    const float b = a * *uniform(1.0f, 3.0f);
    RC_ASSERT(within(lodestar_filmic(a), 0.0f, 1.0f));
    RC_ASSERT(lodestar_filmic(b) >= lodestar_filmic(a) - 4.0f * u);
    const float x = *uniform(0.0f, 1.0f);
    // The power by 14 u, through a slope of at most 12.92.
    RC_ASSERT(std::abs(lodestar_linearFromSrgb(lodestar_srgbFromLinear(x)) - x) <= 40.0f * u);
    RC_ASSERT(within(lodestar_srgbFromLinear(*radiance()), 0.0f, 1.0f));
}

} // namespace lodestar::testing
