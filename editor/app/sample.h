// SPDX-License-Identifier: MIT
//
// `lodestar sample`: one lookup in an environment on the CPU, or a file of them, answered as JSON.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "app/sample_lights.h"
#include "core/result.h"
#include "core/tally.h"
#include "lighting/environment.h"
#include "lighting/error_forecast.h"
#include "lighting/lookup.h"

namespace lodestar::app {

/// One lookup in words, as the command line or a line of a batch says it; what is not said is
/// empty.
struct SampleQuery {
    std::optional<std::string> environment; ///< ENV: a file or an analytic map
    std::optional<std::string> lighting;    ///< instead: a lighting document, for its lights
    std::optional<std::string> hour;        ///< of the document's day, default 15
    std::optional<std::string> lobe;        ///< phong (default), blinn-phong or lambert
    std::optional<std::string> exponent;    ///< a number or "inf"; lambert needs none
    std::optional<std::string> direction;   ///< "X,Y,Z", any length but 0
    std::optional<std::string> estimator;   ///< default: the lobe's own, `tent` or `irradiance`
    std::optional<int> width;               ///< cube face width, texels [1, 4096], default 256
};

struct SampleOptions {
    SampleQuery query;
    std::string batch; ///< a file with one JSON object a line; empty: the query alone
};

/// Answers queries; keeps environments and what was prepared of them from one query to the next.
class Sampler {
public:
    struct Answer {
        lighting::LookupAnswer lookup;
        std::string estimator;      ///< that `auto` chose; else empty
        double foreseenError = 0.0; ///< of it, relative RMSE
        core::Tally warnings; ///< repairs of this query; an environment's are told on its first use
    };

    /// @errors Usage for words that are wrong or missing; those of io::loadEnvironment
    [[nodiscard]] core::Result<Answer> answer(const SampleQuery& query);

private:
    struct Entry {
        lighting::PreparedEnvironment environment;
        lighting::PreparedParts parts;
        lighting::ErrorForecast forecast; ///< empty until `auto` has asked
    };
    /// What `auto` stands for. @pre the environment's tent mips are made
    [[nodiscard]] lighting::ErrorForecast::Choice choose(const std::string& text, int width,
                                                         const lighting::LookupRequest& request);
    /// What the query asks of a document's lights.
    [[nodiscard]] core::Result<Answer> answerLights(const SampleQuery& query);

    using Key = std::pair<std::string, int>;

    [[nodiscard]] core::Result<const lighting::PreparedEnvironment*>
    environment(const std::string& text, int width, const lighting::PreparedParts& parts,
                core::Tally& warnings);

    LightsSampler lights_;
    std::map<Key, Entry> entries_;
    std::size_t texels_ = 0; ///< base texels held
};

/// The JSON line of an answer: {"radiance":[r,g,b],"level":number or null,"fetches":n}, of `auto`
/// with "estimator", its choice, and "foreseen_error".
[[nodiscard]] std::string answerJson(const Sampler::Answer& answer);

/// One line of a batch as a query; keys that the line lacks are taken from the defaults.
/// @errors Usage for what is not an object of the known keys
[[nodiscard]] core::Result<SampleQuery> parseBatchLine(const std::string& line,
                                                       const SampleQuery& defaults);

/// Runs the subcommand: answers on stdout, errors and warnings on stderr. @return the exit status
[[nodiscard]] int runSample(const SampleOptions& options);

} // namespace lodestar::app
