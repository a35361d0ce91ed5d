// SPDX-License-Identifier: MIT
//
// What is edited: a lighting document, and a name for each of its parts that stays while the parts
// change places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "document/document.h"

namespace lodestar::model {

/// The name of a light, key, stop or probe for as long as it is in the document, undo and redo
/// included. Never written to a file.
enum class Id : std::uint64_t { None = 0 };

/// Names of a key and its stops, in the document's order.
struct KeyIds {
    Id id = Id::None;
    std::vector<Id> stops;
    bool operator==(const KeyIds&) const = default;
};

/// Names of a light and its keys, in the document's order.
struct LightIds {
    Id id = Id::None;
    std::vector<KeyIds> keys;
    bool operator==(const LightIds&) const = default;
};

/// Names of a document's parts, each list as long as the document's own.
struct Identities {
    std::vector<LightIds> lights;
    std::vector<Id> probes;
    std::uint64_t next = 1; ///< the name that is given next
    bool operator==(const Identities&) const = default;

    /// A name that none had.
    [[nodiscard]] Id make() { return static_cast<Id>(next++); }
};

/// A document under edit.
struct State {
    document::Document document;
    Identities ids;
};

/// Where a key is.
struct KeyPlace {
    std::size_t light = 0, key = 0;
};

/// Where a stop is.
struct StopPlace {
    std::size_t light = 0, key = 0, stop = 0;
};

/// A document whose parts are named from a first name on.
[[nodiscard]] State named(document::Document document, std::uint64_t first = 1);
/// Names for a light's keys and stops, and for itself.
[[nodiscard]] LightIds namesOf(const document::Light& light, Identities& ids);
/// Names for a key's stops, and for itself.
[[nodiscard]] KeyIds namesOf(const document::Key& key, Identities& ids);

/// The place of a part in the document; nothing for a name of no such part.
[[nodiscard]] std::optional<std::size_t> findLight(const Identities& ids, Id light);
[[nodiscard]] std::optional<KeyPlace> findKey(const Identities& ids, Id key);
[[nodiscard]] std::optional<StopPlace> findStop(const Identities& ids, Id stop);
[[nodiscard]] std::optional<std::size_t> findProbe(const Identities& ids, Id probe);

} // namespace lodestar::model
