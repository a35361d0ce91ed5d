// SPDX-License-Identifier: MIT
//
// What accuracy costs, as the panels are told: each way to estimate glossy light with its measured
// error and time.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lodestar::ui {

/// One estimator, or one layout of the maps of skies and suns.
struct EstimateLine {
    std::string name;
    std::string chosen{};          ///< what `auto` stands for; empty else
    std::optional<double> error{}; ///< relative RMSE over the sphere, as `lodestar cost` tells it
    std::optional<double> worst{}; ///< the same of the worst direction
    std::optional<double> ms{};    ///< milliseconds a megapixel on the GPU that is there
    int fetches = 0;               ///< of textures a pixel
    bool used = false;             ///< by the material
    bool front = false;            ///< none that is measured is faster and as right
};

/// A row of the maps of skies and suns.
struct MapRow {
    double exponent = 0.0;         ///< Phong, of the row
    std::optional<double> error{}; ///< relative RMSE there
    double between = 0.0;          ///< Phong exponent half way to the next row; 0: the last
    std::optional<double> betweenError{};
};

/// One of several selected materials, with what it uses.
struct WornLine {
    std::string material;
    double exponent = 0.0;         ///< Phong, of its lookups seen from above
    std::string estimator;         ///< or layout of maps
    std::optional<double> error{}; ///< relative RMSE
};

struct AccuracyView {
    std::string material;  ///< empty: none is selected; of several the one that errs most
    double exponent = 0.0; ///< Phong, of its lookups seen from above
    /// Whether a material's own estimator has an effect: an environment is read.
    bool selectable = false;
    std::vector<EstimateLine> lines;
    std::vector<MapRow> rows;
    std::vector<WornLine> selected; ///< where several are
    double progress = 1.0;          ///< [0, 1]
};

} // namespace lodestar::ui
