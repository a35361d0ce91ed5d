// SPDX-License-Identifier: MIT
#include "io/environment_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "io/image_file.h"
#include "lighting/environment.h"
#include "lodestar/cube.glsl"
#include "lodestar/display.glsl"

namespace lodestar::io {
namespace {

constexpr std::array<const char*, 6> kFaceNames{"px", "nx", "py", "ny", "pz", "nz"};
constexpr const char* kBraces = "{px,nx,py,ny,pz,nz}";
constexpr int kMaxCubeWidth = 4096;

using Faces = std::array<core::Image, 6>;

struct LoadedPicture {
    core::Image image; ///< linear, 3 channels, repaired
    DeclaredLayout layout = DeclaredLayout::None;
};

core::Result<LoadedPicture> loadPicture(const std::filesystem::path& path, core::Tally& warnings) {
    core::Result<Bytes> bytes = readFile(path);
    if (!bytes) {
        return bytes.error();
    }
    core::Result<DecodedImage> decoded = decodeImage(*bytes, 3);
    if (!decoded) {
        return core::inFile(decoded.error(), path.string());
    }
    if (decoded->info.format == "png" || decoded->info.format == "jpeg") {
        for (float& value : decoded->image.pixels()) {
            value = shader::lodestar_linearFromSrgb(value);
        }
    }
    lighting::repairRadiance(decoded->image, warnings);
    return LoadedPicture{std::move(decoded->image), decoded->info.layout};
}

/// A square cut out of a picture with its upper left corner at (x, y), turned upside down if asked.
core::Image cut(const core::Image& image, int x, int y, int width, bool halfTurn = false) {
    core::Image face(width, width, 3);
    for (int row = 0; row < width; ++row) {
        for (int column = 0; column < width; ++column) {
            const float* from = halfTurn ? image.at(x + width - 1 - column, y + width - 1 - row)
                                         : image.at(x + column, y + row);
            std::copy_n(from, 3, face.at(column, row));
        }
    }
    return face;
}

/// The cells of an unfolded cube as cube.glsl draws it, in GL order. The vertical cross hangs -Z
/// below -Y, where it stands upside down.
Faces facesFromCross(const core::Image& image, bool vertical) {
    const int w = vertical ? image.width() / 3 : image.width() / 4;
    return {cut(image, 2 * w, w, w),
            cut(image, 0, w, w),
            cut(image, w, 0, w),
            cut(image, w, 2 * w, w),
            cut(image, w, w, w),
            vertical ? cut(image, w, 3 * w, w, true) : cut(image, 3 * w, w, w)};
}

Faces facesFromStrip(const core::Image& image) {
    const bool wide = image.width() > image.height();
    const int w = std::min(image.width(), image.height());
    Faces faces;
    for (int face = 0; face < 6; ++face) {
        faces[static_cast<std::size_t>(face)] =
            cut(image, wide ? face * w : 0, wide ? 0 : face * w, w);
    }
    return faces;
}

/// Where OpenEXR keeps the radiance along a direction: the pixel within a strip of six faces of
/// `width`, whose outermost texel centres lie on the cube's edges. OpenEXR's faces are seen so:
/// on +-X the in-face position is (y, z), on +-Y (x, z), on +-Z (x, y).
/// Source: OpenEXR, "Technical Introduction", environment maps.
struct StripPosition {
    int face = 0;
    double column = 0.0; ///< texels within the face, centres at whole numbers
    double row = 0.0;
};

StripPosition openExrPosition(const glm::dvec3& d, int width) {
    const glm::dvec3 a = glm::abs(d);
    const double end = width - 1;
    const auto texel = [&](double coordinate, double major) {
        return (coordinate / major + 1.0) * 0.5 * end;
    };
    if (a.x >= a.y && a.x >= a.z) {
        const double p = texel(d.y, a.x);
        const double q = texel(d.z, a.x);
        return d.x >= 0.0 ? StripPosition{0, q, end - p} : StripPosition{1, end - q, end - p};
    }
    if (a.y >= a.z) {
        const double p = texel(d.x, a.y);
        const double q = texel(d.z, a.y);
        return d.y >= 0.0 ? StripPosition{2, p, end - q} : StripPosition{3, p, q};
    }
    const double p = texel(d.x, a.z);
    const double q = texel(d.y, a.z);
    return d.z >= 0.0 ? StripPosition{4, end - p, end - q} : StripPosition{5, p, end - q};
}

/// Bilinear within one face; its texel centres reach the edges, so nothing lies beyond.
std::array<float, 3> readStrip(const core::Image& strip, const StripPosition& at, int width) {
    const int x0 = std::clamp(static_cast<int>(std::floor(at.column)), 0, width - 1);
    const int y0 = std::clamp(static_cast<int>(std::floor(at.row)), 0, width - 1);
    const int x1 = std::min(x0 + 1, width - 1);
    const int y1 = std::min(y0 + 1, width - 1);
    const double fx = std::clamp(at.column - x0, 0.0, 1.0);
    const double fy = std::clamp(at.row - y0, 0.0, 1.0);
    const int top = at.face * width;
    std::array<float, 3> result{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double upper =
            strip.at(x0, top + y0)[c] * (1.0 - fx) + strip.at(x1, top + y0)[c] * fx;
        const double lower =
            strip.at(x0, top + y1)[c] * (1.0 - fx) + strip.at(x1, top + y1)[c] * fx;
        result[c] = static_cast<float>(upper * (1.0 - fy) + lower * fy);
    }
    return result;
}

/// OpenEXR's cube, turned half about +Y: the centre of OpenEXR's lat-long is +Z, that of ours -Z.
Faces facesFromOpenExrCube(const core::Image& strip) {
    const int width = strip.width();
    Faces faces;
    for (int face = 0; face < 6; ++face) {
        core::Image image(width, width, 3);
        for (int y = 0; y < width; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto u = static_cast<float>((2.0 * x + 1.0) / width - 1.0);
                const auto v = static_cast<float>((2.0 * y + 1.0) / width - 1.0);
                const glm::dvec3 d(shader::lodestar_cubeDirection(face, u, v));
                const StripPosition at = openExrPosition({-d.x, d.y, -d.z}, width);
                const std::array<float, 3> texel = readStrip(strip, at, width);
                std::copy(texel.begin(), texel.end(), image.at(x, y));
            }
        }
        faces[static_cast<std::size_t>(face)] = std::move(image);
    }
    return faces;
}

/// STEM and EXT of a six-file name, where it is one.
struct SixFiles {
    std::string stem; ///< with the "_"
    std::string extension;
    [[nodiscard]] std::string face(std::size_t index) const {
        return stem + kFaceNames[index] + extension;
    }
};

std::optional<SixFiles> sixFiles(const std::string& environment) {
    const std::size_t braces = environment.find(kBraces);
    if (braces != std::string::npos) {
        return SixFiles{environment.substr(0, braces),
                        environment.substr(braces + std::char_traits<char>::length(kBraces))};
    }
    const std::filesystem::path path(environment);
    const std::string extension = path.extension().string();
    const std::string stem = environment.substr(0, environment.size() - extension.size());
    if (stem.ends_with("_") && path.has_stem()) {
        return SixFiles{stem, extension};
    }
    if (stem.ends_with("_px")) {
        SixFiles files{stem.substr(0, stem.size() - 2), extension};
        std::error_code code;
        if (std::filesystem::exists(files.face(1), code)) {
            return files;
        }
    }
    return std::nullopt;
}

core::Result<Faces> loadSixFiles(const SixFiles& files, core::Tally& warnings) {
    Faces faces;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        core::Result<LoadedPicture> picture = loadPicture(files.face(i), warnings);
        if (!picture) {
            return picture.error();
        }
        const core::Image& image = picture->image;
        if (image.width() != image.height() ||
            image.width() != (i == 0 ? image : faces[0]).width()) {
            return core::inFile(core::refused("face of " + std::to_string(image.width()) + " x " +
                                              std::to_string(image.height()) +
                                              " pixels; the six faces are square and of one size"),
                                files.face(i));
        }
        faces[i] = std::move(picture->image);
    }
    return faces;
}

core::Result<LoadedEnvironment> fromPicture(const LoadedPicture& picture, int width) {
    const core::Image& image = picture.image;
    const std::int64_t w = image.width();
    const std::int64_t h = image.height();
    LoadedEnvironment result;
    if (picture.layout == DeclaredLayout::Cube && h == 6 * w) {
        result.layout = EnvironmentLayout::Strip;
        result.base = lighting::cubeFromFaces(facesFromOpenExrCube(image), width);
    } else if (w == 2 * h) {
        result.layout = EnvironmentLayout::LatLong;
        result.base = lighting::cubeFromLatLong(image, width);
    } else if ((4 * w == 3 * h && w % 3 == 0) || (3 * w == 4 * h && w % 4 == 0)) {
        result.layout = EnvironmentLayout::Cross;
        result.base = lighting::cubeFromFaces(facesFromCross(image, w < h), width);
    } else if (w == 6 * h || h == 6 * w) {
        result.layout = EnvironmentLayout::Strip;
        result.base = lighting::cubeFromFaces(facesFromStrip(image), width);
    } else {
        return core::refused("is " + std::to_string(w) + " x " + std::to_string(h) +
                             " pixels, which is no environment; a panorama is 2:1, a cross 3:4 or "
                             "4:3, a strip of faces 6:1 or 1:6");
    }
    return result;
}

core::Result<LoadedEnvironment> loadAnalytic(const std::string& environment, int width) {
    core::Result<lighting::AnalyticEnvironment> analytic = lighting::parseAnalytic(environment);
    if (!analytic) {
        return analytic.error();
    }
    LoadedEnvironment result;
    result.base = lighting::cubeFromAnalytic(*analytic, width);
    result.layout = EnvironmentLayout::Analytic;
    return result;
}

} // namespace

core::Result<core::Image> loadRadiance(const std::filesystem::path& path, core::Tally& warnings) {
    auto picture = loadPicture(path, warnings);
    if (!picture) {
        return picture.error();
    }
    return std::move(picture->image);
}

core::Result<LoadedEnvironment> loadEnvironment(const std::string& environment, int width) {
    LODESTAR_EXPECT(width >= 1 && width <= kMaxCubeWidth, "a cube's width is 1 to 4096 texels");
    if (lighting::isAnalytic(environment)) {
        return loadAnalytic(environment, width);
    }
    core::Tally warnings;
    if (const std::optional<SixFiles> files = sixFiles(environment)) {
        core::Result<Faces> faces = loadSixFiles(*files, warnings);
        if (!faces) {
            return faces.error();
        }
        LoadedEnvironment result;
        result.base = lighting::cubeFromFaces(*faces, width);
        result.layout = EnvironmentLayout::SixFiles;
        result.warnings = std::move(warnings);
        return result;
    }
    core::Result<LoadedPicture> picture = loadPicture(environment, warnings);
    if (!picture) {
        return picture.error();
    }
    core::Result<LoadedEnvironment> result = fromPicture(*picture, width);
    if (!result) {
        return core::inFile(result.error(), environment);
    }
    result->warnings.merge(warnings);
    return result;
}

} // namespace lodestar::io
