// SPDX-License-Identifier: MIT
//
// lodestar-make-assets FOLDER: writes the demo's panoramas, textures and scenes. The same every
// time.
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include "core/result.h"
#include "io/image_file.h"
#include "panorama.h"
#include "scenes.h"

namespace lodestar::samples {
namespace {

core::Result<void> writePanoramas(const std::filesystem::path& folder) {
    core::Image courtyard = renderPanorama(courtyardRadiance, 512, 3);
    addSun(courtyard, courtyardSun());
    if (core::Result<void> written = io::writeImage(folder / "courtyard.exr", courtyard);
        !written) {
        return written;
    }
    const core::Image studio = renderPanorama(studioRadiance, 512, 3);
    if (core::Result<void> written = io::writeImage(folder / "studio.exr", studio); !written) {
        return written;
    }
    return io::writeImage(folder / "faces.exr", renderPanorama(facesRadiance, 512, 3));
}

core::Result<void> writeAll(const std::filesystem::path& folder) {
    using Writer = core::Result<void> (*)(const std::filesystem::path&);
    for (const Writer write :
         {&writePanoramas, &writeFigure1, &writeFigure2, &writeFigure3, &writeAshikhmin,
          &writeEstimators, &writeLamps, &writeTerrace, &writeLift}) {
        if (core::Result<void> written = write(folder); !written) {
            return written;
        }
    }
    return {};
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    const std::string folder = argc > 1 ? argv[1] : "out/demo/assets";
    if (argc > 2 || folder.starts_with('-')) {
        std::fputs("usage: lodestar-make-assets [FOLDER]\n"
                   "Writes the demo's panoramas, textures and scenes (default out/demo/assets).\n"
                   "Example: lodestar-make-assets out/demo/assets\n",
                   argc == 2 && folder == "--help" ? stdout : stderr);
        return argc == 2 && folder == "--help" ? 0 : 2;
    }
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        std::fprintf(stderr, "lodestar: %s: the folder cannot be made: %s\n", folder.c_str(),
                     failure.message().c_str());
        return 5;
    }
    const lodestar::core::Result<void> written = lodestar::samples::writeAll(folder);
    if (!written) {
        std::fprintf(stderr, "lodestar: %s\n", written.error().message().c_str());
        return static_cast<int>(written.error().code);
    }
    return 0;
}
