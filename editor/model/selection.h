// SPDX-License-Identifier: MIT
//
// What is selected, by names that stay while parts change places. Not part of undo.
#pragma once

#include <string>
#include <vector>

#include "model/state.h"

namespace lodestar::model {

struct Selection {
    Id light = Id::None;
    Id key = Id::None;                  ///< of `light`
    std::vector<Id> stops;              ///< of `key`, in the order selected
    std::vector<Id> probes;             ///< in the order selected
    std::vector<std::string> materials; ///< glTF names or "#index"; need no entry in the document
    bool operator==(const Selection&) const = default;
};

/// What a document has of a selection, each part once: a key brings its light, stops the key of
/// the first of them.
[[nodiscard]] Selection valid(Selection selection, const Identities& ids);

} // namespace lodestar::model
