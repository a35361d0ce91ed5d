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
    /// The strip's colours, and what they are of: most frames show the same ones.
    struct Drawn {
        document::Light light;
        bool falseColor = false;
        double exposure = 0.0;
        std::vector<ImU32> colors;
    };
    void drawRamp(const Studio& studio, const Frame& frame);
    void drawKeys(Studio& studio, const Frame& frame);
    void pointer(Studio& studio, const Frame& frame);
    static void answerArrows(Studio& studio, const Frame& frame);
    Drawn drawn_;
    model::Id grabbed_ = model::Id::None;
    double draggedTo_ = -1.0; ///< hour; -1: nowhere yet
    bool scrubs_ = false;
};

/// The light that is painted: which, its axis or path, the key's tint.
void drawLightPanel(Studio& studio);
/// The choice of presets, built in and the user's, and the saving of one.
void drawPresets(Studio& studio);
/// Asks what is to become of what others wrote to the document's file. @param asks begins to
void drawOutside(Studio& studio, bool asks);
/// What goes on beside the frames, with a button that ends it, as Escape does.
void drawWork(Studio& studio);
/// The materials that are selected: exponent, reflectances, estimator.
void drawMaterialPanel(Studio& studio);
/// The environment behind the scene: its source, rotation and exposure.
void drawEnvironmentPanel(Studio& studio);
/// The light probe that is selected: where it is, what it captures and when, where it holds.
void drawProbePanel(Studio& studio);
/// The selected light probes' volumes over the picture, and handles that move the first of them.
class ProbeGizmo {
public:
    /// @param low, size of the picture, framebuffer pixels
    void draw(Studio& studio, const ImVec2& low, const ImVec2& size);

private:
    void drawHandles(Studio& studio, const ImVec2& low, const ImVec2& size, model::Id id,
                     std::size_t index);
    /// Where the pointer and the keys that are held draw a coordinate to, metres; nothing where the
    /// pointer has not moved yet.
    std::optional<double> drag(const Studio& studio, double coordinate, float along);
    double from_ = 0.0;  ///< the coordinate where the drag began
    double moved_ = 0.0; ///< metres by which it was dragged since
};
/// A light probe that holds the whole scene, to begin with.
[[nodiscard]] lighting::Probe firstProbe(const Studio& studio);
/// The selected material's estimators: error against time, and in numbers.
void drawAccuracyPanel(Studio& studio);
/// The rows of the maps of skies and suns with their errors.
void drawMapRowsPanel(Studio& studio);
/// An error as a percentage of two digits, or a dash where none is known yet.
[[nodiscard]] std::string percentText(const std::optional<double>& error);
/// Milliseconds a megapixel likewise.
[[nodiscard]] std::string millisecondsText(const std::optional<double>& ms);
/// The scene's nodes, its materials, the document's lights.
void drawScenePanel(Studio& studio);
/// The plan in words, the times of the last frame, the log.
void drawReportPanel(Studio& studio);
/// The picture, and what the pointer does on it.
void drawViewport(Studio& studio, ProbeGizmo& gizmo);

/// Stops of the chosen key, from the axis outwards, and the selection moved along them.
void selectNeighbourStop(Studio& studio, int step);

} // namespace lodestar::ui
