// SPDX-License-Identifier: MIT
#include "app/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/check_scene.h"
#include "app/command.h"
#include "app/commands.h"
#include "io/document_file.h"
#include "io/environment_file.h"
#include "io/gltf.h"
#include "io/image_file.h"
#include "lighting/mips.h"
#include "lighting/rsrm_layout.h"
#include "lodestar/display.glsl"

namespace lodestar::app {
namespace {

using Json = nlohmann::ordered_json;

Json warningsJson(const core::Tally& warnings) {
    Json json = Json::object();
    for (const auto& [rule, count] : warnings.counts()) {
        json[rule] = count;
    }
    return json;
}

Json problemsJson(const io::GltfProblems& problems) {
    Json json = Json::array();
    for (const io::GltfProblem& problem : problems.list()) {
        json.push_back({{"pointer", problem.where},
                        {"severity", "error"},
                        {"repaired", problem.repaired},
                        {"message", problem.what}});
    }
    return json;
}

/// A scene's JSON; the first refusal goes to `refusal`, if there is one.
Json checkScene(const std::string& file, std::optional<core::Error>& refusal) {
    io::GltfCheck check = io::checkGltf(file);
    Json json;
    json["file"] = file;
    json["kind"] = "scene";
    if (check.file) {
        warn(check.file->warnings, file);
        json["warnings"] = warningsJson(check.file->warnings);
        describeScene(std::move(*check.file), json);
    } else {
        refusal = core::inFile(check.problems.first(), file);
        json["error"] = refusal->what;
        json["where"] = refusal->where;
        if (check.problems.refusedCount() > 1) {
            refusal->what += ", and " + std::to_string(check.problems.refusedCount() - 1) + " more";
        }
    }
    json["problems"] = problemsJson(check.problems);
    json["problemsLeftOut"] = check.problems.leftOut();
    return json;
}

struct PixelFigures {
    double least = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();
    double sum[3] = {0.0, 0.0, 0.0};
    std::size_t finiteCount[3] = {0, 0, 0};
    std::size_t nonFinite = 0;
};

/// Over the colour channels; alpha is no radiance.
PixelFigures pixelFigures(const core::Image& image) {
    PixelFigures figures;
    const std::size_t n = 3;
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const double value = image.pixels()[i];
        if (!std::isfinite(value)) {
            ++figures.nonFinite;
            continue;
        }
        figures.least = std::min(figures.least, value);
        figures.largest = std::max(figures.largest, value);
        figures.sum[i % n] += value;
        ++figures.finiteCount[i % n];
    }
    return figures;
}

const char* layoutName(io::EnvironmentLayout layout, io::DeclaredLayout declared) {
    switch (layout) {
    case io::EnvironmentLayout::LatLong:
        return "lat-long";
    case io::EnvironmentLayout::Cross:
        return "cross";
    case io::EnvironmentLayout::Strip:
        return declared == io::DeclaredLayout::Cube ? "openexr-cube" : "strip";
    case io::EnvironmentLayout::SixFiles:
        return "six-files";
    case io::EnvironmentLayout::Analytic:
        break;
    }
    return "none";
}

/// Mean over the sphere of a lat-long panorama, from its own pixels: a row's weight is the height
/// of its band, sin(upper latitude) - sin(lower). Pixels that are not finite are left out.
std::array<double, 3> latLongMean(const core::Image& image) {
    std::array<double, 3> sum{};
    std::array<double, 3> weight{};
    const int height = image.height();
    for (int y = 0; y < height; ++y) {
        const double band =
            std::cos(std::numbers::pi * y / height) - std::cos(std::numbers::pi * (y + 1) / height);
        for (int x = 0; x < image.width(); ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double value = image.at(x, y)[c];
                sum[c] += std::isfinite(value) ? band * value : 0.0;
                weight[c] += std::isfinite(value) ? band : 0.0;
            }
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        sum[c] = weight[c] > 0.0 ? sum[c] / weight[c] : 0.0;
    }
    return sum;
}

std::array<double, 3> pixelMean(const PixelFigures& figures) {
    std::array<double, 3> mean{};
    for (std::size_t c = 0; c < 3; ++c) {
        mean[c] = figures.finiteCount[c] > 0
                      ? figures.sum[c] / static_cast<double>(figures.finiteCount[c])
                      : 0.0;
    }
    return mean;
}

/// The layout an environment is read by and its mean over the sphere; where it is none, the mean
/// over the pixels. Cubes are loaded at their own size, so that the mean is of their own texels.
void addEnvironment(const std::string& file, const io::ImageInfo& info, const core::Image& image,
                    const PixelFigures& figures, Json& json) {
    const bool strip = info.width >= 6 * info.height || info.height >= 6 * info.width;
    const int faceWidth = std::clamp(
        strip ? std::min(info.width, info.height) : std::max(info.width, info.height) / 4, 1, 2048);
    const core::Result<io::LoadedEnvironment> environment = io::loadEnvironment(file, faceWidth);
    const bool usable = environment.ok() && environment->layout != io::EnvironmentLayout::SixFiles;
    std::array<double, 3> mean = pixelMean(figures);
    if (usable && environment->layout == io::EnvironmentLayout::LatLong) {
        mean = latLongMean(image);
    } else if (usable) {
        const glm::dvec4 sphere = lighting::sphereMean(environment->base, 0);
        mean = {sphere.x, sphere.y, sphere.z};
    }
    json["layout"] = usable ? layoutName(environment->layout, info.layout) : "none";
    json["mean"] = mean;
    json["warnings"] = usable ? warningsJson(environment->warnings) : Json::object();
    if (usable) {
        warn(environment->warnings, file);
    }
}

core::Result<Json> checkImage(const std::string& file, const io::Bytes& bytes) {
    core::Result<io::ImageInfo> info = io::imageInfo(bytes);
    if (!info) {
        return core::inFile(info.error(), file);
    }
    core::Result<io::DecodedImage> decoded = io::decodeImage(bytes, 3);
    if (!decoded) {
        return core::inFile(decoded.error(), file);
    }
    if (info->format == "png" || info->format == "jpeg") {
        for (float& value : decoded->image.pixels()) {
            value = shader::lodestar_linearFromSrgb(value);
        }
    }
    const PixelFigures figures = pixelFigures(decoded->image);
    const bool any = figures.largest >= figures.least;
    Json json;
    json["file"] = file;
    json["kind"] = "image";
    json["format"] = info->format;
    json["width"] = info->width;
    json["height"] = info->height;
    json["channels"] = info->channels;
    json["min"] = any ? Json(figures.least) : Json(nullptr);
    json["max"] = any ? Json(figures.largest) : Json(nullptr);
    json["nonFinite"] = figures.nonFinite;
    addEnvironment(file, *info, decoded->image, figures, json);
    return json;
}

core::Result<Json> checkDocument(const std::string& file) {
    core::Tally warnings;
    const auto document = io::loadDocument(file, warnings);
    if (!document) {
        return document.error();
    }
    warn(warnings, file);
    Json json;
    json["file"] = file;
    json["kind"] = "lighting";
    json["environment"] =
        document->environment ? Json(document->environment->source) : Json(nullptr);
    const lighting::RsrmLayout maps = document::mapLayout(*document);
    json["mapRows"] = lighting::rowExponents(maps);
    json["lights"] = Json::array();
    for (const document::Light& light : document->lights) {
        Json hours = Json::array();
        for (const document::Key& key : light.keys) {
            hours.push_back(key.hour);
        }
        json["lights"].push_back({{"name", light.name},
                                  {"kind", light.kind == lighting::LightKind::Sky ? "sky" : "sun"},
                                  {"hours", hours},
                                  {"path", light.path.has_value()},
                                  {"mapBytes", lighting::texelBytes(maps)}});
    }
    json["materials"] = Json::array();
    for (const auto& [name, material] : document->materials) {
        json["materials"].push_back(name);
    }
    json["probes"] = document->probes.size();
    json["warnings"] = warningsJson(warnings);
    return json;
}

/// Lighting documents are told by their name, or by a text that says so early on.
bool looksLikeDocument(const std::string& file, const io::Bytes& bytes) {
    const std::string start(
        bytes.begin(),
        bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 4096)));
    return file.ends_with(".lodestar.json") ||
           (file.ends_with(".json") && start.find("\"lodestar\"") != std::string::npos);
}

/// Scenes are GLB or JSON text by their first byte that is not white space; the rest are images.
bool looksLikeScene(const io::Bytes& bytes) {
    const auto first = std::find_if(bytes.begin(), bytes.end(), [](unsigned char c) {
        return c != ' ' && c != '\t' && c != '\r' && c != '\n';
    });
    const std::string magic = "glTF";
    return (first != bytes.end() && *first == '{') ||
           (bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin()));
}

bool endsLikeScene(const std::string& file) {
    return file.ends_with(".gltf") || file.ends_with(".glb");
}

Json checkFile(const std::string& file, std::optional<core::Error>& refusal) {
    core::Result<io::Bytes> bytes = io::readFile(file);
    const bool document = bytes && looksLikeDocument(file, *bytes);
    if (bytes && !document && (endsLikeScene(file) || looksLikeScene(*bytes))) {
        return checkScene(file, refusal);
    }
    core::Result<Json> json = document ? checkDocument(file)
                              : bytes  ? checkImage(file, *bytes)
                                       : bytes.error();
    if (json) {
        return std::move(*json);
    }
    refusal = json.error();
    return {{"file", file}, {"error", refusal->what}, {"where", refusal->where}};
}

} // namespace

int runCheck(const std::vector<std::string>& files) {
    Json results = Json::array();
    int status = 0;
    for (const std::string& file : files) {
        std::optional<core::Error> refusal;
        results.push_back(checkFile(file, refusal));
        if (refusal && status == 0) {
            // A failing call prints one line; the JSON says all.
            status = fail(*refusal);
        }
    }
    const Json& printed = files.size() == 1 ? results.front() : results;
    // Names in a file need not be valid UTF-8; the output is.
    std::printf("%s\n", printed.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return status;
}

void addCheck(CLI::App& app, int& status) {
    auto files = std::make_shared<std::vector<std::string>>();
    CLI::App* command =
        app.add_subcommand("check", "Say what a scene, an image or a lighting document holds, or\n"
                                    "why it is refused");
    command
        ->add_option("FILE", *files,
                     "glTF scenes (.gltf, .glb), images (EXR, HDR, PNG, JPEG), lighting documents\n"
                     "(.lodestar.json)")
        ->required();
    command->footer("Example: is this panorama sound?\n"
                    "  lodestar check dusk.hdr");
    command->callback([files, &status] { status = runCheck(*files); });
}

} // namespace lodestar::app
