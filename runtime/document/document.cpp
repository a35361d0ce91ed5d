// SPDX-License-Identifier: MIT
#include "document/document.h"

namespace lodestar::document {
namespace {

lighting::DayLight dayLight(const Light& light) {
    lighting::DayLight day;
    day.kind = light.kind;
    day.axis = light.axis.value_or(glm::dvec3(0.0, 1.0, 0.0));
    day.path = light.path;
    day.name = light.name;
    day.visibility = light.visibility;
    day.add = light.add;
    for (const Key& key : light.keys) {
        lighting::DayKey made{
            key.hour, {{}, key.gradient.interpolation, key.gradient.space}, key.tint, key.axis};
        for (const Stop& stop : key.gradient.stops) {
            made.gradient.stops.push_back(stop.stop);
        }
        day.keys.push_back(std::move(made));
    }
    return day;
}

} // namespace

core::Result<std::vector<lighting::DayLight>> dayLights(const Document& document,
                                                        core::Tally& warnings) {
    std::vector<lighting::DayLight> lights;
    for (std::size_t i = 0; i < document.lights.size(); ++i) {
        auto repaired = lighting::repaired(dayLight(document.lights[i]), warnings);
        if (!repaired) {
            core::Error error = repaired.error();
            error.where = "/lights/" + std::to_string(i) + error.where;
            return error;
        }
        lights.push_back(std::move(*repaired));
    }
    return lights;
}

lighting::RsrmLayout mapLayout(const Document& document) {
    return lighting::rsrmWithRows(document.rsrm ? document.rsrm->exponents : std::vector<double>());
}

} // namespace lodestar::document
