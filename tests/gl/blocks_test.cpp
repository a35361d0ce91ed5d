// SPDX-License-Identifier: MIT
//
// The uniform blocks' C++ structs against the driver's offsets, and every shader variant compiled.
#include <string>

#include <epoxy/gl.h>

#include "gl/program.h"
#include "host/blocks.glsl"
#include "scene/renderer.h"
#include "support/gl_fixture.h"

namespace lodestar {
namespace {

class Blocks : public testing::GlTest {};

struct Field {
    const char* name;
    std::size_t offset;
};

#define LODESTAR_FIELD(block, member)                                                              \
    Field {                                                                                        \
#member, offsetof(scene::blocks::block, member)                                            \
    }

gl::Defines everything(int specular, int diffuse, bool on) {
    gl::Defines defines;
    for (const char* name : {"LODESTAR_NORMALS",
                             "LODESTAR_TANGENTS",
                             "LODESTAR_VERTEX_COLORS",
                             "LODESTAR_BASE_COLOR_TEXTURE",
                             "LODESTAR_METALLIC_ROUGHNESS_TEXTURE",
                             "LODESTAR_NORMAL_TEXTURE",
                             "LODESTAR_OCCLUSION_TEXTURE",
                             "LODESTAR_EMISSIVE_TEXTURE",
                             "LODESTAR_BLINN_PHONG",
                             "LODESTAR_EXPONENT_TEXTURE",
                             "LODESTAR_ALPHA_MASK",
                             "LODESTAR_ALPHA_BLEND",
                             "LODESTAR_PUNCTUAL_LIGHTS",
                             "LODESTAR_ENVIRONMENT",
                             "LODESTAR_BIAS_VERTEX",
                             "LODESTAR_TEXTURE_TRANSFORM",
                             "LODESTAR_SPECULAR_TEXTURE",
                             "LODESTAR_SPECULAR_COLOR_TEXTURE",
                             "LODESTAR_SKINNING",
                             "LODESTAR_SECOND_JOINTS",
                             "LODESTAR_RSRM_LIGHTS",
                             "LODESTAR_SUNS",
                             "LODESTAR_RSRM_LAYOUT",
                             "LODESTAR_RSRM_MIRROR",
                             "LODESTAR_RSRM_ROWS",
                             "LODESTAR_SHADOWS"}) {
        defines.emplace_back(name, on ? "1" : "0");
    }
    // Unlit leaves all the rest out; EverySingleFeatureCompiles switches it on.
    defines.emplace_back("LODESTAR_UNLIT", "0");
    defines.emplace_back("LODESTAR_SPECULAR", std::to_string(specular));
    defines.emplace_back("LODESTAR_DIFFUSE", std::to_string(diffuse));
    return defines;
}

void expectOffset(unsigned program, const Field& field) {
    std::string name = field.name;
    GLuint index = GL_INVALID_INDEX;
    for (const std::string& candidate : {name, name + "[0]"}) {
        const char* text = candidate.c_str();
        if (index == GL_INVALID_INDEX) {
            glGetUniformIndices(program, 1, &text, &index);
        }
    }
    ASSERT_NE(index, GL_INVALID_INDEX) << name << " is not an active uniform";
    GLint offset = -1;
    glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, &offset);
    EXPECT_EQ(static_cast<std::size_t>(offset), field.offset) << name;
}

TEST_F(Blocks, OffsetsAreTheDrivers) {
    auto program =
        gl::Program::make(device(), "host/mesh.vert", "host/mesh.frag", everything(3, 1, true));
    ASSERT_TRUE(program.ok()) << program.error().message();
    const Field fields[] = {LODESTAR_FIELD(LodestarFrame, clipFromWorld),
                            LODESTAR_FIELD(LodestarFrame, worldFromClip),
                            LODESTAR_FIELD(LodestarFrame, cameraPosition),
                            LODESTAR_FIELD(LodestarFrame, environmentCube),
                            LODESTAR_FIELD(LodestarFrame, irradianceCube),
                            LODESTAR_FIELD(LodestarFrame, sh9),
                            LODESTAR_FIELD(LodestarFrame, lightCount),
                            LODESTAR_FIELD(LodestarFrame, lightPosition),
                            LODESTAR_FIELD(LodestarFrame, lightColor),
                            LODESTAR_FIELD(LodestarFrame, lightDirection),
                            LODESTAR_FIELD(LodestarFrame, lightCone),
                            LODESTAR_FIELD(LodestarRsrmLights, rsrmMap),
                            LODESTAR_FIELD(LodestarRsrmLights, rsrmTexel),
                            LODESTAR_FIELD(LodestarRsrmLights, rsrmRows),
                            LODESTAR_FIELD(LodestarRsrmLights, rsrmAxis),
                            LODESTAR_FIELD(LodestarRsrmLights, rsrmShadow),
                            LODESTAR_FIELD(LodestarRsrmLights, rsrmScale),
                            LODESTAR_FIELD(LodestarRsrmLights, shadowFromWorld),
                            LODESTAR_FIELD(LodestarRsrmLights, shadowTexel),
                            LODESTAR_FIELD(LodestarRsrmLights, rsrmOctaves),
                            LODESTAR_FIELD(LodestarMaterial, baseColor),
                            LODESTAR_FIELD(LodestarMaterial, emissive),
                            LODESTAR_FIELD(LodestarMaterial, surface),
                            LODESTAR_FIELD(LodestarMaterial, diffuse),
                            LODESTAR_FIELD(LodestarMaterial, f0),
                            LODESTAR_FIELD(LodestarMaterial, specular),
                            LODESTAR_FIELD(LodestarMaterial, more),
                            LODESTAR_FIELD(LodestarMaterial, uvRows)};
    for (const Field& field : fields) {
        expectOffset(program->id(), field);
    }
}

TEST_F(Blocks, EveryEstimatorVariantCompiles) {
    for (int specular = 0; specular < 4; ++specular) {
        for (int diffuse = 0; diffuse < 4; ++diffuse) {
            for (const bool on : {false, true}) {
                gl::Defines defines = everything(specular, diffuse, on);
                for (auto& [name, value] : defines) {
                    value = name == "LODESTAR_ENVIRONMENT" ? "1" : value;
                }
                auto program =
                    gl::Program::make(device(), "host/mesh.vert", "host/mesh.frag", defines);
                EXPECT_TRUE(program.ok()) << program.error().message();
            }
        }
    }
}

TEST_F(Blocks, EverySingleFeatureCompiles) {
    const gl::Defines none = everything(3, 0, false);
    for (std::size_t feature = 0; feature + 2 < none.size(); ++feature) {
        gl::Defines defines = none;
        defines[feature].second.assign(1, '1');
        defines[0].second.assign(1, '1');
        auto program = gl::Program::make(device(), "host/mesh.vert", "host/mesh.frag", defines);
        EXPECT_TRUE(program.ok()) << defines[feature].first << ": " << program.error().message();
    }
}

TEST_F(Blocks, ABrokenShaderNamesItself) {
    expectErrors();
    auto program = gl::Program::makeFromText(
        device(), "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }",
        "#version 330 core\nvoid main() { nonsense; }", "broken");
    ASSERT_FALSE(program.ok());
    EXPECT_NE(program.error().message().find("broken"), std::string::npos);
    EXPECT_NE(program.error().message().find("nonsense"), std::string::npos);
}

} // namespace
} // namespace lodestar
