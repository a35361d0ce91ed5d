// SPDX-License-Identifier: MIT
//
// A scene's animations: the pose of its nodes at a time. Source: glTF 2.0 specification, section
// 3.11 and appendix C.
#pragma once

#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "core/result.h"
#include "scene/scene.h"

namespace lodestar::scene {

inline constexpr int kRestPose = -1; ///< the animation that moves nothing

/// Time of an animation's last key, in seconds; 0 for kRestPose and an animation without keys.
/// @pre animation is kRestPose or below scene.animations.size()
[[nodiscard]] double duration(const Scene& scene, int animation);

/// Puts the scene into an animation's pose, transforms up to date. What the animation does not move
/// is as in the file, whatever was posed before. Before the first key and behind the last the pose
/// is theirs; a loop is the caller's. @param seconds finite  @pre as duration's
void pose(Scene& scene, int animation, double seconds);

/// Makes worldBounds() hold an animation's poses too, by its poses at even times: what a camera
/// that frames the scene must see. The scene is left in its rest pose.
void reachOver(Scene& scene, int animation);

/// Names of the animations, in order; "animation N" where the file gives none.
[[nodiscard]] std::vector<std::string> animationNames(const Scene& scene);

/// An animation by its name or else its number. @errors Usage naming what there is
[[nodiscard]] core::Result<int> findAnimation(const Scene& scene, const std::string& nameOrNumber);

/// A sampler's numbers at a time, component by component (a quaternion: use sampleRotation).
/// @pre the sampler has times
[[nodiscard]] std::vector<float> sampleValues(const io::GltfAnimationSampler& sampler,
                                              double seconds);
/// A sampler of quaternions at a time: a unit quaternion. LINEAR is spherical, the short way.
/// @pre the sampler has times and 4 components
[[nodiscard]] glm::quat sampleRotation(const io::GltfAnimationSampler& sampler, double seconds);

/// Between unit quaternions at constant angular speed, the short way; safe where they are nearly
/// the same or opposite. @param t [0, 1]
[[nodiscard]] glm::dquat slerp(const glm::dquat& from, const glm::dquat& to, double t);

} // namespace lodestar::scene
