// SPDX-License-Identifier: MIT
//
// What the io tests share: a folder that cleans up, a stop watch, and a small valid glTF to spoil.
#pragma once

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "io/gltf.h"

namespace lodestar::testing {

using Json = nlohmann::json;

/// The time no hostile input may exceed. Sanitizers make everything several times slower: there,
/// only a hang is looked for.
#ifdef __SANITIZE_ADDRESS__
inline constexpr double kMaxSeconds = 30.0;
#else
inline constexpr double kMaxSeconds = 2.0;
#endif

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "lodestar-io-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~TemporaryFolder() {
        std::error_code code;
        std::filesystem::remove_all(path_, code);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, const void* data, std::size_t size) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary)
            .write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
        return path_ / name;
    }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        return write(name, text.data(), text.size());
    }
    std::filesystem::path write(const std::string& name, const io::Bytes& bytes) const {
        return write(name, bytes.data(), bytes.size());
    }

private:
    std::filesystem::path path_;
};

class StopWatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A refusal is one printable line that names the file.
inline void expectOneLine(const core::Error& error, const std::string& file) {
    const std::string message = error.message();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(message.rfind(file, 0), 0U) << message;
    EXPECT_GT(message.size(), file.size() + 5) << message;
    EXPECT_LT(message.size(), file.size() + 800) << message;
    EXPECT_EQ(error.code, core::ErrorCode::InputRefused) << message;
}

/// Loads a file, and checks that checkGltf comes to the same end. @param maxSeconds for each of
/// both
inline core::Result<io::GltfFile> loadAndCheck(const std::filesystem::path& path,
                                               const io::GltfOptions& options = {},
                                               double maxSeconds = kMaxSeconds) {
    const StopWatch loading;
    core::Result<io::GltfFile> file = io::loadGltf(path, options);
    EXPECT_LT(loading.seconds(), maxSeconds) << "loading";
    const StopWatch checking;
    const io::GltfCheck check = io::checkGltf(path, options);
    EXPECT_LT(checking.seconds(), maxSeconds) << "checking";
    EXPECT_EQ(check.file.has_value(), file.ok())
        << (file.ok() ? check.problems.first().what : file.error().message());
    EXPECT_EQ(check.problems.refused(), !file.ok());
    if (check.file && file) {
        EXPECT_EQ(check.file->warnings.counts(), file->warnings.counts());
    }
    if (!file && check.problems.refused()) {
        EXPECT_EQ(check.problems.first().where, file.error().where);
        EXPECT_EQ(check.problems.first().what, file.error().what);
    }
    return file;
}

/// Where a check found refusals, or what is mended.
inline std::set<std::string> pointers(const io::GltfCheck& check, bool repaired) {
    std::set<std::string> result;
    for (const io::GltfProblem& problem : check.problems.list()) {
        if (problem.repaired == repaired) {
            result.insert(problem.where);
        }
    }
    return result;
}

inline std::string base64(const io::Bytes& bytes) {
    static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : digits[(bits >> (18 - 6 * k)) & 63U];
        }
    }
    return text;
}

inline std::string dataUri(const io::Bytes& bytes) {
    return "data:application/octet-stream;base64," + base64(bytes);
}

template <class T>
void put(io::Bytes& bytes, std::initializer_list<T> values) {
    for (const T value : values) {
        const std::size_t at = bytes.size();
        bytes.resize(at + sizeof value);
        std::memcpy(bytes.data() + at, &value, sizeof value);
    }
}

/// 3 positions (36 bytes), 3 normals (36), 3 texture coordinates (24), 3 indices of 16 bits and 2
/// bytes of padding (8): 104 bytes.
inline io::Bytes triangleBytes() {
    io::Bytes bytes;
    put<float>(bytes, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    put<float>(bytes, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    put<float>(bytes, {0, 0, 1, 0, 0, 1});
    put<std::uint16_t>(bytes, {0, 1, 2, 0});
    return bytes;
}

/// A valid document with one of everything that is read.
inline Json triangleDocument() {
    return Json::parse(R"({
      "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
      "extensionsUsed": ["KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 2,
         "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}},
      "nodes": [{"mesh": 0, "children": [2]}, {"camera": 0},
                {"translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
                                  "indices": 3, "material": 0}]}],
      "materials": [{"name": "m", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
      "textures": [{"source": 0, "sampler": 0}], "samplers": [{"magFilter": 9729}],
      "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="}],
      "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1, "zfar": 100}}],
      "buffers": [{"byteLength": 104}],
      "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                      {"buffer": 0, "byteOffset": 36, "byteLength": 36},
                      {"buffer": 0, "byteOffset": 72, "byteLength": 24},
                      {"buffer": 0, "byteOffset": 96, "byteLength": 8},
                      {"buffer": 0, "byteOffset": 0, "byteLength": 12}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                     "min": [0, 0, 0], "max": [1, 1, 0]},
                    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
                    {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"},
                    {"bufferView": 3, "componentType": 5123, "count": 3, "type": "SCALAR"},
                    {"bufferView": 4, "componentType": 5126, "count": 1, "type": "SCALAR",
                     "min": [0], "max": [0]},
                    {"bufferView": 4, "componentType": 5126, "count": 1, "type": "VEC3"}],
      "skins": [{"joints": [0]}],
      "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                      "samplers": [{"input": 4, "output": 5}]}]
    })");
}

/// The document with the triangle's bytes in a data: URI, unless it has its own.
inline std::string documentText(Json document, const io::Bytes& bytes = triangleBytes()) {
    if (document.contains("buffers") && document["buffers"].is_array() &&
        !document["buffers"].empty() && document["buffers"][0].is_object() &&
        !document["buffers"][0].contains("uri")) {
        document["buffers"][0]["uri"] = dataUri(bytes);
    }
    return document.dump();
}

inline io::Bytes glb(const std::string& json, const io::Bytes& binary) {
    io::Bytes bytes;
    const auto padded = [](std::size_t n) { return (n + 3) / 4 * 4; };
    const auto text = static_cast<std::uint32_t>(padded(json.size()));
    const auto data = static_cast<std::uint32_t>(padded(binary.size()));
    put<std::uint32_t>(bytes, {0x46546c67, 2, 12 + 8 + text + 8 + data, text, 0x4e4f534a});
    bytes.insert(bytes.end(), json.begin(), json.end());
    bytes.resize(20 + text, ' ');
    put<std::uint32_t>(bytes, {data, 0x004e4942});
    bytes.insert(bytes.end(), binary.begin(), binary.end());
    bytes.resize(28 + text + data, 0);
    return bytes;
}

} // namespace lodestar::testing
