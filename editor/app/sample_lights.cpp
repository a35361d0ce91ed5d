// SPDX-License-Identifier: MIT
#include "app/sample_lights.h"

#include <algorithm>

#include "app/command.h"
#include "io/document_file.h"
#include "lodestar/lobes.glsl"

namespace lodestar::app {
namespace {

/// The exponent of the lobe about the direction: Blinn-Phong's is converted as the estimator does,
/// seen along the normal; the published ones take it as given.
double lookupExponent(const LightsQuery& query) {
    if (query.lobe == lighting::Lobe::Lambert) {
        return 1.0;
    }
    const bool published = query.estimator.starts_with("rsrm-published");
    if (query.lobe == lighting::Lobe::BlinnPhong && !published && query.exponent < 1e7) {
        return static_cast<double>(
            shader::lodestar_lookupExponent(static_cast<float>(query.exponent), 1.0f));
    }
    return query.exponent;
}

} // namespace

core::Result<const LightsSampler::Lit*> LightsSampler::lit(const std::string& file,
                                                           core::Tally& warnings) {
    auto found = documents_.find(file);
    if (found == documents_.end()) {
        const auto document = io::loadDocument(file, warnings);
        if (!document) {
            return document.error();
        }
        core::Tally counted; // by the loading already
        auto lights = document::dayLights(*document, counted);
        if (!lights) {
            return core::inFile(lights.error(), file);
        }
        found =
            documents_.emplace(file, Lit{std::move(*lights), document::mapLayout(*document)}).first;
    }
    return &found->second;
}

core::Result<lighting::LookupAnswer> LightsSampler::answer(const LightsQuery& query,
                                                           core::Tally& warnings) {
    const bool reference = query.estimator == "reference";
    const lighting::RsrmLayout* layout =
        lighting::rsrmLayoutNamed(query.estimator.empty() ? "rsrm" : query.estimator);
    if (!reference && layout == nullptr) {
        return usage("\"" + query.estimator +
                     "\" is no estimator of a document's lights; these are: " +
                     lighting::kRsrmNames + ", reference");
    }
    const auto found = lit(query.file, warnings);
    if (!found) {
        return found.error();
    }
    const Lit& lit = **found;
    if (query.hour < 0.0 || query.hour >= 24.0) {
        warnings.add("hour outside [0, 24), wrapped");
    }
    const double exponent = lookupExponent(query);
    if (reference) {
        return lighting::LookupAnswer{
            lighting::referenceDay(lit.lights, query.hour, query.direction, exponent), -1.0, 0};
    }
    auto& maps = maps_[{query.file, query.estimator}];
    if (!maps) {
        maps = std::make_unique<lighting::DayLookup>(
            lit.lights, *layout == lighting::kRsrm ? lit.maps : *layout);
    }
    const auto answer = query.lobe == lighting::Lobe::Lambert
                            ? maps->lambert(query.hour, query.direction)
                            : maps->lookup(query.hour, query.direction, exponent);
    return lighting::LookupAnswer{answer.radiance, -1.0, answer.fetches};
}

} // namespace lodestar::app
