// SPDX-License-Identifier: MIT
//
// The embedded shader text: includes flattened, features as defines. Calls no GL.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.h"

namespace lodestar::gl {

/// Macro names and values put before a shader's text.
using Defines = std::vector<std::pair<std::string, std::string>>;

/// One file of shaders/ ("lodestar/cube.glsl", "host/mesh.frag") as it is; empty if there is none.
[[nodiscard]] std::string_view shaderFile(std::string_view name);

/// Names of all embedded files.
[[nodiscard]] std::vector<std::string_view> shaderFileNames();

/// A whole shader: version line, defines, and the file with its includes in place, each file once.
/// @param version the number after #version, 330 or later core
/// @errors Internal naming an include that does not exist
[[nodiscard]] core::Result<std::string> assembleShader(std::string_view name, int version,
                                                       const Defines& defines);

} // namespace lodestar::gl
