// SPDX-License-Identifier: MIT
//
// The golden pictures of glTF's features: what a row says, and what its property may ask.
#pragma once

#include <functional>
#include <vector>

#include "core/image.h"
#include "golden/gltf_builder.h"
#include "scene/scene.h"

namespace lodestar::testing {

/// Pixels a side, and pixels a unit of the scene under GltfBuilder::orthographicCamera.
inline constexpr int kGltfSide = 96;
inline constexpr float kPixelsPerUnit = 40.0f;

/// The light of a picture.
enum class Light {
    Faces, ///< a colour for each face of the cube
    Even,  ///< the same, but towards +X as towards -X
    White, ///< radiance 1 from everywhere
    Dark,  ///< none
    Own,   ///< the file's own image-based light, which is the backdrop too
};

/// A golden as rendered, for its property.
struct Shot {
    const GltfBuilder& built;
    const scene::Scene& scene; ///< posed
    const core::Image& radiance;
    std::function<core::Image(const GltfBuilder&)> render; ///< another file in the same way
    std::function<core::Image(const scene::Scene&)> renderScene;

    /// The pixel that holds a point of the plane z = 0.
    [[nodiscard]] const float* at(float x, float y) const {
        return radiance.at(static_cast<int>((x + 1.2f) * kPixelsPerUnit),
                           static_cast<int>((1.2f - y) * kPixelsPerUnit));
    }
};

struct GltfGolden {
    const char* name;
    void (*build)(GltfBuilder& file);
    /// Makes of the file what a reader that passes over the feature would see.
    void (*ignore)(Json& document);
    /// What holds whatever the picture kept shows.
    void (*property)(const Shot& shot);
    Light light = Light::Faces;
    int scene = -1;
    double seconds = -1.0; ///< of animation 0; below 0: as the file stands
    /// The greatest share of pixels beyond 1/255: silhouette pixels that another rasteriser decides
    /// the other way. 1/1000 as other engines allow across drivers.
    double failing = 1e-3;
};

std::vector<GltfGolden> geometryGoldens();
std::vector<GltfGolden> materialGoldens();
std::vector<GltfGolden> textureGoldens();
std::vector<GltfGolden> motionGoldens();

/// The middle of a pixel column; of a row with the sign changed.
inline float pixelMiddle(int pixel) {
    return (static_cast<float>(pixel) + 0.5f) / kPixelsPerUnit - 1.2f;
}

/// How many pixels something covers.
inline int covered(const core::Image& image) {
    int count = 0;
    for (std::size_t i = 3; i < image.pixels().size(); i += 4) {
        count += image.pixels()[i] > 0.0f ? 1 : 0;
    }
    return count;
}

/// What a byte of sRGB stands for.
inline float linearFromByte(int byte) {
    const float encoded = static_cast<float>(byte) / 255.0f;
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// Every primitive of the file.
inline void eachPrimitive(Json& document, const std::function<void(Json&)>& change) {
    for (Json& mesh : document["meshes"]) {
        for (Json& primitive : mesh["primitives"]) {
            change(primitive);
        }
    }
}

inline void expectColor(const float* pixel, const glm::vec3& expected, float tolerance) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(pixel[c], expected[c], tolerance) << "channel " << c;
    }
}

/// The greatest difference of two pictures over rgb, but for a share of silhouette pixels.
inline void expectSame(const core::Image& a, const core::Image& b, double tolerance,
                       double silhouettes) {
    ASSERT_EQ(a.pixels().size(), b.pixels().size());
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < a.pixels().size(); i += 4) {
        bool differs = false;
        for (std::size_t c = 0; c < 3; ++c) {
            differs =
                differs || std::abs(double{a.pixels()[i + c]} - b.pixels()[i + c]) > tolerance;
        }
        beyond += differs ? 1 : 0;
    }
    EXPECT_LE(static_cast<double>(beyond) / (static_cast<double>(a.pixels().size()) / 4.0),
              silhouettes);
}

} // namespace lodestar::testing
