// SPDX-License-Identifier: MIT
//
// The editor's error view: the picture against its reference, a pass a frame while nothing changes.
#include <cstdio>
#include <utility>

#include "app/editor.h"
#include "app/error_texture.h"

namespace lodestar::app {

bool Editor::errorDue() const {
    return workspace_.view().errorView && !pictureStale_ && around_.plan &&
           (!error_ || error_->passes() < kErrorPasses);
}

void Editor::forgetErrors() {
    error_.reset();
    retired_.push_back(std::exchange(errorPicture_, {}));
    around_.errorPicture = 0;
    around_.errorText.clear();
}

void Editor::drawErrorPass() {
    const auto failed = [this](const std::string& message) {
        workspace_.view().errorView = false;
        workspace_.say(message, true);
        forgetErrors();
        session_.wake();
    };
    if (!litFromAfar(*around_.plan)) {
        return failed("no surface in the picture is lit by an environment, a sky or a sun, whose "
                      "light is compared");
    }
    scene::RenderSettings settings = settings_;
    settings.hour = seen_.hour;
    if (!error_) {
        auto frame = shown_.renderer->redraw(view(), settings, {});
        if (!frame) {
            return failed(frame.error().message());
        }
        error_.emplace(std::move(*frame));
    }
    auto pass = shown_.renderer->redraw(
        view(), settings, scene::ReferenceTaps{error_->passes(), kErrorPasses, kErrorTaps});
    if (!pass) {
        return failed(pass.error().message());
    }
    error_->add(*pass);
    auto texture = errorTexture(*device_, *error_);
    if (!texture) {
        return failed(texture.error().message());
    }
    retired_.push_back(std::exchange(errorPicture_, std::move(*texture)));
    around_.errorPicture = errorPicture_.id();
    char text[64];
    std::snprintf(text, sizeof text, "error against the reference: %d of %d passes",
                  error_->passes(), kErrorPasses);
    around_.errorText = text;
    session_.wake();
}

} // namespace lodestar::app
