// SPDX-License-Identifier: MIT
//
// What the panels share: what they are shown, what is chosen of how it is looked at, and what they
// want of whoever runs them. Degrees and sRGB here; the model's values stay linear radiance.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <imgui.h>

#include "core/image.h"
#include "gl/device.h"
#include "model/model.h"
#include "model/presets.h"
#include "model/ramp.h"
#include "plan/effect_plan.h"
#include "ui/accuracy.h"
#include "ui/input.h"

namespace lodestar::ui {

/// A node of the scene as a line of its tree.
struct NodeLine {
    std::string name;
    int depth = 0;
    std::string holds; ///< "mesh", "camera", ...
    bool named = true; ///< the name is the file's
};

/// A light probe of the document as the scene has it now.
struct ProbeLine {
    bool shown = false;    ///< false: the node that it names is not in the scene
    bool ready = false;    ///< it lights what it holds
    double progress = 1.0; ///< of the faces that it captures anew, [0, 1]
    glm::mat4 worldFromProbe{1.0f};
    bool operator==(const ProbeLine&) const = default;
};

/// A material of the scene as it is drawn now.
struct MaterialLine {
    std::string key;                  ///< what a document calls it: its glTF name, else "#index"
    double exponent = 0.0;            ///< Blinn-Phong [0, 1e7]
    glm::dvec3 diffuse{0.0}, f0{0.0}; ///< reflectances
    std::string specular;             ///< estimator; empty: the frame's
};

/// How a panorama's light is split into a sky about an axis and a sun, and what that loses.
struct PhotographFit {
    glm::dvec3 axis{0.0, 1.0, 0.0}; ///< unit, of the sky
    bool takesSun = true;           ///< whether a sun was looked for
    std::optional<glm::dvec3> sun;  ///< unit, towards the sun that was found
    double sunRadius = 0.0;         ///< degrees
    double residual = 0.0;          ///< lighting::PhotographedLights'
    double diffuseError = 0.0;      ///< of irradiance, relative, RMS over all normals
    std::string advice;
};

/// A picture that lights are taken from.
struct Photograph {
    std::string name;
    std::shared_ptr<const core::Image> radiance; ///< linear, 3 channels, repaired; null: none
    unsigned picture = 0;             ///< a GL texture of it, its first row on top; 0: none
    std::optional<PhotographFit> fit; ///< of a panorama
};

/// Work that goes on beside the frames.
struct WorkLine {
    std::string text;
    double share = 0.0; ///< of its stages that are done, [0, 1]
};

/// What the panels are shown besides the document.
struct Surroundings {
    std::string sceneName, documentName;
    std::vector<NodeLine> nodes;
    std::vector<MaterialLine> materials;
    bool drawsProbes = false;            ///< the picture shows what light probes of the document do
    std::vector<ProbeLine> probes;       ///< in the document's order
    glm::vec3 low{0.0f}, high{1.0f};     ///< world box about the scene
    glm::mat4 clipFromWorld{1.0f};       ///< of the picture
    std::vector<std::string> estimators; ///< that a material may have
    unsigned picture = 0;                ///< a GL texture of the viewport; 0: none
    unsigned preview = 0;                ///< the same of a sphere of the first selected material
    unsigned errorPicture = 0;           ///< the same of the picture's errors, row 0 at the top
    std::string errorText;               ///< what it shows, or how far it has come
    AccuracyView accuracy;               ///< of the first selected material
    std::shared_ptr<const plan::EffectPlan> plan;
    std::map<std::string, double> timesMs; ///< of the last frame, by step
    gl::WorkCounters counters;             ///< of the last frame
    /// Where ImGuiIO::KeysDown has a key, -1 where nowhere: of the back-end of a host's context. A
    /// Session has each at its own number.
    int (*placeOfKey)(Key) = nullptr;
    Photograph photograph;
    std::optional<WorkLine> work;
    std::vector<model::Preset> presets; ///< the user's own
};

/// How the picture is looked at: not part of the document.
struct ViewState {
    double hour = 15.0; ///< [0, 24)
    bool playing = false;
    double hoursASecond = 0.4;
    double exposure = 0.0; ///< stops, +-20
    bool falseColor = false;
    bool errorView = false; ///< how far the picture is from a reference
    bool mapRows = false;   ///< the rows of the maps of skies and suns are shown
    bool picking = false;   ///< the next click in the viewport gives a radiance
    bool brush = false;     ///< the painter paints freehand
    model::Brush brushSettings;
    model::Snap snap{5.0, true, true, 0.0};
    bool snapping = false;
    bool help = false;
    int node = -1;                  ///< of Surroundings::nodes, that is selected; -1: none
    std::string estimator = "tent"; ///< of the frame
    std::string presetName;         ///< that is typed
    std::string presetLeaves;       ///< whose deletion waits for a second click
};

/// How the camera is to move; framebuffer pixels.
struct CameraMove {
    glm::vec2 orbit{0.0f}, look{0.0f}, pan{0.0f};
    float dolly = 0.0f;
    glm::vec3 fly{0.0f}; ///< right, up, forward: -1, 0 or 1
    bool fast = false;
    bool frameAll = false, frameSelection = false, reset = false;
    bool operator==(const CameraMove&) const = default;
};

/// A panorama's mean over azimuth as the gradient of a key.
struct MeanWish {
    model::Id key = model::Id::None;
    glm::dvec3 axis{0.0, 1.0, 0.0}; ///< not zero
};
/// A panorama's sky, and its sun, in place of the document's lights.
struct LightsWish {
    glm::dvec3 axis{0.0, 1.0, 0.0}; ///< of the sky, unit
    bool takesSun = true;
};

/// What a frame of the panels asks for.
struct Wishes {
    bool save = false, quit = false;
    std::optional<std::string> saveAs, saveCommands, openScene, openLighting;
    CameraMove camera;
    /// A click on the picture: its pixel, from its top left, selects the material there, or with
    /// Ctrl adds it to the selection.
    std::optional<glm::ivec2> select;
    bool selectMore = false;
    std::optional<std::size_t> captureProbe; ///< the document's, to be captured anew
    std::optional<glm::ivec2> pick;          ///< a pixel of the viewport, from its top left
    std::optional<std::string> openPhotograph;
    bool closePhotograph = false, cancelWork = false;
    std::optional<MeanWish> mean;
    std::optional<LightsWish> lights;
    bool listPresets = false;                            ///< reads the user's folder again
    std::optional<std::string> savePreset, removePreset; ///< names
    bool reload = false, keepMine = false;               ///< what others did to the document's file
    /// The viewport in the framebuffer: left, top, width, height in pixels.
    std::array<int, 4> viewport{};
};

/// A rectangle of the framebuffer, for whoever drives the panels by synthetic input.
struct Mark {
    ImVec2 low, high;
    ImVec2 clipLow, clipHigh; ///< what its window shows
    bool scrolls = false;     ///< the window has more below or above
    ImGuiID window = 0;       ///< that it was drawn in
    [[nodiscard]] ImVec2 center() const {
        return {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)};
    }
};

/// A line of the log.
struct LogLine {
    std::string text;
    bool isError = false;
};

/// What is handed from panel to panel in a frame.
class Studio {
public:
    Studio(model::Model& edited, const Surroundings& surroundings, ViewState& viewState)
        : model(edited), around(surroundings), view(viewState) {}

    model::Model& model;
    const Surroundings& around;
    ViewState& view;
    Wishes wishes;

    /// Carries a command out; a refusal is a line of the log. What one widget does while it is held
    /// is one step of undo.
    /// @return what it did; nothing where it was refused
    std::optional<model::Outcome> run(const model::Command& command);
    /// The same as a step of its own.
    std::optional<model::Outcome> runOnce(const model::Command& command);
    void say(std::string text, bool isError = false);
    /// Gives the selected stops, or the brush, a radiance. While one widget is held it is one step.
    void give(const glm::dvec3& radiance);

    [[nodiscard]] bool down(Key key) const;
    /// In this frame. @param repeats again and again while it is held
    [[nodiscard]] bool pressed(Key key, bool repeats = false) const;

    /// Names the last widget, or a rectangle.
    void mark(const std::string& name);
    void mark(const std::string& name, const ImVec2& low, const ImVec2& high);

    /// The key that is painted: the selection's, else the first light's at or before the hour.
    [[nodiscard]] model::Id chosenKey() const;
    [[nodiscard]] model::Id chosenLight() const;

    std::map<std::string, Mark> marks;
    std::deque<LogLine> log;
    bool cancelled = false; ///< Escape has just taken back what a widget did while it was held

private:
    friend class Workspace;
    model::MergeToken token_ = 0;
    ImGuiID holder_ = 0; ///< the widget that token_ belongs to
};

} // namespace lodestar::ui
