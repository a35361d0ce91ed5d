// SPDX-License-Identifier: MIT
//
// Groups of oracles.json: inputs with answers computed to 34 digits.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

namespace lodestar::testing {

/// The cases of a group. A group that is missing or empty is an error: nothing would be tested.
inline nlohmann::json oracleCases(const std::string& group) {
    std::ifstream file(LODESTAR_TEST_DATA "/numerics/oracles.json");
    const nlohmann::json cases = nlohmann::json::parse(file).at("groups").at(group).at("cases");
    if (cases.empty()) {
        throw std::runtime_error("no oracles in " + group);
    }
    return cases;
}

} // namespace lodestar::testing
