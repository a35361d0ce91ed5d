// SPDX-License-Identifier: MIT
#include "app/bake_source.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <vector>

#include "app/command.h"
#include "io/document_file.h"
#include "io/environment_file.h"
#include "lighting/day.h"
#include "lighting/zonal_picture.h"

namespace lodestar::app {
namespace {

using lighting::DayLight;
using lighting::LightKind;

constexpr double kDefaultHour = 15.0;

std::string listOf(const std::vector<DayLight>& lights) {
    std::string names;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string& name = lights[i].name;
        names += (i == 0 ? "" : ", ") + (name.empty() ? std::to_string(i) : name);
    }
    return names;
}

/// The light of a name, else of a number; the first one where none is asked for.
core::Result<const DayLight*> choose(const std::vector<DayLight>& lights,
                                     const BakeSourceOptions& options, core::Tally& warnings) {
    if (lights.empty()) {
        return core::inFile(core::refused("the document has no lights", "/lights"), options.source);
    }
    if (options.light.empty()) {
        if (lights.size() > 1) {
            warnings.add("several lights, the first is baked; --light chooses among " +
                         listOf(lights));
        }
        return &lights.front();
    }
    for (const DayLight& light : lights) {
        if (light.name == options.light) {
            return &light;
        }
    }
    std::size_t number = lights.size();
    const char* end = options.light.data() + options.light.size();
    const auto [stop, error] = std::from_chars(options.light.data(), end, number);
    if (error != std::errc{} || stop != end || number >= lights.size()) {
        return usage("the document has no light '" + options.light +
                     "'; these are: " + listOf(lights));
    }
    return &lights[number];
}

core::Result<BakeSource> fromDocument(const BakeSourceOptions& options, const ZonesOfKind& zonesOf,
                                      core::Tally& warnings) {
    if (!options.axis.empty() || !options.kind.empty()) {
        return usage("--axis and --kind are for pictures: a document's lights have their own");
    }
    const auto document = io::loadDocument(options.source, warnings);
    if (!document) {
        return document.error();
    }
    core::Tally counted; // by the loading already
    const auto lights = document::dayLights(*document, counted);
    if (!lights) {
        return core::inFile(lights.error(), options.source);
    }
    const auto light = choose(*lights, options, warnings);
    if (!light) {
        return light.error();
    }
    const double hour = options.hour.value_or(kDefaultHour);
    if (!std::isfinite(hour)) {
        return usage("an hour is a finite number", "--hour");
    }
    if (hour < 0.0 || hour >= 24.0) {
        warnings.add("hour outside [0, 24), wrapped");
    }
    const lighting::DayMoment moment = lighting::momentAt(**light, hour);
    if (moment.visibility <= 0.0) {
        warnings.add("the sun is below the horizon at this hour: its map is black");
    }
    const lighting::Zones zones = zonesOf((*light)->kind);
    return BakeSource{"document",
                      (*light)->kind,
                      lighting::blended(lighting::keyRadiance(**light, moment.keys.from, zones),
                                        lighting::keyRadiance(**light, moment.keys.to, zones),
                                        moment.keys.t, moment.visibility),
                      {},
                      document->rsrm ? document->rsrm->exponents : std::vector<double>()};
}

core::Result<BakeSource> fromPicture(const BakeSourceOptions& options, const ZonesOfKind& zonesOf,
                                     core::Tally& warnings) {
    if (!options.light.empty() || options.hour) {
        return usage("--light and --hour are for lighting documents");
    }
    if (!options.kind.empty() && options.kind != "sky" && options.kind != "sun") {
        return usage("\"" + options.kind + "\" is no kind of light; these are: sky, sun");
    }
    const LightKind kind = options.kind == "sun" ? LightKind::Sun : LightKind::Sky;
    const lighting::Zones zones = zonesOf(kind);
    const auto image = io::loadRadiance(options.source, warnings);
    if (!image) {
        return image.error();
    }
    if (image->width() == 1 || image->height() == 1) {
        if (!options.axis.empty()) {
            return usage("--axis is for panoramas: a strip is painted from its axis outwards");
        }
        std::vector<glm::dvec3> texels;
        for (std::size_t i = 0; i + 2 < image->pixels().size(); i += 3) {
            const float* p = image->pixels().data() + i;
            texels.emplace_back(p[0], p[1], p[2]);
        }
        return BakeSource{"strip", kind, lighting::zonalFromStrip(texels, zones), {}};
    }
    if (image->width() != 2 * image->height()) {
        return core::inFile(core::refused("the picture is " + std::to_string(image->width()) +
                                          " x " + std::to_string(image->height()) +
                                          ", which is no strip (one row or column) and no panorama "
                                          "(twice as wide as high)"),
                            options.source);
    }
    const auto axis = parseAxis(options.axis.empty() ? "0,1,0" : options.axis, "--axis");
    if (!axis) {
        return axis.error();
    }
    auto zonal = lighting::zonalFromPanorama(*image, *axis, zones);
    return BakeSource{"panorama", kind, std::move(zonal.radiance), zonal.residual};
}

} // namespace

core::Result<BakeSource> loadBakeSource(const BakeSourceOptions& options,
                                        const ZonesOfKind& zonesOf, core::Tally& warnings) {
    return std::filesystem::path(options.source).extension() == ".json"
               ? fromDocument(options, zonesOf, warnings)
               : fromPicture(options, zonesOf, warnings);
}

} // namespace lodestar::app
