// SPDX-License-Identifier: MIT
//
// The command line that the hosts share, and what of it is the same in all of them.
#pragma once

#include <cstdint>
#include <string>

#include "core/image.h"
#include "core/result.h"
#include "core/tally.h"
#include "io/gltf.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace lodestar::samples {

struct HostCall {
    std::string scene, lighting, output;
    int width = 640, height = 480;
    double hour = 15.0;
    scene::CameraRequest camera;
};

/// The scene, and the view that `lodestar render` would take of it.
struct HostScene {
    io::GltfFile file;
    scene::View view;
};

/// A host's part: the picture, as it is shown.
using HostDraw = core::Result<core::Image> (*)(const HostCall& call, const HostScene& scene);

/// Reads a host's words, loads its scene, lets it draw, writes the picture; says in one line what
/// fails. @return the exit status
int runHost(const char* name, int argc, char** argv, HostDraw draw);

/// Says on stderr what a host does not show of a scene, a line each.
void warn(const char* name, const HostCall& call, const core::Tally& leftOut);

/// Takes one word of a call and its value. @return false if there is no such word, or no such value
[[nodiscard]] bool takeWord(HostCall& call, const std::string& word, const char* value);
[[nodiscard]] core::Result<HostScene> loadScene(const HostCall& call);

/// A picture of 8 bits a channel, RGBA, row 0 at the bottom.
[[nodiscard]] core::Image pictureOf(const HostCall& call, const std::uint8_t* bytes);

} // namespace lodestar::samples
