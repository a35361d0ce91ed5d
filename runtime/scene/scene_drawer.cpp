// SPDX-License-Identifier: MIT
#include "scene/scene_drawer.h"

#include <utility>

#include <epoxy/gl.h>

#include "scene/gpu_probes.h"

namespace lodestar::scene {

SceneDrawer::SceneDrawer(gl::Device& device, const Scene& scene, GpuScene gpu,
                         GpuDeformation deformation)
    : device_(device), scene_(scene), gpu_(std::move(gpu)), items_(drawItems(scene)),
      deformation_(std::move(deformation)), fullScreen_(device), programs_(device) {}

void SceneDrawer::prepare(const plan::EffectPlan& plan, const RenderSettings& settings) {
    deformation_.prepare(device_, scene_, items_, gpu_, plan);
    materials_.prepare(device_, scene_, settings.materialOverride);
    placeInstances(plan);
}

void SceneDrawer::place(std::span<const std::size_t> order,
                        std::span<const plan::ProbeChoice> choices,
                        std::vector<Instance>& placed) const {
    for (std::size_t i = 0; i < order.size(); ++i) {
        const DrawItem& item = items_[order[i]];
        const Node& node = scene_.nodes[static_cast<std::size_t>(item.node)];
        const glm::mat4 rows = glm::transpose(node.worldFromNode);
        const int skin =
            std::get<MeshComponent>(node.components[static_cast<std::size_t>(item.component)]).skin;
        const plan::ProbeChoice choice = choices.empty() ? plan::ProbeChoice{} : choices[i];
        placed.push_back(
            {{rows[0], rows[1], rows[2]},
             {deformation_.firstTexel(skin), choice.factor[0], choice.factor[1], choice.open}});
    }
}

/// Where the instances of all batches stand: those of the picture, the casters, the faces'.
void SceneDrawer::placeInstances(const plan::EffectPlan& plan) {
    std::vector<Instance> placed;
    placed.reserve(plan.drawOrder.size() + plan.casters.size());
    place(plan.drawOrder, plan.drawChoices, placed);
    place(plan.casters, {}, placed);
    firstInstances_.clear();
    for (const plan::ProbeFace& face : plan.probeFaces) {
        firstInstances_.push_back(placed.size());
        place(face.drawOrder, face.choices, placed);
    }
    instances_.upload(device_, placed);
}

void SceneDrawer::begin() {
    deformation_.bind();
    instances_.forgetBound();
}

void SceneDrawer::drawBackdrop(const plan::EffectPlan& plan) {
    programs_.backdrop(plan).use();
    fullScreen_.bind();
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_FALSE);
    gl::drawFullScreen(device_);
    glDepthMask(GL_TRUE);
}

void SceneDrawer::use(const MeshProgram& program, std::size_t instance) {
    program.program.use();
    glUniform1i(program.firstInstance, static_cast<int>(instances_.bind(instance)));
}

/// @param index of the batch's first draw
void SceneDrawer::drawInstances(std::size_t index, const plan::Batch& batch, PassState& state) {
    const DrawItem& item = items_[index];
    const GpuPrimitive& part = gpu_.geometry().primitive(item.mesh, item.primitive);
    const gl::VertexArray* morphed = deformation_.vertices(index);
    const gl::VertexArray* vertices =
        morphed != nullptr ? morphed : &gpu_.geometry().pool(part).vertices;
    if (state.vertices != vertices) {
        vertices->bind();
        state.vertices = vertices;
    }
    gl::IndexRange indices = part.indices;
    indices.baseVertex = morphed != nullptr ? 0 : indices.baseVertex;
    gl::drawIndexed(device_, part.mode, indices, static_cast<int>(batch.count));
}

void SceneDrawer::drawBatch(const Pass& pass, const plan::Batch& batch,
                            const plan::EffectPlan& plan, const RenderSettings& settings,
                            const GpuProbes& probes, PassState& state) {
    const std::size_t index = pass.order[batch.first];
    const DrawItem& item = items_[index];
    const io::GltfPrimitive& primitive = scene_.meshes[static_cast<std::size_t>(item.mesh)]
                                             .primitives[static_cast<std::size_t>(item.primitive)];
    const io::GltfMaterial& material = materialOf(scene_, primitive);
    const plan::Features features = pass.features[batch.first];
    if (state.program == nullptr || state.features != features) {
        state.program = pass.reference ? &programs_.reference(features, plan, settings)
                                       : &programs_.mesh(features, plan, settings);
        state.features = features;
        const bool blended = plan::has(features, plan::Feature::AlphaBlend);
        blended ? glEnable(GL_BLEND) : glDisable(GL_BLEND);
        glDepthMask(blended ? GL_FALSE : GL_TRUE);
    }
    use(*state.program, pass.before + batch.first);
    if (state.material != &material) {
        state.material = &material;
        materials_.bind(primitive.material);
        gpu_.bindTextures(material);
    }
    if (plan::has(features, plan::Feature::Probe)) {
        const plan::ProbeChoice& choice = pass.choices[batch.first];
        if (state.probes == nullptr || state.probes->probe != choice.probe ||
            state.probes->dark != choice.dark) {
            state.probes = &choice;
            probes.bind(choice);
        }
    }
    const bool twoSided = material.doubleSided || primitive.topology != io::Topology::Triangles;
    if (state.twoSided != twoSided) {
        state.twoSided = twoSided;
        twoSided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    }
    if (state.mirrored != batch.mirrored) {
        state.mirrored = batch.mirrored;
        glFrontFace(batch.mirrored ? GL_CW : GL_CCW);
    }
    drawInstances(index, batch, state);
}

void SceneDrawer::drawPicture(const plan::EffectPlan& plan, const RenderSettings& settings,
                              const GpuProbes& probes) {
    const Pass pass{plan.drawOrder, plan.drawFeatures, plan.drawChoices};
    bool backdropDrawn = !plan.backdrop;
    PassState state;
    for (const plan::Batch& batch : plan.batches) {
        if (!backdropDrawn &&
            plan::has(plan.drawFeatures[batch.first], plan::Feature::AlphaBlend)) {
            drawBackdrop(plan);
            backdropDrawn = true;
            state = {};
        }
        drawBatch(pass, batch, plan, settings, probes, state);
    }
    if (!backdropDrawn) {
        drawBackdrop(plan);
    }
}

void SceneDrawer::drawSurfaces(const plan::EffectPlan& plan, const RenderSettings& settings,
                               const GpuProbes& probes, bool reference) {
    const Pass pass{plan.drawOrder, plan.drawFeatures, plan.drawChoices, 0, reference};
    PassState state;
    for (const plan::Batch& batch : plan.batches) {
        drawBatch(pass, batch, plan, settings, probes, state);
    }
}

void SceneDrawer::drawFace(const plan::EffectPlan& plan, std::size_t face,
                           const RenderSettings& settings, const GpuProbes& probes) {
    const plan::ProbeFace& seen = plan.probeFaces[face];
    const Pass pass{seen.drawOrder, seen.drawFeatures, seen.choices, firstInstances_[face]};
    PassState state;
    for (const plan::Batch& batch : seen.batches) {
        drawBatch(pass, batch, plan, settings, probes, state);
    }
}

void SceneDrawer::drawCasters(const plan::EffectPlan& plan, const plan::PlanInput& input,
                              const RenderSettings& settings) {
    PassState state;
    for (const plan::Batch& batch : plan.casterBatches) {
        const std::size_t index = plan.casters[batch.first];
        const plan::DrawView& draw = input.draws[index];
        if (state.program == nullptr || state.features != draw.features) {
            state.program = &programs_.depth(draw.features, plan, settings);
            state.features = draw.features;
        }
        use(*state.program, plan.drawOrder.size() + batch.first);
        if (plan::has(draw.features, plan::Feature::AlphaMask)) {
            const int material = static_cast<int>(draw.material) - 1;
            materials_.bind(material);
            gpu_.bindTextures(scene_.materials[static_cast<std::size_t>(material)]);
        }
        drawInstances(index, batch, state);
    }
}

} // namespace lodestar::scene
