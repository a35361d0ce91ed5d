// SPDX-License-Identifier: MIT
//
// The viewer's error view: a frame against its reference, a pass a frame while nothing moves.
#include <utility>

#include "app/viewer.h"
#include "core/texels.h"
#include "gl/framebuffer.h"

namespace lodestar::app {

void Viewer::toggleErrorView() {
    errorShown_ = !errorShown_;
    changed(false);
    if (errorShown_ && plan_ && !litByEnvironment(*plan_)) {
        errorShown_ = false;
        say("no surface in the picture is lit by an environment, whose light is compared", false);
    }
}

bool Viewer::errorPending() const {
    return errorShown_ && plan_ && litByEnvironment(*plan_) &&
           (!error_ || error_->passes() < kReferencePasses);
}

core::Result<void> Viewer::drawErrorPass() {
    const auto failed = [this](const core::Error& error) -> core::Result<void> {
        errorShown_ = false;
        say(error.message(), true);
        return {};
    };
    if (!error_) {
        auto frame = document_.renderer->redraw(view(), settings_, {});
        if (!frame) {
            return failed(frame.error());
        }
        error_.emplace(std::move(*frame));
    }
    auto pass = document_.renderer->redraw(
        view(), settings_, scene::ReferenceTaps{error_->passes(), kReferencePasses, kErrorTaps});
    if (!pass) {
        return failed(pass.error());
    }
    error_->add(*pass);
    const core::Image picture = error_->picture(kErrorScale, ErrorView::Legend::Over);
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
    auto texture =
        gl::Texture::make2D(*device_, texels, gl::TexelEncoding::Linear, still, "the error view");
    if (!texture) {
        return failed(texture.error());
    }
    errorPicture_ = std::move(*texture);
    gl::beginWindowPass(*device_, 0, 0, 0, settings_.width, settings_.height);
    showOverlay();
    return {};
}

} // namespace lodestar::app
