// SPDX-License-Identifier: MIT
#include "gltf_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include "io/file.h"

namespace lodestar::samples {
namespace {

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

Json array(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

/// glTF's roughness for a Blinn-Phong exponent, for other readers: alpha^2 = 2 / (s + 2).
float roughnessFromExponent(const Json& exponent) {
    const float s = exponent.is_number() ? exponent.get<float>() : 1e7f;
    return std::min(std::pow(2.0f / (s + 2.0f), 0.25f), 1.0f);
}

} // namespace

GltfWriter::GltfWriter(std::string name) : name_(std::move(name)) {
    root_["asset"] = {{"version", "2.0"}, {"generator", "lodestar-make-assets"}};
    root_["scene"] = 0;
    root_["scenes"] = Json::array({{{"name", name_}, {"nodes", Json::array()}}});
    for (const char* list : {"nodes", "meshes", "materials", "accessors", "bufferViews"}) {
        root_[list] = Json::array();
    }
}

int GltfWriter::addTexture(const std::string& uri) {
    Json& images = root_["images"];
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (images[i]["uri"] == uri) {
            return static_cast<int>(i);
        }
    }
    images.push_back({{"uri", uri}});
    if (!root_.contains("samplers")) { // linear, between levels too; repeating
        root_["samplers"] = Json::array(
            {{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}}});
    }
    root_["textures"].push_back({{"source", images.size() - 1}, {"sampler", 0}});
    return static_cast<int>(images.size()) - 1;
}

int GltfWriter::addMaterial(const Json& material) {
    root_["materials"].push_back(material);
    return static_cast<int>(root_["materials"].size()) - 1;
}

int GltfWriter::addBlinnPhong(const std::string& name, const glm::vec3& diffuse,
                              const glm::vec3& f0, const Json& exponent) {
    const float reflectance = std::max({f0.x, f0.y, f0.z});
    const bool metal = reflectance > 0.15f;
    Json base = array(metal ? f0 : diffuse);
    base.push_back(1.0f);
    return addMaterial(
        {{"name", name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", base},
           {"metallicFactor", metal ? 1.0f : 0.0f},
           {"roughnessFactor", roughnessFromExponent(exponent)}}},
         {"extras",
          {{"lodestar",
            {{"diffuse", array(diffuse)}, {"f0", array(f0)}, {"exponent", exponent}}}}}});
}

Json& GltfWriter::material(int index) {
    return root_["materials"][static_cast<std::size_t>(index)];
}

int GltfWriter::addAccessor(const void* data, std::size_t count, int components, int componentType,
                            bool vertices) {
    static const char* const kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const std::size_t size = count * static_cast<std::size_t>(components) * 4;
    const std::size_t offset = bytes_.size();
    bytes_.resize(offset + size);
    std::memcpy(bytes_.data() + offset, data, size);
    const bool indices = componentType == kUnsignedInt;
    Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
    if (vertices) {
        view["target"] = indices ? kElementArrayBuffer : kArrayBuffer;
    }
    root_["bufferViews"].push_back(view);
    root_["accessors"].push_back({{"bufferView", root_["bufferViews"].size() - 1},
                                  {"componentType", componentType},
                                  {"count", count},
                                  {"type", kTypes[components]}});
    return static_cast<int>(root_["accessors"].size()) - 1;
}

void GltfWriter::addBounds(int accessor, const std::vector<glm::vec3>& positions) {
    glm::vec3 lo(std::numeric_limits<float>::max());
    glm::vec3 hi(std::numeric_limits<float>::lowest());
    for (const glm::vec3& p : positions) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    Json& json = root_["accessors"][static_cast<std::size_t>(accessor)];
    json["min"] = array(lo);
    json["max"] = array(hi);
}

int GltfWriter::addMesh(const std::string& name, const Mesh& mesh, int material) {
    const std::size_t count = mesh.positions.size();
    Json attributes;
    attributes["POSITION"] = addAccessor(mesh.positions.data(), count, 3, kFloat);
    addBounds(attributes["POSITION"].get<int>(), mesh.positions);
    attributes["NORMAL"] = addAccessor(mesh.normals.data(), count, 3, kFloat);
    const std::string look =
        material >= 0 ? root_["materials"][static_cast<std::size_t>(material)].dump() : "";
    if (look.find("\"normalTexture\"") != std::string::npos) { // tangents serve a normal map only
        attributes["TANGENT"] = addAccessor(mesh.tangents.data(), count, 4, kFloat);
    }
    if (look.find("Texture\"") != std::string::npos) {
        attributes["TEXCOORD_0"] = addAccessor(mesh.uvs.data(), count, 2, kFloat);
    }
    if (!mesh.uvs1.empty()) {
        attributes["TEXCOORD_1"] = addAccessor(mesh.uvs1.data(), count, 2, kFloat);
    }
    const int indices = addAccessor(mesh.indices.data(), mesh.indices.size(), 1, kUnsignedInt);
    Json primitive{{"attributes", attributes}, {"indices", indices}};
    if (material >= 0) {
        primitive["material"] = material;
    }
    root_["meshes"].push_back({{"name", name}, {"primitives", Json::array({primitive})}});
    return static_cast<int>(root_["meshes"].size()) - 1;
}

int GltfWriter::addMeshLike(const std::string& name, int mesh, int material) {
    Json copy = root_["meshes"][static_cast<std::size_t>(mesh)];
    copy["name"] = name;
    copy["primitives"][0]["material"] = material;
    root_["meshes"].push_back(copy);
    return static_cast<int>(root_["meshes"].size()) - 1;
}

int GltfWriter::addNode(const std::string& name, int mesh, const glm::vec3& position,
                        const glm::quat& rotation, float scale) {
    Json node{{"name", name}, {"mesh", mesh}, {"translation", array(position)}};
    if (rotation != glm::quat(1.0f, 0.0f, 0.0f, 0.0f)) {
        node["rotation"] = Json::array({rotation.x, rotation.y, rotation.z, rotation.w});
    }
    if (scale != 1.0f) {
        node["scale"] = array(glm::vec3(scale));
    }
    root_["nodes"].push_back(node);
    const int index = static_cast<int>(root_["nodes"].size()) - 1;
    root_["scenes"][0]["nodes"].push_back(index);
    return index;
}

glm::quat lookRotation(const glm::vec3& eye, const glm::vec3& target) {
    const glm::vec3 back = glm::normalize(eye - target); // a camera looks along its -Z
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), back));
    return glm::normalize(glm::quat_cast(glm::mat3(right, glm::cross(back, right), back)));
}

int GltfWriter::addCamera(const std::string& name, const glm::vec3& eye, const glm::vec3& target,
                          float fovDegrees) {
    const glm::quat rotation = lookRotation(eye, target);
    root_["cameras"].push_back(
        {{"name", name},
         {"type", "perspective"},
         {"perspective",
          {{"yfov", glm::radians(fovDegrees)}, {"znear", 0.05f}, {"zfar", 200.0f}}}});
    root_["nodes"].push_back(
        {{"name", name},
         {"camera", root_["cameras"].size() - 1},
         {"translation", array(eye)},
         {"rotation", Json::array({rotation.x, rotation.y, rotation.z, rotation.w})}});
    root_["scenes"][0]["nodes"].push_back(root_["nodes"].size() - 1);
    return static_cast<int>(root_["cameras"].size()) - 1;
}

int GltfWriter::cameraNode(int camera) const {
    const Json& nodes = root_["nodes"];
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].contains("camera") && nodes[i]["camera"] == camera) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

void GltfWriter::useExtension(const std::string& extension) {
    for (const Json& used : root_["extensionsUsed"]) {
        if (used == extension) {
            return;
        }
    }
    root_["extensionsUsed"].push_back(extension);
}

int GltfWriter::addPointLight(const std::string& name, const glm::vec3& position,
                              const glm::vec3& color, float candela, float range) {
    useExtension("KHR_lights_punctual");
    Json& lights = root_["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(
        {{"type", "point"}, {"color", array(color)}, {"intensity", candela}, {"range", range}});
    root_["nodes"].push_back(
        {{"name", name},
         {"translation", array(position)},
         {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
    root_["scenes"][0]["nodes"].push_back(root_["nodes"].size() - 1);
    return static_cast<int>(root_["nodes"].size()) - 1;
}

void GltfWriter::addAnimation(const std::string& name,
                              const std::vector<AnimationChannel>& channels) {
    Json animation{{"name", name}, {"channels", Json::array()}, {"samplers", Json::array()}};
    for (const AnimationChannel& channel : channels) {
        const int input = addAccessor(channel.times.data(), channel.times.size(), 1, kFloat, false);
        Json& times = root_["accessors"][static_cast<std::size_t>(input)];
        times["min"] = Json::array({channel.times.front()});
        times["max"] = Json::array({channel.times.back()});
        std::vector<glm::vec4> turns;
        for (const glm::quat& q : channel.turns) {
            turns.emplace_back(q.x, q.y, q.z, q.w);
        }
        const int output =
            turns.empty()
                ? addAccessor(channel.places.data(), channel.places.size(), 3, kFloat, false)
                : addAccessor(turns.data(), turns.size(), 4, kFloat, false);
        animation["samplers"].push_back(
            {{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1},
             {"target", {{"node", channel.node}, {"path", channel.path}}}});
    }
    root_["animations"].push_back(animation);
}

core::Result<void> GltfWriter::write(const std::filesystem::path& folder) const {
    Json root = root_;
    root["buffers"] = Json::array({{{"uri", name_ + ".bin"}, {"byteLength", bytes_.size()}}});
    core::Result<void> data =
        io::writeFile(folder / (name_ + ".bin"), bytes_.data(), bytes_.size());
    if (!data) {
        return data;
    }
    const std::string text = root.dump(1) + "\n";
    return io::writeFile(folder / (name_ + ".gltf"), text.data(), text.size());
}

glm::quat turn(float degrees) {
    return glm::angleAxis(glm::radians(degrees), glm::vec3(0.0f, 1.0f, 0.0f));
}

} // namespace lodestar::samples
