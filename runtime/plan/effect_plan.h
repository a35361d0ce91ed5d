// SPDX-License-Identifier: MIT
//
// The plan of a frame: which effects run and which are skipped, each with its reason and its
// expected cost. A pure function of its input; no GL.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lighting/environment.h"
#include "lighting/estimator.h"
#include "plan/probe_plan.h"

namespace lodestar::plan {

/// What a draw's shader must be able to do. Bits of a set.
enum class Feature : std::uint64_t {
    Normals = 1u << 0,
    Tangents = 1u << 1,
    VertexColors = 1u << 2,
    BaseColorTexture = 1u << 3,
    MetallicRoughnessTexture = 1u << 4,
    NormalTexture = 1u << 5,
    OcclusionTexture = 1u << 6,
    EmissiveTexture = 1u << 7,
    BlinnPhong = 1u << 8, ///< k_L, F0 and exponent given, not converted from metallic-roughness
    ExponentTexture = 1u << 9,
    AlphaMask = 1u << 10,
    AlphaBlend = 1u << 11,
    PunctualLights = 1u << 12,
    Environment = 1u << 13,
    TextureTransform = 1u << 14,     ///< some texture's coordinates are transformed
    Unlit = 1u << 15,                ///< the base colour is the radiance; no light is asked for
    SpecularTexture = 1u << 16,      ///< scales a dielectric's F0
    SpecularColorTexture = 1u << 17, ///< the same by colour
    Skinning = 1u << 18,             ///< four joints a vertex
    SecondJoints = 1u << 19,         ///< four more
    RsrmLights = 1u << 20,           ///< skies and suns as radially symmetric maps
    Shadows = 1u << 21,              ///< some sun is hidden by what stands before it
    RsrmMirror = 1u << 22,           ///< lobes sharper than the maps' last row show the gradients
    Probe = 1u << 23,                ///< a light probe holds it
    SecondProbe = 1u << 24,          ///< and another
    Tent = 1u << 25,                 ///< glossy light by an estimator of its own, not the frame's
    Ring3 = 1u << 26,
    Ring7 = 1u << 27,
    Taps32 = 1u << 28,
    Taps64 = 1u << 29,
    SgLobes = 1u << 30,                  ///< highlights of analytic lights are spherical Gaussians
    SgFresnel = 1u << 31,                ///< Fresnel's reflectance is a spherical Gaussian's
    ProbeSkies = std::uint64_t{1} << 32, ///< a probe that holds it keeps the sky's part apart
    RsrmRows = std::uint64_t{1} << 33,   ///< the maps' rows were given one by one
};

using Features = std::uint64_t;

[[nodiscard]] constexpr Features bit(Feature feature) {
    return static_cast<Features>(feature);
}
[[nodiscard]] constexpr bool has(Features set, Feature feature) {
    return (set & bit(feature)) != 0;
}
/// The feature of a glossy estimator that a draw may have of its own.
[[nodiscard]] std::optional<Feature> estimatorFeature(const lighting::Estimator& estimator);
/// The estimator of such features; absent where a set has none.
[[nodiscard]] std::optional<lighting::Estimator> estimatorOf(Features set);

/// Lower-case names of the bits, in order, e.g. "normal-texture".
[[nodiscard]] std::vector<std::string> featureNames(Features set);

/// One drawable as the planner sees it.
struct DrawView {
    std::string subject; ///< "node/mesh" for people
    Features features = 0;
    bool visible = true; ///< inside the view
    bool diffuse = true; ///< reflects diffusely anywhere
    bool glossy = true;  ///< reflects glossily anywhere
    bool lit = true;     ///< takes light at all; false for unlit materials
    bool blended = false;
    bool casts = true; ///< a shadow: triangles that are not blended
    /// Phong exponent of its sharpest lookup; infinite where a texture gives it.
    double sharpest = std::numeric_limits<double>::infinity();
    double bluntest = 0.0; ///< of its bluntest; 0 where a texture gives it
    /// How its glossy light is estimated; `auto` where nothing is foreseen yet.
    lighting::Estimator specular = lighting::kDefaultSpecular;
    double toleratedError = 0.0; ///< of `auto`, relative RMSE; 0: none was named
    double foreseenError = 0.0;  ///< of what it chose
    float screenShare = 0.0f;    ///< of the picture that it may cover, [0, 1]
    float distance = 0.0f;       ///< metres along the view, for the order of blended draws
    /// Draws of one geometry, one material and one winding are one call to the driver.
    std::uint64_t geometry = 0;
    std::uint32_t material = 0;
    bool mirrored = false; ///< its triangles wind the other way
    int indexCount = 0;
    std::uint64_t morphBytes = 0;    ///< of its vertices with morph targets added; 0: it has none
    bool weightsChanged = true;      ///< of its morph targets, since they were last added
    glm::vec3 low{0.0f}, high{0.0f}; ///< world box about it
    std::uint32_t layers = 0xffffffffu; ///< captured where it shares a bit with the probe's
    bool operator==(const DrawView&) const = default;
};

struct EnvironmentView {
    std::string source;       ///< as the user named it
    int width = 256;          ///< face width, texels
    bool changed = true;      ///< since the previous plan
    bool present = true;      ///< false: there is none, or a sky light stands in its place
    std::string replacedBy{}; ///< the sky light; empty: there is none
    bool operator==(const EnvironmentView&) const = default;
};

/// A sky or a sun as the planner sees it at the frame's hour.
struct RsrmLightView {
    std::string subject;
    bool shines = true;            ///< false for a sun below the horizon
    bool changed = true;           ///< its blend of keys, since it was uploaded
    std::uint64_t texels = 0;      ///< of its map and gradient
    std::uint64_t uploadBytes = 0; ///< of the same
    bool sky = false;              ///< else a sun
    int shadow = -1;               ///< its layer of the shadow maps; -1: it casts none
    bool shadowChanged = true;     ///< it or a caster moved since that was drawn
    bool operator==(const RsrmLightView&) const = default;
};

/// A captured environment as the planner sees it.
struct CaptureView {
    std::string subject;
    std::array<bool, 6> missing{}; ///< faces that have been asked for and not been drawn
    bool complete = true;          ///< it shows what an earlier capture drew
    bool operator==(const CaptureView&) const = default;
};

/// Everything the plan depends on.
struct PlanInput {
    std::vector<DrawView> draws;
    EnvironmentView environment;
    int lightCount = 0;
    std::vector<RsrmLightView> rsrmLights;
    bool rsrmPublished = false;           ///< the layout of their maps
    double rsrmGreatestExponent = 2048.0; ///< Phong exponent of their maps' last row
    bool rsrmRows = false;                ///< their maps' rows were given one by one
    std::uint64_t shadowTexels = 0;       ///< of one shadow map
    /// Instances stand in pages, those of the draws, then the casters'; no call reads two of them.
    std::size_t instancesPerPage = std::numeric_limits<std::size_t>::max();
    std::vector<CaptureView> captures;
    int faceBudget = 0; ///< faces captured in a frame, at most
    /// Milliseconds of a frame for light probes by what they took before, at most, but for one face
    /// and the light that must be made.
    double probeBudgetMs = std::numeric_limits<double>::infinity();
    /// Faces are drawn after the plan is executed: what they complete, a later plan publishes.
    bool facesComeLater = false;
    std::vector<ProbeView> probes;
    lighting::Estimator specular = lighting::kDefaultSpecular;
    lighting::Estimator diffuse = lighting::kDefaultDiffuse;
    lighting::LobeForm lobes = lighting::LobeForm::Power; ///< of analytic lights' highlights
    lighting::FresnelForm fresnel = lighting::FresnelForm::Schlick;
    bool jointsMoved = true;      ///< since they were last uploaded
    std::uint64_t jointBytes = 0; ///< of all skins' joints
    bool backdrop = true;
    std::uint64_t pixels = 0;                ///< shaded in a frame
    lighting::PreparedParts alreadyPrepared; ///< from earlier frames, of the same environment
    bool operator==(const PlanInput&) const = default;
};

enum class Decision { Run, Skip };

/// Expected work, in the units of the counters.
struct Cost {
    std::uint64_t draws = 0;
    std::uint64_t passes = 0;
    std::uint64_t texelsWritten = 0;
    std::uint64_t uploadBytes = 0;
    bool operator==(const Cost&) const = default;
};

struct Effect {
    std::string effect;  ///< "environment-mips", "irradiance", "skinning", "draw", ...
    std::string subject; ///< what it acts on
    Decision decision = Decision::Run;
    std::string reason; ///< a sentence for people
    Cost cost;
    std::vector<int> faces{}; ///< of a probe's capture, in OpenGL's order
    bool operator==(const Effect&) const = default;
};

/// Neighbours in an order of draws that are one call to the driver.
struct Batch {
    std::size_t first = 0;
    std::size_t count = 0;
    bool mirrored = false; ///< DrawView::mirrored of them all
    bool operator==(const Batch&) const = default;
};

/// A sky or a sun that a frame is lit by.
struct LitLight {
    std::size_t light = 0;   ///< into PlanInput::rsrmLights
    bool blend = false;      ///< its map is made and uploaded in this frame
    int shadow = -1;         ///< layer of its shadow map; -1: nothing is hidden from it
    bool drawShadow = false; ///< that is drawn in this frame
    bool sky = false;        ///< it stands behind what light probes have captured
    bool operator==(const LitLight&) const = default;
};

/// A face to be captured.
struct CaptureFace {
    std::size_t capture = 0; ///< into PlanInput::captures
    int face = 0;            ///< OpenGL's order
    bool operator==(const CaptureFace&) const = default;
};

/// A face of a probe, and what is drawn into it.
struct ProbeFace {
    std::size_t probe = 0;              ///< into PlanInput::probes
    int face = 0;                       ///< OpenGL's order
    std::vector<std::size_t> drawOrder; ///< indices into PlanInput::draws
    std::vector<Features> drawFeatures; ///< in its order
    std::vector<ProbeChoice> choices;   ///< in its order; never the probe itself
    std::vector<Batch> batches;         ///< of its order
    bool operator==(const ProbeFace&) const = default;
};

/// What is made of a probe's captured faces, after they are drawn.
struct ProbeWork {
    std::size_t probe = 0;
    bool publish = false; ///< the faces drawn since the last take the place of the old ones
    int fadeLeft = 1;     ///< frames, this one too, until it shows fully: 1 / that of the way now
    bool compose = false; ///< the sky behind the captured geometry, into level 0
    int lastLevel = 0;    ///< the mip levels 1 to this are made
    bool irradiance = false; ///< its irradiance is made
    bool operator==(const ProbeWork&) const = default;
};

struct EffectPlan {
    std::vector<Effect> effects;
    std::vector<CaptureFace> captureFaces;
    std::vector<ProbeFace> probeFaces;    ///< in the order in which they are drawn
    std::vector<ProbeWork> probeWork;     ///< one a probe that needs any
    std::vector<ProbeChoice> drawChoices; ///< in drawOrder's order; empty where there are no probes
    lighting::PreparedParts prepare;      ///< parts to make now
    std::vector<std::size_t>
        drawOrder; ///< indices into PlanInput::draws: opaque, then blended back to front
    std::vector<Features> drawFeatures; ///< shader features, in drawOrder's order
    std::vector<Batch> batches;         ///< of drawOrder
    std::vector<LitLight> rsrmLights;   ///< suns with a shadow map, other suns, skies
    bool rsrmPublished = false;         ///< the layout of their maps
    std::vector<Batch> casterBatches;   ///< of casters
    std::vector<std::size_t> casters;   ///< indices into PlanInput::draws, of every map drawn
    /// Draws whose joints and morphs must be up to date: those drawn, and the casters.
    std::vector<std::size_t> deformed;
    bool backdrop = false;
    Features backdropFeatures = 0;
    Features skyFeatures = 0; ///< which of the environment and the lights are behind everything

    /// How many of the lights have a shadow map: the first ones.
    [[nodiscard]] std::size_t shadowedLights() const;
    /// How many of the lights are suns: the first ones.
    [[nodiscard]] std::size_t suns() const;
    /// Whether an effect of this name runs.
    [[nodiscard]] bool runs(const std::string& effect) const;
    bool operator==(const EffectPlan&) const = default;
};

/// A plan in words, a line an effect.
[[nodiscard]] std::string planText(const EffectPlan& plan);

/// Decides a frame. The same input gives the same plan.
[[nodiscard]] EffectPlan plan(const PlanInput& input);

} // namespace lodestar::plan
