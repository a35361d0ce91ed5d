// SPDX-License-Identifier: MIT
//
// Where a picture is taken from.
#pragma once

#include <optional>
#include <string>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/result.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// A view: right-handed, looking along -Z of the camera.
struct View {
    glm::mat4 cameraFromWorld{1.0f};
    glm::mat4 clipFromCamera{1.0f};
    glm::vec3 position{0.0f};                  ///< metres; perspective only
    glm::vec3 towardsViewer{0.0f, 0.0f, 1.0f}; ///< unit; orthographic only
    bool perspective = true;

    [[nodiscard]] glm::mat4 clipFromWorld() const { return clipFromCamera * cameraFromWorld; }
    /// Where the viewer is, homogeneous: a direction where the view is orthographic.
    [[nodiscard]] glm::vec4 viewer() const {
        return perspective ? glm::vec4(position, 1.0f) : glm::vec4(towardsViewer, 0.0f);
    }
    bool operator==(const View&) const = default;
};

/// What the user asked for; what is absent is chosen.
struct CameraRequest {
    std::string name;          ///< a camera's or its node's name, or its number; empty: the first
    std::optional<int> number; ///< one of the scene's, in order, whatever the names; one that
                               ///< is not there frames the scene
    std::optional<glm::vec3> eye;     ///< metres
    std::optional<glm::vec3> target;  ///< metres
    std::optional<float> verticalFov; ///< radians
};

inline constexpr float kDefaultVerticalFov = 0.785398163f; ///< 45 degrees

/// The view for a request: eye and target where given, else the named camera, else the file's
/// first, else one that frames the scene from the front, a little above.
/// @param aspect width over height  @errors Usage for a camera that is not there
[[nodiscard]] core::Result<View> chooseView(const Scene& scene, const CameraRequest& request,
                                            float aspect);

/// The names of the scene's cameras, in order.
[[nodiscard]] std::vector<std::string> cameraNames(const Scene& scene);

/// Which camera of the scene a name or else a number means. @errors Usage naming what there is
[[nodiscard]] core::Result<int> findCamera(const Scene& scene, const std::string& nameOrNumber);

/// Depths of the near and far plane, metres, that hold bounds as seen from an eye.
[[nodiscard]] glm::vec2 depthRange(const Bounds& bounds, const glm::mat4& cameraFromWorld);

/// Whether a world-space box may be seen: false only if it lies wholly outside one clip plane.
[[nodiscard]] bool mayBeSeen(const Bounds& worldBounds, const glm::mat4& clipFromWorld);

} // namespace lodestar::scene
