// SPDX-License-Identifier: MIT
//
// Environments as a host makes them: pixels, an analytic text, or faces that it draws one by one.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "core/tally.h"
#include "lighting/cube_texels.h"
#include "lighting/environment.h"
#include "lodestar/lodestar.h"
#include "plan/effect_plan.h"

namespace lodestar::plugin {

/// Of a face of a cube that a host draws, column after column.
struct FaceCamera {
    double view[16];       ///< camera from world
    double projection[16]; ///< OpenGL clip space from camera: row 0 of the face is at y = -1
};
/// @param near, far metres, 0 < near < far
[[nodiscard]] FaceCamera faceCamera(int face, const glm::dvec3& position, double near, double far);

class PlacedEnvironment {
public:
    /// @errors InputRefused with a JSON pointer of the member
    [[nodiscard]] static core::Result<PlacedEnvironment> make(const LodestarEnvironmentDesc& desc,
                                                              const glm::dmat3& hostFromDocument,
                                                              core::Tally& warnings);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] bool isCaptured() const { return capture_.has_value(); }
    /// Of what it shows; 0: nothing yet.
    [[nodiscard]] std::uint64_t version() const { return version_; }
    [[nodiscard]] int width() const { return maps_.base.width(); }

    /// A cube as a GPU takes it, made when it is first asked for. @param which
    /// LODESTAR_TEXELS_ENVIRONMENT, _IRRADIANCE  @pre it shows something
    [[nodiscard]] std::shared_ptr<const lighting::CubeTexels> texels(int which);
    /// Its maps for the CPU's lookups, tent mips and irradiance made. @pre it shows something
    [[nodiscard]] const lighting::PreparedEnvironment& prepared();

    /// Level 0, and the tent mips, made when they are first asked for. @pre it shows something
    [[nodiscard]] const lighting::Cubemap& base() const { return maps_.base; }
    [[nodiscard]] const lighting::Cubemap& tentMips();
    /// Mean radiance over the sphere. @pre it shows something
    [[nodiscard]] const glm::dvec3& mean();

    /// What the planner is told. @pre captured
    [[nodiscard]] plan::CaptureView view() const;
    /// What the host draws for a face. @pre captured
    [[nodiscard]] LodestarFaceJob job(int face) const;
    /// @pre captured; face in [0, 6); width^2 pixels of 3 or 4 channels
    void setFace(int face, const float* pixels, std::uint32_t channels, core::Tally& warnings);
    /// All faces are missing again. @pre captured
    void request();
    [[nodiscard]] std::uint32_t missing() const;

private:
    struct Capture {
        glm::dvec3 position{0.0};
        double near = 0.1, far = 100.0;
        lighting::Cubemap pending; ///< shows nothing until it is whole
        std::array<bool, 6> missing{};
    };
    void show(lighting::Cubemap base);

    std::string name_;
    std::uint64_t version_ = 0;
    lighting::PreparedEnvironment maps_;
    std::optional<glm::dvec3> mean_;
    std::shared_ptr<const lighting::CubeTexels> texels_[2]; ///< environment, irradiance
    std::optional<Capture> capture_;
};

} // namespace lodestar::plugin
