// SPDX-License-Identifier: MIT
//
// The editor's sphere of the selected material, under the light of the scene that is shown.
#pragma once

#include <memory>
#include <optional>

#include "gl/framebuffer.h"
#include "scene/renderer.h"

namespace lodestar::app {

class MaterialPreview {
public:
    /// @param shown whose light and textures are its own; its materials name their textures
    /// @errors NoOpenGl
    [[nodiscard]] static core::Result<std::unique_ptr<MaterialPreview>>
    make(gl::Device& device, const scene::Renderer& shown);

    /// Draws a material. @param settings of the shown picture; size and samples aside
    /// @param exposure factor, > 0  @errors NoOpenGl, Internal
    [[nodiscard]] core::Result<void> draw(const io::GltfMaterial& material,
                                          const scene::RenderSettings& settings, float exposure);
    /// A GL texture, row 0 at the bottom.
    [[nodiscard]] unsigned picture() const { return target_.color().id(); }

private:
    MaterialPreview() = default;

    std::unique_ptr<scene::Scene> scene_;
    std::unique_ptr<scene::Renderer> renderer_;
    gl::DisplayTarget target_;
};

} // namespace lodestar::app
