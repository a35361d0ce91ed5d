// SPDX-License-Identifier: MIT
//
// lodestar-host-foreign: an engine that is deferred and knows nothing of Lodestar
// (deferred_engine.h), lit by a lighting document: textures by the extension "lodestar.gl", one
// text for its lighting pass.
#include <algorithm>
#include <vector>

#include <epoxy/egl.h>

#include <glm/gtc/type_ptr.hpp>

#include "call.h"
#include "deferred_engine.h"
#include "hosts/lit_context.h"
#include "hosts/material.h"
#include "hosts/shading.h"
#include "platform/headless_context.h"

namespace lodestar::samples {
namespace {

constexpr GLuint kFirstUnit = 4; ///< behind the engine's own

constexpr const char* kLighting = R"(
uniform vec3 eye;
uniform vec4 towardsViewer; // w: 1 where all views are parallel
vec3 lighting(vec3 position, vec3 normal, vec4 surface0, vec4 surface1) {
    LodestarSurface here;
    here.view = towardsViewer.w > 0.0 ? towardsViewer.xyz : normalize(eye - position);
    here.normal = normal;
    here.diffuse = surface0.rgb;
    here.exponent = surface0.w;
    here.f0 = surface1.rgb;
    here.occlusion = 1.0;
    vec3 radiance = lodestar_lights(here);
    return vec3(lodestar_srgbFromLinear(lodestar_filmic(radiance.r)),
                lodestar_srgbFromLinear(lodestar_filmic(radiance.g)),
                lodestar_srgbFromLinear(lodestar_filmic(radiance.b)));
})";

/// The library, its OpenGL extension attached as long as this lives.
class Attached {
public:
    explicit Attached(const hosts::LitContext& lit)
        : lit_(lit),
          gl_(static_cast<const LodestarGlApi*>(lit.api().get_extension(LODESTAR_EXTENSION_GL))),
          attached_(gl_ != nullptr && gl_->attach(lit.get(), procedure) == LODESTAR_OK) {}
    Attached(const Attached&) = delete;
    Attached& operator=(const Attached&) = delete;
    ~Attached() {
        if (attached_) {
            gl_->detach(lit_.get(), 1);
        }
    }
    explicit operator bool() const { return attached_; }
    [[nodiscard]] const hosts::LitContext& lit() const { return lit_; }
    [[nodiscard]] const LodestarGlApi& gl() const { return *gl_; }

private:
    static void* procedure(const char* name) {
        return reinterpret_cast<void*>(eglGetProcAddress(name));
    }
    const hosts::LitContext& lit_;
    const LodestarGlApi* gl_;
    bool attached_;
};

/// @return whether the library took its material
bool addPrimitive(const hosts::LitContext& lit, const io::GltfFile& file, const glm::mat4& world,
                  const io::GltfPrimitive& primitive, DeferredEngine& engine) {
    if (primitive.topology != io::Topology::Triangles || primitive.normals.empty()) {
        return true;
    }
    float packed[8];
    if (!hosts::packMaterial(lit, file, primitive.material, packed)) {
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

bool addScene(const hosts::LitContext& lit, const io::GltfFile& file, DeferredEngine& engine) {
    const scene::Scene scene = scene::buildScene(file, file.defaultScene);
    for (const scene::Node& node : scene.nodes) {
        for (const scene::Component& component : node.components) {
            const auto* drawn = std::get_if<scene::MeshComponent>(&component);
            if (drawn == nullptr) {
                continue;
            }
            for (const io::GltfPrimitive& primitive :
                 scene.meshes[static_cast<std::size_t>(drawn->mesh)].primitives) {
                if (!addPrimitive(lit, file, node.worldFromNode, primitive, engine)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/// The three arrays behind the engine's own units. @return whether the library gave them
bool bindTextures(const Attached& attached, GLuint program) {
    GLuint unit = kFirstUnit;
    int which = LODESTAR_TEXELS_MAP;
    for (const char* name : {"lodestar_maps", "lodestar_lamberts", "lodestar_gradients"}) {
        LodestarGlTexture texture{};
        texture.struct_size = sizeof texture;
        if (attached.gl().texture(attached.lit().get(), which++, &texture) != LODESTAR_OK) {
            return false;
        }
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(texture.target, texture.name);
        glUniform1i(glGetUniformLocation(program, name), static_cast<GLint>(unit++));
    }
    return true;
}

/// The lights that shine now, a vec4 each: their axes and layers.
bool setLights(const Attached& attached, GLuint program) {
    std::size_t count = 0;
    attached.lit().api().lights(attached.lit().get(), nullptr, &count);
    std::vector<LodestarLight> lights(count);
    if (attached.lit().api().lights(attached.lit().get(), lights.data(), &count) != LODESTAR_OK) {
        return false;
    }
    std::vector<glm::vec4> axes;
    for (const LodestarLight light : lights) {
        LodestarLightState state{};
        state.struct_size = sizeof state;
        std::uint32_t layer = 0;
        if (attached.lit().api().light_state(attached.lit().get(), light, &state) != LODESTAR_OK) {
            return false;
        }
        if (state.visibility > 0.0 && axes.size() < std::size_t{hosts::kMaxLights} &&
            attached.gl().layer(attached.lit().get(), light, &layer) == LODESTAR_OK) {
            axes.emplace_back(glm::vec3(glm::make_vec3(state.axis)), static_cast<float>(layer));
        }
    }
    const auto shining = static_cast<GLsizei>(axes.size());
    glUniform1i(glGetUniformLocation(program, "lodestar_count"), shining);
    glUniform4fv(glGetUniformLocation(program, "lodestar_axes"), shining,
                 reinterpret_cast<const float*>(axes.data()));
    return true;
}

void setView(const scene::View& view, const LodestarApi& api, GLuint program) {
    const auto at = [&](const char* name) { return glGetUniformLocation(program, name); };
    const glm::vec4 towards(view.towardsViewer, view.perspective ? 0.0f : 1.0f);
    glUniform3fv(at("eye"), 1, glm::value_ptr(view.position));
    glUniform4fv(at("towardsViewer"), 1, glm::value_ptr(towards));
    LodestarMapLayout layout{};
    layout.struct_size = sizeof layout;
    api.map_layout(&layout);
    const hosts::MapUniforms map = hosts::mapUniforms(layout);
    glUniform4fv(at("lodestar_mapSize"), 1, map.size);
    glUniform4fv(at("lodestar_mapRows"), 1, map.rows);
}

core::Result<core::Image> draw(const HostCall& call, const HostScene& loaded) {
    const auto lit = hosts::LitContext::open(call.lighting);
    if (!lit) {
        return lit.error();
    }
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return context.error();
    }
    DeferredEngine engine(call.width, call.height);
    if (!addScene(*lit, loaded.file, engine)) {
        return core::inFile(lit->refusal(), call.scene);
    }
    const std::string refused =
        engine.setLighting(hosts::shadingText(lit->api(), LODESTAR_PROFILE_CORE) + kLighting);
    if (!refused.empty()) {
        return core::Error{core::ErrorCode::Internal, "the shading text: " + refused, {}, {}};
    }
    const Attached attached(*lit);
    if (!attached) {
        return core::Error{core::ErrorCode::NoOpenGl, lit->refusal().what, {}, {}};
    }
    const GLuint program = engine.lightingProgram();
    glUseProgram(program);
    setView(loaded.view, lit->api(), program);
    if (lit->api().set_hour(lit->get(), call.hour) != LODESTAR_OK ||
        attached.gl().update(lit->get()) != LODESTAR_OK || !setLights(attached, program) ||
        !bindTextures(attached, program)) {
        return lit->refusal();
    }
    return pictureOf(call, engine.draw(loaded.view.clipFromWorld()).data());
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    return lodestar::samples::runHost("lodestar-host-foreign", argc, argv, lodestar::samples::draw);
}
