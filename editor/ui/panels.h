// SPDX-License-Identifier: MIT
//
// The panels that have no state of their own. Each draws into the ImGui window that is begun.
#pragma once

#include "ui/gradient_strip.h"
#include "ui/studio.h"

namespace lodestar::ui {

/// The gradient of a key: the strip, its stops' values, brush, interpolation.
class GradientPanel {
public:
    void draw(Studio& studio, model::Id key);

private:
    GradientStrip strip_;
};

/// The day: 24 hours of the chosen light, its keys, the hour.
class DayPanel {
public:
    void draw(Studio& studio);

private:
    struct Frame;
    void drawKeys(Studio& studio, const Frame& frame);
    void pointer(Studio& studio, const Frame& frame);
    model::Id grabbed_ = model::Id::None;
    double draggedTo_ = -1.0; ///< hour; -1: nowhere yet
    bool scrubs_ = false;
};

/// The light that is painted: which, its axis or path, the key's tint.
void drawLightPanel(Studio& studio);
/// The materials that are selected: exponent, reflectances, estimator.
void drawMaterialPanel(Studio& studio);
/// The scene's nodes, its materials, the document's lights.
void drawScenePanel(Studio& studio);
/// The plan in words, the times of the last frame, the log.
void drawReportPanel(Studio& studio);
/// The picture, and what the pointer does on it.
void drawViewport(Studio& studio);

/// Stops of the chosen key, from the axis outwards, and the selection moved along them.
void selectNeighbourStop(Studio& studio, int step);

} // namespace lodestar::ui
