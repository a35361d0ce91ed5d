// SPDX-License-Identifier: MIT
//
// What `lodestar cost` finds out, and how it is written for other programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/image.h"

namespace lodestar::app {

/// One estimator at one exponent on one map.
struct CostRow {
    std::string environment;
    std::string term; ///< "glossy" or "diffuse"
    std::string estimator;
    double exponent = 0.0;  ///< Phong; a diffuse lobe's is 1
    int fetches = 0;        ///< texture fetches a pixel
    double rmse = 0.0;      ///< lighting::Accuracy
    double worst = 0.0;     ///< the same
    double shadingMs = 0.0; ///< milliseconds a megapixel
    bool front = false;     ///< nothing that is faster is as right: of its map, term and exponent
};

/// What an estimator needs of a map before the first pixel.
struct CostPreparation {
    std::string environment, term, estimator;
    double ms = 0.0;         ///< on the CPU, all processors
    std::uint64_t bytes = 0; ///< of textures
};

/// Where on the sphere an estimator is wrong: a panorama of |difference| over the truth's RMS.
struct CostPicture {
    std::string environment, estimator;
    double exponent = 0.0;
    core::Image errors; ///< 1 channel; up is +Y, the middle -Z
};

/// Direct light by a form of its lobe and one of Fresnel's reflectance.
struct CostLobe {
    std::string lobes, fresnel; ///< lighting::nameOf
    double exponent = 0.0;      ///< Blinn-Phong
    double rmse = 0.0;          ///< LobeErrors
    double worst = 0.0;         ///< the same
    double shadingMs = 0.0;     ///< milliseconds a megapixel under kCostedLights lights
};

/// The lights under which direct light is timed.
inline constexpr int kCostedLights = 16;

/// The difference that is lightest in these pictures.
inline constexpr double kPictureMost = 0.5;

struct CostTable {
    std::string renderer;     ///< OpenGL's name of what shaded
    int width = 0;            ///< of a cube's face, texels
    int directions = 0;       ///< that errors were measured at
    double emptyTileMs = 0.0; ///< milliseconds a megapixel of a tile without a lookup
    std::vector<std::string> environments;
    std::vector<double> exponents;
    std::vector<CostRow> rows;
    std::vector<CostPreparation> preparations;
    std::vector<CostPicture> pictures;
    std::vector<CostLobe> lobes;
};

/// Marks the rows that no other of the same map, term and exponent beats: faster or as fast and at
/// least as right.
void markFront(std::vector<CostRow>& rows);

[[nodiscard]] std::string costCsv(const CostTable& table);
[[nodiscard]] std::string lobesCsv(const CostTable& table);
[[nodiscard]] nlohmann::ordered_json costJson(const CostTable& table);

} // namespace lodestar::app
