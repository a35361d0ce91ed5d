// SPDX-License-Identifier: MIT
//
// Environments: where distant light comes from, as a cube map made ready for the estimators.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "core/image.h"
#include "core/result.h"
#include "core/tally.h"
#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// `constant:R,G,B`
struct ConstantEnvironment {
    glm::dvec3 radiance{1.0};
};
/// `gradient:DOWN,UP`: linear in y from -1 to +1.
struct GradientEnvironment {
    glm::dvec3 down{0.0};
    glm::dvec3 up{1.0};
};
/// `disc:X,Y,Z,DEGREES,INSIDE[,OUTSIDE]`: a round lamp of an angular radius about an axis.
struct DiscEnvironment {
    glm::dvec3 axis{0.0, 1.0, 0.0}; ///< unit, towards the lamp
    double angularRadius = 0.1;     ///< radians, (0, pi]
    glm::dvec3 inside{1.0};
    glm::dvec3 outside{0.0};
};
/// `faces:C;C;C;C;C;C`: one colour a face, GL order.
struct FacesEnvironment {
    std::array<glm::dvec3, 6> radiance{};
};
/// The clear sky with a sun that lights a scene when nothing else is given; 15:00, no file.
struct ClearSkyEnvironment {};

using AnalyticEnvironment = std::variant<ConstantEnvironment, GradientEnvironment, DiscEnvironment,
                                         FacesEnvironment, ClearSkyEnvironment>;

/// Whether an ENV text is analytic (starts with a known word and a colon), not a file.
[[nodiscard]] bool isAnalytic(std::string_view text);

/// Parses an analytic ENV. A radiance is R,G,B for `constant`, and one number or R/G/B elsewhere.
/// @errors Usage for a word that is not a number or is missing, and a radiance outside [0, 1e9]
[[nodiscard]] core::Result<AnalyticEnvironment> parseAnalytic(std::string_view text);

/// Radiance along a unit direction.
[[nodiscard]] glm::dvec3 radiance(const AnalyticEnvironment& environment,
                                  const glm::dvec3& direction);

/// Texel means of an analytic environment (solid-angle weighted supersampling, refined where the
/// map has an edge), level 0 only. @pre width in [1, 4096]
[[nodiscard]] Cubemap cubeFromAnalytic(const AnalyticEnvironment& environment, int width);

/// A lat-long panorama resampled to a cube, level 0 only. Centre column -Z, rightwards to +X, top
/// +Y. Every texel is the solid-angle weighted mean of at least 4x4 bilinear lookups, more where
/// the panorama is finer than the cube.
/// @param panorama linear radiance, 3 channels, repaired  @pre width in [1, 4096]
[[nodiscard]] Cubemap cubeFromLatLong(const core::Image& panorama, int width);

/// Six square faces in GL order, resampled to the width where theirs differs.
/// @pre six images of one size, square, 3 channels
[[nodiscard]] Cubemap cubeFromFaces(const std::array<core::Image, 6>& faces, int width);

/// A cube's level 0 turned. @param worldFromEnvironment unit
[[nodiscard]] Cubemap turned(const Cubemap& cube, const glm::quat& worldFromEnvironment);

/// A rotation about +Y, counter-clockwise seen from above. @param angle radians
[[nodiscard]] glm::quat aboutUp(double angle);

/// A cube's level 0 as a document places it: turned, its radiance x 2^ev, at most 1e9.
/// @param worldFromEnvironment unit  @param ev [-64, 64]
[[nodiscard]] Cubemap placed(Cubemap cube, const glm::quat& worldFromEnvironment, double ev);

/// Repairs radiance in place to [0, 1e9]: NaN and negative values become 0, +infinity and larger
/// values 1e9; each is counted.
void repairRadiance(core::Image& image, core::Tally& warnings);

/// Which products of an environment the estimators ask for.
struct PreparedParts {
    bool boxMips = false;
    bool tentMips = false;
    bool sh9 = false;
    bool irradiance = false;
    bool prefilteredMips = false;
    bool operator==(const PreparedParts&) const = default;
};

/// Nine coefficients of irradiance over pi, as shaders/lodestar/sh9.glsl reads them.
using Sh9Coefficients = std::array<glm::vec3, 9>;

/// Irradiance over pi by order-2 spherical harmonics, from texel values and exact solid angles.
[[nodiscard]] Sh9Coefficients sh9FromCube(const Cubemap& base);

inline constexpr int kIrradianceWidth = 16;
/// The irradiance cube (over pi: a constant map of 1 gives 1), level 0 only. Every texel is
/// the cosine lobe summed over the map in 32x32 blocks a face, each acting along its own light's
/// mean direction: 2e-4 RMS of the sum over all texels on panoramas, 1e-6 on a constant.
/// @param side texels of a face, even
[[nodiscard]] Cubemap irradianceCube(const Cubemap& base, int side = kIrradianceWidth);

/// An environment made ready. Only the parts asked for are filled.
struct PreparedEnvironment {
    Cubemap base;       ///< level 0
    Cubemap boxMips;    ///< full chain
    Cubemap tentMips;   ///< full chain
    Cubemap irradiance; ///< over pi
    Sh9Coefficients sh9{};
    Cubemap prefilteredMips; ///< full chain
};

[[nodiscard]] PreparedEnvironment prepare(Cubemap base, const PreparedParts& parts);

} // namespace lodestar::lighting
