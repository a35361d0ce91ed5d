// SPDX-License-Identifier: MIT
//
// lodestar-host-foreign: an engine that is deferred and knows nothing of Lodestar
// (deferred_engine.h), lit by a lighting document: textures by the extension "lodestar.gl", one
// text for its lighting pass.
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

/// The library's textures behind the engine's own units. @return whether it gave them
bool bindTexture(const Attached& attached, const LodestarUniform& sampler, GLuint program,
                 GLuint unit) {
    LodestarGlTexture texture{};
    texture.struct_size = sizeof texture;
    if (attached.gl().texture(attached.lit().get(), sampler.texels, &texture) != LODESTAR_OK) {
        return false;
    }
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(texture.target, texture.name);
    glUniform1i(glGetUniformLocation(program, sampler.name), static_cast<GLint>(unit));
    return true;
}

/// Plans the hour, uploads what it shows, and sets all that the text reads.
bool light(const Attached& attached, double hour, GLuint program) {
    const hosts::LitContext& lit = attached.lit();
    LodestarFrame frame{};
    frame.struct_size = sizeof frame;
    frame.hour = hour;
    LodestarPlan plan = 0;
    if (lit.api().plan_make(lit.get(), &frame, &plan) != LODESTAR_OK ||
        attached.gl().execute(lit.get(), plan) != LODESTAR_OK) {
        return false;
    }
    const std::vector<unsigned char> data = hosts::uniformData(lit.api(), lit.get(), plan);
    GLuint unit = kFirstUnit;
    for (const LodestarUniform& uniform : hosts::uniforms(lit.api())) {
        if (uniform.type == LODESTAR_UNIFORM_VEC4) {
            glUniform4fv(glGetUniformLocation(program, uniform.name),
                         static_cast<GLsizei>(uniform.count),
                         reinterpret_cast<const float*>(data.data() + uniform.offset));
        } else if (!bindTexture(attached, uniform, program, unit++)) {
            return false;
        }
    }
    return true;
}

void setView(const scene::View& view, GLuint program) {
    const auto at = [&](const char* name) { return glGetUniformLocation(program, name); };
    const glm::vec4 towards(view.towardsViewer, view.perspective ? 0.0f : 1.0f);
    glUniform3fv(at("eye"), 1, glm::value_ptr(view.position));
    glUniform4fv(at("towardsViewer"), 1, glm::value_ptr(towards));
}

core::Result<core::Image> draw(const HostCall& call, const HostScene& loaded) {
    const auto lit = hosts::LitContext::open(call.lighting);
    if (!lit) {
        return lit.error();
    }
    warn("lodestar-host-foreign", call, hosts::leftOut(loaded.file));
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
    setView(loaded.view, program);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    if (!light(attached, call.hour, program)) {
        return lit->refusal();
    }
    return pictureOf(call, engine.draw(loaded.view.clipFromWorld()).data());
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    return lodestar::samples::runHost("lodestar-host-foreign", argc, argv, lodestar::samples::draw);
}
