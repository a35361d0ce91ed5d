// SPDX-License-Identifier: MIT
#include "engine_light.h"

#include <vector>

#include <glm/gtc/type_ptr.hpp>

#include "hosts/material.h"
#include "hosts/shading.h"
#include "scene/scene.h"

namespace lodestar::samples {
namespace {

constexpr GLuint kFirstUnit = 8; ///< behind the engine's own

constexpr const char* kLighting = R"(
uniform vec3 eye;
uniform vec4 towardsViewer; // w: 1 where all views are parallel
vec3 viewFrom(vec3 position) {
    return towardsViewer.w > 0.0 ? towardsViewer.xyz : normalize(eye - position);
}
vec3 reflection(vec3 position, vec3 normal) {
    vec3 view = viewFrom(position);
    return 2.0 * dot(normal, view) * normal - view;
}
vec3 lighting(EnginePixel pixel) {
    LodestarSurface here;
    here.view = viewFrom(pixel.position);
    here.normal = pixel.normal;
    here.diffuse = pixel.surface0.rgb;
    here.exponent = pixel.surface0.w;
    here.f0 = pixel.surface1.rgb;
    here.occlusion = 1.0;
    // A quad of a screen pass lies on several objects, so the derivatives of the triangle's own
    // quad give the neighbour in it: on the right and above of even pixels, else on the left and
    // below.
    vec3 r = reflection(pixel.position, pixel.normal);
    vec2 to = 1.0 - 2.0 * mod(floor(gl_FragCoord.xy), 2.0);
    vec3 dx = to.x * (reflection(pixel.position + to.x * pixel.positionDx, pixel.normal + to.x * pixel.normalDx) - r);
    vec3 dy = to.y * (reflection(pixel.position + to.y * pixel.positionDy, pixel.normal + to.y * pixel.normalDy) - r);
    vec3 radiance = lodestar_lighting(here, dx, dy);
    return vec3(lodestar_srgbFromLinear(lodestar_filmic(radiance.r)),
                lodestar_srgbFromLinear(lodestar_filmic(radiance.g)),
                lodestar_srgbFromLinear(lodestar_filmic(radiance.b)));
})";

void setView(const scene::View& view, GLuint program) {
    const auto at = [&](const char* name) { return glGetUniformLocation(program, name); };
    const glm::vec4 towards(view.towardsViewer, view.perspective ? 0.0f : 1.0f);
    glUniform3fv(at("eye"), 1, glm::value_ptr(view.position));
    glUniform4fv(at("towardsViewer"), 1, glm::value_ptr(towards));
}

} // namespace

EngineLight::EngineLight(const hosts::LitContext& lit, Loader loader)
    : lit_(lit),
      gl_(static_cast<const LodestarGlApi*>(lit.api().get_extension(LODESTAR_EXTENSION_GL))),
      attached_(gl_ != nullptr && gl_->attach(lit.get(), loader) == LODESTAR_OK) {}

EngineLight::~EngineLight() {
    if (attached_) {
        gl_->detach(lit_.get(), 1);
    }
}

core::Result<void> EngineLight::prepare(const io::GltfFile& file, DeferredEngine& engine) const {
    if (!attached_) {
        return core::Error{core::ErrorCode::NoOpenGl, lit_.refusal().what, {}, {}};
    }
    if (!addScene(file, engine)) {
        return lit_.refusal();
    }
    const std::string refused =
        engine.setLighting(hosts::shadingText(lit_.api(), LODESTAR_PROFILE_CORE) + kLighting);
    if (!refused.empty()) {
        return core::Error{core::ErrorCode::Internal, "the shading text: " + refused, {}, {}};
    }
    return {};
}

core::Result<void> EngineLight::set(double hour, const scene::View& view,
                                    const DeferredEngine& engine) const {
    const GLuint program = engine.lightingProgram();
    glUseProgram(program);
    setView(view, program);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    return light(hour, program) ? core::Result<void>() : lit_.refusal();
}

/// @return whether the library took its material
bool EngineLight::addPrimitive(const io::GltfFile& file, const glm::mat4& world,
                               const io::GltfPrimitive& primitive, DeferredEngine& engine) const {
    if (primitive.topology != io::Topology::Triangles || primitive.normals.empty()) {
        return true;
    }
    float packed[8];
    if (!hosts::packMaterial(lit_, file, primitive.material, packed)) {
        return false;
    }
    engine.add({.positions = primitive.positions,
                .normals = primitive.normals,
                .indices = primitive.indices,
                .worldFromMesh = world,
                .surface = {glm::make_vec4(packed), glm::make_vec4(packed + 4)},
                .doubleSided = hosts::isDoubleSided(file, primitive.material)});
    return true;
}

bool EngineLight::addScene(const io::GltfFile& file, DeferredEngine& engine) const {
    const scene::Scene scene = scene::buildScene(file, file.defaultScene);
    for (const scene::Node& node : scene.nodes) {
        for (const scene::Component& component : node.components) {
            const auto* drawn = std::get_if<scene::MeshComponent>(&component);
            if (drawn == nullptr) {
                continue;
            }
            for (const io::GltfPrimitive& primitive :
                 scene.meshes[static_cast<std::size_t>(drawn->mesh)].primitives) {
                if (!addPrimitive(file, node.worldFromNode, primitive, engine)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/// The library's textures behind the engine's own units. @return whether it gave them
bool EngineLight::bindTexture(const LodestarUniform& sampler, GLuint program, GLuint unit) const {
    LodestarGlTexture texture{};
    texture.struct_size = sizeof texture;
    if (gl_->texture(lit_.get(), sampler.texels, &texture) != LODESTAR_OK) {
        return false;
    }
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(texture.target, texture.name);
    glUniform1i(glGetUniformLocation(program, sampler.name), static_cast<GLint>(unit));
    return true;
}

bool EngineLight::light(double hour, GLuint program) const {
    LodestarFrame frame{};
    frame.struct_size = sizeof frame;
    frame.hour = hour;
    LodestarPlan plan = 0;
    if (lit_.api().plan_make(lit_.get(), &frame, &plan) != LODESTAR_OK ||
        gl_->execute(lit_.get(), plan) != LODESTAR_OK) {
        return false;
    }
    const std::vector<unsigned char> data = hosts::uniformData(lit_.api(), lit_.get(), plan);
    GLuint unit = kFirstUnit;
    for (const LodestarUniform& uniform : hosts::uniforms(lit_.api())) {
        if (uniform.type == LODESTAR_UNIFORM_VEC4) {
            glUniform4fv(glGetUniformLocation(program, uniform.name),
                         static_cast<GLsizei>(uniform.count),
                         reinterpret_cast<const float*>(data.data() + uniform.offset));
        } else if (!bindTexture(uniform, program, unit++)) {
            return false;
        }
    }
    return true;
}

} // namespace lodestar::samples
