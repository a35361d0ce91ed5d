// SPDX-License-Identifier: MIT
//
// What a command changed, both ways and byte for byte: of lists only the range that differs, so
// that a step of undo is as large as its change and not as the document.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/state.h"

namespace lodestar::model {

enum class Direction { Forth, Back };

/// A range of a list and of its parts' names that is replaced by another one.
template <class Value, class Names>
struct Splice {
    std::size_t at = 0;
    std::vector<Value> valuesBefore, valuesAfter;
    std::vector<Names> namesBefore, namesAfter;

    [[nodiscard]] bool empty() const { return valuesBefore.empty() && valuesAfter.empty(); }
};

template <class Value>
struct Swap {
    Value before, after;
};

/// What few changes have: null where it is the same on both sides, and then as small as that.
template <class Value>
using Rarely = std::unique_ptr<const Swap<Value>>;

/// A change inside one key: its values but the stops, and its stops.
struct KeyChange {
    std::size_t light = 0, key = 0;
    Rarely<document::Key> values; ///< without stops
    Splice<document::Stop, Id> stops;
};

/// A change inside one light: its values but the keys, or its list of keys.
struct LightChange {
    std::size_t light = 0;
    Rarely<document::Light> values; ///< without keys
    Splice<document::Key, KeyIds> keys;
};

struct MaterialChange {
    std::string name;
    std::optional<document::Material> before, after;
};

struct Change {
    Rarely<std::optional<document::Environment>> environment;
    std::vector<MaterialChange> materials;
    Splice<document::Probe, Id> probes;
    Splice<document::Light, LightIds> lights;
    std::vector<LightChange> inLights;
    std::vector<KeyChange> inKeys;
    Rarely<std::optional<document::Rsrm>> rsrm;
    Rarely<document::Unknown> unknown;
    Swap<std::uint64_t> next{0, 0}; ///< Identities::next

    /// Whether the document is the same on both sides.
    [[nodiscard]] bool empty() const;
    /// Memory that it keeps besides itself, about.
    [[nodiscard]] std::size_t bytes() const;
};

[[nodiscard]] Change difference(const State& before, const State& after);

/// @pre the state is the one that the change leads from, in its direction
void apply(const Change& change, Direction direction, State& state);

} // namespace lodestar::model
