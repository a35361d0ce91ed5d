// SPDX-License-Identifier: MIT
//
// Commands as text: a JSON object a line, `{"do": "MoveStops", "moves": [{"stop":
// "/lights/0/keys/1/gradient/stops/2", "at": 12.5}]}`. Members are those of the command's struct,
// angles in degrees, parts of a document as the document writes them; lights, keys, stops and
// probes are named by their JSON pointer in the document as the command finds it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "model/model.h"

namespace lodestar::model {

/// A command as a line, without its end. @param model as the command finds it
/// @errors InputRefused: it names a part that the document does not have, or holds numbers or parts
/// that no text may (a NaN; a stop out of its range, which the command itself would bring into it)
[[nodiscard]] core::Result<std::string> writeCommand(const Command& command, const Model& model);
/// The same. @param ids of the document as the command finds it
[[nodiscard]] core::Result<std::string> writeCommand(const Command& command, const Identities& ids);

/// The command of a line. Whether its values are in range says `Model::execute`.
/// @param model as the command finds it
/// @errors InputRefused with the rule and the pointer of what breaks it
[[nodiscard]] core::Result<Command> readCommand(std::string_view line, const Model& model);

/// Carries the lines of a script out, each a step of undo; `{"do": "Undo"}` and `{"do": "Redo"}`
/// are commands too, blank lines and those that begin with # are none.
/// @return how many commands it had
/// @errors InputRefused with the line: the model holds what the lines before it did
[[nodiscard]] core::Result<std::size_t> runScript(std::string_view text, Model& model);

/// The steps that undo can take as a script, each after its name as a comment: carried out on the
/// document as it was before them it gives the document's bytes as they are. A command that has no
/// text is written as the document that it left.
[[nodiscard]] std::string writeHistory(const Model& model);

/// The names that `do` may have, in the order of Command's types.
[[nodiscard]] std::vector<std::string_view> commandNames();

} // namespace lodestar::model
