// SPDX-License-Identifier: MIT
//
// Khronos' test pictures that say in their texture what is right: each is judged from a view across
// it without perspective to speak of, and each judge must also fail the faults planted in the file.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "io/gltf.h"
#include "lighting/environment.h"
#include "lodestar/display.glsl"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shared.h"

namespace lodestar {
namespace {

constexpr int kSide = 512;

/// Complaints about a picture; none if it is right.
using Complaints = std::vector<std::string>;

/// A rectangle of a picture, pixels.
struct Patch {
    int left, top, width, height;
};

/// A scene drawn from 100 times its size away, so that lengths across the view are pixels.
struct Flat {
    core::Image picture; ///< as a display shows it
    scene::Scene scene;
    float half = 1.0f; ///< of what is seen, metres
    float sign = 1.0f; ///< -1: seen from -Z, +X to the left

    [[nodiscard]] glm::vec2 pixel(const glm::vec3& world) const {
        return 0.5f * static_cast<float>(kSide) *
               glm::vec2(1.0f + sign * world.x / half, 1.0f - world.y / half);
    }
    [[nodiscard]] Patch patch(const scene::Bounds& box) const {
        const glm::vec2 a = pixel(box.low);
        const glm::vec2 b = pixel(box.high);
        const auto left = static_cast<int>(std::ceil(std::min(a.x, b.x)));
        const auto top = static_cast<int>(std::ceil(std::min(a.y, b.y)));
        return {left, top, static_cast<int>(std::max(a.x, b.x)) - left,
                static_cast<int>(std::max(a.y, b.y)) - top};
    }
    [[nodiscard]] glm::vec3 at(int x, int y) const {
        const float* p = picture.at(std::clamp(x, 0, kSide - 1), std::clamp(y, 0, kSide - 1));
        return {p[0], p[1], p[2]};
    }
};

/// Without the pixels that lie across the edge.
Patch inner(const Patch& patch) {
    return {patch.left + 2, patch.top + 2, patch.width - 4, patch.height - 4};
}

bool isRed(const glm::vec3& c) {
    return c.r > 0.4f && c.g < 0.5f * c.r && c.b < 0.5f * c.r;
}
bool isGreen(const glm::vec3& c) {
    return c.g > 0.4f && c.r < 0.6f * c.g && c.b < 0.6f * c.g;
}
bool isDark(const glm::vec3& c) {
    return std::max({c.r, c.g, c.b}) < 0.35f;
}
double shareOf(const Flat& flat, const Patch& patch, bool (*is)(const glm::vec3&)) {
    int count = 0;
    for (int y = 0; y < patch.height; ++y) {
        for (int x = 0; x < patch.width; ++x) {
            count += is(flat.at(patch.left + x, patch.top + y)) ? 1 : 0;
        }
    }
    return static_cast<double>(count) / (patch.width * patch.height);
}

/// A picture over [0, 1]^2, from its upper left.
using Light = std::function<double(double, double)>;

Light lightOf(const Flat& flat, const Patch& patch) {
    return [&flat, patch](double u, double v) {
        return static_cast<double>(glm::dot(flat.at(patch.left + static_cast<int>(u * patch.width),
                                                    patch.top + static_cast<int>(v * patch.height)),
                                            glm::vec3(1.0f / 3.0f)));
    };
}

/// How alike two pictures are, [-1, 1].
double correlation(const Light& a, const Light& b) {
    constexpr int kSteps = 64;
    double sum[5] = {};
    for (int y = 0; y < kSteps; ++y) {
        for (int x = 0; x < kSteps; ++x) {
            const double p = a((x + 0.5) / kSteps, (y + 0.5) / kSteps);
            const double q = b((x + 0.5) / kSteps, (y + 0.5) / kSteps);
            sum[0] += p;
            sum[1] += q;
            sum[2] += p * p;
            sum[3] += q * q;
            sum[4] += p * q;
        }
    }
    constexpr double kCount = kSteps * kSteps;
    const double variances =
        (sum[2] - sum[0] * sum[0] / kCount) * (sum[3] - sum[1] * sum[1] / kCount);
    return variances > 0.0 ? (sum[4] - sum[0] * sum[1] / kCount) / std::sqrt(variances) : 0.0;
}

/// Whether a picture is like another, and more so than like that one turned about in any way.
bool sameWayUp(const Light& picture, const Light& expected, double least) {
    const double same = correlation(picture, expected);
    bool most = same >= least;
    for (int turn = 1; turn < 8; ++turn) {
        most = most && same > correlation(picture, [&](double u, double v) {
                           const double x = (turn & 1) != 0 ? 1.0 - u : u;
                           const double y = (turn & 2) != 0 ? 1.0 - v : v;
                           return (turn & 4) != 0 ? expected(y, x) : expected(x, y);
                       });
    }
    return most;
}

class TextureAssets : public testing::GlTest {
protected:
    Flat draw(io::GltfFile file, float half, float sign,
              const lighting::AnalyticEnvironment& environment) {
        Flat flat{{}, scene::buildScene(std::move(file)), half, sign};
        scene::CameraRequest request;
        request.eye = glm::vec3(0.0f, 0.0f, sign * 100.0f * half);
        request.target = glm::vec3(0.0f);
        request.verticalFov = 2.0f * std::atan(0.01f);
        auto renderer = scene::Renderer::make(device(), flat.scene);
        EXPECT_TRUE(renderer.ok());
        (*renderer)->setEnvironment("light", lighting::cubeFromAnalytic(environment, 64));
        scene::RenderSettings settings;
        settings.width = settings.height = kSide;
        settings.samplesPerSide = 2;
        settings.backdrop = false;
        auto frame = (*renderer)->render(*scene::chooseView(flat.scene, request, 1.0f), settings);
        EXPECT_TRUE(frame.ok());
        flat.picture = std::move(frame->radiance);
        for (float& value : flat.picture.pixels()) {
            value = shader::lodestar_srgbFromLinear(std::min(value, 1.0f));
        }
        return flat;
    }

    using Fault = std::function<void(io::GltfFile&)>;
    using Judge = std::function<Complaints(const Flat&)>;
    /// The file as it is satisfies the judge, and no fault does.
    void expectJudged(const char* relative, float half, float sign,
                      const lighting::AnalyticEnvironment& environment, const Judge& judge,
                      const std::vector<std::pair<const char*, Fault>>& faults) {
        const auto file = io::loadGltf(testing::sharedPath("assets/gltf") / relative);
        ASSERT_TRUE(file.ok()) << file.error().message();
        for (const std::string& complaint : judge(draw(*file, half, sign, environment))) {
            ADD_FAILURE() << complaint;
        }
        for (const auto& [name, fault] : faults) {
            io::GltfFile wrong = *file;
            fault(wrong);
            EXPECT_FALSE(judge(draw(std::move(wrong), half, sign, environment)).empty())
                << "not noticed: " << name;
        }
    }
};

const lighting::ConstantEnvironment kWhite{};

/// Bounds of the meshes that nodes of a name show.
std::vector<scene::Bounds> boundsOf(const Flat& flat, const std::string& name) {
    std::vector<scene::Bounds> found;
    for (const scene::Node& node : flat.scene.nodes) {
        for (const scene::Component& component : node.components) {
            const auto* mesh = std::get_if<scene::MeshComponent>(&component);
            if (mesh != nullptr && node.name == name) {
                found.push_back(scene::primitiveWorldBounds(flat.scene, node, *mesh, 0));
            }
        }
    }
    return found;
}

/// Distance from a place to the nearest dark pixel of a patch, metres.
float distanceToDark(const Flat& flat, const Patch& patch, const glm::vec3& place) {
    const glm::vec2 from = flat.pixel(place);
    float nearest = 2.0f * kSide;
    for (int y = 0; y < patch.height; ++y) {
        for (int x = 0; x < patch.width; ++x) {
            const glm::vec2 to(patch.left + x, patch.top + y);
            if (isDark(flat.at(patch.left + x, patch.top + y))) {
                nearest = std::min(nearest, glm::distance(from, to));
            }
        }
    }
    return nearest * 2.0f * flat.half / kSide;
}

// The squares above hold a red cross but for the right offset; the arrows below end at the green
// mark.
Complaints judgeTransforms(const Flat& flat) {
    Complaints complaints;
    for (const char* name : {"Offset U", "Offset V", "Offset UV"}) {
        const auto boxes = boundsOf(flat, name);
        if (boxes.empty() || shareOf(flat, flat.patch(boxes[0]), isRed) > 0.01) {
            complaints.push_back(std::string(name) + " shows the cross");
        }
    }
    for (const std::string name : {"Rotation", "Scale", "All"}) {
        const auto quad = boundsOf(flat, name);
        const auto right = boundsOf(flat, name + " - Correct");
        if (quad.empty() || right.empty()) {
            complaints.push_back("no " + name);
            continue;
        }
        const Patch patch = flat.patch(quad[0]);
        // The mark's middle lies a mark's size beyond its tip; two pixels for either's edge.
        const float size = right[0].high.x - right[0].low.x;
        const float to = distanceToDark(flat, patch, right[0].center());
        if (to > size + 4.0f * flat.half / kSide) {
            complaints.push_back(name + " ends " + std::to_string(to) + " m from the mark");
        }
        for (const char* other : {" - Error", " - Not Supported"}) {
            for (const scene::Bounds& wrong : boundsOf(flat, name + other)) {
                if (distanceToDark(flat, patch, wrong.center()) < to) {
                    complaints.push_back(name + " ends at" + other);
                }
            }
        }
    }
    return complaints;
}

TEST_F(TextureAssets, TransformsShowTheMarks) {
    LODESTAR_NEEDS_SHARED();
    const auto withTransforms = [](const std::function<void(glm::mat3x2&)>& change) {
        return [change](io::GltfFile& file) {
            for (io::GltfMaterial& material : file.materials) {
                if (material.baseColorTexture.uvTransform) {
                    change(*material.baseColorTexture.uvTransform);
                }
            }
        };
    };
    expectJudged("assimp/textureTransform/TextureTransformTest.gltf", 1.7f, 1.0f, kWhite,
                 judgeTransforms,
                 {{"no transform", withTransforms([](glm::mat3x2& m) { m = glm::mat3x2(1.0f); })},
                  {"no offset", withTransforms([](glm::mat3x2& m) {
                       m[2] = {0, 0};
                   })},
                  {"turned the other way",
                   withTransforms([](glm::mat3x2& m) { std::swap(m[0].y, m[1].x); })}});
}

// Each row shows one picture twice, by the setting and as it should look, not quite in one place:
// green all over, or a mark that stands the same way; a cross nowhere.
Complaints judgeSettings(const Flat& flat) {
    Complaints complaints;
    int rows = 0;
    for (const io::GltfMesh& mesh : flat.scene.meshes) {
        if (mesh.name == "BackgroundMesh" || mesh.name == "LabelMesh") {
            continue;
        }
        // By the middle of the picture's two columns.
        scene::Bounds test, sample;
        for (const glm::vec3& p : mesh.primitives[0].positions) {
            (p.x < 1.5f ? test : sample).add({p.x, p.z, 0.0f}); // the file stands it up
        }
        const Patch a = inner(flat.patch(test));
        const Patch b = inner(flat.patch(sample));
        const double green = shareOf(flat, a, isGreen);
        const bool filled = green > 0.95 && shareOf(flat, b, isGreen) > 0.95;
        ++rows;
        if (shareOf(flat, a, isRed) > 0.01 || green < 0.05 ||
            (!filled && !sameWayUp(lightOf(flat, a), lightOf(flat, b), 0.5))) {
            complaints.push_back(mesh.name + " shows something else");
        }
    }
    if (rows != 8) {
        complaints.push_back(std::to_string(rows) + " rows");
    }
    return complaints;
}

TEST_F(TextureAssets, SettingsShowTheSamples) {
    LODESTAR_NEEDS_SHARED();
    const auto wraps = [](io::Wrap s, io::Wrap t) {
        return [s, t](io::GltfFile& file) {
            for (io::GltfTexture& texture : file.textures) {
                texture.wrapS = s;
                texture.wrapT = t;
            }
        };
    };
    expectJudged("khronos/TextureSettingsTest/glTF-Binary/TextureSettingsTest.glb", 5.8f, 1.0f,
                 kWhite, judgeSettings,
                 {{"all repeat", wraps(io::Wrap::Repeat, io::Wrap::Repeat)},
                  {"all clamp", wraps(io::Wrap::ClampToEdge, io::Wrap::ClampToEdge)},
                  {"all mirror", wraps(io::Wrap::MirroredRepeat, io::Wrap::MirroredRepeat)},
                  {"s and t exchanged",
                   [](io::GltfFile& file) {
                       for (io::GltfTexture& texture : file.textures) {
                           std::swap(texture.wrapS, texture.wrapT);
                       }
                   }},
                  {"all double-sided",
                   [](io::GltfFile& file) {
                       for (io::GltfMaterial& material : file.materials) {
                           material.doubleSided = true;
                       }
                   }},
                  {"all single-sided", [](io::GltfFile& file) {
                       for (io::GltfMaterial& material : file.materials) {
                           material.doubleSided = false;
                       }
                   }}});
}

// Each corner's quad shows that corner of the texture, two fifths of it, the way it lies there.
// What tells it from another corner turned about is the name alone, so that the likeness must be
// close.
Complaints judgeCorners(const Flat& flat) {
    Complaints complaints;
    const std::pair<const char*, glm::dvec2> corners[] = {{"TopLeftNode", {0.0, 0.0}},
                                                          {"TopRightNode", {0.6, 0.0}},
                                                          {"BottomLeftNode", {0.0, 0.6}},
                                                          {"BottomRightNode", {0.6, 0.6}}};
    const core::Texels& image = flat.scene.images[0];
    for (const auto& [name, corner] : corners) {
        const auto boxes = boundsOf(flat, name);
        const Light expected = [&image, from = corner](double u, double v) {
            return static_cast<double>(
                image.value(static_cast<int>((from.x + 0.4 * u) * image.width()),
                            static_cast<int>((from.y + 0.4 * v) * image.height()), 1));
        };
        if (boxes.empty() || !sameWayUp(lightOf(flat, flat.patch(boxes[0])), expected, 0.9)) {
            complaints.push_back(std::string(name) + " shows something else");
        }
    }
    return complaints;
}

TEST_F(TextureAssets, CornersAreWhereTheirNamesSay) {
    LODESTAR_NEEDS_SHARED();
    const auto uvs = [](const std::function<glm::vec2(glm::vec2)>& change) {
        return [change](io::GltfFile& file) {
            for (io::GltfMesh& mesh : file.meshes) {
                for (glm::vec2& uv : mesh.primitives[0].uvs[0]) {
                    uv = change(uv);
                }
            }
        };
    };
    expectJudged("khronos/TextureCoordinateTest/glTF/TextureCoordinateTest.gltf", 1.3f, -1.0f,
                 kWhite, judgeCorners,
                 {{"v upwards", uvs([](glm::vec2 uv) { return glm::vec2(uv.x, 1.0f - uv.y); })},
                  {"u leftwards", uvs([](glm::vec2 uv) { return glm::vec2(1.0f - uv.x, uv.y); })},
                  {"u and v exchanged", uvs([](glm::vec2 uv) { return glm::vec2(uv.y, uv.x); })}});
}

/// The squares of the file: parts of the mesh that hang together, by their boxes.
std::vector<scene::Bounds> squaresOf(const io::GltfPrimitive& primitive) {
    std::vector<std::uint32_t> group(primitive.positions.size());
    std::iota(group.begin(), group.end(), 0u);
    const std::function<std::uint32_t(std::uint32_t)> root = [&](std::uint32_t i) {
        return group[i] == i ? i : group[i] = root(group[i]);
    };
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        group[root(primitive.indices[i])] = root(primitive.indices[i + 1]);
        group[root(primitive.indices[i + 1])] = root(primitive.indices[i + 2]);
    }
    std::vector<scene::Bounds> boxes(group.size());
    for (std::uint32_t i = 0; i < group.size(); ++i) {
        boxes[root(i)].add(primitive.positions[i]);
    }
    std::erase_if(boxes, [](const scene::Bounds& box) {
        const glm::vec3 size = box.high - box.low;
        return box.empty() || size.x < 0.2f || size.y < 0.2f || size.x > 0.5f;
    });
    return boxes;
}

// Beside each modelled bump lies one made by a normal map, turned some way: as lit they must be
// more like each other than like themselves turned about.
Complaints judgeBumps(const Flat& flat) {
    std::vector<scene::Bounds> squares = squaresOf(flat.scene.meshes[0].primitives[0]);
    std::sort(squares.begin(), squares.end(), [](const auto& a, const auto& b) {
        return std::pair(std::round(-a.center().y * 20.0f), a.low.x) <
               std::pair(std::round(-b.center().y * 20.0f), b.low.x);
    });
    Complaints complaints;
    if (squares.size() != 30) {
        return {std::to_string(squares.size()) + " squares"};
    }
    for (std::size_t i = 0; i < squares.size(); i += 2) {
        if (!sameWayUp(lightOf(flat, flat.patch(squares[i])),
                       lightOf(flat, flat.patch(squares[i + 1])), 0.7)) {
            complaints.push_back("pair " + std::to_string(i / 2) + " is bumped another way");
        }
    }
    return complaints;
}

TEST_F(TextureAssets, NormalMapsBumpTheWayOfTheModel) {
    LODESTAR_NEEDS_SHARED();
    const lighting::DiscEnvironment lamp{glm::normalize(glm::dvec3(0.5, 0.6, 0.6)), 0.45,
                                         glm::dvec3(4.0), glm::dvec3(0.15)};
    expectJudged(
        "khronos/NormalTangentTest/glTF-Binary/NormalTangentTest.glb", 1.3f, 1.0f, lamp, judgeBumps,
        {{"bumps are dents", [](io::GltfFile& file) { file.materials[0].normalScale = -1.0f; }},
         {"flat", [](io::GltfFile& file) { file.materials[0].normalScale = 0.0f; }},
         {"v upwards", [](io::GltfFile& file) {
              core::Texels& map = file.images[static_cast<std::size_t>(
                  file.textures[static_cast<std::size_t>(file.materials[0].normalTexture.texture)]
                      .image)];
              for (std::size_t i = 1; i < map.bytes().size(); i += 4) {
                  map.bytes()[i] = static_cast<unsigned char>(255 - map.bytes()[i]);
              }
          }}});
}

} // namespace
} // namespace lodestar
