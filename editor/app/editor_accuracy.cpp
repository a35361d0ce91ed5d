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
    const std::optional<std::size_t> index =
        selected.empty() || !everSynced_ ? std::nullopt : materialIndex(selected.front());
    if (!index) {
        meter_.cancel();
    } else if (!pictureStale_) { // a drag goes first
        const ui::MaterialLine& line = around_.materials[*index];
        const ui::ViewState& view = workspace_.view();
        AccuracyMeter::Subject subject;
        subject.material = line.key;
        subject.exponent = line.exponent;
        subject.estimators = around_.estimators;
        const bool alone =
            around_.plan &&
            std::none_of(around_.plan->drawFeatures.begin(), around_.plan->drawFeatures.end(),
                         [](plan::Features features) {
                             return plan::has(features, plan::Feature::Environment);
                         });
        if (!alone) {
            subject.environment = environment_;
            subject.used = line.specular.empty() ? view.estimator : line.specular;
        } else {
            subject.used = "rsrm";
            subject.hour = view.hour;
            subject.light = model_.revisions().lights;
            subject.rows = view.mapRows;
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
