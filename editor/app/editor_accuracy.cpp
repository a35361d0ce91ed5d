// SPDX-License-Identifier: MIT
//
// What is measured of the selected material, beside the frames.
#include <algorithm>

#include "app/editor.h"

namespace lodestar::app {

std::optional<std::size_t> Editor::materialIndex(const std::string& key) const {
    const auto found = std::find_if(around_.materials.begin(), around_.materials.end(),
                                    [&](const ui::MaterialLine& line) { return line.key == key; });
    return found == around_.materials.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - around_.materials.begin()));
}

void Editor::syncAccuracy() {
    const std::vector<std::string>& selected = model_.selection().materials;
    AccuracyMeter::Subject subject;
    const ui::ViewState& view = workspace_.view();
    for (const std::string& key : selected) {
        if (const auto index = everSynced_ ? materialIndex(key) : std::nullopt) {
            const ui::MaterialLine& line = around_.materials[*index];
            subject.materials.push_back(
                {line.key, line.exponent, line.specular.empty() ? view.estimator : line.specular});
        }
    }
    if (subject.materials.empty()) {
        meter_.cancel();
    } else if (!pictureStale_) { // a drag goes first
        subject.estimators = around_.estimators;
        const bool alone =
            around_.plan &&
            std::none_of(around_.plan->drawFeatures.begin(), around_.plan->drawFeatures.end(),
                         [](plan::Features features) {
                             return plan::has(features, plan::Feature::Environment);
                         });
        if (!alone) {
            subject.environment = environment_;
        } else {
            for (AccuracyMeter::Worn& worn : subject.materials) {
                worn.used = "rsrm";
            }
            subject.hour = view.hour;
            subject.light = model_.revisions().lights;
            subject.rows = view.mapRows;
            subject.maps = document::mapLayout(model_.document());
            core::Tally none;
            if (auto lights = document::dayLights(model_.document(), none)) {
                subject.lights = std::move(*lights);
            }
        }
        meter_.measure(std::move(subject));
    }
    if (meter_.busy() && !pictureStale_ && !errorDue()) {
        if (auto timed = meter_.slice(*device_); !timed) {
            workspace_.say(timed.error().message(), true);
            meter_.cancel();
        }
    }
    if (meter_.poll(around_.accuracy)) {
        session_.wake();
    }
}

} // namespace lodestar::app
