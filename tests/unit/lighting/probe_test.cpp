// SPDX-License-Identifier: MIT
//
// Volumes of light probes: where they are, what they hold of a box, which faces see one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "lighting/probe.h"
#include "lodestar/probes.glsl"

namespace lodestar::lighting {
namespace {

shader::LodestarVolume inShaders(const PlacedVolume& v) {
    return {v.rows[0],   v.rows[1],  v.rows[2],           v.halfExtents,
            v.blendHigh, v.blendLow, v.sphere ? 1.0f : 0, v.outward ? 1.0f : 0};
}

class Draw {
public:
    explicit Draw(unsigned seed) : random_(seed) {}
    float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(static_cast<double>(random_()) * 0x1p-32);
    }
    glm::vec3 within(float reach) {
        return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
    }
    glm::mat4 frame() {
        const glm::vec3 axis = glm::normalize(within(1.0f) + glm::vec3(0.01f));
        const glm::mat4 turned =
            glm::rotate(glm::translate(glm::mat4(1.0f), within(3.0f)), uniform(0, 6), axis);
        return glm::scale(turned, {uniform(0.5f, 2), -uniform(0.5f, 2), uniform(0.5f, 2)});
    }
    ProbeVolume volume(bool sphere) {
        ProbeVolume volume;
        volume.shape = sphere ? VolumeShape::Sphere : VolumeShape::Box;
        volume.center = glm::dvec3(within(1.0f));
        volume.size = sphere ? glm::dvec3(static_cast<double>(uniform(1, 6)))
                             : glm::dvec3(glm::vec3(uniform(1, 6), uniform(1, 6), uniform(1, 6)));
        for (double& blend : volume.blend) {
            blend = static_cast<double>(uniform(0.0f, 4.0f)); // some overlap and are lowered
        }
        return volume;
    }

private:
    std::mt19937 random_;
};

TEST(ProbeVolumes, WeightsAreOneInTheMiddleAndNothingBeyondTheBox) {
    Draw draw(1);
    for (int i = 0; i < 300; ++i) {
        const bool outward = i % 3 == 0;
        const ProbeVolume volume = draw.volume(i % 2 == 0);
        const glm::mat4 frame = draw.frame();
        const auto placed = place(volume, frame, outward);
        ASSERT_TRUE(placed.has_value());
        const auto middle = glm::vec3(frame * glm::vec4(glm::vec3(volume.center), 1.0f));
        EXPECT_NEAR(shader::lodestar_volumeWeight(inShaders(*placed), middle), 1.0f, 1e-4f);
        for (int k = 0; k < 50; ++k) {
            const glm::vec3 at = middle + draw.within(20.0f);
            const float weight = shader::lodestar_volumeWeight(inShaders(*placed), at);
            EXPECT_GE(weight, 0.0f);
            EXPECT_LE(weight, 1.0f);
            const bool inside = glm::all(glm::greaterThanEqual(at, placed->low - 1e-3f)) &&
                                glm::all(glm::lessThanEqual(at, placed->high + 1e-3f));
            if (!inside) {
                EXPECT_EQ(weight, 0.0f);
            }
        }
    }
}

// Along axes that the frame does not turn the local box is the world's: the mean is that of points.
TEST(ProbeVolumes, TheMeanIsThatOfPoints) {
    Draw draw(2);
    for (int i = 0; i < 60; ++i) {
        const glm::mat4 frame = glm::scale(glm::translate(glm::mat4(1.0f), draw.within(2.0f)),
                                           {draw.uniform(0.5f, 2), -1.0f, 1.5f});
        const auto placed = place(draw.volume(false), frame, i % 3 == 0);
        ASSERT_TRUE(placed.has_value());
        const glm::vec3 low = placed->low + draw.within(2.0f);
        const glm::vec3 high = low + glm::abs(draw.within(4.0f));
        constexpr int kPoints = 40;
        double sum = 0.0;
        for (int k = 0; k < kPoints * kPoints * kPoints; ++k) {
            const glm::vec3 t =
                (glm::vec3(k % kPoints, k / kPoints % kPoints, k / kPoints / kPoints) + 0.5f) /
                static_cast<float>(kPoints);
            sum += static_cast<double>(
                shader::lodestar_volumeWeight(inShaders(*placed), glm::mix(low, high, t)));
        }
        // Midpoints in 40 parts: h^2 / 24 of a second derivative of 6 over the square of a blend
        // where it is a tenth of the box and more; a step within a part is half of one, three of
        // them.
        EXPECT_NEAR(meanWeight(*placed, low, high), sum / (kPoints * kPoints * kPoints), 0.04) << i;
    }
}

TEST(ProbeVolumes, ThePointsOwnWeightIsAPointsMean) {
    Draw draw(3);
    for (int i = 0; i < 2000; ++i) {
        const auto placed = place(draw.volume(i % 2 == 0), draw.frame(), i % 3 == 0);
        const glm::vec3 at = 0.5f * (placed->low + placed->high) + draw.within(3.0f);
        // Fades are up to 1.5 / 0.01 m steep in float; those of no width are steps.
        EXPECT_NEAR(meanWeight(*placed, at, at),
                    shader::lodestar_volumeWeight(inShaders(*placed), at), 2e-3f);
    }
}

TEST(ProbeVolumes, TheMeanDoesNotJump) {
    Draw draw(4);
    for (int i = 0; i < 100; ++i) {
        ProbeVolume volume = draw.volume(i % 2 == 0);
        for (double& blend : volume.blend) {
            blend = std::max(blend, 0.5);
        }
        const auto placed = place(volume, glm::mat4(1.0f), i % 3 == 0);
        const glm::vec3 half = glm::abs(draw.within(1.0f));
        const glm::vec3 step = 1e-3f * glm::normalize(draw.within(1.0f));
        glm::vec3 at = placed->low - 1.0f;
        float before = meanWeight(*placed, at - half, at + half);
        for (int k = 0; k < 4000; ++k) {
            at += step;
            const float now = meanWeight(*placed, at - half, at + half);
            // Each of three factors leans by 1.5 over half a metre at most.
            ASSERT_LT(std::abs(now - before), 3.0f * 1.5f / 0.5f * 1e-3f);
            before = now;
        }
    }
}

TEST(ProbeVolumes, WithoutAnInsideThereIsNone) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    ProbeVolume volume;
    EXPECT_TRUE(place(volume, glm::mat4(1.0f), false).has_value());
    EXPECT_TRUE(place(volume, glm::scale(glm::mat4(1.0f), {-1, 2, 0.5f}), false).has_value());
    for (const glm::mat4& frame :
         {glm::mat4(0.0f), glm::mat4(nan), glm::mat4(infinity),
          glm::scale(glm::mat4(1.0f), {1, 0, 1}), glm::scale(glm::mat4(1.0f), {1, 1, 1e-30f}),
          glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0),
                    glm::vec4(0, 0, 0, 1))}) {
        const auto placed = place(volume, frame, false);
        if (placed) { // thin, but finite in every part
            EXPECT_TRUE(std::isfinite(placed->measure));
            for (const glm::vec4& row : placed->rows) {
                EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(row), glm::vec4(infinity))));
            }
        }
    }
    for (const double bad : {static_cast<double>(nan), static_cast<double>(infinity), 1e39}) {
        ProbeVolume broken;
        broken.size.x = bad;
        EXPECT_FALSE(place(broken, glm::mat4(1.0f), true).has_value());
        broken = {};
        broken.blend[2] = bad;
        EXPECT_FALSE(place(broken, glm::mat4(1.0f), true).has_value());
    }
    const auto sound = place(ProbeVolume(), glm::mat4(1.0f), false);
    EXPECT_EQ(meanWeight(*sound, glm::vec3(-infinity), glm::vec3(infinity)), 0.0f);
    EXPECT_EQ(meanWeight(*sound, glm::vec3(nan), glm::vec3(1.0f)), 0.0f);
    for (const glm::dvec3& size : {glm::dvec3(1, 0, 1), glm::dvec3(-1, 1, 1), glm::dvec3(0.0)}) {
        volume.size = size;
        EXPECT_FALSE(place(volume, glm::mat4(1.0f), false).has_value());
    }
}

// A ray from a point in a room, on its wall or beyond it meets the walls where geometry says; from
// beyond it starts at the wall.
TEST(ProbeParallax, MeetsTheWallsWhereTheyAre) {
    Draw draw(6);
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 half(5.0f, 3.0f, 4.0f);
        ProbeVolume volume;
        volume.size = glm::dvec3(2.0f * half);
        const glm::mat4 frame = glm::rotate(glm::translate(glm::mat4(1.0f), draw.within(3.0f)),
                                            draw.uniform(0, 6), glm::vec3(0, 1, 0));
        const auto placed = place(volume, frame, false);
        const glm::vec3 local = draw.within(1.0f) * half * (i % 2 == 0 ? 1.0f : 1.3f);
        const glm::vec3 start = glm::clamp(local, -half, half);
        const glm::vec3 d = glm::normalize(draw.within(1.0f));
        const glm::vec3 captured = 0.5f * draw.within(1.0f) * half;
        float t = 1e30f;
        for (int axis = 0; axis < 3; ++axis) {
            const float wall = d[axis] > 0.0f ? half[axis] : -half[axis];
            t = std::min(t, std::max((wall - start[axis]) / d[axis], 0.0f));
        }
        const glm::vec3 truth = glm::normalize(start + t * d - captured);
        const glm::vec3 lookup = shader::lodestar_parallax(
            inShaders(*placed), glm::vec3(frame * glm::vec4(captured, 1.0f)),
            glm::vec3(frame * glm::vec4(local, 1.0f)), glm::mat3(frame) * d);
        const glm::vec3 found = glm::normalize(glm::transpose(glm::mat3(frame)) * lookup);
        // A texel of 256 is .006 to .012 radians; floats of 10 m keep 1e-5 of it.
        EXPECT_LT(glm::length(found - truth), 1e-4f) << i;
    }
}

// A face sees what lies within 45 degrees of its axis, between near and far: by points of boxes.
TEST(ProbeFaces, SeeWhatPointsSay) {
    Draw draw(5);
    int tight = 0, tried = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 position = draw.within(2.0f);
        const glm::vec3 low = draw.within(8.0f);
        const glm::vec3 high = low + glm::abs(draw.within(1.5f));
        unsigned seen = 0;
        for (int k = 0; k < 200; ++k) {
            const glm::vec3 t(draw.uniform(0, 1), draw.uniform(0, 1), draw.uniform(0, 1));
            const glm::vec3 d = glm::mix(low, high, t) - position;
            for (int face = 0; face < 6; ++face) {
                const int axis = face / 2;
                const float depth = face % 2 == 0 ? d[axis] : -d[axis];
                const float across =
                    std::max(std::abs(d[(axis + 1) % 3]), std::abs(d[(axis + 2) % 3]));
                seen |= depth >= 0.1f && depth <= 9.0f && across <= depth ? 1u << face : 0u;
            }
        }
        const unsigned faces = facesSeeing(position, 0.1, 9.0, low, high);
        EXPECT_EQ(seen & ~faces, 0u); // never too few
        tight += faces == seen ? 1 : 0;
        ++tried;
    }
    EXPECT_GT(tight, tried * 8 / 10); // and seldom too many: points miss slivers
    EXPECT_EQ(facesSeeing(glm::vec3(0), 0.1, 100.0, {-1, -1, -9}, {1, 1, -8}), 1u << 5);
    EXPECT_EQ(facesSeeing(glm::vec3(0), 0.1, 100.0, {8, -1, -1}, {9, 1, 1}), 1u);
    EXPECT_EQ(facesSeeing(glm::vec3(0), 0.1, 5.0, {8, -1, -1}, {9, 1, 1}), 0u);
    EXPECT_EQ(facesSeeing(glm::vec3(0), 0.1, 5.0, glm::vec3(-1), glm::vec3(1)), 0x3fu);
    EXPECT_EQ(facesSeeing(glm::vec3(0), 0.1, 5.0,
                          glm::vec3(std::numeric_limits<float>::quiet_NaN()), glm::vec3(1)),
              0x3fu);
}

} // namespace
} // namespace lodestar::lighting
