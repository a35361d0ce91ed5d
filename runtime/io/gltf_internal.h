// SPDX-License-Identifier: MIT
//
// The steps of loadGltf, one file each. A document is checked as JSON first, where every finding
// has a JSON pointer; only then does tinygltf see a copy that holds nothing but checked, known
// keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "core/result.h"
#include "core/tally.h"
#include "io/file.h"
#include "io/gltf.h"
#include "io/gltf_problems.h"

namespace lodestar::io::detail {

using Json = nlohmann::json;

inline constexpr int kMaxJsonDepth = 64;
inline constexpr std::size_t kMaxJsonValues = 2'000'000;
inline constexpr std::size_t kMaxNodes = 100'000;
inline constexpr int kMaxNodeDepth = 256;
/// Buffers of one document, together.
inline constexpr std::size_t kMaxBufferBytes = std::size_t{1} << 30;
/// Decoded vertices and indices of one document, together.
inline constexpr std::size_t kMaxGeometryBytes = std::size_t{512} << 20;
/// Images of one document as texels, together; as much again may be read in encoded form.
inline constexpr std::size_t kMaxImageBytes = std::size_t{2} << 30;
/// Elements of an accessor that has no data (all zeros).
inline constexpr std::size_t kMaxZeroElements = std::size_t{1} << 20;
/// How far from 1 the length of a vector of 3 or of 4 may lie: what quantisation to 8 bits leaves,
/// as in Khronos' validator.
inline constexpr double kUnitTolerance3 = 0.00674;
inline constexpr double kUnitTolerance4 = 0.00769;
/// Where parseModel keeps a primitive's indices: tinygltf 2.7 refuses index accessors without data.
inline constexpr const char* kIndicesAttribute = "_LODESTAR_INDICES";

/// A document and the binary chunk that came with it.
struct GltfSource {
    Json document;
    Bytes binary;
    bool hasBinary = false;
};

/// Takes .gltf or .glb apart: lengths, JSON nesting and size first, then the JSON itself.
[[nodiscard]] core::Result<GltfSource> readContainer(Bytes bytes);

/// Version 2.x.
[[nodiscard]] core::Result<void> checkAsset(const Json& document);

/// No required extension that is not read.
void checkRequired(const Json& document, GltfProblems& problems);

/// Types, ranges, array lengths and references of every key that is read. False where the
/// document's arrays are none, and nothing more can be said.
[[nodiscard]] bool checkSchema(const Json& document, GltfProblems& problems);

/// What the standard asks beyond what loading needs: breaches that are mended or do no harm.
/// Refused elements are left out. @pre checkRanges
void checkRules(const Json& document, const std::vector<Bytes>& buffers, GltfProblems& problems);

/// Takes refused elements and what hangs on them out of a document, their places kept, so that the
/// rest can be looked at. @pre checkRanges
void cutOutRefused(Json& document, std::vector<Bytes>& buffers, GltfProblems& problems);

/// A copy with only the keys that checkSchema knows.
[[nodiscard]] Json knownKeys(const Json& document);

/// What one element of an accessor is.
struct ElementLayout {
    std::size_t components = 0;
    std::size_t componentBytes = 0;
    std::size_t bytes = 0; ///< with the padding of matrix columns
};

/// Layout by glTF's componentType and type; false for one that glTF does not have.
[[nodiscard]] bool elementLayout(int componentType, const std::string& type, ElementLayout& layout);

/// Buffer views within their buffers and accessors within their views.
void checkRanges(const Json& document, const std::vector<Bytes>& buffers, GltfProblems& problems);

/// Side files of one document.
class SideFiles {
public:
    [[nodiscard]] static core::Result<SideFiles> open(const std::filesystem::path& document,
                                                      const std::filesystem::path& assetRoot);
    /// A data: URI's bytes or a file's below the asset root.
    [[nodiscard]] core::Result<Bytes> read(const std::string& uri, std::size_t maxBytes) const;

private:
    explicit SideFiles(AssetRoot root) : root_(std::move(root)) {}
    AssetRoot root_;
    std::string prefix_; ///< from the root to the document's folder, "" or ending in "/"
};

/// Every buffer's bytes, cut to its byteLength; none where it was refused.
[[nodiscard]] std::vector<Bytes> loadBuffers(GltfSource& source, const SideFiles& files,
                                             GltfProblems& problems);

/// Runs tinygltf over the checked document. Buffers are handed over in memory; it opens no file and
/// sees no image.
[[nodiscard]] core::Result<tinygltf::Model> parseModel(const Json& document,
                                                       std::vector<Bytes> buffers);

/// Spends a limit; shared by everything that decodes.
class Budget {
public:
    explicit Budget(std::size_t bytes) : left_(bytes) {}
    [[nodiscard]] bool spend(std::size_t bytes) {
        if (bytes > left_) {
            return false;
        }
        left_ -= bytes;
        return true;
    }

private:
    std::size_t left_;
};

/// What the converting steps share.
struct GltfContext {
    const Json& document;
    const tinygltf::Model& model;
    GltfFile& file;
    GltfProblems& problems;
    Budget geometry{kMaxGeometryBytes};
};

/// An accessor as floats, element by element; normalised integers are mapped to [0, 1] or [-1, 1].
[[nodiscard]] core::Result<std::vector<float>> readFloats(GltfContext& context, int accessor,
                                                          bool forceNormalized = false);
/// A scalar accessor of unsigned integers.
[[nodiscard]] core::Result<std::vector<std::uint32_t>> readIndices(GltfContext& context,
                                                                   int accessor);

/// The converting steps: what is wrong is refused in the context's problems, a placeholder stands
/// in its place, and the rest is gone through.
void convertMeshes(GltfContext& context);
/// Turns strips, loops and fans into lists, by glTF's mode 0 to 6.
[[nodiscard]] std::vector<std::uint32_t> unrolled(const std::vector<std::uint32_t>& indices,
                                                  int mode);
/// Face normals for a triangle list that has none, vertices split.
void makeFlat(GltfPrimitive& primitive);
/// Zero and non-finite normals replaced by the mean of their triangles' normals.
void repairNormals(GltfPrimitive& primitive, core::Tally& warnings);
void repairTangents(GltfPrimitive& primitive, core::Tally& warnings);

/// JOINTS_n and WEIGHTS_n: every weight >= 0, 1 in all at a vertex.
/// @param at the primitive's JSON pointer
[[nodiscard]] core::Result<void> readInfluences(GltfContext& context,
                                                const tinygltf::Primitive& source,
                                                const std::string& at, GltfPrimitive& primitive);
/// Morph targets, as the document lists them. @param at the primitive's JSON pointer
[[nodiscard]] core::Result<void> readTargets(GltfContext& context, const Json& json,
                                             const std::string& at, GltfPrimitive& primitive);
/// The weights of a mesh's targets, 0 where the file says nothing; as many in every primitive.
void readTargetWeights(GltfContext& context, std::size_t mesh, GltfMesh& converted);
/// Refuses nodes whose own weights are not as many as their mesh's. @pre meshes are converted
void checkNodeWeights(GltfContext& context);
/// What the core specification and KHR_mesh_quantization let the components of an attribute be.
/// @param delta the attribute is a morph target's
[[nodiscard]] core::Result<void> checkComponents(const GltfContext& context,
                                                 const std::string& name,
                                                 const tinygltf::Accessor& accessor,
                                                 const std::string& at, bool delta);
/// The numbers of an accessor of the type, or an error at `at`.
/// @param types componentTypes allowed, for the message too
[[nodiscard]] core::Result<std::vector<float>>
readTyped(GltfContext& context, int accessor, const char* type, std::initializer_list<int> types,
          bool forceNormalized, const std::string& at);
/// Skins, and what the nodes with a skin say of it. @pre nodes and meshes are converted
void convertSkins(GltfContext& context);
/// @pre nodes and meshes are converted
void convertAnimations(GltfContext& context);

void convertMaterials(GltfContext& context);
/// Reads members that the schema's tables leave out, of an extension's object. The first fault is
/// kept and ends up in status(); what follows it reads as absent.
class ExtensionReader {
public:
    /// @param object the extension's value, or null: everything is absent then
    ExtensionReader(const Json* object, std::string at);

    [[nodiscard]] bool present() const { return object_ != nullptr; }
    [[nodiscard]] double number(const char* key, double otherwise);
    /// An array of as many finite numbers as there are values; left alone where it is absent.
    void numbers(const char* key, std::span<double> values);
    /// An index below size. @param what is counted, for people
    [[nodiscard]] std::optional<int> index(const char* key, std::size_t size, const char* what);
    void refuse(const std::string& what, const std::string& key);
    [[nodiscard]] const core::Result<void>& status() const { return status_; }

private:
    [[nodiscard]] const Json* find(const char* key) const;

    const Json* object_;
    std::string at_;
    core::Result<void> status_;
};

/// An extension's value in an object's "extensions", or null.
[[nodiscard]] const Json* extensionOf(const Json& object, const char* name);

/// KHR_texture_transform of a textureInfo. @param set replaced by the extension's texCoord
[[nodiscard]] core::Result<std::optional<glm::mat3x2>>
readTextureTransform(const Json& info, const std::string& at, int& set);
/// KHR_materials_unlit, _ior and the factors of _specular.
[[nodiscard]] core::Result<void> readMaterialExtensions(const Json& json, const std::string& at,
                                                        GltfMaterial& material,
                                                        core::Tally& warnings);
/// EXT_lights_image_based: the document's environments, and which one each scene has.
void convertEnvironments(GltfContext& context);

void convertTextures(GltfContext& context);
void convertCameras(GltfContext& context);
void convertLights(GltfContext& context);
void convertNodes(GltfContext& context);
void convertScenes(GltfContext& context);
/// @param all tries the images that nothing shows, too
void loadImages(GltfContext& context, const SideFiles& files, bool all);
/// Refuses image-based lights that a scene names and whose faces make no cube. @pre images are
/// decoded
void checkEnvironmentFaces(GltfContext& context);

[[nodiscard]] inline std::string pointer(const std::string& parent, std::size_t index) {
    return parent + "/" + std::to_string(index);
}

/// The member of an object, or null.
[[nodiscard]] inline const Json* member(const Json& object, const char* key) {
    if (!object.is_object()) {
        return nullptr;
    }
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

/// An array member's elements; none where it is absent.
[[nodiscard]] inline std::size_t memberSize(const Json& object, const char* key) {
    const Json* found = member(object, key);
    return found != nullptr && found->is_array() ? found->size() : 0;
}

} // namespace lodestar::io::detail
