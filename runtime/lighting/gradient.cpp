// SPDX-License-Identifier: MIT
#include "lighting/gradient.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include <glm/common.hpp>

#include "core/contract.h"

namespace lodestar::lighting {

namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

/// Written so that NaN becomes 0.
double repairedNumber(double value) {
    return value > 0.0 ? std::min(value, kMaxRadiance) : 0.0;
}

// The curve of lodestar_srgbFromLinear and its inverse, which stop at 1: a display does, radiance
// does not.
double srgbFromLinear(double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}
double linearFromSrgb(double x) {
    return x <= 0.0404482362771082 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// Ottosson 2020, "A perceptual color space for image processing", linear sRGB to Oklab.
glm::dvec3 oklabFromLinear(const glm::dvec3& c) {
    const double l = std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
    const double m = std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
    const double s = std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}
glm::dvec3 linearFromOklab(const glm::dvec3& lab) {
    const double l = std::pow(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z, 3);
    const double m = std::pow(lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z, 3);
    const double s = std::pow(lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z, 3);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

glm::dvec3 encoded(const glm::dvec3& c, GradientSpace space) {
    switch (space) {
    case GradientSpace::Srgb:
        return {srgbFromLinear(c.r), srgbFromLinear(c.g), srgbFromLinear(c.b)};
    case GradientSpace::Oklab:
        return oklabFromLinear(c);
    case GradientSpace::Linear:
        break;
    }
    return c;
}
glm::dvec3 decoded(const glm::dvec3& c, GradientSpace space) {
    switch (space) {
    case GradientSpace::Srgb:
        return {linearFromSrgb(c.r), linearFromSrgb(c.g), linearFromSrgb(c.b)};
    case GradientSpace::Oklab:
        return linearFromOklab(c);
    case GradientSpace::Linear:
        break;
    }
    return c;
}

/// Degrees from the axis.
double fromAxis(const GradientStop& stop, LightKind kind) {
    return kind == LightKind::Sky ? 90.0 - stop.at : stop.at;
}

/// The slope of a monotone cubic at a stop between two pieces of lengths h0, h1 and secants d0, d1:
/// their weighted harmonic mean, 0 at an extremum (Fritsch and Butland 1984).
double monotoneSlope(double h0, double d0, double h1, double d1) {
    if (!(d0 * d1 > 0.0)) {
        return 0.0;
    }
    const double w0 = 2.0 * h1 + h0;
    const double w1 = h1 + 2.0 * h0;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// Turns a list that runs towards the axis around. A Constant stop held up to the next one listed,
/// which now comes before it: radiances move one place on, the last listed keeps its own place too.
void turnAround(Gradient& gradient) {
    std::vector<GradientStop>& stops = gradient.stops;
    std::reverse(stops.begin(), stops.end());
    if (gradient.interpolation == GradientInterpolation::Constant) {
        stops.insert(stops.begin(), stops.front());
        for (std::size_t i = 1; i + 1 < stops.size(); ++i) {
            stops[i].color = stops[i + 1].color;
            stops[i].ev = stops[i + 1].ev;
        }
    }
}

core::Result<void> checkedPlaces(const std::vector<GradientStop>& stops, LightKind kind) {
    if (stops.empty()) {
        return core::refused("a gradient needs at least one stop", "/stops");
    }
    const double least = kind == LightKind::Sky ? -90.0 : 0.0;
    const double most = kind == LightKind::Sky ? 90.0 : 180.0;
    for (std::size_t i = 0; i < stops.size(); ++i) {
        // Written so that NaN is refused.
        if (!(stops[i].at >= least && stops[i].at <= most)) {
            return core::refused(kind == LightKind::Sky
                                     ? "a sky's stop lies at an elevation from -90 to 90 degrees"
                                     : "a sun's stop lies at an angle from 0 to 180 degrees",
                                 "/stops/" + std::to_string(i) + "/at");
        }
    }
    return {};
}

} // namespace

glm::dvec3 radianceOf(const GradientStop& stop) {
    const glm::dvec3 radiance = stop.color * std::exp2(stop.ev);
    return {repairedNumber(radiance.r), repairedNumber(radiance.g), repairedNumber(radiance.b)};
}

core::Result<Gradient> repaired(Gradient gradient, LightKind kind, core::Tally& warnings) {
    std::vector<GradientStop>& stops = gradient.stops;
    if (auto checked = checkedPlaces(stops, kind); !checked) {
        return checked.error();
    }
    const auto nearer = [kind](const GradientStop& a, const GradientStop& b) {
        return fromAxis(a, kind) < fromAxis(b, kind);
    };
    if (!std::is_sorted(stops.begin(), stops.end(), nearer)) {
        if (std::is_sorted(stops.rbegin(), stops.rend(), nearer)) {
            turnAround(gradient);
        } else {
            std::stable_sort(stops.begin(), stops.end(), nearer);
            warnings.add("gradient stops out of order, sorted");
        }
    }
    std::uint64_t notNumbers = 0;
    std::uint64_t negative = 0;
    std::uint64_t tooLarge = 0;
    for (GradientStop& stop : stops) {
        bool wrong = false;
        for (int c = 0; c < 3; ++c) {
            const double value = stop.color[c] * std::exp2(stop.ev);
            notNumbers += std::isnan(value) ? 1U : 0U;
            negative += value < 0.0 ? 1U : 0U;
            tooLarge += value > kMaxRadiance ? 1U : 0U;
            wrong = wrong || !(value >= 0.0 && value <= kMaxRadiance);
        }
        if (wrong) {
            stop.color = radianceOf(stop);
            stop.ev = 0.0;
        }
    }
    warnings.add("gradient radiance not a number, set to 0", notNumbers);
    warnings.add("gradient radiance negative, set to 0", negative);
    warnings.add("gradient radiance above 1e9, set to 1e9", tooLarge);
    return gradient;
}

RadianceProfile::RadianceProfile(const Gradient& gradient, LightKind kind)
    : kind_(kind), interpolation_(gradient.interpolation), space_(gradient.space) {
    LODESTAR_EXPECT(!gradient.stops.empty(), "a gradient has stops");
    for (const GradientStop& stop : gradient.stops) {
        const double angle = fromAxis(stop, kind) * kRadians;
        LODESTAR_EXPECT(angle >= 0.0 && (angles_.empty() || angle >= angles_.back()),
                        "the gradient's stops are in order");
        angles_.push_back(angle);
        radiances_.push_back(radianceOf(stop));
        values_.push_back(encoded(radiances_.back(), space_));
    }
    if (interpolation_ == GradientInterpolation::Cubic) {
        setSlopes();
    }
}

void RadianceProfile::setSlopes() {
    const std::size_t n = angles_.size();
    slopesIn_.assign(n, glm::dvec3(0.0));
    slopesOut_.assign(n, glm::dvec3(0.0));
    const auto length = [this](std::size_t i) { return angles_[i + 1] - angles_[i]; };
    const auto secant = [&](std::size_t i) { return (values_[i + 1] - values_[i]) / length(i); };
    for (std::size_t i = 0; i < n; ++i) {
        // A step ends a curve: each side goes on as if the other were not there.
        const bool before = i > 0 && length(i - 1) > 0.0;
        const bool after = i + 1 < n && length(i) > 0.0;
        if (before && after) {
            for (int c = 0; c < 3; ++c) {
                slopesIn_[i][c] =
                    monotoneSlope(length(i - 1), secant(i - 1)[c], length(i), secant(i)[c]);
            }
            slopesOut_[i] = slopesIn_[i];
        } else if (before) {
            slopesIn_[i] = secant(i - 1);
        } else if (after) {
            slopesOut_[i] = secant(i);
        }
    }
}

glm::dvec3 RadianceProfile::between(std::size_t i, double t) const {
    const glm::dvec3& a = values_[i - 1];
    const glm::dvec3& b = values_[i];
    switch (interpolation_) {
    case GradientInterpolation::Constant:
        return a;
    case GradientInterpolation::Smooth: {
        const double s = t * t * (3.0 - 2.0 * t);
        return (1.0 - s) * a + s * b;
    }
    case GradientInterpolation::Cubic: {
        const double h = angles_[i] - angles_[i - 1];
        const double u = 1.0 - t;
        return u * u * (1.0 + 2.0 * t) * a + t * t * (3.0 - 2.0 * t) * b +
               h * t * u * (u * slopesOut_[i - 1] - t * slopesIn_[i]);
    }
    case GradientInterpolation::Linear:
        break;
    }
    return (1.0 - t) * a + t * b;
}

glm::dvec3 RadianceProfile::radiance(double theta) const {
    const auto after = std::upper_bound(angles_.begin(), angles_.end(), theta);
    const auto i = static_cast<std::size_t>(after - angles_.begin());
    if (i == 0) {
        return radiances_.front();
    }
    if (i == angles_.size()) {
        return kind_ == LightKind::Sun && theta > angles_.back() ? glm::dvec3(0.0)
                                                                 : radiances_.back();
    }
    const double t = (theta - angles_[i - 1]) / (angles_[i] - angles_[i - 1]);
    return glm::max(decoded(between(i, t), space_), glm::dvec3(0.0));
}

} // namespace lodestar::lighting
