// SPDX-License-Identifier: MIT
#include "scene/animation.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/contract.h"

namespace lodestar::scene {
namespace {

/// Between which keys a time lies.
struct Place {
    std::size_t key = 0;  ///< the one before
    double t = 0.0;       ///< [0, 1) of the way to the next; 0: the key itself
    double seconds = 0.0; ///< from the key to the next; 0 behind the last
};

Place placeOf(const std::vector<float>& times, double seconds) {
    const auto after = std::upper_bound(times.begin(), times.end(), seconds,
                                        [](double a, float b) { return a < double{b}; });
    if (after == times.begin()) {
        return {};
    }
    const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) {
        return {key, 0.0, 0.0};
    }
    const double length = double{*after} - double{times[key]};
    return {key, (seconds - double{times[key]}) / length, length};
}

/// Weights of a cubic Hermite spline [glTF 2.0, appendix C.5]: of this key's value and out-tangent,
/// and the next one's value and in-tangent, tangents a second.
struct Hermite {
    double value0, tangent0, value1, tangent1;
};

Hermite hermite(double t, double seconds) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    return {2.0 * t3 - 3.0 * t2 + 1.0, seconds * (t3 - 2.0 * t2 + t), -2.0 * t3 + 3.0 * t2,
            seconds * (t3 - t2)};
}

/// Where part 0 (in-tangent), 1 (value) or 2 (out-tangent) of a key begins.
std::size_t at(const io::GltfAnimationSampler& sampler, std::size_t key, std::size_t part = 1) {
    return sampler.interpolation == io::Interpolation::CubicSpline
               ? (3 * key + part) * sampler.components
               : key * sampler.components;
}

std::vector<double> valuesAt(const io::GltfAnimationSampler& sampler, const Place& place) {
    std::vector<double> out(sampler.components);
    const std::vector<float>& v = sampler.values;
    const std::size_t n = place.key;
    const bool between = place.t > 0.0 && sampler.interpolation != io::Interpolation::Step;
    const Hermite h = hermite(place.t, place.seconds);
    for (std::size_t c = 0; c < out.size(); ++c) {
        const double value = v[at(sampler, n) + c];
        if (!between) {
            out[c] = value;
        } else if (sampler.interpolation == io::Interpolation::Linear) {
            out[c] = (1.0 - place.t) * value + place.t * double{v[at(sampler, n + 1) + c]};
        } else {
            out[c] = h.value0 * value + h.tangent0 * double{v[at(sampler, n, 2) + c]} +
                     h.value1 * double{v[at(sampler, n + 1) + c]} +
                     h.tangent1 * double{v[at(sampler, n + 1, 0) + c]};
        }
    }
    return out;
}

/// Of x, y, z, w; no rotation where they have no length.
glm::dquat unitQuaternion(double x, double y, double z, double w) {
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    return length > 1e-20 ? glm::dquat(w / length, x / length, y / length, z / length)
                          : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

glm::dquat keyRotation(const io::GltfAnimationSampler& sampler, std::size_t key) {
    const float* v = sampler.values.data() + at(sampler, key);
    return unitQuaternion(v[0], v[1], v[2], v[3]);
}

void restPose(Scene& scene) {
    for (Node& node : scene.nodes) {
        if (node.rest) {
            node.parentFromNode = node.rest->matrix();
        }
        for (Component& component : node.components) {
            if (auto* mesh = std::get_if<MeshComponent>(&component)) {
                mesh->weights = mesh->restWeights;
            }
        }
    }
}

void setWeights(Node& node, const std::vector<float>& weights) {
    for (Component& component : node.components) {
        if (auto* mesh = std::get_if<MeshComponent>(&component)) {
            mesh->weights = weights;
        }
    }
}

const io::GltfAnimation* animationOf(const Scene& scene, int animation) {
    LODESTAR_EXPECT(animation >= kRestPose && animation < static_cast<int>(scene.animations.size()),
                    "an animation is one of the scene's");
    return animation == kRestPose ? nullptr
                                  : &scene.animations[static_cast<std::size_t>(animation)];
}

} // namespace

double duration(const Scene& scene, int animation) {
    const io::GltfAnimation* moving = animationOf(scene, animation);
    double last = 0.0;
    if (moving != nullptr) {
        for (const io::GltfAnimationSampler& sampler : moving->samplers) {
            last = sampler.times.empty() ? last : std::max(last, double{sampler.times.back()});
        }
    }
    return last;
}

void pose(Scene& scene, int animation, double seconds) {
    const io::GltfAnimation* moving = animationOf(scene, animation);
    LODESTAR_EXPECT(std::isfinite(seconds), "a time is finite");
    restPose(scene);
    std::vector<std::optional<Trs>> moved(moving == nullptr ? 0 : scene.nodes.size());
    for (std::size_t c = 0; moving != nullptr && c < moving->channels.size(); ++c) {
        const io::GltfAnimationChannel& channel = moving->channels[c];
        const auto& sampler = moving->samplers[static_cast<std::size_t>(channel.sampler)];
        Node& node = scene.nodes[static_cast<std::size_t>(channel.node)];
        std::optional<Trs>& trs = moved[static_cast<std::size_t>(channel.node)];
        if (channel.path == io::AnimationPath::Weights) {
            setWeights(node, sampleValues(sampler, seconds));
            continue;
        }
        if (!node.rest) {
            continue;
        }
        trs = trs ? trs : node.rest;
        if (channel.path == io::AnimationPath::Rotation) {
            trs->rotation = sampleRotation(sampler, seconds);
        } else {
            const std::vector<float> v = sampleValues(sampler, seconds);
            (channel.path == io::AnimationPath::Scale ? trs->scale
                                                      : trs->translation) = {v[0], v[1], v[2]};
        }
    }
    for (std::size_t n = 0; n < moved.size(); ++n) {
        if (moved[n]) {
            scene.nodes[n].parentFromNode = moved[n]->matrix();
        }
    }
    updateTransforms(scene);
}

void reachOver(Scene& scene, int animation) {
    constexpr int kPoses = 32;
    const double last = duration(scene, animation);
    scene.reach = {}; // worldBounds() holds it, and another animation's is of the past
    Bounds reach;
    for (int i = 0; i <= kPoses; ++i) {
        pose(scene, animation, last * i / kPoses);
        reach.add(scene.worldBounds());
    }
    scene.reach = reach;
    pose(scene, kRestPose, 0.0);
}

std::vector<std::string> animationNames(const Scene& scene) {
    std::vector<std::string> names;
    for (const io::GltfAnimation& animation : scene.animations) {
        names.push_back(animation.name.empty() ? "animation " + std::to_string(names.size())
                                               : animation.name);
    }
    return names;
}

core::Result<int> findAnimation(const Scene& scene, const std::string& nameOrNumber) {
    const std::vector<std::string> names = animationNames(scene);
    const auto found = std::find(names.begin(), names.end(), nameOrNumber);
    if (found != names.end()) {
        return static_cast<int>(found - names.begin());
    }
    std::size_t number = 0;
    const char* end = nameOrNumber.data() + nameOrNumber.size();
    const auto parsed = std::from_chars(nameOrNumber.data(), end, number);
    if (parsed.ec == std::errc() && parsed.ptr == end && number < names.size()) {
        return static_cast<int>(number);
    }
    std::string list;
    for (const std::string& name : names) {
        list += (list.empty() ? "" : ", ") + name;
    }
    return core::Error{core::ErrorCode::Usage,
                       "there is no animation '" + nameOrNumber + "'; there " +
                           (names.empty() ? std::string("are none") : "is " + list),
                       {},
                       "--animation"};
}

std::vector<float> sampleValues(const io::GltfAnimationSampler& sampler, double seconds) {
    const std::vector<double> values = valuesAt(sampler, placeOf(sampler.times, seconds));
    return {values.begin(), values.end()};
}

glm::quat sampleRotation(const io::GltfAnimationSampler& sampler, double seconds) {
    const Place place = placeOf(sampler.times, seconds);
    if (place.t > 0.0 && sampler.interpolation == io::Interpolation::Linear) {
        return glm::quat(
            slerp(keyRotation(sampler, place.key), keyRotation(sampler, place.key + 1), place.t));
    }
    const std::vector<double> v = valuesAt(sampler, place);
    return glm::quat(unitQuaternion(v[0], v[1], v[2], v[3]));
}

glm::dquat slerp(const glm::dquat& from, const glm::dquat& to, double t) {
    // Through the sum and the difference: exact for small angles, where an arc cosine of the dot
    // product is not. The angle is at most pi/2 after the sign is chosen, so its sine only vanishes
    // for equal ends.
    const glm::dquat other = glm::dot(from, to) < 0.0 ? -to : to;
    const double angle = 2.0 * std::atan2(glm::length(other - from), glm::length(other + from));
    const double sine = std::sin(angle);
    if (!(sine > 1e-12)) {
        return from;
    }
    return glm::normalize(from * (std::sin((1.0 - t) * angle) / sine) +
                          other * (std::sin(t * angle) / sine));
}

} // namespace lodestar::scene
