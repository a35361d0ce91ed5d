// SPDX-License-Identifier: MIT
//
// `lodestar compare`: how far one rendered picture is from another.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/commands.h"
#include "app/error_view.h"
#include "io/file.h"
#include "io/image_file.h"

namespace lodestar::app {
namespace {

struct CompareOptions {
    std::string picture, reference, output;
    double scale = 100.0 * kErrorScale;
};

/// Linear radiance of an EXR, 4 channels.
core::Result<core::Image> loadRadiance(const std::string& file) {
    const auto bytes = io::readFile(file);
    if (!bytes) {
        return core::inFile(bytes.error(), file);
    }
    auto decoded = io::decodeImage(*bytes, 4);
    if (!decoded) {
        return core::inFile(decoded.error(), file);
    }
    if (decoded->info.format != "openexr") {
        return core::inFile({core::ErrorCode::InputRefused,
                             "pictures are compared by their linear radiance, as render writes EXR",
                             {},
                             {}},
                            file);
    }
    return std::move(decoded->image);
}

core::Result<void> compare(const CompareOptions& options) {
    auto picture = loadRadiance(options.picture);
    if (!picture) {
        return picture.error();
    }
    const auto reference = loadRadiance(options.reference);
    if (!reference) {
        return reference.error();
    }
    if (picture->width() != reference->width() || picture->height() != reference->height()) {
        return core::inFile(
            {core::ErrorCode::InputRefused, "is not of the size of " + options.reference, {}, {}},
            options.picture);
    }
    ErrorView view(std::move(*picture));
    view.add(*reference);
    const ErrorFigures figures = view.figures();
    if (!options.output.empty()) {
        if (auto written = io::writeImage(
                options.output, view.picture(options.scale / 100.0, ErrorView::Legend::Beneath));
            !written) {
            return written;
        }
    }
    const nlohmann::ordered_json json = {{"mean", figures.mean},
                                         {"rms", figures.rms},
                                         {"worst", figures.worst},
                                         {"worst_at", {figures.worstX, figures.worstY}},
                                         {"pixels", figures.pixels}};
    std::printf("%s\n", json.dump().c_str());
    return {};
}

int runCompare(const CompareOptions& options) {
    if (!options.output.empty() && !options.output.ends_with(".png")) {
        return fail(usage("'" + options.output + "' does not end in .png", "-o"));
    }
    const auto done = compare(options);
    return done ? 0 : fail(done.error());
}

} // namespace

void addCompare(CLI::App& app, int& status) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand(
        "compare",
        "How far one picture is from another of the same view: figures as JSON, and the\n"
        "errors in false colour. Both are EXRs as `render` writes them.\n\n"
        "Example: what a probe's old light is off by\n"
        "  lodestar compare composed.exr captured.exr -o error.png");
    command->add_option("PICTURE", options->picture, "The picture, an EXR")->required();
    command->add_option("REFERENCE", options->reference, "What it should be, an EXR")->required();
    command->add_option("-o,--output", options->output,
                        "ERROR.png: errors in false colour with a legend in per cent");
    command->add_option("--error-scale", options->scale, "Per cent that have the last colour")
        ->check(CLI::Range(0.001, 1e6))
        ->capture_default_str();
    command->callback([options, &status] { status = runCompare(*options); });
}

} // namespace lodestar::app
