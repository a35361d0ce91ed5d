// SPDX-License-Identifier: MIT
//
// A camera moved by hand: about a point, across, towards it, or free. Values only; no input, no GL.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/camera.h"

namespace lodestar::scene {

/// Where a hand-moved camera stands: it looks along -Z of its orientation at the pivot.
struct CameraPose {
    glm::quat worldFromCamera{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 pivot{0.0f}; ///< what is orbited, metres
    float distance = 1.0f; ///< from the eye to the pivot, metres, > 0
    bool perspective = true;
    float verticalFov = kDefaultVerticalFov; ///< radians; perspective only
    float halfHeight = 1.0f;                 ///< metres; orthographic only

    [[nodiscard]] glm::vec3 right() const;
    [[nodiscard]] glm::vec3 up() const;
    [[nodiscard]] glm::vec3 forward() const;
    [[nodiscard]] glm::vec3 eye() const { return pivot - distance * forward(); }
};

/// The pose of a view; its pivot lies before the eye, as deep as the middle of the bounds, or on
/// the near side of it where the eye is inside them.
[[nodiscard]] CameraPose poseFromView(const View& view, const Bounds& bounds);

/// The view of a pose, with depth planes that hold the bounds. @param aspect width over height, > 0
[[nodiscard]] View viewFromPose(const CameraPose& pose, const Bounds& bounds, float aspect);

/// Turns the camera about the pivot. The horizon stays level, and the camera stops a little short
/// of looking straight up or down.
/// @param radians x to the left about the world's up, y over the top
void orbit(CameraPose& pose, const glm::vec2& radians);
/// Turns the camera about its eye, within the same bounds. @param radians x to the right, y up
void look(CameraPose& pose, const glm::vec2& radians);
/// Moves eye and pivot so that what is at the pivot's depth follows the pointer.
/// @param pixels x to the right, y down  @param viewportHeight in the same pixels, > 0
void pan(CameraPose& pose, const glm::vec2& pixels, float viewportHeight);
/// Goes to the pivot by a tenth of the distance for each step, never through it; an orthographic
/// camera magnifies. @param steps positive is nearer  @param bounds limit how near and how far
void dolly(CameraPose& pose, float steps, const Bounds& bounds);
/// Moves eye and pivot. @param metres along the camera's right, the world's up, the camera's
/// forward
void fly(CameraPose& pose, const glm::vec3& metres);
/// Keeps the direction and stands back so that all of the bounds is in the picture, the pivot in
/// its middle. Does nothing for empty bounds.
void frameAll(CameraPose& pose, const Bounds& bounds, float aspect);

/// Metres a second that cross the bounds in some four seconds. @param fast four times as much
[[nodiscard]] float flySpeed(const Bounds& bounds, bool fast);

} // namespace lodestar::scene
