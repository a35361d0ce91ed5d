// SPDX-License-Identifier: MIT
#include "lighting/photographed_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/contract.h"
#include "lighting/gradient_simplify.h"
#include "lighting/zonal.h"
#include "lighting/zonal_picture.h"

namespace lodestar::lighting {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

/// How far from its middle a sun's light may reach, and where its surroundings are looked at.
constexpr double kWidestSun = 12.0 * kDegree;
constexpr double kSurroundings = 20.0 * kDegree;
constexpr double kDarkened = 2.0;       ///< times the surroundings: there a sun ends
constexpr double kLeastContrast = 10.0; ///< over the surroundings
constexpr double kLeastShare = 0.02;    ///< of all light
constexpr std::size_t kSunStops = 12;   ///< at most, one for a ring
constexpr std::size_t kSkyStops = 16;
constexpr int kSkyZones = 128;

/// The texels of a lat-long panorama.
class Texels {
public:
    explicit Texels(const core::Image& image) : image_(image) {}

    [[nodiscard]] glm::dvec3 direction(int x, int y) const {
        return latLongDirection(x + 0.5, y + 0.5, image_);
    }
    [[nodiscard]] double solidAngle(int y) const {
        return 4.0 * kPi / image_.width() *
               ringArea(y * kPi / image_.height(), (y + 1) * kPi / image_.height());
    }
    [[nodiscard]] glm::dvec3 radiance(int x, int y) const {
        const float* texel = image_.at(x, y);
        return {texel[0], texel[1], texel[2]};
    }

    /// Calls visit(x, y, direction) for texels whose centre lies within an angle of an axis.
    template <class Visit>
    void within(const glm::dvec3& axis, double angle, Visit&& visit) const {
        const double colatitude = std::acos(std::clamp(axis.y, -1.0, 1.0));
        const auto row = [&](double theta) {
            return std::clamp(static_cast<int>(theta / kPi * image_.height()), 0,
                              image_.height() - 1);
        };
        for (int y = row(colatitude - angle); y <= row(colatitude + angle); ++y) {
            for (int x = 0; x < image_.width(); ++x) {
                const glm::dvec3 d = direction(x, y);
                if (glm::dot(d, axis) > std::cos(angle)) {
                    visit(x, y, d);
                }
            }
        }
    }

private:
    const core::Image& image_;
};

/// Where the brightest texel is, then the middle of what is a tenth as bright within 3 degrees.
glm::dvec3 brightestPlace(const core::Image& panorama) {
    const Texels texels(panorama);
    double greatest = -1.0;
    glm::dvec3 place(0.0, 1.0, 0.0);
    for (int y = 0; y < panorama.height(); ++y) {
        for (int x = 0; x < panorama.width(); ++x) {
            if (const double l = luminance(texels.radiance(x, y)); l > greatest) {
                greatest = l;
                place = texels.direction(x, y);
            }
        }
    }
    glm::dvec3 sum(0.0);
    texels.within(place, 3.0 * kDegree, [&](int x, int y, const glm::dvec3& d) {
        const double l = luminance(texels.radiance(x, y));
        sum += l >= 0.1 * greatest ? l * texels.solidAngle(y) * d : glm::dvec3(0.0);
    });
    return glm::length(sum) > 0.0 ? glm::normalize(sum) : place;
}

/// Mean radiance in rings about an axis; those without a texel hold what the one before does.
struct Rings {
    double width; ///< radians
    std::vector<glm::dvec3> means;
};

Rings ringsAbout(const core::Image& panorama, const glm::dvec3& axis, double reach) {
    const Texels texels(panorama);
    Rings rings{std::max(0.25 * kDegree, kPi / panorama.height()), {}};
    const auto count = static_cast<std::size_t>(std::ceil(reach / rings.width));
    rings.means.resize(count);
    std::vector<double> weights(count);
    texels.within(axis, reach, [&](int x, int y, const glm::dvec3& d) {
        const double angle = std::acos(std::clamp(glm::dot(d, axis), -1.0, 1.0));
        const auto i = std::min(static_cast<std::size_t>(angle / rings.width), count - 1);
        rings.means[i] += texels.solidAngle(y) * texels.radiance(x, y);
        weights[i] += texels.solidAngle(y);
    });
    for (std::size_t i = 0; i < count; ++i) {
        rings.means[i] = weights[i] > 0.0 ? rings.means[i] / weights[i]
                                          : (i > 0 ? rings.means[i - 1] : glm::dvec3(0.0));
    }
    return rings;
}

/// The radius within which a sun's light lies; 0 where the brightest place is none.
double sunReach(const Rings& rings) {
    const auto at = [&](double angle) {
        return std::min(static_cast<std::size_t>(angle / rings.width), rings.means.size());
    };
    double around = 0.0;
    double area = 0.0;
    for (std::size_t i = at(kWidestSun); i < rings.means.size(); ++i) {
        const double ring = ringArea(static_cast<double>(i) * rings.width,
                                     static_cast<double>(i + 1) * rings.width);
        around += ring * luminance(rings.means[i]);
        area += ring;
    }
    around /= area;
    if (luminance(rings.means[0]) < kLeastContrast * around) {
        return 0.0;
    }
    for (std::size_t i = 1; i < at(kWidestSun); ++i) {
        if (luminance(rings.means[i]) <= kDarkened * around) {
            return static_cast<double>(i) * rings.width;
        }
    }
    return 0.0;
}

/// The gradient of what is taken, as means in rings, its energy scaled to be what was taken.
Gradient sunGradient(const std::vector<glm::dvec3>& means, double width,
                     const glm::dvec3& irradiance) {
    Gradient gradient;
    gradient.stops.push_back({0.0, means[0], 0.0});
    for (std::size_t i = 1; i < means.size(); ++i) {
        gradient.stops.push_back({(static_cast<double>(i) + 0.5) * width / kDegree, means[i], 0.0});
    }
    gradient.stops.push_back(
        {(static_cast<double>(means.size()) + 0.5) * width / kDegree, glm::dvec3(0.0), 0.0});
    const glm::dvec3 has = facingIrradiance(zonalRadiance(RadianceProfile(gradient, LightKind::Sun),
                                                          {ZoneSpacing::Quartic, 1024})) *
                           kPi;
    for (GradientStop& stop : gradient.stops) {
        for (int c = 0; c < 3; ++c) {
            stop.color[c] =
                has[c] > 0.0 ? std::min(stop.color[c] * irradiance[c] / has[c], kMaxRadiance) : 0.0;
        }
    }
    return gradient;
}

/// Takes a sun's light out of the picture.
std::optional<PhotographedSun> takeSun(core::Image& rest, const glm::dvec3& mean) {
    PhotographedSun sun;
    sun.axis = brightestPlace(rest);
    const Rings rings = ringsAbout(rest, sun.axis, kSurroundings);
    sun.radius = sunReach(rings);
    if (sun.radius <= 0.0) {
        return std::nullopt;
    }
    const auto last = static_cast<std::size_t>(std::round(sun.radius / rings.width));
    const glm::dvec3 about =
        0.5 * (rings.means[last] + rings.means[std::min(last + 1, rings.means.size() - 1)]);
    const double step = std::max(rings.width, sun.radius / static_cast<double>(kSunStops));
    std::vector<glm::dvec3> taken(static_cast<std::size_t>(std::ceil(sun.radius / step - 1e-9)));
    std::vector<double> weights(taken.size());
    core::Image left = rest;
    const Texels texels(rest);
    double light = 0.0;
    texels.within(sun.axis, sun.radius, [&](int x, int y, const glm::dvec3& d) {
        const double omega = texels.solidAngle(y);
        const double angle = std::acos(std::clamp(glm::dot(d, sun.axis), -1.0, 1.0));
        const auto ring = std::min(static_cast<std::size_t>(angle / step), taken.size() - 1);
        const glm::dvec3 excess = glm::max(texels.radiance(x, y) - about, glm::dvec3(0.0));
        for (int c = 0; c < 3; ++c) {
            left.at(x, y)[c] -= static_cast<float>(excess[c]);
        }
        taken[ring] += omega * excess;
        weights[ring] += omega;
        sun.irradiance += omega * glm::dot(d, sun.axis) * excess;
        light += omega * luminance(excess);
    });
    if (light < kLeastShare * 4.0 * kPi * luminance(mean)) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < taken.size(); ++i) {
        taken[i] =
            weights[i] > 0.0 ? taken[i] / weights[i] : (i > 0 ? taken[i - 1] : glm::dvec3(0.0));
    }
    sun.gradient = sunGradient(taken, step, sun.irradiance);
    rest = std::move(left);
    return sun;
}

/// A sky through those of its zones' means that matter most, its energy scaled to be theirs.
Gradient skyGradient(const ZonalRadiance& radiance) {
    const std::size_t zones = radiance.means.size();
    const glm::dvec3 whole = sphereMean(radiance);
    std::vector<GradientStop> all;
    for (std::size_t i = 0; i < zones; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) / static_cast<double>(zones);
        all.push_back({90.0 - 180.0 * middle, radiance.means[i], 0.0});
    }
    all.front().at = 90.0;
    all.back().at = -90.0;
    Gradient gradient;
    const std::vector<bool> kept = keptStops(all, kSkyStops);
    for (std::size_t i = 0; i < zones; ++i) {
        if (kept[i]) {
            gradient.stops.push_back(all[i]);
        }
    }
    const glm::dvec3 has =
        sphereMean(zonalRadiance(RadianceProfile(gradient, LightKind::Sky), radiance.zones));
    for (GradientStop& stop : gradient.stops) {
        for (int c = 0; c < 3; ++c) {
            stop.color[c] =
                has[c] > 0.0 ? std::min(stop.color[c] * whole[c] / has[c], kMaxRadiance) : 0.0;
        }
    }
    return gradient;
}

} // namespace

PhotographedLights lightsFromPanorama(const core::Image& panorama, const glm::dvec3& axis,
                                      bool sun) {
    LODESTAR_EXPECT(!panorama.empty() && panorama.channels() == 3, "a panorama has three channels");
    const Zones zones{ZoneSpacing::EqualAngle, kSkyZones};
    PanoramaZones zonal = zonalFromPanorama(panorama, axis, zones);
    PhotographedLights lights;
    lights.residual = lights.residualBefore = zonal.residual;
    lights.rest = panorama;
    if (sun) {
        lights.sun = takeSun(lights.rest, sphereMean(zonal.radiance));
    }
    if (lights.sun) {
        zonal = zonalFromPanorama(lights.rest, axis, zones);
        lights.residual = zonal.residual;
    }
    lights.sky = skyGradient(zonal.radiance);
    return lights;
}

} // namespace lodestar::lighting
