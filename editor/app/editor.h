// SPDX-License-Identifier: MIT
//
// `lodestar edit` without its window: events in, frames out, so that tests drive it without a
// display. What edits is editor/model, what is shown are editor/ui's panels; here they meet a scene
// and its renderer.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/accuracy_meter.h"
#include "app/background.h"
#include "app/editor_preview.h"
#include "app/error_view.h"
#include "app/scene_lighting.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"
#include "model/document_file.h"
#include "model/model.h"
#include "platform/window.h"
#include "scene/camera_controller.h"
#include "scene/renderer.h"
#include "ui/session.h"
#include "ui/workspace.h"

namespace lodestar::app {

struct EditorOptions {
    std::string scene;    ///< empty: the built-in spheres
    std::string lighting; ///< empty: the document beside the scene, to be made where there is none
    std::string assetRoot;
    bool beside = false; ///< a scene that is there is opened beside the frames of the spheres
};

class Editor {
public:
    /// @errors as `load`'s: what a named file is refused for
    [[nodiscard]] static core::Result<std::unique_ptr<Editor>>
    make(gl::Device& device, const EditorOptions& options, ui::Clipboard clipboard);

    void handle(const platform::Event& event);
    /// What moves by itself does so. @param seconds since the last call
    void advance(double seconds);
    /// Whether a frame would differ from the last one.
    [[nodiscard]] bool wantsFrame() const;
    /// Seconds until something is due without an event; 0: now.
    [[nodiscard]] double patience() const;
    /// Builds the panels, brings the scene's light up to date, draws both into a framebuffer. A
    /// stroke is in the picture of the frame that it was made in.
    /// @param width @param height framebuffer pixels, > 0  @param scale of the display
    /// @errors NoOpenGl, Internal: the first frame; later ones say so in the log
    [[nodiscard]] core::Result<void> drawFrame(int width, int height, float scale,
                                               unsigned framebuffer = 0);

    [[nodiscard]] bool closing() const { return closing_; }
    [[nodiscard]] std::string title() const;

    [[nodiscard]] model::Model& model() { return model_; }
    [[nodiscard]] ui::Workspace& workspace() { return workspace_; }
    [[nodiscard]] const ui::Surroundings& surroundings() const { return around_; }
    /// Whether something goes on beside the frames.
    [[nodiscard]] bool works() const { return work_.runs() || opening_; }
    [[nodiscard]] int framesDrawn() const { return framesDrawn_; }
    [[nodiscard]] int picturesDrawn() const { return picturesDrawn_; }
    [[nodiscard]] int previewsDrawn() const { return previewsDrawn_; }
    /// Passes of the error view's reference so far, of how many.
    [[nodiscard]] int errorPasses() const { return error_ ? error_->passes() : 0; }
    static constexpr int kErrorPasses = 32;
    /// The figures of the error view. @pre a pass has been drawn
    [[nodiscard]] ErrorFigures errorFigures() const { return error_->figures(); }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr double kWatchSeconds = 1.0;
    static constexpr int kWindowFrames = 3;      ///< until a window that appears is seen as it is
    static constexpr double kWorkSeconds = 0.05; ///< between two looks at what goes on

    /// A scene and what shows it. In an order that lets the renderer go first.
    struct Shown {
        std::unique_ptr<scene::Scene> scene;
        std::vector<io::GltfMaterial> materials; ///< as in the file
        std::unique_ptr<scene::Renderer> renderer;
        scene::Bounds bounds;
        DistantLight own; ///< where the document says nothing
    };
    /// A scene that has been read and goes to the GPU, beside the one that is shown.
    struct Opening {
        Opening(gl::Device& device, std::string from, std::string within, Shown read,
                const scene::Renderer* light)
            : path(std::move(from)), root(std::move(within)), shown(std::move(read)),
              upload(device, *shown.scene, light) {}
        std::string path, root;
        Shown shown;
        scene::RendererUpload upload;
    };

    Editor(gl::Device& device, ui::Clipboard clipboard);
    core::Result<void> openLightingFile(const std::filesystem::path& path);
    void describeScene();
    void describeMaterials();

    /// Brings the renderer up to date with the document. @return whether anything was due
    bool syncDocument();
    void syncEnvironment();
    void syncLights();
    void syncMaterials();
    void syncProbes();
    /// What the panels are told of the light probes.
    void describeProbes();

    /// A material's number by what a document calls it.
    [[nodiscard]] std::optional<std::size_t> materialIndex(const std::string& key) const;
    /// Draws the sphere of the selected material anew where it or its light has changed.
    void syncPreview();
    /// Says what is to be measured of the selected material, and takes what is.
    void syncAccuracy();
    /// Whether the error view is still to be made or to be made better.
    [[nodiscard]] bool errorDue() const;
    void drawErrorPass();
    void forgetErrors();

    void answer(const ui::Wishes& wishes);
    void moveCamera(const ui::CameraMove& move);
    void pick(const glm::ivec2& pixel);
    /// Selects the material at a pixel of the picture, or none where there is nothing.
    void select(const glm::ivec2& pixel, bool more);
    /// World box about what is selected: a node and what is below it, light probes, what has the
    /// materials; the whole scene where nothing is.
    [[nodiscard]] scene::Bounds selectedBounds() const;
    void save();
    core::Result<void> drawPicture();
    [[nodiscard]] core::Result<void> buildPanels(int width, int height, float scale);
    [[nodiscard]] scene::View view() const;
    [[nodiscard]] float aspect() const;
    [[nodiscard]] double now() const;
    void handleKey(const platform::KeyEvent& event);
    void drop(const std::string& path);

    // editor_open.cpp
    /// A file's scene with all but its renderer. @param path empty: the built-in spheres
    /// @errors as `load`'s
    static core::Result<Shown> readScene(const std::string& path, const std::string& root,
                                         Background::Progress& progress);
    /// Reads, uploads and shows a scene before it returns. @errors as readScene, NoOpenGl
    core::Result<void> openScene(const std::string& path, const std::string& root);
    /// The same beside the frames: until it is all there, what was shown is.
    void openSceneBeside(const std::string& path, const std::string& root);
    /// As somebody at the window asks for it: which is said in place of what was said before.
    void askForScene(const std::string& path);
    void uploadOpening();
    void show(const std::string& path, const std::string& root, Shown shown);
    void cancelWork();
    void pollWork();
    void describeWork();
    // editor_files.cpp
    /// Looks once a second at what others did to the document's file.
    void watchFile(double seconds);
    void reload();
    void listPresets();
    void answerFiles(const ui::Wishes& wishes);
    void paste(const std::string& text);
    // editor_photograph.cpp
    void openPhotograph(const std::string& path);
    void closePhotograph();
    /// Draws it for the exposure of the view.
    void showPhotograph();
    /// Between two frames, as the last one's panels show the old texture.
    void refreshPhotograph();
    void useLights(const ui::LightsWish& wish);
    void useMean(const ui::MeanWish& wish);
    void setMean(const ui::MeanWish& wish, const document::Gradient& gradient);
    void answerPhotograph(const ui::Wishes& wishes);
    /// Another picture is due.
    void stale();

    gl::Device* device_;
    ui::Session session_;
    ui::Workspace workspace_;
    ui::Surroundings around_;
    model::Model model_;
    model::DocumentFile file_;
    model::Revisions synced_;
    bool everSynced_ = false;
    std::string scenePath_, assetRoot_;
    Shown shown_;
    bool hasEnvironment_ = false;
    std::optional<DistantLight> read_; ///< the environment's file, as last read
    ProbeMaps probeMaps_;
    core::Tally probeWarnings_;    ///< of the last time that they were set
    std::vector<int> shownProbes_; ///< by the renderer's order: which of the document's
    std::shared_ptr<const lighting::Cubemap> environment_; ///< that is set, where there is one

    /// What the sphere depends on.
    struct PreviewKey {
        std::size_t material = 0;
        std::uint64_t document = 0;
        double hour = 0.0, exposure = 0.0;
        bool operator==(const PreviewKey&) const = default;
    };
    std::unique_ptr<MaterialPreview> preview_;
    std::optional<PreviewKey> previewed_;
    int previewsDrawn_ = 0;
    AccuracyMeter meter_;
    std::optional<ErrorView> error_;
    gl::Texture errorPicture_;
    std::vector<gl::Texture> retired_; ///< that the frame being built may still show

    scene::RenderSettings settings_;
    scene::CameraRequest request_;
    std::optional<scene::CameraPose> pose_;
    gl::DisplayTarget picture_;
    ui::CameraMove move_; ///< of the last frame: a held key goes on flying
    ui::ViewState seen_;  ///< what the picture shows

    bool pictureStale_ = true;
    bool coarse_ = false; ///< the picture has one sample a pixel
    double fineMs_ = 0.0;
    Clock::time_point start_ = Clock::now(), lastChange_ = Clock::now();
    double sinceFrame_ = 0.0;
    int framesDrawn_ = 0, picturesDrawn_ = 0;
    std::string status_;
    bool closing_ = false;

    double sinceWatched_ = 0.0;        ///< the document's file, seconds
    std::unique_ptr<Opening> opening_; ///< null: none is on its way
    std::vector<std::string> presetWarnings_;
    std::shared_ptr<const core::Image> photographSmall_; ///< as wide as its texture
    std::vector<document::Light> photographLights_;      ///< of its fit
    gl::Texture photographTexture_;
    double photographExposure_ = 0.0; ///< of that texture
    Background work_;                 ///< last, so that it has ended before what it fills goes
};

} // namespace lodestar::app
