// SPDX-License-Identifier: MIT
//
// The smallest scene that is lit.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "support/run.h"

namespace lodestar::testing {

/// A square of 4 m on the ground, white and matt, named "Floor".
inline std::string floorScene(const TemporaryFolder& folder) {
    const float vertices[] = {-2, 0, -2, 0, 1, 0, 2,  0, -2, 0, 1, 0,
                              2,  0, 2,  0, 1, 0, -2, 0, 2,  0, 1, 0};
    const std::uint32_t indices[] = {0, 2, 1, 0, 3, 2};
    std::ofstream bin(folder.file("floor.bin"), std::ios::binary);
    bin.write(reinterpret_cast<const char*>(vertices), sizeof vertices);
    bin.write(reinterpret_cast<const char*>(indices), sizeof indices);
    const std::string path = folder.file("floor.gltf");
    std::ofstream(path) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"name":"Floor","mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"material":0}]}],
      "materials":[{"pbrMetallicRoughness":{"metallicFactor":0}}],
      "buffers":[{"uri":"floor.bin","byteLength":120}],
      "bufferViews":[{"buffer":0,"byteLength":96,"byteStride":24},{"buffer":0,"byteOffset":96,"byteLength":24}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-2,0,-2],"max":[2,0,2]},
        {"bufferView":0,"byteOffset":12,"componentType":5126,"count":4,"type":"VEC3"},
        {"bufferView":1,"componentType":5125,"count":6,"type":"SCALAR"}]})";
    return path;
}

} // namespace lodestar::testing
