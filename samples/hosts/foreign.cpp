// SPDX-License-Identifier: MIT
//
// lodestar-host-foreign: an engine that is deferred and knows nothing of Lodestar
// (deferred_engine.h), lit by a lighting document: textures by the extension "lodestar.gl", one
// text for its lighting pass.
#include <algorithm>
#include <vector>

#include <epoxy/egl.h>

#include <glm/gtc/type_ptr.hpp>

#include <lodestar/lodestar.h>

#include "call.h"
#include "deferred_engine.h"
#include "hosts/material.h"
#include "hosts/shading.h"
#include "io/file.h"
#include "platform/headless_context.h"

namespace lodestar::samples {
namespace {

constexpr const char* kName = "lodestar-host-foreign";
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

struct Lodestar {
    LodestarApi api{};
    LodestarContext* context = nullptr;
    LodestarDocument document = 0;
    const LodestarGlApi* gl = nullptr;

    /// Says why the library refused. @return the exit status
    [[nodiscard]] int fails(const std::string& file = {}) const {
        return hostFails(kName, (file.empty() ? "" : file + ": ") + api.last_error(context), 3);
    }
};

int addPrimitive(const Lodestar& lodestar, const io::GltfFile& file, const glm::mat4& world,
                 const io::GltfPrimitive& primitive, DeferredEngine& engine) {
    if (primitive.topology != io::Topology::Triangles || primitive.normals.empty()) {
        return 0;
    }
    float packed[8];
    if (!hosts::packMaterial(lodestar.api, lodestar.context, lodestar.document, file,
                             primitive.material, packed)) {
        return lodestar.fails();
    }
    engine.add({.positions = primitive.positions,
                .normals = primitive.normals,
                .indices = primitive.indices,
                .worldFromMesh = world,
                .surface = {glm::make_vec4(packed), glm::make_vec4(packed + 4)},
                .doubleSided = hosts::isDoubleSided(file, primitive.material)});
    return 0;
}

int addScene(const Lodestar& lodestar, const io::GltfFile& file, DeferredEngine& engine) {
    const scene::Scene scene = scene::buildScene(file, file.defaultScene);
    int status = 0;
    for (const scene::Node& node : scene.nodes) {
        for (const scene::Component& component : node.components) {
            const auto* drawn = std::get_if<scene::MeshComponent>(&component);
            if (drawn == nullptr) {
                continue;
            }
            const io::GltfMesh& mesh = scene.meshes[static_cast<std::size_t>(drawn->mesh)];
            for (const io::GltfPrimitive& primitive : mesh.primitives) {
                status = status != 0
                             ? status
                             : addPrimitive(lodestar, file, node.worldFromNode, primitive, engine);
            }
        }
    }
    return status;
}

/// The three arrays behind the engine's own units. @return whether the library gave them
bool bindTextures(const Lodestar& lodestar, GLuint program) {
    GLuint unit = kFirstUnit;
    int which = LODESTAR_TEXELS_MAP;
    for (const char* name : {"lodestar_maps", "lodestar_lamberts", "lodestar_gradients"}) {
        LodestarGlTexture texture{};
        texture.struct_size = sizeof texture;
        if (lodestar.gl->texture(lodestar.context, which++, &texture) != LODESTAR_OK) {
            return false;
        }
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(texture.target, texture.name);
        glUniform1i(glGetUniformLocation(program, name), static_cast<GLint>(unit++));
    }
    return true;
}

/// The lights that shine now, a vec4 each: their axes and layers.
bool setLights(const Lodestar& lodestar, GLuint program) {
    std::size_t count = 0;
    lodestar.api.lights(lodestar.context, nullptr, &count);
    std::vector<LodestarLight> lights(count);
    if (lodestar.api.lights(lodestar.context, lights.data(), &count) != LODESTAR_OK) {
        return false;
    }
    std::vector<glm::vec4> axes;
    for (const LodestarLight light : lights) {
        LodestarLightState state{};
        state.struct_size = sizeof state;
        std::uint32_t layer = 0;
        if (lodestar.api.light_state(lodestar.context, light, &state) != LODESTAR_OK) {
            return false;
        }
        if (state.visibility > 0.0 && axes.size() < std::size_t{hosts::kMaxLights} &&
            lodestar.gl->layer(lodestar.context, light, &layer) == LODESTAR_OK) {
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

int save(const HostCall& call, const std::vector<std::uint8_t>& bytes) {
    core::Image picture(call.width, call.height, 4);
    std::size_t at = 0;
    for (int y = call.height - 1; y >= 0; --y) {
        for (int x = 0; x < call.width; ++x) {
            for (int c = 0; c < 4; ++c) {
                picture.at(x, y)[c] = static_cast<float>(bytes[at++]) / 255.0f;
            }
        }
    }
    const auto written = io::writeImage(call.output, picture);
    return written ? 0 : hostFails(kName, written.error().message(), 5);
}

int drawLit(const HostCall& call, const Lodestar& lodestar, const HostScene& loaded) {
    DeferredEngine engine(call.width, call.height);
    if (const int status = addScene(lodestar, loaded.file, engine); status != 0) {
        return status;
    }
    const std::string refused =
        engine.setLighting(hosts::shadingText(lodestar.api, LODESTAR_PROFILE_CORE) + kLighting);
    if (!refused.empty()) {
        return hostFails(kName, "the shading text: " + refused, 1);
    }
    const GLuint program = engine.lightingProgram();
    glUseProgram(program);
    setView(loaded.view, lodestar.api, program);
    if (lodestar.api.set_hour(lodestar.context, call.hour) != LODESTAR_OK ||
        lodestar.gl->update(lodestar.context) != LODESTAR_OK || !setLights(lodestar, program) ||
        !bindTextures(lodestar, program)) {
        return lodestar.fails();
    }
    return save(call, engine.draw(loaded.view.clipFromWorld()));
}

void* procedure(const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

int draw(const HostCall& call, Lodestar& lodestar) {
    const auto text = io::readFile(call.lighting);
    if (!text) {
        return hostFails(kName, text.error().message(), 3);
    }
    const LodestarApi& api = lodestar.api;
    if (api.document_load(lodestar.context, reinterpret_cast<const char*>(text->data()),
                          text->size(), &lodestar.document) != LODESTAR_OK ||
        api.document_apply(lodestar.context, lodestar.document) != LODESTAR_OK) {
        return lodestar.fails(call.lighting);
    }
    const auto loaded = loadHostScene(call);
    if (!loaded) {
        return hostFails(kName, loaded.error().message(), static_cast<int>(loaded.error().code));
    }
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return hostFails(kName, context.error().message(), 4);
    }
    lodestar.gl = static_cast<const LodestarGlApi*>(api.get_extension(LODESTAR_EXTENSION_GL));
    if (lodestar.gl->attach(lodestar.context, procedure) != LODESTAR_OK) {
        return lodestar.fails();
    }
    const int status = drawLit(call, lodestar, *loaded);
    lodestar.gl->detach(lodestar.context, 1);
    return status;
}

int run(const HostCall& call) {
    Lodestar lodestar;
    lodestar.api.struct_size = sizeof lodestar.api;
    if (lodestar_get_api(LODESTAR_ABI_VERSION, &lodestar.api) != LODESTAR_OK ||
        lodestar.api.context_create(nullptr, &lodestar.context) != LODESTAR_OK) {
        return hostFails(kName, "the library cannot be used", 1);
    }
    const int status = draw(call, lodestar);
    lodestar.api.context_destroy(lodestar.context);
    return status;
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    const auto call = lodestar::samples::parseHostCall(argc, argv);
    return call ? lodestar::samples::run(*call)
                : lodestar::samples::explainHost(lodestar::samples::kName, argc, argv);
}
