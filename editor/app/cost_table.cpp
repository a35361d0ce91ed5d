// SPDX-License-Identifier: MIT
#include "app/cost_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace lodestar::app {
namespace {

bool rivals(const CostRow& a, const CostRow& b) {
    return a.environment == b.environment && a.term == b.term && a.exponent == b.exponent;
}

/// A field of a CSV line: quoted where it has to be (RFC 4180).
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char character : text) {
        quoted += character == '"' ? std::string("\"\"") : std::string(1, character);
    }
    return quoted + "\"";
}

/// A number with all its digits; JSON and CSV have none that are not finite.
nlohmann::ordered_json number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

} // namespace

void markFront(std::vector<CostRow>& rows) {
    for (CostRow& row : rows) {
        row.front = std::none_of(rows.begin(), rows.end(), [&](const CostRow& other) {
            return rivals(row, other) && other.shadingMs <= row.shadingMs &&
                   other.rmse <= row.rmse &&
                   (other.shadingMs < row.shadingMs || other.rmse < row.rmse);
        });
    }
}

std::string costCsv(const CostTable& table) {
    std::ostringstream text;
    text << "environment,term,estimator,exponent,fetches,rmse,worst,shading_ms_per_megapixel,"
            "preparation_ms,texture_bytes,front\n";
    for (const CostRow& row : table.rows) {
        const auto made = std::find_if(table.preparations.begin(), table.preparations.end(),
                                       [&](const CostPreparation& preparation) {
                                           return preparation.environment == row.environment &&
                                                  preparation.term == row.term &&
                                                  preparation.estimator == row.estimator;
                                       });
        text << field(row.environment) << ',' << row.term << ',' << field(row.estimator) << ','
             << number(row.exponent).dump() << ',' << row.fetches << ',' << number(row.rmse).dump()
             << ',' << number(row.worst).dump() << ',' << number(row.shadingMs).dump() << ','
             << number(made->ms).dump() << ',' << made->bytes << ',' << (row.front ? 1 : 0) << '\n';
    }
    return text.str();
}

std::string lobesCsv(const CostTable& table) {
    std::ostringstream text;
    text << "lobes,fresnel,exponent,rmse,worst,shading_ms_per_megapixel\n";
    for (const CostLobe& row : table.lobes) {
        text << row.lobes << ',' << row.fresnel << ',' << number(row.exponent).dump() << ','
             << number(row.rmse).dump() << ',' << number(row.worst).dump() << ','
             << number(row.shadingMs).dump() << '\n';
    }
    return text.str();
}

nlohmann::ordered_json costJson(const CostTable& table) {
    nlohmann::ordered_json json;
    json["renderer"] = table.renderer;
    json["cube_width"] = table.width;
    json["directions"] = table.directions;
    json["empty_tile_ms_per_megapixel"] = table.emptyTileMs;
    json["environments"] = table.environments;
    json["exponents"] = table.exponents;
    json["rows"] = nlohmann::ordered_json::array();
    for (const CostRow& row : table.rows) {
        json["rows"].push_back({{"environment", row.environment},
                                {"term", row.term},
                                {"estimator", row.estimator},
                                {"exponent", row.exponent},
                                {"fetches", row.fetches},
                                {"rmse", number(row.rmse)},
                                {"worst", number(row.worst)},
                                {"shading_ms_per_megapixel", number(row.shadingMs)},
                                {"front", row.front}});
    }
    json["preparations"] = nlohmann::ordered_json::array();
    for (const CostPreparation& made : table.preparations) {
        json["preparations"].push_back({{"environment", made.environment},
                                        {"term", made.term},
                                        {"estimator", made.estimator},
                                        {"ms", made.ms},
                                        {"texture_bytes", made.bytes}});
    }
    json["lobes"] = nlohmann::ordered_json::array();
    for (const CostLobe& row : table.lobes) {
        json["lobes"].push_back({{"lobes", row.lobes},
                                 {"fresnel", row.fresnel},
                                 {"exponent", row.exponent},
                                 {"rmse", number(row.rmse)},
                                 {"worst", number(row.worst)},
                                 {"shading_ms_per_megapixel", number(row.shadingMs)}});
    }
    return json;
}

} // namespace lodestar::app
