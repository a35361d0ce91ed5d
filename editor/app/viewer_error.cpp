// SPDX-License-Identifier: MIT
//
// The viewer's error view: a frame against its reference, a pass a frame while nothing moves.
#include <utility>

#include "app/error_texture.h"
#include "app/viewer.h"
#include "gl/framebuffer.h"

namespace lodestar::app {

void Viewer::toggleErrorView() {
    errorShown_ = !errorShown_;
    changed(false);
    if (errorShown_ && plan_ && !litFromAfar(*plan_)) {
        errorShown_ = false;
        say("no surface in the picture is lit by an environment, a sky or a sun, whose light is "
            "compared",
            false);
    }
}

bool Viewer::errorPending() const {
    return errorShown_ && plan_ && litFromAfar(*plan_) &&
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
    auto texture = errorTexture(*device_, *error_);
    if (!texture) {
        return failed(texture.error());
    }
    errorPicture_ = std::move(*texture);
    gl::beginWindowPass(*device_, 0, 0, 0, settings_.width, settings_.height);
    showOverlay();
    return {};
}

} // namespace lodestar::app
