// SPDX-License-Identifier: MIT
//
// How commands are carried out: one function each, and the rules that they share. Internal.
#pragma once

#include <cstddef>
#include <vector>

#include "core/result.h"
#include "model/command.h"

namespace lodestar::model {

/// Parts that were added, or why nothing was done.
using Performed = core::Result<std::vector<Id>>;

Performed performOn(State& state, const AddStop& command);
Performed performOn(State& state, const InsertStops& command);
Performed performOn(State& state, const MoveStops& command);
Performed performOn(State& state, const SetStops& command);
Performed performOn(State& state, const DeleteStops& command);
Performed performOn(State& state, const ReverseStops& command);
Performed performOn(State& state, const MirrorStops& command);
Performed performOn(State& state, const DistributeStops& command);
Performed performOn(State& state, const SimplifyStops& command);
Performed performOn(State& state, const SetGradient& command);
Performed performOn(State& state, const SetInterpolation& command);
Performed performOn(State& state, const SetSpace& command);
Performed performOn(State& state, const BrushStroke& command);
Performed performOn(State& state, const AddKey& command);
Performed performOn(State& state, const InsertKey& command);
Performed performOn(State& state, const MoveKey& command);
Performed performOn(State& state, const CopyKey& command);
Performed performOn(State& state, const DeleteKey& command);
Performed performOn(State& state, const SetKey& command);
Performed performOn(State& state, const AddLight& command);
Performed performOn(State& state, const RemoveLight& command);
Performed performOn(State& state, const SetLight& command);
Performed performOn(State& state, const SetLights& command);
Performed performOn(State& state, const SetEnvironment& command);
Performed performOn(State& state, const RemoveEnvironment& command);
Performed performOn(State& state, const SetMaterials& command);
Performed performOn(State& state, const ResetMaterials& command);
Performed performOn(State& state, const AddProbe& command);
Performed performOn(State& state, const SetProbe& command);
Performed performOn(State& state, const RemoveProbes& command);
Performed performOn(State& state, const SetMapRow& command);
Performed performOn(State& state, const SetMapRows& command);
Performed performOn(State& state, const ReplaceDocument& command);

/// A gradient, its stops' names, and what gives new ones.
struct GradientEdit {
    lighting::LightKind kind;
    document::Gradient& gradient;
    std::vector<Id>& names;
    Identities& ids;

    /// Puts stops in order from the axis outwards; those at one place keep theirs.
    void sort();
    /// Adds a stop before place i. @return its name
    Id insert(std::size_t i, document::Stop stop);
    /// The place behind, or before, all stops at an angle. @pre in order
    [[nodiscard]] std::size_t after(double at) const;
    [[nodiscard]] std::size_t before(double at) const;
    /// A sun is black beyond its last stop: a stop out there must not draw its light along.
    void closeBefore(double at);
};

/// A key's gradient, put in order. @errors InputRefused: no such key, a gradient without stops
[[nodiscard]] core::Result<GradientEdit> editGradient(State& state, Id key);
[[nodiscard]] GradientEdit gradientAt(State& state, const KeyPlace& place);

} // namespace lodestar::model
