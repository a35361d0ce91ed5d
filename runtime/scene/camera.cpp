// SPDX-License-Identifier: MIT
#include "scene/camera.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace lodestar::scene {
namespace {

struct PlacedCamera {
    const Node* node;
    const io::GltfCamera* camera;
};

std::vector<PlacedCamera> placedCameras(const Scene& scene) {
    std::vector<PlacedCamera> cameras;
    for (const Node& node : scene.nodes) {
        for (const Component& component : node.components) {
            if (const auto* camera = std::get_if<CameraComponent>(&component)) {
                cameras.push_back({&node, &camera->camera});
            }
        }
    }
    return cameras;
}

std::string nameOf(const PlacedCamera& placed) {
    return placed.camera->name.empty() ? placed.node->name : placed.camera->name;
}

View lookAt(const Scene& scene, const glm::vec3& eye, const glm::vec3& target, float verticalFov,
            float aspect) {
    glm::vec3 forward = target - eye;
    const float distance = glm::length(forward);
    forward = distance > 0.0f ? forward / distance : glm::vec3(0.0f, 0.0f, -1.0f);
    const glm::vec3 up = std::abs(forward.y) < 0.999f ? glm::vec3(0.0f, 1.0f, 0.0f)
                                                      : glm::vec3(0.0f, 0.0f, -forward.y);
    View view;
    view.position = eye;
    view.cameraFromWorld = glm::lookAt(eye, eye + forward, up);
    const glm::vec2 planes = depthRange(scene.worldBounds(), view.cameraFromWorld);
    view.clipFromCamera = glm::perspective(verticalFov, aspect, planes.x, planes.y);
    return view;
}

/// How far from the target an eye along `direction` must be for all of a box to be in the picture.
float distanceToFrame(const Bounds& bounds, const glm::vec3& direction, float verticalFov,
                      float aspect) {
    constexpr float kMargin = 1.08f; // of the half angles' tangents
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), direction));
    const glm::vec3 up = glm::cross(direction, right);
    const float tangent = std::tan(0.5f * verticalFov);
    float distance = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p = glm::vec3((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                                      (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                                      (corner & 4) != 0 ? bounds.high.z : bounds.low.z) -
                            bounds.center();
        const float across = std::max(std::abs(glm::dot(p, right)) / (tangent * aspect),
                                      std::abs(glm::dot(p, up)) / tangent);
        distance = std::max(distance, glm::dot(p, direction) + kMargin * across);
    }
    return std::max(distance, 1e-4f);
}

/// Frames everything from the front right, a little above.
View frame(const Scene& scene, float verticalFov, float aspect) {
    const glm::vec3 direction = glm::normalize(glm::vec3(0.45f, 0.3f, 1.0f));
    Bounds bounds = scene.worldBounds();
    if (bounds.empty()) {
        bounds.add(glm::vec3(-1.0f));
        bounds.add(glm::vec3(1.0f));
    }
    const glm::vec3 eye =
        bounds.center() + direction * distanceToFrame(bounds, direction, verticalFov, aspect);
    return lookAt(scene, eye, bounds.center(), verticalFov, aspect);
}

View fromCamera(const Scene& scene, const PlacedCamera& placed, float aspect,
                std::optional<float> verticalFov) {
    const io::GltfCamera& camera = *placed.camera;
    // A camera's pose is its node's without scale.
    const glm::mat4& world = placed.node->worldFromNode;
    const auto axis = [&](int column, const glm::vec3& fallback) {
        const glm::vec3 v(world[column]);
        const float length = glm::length(v);
        return length > 1e-12f ? v / length : fallback;
    };
    const glm::vec3 back = axis(2, glm::vec3(0.0f, 0.0f, 1.0f));
    const glm::vec3 up = axis(1, glm::vec3(0.0f, 1.0f, 0.0f));
    View view;
    view.position = glm::vec3(world[3]);
    view.towardsViewer = back;
    view.cameraFromWorld = glm::lookAt(view.position, view.position - back, up);
    view.perspective = camera.perspective;
    if (camera.perspective) {
        const float farPlane =
            std::isfinite(camera.farPlane)
                ? camera.farPlane
                : std::max(depthRange(scene.worldBounds(), view.cameraFromWorld).y,
                           camera.nearPlane * 2.0f);
        view.clipFromCamera = glm::perspective(verticalFov.value_or(camera.verticalFov), aspect,
                                               camera.nearPlane, farPlane);
    } else {
        // The magnified width is kept, as a perspective keeps its vertical field of view.
        const float x = std::max(camera.xMagnification, camera.yMagnification * aspect);
        view.clipFromCamera =
            glm::ortho(-x, x, -x / aspect, x / aspect, camera.nearPlane, camera.farPlane);
    }
    return view;
}

} // namespace

glm::vec2 depthRange(const Bounds& bounds, const glm::mat4& cameraFromWorld) {
    const float radius = std::max(bounds.radius(), 1e-4f);
    const glm::vec3 center = bounds.empty() ? glm::vec3(0.0f) : bounds.center();
    const float depth = -glm::vec3(cameraFromWorld * glm::vec4(center, 1.0f)).z;
    const float farPlane = std::max(depth + 1.01f * radius, 1e-3f);
    return {std::max(depth - 1.01f * radius, farPlane * 1e-4f), farPlane};
}

std::vector<std::string> cameraNames(const Scene& scene) {
    std::vector<std::string> names;
    for (const PlacedCamera& placed : placedCameras(scene)) {
        names.push_back(nameOf(placed));
    }
    return names;
}

core::Result<int> findCamera(const Scene& scene, const std::string& nameOrNumber) {
    const std::vector<PlacedCamera> cameras = placedCameras(scene);
    std::string known;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        if (nameOf(cameras[i]) == nameOrNumber || cameras[i].node->name == nameOrNumber) {
            return static_cast<int>(i);
        }
        known += (known.empty() ? "" : ", ") + nameOf(cameras[i]);
    }
    std::size_t number = 0;
    const char* end = nameOrNumber.data() + nameOrNumber.size();
    const auto [stop, error] = std::from_chars(nameOrNumber.data(), end, number);
    if (error == std::errc{} && stop == end && number < cameras.size()) {
        return static_cast<int>(number);
    }
    return core::Error{core::ErrorCode::Usage,
                       "no camera '" + nameOrNumber + "'; the scene has " +
                           (known.empty() ? "none" : std::to_string(cameras.size()) + ": " + known),
                       {},
                       "--camera"};
}

core::Result<View> chooseView(const Scene& scene, const CameraRequest& request, float aspect) {
    const float fov = request.verticalFov.value_or(kDefaultVerticalFov);
    if (request.eye || request.target) {
        const Bounds bounds = scene.worldBounds();
        const glm::vec3 center = bounds.empty() ? glm::vec3(0.0f) : bounds.center();
        const glm::vec3 target = request.target.value_or(center);
        const glm::vec3 eye = request.eye.value_or(
            target + glm::normalize(glm::vec3(0.45f, 0.3f, 1.0f)) *
                         (std::max(bounds.radius(), 1e-4f) / std::sin(0.5f * fov)));
        return lookAt(scene, eye, target, fov, aspect);
    }
    const std::vector<PlacedCamera> cameras = placedCameras(scene);
    int number = request.number.value_or(0);
    if (!request.name.empty() && !request.number) {
        const core::Result<int> found = findCamera(scene, request.name);
        if (!found) {
            return found.error();
        }
        number = *found;
    }
    if (number < 0 || number >= static_cast<int>(cameras.size())) {
        return frame(scene, fov, aspect);
    }
    return fromCamera(scene, cameras[static_cast<std::size_t>(number)], aspect,
                      request.verticalFov);
}

bool mayBeSeen(const Bounds& worldBounds, const glm::mat4& clipFromWorld) {
    if (worldBounds.empty()) {
        return false;
    }
    int outside[6] = {};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 clip =
            clipFromWorld * glm::vec4((corner & 1) != 0 ? worldBounds.high.x : worldBounds.low.x,
                                      (corner & 2) != 0 ? worldBounds.high.y : worldBounds.low.y,
                                      (corner & 4) != 0 ? worldBounds.high.z : worldBounds.low.z,
                                      1.0f);
        for (int axis = 0; axis < 3; ++axis) {
            outside[2 * axis] += clip[axis] < -clip.w ? 1 : 0;
            outside[2 * axis + 1] += clip[axis] > clip.w ? 1 : 0;
        }
    }
    return std::none_of(std::begin(outside), std::end(outside),
                        [](int count) { return count == 8; });
}

} // namespace lodestar::scene
