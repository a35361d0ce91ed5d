// SPDX-License-Identifier: MIT
//
// Commands on the stops of one gradient. Angles are degrees as in the document: a sky's elevation
// [-90, 90], a sun's angle from its axis [0, 180]. Colours are linear Rec. 709, radiance is
// color x 2^ev in [0, 1e9]. A gradient that a command touches is put in order from the axis
// outwards (a sky's from +90 down) by the rules of lighting::repaired.
//
// Every command is refused, and nothing changes, where a number is NaN or infinite, a colour is
// negative, an ev lies outside [-64, 64], a radiance above 1e9, with its key's tint or without, or
// an Id names nothing. Finite angles are brought into their range; numbers too small for a normal
// double become 0.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "document/document.h"
#include "model/state.h"

namespace lodestar::model {

/// A gradient holds no more stops than this: 64 MiB of text hold some 200,000.
inline constexpr std::size_t kMostStops = 65536;

/// Adds a stop with the gradient's own radiance there, so that a linear one shines as before.
struct AddStop {
    Id key = Id::None;
    double at = 0.0;
};

/// Adds stops as given; one at the place of another stands behind it: a step.
struct InsertStops {
    Id key = Id::None;
    std::vector<document::Stop> stops;
};

/// A stop and where it goes.
struct StopMove {
    Id stop = Id::None;
    double at = 0.0;
};

/// Moves stops, of any keys. One that lands on another stays on the side it came from: a step.
struct MoveStops {
    std::vector<StopMove> moves;
};

/// Gives stops, of any keys, the values that are set.
struct SetStops {
    std::vector<Id> stops;
    std::optional<double> at;
    std::optional<glm::dvec3> color;
    std::optional<double> ev;
};

/// Deletes stops. Refused where fewer than two would be left of a gradient.
struct DeleteStops {
    std::vector<Id> stops;
};

/// Turns the gradient around between its first and last stop; each stop keeps its radiance.
struct ReverseStops {
    Id key = Id::None;
};

/// Makes the gradient symmetric: a sky's lower half becomes the upper one's mirror image at the
/// horizon; a sun's outer half the inner one's, about the middle of its stops.
struct MirrorStops {
    Id key = Id::None;
};

/// Spaces the stops evenly between the first and the last; steps are drawn apart. From the left,
/// each begins an equal part of what they span, so that without interpolation each holds as long:
/// the last one moves too.
struct DistributeStops {
    Id key = Id::None;
    bool fromLeft = false;
};

/// Leaves at most `count` stops, first and last among them: again and again the stop goes whose
/// triangle with its neighbours, of angle and radiance, is smallest (Visvalingam and Whyatt 1993).
/// Refused below two.
struct SimplifyStops {
    Id key = Id::None;
    std::size_t count = 8;
};

/// Replaces a key's gradient.
struct SetGradient {
    Id key = Id::None;
    document::Gradient gradient;
};

struct SetInterpolation {
    Id key = Id::None;
    lighting::GradientInterpolation interpolation = lighting::GradientInterpolation::Linear;
};

struct SetSpace {
    Id key = Id::None;
    lighting::GradientSpace space = lighting::GradientSpace::Linear;
};

/// What a brush does to the radiance under it.
enum class BrushMode {
    Paint,  ///< mixes it towards `color`
    Smooth, ///< mixes it towards its mean over half the brush
};

struct Brush {
    BrushMode mode = BrushMode::Paint;
    double size = 10.0;    ///< degrees across, (0, 180]
    double softness = 0.5; ///< [0, 1]: 0 has a hard edge (a step), 1 falls off from the middle on
    double strength = 1.0; ///< [0, 1]: the share that the brush takes in its middle
    glm::dvec3 color{1.0}; ///< radiance, linear Rec. 709, [0, 1e9]; of Paint
};

/// A freehand stroke: the brush drawn through all its places and between them. What it passes twice
/// it paints once; a drag sends the whole stroke so far each time, under one MergeToken. Stops are
/// added where the stroke bends the gradient.
struct BrushStroke {
    Id key = Id::None;
    Brush brush;
    std::vector<double> path; ///< degrees, in the order drawn; at least one
};

} // namespace lodestar::model
