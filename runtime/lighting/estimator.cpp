// SPDX-License-Identifier: MIT
#include "lighting/estimator.h"

#include <array>
#include <charconv>
#include <cmath>

namespace lodestar::lighting {

namespace {

struct Row {
    EstimatorKind kind;
    std::string_view name; ///< with LAMBDA or N where a number stands
    bool glossy;
    bool diffuse;
};

constexpr std::array kRows{
    Row{EstimatorKind::Mip, "mip", true, false},
    Row{EstimatorKind::MipFloor, "mip-floor", true, false},
    Row{EstimatorKind::Bias, "bias:LAMBDA", true, true},
    Row{EstimatorKind::BiasVertex, "bias:LAMBDA:vertex", true, false},
    Row{EstimatorKind::Tent, "tent", true, false},
    Row{EstimatorKind::Ring3, "ring:3", true, false},
    Row{EstimatorKind::Ring7, "ring:7", true, false},
    Row{EstimatorKind::Taps, "taps:N", true, false},
    Row{EstimatorKind::Prefiltered, "prefiltered", true, false},
    Row{EstimatorKind::Auto, "auto:ERROR", true, false},
    Row{EstimatorKind::LowestMip, "lowest-mip", false, true},
    Row{EstimatorKind::Sh9, "sh9", false, true},
    Row{EstimatorKind::Irradiance, "irradiance", false, true},
    Row{EstimatorKind::Reference, "reference", true, true},
};

constexpr std::string_view kBiasPrefix = "bias:";
constexpr std::string_view kAutoPrefix = "auto:";
constexpr std::string_view kTapsPrefix = "taps:";
constexpr std::string_view kVertexSuffix = ":vertex";
constexpr float kMaxBias = 32.0f; ///< deeper than any chain; larger values are slips of the pen

const Row& rowOf(EstimatorKind kind) {
    for (const Row& row : kRows) {
        if (row.kind == kind) {
            return row;
        }
    }
    core::contractViolated("kind is in the table", "unknown estimator kind", __FILE__, __LINE__);
}

core::Error unknown(std::string_view name, Term term) {
    std::string list;
    for (const std::string& known : estimatorNames(term)) {
        list += (list.empty() ? "" : ", ") + known;
    }
    return {core::ErrorCode::Usage,
            "\"" + std::string(name) + "\" is not a " +
                (term == Term::Glossy ? "glossy" : "diffuse") + " estimator; these are: " + list,
            {},
            {}};
}

core::Result<Estimator> parseBias(std::string_view name, Term term) {
    std::string_view number = name.substr(kBiasPrefix.size());
    Estimator estimator{EstimatorKind::Bias, 0.0f};
    if (number.ends_with(kVertexSuffix)) {
        number.remove_suffix(kVertexSuffix.size());
        estimator.kind = EstimatorKind::BiasVertex;
    }
    if (!serves(estimator.kind, term)) {
        return unknown(name, term);
    }
    const char* end = number.data() + number.size();
    const auto [stop, code] = std::from_chars(number.data(), end, estimator.leastLevel);
    // Written so that NaN is refused.
    if (code != std::errc() || stop != end ||
        !(estimator.leastLevel >= 0.0f && estimator.leastLevel <= kMaxBias)) {
        return core::Error{core::ErrorCode::Usage,
                           "\"" + std::string(name) +
                               "\" needs a mip level from 0 to 32 after \"bias:\"",
                           {},
                           {}};
    }
    return estimator;
}

core::Result<Estimator> parseTaps(std::string_view name, Term term) {
    if (!serves(EstimatorKind::Taps, term)) {
        return unknown(name, term);
    }
    const std::string_view number = name.substr(kTapsPrefix.size());
    Estimator estimator{EstimatorKind::Taps};
    const char* end = number.data() + number.size();
    const auto [stop, code] = std::from_chars(number.data(), end, estimator.taps);
    if (code != std::errc() || stop != end || estimator.taps < kLeastTaps ||
        estimator.taps > kMostTaps) {
        return core::Error{core::ErrorCode::Usage,
                           "\"" + std::string(name) +
                               "\" needs a number of taps from 1 to 1024 after \"taps:\"",
                           {},
                           {}};
    }
    return estimator;
}

core::Result<Estimator> parseAuto(std::string_view name, Term term) {
    if (!serves(EstimatorKind::Auto, term)) {
        return unknown(name, term);
    }
    const std::string_view number = name.substr(kAutoPrefix.size());
    Estimator estimator{EstimatorKind::Auto};
    const char* end = number.data() + number.size();
    const auto [stop, code] = std::from_chars(number.data(), end, estimator.tolerance);
    if (code != std::errc() || stop != end ||
        !(estimator.tolerance > 0.0f && estimator.tolerance <= kMostTolerance)) {
        return core::Error{core::ErrorCode::Usage,
                           "\"" + std::string(name) +
                               "\" needs a relative error above 0, at most 10, after \"auto:\"",
                           {},
                           {}};
    }
    return estimator;
}

/// The shortest digits that read back to the same float.
std::string digitsOf(float value) {
    std::array<char, 32> digits{};
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return {digits.data(), result.ptr};
}

} // namespace

core::Result<Estimator> parseEstimator(std::string_view name, Term term) {
    if (name.starts_with(kBiasPrefix)) {
        return parseBias(name, term);
    }
    if (name.starts_with(kTapsPrefix)) {
        return parseTaps(name, term);
    }
    if (name.starts_with(kAutoPrefix)) {
        return parseAuto(name, term);
    }
    for (const Row& row : kRows) {
        if (row.name == name && (term == Term::Glossy ? row.glossy : row.diffuse)) {
            return Estimator{row.kind, 0.0f};
        }
    }
    return unknown(name, term);
}

std::string estimatorName(const Estimator& estimator) {
    if (estimator.kind == EstimatorKind::Taps) {
        return std::string(kTapsPrefix) + std::to_string(estimator.taps);
    }
    if (estimator.kind == EstimatorKind::Auto) {
        return std::string(kAutoPrefix) + digitsOf(estimator.tolerance);
    }
    if (estimator.kind != EstimatorKind::Bias && estimator.kind != EstimatorKind::BiasVertex) {
        return std::string(rowOf(estimator.kind).name);
    }
    std::string name = std::string(kBiasPrefix) + digitsOf(estimator.leastLevel);
    if (estimator.kind == EstimatorKind::BiasVertex) {
        name += kVertexSuffix;
    }
    return name;
}

std::vector<std::string> estimatorNames(Term term) {
    std::vector<std::string> names;
    for (const Row& row : kRows) {
        if (term == Term::Glossy ? row.glossy : row.diffuse) {
            names.emplace_back(row.name);
        }
    }
    return names;
}

std::string nameOf(LobeForm form) {
    return form == LobeForm::Sg ? "sg" : "power";
}

std::string nameOf(FresnelForm form) {
    return form == FresnelForm::Sg ? "sg" : "schlick";
}

bool readsTentMips(EstimatorKind kind) {
    return kind == EstimatorKind::Tent || kind == EstimatorKind::Ring3 ||
           kind == EstimatorKind::Ring7 || kind == EstimatorKind::Taps ||
           kind == EstimatorKind::Auto;
}

bool followsLobe(EstimatorKind kind) {
    return readsTentMips(kind) || kind == EstimatorKind::Prefiltered;
}

bool serves(EstimatorKind kind, Term term) {
    const Row& row = rowOf(kind);
    return term == Term::Glossy ? row.glossy : row.diffuse;
}

} // namespace lodestar::lighting
