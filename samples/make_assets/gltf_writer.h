// SPDX-License-Identifier: MIT
//
// Writes glTF 2.0: a .gltf of JSON beside a .bin of vertex data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "core/result.h"
#include "shapes.h"

namespace lodestar::samples {

using Json = nlohmann::ordered_json;

/// Keys of one quantity of a node.
struct AnimationChannel {
    int node = 0;
    std::string path;              ///< "translation", or "rotation"
    std::vector<float> times;      ///< seconds, ascending
    std::vector<glm::vec3> places; ///< of a translation, one a time
    std::vector<glm::quat> turns;  ///< of a rotation
};

/// How a camera stands that looks from one point at another.
[[nodiscard]] glm::quat lookRotation(const glm::vec3& eye, const glm::vec3& target);

/// One glTF file in the making; the functions return the index of what they added.
class GltfWriter {
public:
    explicit GltfWriter(std::string name);

    /// A texture beside the file, repeating, with mip levels. The same file is added once.
    int addTexture(const std::string& uri);

    /// A material in glTF's own JSON.
    int addMaterial(const Json& material);

    /// A material of Blinn-Phong quantities: glTF's metallic-roughness as other readers should see
    /// it, and extras.lodestar as ours does. `exponent` is a number or "mirror".
    int addBlinnPhong(const std::string& name, const glm::vec3& diffuse, const glm::vec3& f0,
                      const Json& exponent);

    int addMesh(const std::string& name, const Mesh& mesh, int material);

    /// A mesh of the same vertices as an earlier one, which they share, in another material.
    int addMeshLike(const std::string& name, int mesh, int material);

    int addNode(const std::string& name, int mesh, const glm::vec3& position,
                const glm::quat& rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f), float scale = 1.0f);

    /// A camera at `eye` looking at `target`. @param fovDegrees vertical
    int addCamera(const std::string& name, const glm::vec3& eye, const glm::vec3& target,
                  float fovDegrees);

    /// The node of a camera.
    [[nodiscard]] int cameraNode(int camera) const;

    /// A node that shines to all sides. @param candela [cd]  @param range metres
    int addPointLight(const std::string& name, const glm::vec3& position, const glm::vec3& color,
                      float candela, float range);

    /// Says that the file uses an extension.
    void useExtension(const std::string& extension);

    /// An animation of linear keys.
    void addAnimation(const std::string& name, const std::vector<AnimationChannel>& channels);

    /// Writes NAME.gltf and NAME.bin into a folder. @errors OutputFailed
    [[nodiscard]] core::Result<void> write(const std::filesystem::path& folder) const;

    /// The JSON of a material, to add to it.
    [[nodiscard]] Json& material(int index);

private:
    int addAccessor(const void* data, std::size_t count, int components, int componentType,
                    bool vertices = true);
    void addBounds(int accessor, const std::vector<glm::vec3>& positions);

    std::string name_;
    Json root_;
    std::vector<unsigned char> bytes_;
};

/// A turn about +Y, degrees, counter-clockwise from above.
[[nodiscard]] glm::quat turn(float degrees);

} // namespace lodestar::samples
