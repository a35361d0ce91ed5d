// SPDX-License-Identifier: MIT
//
// The command line that the hosts share, and what of it is the same in all of them.
#pragma once

#include <optional>
#include <string>

#include "core/result.h"
#include "io/gltf.h"
#include "io/image_file.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace lodestar::samples {

struct HostCall {
    std::string scene, lighting, output;
    int width = 640, height = 480;
    double hour = 15.0;
    scene::CameraRequest camera;
};

/// Reads the words; nothing where they are no call.
std::optional<HostCall> parseHostCall(int argc, char** argv);
/// Prints how a host is called. @return the exit status for a call that was none
int explainHost(const char* name, int argc, char** argv);
/// Prints one line `NAME: what`. @return the status
int hostFails(const char* name, const std::string& what, int status);

/// The scene, and the view that `lodestar render` would take of it. @errors as theirs
struct HostScene {
    io::GltfFile file;
    scene::View view;
};
[[nodiscard]] core::Result<HostScene> loadHostScene(const HostCall& call);

} // namespace lodestar::samples
