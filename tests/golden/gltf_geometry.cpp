// SPDX-License-Identifier: MIT
//
// Goldens of vertices and nodes: sparse and quantized data, modes, normals, colours, transforms,
// scenes and cameras. Rectangles end at pixel borders, so that they cover an exact count of pixels.
#include <set>

#include "golden/gltf_golden.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

void sparse(GltfBuilder& file) {
    const int orange = file.unlit(0.9f, 0.5f, 0.1f);
    const int blue = file.unlit(0.1f, 0.3f, 0.9f);
    // The upper corners come down from y = 0.8 to y = 0.
    Json moved = file.panel(-1.0f, -0.8f, -0.2f, 0.8f, orange);
    const auto substitute = [&](Json& accessor, const std::vector<std::uint16_t>& which,
                                const std::vector<float>& positions) {
        accessor["sparse"] = {
            {"count", which.size()},
            {"indices", {{"bufferView", file.view(which, 1)}, {"componentType", 5123}}},
            {"values", {{"bufferView", file.view(positions, 3)}}}};
    };
    Json& base = file.document["accessors"][moved["attributes"]["POSITION"].get<std::size_t>()];
    substitute(base, {0, 1}, {-1, 0, 0, -0.2f, 0, 0});
    base["max"] = {-0.2, 0, 0};
    // All zero but for three corners.
    Json grown = file.panel(0.0f, -0.8f, 0.8f, 0.0f, blue);
    Json zeros = {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}};
    zeros["min"] = {0, -0.8f, 0};
    zeros["max"] = {0.8f, 0, 0};
    substitute(zeros, {1, 2, 3}, {0.8f, 0, 0, 0.8f, -0.8f, 0, 0, -0.8f, 0});
    grown["attributes"]["POSITION"] = file.add("accessors", zeros);
    file.show({moved, grown});
}

/// A primitive of a mode over points given by pixel column and row.
Json drawn(GltfBuilder& file, int mode, int material, const std::vector<glm::ivec2>& pixels) {
    std::vector<glm::vec3> positions;
    for (const glm::ivec2& p : pixels) {
        positions.emplace_back(pixelMiddle(p.x), -pixelMiddle(p.y), 0.0f);
    }
    return {{"mode", mode},
            {"attributes", {{"POSITION", file.vectors(positions)}}},
            {"material", material}};
}

void points(GltfBuilder& file) {
    file.show({drawn(file, 0, file.unlit(0.9f, 0.2f, 0.2f),
                     {{20, 20}, {48, 12}, {70, 30}, {64, 70}, {30, 60}, {12, 84}})});
}

void lines(GltfBuilder& file) {
    const std::vector<glm::ivec2> corners = {{0, 0}, {20, 0}, {20, 24}, {0, 24}, {0, 12}, {10, 12}};
    const auto moved = [&](int x, int y) {
        std::vector<glm::ivec2> result = corners;
        for (glm::ivec2& p : result) {
            p += glm::ivec2(x, y);
        }
        return result;
    };
    file.show({drawn(file, 1, file.unlit(0.9f, 0.2f, 0.2f), moved(8, 8)),
               drawn(file, 3, file.unlit(0.2f, 0.9f, 0.2f), moved(38, 36)),
               drawn(file, 2, file.unlit(0.3f, 0.4f, 1.0f), moved(68, 64))});
}

/// A strip and a fan that turn towards the camera in every triangle, of 32 x 32 pixels each.
void stripsAndFans(GltfBuilder& file) {
    const auto shape = [&](int mode, int material, const std::vector<float>& corners) {
        std::vector<float> positions;
        for (std::size_t i = 0; i < corners.size(); i += 2) {
            positions.insert(positions.end(), {corners[i], corners[i + 1], 0.0f});
        }
        return Json{{"mode", mode},
                    {"attributes", {{"POSITION", file.floats("VEC3", positions)}}},
                    {"material", material}};
    };
    file.show({shape(5, file.unlit(0.9f, 0.6f, 0.1f),
                     {-1, 1, -1, 0.2f, -0.6f, 1, -0.6f, 0.2f, -0.2f, 1, -0.2f, 0.2f}),
               shape(6, file.unlit(0.1f, 0.6f, 0.8f),
                     {0.2f, -1, 1, -1, 1, -0.4f, 1, -0.2f, 0.6f, -0.2f, 0.2f, -0.2f})});
}

void withoutMode(Json& document) {
    eachPrimitive(document, [](Json& primitive) { primitive.erase("mode"); });
}

/// Two triangles without indices; the accessor of indices that names one only is not used.
void noIndices(GltfBuilder& file) {
    Json primitive = {
        {"attributes",
         {{"POSITION", file.floats("VEC3", {-0.8f, 0.6f, 0, -0.8f, -0.6f, 0, 0.8f, -0.6f, 0, -0.8f,
                                            0.6f, 0, 0.8f, -0.6f, 0, 0.8f, 0.6f, 0})},
          {"NORMAL", file.floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})}}},
        {"material", file.lambert(0.7f, 0.8f, 0.3f)}};
    primitive["extras"]["one"] = file.indices({0, 1, 2});
    file.show({primitive});
}

/// An octahedron without normals: flat faces. The smooth normals' accessor is not used.
void generatedNormals(GltfBuilder& file) {
    const std::vector<glm::vec3> corners = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                            {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    Json primitive = {{"attributes", {{"POSITION", file.vectors(corners)}}},
                      {"indices", file.indices({0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                                2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5})},
                      {"material", file.lambert(0.8f, 0.8f, 0.8f)}};
    primitive["extras"]["smooth"] = file.vectors(corners);
    file.show({primitive}, {{"rotation", {0.2425356, 0.2425356, 0.1212678, 0.9315413}}});
}

void oneColorAFace(const Shot& shot) {
    std::set<std::array<float, 3>> colors;
    for (std::size_t i = 0; i < shot.radiance.pixels().size(); i += 4) {
        const float* p = &shot.radiance.pixels()[i];
        if (p[3] > 0.0f) {
            // 1e-3 holds what interpolation of equal normals rounds.
            colors.insert(
                {std::round(p[0] * 1e3f), std::round(p[1] * 1e3f), std::round(p[2] * 1e3f)});
        }
    }
    // A solid of eight faces shows four of them, from anywhere that is in no face's plane.
    EXPECT_GE(colors.size(), 4U);
    EXPECT_LE(colors.size(), 8U) << "a colour may fall between two steps";
}

/// Red rises to the right, blue downwards; four ways to store it, exact in all.
void vertexColors(GltfBuilder& file) {
    const int white = file.unlit(1.0f, 1.0f, 1.0f);
    const auto panel = [&](float x, float y, int colors) {
        Json json = file.panel(x, y, x + 0.8f, y + 0.8f, white);
        json["attributes"]["COLOR_0"] = colors;
        return json;
    };
    const std::vector<std::uint8_t> bytes = {51,  51, 51,  255, 255, 51, 51,  255,
                                             255, 51, 255, 255, 51,  51, 255, 255};
    std::vector<std::uint16_t> shorts;
    std::vector<float> four;
    std::vector<float> three;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto value = static_cast<float>(bytes[i]) / 255.0f;
        four.push_back(value);
        if (i % 4 != 3) {
            shorts.push_back(static_cast<std::uint16_t>(bytes[i] * 257));
            three.push_back(value);
        }
    }
    file.show({panel(-1.0f, 0.2f, file.accessor("VEC4", bytes, true)),
               panel(0.2f, 0.2f, file.accessor("VEC3", shorts, true)),
               panel(-1.0f, -1.0f, file.floats("VEC4", four)),
               panel(0.2f, -1.0f, file.floats("VEC3", three))});
}

void colorsAreLinear(const Shot& shot) {
    for (const glm::vec2& corner :
         {glm::vec2(-1, 1), glm::vec2(0.2f, 1), glm::vec2(-1, -0.2f), glm::vec2(0.2f, -0.2f)}) {
        // The middle of the panel's pixel (8, 20) of 32 x 32. Interpolation is of single precision.
        const glm::vec2 in(8.5f / 32.0f, 20.5f / 32.0f);
        expectColor(shot.at(corner.x + 0.8f * in.x, corner.y - 0.8f * in.y),
                    {0.2f + 0.8f * in.x, 0.2f, 0.2f + 0.8f * in.y}, 1e-5f);
    }
}

/// KHR_mesh_quantization: a sphere of shorts and bytes.
void quantized(GltfBuilder& file) {
    file.uses("KHR_mesh_quantization");
    file.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const io::GltfPrimitive shape = sphere(24, 48);
    const auto integers = [](const auto& vectors, auto one) {
        std::vector<decltype(one)> result;
        for (const auto& v : vectors) {
            for (glm::length_t c = 0; c < v.length(); ++c) {
                result.push_back(
                    static_cast<decltype(one)>(std::lround(v[c] * static_cast<float>(one))));
            }
        }
        return result;
    };
    Json material = {{"pbrMetallicRoughness",
                      {{"baseColorTexture", {{"index", file.texture("four.png", fourColors())}}},
                       {"metallicFactor", 0},
                       {"roughnessFactor", 0.6}}}};
    Json primitive = file.primitive(shape, file.add("materials", material));
    Json& attributes = primitive["attributes"];
    attributes["POSITION"] =
        file.accessor("VEC3", integers(shape.positions, std::int16_t{32767}), true);
    attributes["NORMAL"] = file.accessor("VEC3", integers(shape.normals, std::int8_t{127}), true);
    attributes["TEXCOORD_0"] =
        file.accessor("VEC2", integers(shape.uvs[0], std::uint16_t{65535}), true);
    file.show({primitive});
}

/// But for the normals: bytes that are none are refused.
void notNormalized(Json& document) {
    for (Json& accessor : document["accessors"]) {
        if (accessor["componentType"] != 5120) {
            accessor.erase("normalized");
        }
    }
}

void asInFloats(const Shot& shot) {
    GltfBuilder floats;
    floats.texture("four.png", fourColors());
    Json primitive = floats.primitive(sphere(24, 48), 0);
    floats.document["materials"] = shot.built.document["materials"];
    floats.show({primitive});
    floats.orthographicCamera();
    // A normal of bytes is off by sqrt(3) / 2 of 1/127: 0.007 rad. Light from faces of radiance up
    // to 1.6 changes by at most that much a radian through Lambert's lobe, and this lobe of
    // roughness 0.6 is sharper by less than 4. Texels change at a border within the uv's rounding.
    expectSame(shot.radiance, shot.render(floats), 4 * 1.6 * 0.007, 2e-3);
}

/// A sphere made an ellipsoid away from the middle, turned, under a node that mirrors x.
void mirrored(GltfBuilder& file) {
    const Json primitive = file.primitive(sphere(24, 48), file.lambert(0.8f, 0.7f, 0.6f));
    const int inner =
        file.add("nodes", {{"mesh", file.add("meshes", {{"primitives", {primitive}}})},
                           {"translation", {0.4, 0.2, 0}},
                           {"rotation", {0, 0, 0.3826834, 0.9238795}},
                           {"scale", {0.65, 0.3, 0.4}}});
    file.node({{"name", "mirror"}, {"children", {inner}}, {"scale", {-1, 1, 1}}});
}

void notMirrored(Json& document) {
    for (Json& node : document["nodes"]) {
        if (node.value("name", "") == "mirror") {
            node.erase("scale");
        }
    }
}

/// The light is the same to the left and to the right, so that the picture is the other's mirror
/// image, but for pixels whose middle lies on the silhouette. Lambert's light is single precision.
void mirrorImage(const Shot& shot) {
    GltfBuilder other = shot.built;
    notMirrored(other.document);
    const core::Image straight = shot.render(other);
    core::Image turned = straight;
    for (int y = 0; y < kGltfSide; ++y) {
        for (int x = 0; x < kGltfSide; ++x) {
            std::copy_n(straight.at(kGltfSide - 1 - x, y), 4, turned.at(x, y));
        }
    }
    expectSame(shot.radiance, turned, 1e-3, 1e-3);
}

/// An ellipsoid by the node's scale. The normals of who turns them as positions are not used.
void unevenScale(GltfBuilder& file) {
    const glm::vec3 scale(1.0f, 0.4f, 0.7f);
    const io::GltfPrimitive shape = sphere(24, 48);
    Json primitive = file.primitive(shape, file.lambert(0.9f, 0.9f, 0.9f));
    std::vector<glm::vec3> wrong;
    for (const glm::vec3& n : shape.normals) {
        wrong.push_back(glm::normalize(scale * scale * n));
    }
    primitive["extras"]["wrong"] = file.vectors(wrong);
    file.show({primitive}, {{"rotation", {0.1305262, 0, 0.2588190, 0.9570691}},
                            {"scale", {scale.x, scale.y, scale.z}}});
}

void ellipsoidsNormals(const Shot& shot) {
    const glm::vec3 scale(1.0f, 0.4f, 0.7f);
    io::GltfPrimitive shape = sphere(24, 48);
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        shape.normals[i] = glm::normalize(shape.normals[i] / scale);
        shape.positions[i] *= scale;
    }
    GltfBuilder baked;
    const Json primitive = baked.primitive(shape, baked.lambert(0.9f, 0.9f, 0.9f));
    baked.show({primitive}, {{"rotation", {0.1305262, 0, 0.2588190, 0.9570691}}});
    baked.orthographicCamera();
    // Unequal lengths weigh the interpolated normals otherwise: over a face of 7.5 degrees they
    // turn by no more than its square / 8 times the lengths' ratio 2.5, 0.005 rad, times 1.6.
    expectSame(shot.radiance, shot.render(baked), 1.6 * 0.005, 1e-3);
}

/// Two scenes: a panel at the left and, shown here, two at the right.
void secondScene(GltfBuilder& file) {
    file.show({file.panel(-1.0f, -0.5f, -0.5f, 0.5f, file.unlit(0.9f, 0.1f, 0.1f))});
    const Json two = {file.panel(0.1f, -0.5f, 0.4f, 0.5f, file.unlit(0.1f, 0.8f, 0.1f)),
                      file.panel(0.6f, -0.5f, 0.9f, 0.5f, 1)};
    const int mesh = file.add("meshes", {{"primitives", two}});
    const int node = file.add("nodes", {{"mesh", mesh}});
    const int camera = file.add("cameras", Json::parse(R"({"type": "orthographic", "orthographic":
        {"xmag": 1.2, "ymag": 1.2, "znear": 0.1, "zfar": 20}})"));
    const int eye = file.add("nodes", {{"camera", camera}, {"translation", {0, 0, 5}}});
    file.add("scenes", {{"name", "second"}, {"nodes", {node, eye}}});
}

void otherScene(Json& document) {
    document["scenes"][1]["nodes"] = document["scenes"][0]["nodes"];
}

/// Two squares of one size, one four times as far.
void squares(GltfBuilder& file) {
    file.show({file.panel(-0.9f, -0.4f, -0.1f, 0.4f, file.unlit(0.9f, 0.7f, 0.1f), 4.0f),
               file.panel(0.1f, -0.4f, 0.9f, 0.4f, file.unlit(0.2f, 0.4f, 0.9f), 1.0f)});
}

void perspectiveCamera(GltfBuilder& file) {
    squares(file);
    const int camera = file.add("cameras", Json::parse(R"({"type": "perspective", "perspective":
        {"yfov": 1.5707963, "znear": 0.1}})"));
    file.node({{"camera", camera}, {"translation", {0, 0, 5}}});
}

void otherProjection(Json& document) {
    Json& camera = document["cameras"][0];
    camera = camera["type"] == "perspective"
                 ? Json::parse(R"({"type": "orthographic", "orthographic": {"xmag": 1.2,
                       "ymag": 1.2, "znear": 0.1, "zfar": 20}})")
                 : Json::parse(R"({"type": "perspective", "perspective":
                       {"yfov": 1.5707963, "znear": 0.1}})");
}

template <int kPixels>
void covers(const Shot& shot) {
    EXPECT_EQ(covered(shot.radiance), kPixels);
}

} // namespace

std::vector<GltfGolden> geometryGoldens() {
    return {
        {"sparse-accessor", sparse,
         [](Json& document) {
             for (Json& accessor : document["accessors"]) {
                 accessor.erase("sparse");
             }
         },
         covers<2 * 32 * 32>},
        {"points", points, withoutMode, covers<6 * 3 * 3>}, // three pixels wide each
        // Lengths of list, loop and strip. The last pixel of each of 14 lines is the driver's
        // choice.
        {"lines", lines, withoutMode,
         [](const Shot& shot) {
             EXPECT_NEAR(covered(shot.radiance), (20 + 20 + 10) + (86 + 12) + 86, 15);
         },
         Light::Faces, -1, -1.0, 2e-3},
        {"strips-and-fans", stripsAndFans, withoutMode, covers<2 * 32 * 32>},
        {"no-indices", noIndices,
         [](Json& document) {
             eachPrimitive(document, [](Json& p) { p["indices"] = p["extras"]["one"]; });
         },
         covers<64 * 48>},
        {"generated-normals", generatedNormals,
         [](Json& document) {
             eachPrimitive(document,
                           [](Json& p) { p["attributes"]["NORMAL"] = p["extras"]["smooth"]; });
         },
         oneColorAFace},
        {"vertex-colors", vertexColors,
         [](Json& document) {
             eachPrimitive(document, [](Json& p) { p["attributes"].erase("COLOR_0"); });
         },
         colorsAreLinear},
        // Texels change along two lines of 80 pixels, whose middles may fall on either side.
        {"quantized", quantized, notNormalized, asInFloats, Light::Faces, -1, -1.0, 5e-3},
        {"negative-scale", mirrored, notMirrored, mirrorImage, Light::Even},
        {"uneven-scale", unevenScale,
         [](Json& document) {
             eachPrimitive(document,
                           [](Json& p) { p["attributes"]["NORMAL"] = p["extras"]["wrong"]; });
         },
         ellipsoidsNormals},
        {"second-scene", secondScene, otherScene, covers<2 * 12 * 40>, Light::Faces, 1},
        {"orthographic-camera", squares, otherProjection, covers<2 * 32 * 32>},
        // At distances 1 and 4 a unit is 48 and 12 pixels; the near square is cut at the border.
        {"perspective-camera", perspectiveCamera, otherProjection,
         [](const Shot& shot) {
             const double near = (0.9 - 0.1) * 48 * 0.8 * 48;
             const double far = (0.9 - 0.1) * 12 * 0.8 * 12;
             // Borders do not fall between pixels: half a pixel along each side.
             EXPECT_NEAR(covered(shot.radiance), near + far, 2 * (0.8 * 48 + 0.8 * 12));
         }},
    };
}

} // namespace lodestar::testing
