// SPDX-License-Identifier: MIT
//
// Commands on the environment, materials, light probes and maps of a document. Refused, and nothing
// changed, where a number is NaN, infinite or out of its range, or an Id names nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "document/document.h"
#include "model/state.h"

namespace lodestar::model {

/// Gives the environment the values that are set. Where there is none, it needs a source.
struct SetEnvironment {
    std::optional<std::string> source; ///< ENV: analytic, or a path in the document's folder
    std::optional<double> rotation;    ///< radians about +Y, counter-clockwise seen from above
    std::optional<double> ev;          ///< [-64, 64]
};

struct RemoveEnvironment {};

/// Gives materials the values that are set; those that have no entry get one.
struct SetMaterials {
    std::vector<std::string> names;        ///< glTF names or "#index"
    std::optional<double> exponent;        ///< Blinn-Phong [0, 1e7], or +infinity: a mirror
    std::optional<glm::dvec3> diffuse, f0; ///< reflectances [0, 1]
    std::optional<std::string> specular;   ///< estimator (docs/estimators.md)
    std::optional<double> tolerance;       ///< relative error, (0, 1e9]
};

/// Values of a material, as bits.
enum class MaterialField : unsigned {
    Exponent = 1,
    Diffuse = 2,
    F0 = 4,
    Specular = 8,
    Tolerance = 16,
    All = 31,
};
[[nodiscard]] constexpr MaterialField operator|(MaterialField a, MaterialField b) {
    return static_cast<MaterialField>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

/// Takes values away from materials, so that the scene's own hold again.
struct ResetMaterials {
    std::vector<std::string> names;
    MaterialField fields = MaterialField::All;
};

/// Adds a light probe behind the others.
struct AddProbe {
    lighting::Probe probe;
};

/// Gives a light probe all its values.
struct SetProbe {
    Id id = Id::None;
    lighting::Probe probe;
};

struct RemoveProbes {
    std::vector<Id> probes;
};

/// Moves a row of the maps of skies and suns. The default rows become the document's own by it.
/// Refused where it breaks lighting::faultOfRows.
struct SetMapRow {
    std::size_t row = 0; ///< of those that there are
    double exponent = 0.0;
};

/// Gives the maps these rows; none: the default ones.
struct SetMapRows {
    std::vector<double> exponents; ///< Phong, as lighting::faultOfRows has them
};

/// Replaces the document: read again, recovered. Parts keep their names by place.
struct ReplaceDocument {
    document::Document document;
};

} // namespace lodestar::model
