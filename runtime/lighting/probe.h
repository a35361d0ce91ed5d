// SPDX-License-Identifier: MIT
//
// Light probes: where light is captured, where it holds, and how strongly it lights a point. Values
// and pure functions; a renderer keeps what is captured.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lodestar::lighting {

enum class VolumeShape { Box, Sphere };

/// A volume in its probe's frame, in metres of that frame: it turns, moves and scales with the
/// node.
struct ProbeVolume {
    VolumeShape shape = VolumeShape::Box;
    glm::dvec3 center{0.0};
    glm::dvec3 size{10.0}; ///< full extents; a sphere's diameter in x, y and z
    /// Over how many metres the weight falls to 0, at +X, -X, +Y, -Y, +Z, -Z; a sphere's in the
    /// first. Inside the volume's faces, but outside those of an interior.
    std::array<double, 6> blend{};
    bool operator==(const ProbeVolume&) const = default;
};

enum class ProbeUpdate {
    Once,     ///< when first needed, then never
    OnChange, ///< where something that a face sees has moved, or its light has changed
    Every,    ///< every N frames, all faces
    Always,   ///< all faces as often as the budget lets
    OnDemand, ///< when asked for
};

/// What a change of the sky's intensity or tint alone makes of a probe's light.
enum class ProbeRelight {
    Compose, ///< the new sky is composed behind the captured geometry, mips are made anew
    Ratio,   ///< the sky's part is kept apart and multiplied while shading: no pass
};

struct ProbeCapture {
    int resolution = 128;               ///< texels of a face's side, [1, 16384]
    double nearPlane = 0.05;            ///< metres, > 0
    double farPlane = 1000.0;           ///< metres, > near
    std::uint32_t layers = 0xffffffffu; ///< nodes that share a bit with it are captured
    bool operator==(const ProbeCapture&) const = default;
};

struct Probe {
    std::string name;
    std::string node;         ///< the name of the node it is at; empty: at `position`
    glm::dvec3 position{0.0}; ///< metres, in the node's frame, or the world's without one
    std::string source;       ///< ENV whose light it holds; empty: it is captured
    ProbeCapture capture;
    ProbeUpdate update = ProbeUpdate::OnChange;
    int every = 1; ///< frames, >= 1, of ProbeUpdate::Every
    ProbeRelight relight = ProbeRelight::Compose;
    ProbeVolume influence;
    std::optional<ProbeVolume> proxy; ///< for parallax correction; absent: light is from far away
    int priority = 0;                 ///< of two at one point, the higher shows
    bool exterior = true;   ///< false: inside it nothing is lit by the distant environment
    glm::dvec3 tint{1.0};   ///< factor on its light, each >= 0
    double intensity = 1.0; ///< factor on its light, >= 0
    bool operator==(const Probe&) const = default;
};

/// A volume in the world: the members of LodestarVolume of shaders/lodestar/probes.glsl.
struct PlacedVolume {
    std::array<glm::vec4, 3> rows{}; ///< of volumeFromWorld
    glm::vec3 halfExtents{0.0f};     ///< metres of its frame; a sphere's radius in all three
    glm::vec3 blendHigh{0.0f}, blendLow{0.0f}; ///< metres of its frame; a sphere's in x
    bool sphere = false;
    bool outward = false;            ///< blends lie outside its faces
    glm::vec3 low{0.0f}, high{0.0f}; ///< the world box beyond which its weight is 0
    double measure = 0.0;            ///< cubic metres inside its faces
    bool operator==(const PlacedVolume&) const = default;
};

/// A volume as its node carries it. @param outward blend lies outside its faces (interiors)
/// @return nothing where it has no inside: a size of zero or beyond 1e18 m, a singular frame, a
/// number that is not finite
[[nodiscard]] std::optional<PlacedVolume> place(const ProbeVolume& volume,
                                                const glm::mat4& worldFromNode, bool outward);

/// The mean weight of a volume over a world box, [0, 1]: that of its local box for a box, that over
/// the box's range of distances for a sphere. Continuous in the box; the point's own weight where
/// the box is a point, 0 where it is not finite.
[[nodiscard]] float meanWeight(const PlacedVolume& placed, const glm::vec3& low,
                               const glm::vec3& high);

/// Which faces, in OpenGL's order, of a cube captured at a point may see a world box: a set of
/// bits.
/// @param nearPlane, farPlane metres
[[nodiscard]] unsigned facesSeeing(const glm::vec3& position, double nearPlane, double farPlane,
                                   const glm::vec3& low, const glm::vec3& high);

} // namespace lodestar::lighting
