// SPDX-License-Identifier: MIT
//
// What the viewer's window shows and does, without the window: events in, frames out.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/error_view.h"
#include "app/scene_options.h"
#include "app/view_keys.h"
#include "app/view_overlay.h"
#include "gl/texture.h"
#include "platform/window.h"
#include "scene/animation.h"
#include "scene/camera_controller.h"

namespace lodestar::app {

struct ViewerOptions {
    SceneOptions scene;
    double exposure = 0.0; ///< stops
    int samplesPerSide = 2;
};

/// A scene under an environment, seen by a camera that is moved by hand.
class Viewer {
public:
    /// @errors as Renderer::make
    [[nodiscard]] static core::Result<std::unique_ptr<Viewer>>
    make(gl::Device& device, LoadedScene loaded, const ViewerOptions& options);

    /// The framebuffer; a size of 0 draws nothing.
    void setSize(int width, int height, float contentScale);
    void handle(const platform::Event& event);
    /// Moves what moves by itself. @param seconds since the last call, >= 0
    void advance(double seconds);

    /// Whether a frame would show something new.
    [[nodiscard]] bool wantsFrame() const;
    /// Seconds that may be slept if nothing happens; infinity if nothing is to come.
    [[nodiscard]] double patience() const;
    /// Draws into framebuffer 0 what is to be seen now. @pre a size above 0
    /// @errors as Renderer::draw, of the first frame; later ones show theirs in the window
    [[nodiscard]] core::Result<void> drawFrame();

    [[nodiscard]] bool closing() const { return closing_; }
    [[nodiscard]] bool fullScreen() const { return fullScreen_; }
    [[nodiscard]] std::string title() const;
    [[nodiscard]] OverlayText text() const;
    [[nodiscard]] scene::View view() const;
    /// Counters, estimators, and when each frame was drawn.
    [[nodiscard]] nlohmann::json stats() const;

private:
    using Clock = std::chrono::steady_clock;

    /// A scene and what is kept of it on the GPU, in the order of their ends.
    struct Document {
        std::string path;
        std::unique_ptr<scene::Scene> scene;
        std::unique_ptr<scene::Renderer> renderer;
        scene::Bounds bounds;
        bool firstFrame = true; ///< none has been drawn
    };
    struct DrawnFrame {
        double at = 0.0; ///< seconds since the viewer was made
        int samples = 1; ///< a pixel
        std::map<std::string, double> timesMs;
        gl::WorkCounters counters;
    };

    Viewer(gl::Device& device, const ViewerOptions& options);
    [[nodiscard]] core::Result<Document> documentOf(std::string path, scene::Scene scene);
    /// @param number which of its scenes; absent: the file's own choice
    void openScene(const std::string& path, std::optional<int> number);
    void takeLight(DistantLight light);
    void showEnvironment();
    void takeLights(std::vector<lighting::DayLight> lights);
    /// Whether a lighting document is all the light.
    [[nodiscard]] bool onlyLights() const;
    void dropReplacingSkies();
    void moveHour(double hours);
    void playDay();
    void nextDaySpeed();
    void advanceDay(double seconds);
    [[nodiscard]] std::string hourText() const;
    void openEnvironment(const std::string& path);
    void press(const platform::KeyEvent& event);
    void perform(const KeyBinding& binding);
    void chooseCamera(int step);
    void chooseScene(int step);
    void chooseEstimator(const KeyBinding& binding);
    void play();
    void scrub(double seconds);
    void chooseAnimation(int animation);
    void advanceAnimation(double seconds);
    [[nodiscard]] std::string animationText() const;
    void drag(float x, float y);
    void wheel(float steps);
    void saveScreenshot();
    void toggleErrorView();
    /// Whether the error view wants a pass more: nothing has moved since the last frame.
    [[nodiscard]] bool errorPending() const;
    [[nodiscard]] core::Result<void> drawErrorPass();
    void showOverlay();
    void say(std::string message, bool isError);
    [[nodiscard]] scene::CameraPose& moved();
    [[nodiscard]] glm::vec3 flyDirection() const;
    [[nodiscard]] bool held(platform::Key key) const { return keys_.count(key) > 0; }
    [[nodiscard]] bool held(platform::PointerButton b) const { return buttons_.count(b) > 0; }
    [[nodiscard]] float aspect() const;
    [[nodiscard]] bool moving() const;
    void changed(bool measureAgain);
    void note(const scene::Frame& frame, int samplesPerSide);
    [[nodiscard]] std::string timeText() const;
    [[nodiscard]] std::vector<std::string> probeLines() const;

    gl::Device* device_;
    ViewerOptions options_;
    Overlay overlay_;
    lighting::Cubemap environment_;
    std::string environmentName_;
    core::Tally lightWarnings_;
    bool lightChosen_ = false; ///< by the options or dropped; otherwise a scene brings its own
    std::vector<lighting::DayLight> lights_;         ///< of the lighting document
    std::string lightsEstimator_;                    ///< how their maps are stored
    lighting::RsrmLayout ownMaps_ = lighting::kRsrm; ///< what the document has for `rsrm`
    bool dayPlaying_ = false;
    std::size_t daySpeed_ = 0;
    scene::RenderSettings settings_;
    scene::CameraRequest request_;
    Document document_;
    int sceneIndex_ = io::kNone; ///< as OpenedFile's
    int sceneCount_ = 1;
    int cameraIndex_ = 0;
    int animation_ = scene::kRestPose; ///< that the scene is posed by
    double time_ = 0.0;                ///< seconds into it
    bool playing_ = false;
    std::optional<scene::CameraPose> pose_; ///< once moved by hand

    std::set<platform::Key> keys_;
    std::set<platform::PointerButton> buttons_;
    std::optional<glm::vec2> pointer_;
    bool panning_ = false;

    float contentScale_ = 1.0f;
    bool help_ = false;
    bool textShown_ = true;
    bool fullScreen_ = false;
    bool closing_ = false;
    std::string message_;
    bool messageIsError_ = false;

    bool errorShown_ = false;        ///< the error view in place of the picture
    std::optional<ErrorView> error_; ///< of the last frame; none: no pass has been drawn
    gl::Texture errorPicture_;       ///< what is shown of it

    int framesWanted_ = 2;
    bool coarse_ = false; ///< the last frame had fewer samples than a still one
    double exposure_;     ///< stops
    double fineMs_ = 0.0; ///< of a frame with all samples
    Clock::time_point start_ = Clock::now();
    Clock::time_point lastMotion_ = start_;
    bool measured_ = false; ///< the first reading after a change has been dropped
    std::vector<double> readings_;
    int readingSamples_ = 0;
    std::shared_ptr<const plan::EffectPlan> plan_; ///< of the last frame
    std::vector<DrawnFrame> drawn_;
    std::uint64_t framesDrawn_ = 0;
    std::uint64_t screenshots_ = 0;
};

} // namespace lodestar::app
