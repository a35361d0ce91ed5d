// SPDX-License-Identifier: MIT
//
// Commands on lights and the keys of their day. Hours are local solar time, brought into [0, 24);
// an axis points towards the light; angles are radians. Refused, and nothing changed, where a
// number is NaN, infinite or out of its range, or an Id names nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "document/document.h"
#include "model/state.h"

namespace lodestar::model {

/// Adds a key with what the light is at that hour, so that it shines there as before. Refused where
/// there is one at the hour.
struct AddKey {
    Id light = Id::None;
    double hour = 0.0;
};

/// Adds a key as given. Refused where there is one at its hour.
struct InsertKey {
    Id light = Id::None;
    document::Key key;
};

/// Gives a key another hour; keys stay in the order of their hours. Refused where there is one.
struct MoveKey {
    Id key = Id::None;
    double hour = 0.0;
};

/// Adds a copy of a key at another hour. Refused where there is one.
struct CopyKey {
    Id key = Id::None;
    double hour = 0.0;
};

/// Refused for the last key of a light.
struct DeleteKey {
    Id key = Id::None;
};

/// Gives a key the values that are set.
struct SetKey {
    Id key = Id::None;
    std::optional<glm::dvec3> tint;                ///< factor on radiance, [0, 1e9]
    std::optional<std::optional<glm::dvec3>> axis; ///< not zero; nothing: the light's own
};

/// Adds a light behind the others.
struct AddLight {
    document::Light light;
};

struct RemoveLight {
    Id light = Id::None;
};

/// Gives a light the values that are set.
struct SetLight {
    Id light = Id::None;
    std::optional<std::string> name;
    std::optional<std::optional<glm::dvec3>> axis;        ///< not zero; nothing: +Y
    std::optional<std::optional<lighting::SunPath>> path; ///< a sun's; nothing: the axis holds
    std::optional<bool> visibility;
    std::optional<bool> add;
};

/// Replaces all lights: a preset.
struct SetLights {
    std::vector<document::Light> lights;
};

} // namespace lodestar::model
