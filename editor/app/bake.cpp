// SPDX-License-Identifier: MIT
//
// `lodestar bake`: a filtered map as a picture, every exponent a row.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/bake_lights.h"
#include "app/bake_source.h"
#include "app/command.h"
#include "app/commands.h"
#include "io/image_file.h"
#include "lighting/rsrm.h"
#include "lighting/rsrm_weights.h"

namespace lodestar::app {
namespace {

constexpr int kMaxColumns = 1024;
constexpr std::size_t kMaxRows = 64;
constexpr double kMaxExponent = 1e7;

struct BakeOptions {
    BakeSourceOptions source;
    std::string output;
    std::string exponents = "1,2,4,8,16,32,64,128,256,512,1024,2048";
    int columns = 0; ///< 0: the layout's own
    std::string encoding = "float";
    std::string layout = "rsrm";
    bool errors = false;
    bool keepSun = false;
};

core::Result<lighting::RsrmLayout> parseLayout(const BakeOptions& options) {
    if (options.layout != "rsrm" && options.layout != "rsrm-published") {
        return usage("\"" + options.layout + "\" is no layout; these are: rsrm, rsrm-published");
    }
    lighting::RsrmLayout layout =
        options.layout == "rsrm" ? lighting::kRsrm : lighting::kRsrmPublished;
    layout.columns = options.columns == 0 ? layout.columns : options.columns;
    if (layout.columns < 2 || layout.columns > kMaxColumns) {
        return usage("a map has 2 to " + std::to_string(kMaxColumns) + " columns", "--columns");
    }
    if (options.encoding == "unorm8") {
        layout.encoding = lighting::RsrmEncoding::Unorm8;
    } else if (options.encoding == "rgb9e5") {
        layout.encoding = lighting::RsrmEncoding::SharedExponent;
    } else if (options.encoding == "half") {
        layout.encoding = lighting::RsrmEncoding::Half;
    } else if (options.encoding == "float") {
        layout.encoding = lighting::RsrmEncoding::Float;
    } else {
        return usage("\"" + options.encoding +
                     "\" is no encoding; these are: unorm8, rgb9e5, half, float");
    }
    return layout;
}

lighting::RsrmBake filtered(const BakeSource& source, const lighting::RsrmLayout& layout,
                            const std::vector<double>& exponents) {
    const std::vector<double> angles = lighting::columnAngles(layout.columnMap, layout.columns);
    const lighting::Zones& zones = source.radiance.zones;
    return (layout.sampledWeights ? lighting::RsrmKernel::published(zones.count, angles, exponents)
                                  : lighting::RsrmKernel(zones, angles, exponents))
        .bake(source.radiance);
}

/// The picture: what is left of the bake once its texels are stored and read again.
core::Image decoded(const lighting::RsrmLayout& layout, const lighting::RsrmBake& bake) {
    const std::vector<glm::vec3> stored = lighting::storedRows(layout, bake);
    core::Image image(static_cast<int>(bake.columns), static_cast<int>(bake.exponents.size()), 3);
    std::copy_n(&stored[0].x, image.pixels().size(), image.pixels().begin());
    return image;
}

/// Worst difference of each row from double precision, over the row's peak, at every tenth column
/// and the last: exact weights by rings over zones a quarter as wide.
core::Result<std::vector<double>> rowErrors(const BakeOptions& options,
                                            const lighting::RsrmLayout& layout,
                                            const std::vector<double>& exponents,
                                            const core::Image& image) {
    core::Tally counted; // by the baking already
    const auto fine = loadBakeSource(
        options.source,
        [](lighting::LightKind kind) {
            lighting::Zones zones = lighting::zonesFor(kind);
            zones.count *= 4;
            return zones;
        },
        counted);
    if (!fine) {
        return fine.error();
    }
    const std::vector<double> edges = lighting::zoneEdges(fine->radiance.zones);
    const std::vector<double> angles = lighting::columnAngles(layout.columnMap, layout.columns);
    const int step = std::max(1, (layout.columns - 1) / 10);
    std::vector<double> errors;
    for (std::size_t row = 0; row < exponents.size(); ++row) {
        double worst = 0.0;
        double peak = 0.0;
        for (int column = 0; column < layout.columns;) {
            const std::vector<double> weights = lighting::ringWeights(
                angles[static_cast<std::size_t>(column)], edges, exponents[row]);
            glm::dvec3 sum(0.0);
            for (std::size_t j = 0; j < weights.size(); ++j) {
                sum += weights[j] * fine->radiance.means[j];
            }
            for (int c = 0; c < 3; ++c) {
                const double stored = image.at(column, static_cast<int>(row))[c];
                worst = std::max(worst, std::abs(stored - sum[c]));
                peak = std::max(peak, sum[c]);
            }
            column = column == layout.columns - 1 ? layout.columns
                                                  : std::min(column + step, layout.columns - 1);
        }
        errors.push_back(peak > 0.0 ? worst / peak : worst);
    }
    return errors;
}

nlohmann::ordered_json describe(const BakeOptions& options, const BakeSource& source,
                                const lighting::RsrmLayout& layout,
                                const std::vector<double>& exponents, const core::Image& image,
                                const core::Tally& warnings) {
    nlohmann::ordered_json json;
    json["source"] = source.what;
    json["kind"] = source.kind == lighting::LightKind::Sun ? "sun" : "sky";
    json["layout"] = options.layout;
    json["encoding"] = options.encoding;
    json["columns"] = layout.columns;
    json["rows"] = layout.rows;
    json["exponents"] = exponents;
    json["bytes"] = lighting::texelBytes(layout);
    for (int row = 0; row < image.height(); ++row) {
        const float* first = image.at(0, row);
        json["peaks"].push_back(*std::max_element(first, first + 3 * image.width()));
    }
    if (source.residual) {
        json["residual"] = *source.residual;
    }
    json["warnings"] = warnings.counts();
    return json;
}

/// Words that say how a map is filtered, where none is.
const char* kMapOptions[] = {"--light",   "--hour",     "--kind",   "--exponents",
                             "--columns", "--encoding", "--layout", "--errors"};

int runBakeLights(const BakeOptions& options, const CLI::App& command) {
    for (const char* option : kMapOptions) {
        if (command.count(option) > 0) {
            return fail(
                usage("is for maps; a document of lights takes --axis and --keep-sun", option));
        }
    }
    return bakeLights(
        {options.source.source, options.output, options.source.axis, options.keepSun});
}

/// The exponents that are asked for, else a document's rows of its own where `rsrm` is baked.
core::Result<std::vector<double>> rowsOf(const BakeOptions& options, const BakeSource& source,
                                         bool asked) {
    if (!asked && options.layout == "rsrm" && !source.exponents.empty()) {
        return source.exponents;
    }
    auto exponents = parseExponents(options.exponents, "--exponents");
    if (exponents && exponents->size() > kMaxRows) {
        return usage("a map has at most " + std::to_string(kMaxRows) + " rows", "--exponents");
    }
    return exponents;
}

int runBake(const BakeOptions& options, const CLI::App& command) {
    if (std::filesystem::path(options.output).extension() == ".json") {
        return runBakeLights(options, command);
    }
    if (std::filesystem::path(options.output).extension() != ".exr") {
        return fail(usage("a map is written as .exr and lights as .json, by the name's ending",
                          "--output"));
    }
    if (options.keepSun) {
        return fail(usage("is for lights, written as .json", "--keep-sun"));
    }
    auto layout = parseLayout(options);
    if (!layout) {
        return fail(layout.error());
    }
    core::Tally warnings;
    const auto source = loadBakeSource(
        options.source, [&](lighting::LightKind kind) { return lighting::zonesFor(*layout, kind); },
        warnings);
    if (!source) {
        return fail(source.error());
    }
    warn(warnings, options.source.source);
    const auto exponents = rowsOf(options, *source, command.count("--exponents") > 0);
    if (!exponents) {
        return fail(exponents.error());
    }
    layout->rows = static_cast<int>(exponents->size());
    const core::Image image = decoded(*layout, filtered(*source, *layout, *exponents));
    auto answer = describe(options, *source, *layout, *exponents, image, warnings);
    if (options.errors) {
        const auto errors = rowErrors(options, *layout, *exponents, image);
        if (!errors) {
            return fail(errors.error());
        }
        answer["errors"] = *errors;
    }
    const bool published = layout->columnMap == lighting::RsrmColumns::UniformHeight;
    const auto written = io::writeImage(options.output, image,
                                        {{"lodestar:layout", published ? "published" : "u2"}});
    if (!written) {
        return fail(written.error());
    }
    std::printf("%s\n", answer.dump(2).c_str());
    return 0;
}

} // namespace

void addBake(CLI::App& app, int& status) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* command = app.add_subcommand(
        "bake", "Filter a painted sky or sun for a list of exponents into an EXR: a row each, as "
                "decoded linear radiance; or make lights that can be painted of a photographed "
                "sky.\n\n"
                "Examples: the sun of a document at dusk; how symmetric a photographed sky is; its "
                "sky and sun\n"
                "  lodestar bake dusk.lodestar.json --light sun --hour 19.5 -o sun.exr\n"
                "  lodestar bake park.hdr --exponents 1,64,1024 -o park.exr\n"
                "  lodestar bake park.hdr -o park.lodestar.json\n"
                "answers JSON: rows, columns, bytes, peaks, warnings; \"residual\" of a panorama "
                "is the share of "
                "its light that is not symmetric about the axis.");
    BakeSourceOptions& source = options->source;
    command
        ->add_option("source", source.source,
                     "A lighting document (.json); a picture of one row or column, painted from "
                     "the axis (a sky's zenith) outwards at equal angles; or a panorama")
        ->required();
    command
        ->add_option(
            "-o,--output", options->output,
            "The map, .exr; or a panorama's lights, .json: a sky and, where one is found, its sun")
        ->required();
    command->add_option("--light", source.light,
                        "The document's light, by name or number (default: the first)");
    command->add_option("--hour", source.hour, "Hour of its day, [0, 24) (default 15)");
    command->add_option(
        "--kind", source.kind,
        "What a picture shows: sky (default) or sun, with zones fine about the axis");
    command->add_option("--axis", source.axis,
                        "X,Y,Z that a panorama's mean is taken about (default 0,1,0, the zenith)");
    command->add_option(
        "--exponents", options->exponents,
        "Phong exponents of the rows, 0 to 1e7 (default: the document's own rows, else "
        "1,2,4,...,2048)");
    command->add_option("--columns", options->columns,
                        "Columns, 2 to 1024 (default 170, published 256)");
    command->add_option("--encoding", options->encoding,
                        "What a texel is stored as before it is decoded: unorm8, rgb9e5, half or "
                        "float (default)");
    command->add_option(
        "--layout", options->layout,
        "rsrm (default): exact weights, columns even in u2; rsrm-published: Stone's "
        "weights and columns");
    command->add_flag("--errors", options->errors,
                      "Also answer each row's worst error over its peak, against sums in double "
                      "precision at a tenth of the columns (a second or two)");
    command->add_flag("--keep-sun", options->keepSun,
                      "With .json: leave a sun in the sky's mean instead of taking it out");
    command->callback([options, command, &status] { status = runBake(*options, *command); });
}

} // namespace lodestar::app
