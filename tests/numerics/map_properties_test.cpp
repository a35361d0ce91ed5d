// SPDX-License-Identifier: MIT
//
// What holds of maps made from pictures, of their placing, and of light probes' volumes, for every
// valid input, or for any bits where none is refused. u below is 2^-23.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "lighting/environment.h"
#include "lighting/probe.h"
#include "lighting/zonal_picture.h"
#include "numerics/property_inputs.h"

namespace lodestar::testing {

namespace {

using lighting::Cubemap;

constexpr float u = 0x1p-23f;

core::Image picture(int width, int height) {
    core::Image image(width, height, 3);
    for (float& value : image.pixels()) {
        value = *radiance();
    }
    return image;
}

core::Image quarter(core::Image image) {
    for (float& value : image.pixels()) {
        value *= 0.25f;
    }
    return image;
}

/// Least and greatest radiance of a channel.
std::pair<float, float> rangeOf(const core::Image& image, std::size_t channel) {
    std::pair<float, float> range(INFINITY, 0.0f);
    for (std::size_t i = channel; i < image.pixels().size(); i += 3) {
        range.first = std::min(range.first, image.pixels()[i]);
        range.second = std::max(range.second, image.pixels()[i]);
    }
    return range;
}

bool within(const Cubemap& cube, std::size_t channel, float low, float high, float share) {
    return std::all_of(cube.level(0).begin(), cube.level(0).end(), [&](const glm::vec4& texel) {
        const float value = texel[static_cast<int>(channel)];
        return value >= low * (1.0f - share) && value <= high * (1.0f + share);
    });
}

bool isQuarter(const Cubemap& a, const Cubemap& b) {
    for (std::size_t i = 0; i < a.level(0).size(); ++i) {
        if (glm::vec3(b.level(0)[i]) != 0.25f * glm::vec3(a.level(0)[i])) {
            return false;
        }
    }
    return true;
}

} // namespace

// Bilinear reads of three roundings a mix, summed in double or over at most 16 x 16: 260 roundings.
RC_GTEST_PROP(Pictures, APanoramasCubeLiesWithinItAndIsLinear, ()) {
    const core::Image panorama = picture(*rc::gen::inRange(1, 12), *rc::gen::inRange(1, 8));
    const int width = *rc::gen::inRange(1, 7);
    const Cubemap cube = lighting::cubeFromLatLong(panorama, width);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto [low, high] = rangeOf(panorama, channel);
        RC_ASSERT(within(cube, channel, low, high, 140.0f * u));
    }
    RC_ASSERT(isQuarter(cube, lighting::cubeFromLatLong(quarter(panorama), width)));
}

// Means in double, or of four reads.
RC_GTEST_PROP(Pictures, SixFacesCubeLiesWithinThemAndIsLinear, ()) {
    const int size = *rc::gen::inRange(1, 7);
    const int width = *rc::gen::inRange(1, 9);
    std::array<core::Image, 6> faces, quarters;
    std::pair<float, float> range(INFINITY, 0.0f);
    for (std::size_t face = 0; face < 6; ++face) {
        faces[face] = picture(size, size);
        quarters[face] = quarter(faces[face]);
        const auto [low, high] = rangeOf(faces[face], 1);
        range = {std::min(range.first, low), std::max(range.second, high)};
    }
    const Cubemap cube = lighting::cubeFromFaces(faces, width);
    RC_ASSERT(within(cube, 1, range.first, range.second, 12.0f * u));
    RC_ASSERT(isQuarter(cube, lighting::cubeFromFaces(quarters, width)));
}

// Sixteen reads a texel.
RC_GTEST_PROP(Pictures, APlacedMapIsRadianceWhateverItsExposure, ()) {
    std::array<core::Image, 6> faces;
    std::pair<float, float> range(INFINITY, 0.0f);
    for (core::Image& face : faces) {
        face = picture(3, 3);
        const auto [low, high] = rangeOf(face, 0);
        range = {std::min(range.first, low), std::max(range.second, high)};
    }
    const Cubemap cube = lighting::cubeFromFaces(faces, 3);
    const glm::quat turn =
        glm::angleAxis(*uniform(-7.0f, 7.0f), *direction()) * lighting::aboutUp(1.0);
    RC_ASSERT(within(lighting::turned(cube, turn), 0, range.first, range.second, 24.0f * u));
    const double ev = static_cast<double>(*uniform(-64.0f, 64.0f));
    RC_ASSERT(within(lighting::placed(cube, turn, ev), 0, 0.0f, 1e9f, 0.0f));
}

// Means of means, in double; how uneven a zone is is a share.
RC_GTEST_PROP(Pictures, APanoramasZonesLieWithinIt, ()) {
    const core::Image panorama = picture(*rc::gen::inRange(1, 12), *rc::gen::inRange(1, 8));
    const lighting::Zones zones{*rc::gen::element(lighting::ZoneSpacing::EqualHeight,
                                                  lighting::ZoneSpacing::EqualAngle,
                                                  lighting::ZoneSpacing::Quartic),
                                *rc::gen::inRange(1, 20)};
    const auto result =
        lighting::zonalFromPanorama(panorama, glm::normalize(glm::dvec3(*direction())), zones);
    const auto [low, high] = rangeOf(panorama, 2);
    for (const glm::dvec3& mean : result.radiance.means) {
        RC_ASSERT(mean.b >= static_cast<double>(low) * (1.0 - 1e-9));
        RC_ASSERT(mean.b <= static_cast<double>(high) * (1.0 + 1e-9));
    }
    RC_ASSERT(result.residual >= 0.0 && result.residual <= 1.0);
}

// A volume of any bits is none, or a finite one; it holds any box by a share.
RC_GTEST_PROP(Volumes, AnyBitsAreNoneOrAVolume, ()) {
    const auto any = [] {
        return *rc::gen::oneOf(uniform(-20.0f, 20.0f), uniform(0.0f, 3.0f), anyFloat());
    };
    const auto usual = [] {
        return *rc::gen::oneOf(uniform(0.1f, 9.0f), logarithmic(1e-9f, 1e9f));
    };
    const bool valid = *rc::gen::inRange(0, 4) > 0;
    const auto number = [&] { return valid ? usual() : any(); };
    lighting::ProbeVolume volume;
    volume.shape = *rc::gen::element(lighting::VolumeShape::Box, lighting::VolumeShape::Sphere);
    volume.center = {number(), number(), number()};
    volume.size = {number(), number(), number()};
    for (double& blend : volume.blend) {
        blend = static_cast<double>(number());
    }
    glm::mat4 worldFromNode(1.0f);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) {
            worldFromNode[column][row] =
                *rc::gen::inRange(0, 3) == 0 ? number() : worldFromNode[column][row];
        }
    }
    const auto placed = lighting::place(volume, worldFromNode, *rc::gen::arbitrary<bool>());
    if (!placed) {
        return;
    }
    for (const glm::vec4& row : placed->rows) {
        RC_ASSERT(std::isfinite(row.x) && std::isfinite(row.y) && std::isfinite(row.z) &&
                  std::isfinite(row.w));
    }
    RC_ASSERT(std::isfinite(placed->measure) && placed->measure > 0.0);
    const glm::vec3 low(any(), any(), any());
    const glm::vec3 high(low + glm::vec3(*uniform(0.0f, 5.0f)));
    const float mean = lighting::meanWeight(*placed, low, high);
    RC_ASSERT(mean >= 0.0f && mean <= 1.0f + 12.0f * u);
}

} // namespace lodestar::testing
