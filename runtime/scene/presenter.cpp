// SPDX-License-Identifier: MIT
#include "scene/presenter.h"

#include <utility>

#include <epoxy/gl.h>

namespace lodestar::scene {

Presenter::Presenter(gl::Device& device, gl::Program program)
    : device_(&device), program_(std::move(program)), fullScreen_(device) {
    program_.setSampler("uRadiance", 0);
    origin_ = program_.uniform("uOrigin");
    samplesPerSide_ = program_.uniform("uSamplesPerSide");
    exposure_ = program_.uniform("uExposure");
}

core::Result<Presenter> Presenter::make(gl::Device& device) {
    auto program = gl::Program::make(device, "host/present.vert", "host/present.frag", {});
    if (!program) {
        return program.error();
    }
    return Presenter(device, std::move(*program));
}

void Presenter::show(const gl::Framebuffer& tile, const glm::ivec2& origin, int samplesPerSide,
                     float exposure, unsigned framebuffer) {
    gl::beginWindowPass(*device_, framebuffer, origin.x, origin.y, tile.width() / samplesPerSide,
                        tile.height() / samplesPerSide);
    program_.use();
    glUniform2i(origin_, origin.x, origin.y);
    glUniform1i(samplesPerSide_, samplesPerSide);
    glUniform1f(exposure_, exposure);
    tile.color().bind(0);
    fullScreen_.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    gl::drawFullScreen(*device_);
}

} // namespace lodestar::scene
