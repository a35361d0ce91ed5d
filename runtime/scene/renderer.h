// SPDX-License-Identifier: MIT
//
// The built-in forward renderer: plans a frame, makes ready what the plan says, draws, reads back
// or shows the frame in a window.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "lighting/day.h"
#include "lighting/environment.h"
#include "lighting/estimator.h"
#include "plan/effect_plan.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// One material for every draw, for furnaces and comparisons.
struct MaterialOverride {
    glm::vec3 diffuse{1.0f};
    glm::vec3 f0{0.0f};
    float exponent = 0.0f;
    bool operator==(const MaterialOverride&) const = default;
};

struct RenderSettings {
    int width = 960;
    int height = 640;
    int samplesPerSide = 1; ///< supersampling: samplesPerSide^2 samples a pixel
    lighting::Estimator specular = lighting::kDefaultSpecular;
    lighting::Estimator diffuse = lighting::kDefaultDiffuse;
    lighting::LobeForm lobes = lighting::LobeForm::Power; ///< of analytic lights' highlights
    lighting::FresnelForm fresnel = lighting::FresnelForm::Schlick;
    bool backdrop = true;
    double hour = 15.0;   ///< local solar time of the lights; finite, wrapped into [0, 24)
    bool seamless = true; ///< false filters each cube face on its own, for comparison only
    std::optional<MaterialOverride> materialOverride;
    /// `auto` waits for the errors that it chooses by; else frames use `tent` until they are there.
    bool waitForForecast = true;
    int faceBudget = 1000000; ///< faces of light probes that a frame draws, at most
    /// Milliseconds of the GPU's time that a frame spends on light probes, by what they took
    /// before, at most, but for one face and light that must be made; infinite: unbounded.
    double probeBudgetMs = std::numeric_limits<double>::infinity();
    /// Light probes capture again where bounced light may have changed by more than that share.
    double lightThreshold = 0.1;
    bool operator==(const RenderSettings&) const = default;
};

/// A frame and what it took.
struct Frame {
    core::Image radiance; ///< 4 channels, linear, premultiplied by coverage; every value finite
    std::shared_ptr<const plan::EffectPlan> plan; ///< the last frame's where nothing has changed
    gl::WorkCounters counters;                    ///< of this frame
    std::map<std::string, double> timesMs;        ///< by step
    std::uint64_t repairedPixels = 0;             ///< pixels that were not finite and are now 0
};

/// The share of a reference's taps that one picture takes: first, first + step ... below total.
struct ReferenceTaps {
    int first = 0;
    int step = 1;
    int total = 1024; ///< [1, 16384]
};

/// What the planner is told of a scene seen through a view.
[[nodiscard]] plan::PlanInput planInput(const Scene& scene, const View& view,
                                        const RenderSettings& settings,
                                        const plan::EnvironmentView& environment);

/// The same of a first frame under skies and suns too. @param lights as lighting::repaired leaves
/// them  @param layout of their maps
[[nodiscard]] plan::PlanInput planInput(const Scene& scene, const View& view,
                                        const RenderSettings& settings,
                                        plan::EnvironmentView environment,
                                        const std::vector<lighting::DayLight>& lights,
                                        const lighting::RsrmLayout& layout = lighting::kRsrm);

/// Draws one scene under one environment, day lights, or both. The scene must outlive the renderer
/// unchanged but for its pose, node transforms and morph weights, and what materialsChanged says.
class Renderer {
public:
    /// Uploads what the scene needs. @errors NoOpenGl if the driver has no memory for it
    [[nodiscard]] static core::Result<std::unique_ptr<Renderer>> make(gl::Device& device,
                                                                      const Scene& scene);
    /// Another scene under another renderer's light: with its textures, and in every frame with the
    /// environment and the lights that are set there. Light probes are not shared.
    /// @param scene its materials name textures of the other's scene; it has no images
    /// @errors as make
    [[nodiscard]] static core::Result<std::unique_ptr<Renderer>>
    makeBeside(gl::Device& device, const Scene& scene, const Renderer& other);
    ~Renderer();

    /// Sets the distant environment. @param source its name, for the plan  @param base level 0
    void setEnvironment(std::string source, lighting::Cubemap base);
    /// Sets the skies and suns, in place of those set before. Without an environment they are all
    /// the light, the backdrop too; beside one suns add to it, and a sky stands in its place unless
    /// it says `add`. What of their keys is as it was is not baked again.
    /// @param lights as lighting::repaired leaves them
    /// @param layout how their maps are stored
    void setLights(std::vector<lighting::DayLight> lights,
                   const lighting::RsrmLayout& layout = lighting::kRsrm);
    /// To be called where numbers, colours or estimators of the scene's materials have changed, or
    /// an estimator's choice beside another renderer; textures that they name must have been
    /// uploaded.
    void materialsChanged();
    /// To be called where the scene's light probes have been set anew or their values have changed.
    /// Those that capture as before keep what they hold; where they stand elsewhere they capture
    /// again.
    void probesChanged();
    /// Counts of lights and shadows beyond what a frame holds.
    [[nodiscard]] const core::Tally& lightWarnings() const;

    /// Counts of light probes that got less than they asked for.
    [[nodiscard]] const core::Tally& probeWarnings() const;

    /// Whether the last frame used `tent` where `auto` has not chosen yet: the next may look
    /// better.
    [[nodiscard]] bool awaitsForecast() const;

    /// Light probes stand in the order of the scene's nodes.
    [[nodiscard]] std::size_t probeCount() const;
    [[nodiscard]] const std::string& probeName(std::size_t probe) const;
    /// Asks for a capture, whatever the probe's update policy.
    void requestProbe(std::size_t probe);
    /// Whether a probe lights what it holds: it has been captured whole.
    [[nodiscard]] bool isProbeReady(std::size_t probe) const;
    /// How far the faces that it captures anew have come, [0, 1]; they show when all have been
    /// drawn.
    [[nodiscard]] double probeProgress(std::size_t probe) const;
    /// A face of what a probe lights with, as GpuProbes::read.
    [[nodiscard]] core::Image readProbe(std::size_t probe, int face, int level = 0) const;

    /// @errors NoOpenGl, Internal (a shader that the driver refuses)
    [[nodiscard]] core::Result<Frame> render(const View& view, const RenderSettings& settings);

    /// The same picture, shown in the context's own framebuffer 0 as a PNG would hold it, and not
    /// read back: Frame::radiance is empty and repaired pixels are not counted.
    /// @param exposure factor on radiance, > 0
    /// @param framebuffer that it is shown in instead, from its lower left
    [[nodiscard]] core::Result<Frame> draw(const View& view, const RenderSettings& settings,
                                           float exposure, unsigned framebuffer = 0);

    /// What the last frame drew once more, one sample a pixel, in front of nothing: every value 0
    /// where there is no surface. All is as it was in the frame but for light from afar.
    /// @param taps the mean of the environment, skies and suns over each lobe by so many taps, as
    /// docs/estimators.md says of `--error-view`; none: by the settings' estimators and the maps
    /// @pre the last call was render or draw, with this view and these settings but for
    /// samplesPerSide
    /// @errors NoOpenGl, Internal, as render
    [[nodiscard]] core::Result<core::Image> redraw(const View& view, const RenderSettings& settings,
                                                   const std::optional<ReferenceTaps>& taps);

private:
    friend class RendererUpload;
    struct State;
    explicit Renderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// A renderer in the making: with each step a part of its scene goes to the GPU, so that others can
/// draw in between.
class RendererUpload {
public:
    /// @param scene as the renderer's
    /// @param light whose environment and lights shine on it too, as beside another; it may go
    /// first. Null: its own, none yet
    RendererUpload(gl::Device& device, const Scene& scene, const Renderer* light = nullptr);
    ~RendererUpload();
    /// Uploads the vertices, then a texture at a time.
    /// @return the renderer once all is there, null before  @errors as Renderer::make
    [[nodiscard]] core::Result<std::unique_ptr<Renderer>> step();
    /// Of its steps that are done, [0, 1].
    [[nodiscard]] double share() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace lodestar::scene
