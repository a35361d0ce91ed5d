// SPDX-License-Identifier: MIT
//
// Everything that changes a document, as values: what an interface asks for, a script or a test
// can ask for too.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "core/result.h"
#include "model/light_commands.h"
#include "model/scene_commands.h"
#include "model/state.h"
#include "model/stop_commands.h"

namespace lodestar::model {

using Command =
    std::variant<AddStop, InsertStops, MoveStops, SetStops, DeleteStops, ReverseStops, MirrorStops,
                 DistributeStops, SimplifyStops, SetGradient, SetInterpolation, SetSpace,
                 BrushStroke, AddKey, InsertKey, MoveKey, CopyKey, DeleteKey, SetKey, AddLight,
                 RemoveLight, SetLight, SetLights, SetEnvironment, RemoveEnvironment, SetMaterials,
                 ResetMaterials, AddProbe, SetProbe, RemoveProbes, SetMapRow, SetMapRows,
                 ReplaceDocument>;

/// What undo says of a command: "Move stop".
[[nodiscard]] std::string_view nameOf(const Command& command);

/// Carries a command out on a state. On failure the state is of no use any more.
/// @return the parts that were added, of the kind that the command is about
/// @errors InputRefused with one sentence
[[nodiscard]] core::Result<std::vector<Id>> perform(const Command& command, State& state);

} // namespace lodestar::model
