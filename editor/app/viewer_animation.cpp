// SPDX-License-Identifier: MIT
//
// The viewer's time: which animation poses the scene, and when.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/viewer.h"

namespace lodestar::app {

void Viewer::chooseAnimation(int animation) {
    const std::vector<std::string> names = scene::animationNames(*document_.scene);
    if (names.empty()) {
        say("the scene has no animations", false);
        return;
    }
    animation_ = animation % static_cast<int>(names.size());
    time_ = 0.0;
    playing_ = playing_ && scene::duration(*document_.scene, animation_) > 0.0;
    scene::reachOver(*document_.scene, animation_);
    document_.bounds = document_.scene->worldBounds();
    scene::pose(*document_.scene, animation_, time_);
    say(names[static_cast<std::size_t>(animation_)], false);
}

void Viewer::play() {
    if (animation_ == scene::kRestPose) {
        chooseAnimation(0);
    }
    // One pose is no motion: an animation of no length would draw for nothing.
    playing_ = !playing_ && scene::duration(*document_.scene, animation_) > 0.0;
    changed(false);
}

void Viewer::scrub(double seconds) {
    if (animation_ == scene::kRestPose) {
        chooseAnimation(0);
    }
    if (animation_ == scene::kRestPose) {
        return;
    }
    playing_ = false;
    time_ = std::clamp(time_ + seconds, 0.0, scene::duration(*document_.scene, animation_));
    scene::pose(*document_.scene, animation_, time_);
    changed(false);
}

void Viewer::advanceAnimation(double seconds) {
    if (!playing_) {
        return;
    }
    time_ = std::fmod(time_ + seconds, scene::duration(*document_.scene, animation_));
    scene::pose(*document_.scene, animation_, time_);
    changed(false);
}

std::string Viewer::animationText() const {
    if (animation_ == scene::kRestPose) {
        return document_.scene->animations.empty() ? "no animation" : "at rest   space plays";
    }
    char text[64];
    std::snprintf(text, sizeof text, "%s %.2f of %.2f s", playing_ ? "playing  " : "paused   ",
                  time_, scene::duration(*document_.scene, animation_));
    return text;
}

} // namespace lodestar::app
