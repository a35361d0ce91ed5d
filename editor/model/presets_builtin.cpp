// SPDX-License-Identifier: MIT
//
// The presets that are built in: fits by eye to photographs' proportions, so that a white floor
// lies near 1 by day at exposure 0. A sun's disc is 0.27 degrees in radius.
#include <vector>

#include "model/presets.h"

namespace lodestar::model {
namespace {

using document::Key;
using document::Light;
using document::Stop;
using lighting::GradientInterpolation;
using lighting::GradientSpace;
using lighting::LightKind;

Stop stop(double at, const glm::dvec3& color, double ev = 0.0) {
    return {{at, color, ev}, {}};
}

Light sky(std::vector<Stop> stops) {
    Light light;
    light.name = "sky";
    Key key;
    key.hour = 12.0;
    key.gradient = {std::move(stops), GradientInterpolation::Smooth, GradientSpace::Oklab, {}};
    light.keys.push_back(std::move(key));
    return light;
}

/// A disc with a glow. @param disc, glow stops of EV of the disc and of the sky beside it
Light sun(const char* name, const glm::dvec3& axis, const glm::dvec3& color, double disc,
          double glow) {
    Light light;
    light.name = name;
    light.kind = LightKind::Sun;
    light.axis = axis;
    Key key;
    key.hour = 12.0;
    key.gradient.stops = {stop(0.0, color, disc),       stop(0.27, color, disc),
                          stop(0.27, color, glow),      stop(1.5, color, glow - 3.5),
                          stop(6.0, color, glow - 6.0), stop(20.0, color, glow - 8.8),
                          stop(50.0, glm::dvec3(0.0))};
    light.keys.push_back(std::move(key));
    return light;
}

/// A round lamp with a soft edge. @param radius degrees
Light lamp(const char* name, const glm::dvec3& axis, const glm::dvec3& color, double ev,
           double radius) {
    Light light;
    light.name = name;
    light.kind = LightKind::Sun;
    light.axis = axis;
    light.visibility = false;
    Key key;
    key.hour = 12.0;
    key.gradient = {
        {stop(0.0, color, ev), stop(0.8 * radius, color, ev), stop(radius, glm::dvec3(0.0))},
        GradientInterpolation::Smooth,
        GradientSpace::Linear,
        {}};
    light.keys.push_back(std::move(key));
    return light;
}

std::vector<Preset> make() {
    return {
        {"Clear noon",
         {sky({stop(90, {0.040, 0.115, 0.370}), stop(30, {0.155, 0.310, 0.610}),
               stop(9, {0.450, 0.620, 0.840}), stop(0, {0.820, 0.890, 0.950}),
               stop(0, {0.260, 0.230, 0.185}), stop(-90, {0.220, 0.195, 0.160})}),
          sun("sun", {0.35, 0.85, 0.40}, {1.0, 0.93, 0.78}, 15.5, 5.5)}},
        {"Golden hour",
         {sky({stop(90, {0.050, 0.085, 0.215}), stop(35, {0.200, 0.190, 0.270}),
               stop(12, {0.700, 0.420, 0.270}), stop(3, {1.250, 0.640, 0.260}),
               stop(0, {1.100, 0.520, 0.200}), stop(0, {0.130, 0.088, 0.060}),
               stop(-90, {0.100, 0.068, 0.050})}),
          sun("sun", {-0.94, 0.19, 0.28}, {1.0, 0.52, 0.20}, 14.3, 5.3)}},
        {"Overcast",
         {sky({stop(90, {0.930, 0.960, 1.000}), stop(45, {0.760, 0.785, 0.820}),
               stop(0, {0.420, 0.435, 0.460}), stop(-2, {0.165, 0.155, 0.145}),
               stop(-90, {0.120, 0.110, 0.100})})}},
        {"Dusk",
         {sky({stop(90, {0.014, 0.024, 0.070}), stop(35, {0.042, 0.042, 0.095}),
               stop(12, {0.150, 0.085, 0.110}), stop(4, {0.360, 0.150, 0.100}),
               stop(0, {0.480, 0.190, 0.085}), stop(0, {0.020, 0.015, 0.017}),
               stop(-90, {0.014, 0.011, 0.013})})}},
        {"Night",
         {sky({stop(90, {0.010, 0.018, 0.048}), stop(20, {0.016, 0.027, 0.062}),
               stop(0, {0.032, 0.043, 0.080}), stop(0, {0.008, 0.008, 0.011}),
               stop(-90, {0.005, 0.005, 0.008})}),
          sun("moon", {-0.45, 0.70, -0.55}, {0.70, 0.84, 1.0}, 12.3, 1.5)}},
        {"Studio",
         {sky({stop(90, {0.300, 0.300, 0.310}), stop(20, {0.160, 0.160, 0.165}),
               stop(0, {0.090, 0.090, 0.095}), stop(-90, {0.050, 0.050, 0.050})}),
          lamp("key light", {0.62, 0.62, 0.48}, {1.0, 0.96, 0.90}, 4.0, 16.0),
          lamp("fill light", {-0.80, 0.35, 0.48}, {0.88, 0.94, 1.0}, 0.8, 28.0),
          lamp("rim light", {-0.25, 0.55, -0.80}, {1.0, 1.0, 1.0}, 3.6, 9.0)}},
    };
}

} // namespace

document::Light plainLight(LightKind kind, std::string name) {
    const bool isSky = kind == LightKind::Sky;
    Light light =
        sky(isSky ? std::vector<Stop>{stop(90, glm::dvec3(0.5)), stop(-90, glm::dvec3(0.1))}
                  : std::vector<Stop>{stop(0, glm::dvec3(1.0), 14.0),
                                      stop(0.27, glm::dvec3(1.0), 14.0)});
    light.kind = kind;
    light.keys[0].gradient.interpolation = GradientInterpolation::Linear;
    light.keys[0].gradient.space = GradientSpace::Linear;
    light.name = std::move(name);
    if (!isSky) {
        light.axis = glm::dvec3(0.3, 0.8, 0.5);
    }
    return light;
}

const std::vector<Preset>& builtInPresets() {
    static const std::vector<Preset> presets = make();
    return presets;
}

} // namespace lodestar::model
