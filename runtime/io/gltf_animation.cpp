// SPDX-License-Identifier: MIT
//
// Animations. Source: glTF 2.0 specification, section 3.11 and appendix C.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr std::array<const char*, 4> kPaths = {"translation", "rotation", "scale", "weights"};
constexpr std::array<const char*, 3> kInterpolations = {"STEP", "LINEAR", "CUBICSPLINE"};

/// One animation on its way.
class AnimationReader {
public:
    AnimationReader(GltfContext& context, const Json& json, std::string at)
        : context_(context), json_(json), at_(std::move(at)) {}

    core::Result<GltfAnimation> read() {
        if (const Json* name = member(json_, "name")) {
            animation_.name = name->get<std::string>();
        }
        animation_.samplers.resize(json_["samplers"].size());
        for (std::size_t c = 0; c < json_["channels"].size(); ++c) {
            core::Result<void> done = readChannel(c);
            if (!done) {
                return done.error();
            }
        }
        return std::move(animation_);
    }

private:
    core::Result<void> readChannel(std::size_t index) {
        const Json& json = json_["channels"][index];
        const Json& target = json["target"];
        const std::string path = target["path"].get<std::string>();
        const auto found = std::find(kPaths.begin(), kPaths.end(), path);
        const Json* node = member(target, "node");
        const char* ignored = node == nullptr         ? "animation channel without a node, ignored"
                              : found == kPaths.end() ? "animation of another property, ignored"
                                                      : nullptr;
        if (ignored != nullptr) {
            context_.file.warnings.add(ignored);
            return {};
        }
        GltfAnimationChannel channel;
        channel.node = node->get<int>();
        channel.path = static_cast<AnimationPath>(found - kPaths.begin());
        channel.sampler = json["sampler"].get<int>();
        const GltfNode& moved = context_.file.nodes[static_cast<std::size_t>(channel.node)];
        if (channel.path != AnimationPath::Weights && moved.hasMatrix) {
            ignored = "animation of a node with a matrix, ignored";
        } else if (channel.path == AnimationPath::Weights && targetsOf(moved) == 0) {
            ignored = "animation of morph weights of a node without targets, ignored";
        } else if (!taken_.emplace(channel.node, channel.path).second) {
            ignored = "animation channel for what another moves already, ignored";
        }
        if (ignored != nullptr) {
            context_.file.warnings.add(ignored);
            return {};
        }
        core::Result<void> sampled = readSampler(static_cast<std::size_t>(channel.sampler),
                                                 channel.path, componentsOf(channel, moved));
        if (sampled) {
            animation_.channels.push_back(channel);
        }
        return sampled;
    }

    [[nodiscard]] std::size_t targetsOf(const GltfNode& node) const {
        return node.mesh == kNone
                   ? 0
                   : context_.file.meshes[static_cast<std::size_t>(node.mesh)].weights.size();
    }

    [[nodiscard]] std::size_t componentsOf(const GltfAnimationChannel& channel,
                                           const GltfNode& node) const {
        switch (channel.path) {
        case AnimationPath::Rotation:
            return 4;
        case AnimationPath::Weights:
            return targetsOf(node);
        default:
            return 3;
        }
    }

    core::Result<void> readSampler(std::size_t index, AnimationPath path, std::size_t components) {
        GltfAnimationSampler& sampler = animation_.samplers[index];
        const Json& json = json_["samplers"][index];
        const std::string at = pointer(at_ + "/samplers", index);
        if (sampler.components != 0) {
            return sampler.components == components
                       ? core::Result<void>()
                       : core::refused("sampler moves things of different sizes", at);
        }
        if (const Json* given = member(json, "interpolation")) {
            const auto found = std::find(kInterpolations.begin(), kInterpolations.end(),
                                         given->get<std::string>());
            if (found == kInterpolations.end()) {
                return core::refused("interpolation '" + given->get<std::string>().substr(0, 32) +
                                         "' is none of STEP, LINEAR, CUBICSPLINE",
                                     at + "/interpolation");
            }
            sampler.interpolation = static_cast<Interpolation>(found - kInterpolations.begin());
        }
        core::Result<void> timed = readTimes(json, at, sampler);
        if (!timed) {
            return timed;
        }
        sampler.components = components;
        return readValues(json, path, at, sampler);
    }

    core::Result<void> readTimes(const Json& json, const std::string& at,
                                 GltfAnimationSampler& sampler) {
        auto times =
            readTyped(context_, json["input"].get<int>(), "SCALAR", {5126}, false, at + "/input");
        if (!times) {
            return times.error();
        }
        for (std::size_t i = 0; i < times->size(); ++i) {
            const float time = (*times)[i];
            if (!std::isfinite(time) || time < 0.0f || (i > 0 && !(time > (*times)[i - 1]))) {
                return core::refused("time " + std::to_string(i) +
                                         " is not finite, negative or not after the one before",
                                     at + "/input");
            }
        }
        if (sampler.interpolation == Interpolation::CubicSpline && times->size() < 2) {
            return core::refused("CUBICSPLINE needs at least two times", at + "/input");
        }
        sampler.times = std::move(*times);
        return {};
    }

    core::Result<void> readValues(const Json& json, AnimationPath path, const std::string& at,
                                  GltfAnimationSampler& sampler) {
        const std::string here = at + "/output";
        const int accessor = json["output"].get<int>();
        const bool mayBeIntegers =
            path == AnimationPath::Rotation || path == AnimationPath::Weights;
        const char* type = path == AnimationPath::Rotation  ? "VEC4"
                           : path == AnimationPath::Weights ? "SCALAR"
                                                            : "VEC3";
        const bool integers =
            context_.model.accessors[static_cast<std::size_t>(accessor)].componentType != 5126;
        auto values = mayBeIntegers ? readTyped(context_, accessor, type,
                                                {5120, 5121, 5122, 5123, 5126}, integers, here)
                                    : readTyped(context_, accessor, type, {5126}, false, here);
        if (!values) {
            return values.error();
        }
        const std::size_t perKey = sampler.interpolation == Interpolation::CubicSpline ? 3 : 1;
        const std::size_t wanted = sampler.times.size() * perKey * sampler.components;
        if (values->size() != wanted) {
            return core::refused(std::to_string(values->size()) + " numbers where " +
                                     std::to_string(sampler.times.size()) + " times ask for " +
                                     std::to_string(wanted),
                                 here);
        }
        if (!std::all_of(values->begin(), values->end(),
                         [](float value) { return std::isfinite(value); })) {
            return core::refused("a value is not finite", here);
        }
        sampler.values = std::move(*values);
        return {};
    }

    GltfContext& context_;
    const Json& json_;
    std::string at_;
    GltfAnimation animation_;
    std::set<std::pair<int, AnimationPath>> taken_;
};

} // namespace

void convertAnimations(GltfContext& context) {
    for (std::size_t i = 0; i < memberSize(context.document, "animations"); ++i) {
        core::Result<GltfAnimation> animation =
            AnimationReader(context, context.document["animations"][i], pointer("/animations", i))
                .read();
        if (!animation) {
            context.problems.refuse(animation.error());
        }
        context.file.animations.push_back(animation ? std::move(*animation) : GltfAnimation());
    }
}

} // namespace lodestar::io::detail
