// SPDX-License-Identifier: MIT
//
// What 10,000 draws cost the CPU: the renderer's frame (plan, instances, batches), against a loop
// that sets everything for each node and draws it. Both draw the same triangles into 16 x 16
// pixels, so that a software driver's vertices weigh the same in both. CPU time of the
// process, medians, the ratio formed repeat by repeat.
//
//   build/bench-draws [repeats]
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>

#include "bench/shading_front.h"
#include "gl/program.h"
#include "lighting/environment.h"
#include "platform/headless_context.h"
#include "scene/gpu_scene.h"
#include "scene/renderer.h"
#include "support/shapes.h"

namespace {

using namespace lodestar;
using namespace lodestar::testing;

constexpr int kNodes = 10000;

/// A grid of nodes that show so many meshes in so many materials, all within the view.
scene::Scene gridOf(int meshes, int materials) {
    io::GltfFile file;
    for (int i = 0; i < materials; ++i) {
        const float shade = static_cast<float>(i % 20) / 20.0f;
        file.materials.push_back(blinnPhong(glm::vec3(shade), glm::vec3(0.04f), 10.0f));
    }
    for (int i = 0; i < meshes; ++i) {
        io::GltfPrimitive triangle;
        triangle.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0.001f * static_cast<float>(i)}};
        triangle.normals.assign(3, {0, 0, 1});
        triangle.indices = {0, 1, 2};
        triangle.material = i % materials;
        file.meshes.push_back({"mesh", {triangle}, {}});
    }
    for (int i = 0; i < kNodes; ++i) {
        io::GltfNode node;
        node.mesh = i % meshes;
        node.translation = {static_cast<float>(i % 100 - 50) * 0.02f,
                            static_cast<float>(i / 100 - 50) * 0.02f, 0.0f};
        node.scale = glm::vec3(0.008f);
        file.nodes.push_back(node);
    }
    file.scenes.push_back({"grid", {}});
    for (int i = 0; i < kNodes; ++i) {
        file.scenes[0].roots.push_back(i);
    }
    file.defaultScene = 0;
    return scene::buildScene(std::move(file));
}

/// The loop that needs no thought.
struct Naive {
    gl::Program program;
    gl::Buffer draw, material;
    scene::GpuScene textures;
    struct Mesh {
        gl::Buffer positions, normals, indices;
        gl::VertexArray vertices;
    };
    std::vector<Mesh> meshes;

    static constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(std140) uniform Draw { mat4 clipFromModel; mat4 normalFromModel; vec4 more; };
out vec3 vNormal;
void main() {
    vNormal = mat3(normalFromModel) * aNormal;
    gl_Position = clipFromModel * vec4(aPosition, 1.0);
})";
    static constexpr const char* kFragment = R"(#version 330 core
layout(std140) uniform Material { vec4 values[23]; };
in vec3 vNormal;
out vec4 oColor;
void main() { oColor = vec4(values[4].rgb * abs(normalize(vNormal).z), 1.0); })";

    void frame(gl::Device& device, const scene::Scene& scene, const scene::View& view) {
        struct {
            glm::mat4 clipFromModel, normalFromModel;
            glm::vec4 more;
        } block{};
        for (const scene::Node& node : scene.nodes) {
            for (const scene::Component& component : node.components) {
                const auto* mesh = std::get_if<scene::MeshComponent>(&component);
                if (mesh == nullptr) {
                    continue;
                }
                const io::GltfMaterial& worn = scene.materials[static_cast<std::size_t>(
                    scene.meshes[static_cast<std::size_t>(mesh->mesh)].primitives[0].material)];
                program.use();
                block.clipFromModel = view.clipFromWorld() * node.worldFromNode;
                block.normalFromModel = glm::transpose(glm::inverse(node.worldFromNode));
                draw.update(std::as_bytes(std::span(&block, 1)));
                draw.bindBlock(0);
                const auto values = scene::materialBlock(worn, {});
                material.update(std::as_bytes(std::span(&values, 1)));
                material.bindBlock(1);
                textures.bindTextures(worn);
                glEnable(GL_CULL_FACE);
                glFrontFace(GL_CCW);
                glDisable(GL_BLEND);
                glDepthMask(GL_TRUE);
                meshes[static_cast<std::size_t>(mesh->mesh)].vertices.bind();
                gl::drawIndexed(device, gl::DrawMode::Triangles, {0, 3, 0});
            }
        }
    }
};

core::Result<Naive> makeNaive(gl::Device& device, const scene::Scene& scene) {
    auto program = gl::Program::makeFromText(device, Naive::kVertex, Naive::kFragment, "naive");
    if (!program) {
        return program.error();
    }
    scene::GpuScene textures(device, scene);
    for (const scene::TextureUse& use : scene::texturesOf(scene)) {
        if (auto added = textures.addTexture(device, scene, use); !added) {
            return added.error();
        }
    }
    std::vector<Naive::Mesh> meshes;
    for (const io::GltfMesh& mesh : scene.meshes) {
        const io::GltfPrimitive& part = mesh.primitives[0];
        const auto buffer = [&](gl::BufferKind kind, const auto& values) {
            return gl::Buffer(device, kind, std::as_bytes(std::span(values)));
        };
        Naive::Mesh& made = meshes.emplace_back();
        made.positions = buffer(gl::BufferKind::Vertex, part.positions);
        made.normals = buffer(gl::BufferKind::Vertex, part.normals);
        made.indices = buffer(gl::BufferKind::Index, part.indices);
        made.vertices = gl::VertexArray(device);
        made.vertices.setAttribute(gl::Attribute::Position, made.positions, 3);
        made.vertices.setAttribute(gl::Attribute::Normal, made.normals, 3);
        made.vertices.setIndices(made.indices);
    }
    program->setBlock("Draw", 0);
    program->setBlock("Material", 1);
    const std::vector<std::byte> bytes(144);
    const scene::blocks::LodestarMaterial block{};
    return Naive{std::move(*program), gl::Buffer(device, gl::BufferKind::Uniform, bytes),
                 gl::Buffer(device, gl::BufferKind::Uniform, std::as_bytes(std::span(&block, 1))),
                 std::move(textures), std::move(meshes)};
}

struct Row {
    const char* name;
    int meshes, materials;
};

core::Result<void> measure(gl::Device& device, const Row& row, int repeats) {
    scene::Scene scene = gridOf(row.meshes, row.materials);
    const scene::View view = frontView(scene);
    auto renderer = scene::Renderer::make(device, scene);
    if (!renderer) {
        return renderer.error();
    }
    (*renderer)->setEnvironment("grey",
                                lighting::cubeFromAnalytic(lighting::ConstantEnvironment{}, 16));
    scene::RenderSettings settings;
    settings.width = settings.height = 16;
    settings.backdrop = false;
    auto naive = makeNaive(device, scene);
    if (!naive) {
        return naive.error();
    }
    auto target = gl::Framebuffer::make(device, 16, 16);
    if (!target) {
        return target.error();
    }
    std::vector<double> ours, theirs, ratios, plan, prepare;
    gl::WorkCounters counters;
    for (int repeat = -2; repeat < repeats; ++repeat) {
        glFinish();
        const double start = cpuMilliseconds();
        auto frame = (*renderer)->render(view, settings);
        if (!frame) {
            return frame.error();
        }
        glFinish();
        const double drawn = cpuMilliseconds();
        target->begin();
        glFinish();
        const double before = cpuMilliseconds();
        naive->frame(device, scene, view);
        glFinish();
        const double after = cpuMilliseconds();
        if (repeat >= 0) {
            ours.push_back(drawn - start);
            theirs.push_back(after - before);
            ratios.push_back(ours.back() / theirs.back());
            plan.push_back(frame->timesMs["plan"]);
            prepare.push_back(frame->timesMs["prepare"]);
            counters = frame->counters;
        }
    }
    std::printf("%-34s %6llu %8llu %8llu %9.2f %9.2f %9.2f %9.2f %7.3f\n", row.name,
                static_cast<unsigned long long>(counters.draws),
                static_cast<unsigned long long>(counters.programSwitches),
                static_cast<unsigned long long>(counters.uploads), median(plan), median(prepare),
                median(ours), median(theirs), median(ratios));
    return {};
}

int fail(const core::Error& error) {
    std::fprintf(stderr, "bench-draws: %s\n", error.message().c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto device = gl::Device::create();
    if (!device) {
        return fail(device.error());
    }
    const Row rows[] = {{"one mesh", 1, 1},
                        {"100 meshes, 20 materials", 100, 20},
                        {"10,000 meshes, 20 materials", kNodes, 20},
                        {"10,000 meshes, 10,000 materials", kNodes, kNodes}};
    std::printf("%s, %d nodes, ms of CPU\n%-34s %6s %8s %8s %9s %9s %9s %9s %7s\n",
                (*device)->capabilities().renderer.c_str(), kNodes, "scene", "draws", "programs",
                "uploads", "plan", "prepare", "frame", "loop", "ratio");
    for (const Row& row : rows) {
        if (auto measured = measure(**device, row, argc > 1 ? std::atoi(argv[1]) : 15); !measured) {
            return fail(measured.error());
        }
    }
    return 0;
}
