// SPDX-License-Identifier: MIT
//
// The viewer's lights and their hour.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/viewer.h"
#include "lighting/day.h"
#include "lighting/rsrm_layout.h"

namespace lodestar::app {
namespace {

/// Hours a second that a day plays at, chosen in turn: a day a minute at first.
constexpr double kDaySpeeds[] = {0.4, 1.6, 6.4, 0.1};

} // namespace

void Viewer::takeLights(std::vector<lighting::DayLight> lights) {
    lights_ = std::move(lights);
    dayPlaying_ = dayPlaying_ && !lights_.empty();
    document_.renderer->setLights(lights_, layoutOf(lightsEstimator_, ownMaps_));
}

/// A panorama that is chosen by hand is meant to be seen: no sky stands in its place.
void Viewer::dropReplacingSkies() {
    if (std::any_of(lights_.begin(), lights_.end(), lighting::replacesEnvironment)) {
        std::erase_if(lights_, lighting::replacesEnvironment);
        takeLights(std::move(lights_));
    }
}

void Viewer::moveHour(double hours) {
    if (lights_.empty()) {
        say("no lighting document: nothing here has an hour", false);
        return;
    }
    settings_.hour = lighting::wrappedHour(settings_.hour + hours);
    changed(false);
}

void Viewer::playDay() {
    dayPlaying_ = !dayPlaying_ && !lights_.empty();
    moveHour(0.0);
}

void Viewer::nextDaySpeed() {
    daySpeed_ = (daySpeed_ + 1) % std::size(kDaySpeeds);
    moveHour(0.0);
}

void Viewer::advanceDay(double seconds) {
    if (dayPlaying_) {
        moveHour(seconds * kDaySpeeds[daySpeed_]);
    }
}

std::string Viewer::hourText() const {
    const int minutes = static_cast<int>(std::lround(settings_.hour * 60.0)) % (24 * 60);
    char text[64];
    std::snprintf(text, sizeof text, "hour      %02d:%02d", minutes / 60, minutes % 60);
    std::string line = text;
    if (dayPlaying_) {
        std::snprintf(text, sizeof text, ", %g hours a second", kDaySpeeds[daySpeed_]);
        line += text;
    }
    return line;
}

} // namespace lodestar::app
