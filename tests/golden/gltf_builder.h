// SPDX-License-Identifier: MIT
//
// Puts small glTF files together, piece by piece, with data of any component type: what the
// features' golden pictures are rendered from, through files on disk.
#pragma once

#include <algorithm>
#include <cstring>
#include <map>

#include "io/image_file.h"
#include "unit/io/io_support.h"

namespace lodestar::testing {

template <class T>
inline constexpr int kComponentType = 0;
template <>
inline constexpr int kComponentType<std::int8_t> = 5120;
template <>
inline constexpr int kComponentType<std::uint8_t> = 5121;
template <>
inline constexpr int kComponentType<std::int16_t> = 5122;
template <>
inline constexpr int kComponentType<std::uint16_t> = 5123;
template <>
inline constexpr int kComponentType<float> = 5126;

/// One glTF file in the making; the functions return the index of what they added.
class GltfBuilder {
public:
    Json document = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0,
        "scenes": [{"name": "first", "nodes": []}]})");

    int add(const char* list, const Json& item) {
        document[list].push_back(item);
        return static_cast<int>(document[list].size()) - 1;
    }

    /// A node at the root of the first scene.
    int node(const Json& item) {
        const int index = add("nodes", item);
        document["scenes"][0]["nodes"].push_back(index);
        return index;
    }

    void uses(const char* extension) {
        Json& used = document["extensionsUsed"];
        if (std::find(used.begin(), used.end(), extension) == used.end()) {
            used.push_back(extension);
        }
    }

    /// A buffer view of values; elements of vertex data begin at multiples of four bytes.
    template <class T>
    int view(const std::vector<T>& values, std::size_t components) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        const std::size_t from = bytes_.size();
        const std::size_t element = components * sizeof(T);
        const std::size_t stride = components > 1 ? (element + 3) / 4 * 4 : element;
        for (std::size_t i = 0; i < values.size(); i += components) {
            const auto* data = reinterpret_cast<const unsigned char*>(&values[i]);
            bytes_.insert(bytes_.end(), data, data + element);
            bytes_.resize(bytes_.size() + stride - element);
        }
        Json json = {{"buffer", 0}, {"byteOffset", from}, {"byteLength", bytes_.size() - from}};
        if (stride != element) {
            json["byteStride"] = stride;
        }
        return add("bufferViews", json);
    }

    /// An accessor over values of its own.
    template <class T>
    int accessor(const char* type, const std::vector<T>& values, bool normalized = false) {
        const std::string name = type;
        const std::size_t components = name == "SCALAR" ? 1
                                       : name == "MAT4" ? 16
                                                        : static_cast<std::size_t>(name[3] - '0');
        Json json = {{"bufferView", view(values, components)},
                     {"componentType", kComponentType<T>},
                     {"count", values.size() / components},
                     {"type", type}};
        if (normalized) {
            json["normalized"] = true;
        }
        for (std::size_t c = 0; c < components; ++c) {
            T low = values[c];
            T high = values[c];
            for (std::size_t i = c; i < values.size(); i += components) {
                low = std::min(low, values[i]);
                high = std::max(high, values[i]);
            }
            json["min"].push_back(low);
            json["max"].push_back(high);
        }
        return add("accessors", json);
    }

    int floats(const char* type, const std::vector<float>& values) {
        return accessor<float>(type, values);
    }

    template <glm::length_t N>
    int vectors(const std::vector<glm::vec<N, float>>& values) {
        std::vector<float> flat;
        for (const auto& v : values) {
            for (glm::length_t c = 0; c < N; ++c) {
                flat.push_back(v[c]);
            }
        }
        return floats(("VEC" + std::to_string(N)).c_str(), flat);
    }

    int indices(const std::vector<std::uint32_t>& list) {
        return accessor<std::uint16_t>("SCALAR", {list.begin(), list.end()});
    }

    /// A decoded primitive's positions, normals, texture coordinates and indices.
    Json primitive(const io::GltfPrimitive& shape, int material) {
        Json json = {{"indices", indices(shape.indices)}, {"material", material}};
        json["attributes"]["POSITION"] = vectors(shape.positions);
        json["attributes"]["NORMAL"] = vectors(shape.normals);
        json["attributes"]["TEXCOORD_0"] = vectors(shape.uvs[0]);
        return json;
    }

    /// A rectangle facing +Z, single-sided, uv (0, 0) at its upper left.
    Json panel(float left, float bottom, float right, float top, int material, float z = 0.0f) {
        return {{"attributes",
                 {{"POSITION", floats("VEC3", {left, top, z, right, top, z, right, bottom, z, left,
                                               bottom, z})},
                  {"NORMAL", floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})},
                  {"TEXCOORD_0", floats("VEC2", {0, 0, 1, 0, 1, 1, 0, 1})}}},
                {"indices", indices({0, 3, 2, 0, 2, 1})},
                {"material", material}};
    }

    /// A node that shows primitives as one mesh.
    int show(const std::vector<Json>& primitives, Json at = Json::object()) {
        at["mesh"] = add("meshes", {{"primitives", primitives}});
        return node(at);
    }

    /// A material whose colour is its radiance.
    int unlit(float r, float g, float b, float a = 1.0f) {
        uses("KHR_materials_unlit");
        return add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {r, g, b, a}}}},
                                 {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    }

    /// A material of Lambert's law alone.
    int lambert(float r, float g, float b) {
        return add(
            "materials",
            {{"extras",
              {{"lodestar", {{"diffuse", {r, g, b}}, {"f0", {0, 0, 0}}, {"exponent", 0}}}}}});
    }

    /// A PNG beside the file. @return its texture, sampled at the nearest texel
    int texture(const std::string& name, const core::Texels& texels) {
        core::Image image(texels.width(), texels.height(), 4);
        for (int y = 0; y < texels.height(); ++y) {
            for (int x = 0; x < texels.width(); ++x) {
                for (int c = 0; c < 4; ++c) {
                    image.at(x, y)[c] = texels.value(x, y, c);
                }
            }
        }
        pictures_[name] = std::move(image);
        if (!document.contains("samplers")) {
            add("samplers", {{"magFilter", 9728}, {"minFilter", 9728}});
        }
        return add("textures", {{"source", add("images", {{"uri", name}})}, {"sampler", 0}});
    }

    /// What the camera of every picture sees: x and y in [-1.2, 1.2], from +Z.
    void orthographicCamera() {
        const int camera = add("cameras", Json::parse(R"({"type": "orthographic", "orthographic":
            {"xmag": 1.2, "ymag": 1.2, "znear": 0.1, "zfar": 20}})"));
        node({{"camera", camera}, {"translation", {0, 0, 5}}});
    }

    /// Writes the .gltf, its .bin and its pictures. @return the .gltf's path
    std::filesystem::path write(const TemporaryFolder& folder) const {
        Json whole = document;
        whole["buffers"] = {{{"uri", "data.bin"}, {"byteLength", bytes_.size()}}};
        folder.write("data.bin", bytes_);
        for (const auto& [name, image] : pictures_) {
            EXPECT_TRUE(io::writeImage(folder / name, image).ok()) << name;
        }
        return folder.write("scene.gltf", whole.dump());
    }

private:
    io::Bytes bytes_;
    std::map<std::string, core::Image> pictures_;
};

/// Four texels: red, green over blue, yellow.
inline core::Texels fourColors() {
    core::Texels colors(2, 2);
    colors.bytes() = {255, 26, 26, 255, 26, 255, 26, 255, 26, 26, 255, 255, 230, 230, 26, 255};
    return colors;
}

} // namespace lodestar::testing
