// SPDX-License-Identifier: MIT
//
// glTF 2.0 files as validated plain data: every reference checked, every accessor decoded, every
// number finite. tinygltf is seen by gltf*.cpp only.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_precision.hpp>
#include <glm/mat3x2.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/result.h"
#include "core/tally.h"
#include "core/texels.h"
#include "io/gltf_problems.h"
#include "lighting/estimator.h"

namespace lodestar::io {

inline constexpr int kNone = -1; ///< an index that is absent

enum class Wrap { Repeat, MirroredRepeat, ClampToEdge };
enum class Filter { Nearest, Linear };
enum class MipFilter { None, Nearest, Linear };

/// A texture: an image and how to sample it. The image is decoded as stored (sRGB stays encoded).
struct GltfTexture {
    int image = kNone;
    Wrap wrapS = Wrap::Repeat;
    Wrap wrapT = Wrap::Repeat;
    Filter magnification = Filter::Linear;
    Filter minification = Filter::Linear;
    MipFilter mip = MipFilter::Linear;
};

struct GltfTextureRef {
    int texture = kNone;
    int uvSet = 0; ///< an index into GltfPrimitive::uvs
    /// KHR_texture_transform: texture coordinates from the set's, M (u, v, 1); absent if none.
    std::optional<glm::mat3x2> uvTransform = {};
};

enum class AlphaMode { Opaque, Mask, Blend };

/// How a texel of the exponent texture says the exponent.
enum class ExponentEncoding {
    Exponent, ///< texel x scale
    Log2,     ///< 2^(texel x scale) - 1
};

/// Blinn-Phong quantities given directly, in a material's `extras.lodestar`. They win over
/// metallic-roughness where present.
struct GltfBlinnPhong {
    std::optional<glm::vec3> diffuse; ///< k_L, linear [0, 1]
    std::optional<glm::vec3> f0;      ///< [0, 1]
    std::optional<float> exponent;    ///< [0, 1e7]; "mirror" in JSON is 1e7
    GltfTextureRef exponentTexture;   ///< red channel, linear
    ExponentEncoding exponentEncoding = ExponentEncoding::Log2;
    float exponentScale = 1.0f;
};

struct GltfMaterial {
    std::string name;
    /// How its glossy light is estimated, where a lighting document says so; no file does.
    std::optional<lighting::Estimator> specularEstimator{};
    glm::vec4 baseColor{1.0f}; ///< linear
    float metallic = 1.0f;
    float roughness = 1.0f;
    glm::vec3 emissive{0.0f};
    float normalScale = 1.0f;
    float occlusionStrength = 1.0f;
    GltfTextureRef baseColorTexture;         ///< sRGB
    GltfTextureRef metallicRoughnessTexture; ///< linear: g roughness, b metallic
    GltfTextureRef normalTexture;            ///< linear
    GltfTextureRef occlusionTexture;         ///< linear, red
    GltfTextureRef emissiveTexture;          ///< sRGB
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    bool unlit = false;                  ///< KHR_materials_unlit: the base colour is the radiance
    float ior = 1.5f;                    ///< KHR_materials_ior, [1, inf) or 0 (F0 = 1)
    float specular = 1.0f;               ///< KHR_materials_specular: scales a dielectric's F0
    glm::vec3 specularColor{1.0f};       ///< the same by colour, linear, >= 0
    GltfTextureRef specularTexture;      ///< linear, alpha
    GltfTextureRef specularColorTexture; ///< sRGB
    /// Which TEXCOORD_n of the file is GltfPrimitive::uvs[0] and [1] under this material.
    std::array<int, 2> uvSources{0, 1};
    std::optional<GltfBlinnPhong> blinnPhong;
    /// What a lighting document says in place of what metallic-roughness makes of a texel; no file
    /// does. Each stands for itself; without effect beside blinnPhong.
    std::optional<float> exponent{};    ///< [0, 1e7]
    std::optional<glm::vec3> diffuse{}; ///< times the base colour's texture and vertices' colours
    std::optional<glm::vec3> f0{};
};

enum class Topology { Points, Lines, Triangles };

/// Joints that move one vertex are given in sets of four.
inline constexpr std::size_t kInfluenceSets = 2;

/// What one morph target adds to a primitive's vertices at weight 1. Each list is empty or as long
/// as the primitive's positions.
struct GltfMorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

/// One drawable: decoded, indexed, strips and fans unrolled. normals are generated flat where a
/// triangle mesh has none (with vertices split as glTF asks); empty for points and lines without.
struct GltfPrimitive {
    Topology topology = Topology::Triangles;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;     ///< unit, or empty
    std::vector<glm::vec4> tangents;    ///< w is the handedness; empty if the file has none
    std::vector<glm::vec2> uvs[2];      ///< empty if absent
    std::vector<glm::vec4> colors;      ///< linear; empty if absent
    std::vector<std::uint32_t> indices; ///< every one < positions.size()
    int material = kNone;               ///< kNone: glTF's default material
    bool flatNormals = false;           ///< normals were generated: deformed faces make new ones
    /// Into the joints of the node's skin, by set; empty if absent. 0 where the weight is 0.
    std::vector<glm::u16vec4> joints[kInfluenceSets];
    std::vector<glm::vec4> weights[kInfluenceSets]; ///< >= 0, 1 in all at every vertex
    std::vector<GltfMorphTarget> targets;           ///< as many in all primitives of a mesh
};

struct GltfMesh {
    std::string name;
    std::vector<GltfPrimitive> primitives;
    std::vector<float> weights; ///< of the morph targets, one each; a node's win
};

/// How a sampler's values are joined between its times.
enum class Interpolation { Step, Linear, CubicSpline };

/// Keys over time. A key of CubicSpline holds an in-tangent, a value and an out-tangent.
struct GltfAnimationSampler {
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> times;  ///< seconds, >= 0, strictly increasing; empty if no channel reads it
    std::vector<float> values; ///< finite; key by key, `components` numbers each (3 times: spline)
    std::size_t components = 0; ///< of one value: 3, 4 (quaternion xyzw) or the number of targets
};

/// What of a node an animation moves.
enum class AnimationPath { Translation, Rotation, Scale, Weights };

struct GltfAnimationChannel {
    int node = kNone;
    AnimationPath path = AnimationPath::Translation;
    int sampler = 0; ///< of the same animation
};

/// No two channels of an animation move the same thing, and none the transform of a node with a
/// matrix.
struct GltfAnimation {
    std::string name;
    std::vector<GltfAnimationChannel> channels;
    std::vector<GltfAnimationSampler> samplers;
};

/// Joints that deform a mesh.
struct GltfSkin {
    std::string name;
    std::vector<int> joints;            ///< nodes; at least one
    std::vector<glm::mat4> inverseBind; ///< jointFromMesh in the bind pose, one a joint
    int skeleton = kNone;               ///< node; the joints' common root, for information
};

/// Right-handed, looks along -Z, +Y up.
struct GltfCamera {
    std::string name;
    bool perspective = true;
    float verticalFov = 0.8f;                           ///< radians, perspective
    float aspect = 0.0f;                                ///< 0: the viewport's
    float xMagnification = 1.0f, yMagnification = 1.0f; ///< orthographic half extents
    float nearPlane = 0.01f;
    float farPlane = std::numeric_limits<float>::infinity();
};

enum class LightKind { Directional, Point, Spot };

/// KHR_lights_punctual; shines along -Z of its node.
struct GltfLight {
    std::string name;
    LightKind kind = LightKind::Point;
    glm::vec3 color{1.0f};
    float intensity =
        1.0f; ///< lux for directional (= irradiance), candela else (= radiant intensity)
    float range = std::numeric_limits<float>::infinity(); ///< metres
    float innerConeAngle = 0.0f;                          ///< radians
    float outerConeAngle = 0.785398163f;                  ///< radians, (inner, pi/2]
};

struct GltfNode {
    std::string name;
    int parent = kNone;
    std::vector<int> children;
    bool hasMatrix = false;
    glm::mat4 matrix{1.0f}; ///< parentFromNode; composed from TRS unless hasMatrix
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    int mesh = kNone;
    int camera = kNone;
    int light = kNone;
    int skin = kNone;                   ///< kNone unless the node has a mesh with joints
    std::vector<float> weights;         ///< of its mesh's morph targets; empty: the mesh's own
    std::uint32_t layers = 0xffffffffu; ///< `extras.lodestar.layers`: light probes that share a bit
};

/// EXT_lights_image_based. Its irradiance coefficients are not kept: irradiance is made from the
/// images.
struct GltfEnvironment {
    std::string name;
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f}; ///< worldFromEnvironment, unit
    float intensity = 1.0f;                     ///< [0, 1e9]
    std::array<int, 6> faces{}; ///< images in GL order, first row at t = 0: colours / alpha (RGBD)
};

struct GltfScene {
    std::string name;
    std::vector<int> roots;
    int environment = kNone;
};

/// What an image was in the file.
struct GltfImageInfo {
    std::string name;
    std::string format; ///< "png", "jpeg", ...; empty where it could not be read
    int width = 0;
    int height = 0;
    int channels = 0;
};

/// A whole file. All indices are valid or kNone; the nodes of a scene form a forest.
struct GltfFile {
    std::vector<GltfScene> scenes;
    int defaultScene = kNone; ///< scene 0 if the file names none; kNone if it has none
    std::vector<GltfNode> nodes;
    std::vector<GltfMesh> meshes;
    std::vector<GltfMaterial> materials;
    std::vector<GltfTexture> textures;
    /// As stored; 1x1 white where decoding failed (counted), empty where nothing shows the image.
    std::vector<core::Texels> images;
    std::vector<GltfImageInfo> imageInfos; ///< as many; without sizes where nothing was decoded
    std::vector<GltfCamera> cameras;
    std::vector<GltfLight> lights;
    std::vector<GltfEnvironment> environments;
    std::vector<GltfAnimation> animations;
    std::vector<GltfSkin> skins;
    std::vector<std::string> extensionsUsed;
    std::vector<std::string> extensionsRequired;
    std::size_t bufferBytes = 0; ///< of all buffers
    core::Tally warnings;        ///< what was repaired or ignored

    /// Whether the file lists an extension as used or required.
    [[nodiscard]] bool extensionListed(const std::string& name) const;
};

/// Whether an extension's content is read.
[[nodiscard]] bool isSupportedExtension(std::string_view name);

struct GltfOptions {
    std::filesystem::path assetRoot; ///< empty: the file's own folder
};

/// Loads .gltf or .glb. @errors InputRefused with the JSON pointer or byte of what is wrong
[[nodiscard]] core::Result<GltfFile> loadGltf(const std::filesystem::path& path,
                                              const GltfOptions& options = {});

/// A file and everything that is wrong with it.
struct GltfCheck {
    std::optional<GltfFile> file; ///< what loadGltf gives; none where it refuses
    GltfProblems problems;
};

/// The steps of loadGltf, which go on behind a problem as far as is safe, with the images that
/// nothing shows, and the standard's rules that loading can do without.
[[nodiscard]] GltfCheck checkGltf(const std::filesystem::path& path,
                                  const GltfOptions& options = {});

} // namespace lodestar::io
