// SPDX-License-Identifier: MIT
//
// The lighting document: what lights a scene, beside a glTF that nobody need touch. Values as the
// text has them, in its order; degrees only in the text. docs/lighting-document.md is its page.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "core/tally.h"
#include "lighting/day.h"
#include "lighting/probe.h"
#include "lighting/rsrm_layout.h"

namespace lodestar::document {

/// The version of the format that is read and written.
inline constexpr int kVersion = 1;
/// Larger texts, and deeper ones, are refused.
inline constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20;
inline constexpr int kMaxDepth = 64;

/// Members of an object that this version does not know, as the text of a JSON object; empty if
/// there are none. They survive a load and a save.
using Unknown = std::string;

struct Environment {
    std::string source;    ///< as ENV on the command line; a path is relative to the document
    double rotation = 0.0; ///< radians about +Y, counter-clockwise seen from above
    double ev = 0.0;       ///< radiance x 2^ev, [-64, 64]
    Unknown unknown;
    bool operator==(const Environment&) const = default;
};

struct Stop {
    lighting::GradientStop stop;
    Unknown unknown;
    bool operator==(const Stop&) const = default;
};

struct Gradient {
    std::vector<Stop> stops;
    lighting::GradientInterpolation interpolation = lighting::GradientInterpolation::Linear;
    lighting::GradientSpace space = lighting::GradientSpace::Linear;
    Unknown unknown;
    bool operator==(const Gradient&) const = default;
};

struct Key {
    double hour = 0.0;
    Gradient gradient;
    glm::dvec3 tint{1.0};
    std::optional<glm::dvec3> axis;
    Unknown unknown;
    bool operator==(const Key&) const = default;
};

struct Light {
    std::string name;
    lighting::LightKind kind = lighting::LightKind::Sky;
    std::optional<glm::dvec3> axis; ///< as written; a light without one has +Y
    std::optional<lighting::SunPath> path;
    std::vector<Key> keys;
    bool visibility = true;
    bool add = false;
    Unknown unknown;
    Unknown pathUnknown; ///< of the path
    bool operator==(const Light&) const = default;
};

/// What a material is given in place of what its file says.
struct Material {
    std::optional<double> exponent;        ///< Blinn-Phong [0, 1e7], +infinity for "mirror"
    std::optional<glm::dvec3> diffuse, f0; ///< reflectances [0, 1]
    std::optional<std::string> specular;   ///< estimator
    std::optional<double> tolerance;       ///< relative error, > 0
    Unknown unknown;
    bool operator==(const Material&) const = default;
};

/// A light probe, and what of its objects no version knows.
struct Probe {
    lighting::Probe probe;
    Unknown unknown, captureUnknown, updateUnknown, influenceUnknown, proxyUnknown;
    bool operator==(const Probe&) const = default;
};

/// How the maps of skies and suns are made.
struct Rsrm {
    /// Of their rows: none for the default ones, or 2 to 24 as lighting::faultOfRows has them.
    std::vector<double> exponents;
    Unknown unknown;
    bool operator==(const Rsrm&) const = default;
};

struct Document {
    std::optional<Environment> environment;
    std::vector<Light> lights;
    std::optional<Rsrm> rsrm;
    std::vector<Probe> probes;
    std::map<std::string, Material> materials; ///< by glTF name or "#index"
    Unknown unknown;
    bool operator==(const Document&) const = default;
};

/// Reads a document. What lighting::repaired mends is counted; `dayLights` mends it.
/// @errors InputRefused with the JSON pointer or the line of what is wrong
[[nodiscard]] core::Result<Document> parseDocument(std::string_view text, core::Tally& warnings);

/// The same document as text: two blanks an indent, all digits, unknown members after the known.
/// What is not finite is written as 0.
[[nodiscard]] std::string writeDocument(const Document& document);

/// The lights, put in order by lighting::repaired.
/// @errors InputRefused with the JSON pointer from the document's root
[[nodiscard]] core::Result<std::vector<lighting::DayLight>> dayLights(const Document& document,
                                                                      core::Tally& warnings);

/// The layout of the lights' maps: `rsrm`, with the document's rows if it has some.
[[nodiscard]] lighting::RsrmLayout mapLayout(const Document& document);

} // namespace lodestar::document
