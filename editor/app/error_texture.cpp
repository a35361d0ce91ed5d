// SPDX-License-Identifier: MIT
#include "app/error_texture.h"

#include "core/texels.h"

namespace lodestar::app {

core::Result<gl::Texture> errorTexture(gl::Device& device, const ErrorView& view) {
    const core::Image picture = view.picture(kErrorScale, ErrorView::Legend::Over);
    core::Texels texels(picture.width(), picture.height());
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            for (int c = 0; c < 4; ++c) {
                texels.set(x, y, c, picture.at(x, y)[c]);
            }
        }
    }
    const gl::SamplerState still{
        gl::Wrap::ClampToEdge, gl::Wrap::ClampToEdge, false, false, false, false};
    return gl::Texture::make2D(device, texels, gl::TexelEncoding::Linear, still, "the error view");
}

} // namespace lodestar::app
