// SPDX-License-Identifier: MIT
#include "app/sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/commands.h"
#include "io/environment_file.h"
#include "io/file.h"
#include "lighting/mips.h"
#include "lighting/prefiltered.h"
#include "lodestar/lobes.glsl"

namespace lodestar::app {

namespace {

using nlohmann::json;

constexpr int kMaxWidth = 4096;
constexpr double kMaxExponent = 1e7;
/// Base texels kept before the store is emptied: about 1 GiB with both mip chains.
constexpr std::size_t kMaxTexels = std::size_t{24} << 20;

/// An exponent brought into the range of the lobes.
core::Result<double> parseRepairedExponent(const std::string& text, core::Tally& warnings) {
    auto value = parseExponent(text, "exponent");
    if (value && *value > kMaxExponent && std::isfinite(*value)) {
        warnings.add("exponent above 1e7, set to 1e7");
        return kMaxExponent;
    }
    return value;
}

core::Result<glm::dvec3> parseDirection(const std::string& text) {
    const auto direction = parseVector(text, "direction");
    if (!direction) {
        return direction.error();
    }
    const glm::dvec3 a = glm::abs(*direction);
    const double largest = std::max({a.x, a.y, a.z});
    if (largest == 0.0) {
        return usage("0,0,0 points nowhere", "direction");
    }
    return glm::normalize(*direction / largest); // squares of huge components would overflow
}

core::Result<lighting::Lobe> parseLobe(const std::string& text) {
    if (text == "phong") {
        return lighting::Lobe::Phong;
    }
    if (text == "blinn-phong") {
        return lighting::Lobe::BlinnPhong;
    }
    if (text == "lambert") {
        return lighting::Lobe::Lambert;
    }
    return usage("\"" + text + "\" is not a lobe; these are: phong, blinn-phong, lambert");
}

core::Result<lighting::Estimator> parseQueryEstimator(const SampleQuery& query,
                                                      lighting::Lobe lobe) {
    const bool diffuse = lobe == lighting::Lobe::Lambert;
    if (!query.estimator) {
        return diffuse ? lighting::kDefaultDiffuse : lighting::kDefaultSpecular;
    }
    return lighting::parseEstimator(*query.estimator,
                                    diffuse ? lighting::Term::Diffuse : lighting::Term::Glossy);
}

/// All of a request but its estimator.
core::Result<lighting::LookupRequest> parseLobeRequest(const SampleQuery& query,
                                                       core::Tally& warnings) {
    lighting::LookupRequest request;
    auto lobe = parseLobe(query.lobe.value_or("phong"));
    if (!lobe) {
        return lobe.error();
    }
    request.lobe = *lobe;
    if (request.lobe != lighting::Lobe::Lambert) {
        if (!query.exponent) {
            return usage("an exponent is needed for this lobe");
        }
        auto exponent = parseRepairedExponent(*query.exponent, warnings);
        if (!exponent) {
            return exponent.error();
        }
        request.exponent = *exponent;
    }
    if (!query.direction) {
        return usage("a direction is needed");
    }
    auto direction = parseDirection(*query.direction);
    if (!direction) {
        return direction.error();
    }
    request.direction = *direction;
    return request;
}

core::Result<lighting::LookupRequest> parseRequest(const SampleQuery& query,
                                                   core::Tally& warnings) {
    auto request = parseLobeRequest(query, warnings);
    if (!request) {
        return request;
    }
    auto estimator = parseQueryEstimator(query, request->lobe);
    if (!estimator) {
        return estimator.error();
    }
    request->estimator = *estimator;
    return request;
}

/// A JSON value of a batch as the command line would say it; empty if its type is wrong.
std::optional<std::string> wordsOf(const json& value) {
    if (value.is_string()) {
        return value.get<std::string>();
    }
    if (value.is_number()) {
        return value.dump();
    }
    if (value.is_array()) {
        std::string list;
        for (const json& element : value) {
            if (!element.is_number()) {
                return std::nullopt;
            }
            list += (list.empty() ? "" : ",") + element.dump();
        }
        return list;
    }
    return std::nullopt;
}

core::Result<void> setKey(SampleQuery& query, const std::string& key, const json& value) {
    const std::array<std::pair<const char*, std::optional<std::string>*>, 7> words{{
        {"environment", &query.environment},
        {"lighting", &query.lighting},
        {"hour", &query.hour},
        {"lobe", &query.lobe},
        {"exponent", &query.exponent},
        {"direction", &query.direction},
        {"estimator", &query.estimator},
    }};
    for (const auto& [name, target] : words) {
        if (key == name) {
            std::optional<std::string> text = wordsOf(value);
            if (!text) {
                return usage("a text, a number or a list of numbers is needed", "/" + key);
            }
            *target = std::move(*text);
            return {};
        }
    }
    if (key != "width") {
        return usage("unknown key \"" + key + "\"", "/" + key);
    }
    const double width = value.is_number() ? value.get<double>() : 0.0;
    if (!(width >= 1.0 && width <= kMaxWidth) || width != std::floor(width)) {
        return usage("the width is not a whole number from 1 to 4096", "/" + key);
    }
    query.width = static_cast<int>(width);
    return {};
}

std::string sourceOf(const SampleQuery& query) {
    return query.lighting ? *query.lighting : query.environment.value_or("");
}

int runBatch(const SampleOptions& options) {
    auto bytes = io::readFile(options.batch);
    if (!bytes) {
        return fail(core::inFile(bytes.error(), options.batch));
    }
    Sampler sampler;
    std::istringstream lines(std::string(bytes->begin(), bytes->end()));
    std::string line;
    while (std::getline(lines, line)) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) {
            continue;
        }
        const auto query = parseBatchLine(line, options.query);
        const auto answer =
            query ? sampler.answer(*query) : core::Result<Sampler::Answer>(query.error());
        std::string text;
        if (answer) {
            warn(answer->warnings, sourceOf(*query));
            text = answerJson(*answer);
        } else {
            text = json{{"error", answer.error().message()},
                        {"status", static_cast<int>(answer.error().code)}}
                       .dump(-1, ' ', false, json::error_handler_t::replace);
        }
        std::printf("%s\n", text.c_str());
    }
    return 0;
}

/// What was printed reached the file or pipe, or the status says that it did not.
int finish(int status) {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        return fail(
            {core::ErrorCode::OutputFailed, "the answer could not be written", "stdout", {}});
    }
    return status;
}

} // namespace

core::Result<const lighting::PreparedEnvironment*>
Sampler::environment(const std::string& text, int width, const lighting::PreparedParts& parts,
                     core::Tally& warnings) {
    const Key key{text, width};
    auto found = entries_.find(key);
    if (found == entries_.end()) {
        auto loaded = io::loadEnvironment(text, width);
        if (!loaded) {
            return loaded.error();
        }
        warnings.merge(loaded->warnings);
        const std::size_t texels = loaded->base.level(0).size();
        if (texels_ + texels > kMaxTexels) {
            entries_.clear();
            texels_ = 0;
        }
        texels_ += texels;
        found = entries_.emplace(key, Entry{}).first;
        found->second.environment.base = std::move(loaded->base);
    }
    Entry& entry = found->second;
    lighting::PreparedEnvironment& made = entry.environment;
    if (parts.boxMips && !entry.parts.boxMips) {
        made.boxMips = lighting::boxMips(made.base);
        entry.parts.boxMips = true;
    }
    if (parts.tentMips && !entry.parts.tentMips) {
        made.tentMips = lighting::tentMips(made.base);
        entry.parts.tentMips = true;
    }
    if (parts.prefilteredMips && !entry.parts.prefilteredMips) {
        made.prefilteredMips = lighting::prefilteredMips(made.base);
        entry.parts.prefilteredMips = true;
    }
    if (parts.sh9 && !entry.parts.sh9) {
        made.sh9 = lighting::sh9FromCube(made.base);
        entry.parts.sh9 = true;
    }
    if (parts.irradiance && !entry.parts.irradiance) {
        made.irradiance = lighting::irradianceCube(made.base);
        entry.parts.irradiance = true;
    }
    return &made;
}

lighting::ErrorForecast::Choice Sampler::choose(const std::string& text, int width,
                                                const lighting::LookupRequest& request) {
    Entry& entry = entries_.at({text, width});
    if (entry.forecast.empty()) {
        entry.forecast =
            lighting::ErrorForecast(entry.environment.base, entry.environment.tentMips);
    }
    double exponent = request.exponent;
    if (request.lobe == lighting::Lobe::BlinnPhong) {
        exponent = static_cast<double>(
            shader::lodestar_lookupExponent(static_cast<float>(exponent), 1.0f));
    }
    return entry.forecast.choose(static_cast<double>(request.estimator.tolerance), exponent,
                                 exponent);
}

core::Result<Sampler::Answer> Sampler::answerLights(const SampleQuery& query) {
    Answer answer;
    if (query.environment) {
        return usage("an environment or a lighting document is asked, not both");
    }
    const auto request = parseLobeRequest(query, answer.warnings);
    if (!request) {
        return request.error();
    }
    LightsQuery lights{*query.lighting,    15.0,
                       request->lobe,      request->exponent,
                       request->direction, query.estimator.value_or("")};
    if (query.hour) {
        const auto hour = parseNumbers(*query.hour, 1, "hour");
        if (!hour) {
            return hour.error();
        }
        lights.hour = hour->front();
    }
    auto found = lights_.answer(lights, answer.warnings);
    if (!found) {
        return found.error();
    }
    answer.lookup = *found;
    return answer;
}

core::Result<Sampler::Answer> Sampler::answer(const SampleQuery& query) {
    if (query.lighting) {
        return answerLights(query);
    }
    Answer answer;
    auto request = parseRequest(query, answer.warnings);
    if (!request) {
        return request.error();
    }
    if (!query.environment) {
        return usage("an environment or a lighting document is needed");
    }
    auto prepared = environment(*query.environment, query.width.value_or(io::kDefaultCubeWidth),
                                lighting::partsFor(request->estimator), answer.warnings);
    if (!prepared) {
        return prepared.error();
    }
    if (request->estimator.kind == lighting::EstimatorKind::Auto) {
        const auto choice =
            choose(*query.environment, query.width.value_or(io::kDefaultCubeWidth), *request);
        request->estimator = choice.estimator;
        answer.estimator = lighting::estimatorName(choice.estimator);
        answer.foreseenError = choice.error;
    }
    answer.lookup = lighting::lookup(**prepared, *request,
                                     {0, [](double share) {
                                          constexpr double kPercent = 100.0;
                                          progress("reference: percent",
                                                   static_cast<std::size_t>(share * kPercent), 100);
                                      }});
    endProgress();
    return answer;
}

std::string answerJson(const Sampler::Answer& answer) {
    nlohmann::ordered_json line;
    const lighting::LookupAnswer& lookup = answer.lookup;
    line["radiance"] = {lookup.radiance.r, lookup.radiance.g, lookup.radiance.b};
    line["level"] = lookup.level >= 0.0 ? nlohmann::ordered_json(lookup.level) : nullptr;
    line["fetches"] = lookup.fetches;
    if (!answer.estimator.empty()) {
        line["estimator"] = answer.estimator;
        line["foreseen_error"] = answer.foreseenError;
    }
    return line.dump();
}

core::Result<SampleQuery> parseBatchLine(const std::string& line, const SampleQuery& defaults) {
    const json object = json::parse(line, nullptr, false);
    if (!object.is_object()) {
        return usage("the line is not a JSON object");
    }
    SampleQuery query = defaults;
    for (const auto& [key, value] : object.items()) {
        if (value.is_null()) {
            continue; // as if the line lacked it
        }
        if (auto set = setKey(query, key, value); !set) {
            return set.error();
        }
    }
    return query;
}

int runSample(const SampleOptions& options) {
    if (!options.batch.empty()) {
        return finish(runBatch(options));
    }
    Sampler sampler;
    const auto answer = sampler.answer(options.query);
    if (!answer) {
        return fail(answer.error());
    }
    warn(answer->warnings, sourceOf(options.query));
    std::printf("%s\n", answerJson(*answer).c_str());
    return finish(0);
}

void addSample(CLI::App& app, int& status) {
    auto options = std::make_shared<SampleOptions>();
    CLI::App* command = app.add_subcommand(
        "sample", "One lookup in an environment on the CPU, answered as JSON.\n\n"
                  "Example: what a shiny thing facing up sees of a sky that brightens upwards\n"
                  "  lodestar sample --environment gradient:0,1 --lobe phong --exponent 64 \\\n"
                  "      --direction 0,1,0 --estimator tent\n"
                  "answers {\"radiance\":[r,g,b],\"level\":N,\"fetches\":1}. Compare --estimator "
                  "reference, which sums all texels.");
    SampleQuery& query = options->query;
    command->add_option(
        "--environment", query.environment,
        "A panorama, cube cross or strip, six files STEM_{px,nx,py,ny,pz,nz}.EXT, or "
        "constant:R,G,B, gradient:DOWN,UP, disc:X,Y,Z,DEGREES,INSIDE[,OUTSIDE], "
        "faces:R,G,B;... (six)");
    command->add_option("--lighting", query.lighting,
                        "Instead: a lighting document, for the sum of its lights at --hour");
    command->add_option("--hour", query.hour, "Hour of the document's day, [0, 24) (default 15)");
    command->add_option("--lobe", query.lobe,
                        "phong (default), blinn-phong (view = normal = direction) or lambert");
    command->add_option("--exponent", query.exponent,
                        "The lobe's exponent, 0 to 1e7, or inf for a mirror; lambert ignores it");
    command->add_option("--direction", query.direction, "X,Y,Z that the lobe is about");
    const auto list = [](lighting::Term term) {
        std::string names;
        for (const std::string& name : lighting::estimatorNames(term)) {
            names += (names.empty() ? "" : ", ") + name;
        }
        return names;
    };
    const std::string names = "How it is looked up: " + list(lighting::Term::Glossy) +
                              " (default tent); for lambert " + list(lighting::Term::Diffuse) +
                              " (default irradiance); for a document's lights " +
                              lighting::kRsrmNames + ", reference";
    command->add_option("--estimator", query.estimator, names);
    command->add_option("--width", query.width, "Cube face width in texels (default 256)")
        ->check(CLI::Range(1, kMaxWidth));
    command->add_option(
        "--batch", options->batch,
        "A file with one JSON object a line, keys as the options; one answer a line. "
        "Options given beside it are the lines' defaults");
    command->callback([options, &status] { status = runSample(*options); });
}

} // namespace lodestar::app
