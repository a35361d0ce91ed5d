// SPDX-License-Identifier: MIT
#include "environments.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include "lighting/mips.h"
#include "lodestar/cube.glsl"

namespace lodestar::plugin {
namespace {

constexpr std::uint32_t kDefaultFaceWidth = 256;
constexpr std::uint32_t kMaxFaceWidth = 4096;
constexpr std::uint32_t kMaxPixelsWide = 32768;

core::Error refusal(const char* what, const char* where) {
    return core::refused(what, where);
}

/// Rows of a host's pixels, from `top` on, as an image of three channels.
core::Image imageOf(const float* pixels, std::uint32_t width, std::uint32_t top,
                    std::uint32_t height, std::uint32_t channels) {
    core::Image image(static_cast<int>(width), static_cast<int>(height), 3);
    const float* from = pixels + std::size_t{top} * width * channels;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x, from += channels) {
            std::copy_n(from, 3, image.at(static_cast<int>(x), static_cast<int>(y)));
        }
    }
    return image;
}

core::Result<void> checkPixels(const LodestarEnvironmentDesc& desc) {
    const std::uint32_t w = desc.width, h = desc.height;
    if (desc.pixels == nullptr) {
        return refusal("the pixels are null", "/pixels");
    }
    if (desc.channels != 3 && desc.channels != 4) {
        return refusal("a pixel has 3 or 4 channels", "/channels");
    }
    const bool shaped = desc.layout == LODESTAR_LATLONG ? w == 2 * h : h == 6 * w;
    if (w == 0 || h == 0 || w > kMaxPixelsWide || !shaped) {
        return refusal(desc.layout == LODESTAR_LATLONG
                           ? "a panorama is twice as wide as high, at most 32768"
                           : "six square faces, each below the last, are six times as high as wide",
                       "/width");
    }
    return {};
}

core::Result<lighting::Cubemap> cubeOf(const LodestarEnvironmentDesc& desc, int faceWidth,
                                       core::Tally& warnings) {
    if (desc.layout == LODESTAR_ANALYTIC) {
        if (desc.analytic == nullptr) {
            return refusal("the text is null", "/analytic");
        }
        const auto analytic = lighting::parseAnalytic(desc.analytic);
        if (!analytic) {
            return refusal(analytic.error().what.c_str(), "/analytic");
        }
        return lighting::cubeFromAnalytic(*analytic, faceWidth);
    }
    if (auto good = checkPixels(desc); !good) {
        return good.error();
    }
    if (desc.layout == LODESTAR_LATLONG) {
        core::Image panorama = imageOf(desc.pixels, desc.width, 0, desc.height, desc.channels);
        lighting::repairRadiance(panorama, warnings);
        return lighting::cubeFromLatLong(panorama, faceWidth);
    }
    std::array<core::Image, 6> faces;
    for (std::uint32_t face = 0; face < 6; ++face) {
        faces[face] =
            imageOf(desc.pixels, desc.width, face * desc.width, desc.width, desc.channels);
        lighting::repairRadiance(faces[face], warnings);
    }
    return lighting::cubeFromFaces(faces, faceWidth);
}

core::Result<void> checkPlace(const LodestarEnvironmentDesc& desc) {
    if (desc.layout < LODESTAR_LATLONG || desc.layout > LODESTAR_CAPTURED) {
        return refusal("no such layout", "/layout");
    }
    if (desc.face_width > kMaxFaceWidth) {
        return refusal("a face is at most 4096 texels wide", "/face_width");
    }
    if (!std::isfinite(desc.rotation)) {
        return refusal("a rotation is finite", "/rotation");
    }
    if (!(std::abs(desc.ev) <= 64.0)) {
        return refusal("an ev lies in [-64, 64]", "/ev");
    }
    if (desc.layout != LODESTAR_CAPTURED) {
        return {};
    }
    if (!(std::isfinite(desc.position[0]) && std::isfinite(desc.position[1]) &&
          std::isfinite(desc.position[2]))) {
        return refusal("a position is finite", "/position");
    }
    if (!(desc.near_plane > 0.0 && desc.far_plane > desc.near_plane &&
          std::isfinite(desc.far_plane))) {
        return refusal("0 < near < far", "/near_plane");
    }
    return {};
}

} // namespace

core::Result<PlacedEnvironment> PlacedEnvironment::make(const LodestarEnvironmentDesc& desc,
                                                        const glm::dmat3& hostFromDocument,
                                                        core::Tally& warnings) {
    if (auto good = checkPlace(desc); !good) {
        return good.error();
    }
    const int width = static_cast<int>(desc.face_width != 0 ? desc.face_width : kDefaultFaceWidth);
    PlacedEnvironment result;
    result.name_ = desc.name != nullptr ? desc.name : "environment";
    if (desc.layout == LODESTAR_CAPTURED) {
        Capture capture;
        capture.position = {desc.position[0], desc.position[1], desc.position[2]};
        capture.near = desc.near_plane;
        capture.far = desc.far_plane;
        capture.pending = lighting::Cubemap(width);
        capture.missing.fill(true);
        result.capture_ = std::move(capture);
        return result;
    }
    auto cube = cubeOf(desc, width, warnings);
    if (!cube) {
        return cube.error();
    }
    const glm::quat frame(glm::quat_cast(hostFromDocument));
    const glm::quat own =
        desc.in_host_frame != 0 ? glm::conjugate(frame) : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
    result.show(lighting::placed(std::move(*cube), frame * lighting::aboutUp(desc.rotation) * own,
                                 desc.ev));
    return result;
}

void PlacedEnvironment::show(lighting::Cubemap base) {
    maps_ = {};
    maps_.base = std::move(base);
    mean_.reset();
    texels_[0].reset();
    texels_[1].reset();
    ++version_;
}

const lighting::Cubemap& PlacedEnvironment::tentMips() {
    if (maps_.tentMips.empty()) {
        maps_.tentMips = lighting::tentMips(maps_.base);
    }
    return maps_.tentMips;
}

const glm::dvec3& PlacedEnvironment::mean() {
    if (!mean_) {
        mean_ = glm::dvec3(lighting::sphereMean(maps_.base, 0));
    }
    return *mean_;
}

const lighting::PreparedEnvironment& PlacedEnvironment::prepared() {
    (void)tentMips();
    if (maps_.irradiance.empty()) {
        maps_.irradiance = lighting::irradianceCube(maps_.base);
    }
    return maps_;
}

std::shared_ptr<const lighting::CubeTexels> PlacedEnvironment::texels(int which) {
    const bool irradiance = which == LODESTAR_TEXELS_IRRADIANCE;
    std::shared_ptr<const lighting::CubeTexels>& made = texels_[irradiance ? 1 : 0];
    if (!made) {
        lighting::Cubemap& map = irradiance ? maps_.irradiance : maps_.tentMips;
        if (map.empty()) {
            map =
                irradiance ? lighting::irradianceCube(maps_.base) : lighting::tentMips(maps_.base);
        }
        made = std::make_shared<const lighting::CubeTexels>(lighting::cubeTexels(map));
    }
    return made;
}

plan::CaptureView PlacedEnvironment::view() const {
    return {name_, capture_->missing, version_ != 0};
}

FaceCamera faceCamera(int face, const glm::dvec3& position, double near, double far) {
    const glm::dvec3 forward(shader::lodestar_cubeDirection(face, 0.0f, 0.0f));
    const glm::dvec3 right = glm::dvec3(shader::lodestar_cubeDirection(face, 1.0f, 0.0f)) - forward;
    const glm::dvec3 up = glm::dvec3(shader::lodestar_cubeDirection(face, 0.0f, 1.0f)) - forward;
    const glm::dmat3 cameraFromWorld = glm::transpose(glm::dmat3(right, up, -forward));
    glm::dmat4 view(cameraFromWorld);
    view[3] = glm::dvec4(-(cameraFromWorld * position), 1.0);
    const glm::dmat4 projection = glm::perspectiveRH_NO(std::acos(0.0), 1.0, near, far);
    FaceCamera camera{};
    std::copy_n(glm::value_ptr(view), 16, camera.view);
    std::copy_n(glm::value_ptr(projection), 16, camera.projection);
    return camera;
}

LodestarFaceJob PlacedEnvironment::job(int face) const {
    const FaceCamera camera = faceCamera(face, capture_->position, capture_->near, capture_->far);
    LodestarFaceJob job{};
    job.struct_size = sizeof job;
    job.face = face;
    std::copy_n(camera.view, 16, job.view);
    std::copy_n(camera.projection, 16, job.projection);
    job.width = static_cast<std::uint32_t>(capture_->pending.width());
    return job;
}

void PlacedEnvironment::setFace(int face, const float* pixels, std::uint32_t channels,
                                core::Tally& warnings) {
    const int width = capture_->pending.width();
    const auto w = static_cast<std::uint32_t>(width);
    core::Image image = imageOf(pixels, w, 0, w, channels);
    lighting::repairRadiance(image, warnings);
    for (int y = 0; y < width; ++y) {
        for (int x = 0; x < width; ++x) {
            const float* from = image.at(x, y);
            capture_->pending.texel(face, x, y) = glm::vec4(from[0], from[1], from[2], 1.0f);
        }
    }
    capture_->missing[static_cast<std::size_t>(face)] = false;
    if (missing() == 0) {
        show(capture_->pending);
    }
}

void PlacedEnvironment::request() {
    capture_->missing.fill(true);
}

std::uint32_t PlacedEnvironment::missing() const {
    return capture_ ? static_cast<std::uint32_t>(
                          std::count(capture_->missing.begin(), capture_->missing.end(), true))
                    : 0u;
}

} // namespace lodestar::plugin
