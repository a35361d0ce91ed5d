// SPDX-License-Identifier: MIT
//
// Interpolations against closed forms, poses, and the boxes about deformed meshes.
#include "scene/animation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace lodestar {
namespace {

constexpr double kPi = 3.14159265358979323846;

glm::dquat about(const glm::dvec3& axis, double angle) {
    return glm::dquat(std::cos(0.5 * angle), std::sin(0.5 * angle) * axis);
}

/// Angle of the rotation from one to the other.
double angleBetween(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat other = glm::dot(a, b) < 0.0 ? -b : b;
    return 4.0 * std::atan2(glm::length(other - a), glm::length(other + a));
}

io::GltfAnimationSampler sampler(io::Interpolation interpolation, std::vector<float> times,
                                 std::vector<float> values, std::size_t components) {
    return {interpolation, std::move(times), std::move(values), components};
}

TEST(Sampling, StepHoldsUntilTheNextKey) {
    const auto s = sampler(io::Interpolation::Step, {1, 2, 4}, {10, 20, 30}, 1);
    const std::pair<double, float> expected[] = {{0.0, 10}, {1.0, 10}, {1.999, 10}, {2.0, 20},
                                                 {3.9, 20}, {4.0, 30}, {99.0, 30},  {-5.0, 10}};
    for (const auto& [time, value] : expected) {
        EXPECT_EQ(scene::sampleValues(s, time).at(0), value) << time;
    }
}

TEST(Sampling, LinearIsAStraightLineAndHoldsOutside) {
    const auto s = sampler(io::Interpolation::Linear, {1, 3}, {0, 100, 4, -100}, 2);
    for (double t = 0.0; t <= 4.0; t += 0.125) {
        const double u = std::min(std::max((t - 1.0) / 2.0, 0.0), 1.0);
        const std::vector<float> v = scene::sampleValues(s, t);
        EXPECT_FLOAT_EQ(v[0], static_cast<float>(4.0 * u));
        EXPECT_FLOAT_EQ(v[1], static_cast<float>(100.0 - 200.0 * u));
    }
}

TEST(Sampling, CubicSplineReproducesACubic) {
    // p(t) = t^3 - 2 t over [0, 2] and [2, 3]; tangents are its derivative 3 t^2 - 2.
    const auto s =
        sampler(io::Interpolation::CubicSpline, {0, 2, 3}, {99, 0, -2, 10, 4, 10, 25, 21, 99}, 1);
    for (double t = 0.0; t <= 3.0; t += 0.0625) {
        EXPECT_NEAR(scene::sampleValues(s, t).at(0), t * t * t - 2.0 * t, 3e-6) << t;
    }
    EXPECT_EQ(scene::sampleValues(s, -1.0).at(0), 0.0f);
    EXPECT_EQ(scene::sampleValues(s, 9.0).at(0), 21.0f);
}

TEST(Sampling, ASplineOfRotationsIsUnit) {
    const auto s =
        sampler(io::Interpolation::CubicSpline, {0, 1},
                {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 0, -2, 0, 0, 0, 1, 0, 0, 0, 0, 0}, 4);
    for (double t = 0.0; t <= 1.0; t += 0.1) {
        EXPECT_NEAR(glm::length(scene::sampleRotation(s, t)), 1.0, 1e-6) << t;
    }
    // By the Hermite weights at 1/2: z = 3/8 + 1/2 + 2/8, w = 1/2.
    const glm::quat middle = scene::sampleRotation(s, 0.5);
    EXPECT_NEAR(middle.z / middle.w, (0.375 + 0.5 + 0.25) / 0.5, 1e-6);
}

TEST(Slerp, TurnsAtConstantSpeedTheShortWay) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, -2.0, 0.5));
    const glm::dquat from = about(glm::normalize(glm::dvec3(0.3, 1.0, 0.2)), 1.1);
    for (const double angle : {0.0, 1e-12, 1e-9, 1e-6, 0.3, 1.5, 3.0, kPi - 1e-6, kPi - 1e-12}) {
        for (const double sign : {1.0, -1.0}) {
            const glm::dquat to = (about(axis, angle) * from) * sign;
            for (double t = 0.0; t <= 1.0; t += 0.125) {
                const glm::dquat expected = about(axis, t * angle) * from;
                const glm::dquat got = scene::slerp(from, to, t);
                EXPECT_NEAR(angleBetween(got, expected), 0.0, 4e-12) << angle << " " << t;
                EXPECT_NEAR(glm::length(got), 1.0, 1e-14);
            }
        }
    }
}

TEST(Slerp, OppositeRotationsTurnEitherWayButEvenly) {
    const glm::dquat from(1.0, 0.0, 0.0, 0.0);
    const glm::dquat to = about({0.0, 0.0, 1.0}, kPi);
    EXPECT_NEAR(angleBetween(from, scene::slerp(from, to, 0.25)), 0.25 * kPi, 1e-12);
    EXPECT_NEAR(angleBetween(to, scene::slerp(from, to, 0.25)), 0.75 * kPi, 1e-12);
}

/// Two animations: one turns and moves node 0, the other morphs it.
io::GltfFile animatedFile() {
    io::GltfPrimitive primitive = testing::square();
    io::GltfMorphTarget target;
    target.positions.assign(4, {0, 0, 2});
    primitive.targets.push_back(target);
    io::GltfFile file = testing::fileOf(primitive, {});
    file.nodes[0].weights = {0.25f};
    file.nodes[0].translation = {5, 0, 0};
    io::GltfAnimation turn;
    turn.name = "turn";
    const auto half = static_cast<float>(std::sqrt(0.5));
    turn.samplers = {sampler(io::Interpolation::Linear, {0, 1}, {0, 0, 0, 1, 0, 0, half, half}, 4),
                     sampler(io::Interpolation::Linear, {0, 2}, {0, 0, 0, 0, 8, 0}, 3)};
    turn.channels = {{0, io::AnimationPath::Rotation, 0}, {0, io::AnimationPath::Translation, 1}};
    io::GltfAnimation morph;
    morph.samplers = {sampler(io::Interpolation::Linear, {0, 1}, {0, 1}, 1)};
    morph.channels = {{0, io::AnimationPath::Weights, 0}};
    file.animations = {turn, morph};
    return file;
}

float weightOf(const scene::Scene& scene) {
    return std::get<scene::MeshComponent>(scene.nodes.at(0).components.at(0)).weights.at(0);
}

TEST(Pose, IsThatOfTheTimeAndNothingElse) {
    scene::Scene scene = scene::buildScene(animatedFile());
    const glm::mat4 rest = scene.nodes[0].worldFromNode;
    EXPECT_EQ(rest[3], glm::vec4(5, 0, 0, 1));
    EXPECT_EQ(weightOf(scene), 0.25f);
    EXPECT_EQ(scene::duration(scene, 0), 2.0);
    EXPECT_EQ(scene::duration(scene, 1), 1.0);
    EXPECT_EQ(scene::duration(scene, scene::kRestPose), 0.0);
    scene::pose(scene, 0, 1.0);
    EXPECT_EQ(scene.nodes[0].worldFromNode[3], glm::vec4(0, 4, 0, 1));
    EXPECT_NEAR(scene.nodes[0].worldFromNode[0].y, 1.0, 1e-6); // a quarter turn about z
    EXPECT_EQ(weightOf(scene), 0.25f);
    scene::pose(scene, 1, 0.5);
    EXPECT_EQ(weightOf(scene), 0.5f);
    EXPECT_EQ(scene.nodes[0].worldFromNode, rest);
    scene::pose(scene, scene::kRestPose, 3.0);
    EXPECT_EQ(weightOf(scene), 0.25f);
}

TEST(Pose, AnimationsAreFoundByNameAndNumber) {
    const scene::Scene scene = scene::buildScene(animatedFile());
    EXPECT_EQ(scene::animationNames(scene), (std::vector<std::string>{"turn", "animation 1"}));
    EXPECT_EQ(*scene::findAnimation(scene, "turn"), 0);
    EXPECT_EQ(*scene::findAnimation(scene, "1"), 1);
    EXPECT_FALSE(scene::findAnimation(scene, "2").ok());
    EXPECT_NE(scene::findAnimation(scene, "walk").error().message().find("turn"),
              std::string::npos);
}

TEST(Bounds, HoldMorphedVertices) {
    scene::Scene scene = scene::buildScene(animatedFile());
    scene::pose(scene, 1, 1.0); // weight 1 lifts the square to z = 2, at x = 5
    const scene::Bounds bounds = scene.worldBounds();
    EXPECT_LE(bounds.low.z, 2.0f);
    EXPECT_GE(bounds.high.z, 2.0f);
    EXPECT_EQ(bounds.low.x, 4.0f);
    scene::reachOver(scene, 0);
    EXPECT_GE(scene.worldBounds().high.y, 9.0f); // the end of "turn": 8 up, half side 1
}

} // namespace
} // namespace lodestar
