// SPDX-License-Identifier: MIT
#include "numerics/ladder_environments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "io/file.h"
#include "io/image_file.h"
#include "lodestar/cube.glsl"

namespace lodestar::testing {

namespace {

using glm::dvec3;

dvec3 gradientRadiance(const dvec3& d) {
    return (0.5 + 0.5 * glm::dot(d, dvec3(0.36, 0.48, 0.8))) * dvec3(1.0, 0.9, 0.7);
}

dvec3 checkerRadiance(const dvec3& d) {
    const dvec3 a = glm::abs(d);
    const dvec3 cell = glm::floor((d / std::max({a.x, a.y, a.z}) + 1.0) * 2.0);
    return dvec3(static_cast<int>(cell.x + cell.y + cell.z) % 2 == 0 ? 1.0 : 0.05);
}

int faceOf(const dvec3& d) {
    return shader::lodestar_cubeFace(shader::vec3(d));
}

dvec3 sixFaceRadiance(const dvec3& d) {
    static const std::array<dvec3, 6> colours{{{0.63, 0.065, 0.05},
                                               {0.14, 0.45, 0.09},
                                               {1.6, 1.55, 1.4},
                                               {0.3, 0.29, 0.25},
                                               {0.7, 0.68, 0.6},
                                               {0.02, 0.02, 0.02}}};
    return colours[static_cast<std::size_t>(faceOf(d))];
}

dvec3 faceContrastRadiance(const dvec3& d) {
    const int axis = faceOf(d) / 2;
    return dvec3(axis == 0 ? 1.0 : axis == 1 ? 0.3 : 0.0);
}

/// Bilinear lookup in a lat-long panorama, centre column -Z, rightwards to +X, top +Y.
class Panorama {
public:
    explicit Panorama(const std::filesystem::path& path) {
        const auto bytes = io::readFile(path);
        const auto decoded =
            bytes ? io::decodeImage(*bytes, 3) : core::Result<io::DecodedImage>(bytes.error());
        if (!decoded) {
            throw std::runtime_error(decoded.error().message());
        }
        width_ = decoded->image.width();
        height_ = decoded->image.height();
        const std::vector<float>& stored = decoded->image.pixels();
        for (std::size_t i = 0; i < stored.size(); i += 3) {
            pixels_.push_back(glm::max(dvec3(stored[i], stored[i + 1], stored[i + 2]), dvec3(0.0)));
        }
    }

    [[nodiscard]] dvec3 radiance(const dvec3& d) const {
        const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi * height_ - 0.5;
        const double x = (std::atan2(d.x, -d.z) / (2.0 * std::numbers::pi) + 0.5) * width_ - 0.5;
        const double x0 = std::floor(x);
        const double y0 = std::floor(y);
        const int column = static_cast<int>(x0);
        const int row = static_cast<int>(y0);
        return glm::mix(glm::mix(at(column, row), at(column + 1, row), x - x0),
                        glm::mix(at(column, row + 1), at(column + 1, row + 1), x - x0), y - y0);
    }

private:
    [[nodiscard]] const dvec3& at(int x, int y) const {
        const int column = (x + width_) % width_;
        const int row = std::clamp(y, 0, height_ - 1);
        return pixels_[static_cast<std::size_t>(row * width_ + column)];
    }
    int width_ = 0;
    int height_ = 0;
    std::vector<dvec3> pixels_;
};

} // namespace

lighting::Cubemap bakeCube(const std::function<dvec3(const dvec3&)>& radiance, int width,
                           int subsamples) {
    lighting::Cubemap cube(width);
    const double pitch = 2.0 / (width * subsamples);
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < width; ++y) {
            for (int x = 0; x < width; ++x) {
                dvec3 sum(0.0);
                double weights = 0.0;
                for (int i = 0; i < subsamples * subsamples; ++i) {
                    const double u = (x * subsamples + i % subsamples + 0.5) * pitch - 1.0;
                    const double v = (y * subsamples + i / subsamples + 0.5) * pitch - 1.0;
                    const double norm = std::sqrt(u * u + v * v + 1.0);
                    const std::array<dvec3, 6> d{{{1.0, -v, -u},
                                                  {-1.0, -v, u},
                                                  {u, 1.0, v},
                                                  {u, -1.0, -v},
                                                  {u, -v, 1.0},
                                                  {-u, -v, -1.0}}};
                    const double weight = 1.0 / (norm * norm * norm);
                    sum += weight * radiance(d[static_cast<std::size_t>(face)] / norm);
                    weights += weight;
                }
                cube.texel(face, x, y) = glm::vec4(glm::vec3(sum / weights), 1.0f);
            }
        }
    }
    return cube;
}

lighting::Cubemap lampCube(const dvec3& axis, double degrees, int width) {
    const double edge = std::cos(degrees * std::numbers::pi / 180.0);
    const auto lamp = [&](const dvec3& d) {
        return (glm::dot(d, axis) > edge ? 100.0 : 0.05) * dvec3(1.0, 0.95, 0.85);
    };
    return bakeCube(lamp, width, 8);
}

std::vector<NamedCube> analyticSet(int width) {
    return {{"gradient", bakeCube(gradientRadiance, width, 4)},
            {"disc5", lampCube(kCornerAxis, 5.0, width)},
            {"disc5c", lampCube(kCentreAxis, 5.0, width)},
            {"checker", bakeCube(checkerRadiance, width, 4)},
            {"sixface", bakeCube(sixFaceRadiance, width, 1)},
            {"facechk", bakeCube(faceContrastRadiance, width, 1)}};
}

std::filesystem::path panoramaPath(const std::string& name) {
    return std::filesystem::path("/usr/share/blender/datafiles/studiolights/world") /
           (name + ".exr");
}

std::vector<NamedCube> panoramaSet(const std::vector<std::string>& names, int width) {
    std::vector<NamedCube> cubes;
    for (const std::string& name : names) {
        const Panorama panorama(panoramaPath(name));
        cubes.push_back(
            {name, bakeCube([&](const dvec3& d) { return panorama.radiance(d); }, width, 4)});
    }
    return cubes;
}

} // namespace lodestar::testing
