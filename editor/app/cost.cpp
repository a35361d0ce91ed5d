// SPDX-License-Identifier: MIT
//
// `lodestar cost`: what accuracy costs in time, on given maps and on the machine that is there.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/commands.h"
#include "app/cost_estimates.h"
#include "app/cost_lobes.h"
#include "app/cost_page.h"
#include "app/cost_plots.h"
#include "app/cost_shading.h"
#include "app/cost_table.h"
#include "io/environment_file.h"
#include "io/file.h"
#include "io/image_file.h"
#include "lighting/accuracy.h"
#include "platform/headless_context.h"
#include "ui/false_color.h"

namespace lodestar::app {
namespace {

constexpr int kPictureWidth = 64, kPictureHeight = 32;

struct CostOptions {
    std::vector<std::string> environments;
    std::string folder;
    std::string exponents = "1,2,4,8,16,32,64,128,256,512,1024,2048";
    int width = io::kDefaultCubeWidth;
    int directions = 512;
    int repeats = 3;
    bool noPlots = false;
};

/// What is measured on one map.
struct Measured {
    std::string name;
    lighting::Cubemap base;
    std::vector<lighting::MeasuredDirection> directions; ///< of errors
    std::vector<glm::dvec3> all;                         ///< those, then the pictures' pixels
    std::vector<glm::dvec3> truths;                      ///< [all][exponent]
};

std::vector<glm::dvec3> pictureDirections() {
    std::vector<glm::dvec3> directions;
    for (int y = 0; y < kPictureHeight; ++y) {
        const double theta = std::numbers::pi * (y + 0.5) / kPictureHeight;
        for (int x = 0; x < kPictureWidth; ++x) {
            const double azimuth = 2.0 * std::numbers::pi * ((x + 0.5) / kPictureWidth - 0.5);
            directions.emplace_back(std::sin(theta) * std::sin(azimuth), std::cos(theta),
                                    -std::sin(theta) * std::cos(azimuth));
        }
    }
    return directions;
}

core::Result<Measured> measureTruth(const CostOptions& options, std::size_t index,
                                    const std::vector<double>& exponents) {
    const std::string& source = options.environments[index];
    auto loaded = io::loadEnvironment(source, options.width);
    if (!loaded) {
        return loaded.error();
    }
    warn(loaded->warnings, source);
    Measured map;
    const std::string stem = std::filesystem::path(source).stem().string();
    map.name = source.find(':') == std::string::npos && !stem.empty() ? stem : source;
    map.base = std::move(loaded->base);
    map.directions = lighting::measuredDirections(map.base, options.directions);
    for (const lighting::MeasuredDirection& measured : map.directions) {
        map.all.push_back(measured.direction);
    }
    const std::vector<glm::dvec3> pixels = pictureDirections();
    map.all.insert(map.all.end(), pixels.begin(), pixels.end());
    const std::string what = "the truth of " + map.name + ": directions";
    map.truths = lighting::lobeMeans(map.base, map.all, exponents, [&](std::size_t done) {
        if (done % 16 == 0) {
            progress(what, done, map.all.size());
        }
    });
    endProgress();
    return map;
}

/// The truth at one exponent.
std::vector<glm::dvec3> truthAt(const Measured& map, const std::vector<double>& exponents,
                                double exponent) {
    const auto at = static_cast<std::size_t>(
        std::find(exponents.begin(), exponents.end(), exponent) - exponents.begin());
    std::vector<glm::dvec3> truth;
    for (std::size_t d = 0; d < map.all.size(); ++d) {
        truth.push_back(map.truths[d * exponents.size() + at]);
    }
    return truth;
}

/// |difference| of the pictures' pixels over the truth's RMS over the sphere.
core::Image pictureOf(const Measured& map, const std::vector<glm::dvec3>& truth,
                      const std::vector<glm::dvec3>& answers) {
    double norm = 0.0;
    for (std::size_t d = 0; d < map.directions.size(); ++d) {
        norm += map.directions[d].weight * glm::dot(truth[d], truth[d]);
    }
    core::Image image(kPictureWidth, kPictureHeight, 1);
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const std::size_t d = map.directions.size() + i;
        const glm::dvec3 difference = answers[d] - truth[d];
        image.pixels()[i] = static_cast<float>(
            std::sqrt(glm::dot(difference, difference) / std::max(norm, 1e-300)));
    }
    return image;
}

/// Exponents that are shown as pictures: a broad, a glossy and a sharp one of those asked for.
bool isShown(const std::vector<double>& exponents, double exponent) {
    const std::size_t last = exponents.size() - 1;
    for (const std::size_t shown : {last / 4, last / 2, last - last / 4}) {
        if (exponents[shown] == exponent) {
            return true;
        }
    }
    return false;
}

class CostMeasurement {
public:
    CostMeasurement(const CostOptions& options, CostShading& shading, CostTable& table)
        : options_(options), shading_(shading), table_(table) {}

    core::Result<void> run(const Measured& map, const std::vector<double>& truthExponents) {
        const std::vector<CostedLookup> lookups = costedLookups();
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            progress("estimators on " + map.name + ":", i, lookups.size());
            if (auto done = measure(map, lookups[i], truthExponents); !done) {
                return done;
            }
        }
        endProgress();
        return {};
    }

private:
    core::Result<void> measure(const Measured& map, const CostedLookup& lookup,
                               const std::vector<double>& truthExponents) {
        const bool glossy = lookup.term == lighting::Term::Glossy;
        const ReadyLookup ready = makeReady(lookup, map.base);
        const auto bytes = shading_.prepare(lookup, map.base);
        if (!bytes) {
            return bytes.error();
        }
        const char* term = glossy ? "glossy" : "diffuse";
        table_.preparations.push_back({map.name, term, lookup.name, ready.preparationMs, *bytes});
        for (const double exponent : glossy ? table_.exponents : std::vector<double>{1.0}) {
            const std::vector<glm::dvec3> truth = truthAt(map, truthExponents, exponent);
            std::vector<glm::dvec3> answers;
            CostRow row{map.name, term, lookup.name, exponent};
            for (const glm::dvec3& direction : map.all) {
                const CostAnswer answer = ready.answer(direction, exponent);
                row.fetches = answer.fetches;
                answers.push_back(answer.radiance);
            }
            const lighting::Accuracy accuracy =
                lighting::accuracyOf(map.directions, {truth.data(), map.directions.size()},
                                     {answers.data(), map.directions.size()});
            row.rmse = accuracy.rmse;
            row.worst = accuracy.worst;
            const auto ms = shading_.milliseconds(exponent, options_.repeats);
            if (!ms) {
                return ms.error();
            }
            row.shadingMs = *ms;
            table_.rows.push_back(row);
            if (glossy && lookup.layout == nullptr && isShown(table_.exponents, exponent)) {
                table_.pictures.push_back(
                    {map.name, lookup.name, exponent, pictureOf(map, truth, answers)});
            }
        }
        return {};
    }

    const CostOptions& options_;
    CostShading& shading_;
    CostTable& table_;
};

/// Direct light by each pair of forms at each exponent; the time, which no exponent changes, once.
core::Result<void> measureLobes(const CostOptions& options, CostShading& shading,
                                CostTable& table) {
    for (const auto lobes : {lighting::LobeForm::Power, lighting::LobeForm::Sg}) {
        for (const auto fresnel : {lighting::FresnelForm::Schlick, lighting::FresnelForm::Sg}) {
            const double middle = table.exponents[table.exponents.size() / 2];
            const auto ms = shading.lobeMilliseconds(lobes, fresnel, middle, options.repeats);
            if (!ms) {
                return ms.error();
            }
            for (const double exponent : table.exponents) {
                const LobeErrors errors = lobeErrors(lobes, fresnel, exponent);
                table.lobes.push_back(
                    {nameOf(lobes), nameOf(fresnel), exponent, errors.rmse, errors.worst, *ms});
            }
        }
    }
    return {};
}

core::Result<CostTable> measureAll(const CostOptions& options) {
    auto exponents = parseExponents(options.exponents, "--exponents");
    if (!exponents) {
        return exponents.error();
    }
    std::sort(exponents->begin(), exponents->end());
    exponents->erase(std::unique(exponents->begin(), exponents->end()), exponents->end());
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return context.error();
    }
    auto device = gl::Device::create();
    if (!device) {
        return device.error();
    }
    auto shading = CostShading::make(**device);
    if (!shading) {
        return shading.error();
    }
    CostTable table;
    table.renderer = (*device)->capabilities().renderer;
    table.width = options.width;
    table.directions = options.directions;
    table.exponents = *exponents;
    std::vector<double> truthExponents = *exponents;
    if (std::find(truthExponents.begin(), truthExponents.end(), 1.0) == truthExponents.end()) {
        truthExponents.push_back(1.0); // the diffuse lobe's
    }
    for (std::size_t i = 0; i < options.environments.size(); ++i) {
        const auto map = measureTruth(options, i, truthExponents);
        if (!map) {
            return map.error();
        }
        table.environments.push_back(map->name);
        CostMeasurement measurement(options, **shading, table);
        if (auto measured = measurement.run(*map, truthExponents); !measured) {
            return measured.error();
        }
    }
    const auto empty = (*shading)->emptyMilliseconds(options.repeats);
    if (!empty) {
        return empty.error();
    }
    table.emptyTileMs = *empty;
    if (auto measured = measureLobes(options, **shading, table); !measured) {
        return measured.error();
    }
    markFront(table.rows);
    return table;
}

core::Result<void> writeText(const std::filesystem::path& file, const std::string& text) {
    return io::writeFile(file, text.data(), text.size());
}

/// One channel in false colour, as a PNG holds it. @param most the value that is lightest
core::Image falseColorPicture(const core::Image& values, double most) {
    core::Image picture(values.width(), values.height(), 4);
    for (std::size_t i = 0; i < values.pixels().size(); ++i) {
        const glm::vec3 color = ui::falseColor(static_cast<double>(values.pixels()[i]) / most);
        std::copy_n(&color.x, 3, picture.pixels().begin() + static_cast<std::ptrdiff_t>(4 * i));
        picture.pixels()[4 * i + 3] = 1.0f;
    }
    return picture;
}

core::Result<std::vector<std::filesystem::path>>
writePictures(const CostTable& table, const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 0; i < table.pictures.size(); ++i) {
        char name[40];
        std::snprintf(name, sizeof name, "errors-%03zu.png", i + 1);
        files.push_back(folder / name);
        if (auto written = io::writeImage(
                files.back(), falseColorPicture(table.pictures[i].errors, kPictureMost));
            !written) {
            return written.error();
        }
    }
    return files;
}

core::Result<void> writeAll(const CostOptions& options, const CostTable& table) {
    const std::filesystem::path folder = options.folder;
    if (auto written = writeText(folder / "cost.csv", costCsv(table)); !written) {
        return written;
    }
    if (auto written = writeText(folder / "lobes.csv", lobesCsv(table)); !written) {
        return written;
    }
    if (auto written = writeText(folder / "cost.json", costJson(table).dump(1) + "\n"); !written) {
        return written;
    }
    const auto pictures = writePictures(table, folder);
    if (!pictures) {
        return pictures.error();
    }
    std::vector<CostPlot> plots;
    if (!options.noPlots) {
        auto drawn = plotCost(table, folder);
        if (!drawn) {
            return drawn.error();
        }
        plots = std::move(*drawn);
    }
    const auto page = costPage(table, plots, *pictures);
    return page ? writeText(folder / "index.html", *page) : core::Result<void>(page.error());
}

int runCost(const CostOptions& options) {
    if (!options.noPlots && !canPlot()) {
        return fail(usage("the plots need gnuplot, which is not installed; --no-plots goes without",
                          "--no-plots"));
    }
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed) {
        return fail({core::ErrorCode::OutputFailed,
                     "the folder could not be made: " + failed.message(),
                     options.folder,
                     {}});
    }
    const auto table = measureAll(options);
    if (!table) {
        return fail(table.error());
    }
    if (auto written = writeAll(options, *table); !written) {
        return fail(written.error());
    }
    for (const std::string& sentence : costConclusion(*table)) {
        std::printf("%s\n", sentence.c_str());
    }
    std::printf("%s\n", (std::filesystem::path(options.folder) / "index.html").c_str());
    return 0;
}

} // namespace

void addCost(CLI::App& app, int& status) {
    auto options = std::make_shared<CostOptions>();
    CLI::App* command = app.add_subcommand(
        "cost",
        "What accuracy costs in time: error against the reference and milliseconds of every\n"
        "estimator on given maps and this machine, as a page, CSV and JSON.\n\n"
        "Example: which estimator is worth its time on a sunset?\n"
        "  lodestar cost sunset.exr -o cost && xdg-open cost/index.html");
    command
        ->add_option("ENV", options->environments,
                     "Panoramas, cubes or analytic maps, as `sample --environment` takes them")
        ->required();
    command
        ->add_option("-o,--output", options->folder,
                     "Folder for index.html, cost.csv, lobes.csv, cost.json")
        ->required();
    command->add_option("--exponents", options->exponents, "Phong exponents, 0 to 1e7")
        ->capture_default_str();
    command->add_option("--width", options->width, "Cube face width in texels")
        ->check(CLI::Range(16, 1024))
        ->capture_default_str();
    command
        ->add_option("--directions", options->directions,
                     "Directions that errors are measured at, half of them at what is bright")
        ->check(CLI::Range(16, 100000))
        ->capture_default_str();
    command->add_option("--repeats", options->repeats, "Of each timing; the least counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_flag("--no-plots", options->noPlots, "Go without gnuplot and its plots");
    command->callback([options, &status] { status = runCost(*options); });
}

} // namespace lodestar::app
