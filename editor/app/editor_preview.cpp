// SPDX-License-Identifier: MIT
#include "app/editor_preview.h"

#include "app/editor.h"
#include "app/starter_scene.h"

namespace lodestar::app {
namespace {

/// Pixels of the picture's side: what a display of twice the density shows of it.
constexpr int kSide = 192;

} // namespace

core::Result<std::unique_ptr<MaterialPreview>> MaterialPreview::make(gl::Device& device,
                                                                     const scene::Renderer& shown) {
    std::unique_ptr<MaterialPreview> preview(new MaterialPreview);
    preview->scene_ = std::make_unique<scene::Scene>(scene::buildScene(sphereScene()));
    auto renderer = scene::Renderer::makeBeside(device, *preview->scene_, shown);
    if (!renderer) {
        return renderer.error();
    }
    preview->renderer_ = std::move(*renderer);
    auto target = gl::DisplayTarget::make(device, kSide, kSide);
    if (!target) {
        return target.error();
    }
    preview->target_ = std::move(*target);
    return preview;
}

core::Result<void> MaterialPreview::draw(const io::GltfMaterial& material,
                                         const scene::RenderSettings& settings, float exposure) {
    scene_->materials.front() = material;
    renderer_->materialsChanged();
    scene::RenderSettings small = settings;
    small.width = small.height = kSide;
    small.samplesPerSide = 2;
    scene::CameraRequest request;
    request.eye = glm::vec3(0.0f, 0.6f, 3.4f);
    request.target = glm::vec3(0.0f);
    request.verticalFov = 0.64f;
    const auto view = scene::chooseView(*scene_, request, 1.0f);
    auto frame = renderer_->draw(*view, small, exposure, target_.framebuffer());
    return frame ? core::Result<void>() : core::Result<void>(frame.error());
}

void Editor::syncPreview() {
    const std::vector<std::string>& selected = model_.selection().materials;
    const std::optional<std::size_t> index =
        selected.empty() ? std::nullopt : materialIndex(selected.front());
    if (!index) {
        around_.preview = 0;
        previewed_.reset();
        return;
    }
    const PreviewKey wanted{*index, model_.revisions().document, workspace_.view().hour,
                            workspace_.view().exposure};
    if (previewed_ == wanted) {
        return;
    }
    core::Result<void> drawn;
    if (!preview_) {
        auto made = MaterialPreview::make(*device_, *shown_.renderer);
        if (made) {
            preview_ = std::move(*made);
        } else {
            drawn = made.error();
        }
    }
    if (drawn) {
        scene::RenderSettings settings = settings_;
        settings.hour = workspace_.view().hour;
        drawn = preview_->draw(shown_.scene->materials[*index], settings,
                               static_cast<float>(std::exp2(workspace_.view().exposure)));
    }
    if (!drawn) {
        workspace_.say(drawn.error().message(), true);
    } else {
        ++previewsDrawn_;
    }
    const unsigned picture = drawn ? preview_->picture() : 0;
    if (around_.preview != picture) {
        around_.preview = picture;
        session_.wake();
    }
    previewed_ = wanted;
}

} // namespace lodestar::app
