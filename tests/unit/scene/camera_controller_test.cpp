// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>

#include "scene/camera_controller.h"

namespace lodestar::scene {
namespace {

Bounds cube(float half) {
    Bounds bounds;
    bounds.add(glm::vec3(-half));
    bounds.add(glm::vec3(half));
    return bounds;
}

/// An eye on +Z that looks at the origin.
CameraPose front(float distance) {
    CameraPose pose;
    pose.distance = distance;
    return pose;
}

/// Pixels right of and below the middle of a picture, in halves of its height.
glm::vec2 seenAt(const CameraPose& pose, const glm::vec3& point, float aspect = 1.0f) {
    const View view = viewFromPose(pose, cube(1.0f), aspect);
    const glm::vec4 clip = view.clipFromWorld() * glm::vec4(point, 1.0f);
    return {clip.x / clip.w * aspect, -clip.y / clip.w};
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

// A few float operations on numbers of this size; 2^-24 each.
constexpr float kRounding = 1e-5f;

TEST(CameraController, AViewSurvivesItsPose) {
    Scene scene;
    for (const glm::vec3& eye :
         {glm::vec3(3, 2, 5), glm::vec3(-4, -1, 0.5f), glm::vec3(0, 0.2f, 0)}) {
        CameraRequest request;
        request.eye = eye;
        request.target = glm::vec3(0.5f, 0.0f, 0.0f);
        request.verticalFov = 0.6f;
        const View view = chooseView(scene, request, 1.5f).value();
        const View again = viewFromPose(poseFromView(view, cube(1.0f)), cube(1.0f), 1.5f);
        expectNear(again.position, view.position, 10.0f * kRounding);
        for (int column = 0; column < 4; ++column) {
            expectNear(glm::vec3(again.cameraFromWorld[column]),
                       glm::vec3(view.cameraFromWorld[column]), 10.0f * kRounding);
        }
        EXPECT_NEAR(again.clipFromCamera[1][1], view.clipFromCamera[1][1], kRounding);
        EXPECT_NEAR(again.clipFromCamera[0][0], view.clipFromCamera[0][0], kRounding);
    }
}

TEST(CameraController, OrbitKeepsDistanceAndPivotInTheMiddle) {
    CameraPose pose = front(4.0f);
    for (int i = 0; i < 1000; ++i) {
        orbit(pose, {0.13f * std::sin(0.1f * static_cast<float>(i)), 0.05f});
        EXPECT_NEAR(glm::length(pose.eye()), 4.0f, 10.0f * kRounding);
        EXPECT_NEAR(pose.right().y, 0.0f, 1000.0f * kRounding) << "the horizon tilts";
    }
    EXPECT_NEAR(seenAt(pose, glm::vec3(0.0f)).x, 0.0f, 1e-4f);
}

TEST(CameraController, OrbitToTheRightShowsTheLeftSide) {
    CameraPose pose = front(4.0f);
    orbit(pose, {0.5f, 0.0f});
    EXPECT_LT(pose.eye().x, 0.0f);
    pose = front(4.0f);
    orbit(pose, {0.0f, 0.5f}); // dragged down: the top comes into sight
    EXPECT_GT(pose.eye().y, 0.0f);
}

TEST(CameraController, OrbitStopsShortOfThePolesAndComesBack) {
    for (float turn : {10.0f, -10.0f}) {
        CameraPose pose = front(4.0f);
        orbit(pose, {0.0f, turn});
        EXPECT_LT(std::abs(pose.forward().y), 1.0f);
        EXPECT_GT(std::abs(pose.forward().y), 0.999f);
        EXPECT_GT(pose.up().y, 0.0f) << "over the pole";
        orbit(pose, {0.0f, turn > 0.0f ? -1.0f : 1.0f});
        EXPECT_LT(std::abs(pose.forward().y), 0.9f);
    }
}

TEST(CameraController, PanKeepsThePivotUnderThePointer) {
    for (bool perspective : {true, false}) {
        CameraPose pose = front(4.0f);
        pose.perspective = perspective;
        pose.halfHeight = 2.0f;
        orbit(pose, {0.7f, 0.3f});
        pan(pose, {30.0f, -20.0f}, 200.0f);
        const glm::vec2 at = seenAt(pose, glm::vec3(0.0f));
        EXPECT_NEAR(at.x, 30.0f / 100.0f, 1e-4f) << perspective;
        EXPECT_NEAR(at.y, -20.0f / 100.0f, 1e-4f) << perspective;
    }
}

TEST(CameraController, DollyNeverPassesThePivotAndIsUndone) {
    const Bounds bounds = cube(1.0f);
    CameraPose pose = front(4.0f);
    dolly(pose, 1.0f, bounds);
    EXPECT_NEAR(pose.distance, 3.6f, kRounding);
    dolly(pose, -1.0f, bounds);
    EXPECT_NEAR(pose.distance, 4.0f, kRounding);
    for (int i = 0; i < 1000; ++i) {
        dolly(pose, 5.0f, bounds);
    }
    EXPECT_GT(pose.distance, 0.0f);
    for (int i = 0; i < 1000; ++i) {
        dolly(pose, -5.0f, bounds);
    }
    EXPECT_LE(pose.distance, 1e3f * bounds.radius());
    expectNear(pose.pivot, glm::vec3(0.0f), 0.0f);
}

TEST(CameraController, LookTurnsAboutTheEye) {
    CameraPose pose = front(4.0f);
    const glm::vec3 eye = pose.eye();
    look(pose, {0.4f, 0.2f});
    expectNear(pose.eye(), eye, 10.0f * kRounding);
    EXPECT_GT(pose.forward().x, 0.0f);
    EXPECT_NEAR(pose.forward().y, std::sin(0.2f), kRounding);
}

TEST(CameraController, FlyGoesAlongItsAxes) {
    CameraPose pose = front(4.0f);
    fly(pose, {1.0f, 2.0f, 3.0f});
    expectNear(pose.eye(), {1.0f, 2.0f, 1.0f}, kRounding);
    EXPECT_NEAR(flySpeed(cube(1.0f), true), 4.0f * flySpeed(cube(1.0f), false), kRounding);
}

TEST(CameraController, FrameAllShowsEveryCornerAndFillsThePicture) {
    Bounds bounds;
    bounds.add(glm::vec3(5, 1, -3));
    bounds.add(glm::vec3(6, 4, -2.5f));
    for (bool perspective : {true, false}) {
        for (float aspect : {0.4f, 1.0f, 2.5f}) {
            CameraPose pose = front(40.0f);
            pose.perspective = perspective;
            orbit(pose, {0.9f, 0.4f});
            frameAll(pose, bounds, aspect);
            const View view = viewFromPose(pose, bounds, aspect);
            float largest = 0.0f;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 p((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                                  (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                                  (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
                const glm::vec4 clip = view.clipFromWorld() * glm::vec4(p, 1.0f);
                largest = std::max({largest, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
                EXPECT_LE(std::abs(clip.z), clip.w) << "behind a depth plane";
            }
            EXPECT_LE(largest, 1.0f);
            EXPECT_GE(largest, 0.9f) << "the margin is 8 %";
        }
    }
}

TEST(CameraController, AnEmptySceneCanBeLookedAt) {
    const Bounds nothing;
    CameraPose pose = front(1.0f);
    frameAll(pose, nothing, 1.0f);
    dolly(pose, 3.0f, nothing);
    const View view = viewFromPose(pose, nothing, 1.0f);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            EXPECT_TRUE(std::isfinite(view.clipFromWorld()[column][row]));
        }
    }
    EXPECT_GT(flySpeed(nothing, false), 0.0f);
}

} // namespace
} // namespace lodestar::scene
