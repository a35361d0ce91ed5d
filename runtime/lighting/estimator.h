// SPDX-License-Identifier: MIT
//
// The estimators by name: how a lobe's mean radiance is got from an environment. The names are the
// same in code, JSON, the editor and on the command line (docs/estimators.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace lodestar::lighting {

enum class EstimatorKind {
    Mip,         ///< `mip`: McGuire 2013 as published; plain mips, exponent as given
    MipFloor,    ///< `mip-floor`: the same, level raised to the pixel's footprint
    Bias,        ///< `bias:LAMBDA`: Ashikhmin and Ghosh 2002, a least level per object
    BiasVertex,  ///< `bias:LAMBDA:vertex`: the same, per vertex, sharper at grazing angles
    Tent,        ///< `tent`: one fetch from tent mips
    Ring3,       ///< `ring:3`: three taps about the lobe's axis, from tent mips
    Ring7,       ///< `ring:7`: six taps about the lobe's axis and the axis itself
    Taps,        ///< `taps:N`: N taps on a spiral, from tent mips
    Prefiltered, ///< `prefiltered`: one fetch from levels that are means over lobes
    Auto,        ///< `auto:ERROR`: the cheapest of ErrorForecast's that is right enough
    LowestMip,   ///< `lowest-mip`: Lambert from the coarsest plain mip, as published
    Sh9,         ///< `sh9`: nine spherical-harmonic coefficients
    Irradiance,  ///< `irradiance`: a 16x16 irradiance cube
    Reference,   ///< `reference`: double precision over all texels, CPU only
};

enum class Term { Glossy, Diffuse };

/// How many taps there may be: beyond the most a frame would take seconds.
inline constexpr int kLeastTaps = 1;
inline constexpr int kMostTaps = 1024;

/// The coarsest tolerance of `auto`.
inline constexpr float kMostTolerance = 10.0f;

/// An estimator and its parameter.
struct Estimator {
    EstimatorKind kind = EstimatorKind::Tent;
    float leastLevel = 0.0f; ///< bias only, mip level >= 0
    int taps = 16;           ///< taps only, [kLeastTaps, kMostTaps]
    float tolerance = 0.05f; ///< auto only, relative RMSE, (0, kMostTolerance]

    bool operator==(const Estimator&) const = default;
};

inline constexpr Estimator kDefaultSpecular{EstimatorKind::Tent, 0.0f};
inline constexpr Estimator kDefaultDiffuse{EstimatorKind::Irradiance, 0.0f};

/// The estimator a name says, for a term; the error lists the names that the term has.
[[nodiscard]] core::Result<Estimator> parseEstimator(std::string_view name, Term term);

/// Its name, as parseEstimator takes it.
[[nodiscard]] std::string estimatorName(const Estimator& estimator);

/// The names a term has, for help and messages; `bias:LAMBDA`, `taps:N` and `auto:ERROR`
/// stand as that.
[[nodiscard]] std::vector<std::string> estimatorNames(Term term);

/// What stands for the power of a highlight's cosine, and for Fresnel's (1 - x)^5: that itself, or
/// a spherical Gaussian (docs/derivations/sg.md).
enum class LobeForm { Power, Sg };
enum class FresnelForm { Schlick, Sg };

/// Their names, on the command line too: `power`, `schlick`, `sg`.
[[nodiscard]] std::string nameOf(LobeForm form);
[[nodiscard]] std::string nameOf(FresnelForm form);

/// Whether it reads tent mips about the lookup of a Blinn-Phong lobe: `tent`, rings, taps
/// and what `auto` chooses.
[[nodiscard]] bool readsTentMips(EstimatorKind kind);

/// Whether it is about the lookup of a Blinn-Phong lobe and blends into Lambert's below exponent 1:
/// those that read tent mips, and `prefiltered`. The published ones are about the reflection.
[[nodiscard]] bool followsLobe(EstimatorKind kind);

/// Whether the term can be estimated so: `bias` and `reference` for both, the others for one.
[[nodiscard]] bool serves(EstimatorKind kind, Term term);

} // namespace lodestar::lighting
