// SPDX-License-Identifier: MIT
//
// The lights of documents, for `lodestar sample --lighting`.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "core/tally.h"
#include "lighting/day_lookup.h"
#include "lighting/lookup.h"

namespace lodestar::app {

/// One lookup in a document's lights.
struct LightsQuery {
    std::string file;
    double hour = 15.0; ///< finite, wrapped into [0, 24)
    lighting::Lobe lobe = lighting::Lobe::Phong;
    double exponent = 1.0;
    glm::dvec3 direction{0.0, 0.0, 1.0}; ///< unit
    std::string estimator;               ///< empty: rsrm
};

/// Answers queries; keeps documents and their maps from one query to the next.
class LightsSampler {
public:
    /// @errors Usage for an estimator that lights lack; InputRefused for the document
    [[nodiscard]] core::Result<lighting::LookupAnswer> answer(const LightsQuery& query,
                                                              core::Tally& warnings);

private:
    struct Lit {
        std::vector<lighting::DayLight> lights;
        lighting::RsrmLayout maps; ///< what the document has for `rsrm`
    };
    [[nodiscard]] core::Result<const Lit*> lit(const std::string& file, core::Tally& warnings);

    std::map<std::string, Lit> documents_;
    /// By file and estimator.
    std::map<std::pair<std::string, std::string>, std::unique_ptr<lighting::DayLookup>> maps_;
};

} // namespace lodestar::app
