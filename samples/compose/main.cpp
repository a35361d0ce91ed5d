// SPDX-License-Identifier: MIT
//
// lodestar-compose: joins PNGs into a labelled contact sheet.
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "io/file.h"
#include "io/image_file.h"
#include "lodestar/display.glsl"
#include "sheet.h"

namespace lodestar::samples {
namespace {

constexpr std::string_view kUsage =
    "usage: lodestar-compose -o OUT.png [--title T] [--note N] [--columns A|B|..] [--width N]\n"
    "                        --row LABEL FILE[::CAPTION] [--inset FILE].. ... [--row LABEL "
    "FILE..]...\n"
    "Joins pictures into a labelled contact sheet; a LABEL may be empty. An inset lies in the "
    "lower\n"
    "left of the picture before it. An EXR is shown as `lodestar render` would show it.\n"
    "Example: lodestar-compose -o sheet.png --title Figure --row \"\" a.png::before b.png::after\n";

core::Error usage(const std::string& what) {
    return {core::ErrorCode::Usage, what, {}, {}};
}

struct Call {
    Sheet sheet;
    std::string output;
};

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char character : text) {
        if (character == separator) {
            parts.emplace_back();
        } else {
            parts.back() += character;
        }
    }
    return parts;
}

core::Result<core::Image> loadPicture(const std::string& path) {
    const core::Result<io::Bytes> bytes = io::readFile(path);
    if (!bytes) {
        return core::inFile(bytes.error(), path);
    }
    core::Result<io::DecodedImage> decoded = io::decodeImage(*bytes, 4);
    if (!decoded) {
        return core::inFile(decoded.error(), path);
    }
    if (decoded->info.format == "openexr") {
        std::vector<float>& values = decoded->image.pixels();
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = i % 4 == 3
                            ? values[i]
                            : shader::lodestar_srgbFromLinear(shader::lodestar_filmic(values[i]));
        }
    }
    return std::move(decoded->image);
}

core::Result<Cell> loadCell(const std::string& argument) {
    const std::size_t mark = argument.find("::");
    auto image = loadPicture(argument.substr(0, mark));
    if (!image) {
        return image.error();
    }
    return Cell{std::move(*image),
                mark == std::string::npos ? std::string() : argument.substr(mark + 2),
                {}};
}

core::Result<void> takeOption(Call& call, const std::string& name, const std::string& value) {
    if (name == "-o") {
        call.output = value;
    } else if (name == "--title") {
        call.sheet.title = value;
    } else if (name == "--note") {
        call.sheet.note = value;
    } else if (name == "--columns") {
        call.sheet.columns = split(value, '|');
    } else if (name == "--row") {
        call.sheet.rows.push_back({value, {}});
    } else if (name == "--inset") {
        if (call.sheet.rows.empty() || call.sheet.rows.back().cells.empty()) {
            return usage("an --inset follows a picture");
        }
        auto inset = loadPicture(value);
        if (!inset) {
            return inset.error();
        }
        call.sheet.rows.back().cells.back().insets.push_back(std::move(*inset));
    } else if (name == "--width") {
        const bool digits = value.find_first_not_of("0123456789") == std::string::npos;
        call.sheet.width = digits && !value.empty() && value.size() < 6 ? std::stoi(value) : 0;
        if (call.sheet.width < 200 || call.sheet.width > io::kMaxImageSide) {
            return usage("--width must be a whole number from 200 to 16384");
        }
    } else {
        return usage("unknown option '" + name + "'");
    }
    return {};
}

core::Result<Call> parse(const std::vector<std::string>& arguments) {
    Call call;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if (argument.starts_with("-")) {
            if (i + 1 == arguments.size()) {
                return usage(argument + " needs a value");
            }
            if (core::Result<void> taken = takeOption(call, argument, arguments[++i]); !taken) {
                return taken.error();
            }
            continue;
        }
        if (call.sheet.rows.empty()) {
            return usage("pictures must follow a --row");
        }
        core::Result<Cell> cell = loadCell(argument);
        if (!cell) {
            return cell.error();
        }
        call.sheet.rows.back().cells.push_back(std::move(*cell));
    }
    for (const SheetRow& row : call.sheet.rows) {
        if (row.cells.empty()) {
            return usage("a --row has no pictures");
        }
    }
    if (call.output.empty() || call.sheet.rows.empty()) {
        return usage("needs -o OUT.png and a --row");
    }
    return call;
}

core::Result<void> run(const std::vector<std::string>& arguments) {
    const core::Result<Call> call = parse(arguments);
    if (!call) {
        return call.error();
    }
    return io::writeImage(call->output, drawSheet(call->sheet));
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.size() == 1 && arguments[0] == "--help") {
        std::fputs(lodestar::samples::kUsage.data(), stdout);
        return 0;
    }
    const lodestar::core::Result<void> done = lodestar::samples::run(arguments);
    if (!done) {
        std::fprintf(stderr, "lodestar: %s\n", done.error().message().c_str());
        return static_cast<int>(done.error().code);
    }
    return 0;
}
