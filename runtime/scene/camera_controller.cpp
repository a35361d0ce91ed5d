// SPDX-License-Identifier: MIT
#include "scene/camera_controller.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace lodestar::scene {
namespace {

constexpr glm::vec3 kWorldUp(0.0f, 1.0f, 0.0f);
/// The steepest look, as the sine of its elevation: 89.4 degrees.
constexpr float kSteepest = 0.99995f;
/// The bounds' radius where there is nothing to see.
constexpr float kNoRadius = 1.0f;

float radiusOf(const Bounds& bounds) {
    const float radius = bounds.radius();
    return std::isfinite(radius) && radius > 1e-6f ? radius : kNoRadius;
}

/// The turned orientation: about the world's up, then about the camera's right unless that would
/// look steeper than allowed.
glm::quat turned(const glm::quat& worldFromCamera, float yaw, float pitch) {
    const glm::quat level = glm::normalize(glm::angleAxis(yaw, kWorldUp) * worldFromCamera);
    const float sine = -(level * glm::vec3(0.0f, 0.0f, 1.0f)).y; // of the elevation looked at
    const float elevation = std::asin(std::clamp(sine, -1.0f, 1.0f));
    const float limit = std::asin(kSteepest);
    const bool upright = (level * kWorldUp).y >= 0.0f;
    // A camera that stands on its head keeps its own sense of up. A view that is steeper than the
    // limit from the start may only come down.
    const float wanted = elevation + (upright ? pitch : -pitch);
    const float allowed =
        std::clamp(wanted, std::min(-limit, elevation), std::max(limit, elevation));
    const float turn = upright ? allowed - elevation : elevation - allowed;
    return glm::normalize(level * glm::angleAxis(turn, glm::vec3(1.0f, 0.0f, 0.0f)));
}

} // namespace

glm::vec3 CameraPose::right() const {
    return worldFromCamera * glm::vec3(1.0f, 0.0f, 0.0f);
}

glm::vec3 CameraPose::up() const {
    return worldFromCamera * glm::vec3(0.0f, 1.0f, 0.0f);
}

glm::vec3 CameraPose::forward() const {
    return worldFromCamera * glm::vec3(0.0f, 0.0f, -1.0f);
}

CameraPose poseFromView(const View& view, const Bounds& bounds) {
    CameraPose pose;
    const glm::mat4 worldFromCamera = glm::inverse(view.cameraFromWorld);
    pose.worldFromCamera = glm::normalize(glm::quat_cast(glm::mat3(worldFromCamera)));
    pose.perspective = view.perspective;
    if (view.perspective) {
        pose.verticalFov = 2.0f * std::atan(1.0f / view.clipFromCamera[1][1]);
    } else {
        pose.halfHeight = 1.0f / view.clipFromCamera[1][1];
    }
    const glm::vec3 eye(worldFromCamera[3]);
    const float radius = radiusOf(bounds);
    const glm::vec3 center = bounds.empty() ? eye + pose.forward() * radius : bounds.center();
    pose.distance = std::max(glm::dot(center - eye, pose.forward()), 0.25f * radius);
    pose.pivot = eye + pose.distance * pose.forward();
    return pose;
}

View viewFromPose(const CameraPose& pose, const Bounds& bounds, float aspect) {
    LODESTAR_EXPECT(aspect > 0.0f, "a picture has a size");
    View view;
    view.position = pose.eye();
    view.towardsViewer = -pose.forward();
    view.perspective = pose.perspective;
    view.cameraFromWorld = glm::mat4_cast(glm::conjugate(pose.worldFromCamera)) *
                           glm::translate(glm::mat4(1.0f), -view.position);
    glm::vec2 planes = depthRange(bounds, view.cameraFromWorld);
    if (pose.perspective) {
        view.clipFromCamera = glm::perspective(pose.verticalFov, aspect, planes.x, planes.y);
    } else {
        // Without a vanishing point nothing is behind the eye.
        const float radius = 1.01f * radiusOf(bounds);
        const glm::vec3 center = bounds.empty() ? pose.pivot : bounds.center();
        const float depth = glm::dot(center - view.position, pose.forward());
        planes = {depth - radius, depth + radius};
        const float x = pose.halfHeight * aspect;
        view.clipFromCamera =
            glm::ortho(-x, x, -pose.halfHeight, pose.halfHeight, planes.x, planes.y);
    }
    return view;
}

void orbit(CameraPose& pose, const glm::vec2& radians) {
    pose.worldFromCamera = turned(pose.worldFromCamera, -radians.x, -radians.y);
}

void look(CameraPose& pose, const glm::vec2& radians) {
    const glm::vec3 eye = pose.eye();
    pose.worldFromCamera = turned(pose.worldFromCamera, -radians.x, radians.y);
    pose.pivot = eye + pose.distance * pose.forward();
}

void pan(CameraPose& pose, const glm::vec2& pixels, float viewportHeight) {
    LODESTAR_EXPECT(viewportHeight > 0.0f, "a viewport has a height");
    const float halfHeight =
        pose.perspective ? pose.distance * std::tan(0.5f * pose.verticalFov) : pose.halfHeight;
    const glm::vec2 metres = pixels * (2.0f * halfHeight / viewportHeight);
    pose.pivot += pose.up() * metres.y - pose.right() * metres.x;
}

void dolly(CameraPose& pose, float steps, const Bounds& bounds) {
    const float radius = radiusOf(bounds);
    const float factor = std::pow(0.9f, steps);
    const auto scaled = [&](float value) {
        // A start outside the limits stays, but does not go further out.
        return std::clamp(value * factor, std::min(value, 1e-3f * radius),
                          std::max(value, 1e2f * radius));
    };
    float& size = pose.perspective ? pose.distance : pose.halfHeight;
    size = scaled(size);
}

void fly(CameraPose& pose, const glm::vec3& metres) {
    pose.pivot += pose.right() * metres.x + kWorldUp * metres.y + pose.forward() * metres.z;
}

void frameAll(CameraPose& pose, const Bounds& bounds, float aspect) {
    constexpr float kMargin = 1.08f; // of the half angles' tangents
    if (bounds.empty()) {
        return;
    }
    const float tangent = std::tan(0.5f * pose.verticalFov);
    float distance = 1e-4f * radiusOf(bounds);
    float halfHeight = 1e-4f * radiusOf(bounds);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p = glm::vec3((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                                      (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                                      (corner & 4) != 0 ? bounds.high.z : bounds.low.z) -
                            bounds.center();
        const float across = std::max(std::abs(glm::dot(p, pose.right())) / aspect,
                                      std::abs(glm::dot(p, pose.up())));
        halfHeight = std::max(halfHeight, kMargin * across);
        distance = std::max(distance, kMargin * across / tangent - glm::dot(p, pose.forward()));
    }
    pose.pivot = bounds.center();
    pose.halfHeight = halfHeight;
    pose.distance = pose.perspective ? distance : std::max(pose.distance, radiusOf(bounds));
}

float flySpeed(const Bounds& bounds, bool fast) {
    return radiusOf(bounds) * (fast ? 2.0f : 0.5f);
}

} // namespace lodestar::scene
