// SPDX-License-Identifier: MIT
//
// Copy and paste as text: a small lighting document that says at its root what of it is meant,
// `"clipboard": "stops" | "gradient" | "key" | "material"`. So it is read by the document's own
// rules, it may be kept in a file, and a host's clipboard carries it between maps and programs.
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "model/command.h"
#include "model/model.h"

namespace lodestar::model {

/// The text of parts of a document. @errors InputRefused: a name of no such part; stops of several
/// gradients
[[nodiscard]] core::Result<std::string> copyStops(const Model& model, const std::vector<Id>& stops);
[[nodiscard]] core::Result<std::string> copyGradient(const Model& model, Id key);
[[nodiscard]] core::Result<std::string> copyKey(const Model& model, Id key);
[[nodiscard]] core::Result<std::string> copyMaterial(const Model& model, const std::string& name);

/// Where a paste goes: stops and gradients to the key, keys to the light at the hour, a material to
/// all that are named.
struct PasteTarget {
    Id key = Id::None;
    Id light = Id::None;
    double hour = 12.0;
    std::vector<std::string> materials;
};

/// The command that a pasted text asks for. Between a sky and a sun, stops keep their angle from
/// the axis.
/// @errors InputRefused with one sentence: text that is no such thing, no place for it
[[nodiscard]] core::Result<Command> pasteCommand(const Model& model, std::string_view text,
                                                 const PasteTarget& target);

} // namespace lodestar::model
