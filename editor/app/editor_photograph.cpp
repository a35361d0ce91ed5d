// SPDX-License-Identifier: MIT
//
// The editor's photograph: read and fitted beside the frames, shown as a texture.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include "app/bake_lights.h"
#include "app/command.h"
#include "app/editor.h"
#include "io/environment_file.h"
#include "model/picture_gradient.h"
#include "ui/theme.h"

namespace lodestar::app {
namespace {

using ImagePtr = std::shared_ptr<const core::Image>;

/// A texture of a photograph is no wider and no higher.
constexpr int kMostShown = 1024;

/// What came of fitting a panorama.
struct Fitted {
    ui::PhotographFit fit;
    std::vector<document::Light> lights;
};

Fitted fitted(const core::Image& panorama, const glm::dvec3& axis, bool takesSun,
              Background::Progress& progress) {
    Fitted made;
    const lighting::PhotographedLights lights =
        lighting::lightsFromPanorama(panorama, axis, takesSun);
    ++progress.stage;
    made.fit.axis = axis;
    made.fit.takesSun = takesSun;
    if (lights.sun) {
        made.fit.sun = lights.sun->axis;
        made.fit.sunRadius = glm::degrees(lights.sun->radius);
    }
    made.fit.residual = lights.residual;
    if (!progress.cancelled) {
        made.fit.diffuseError = diffuseError(panorama, lights, axis);
    }
    made.fit.advice = photographAdvice(lights.residual, made.fit.diffuseError);
    made.lights = documentLights(lights, axis);
    return made;
}

bool isPanorama(const core::Image& image) {
    return image.width() == 2 * image.height();
}

/// Half the size by means over blocks until it can be shown.
core::Image shrunk(const core::Image& image) {
    const int step =
        std::max(1, (std::max(image.width(), image.height()) + kMostShown - 1) / kMostShown);
    core::Image small((image.width() + step - 1) / step, (image.height() + step - 1) / step, 3);
    for (int y = 0; y < small.height(); ++y) {
        for (int x = 0; x < small.width(); ++x) {
            glm::dvec3 sum(0.0);
            double count = 0.0;
            for (int v = y * step; v < std::min((y + 1) * step, image.height()); ++v) {
                for (int u = x * step; u < std::min((x + 1) * step, image.width()); ++u) {
                    const float* const texel = image.at(u, v);
                    sum += glm::dvec3(texel[0], texel[1], texel[2]);
                    count += 1.0;
                }
            }
            for (int c = 0; c < 3; ++c) {
                small.at(x, y)[c] = static_cast<float>(sum[c] / count);
            }
        }
    }
    return small;
}

} // namespace

void Editor::openPhotograph(const std::string& path) {
    const std::string name = std::filesystem::path(path).filename().string();
    const auto read = [this, path,
                       name](Background::Progress& progress) -> core::Result<Background::Finish> {
        core::Tally warnings;
        auto image = io::loadRadiance(path, warnings);
        if (!image) {
            return core::inFile(image.error(), path);
        }
        ++progress.stage;
        auto radiance = std::make_shared<const core::Image>(std::move(*image));
        auto small = std::make_shared<const core::Image>(shrunk(*radiance));
        std::shared_ptr<Fitted> fit;
        if (isPanorama(*radiance) && !progress.cancelled) {
            fit = std::make_shared<Fitted>(
                fitted(*radiance, glm::dvec3(0.0, 1.0, 0.0), true, progress));
        }
        return Background::Finish([this, path, name, radiance, small, fit, warnings] {
            warn(warnings, path);
            around_.photograph = {name, radiance, 0, {}};
            photographLights_.clear();
            if (fit) {
                around_.photograph.fit = fit->fit;
                photographLights_ = fit->lights;
            }
            photographSmall_ = small;
            showPhotograph();
        });
    };
    work_.start(
        {"Reading " + name, "Looking for the sun in " + name, "Comparing lights with " + name},
        read);
    session_.wake(kWindowFrames);
}

void Editor::closePhotograph() {
    around_.photograph = {};
    photographSmall_.reset();
    photographLights_.clear();
    session_.wake();
}

void Editor::refreshPhotograph() {
    if (!photographSmall_) {
        photographTexture_ = {};
    } else if (photographExposure_ != workspace_.view().exposure) {
        showPhotograph();
    }
}

void Editor::showPhotograph() {
    if (!photographSmall_) {
        return;
    }
    photographExposure_ = workspace_.view().exposure;
    const core::Image& image = *photographSmall_;
    core::Texels texels(image.width(), image.height());
    unsigned char* byte = texels.bytes().data();
    const double factor = std::exp2(photographExposure_);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const float* const texel = image.at(x, y);
            const ImU32 color = ui::shownColor(glm::dvec3(texel[0], texel[1], texel[2]), factor);
            for (const int shift :
                 {IM_COL32_R_SHIFT, IM_COL32_G_SHIFT, IM_COL32_B_SHIFT, IM_COL32_A_SHIFT}) {
                *byte++ = static_cast<unsigned char>(color >> shift);
            }
        }
    }
    const gl::SamplerState sampler{
        gl::Wrap::ClampToEdge, gl::Wrap::ClampToEdge, true, true, false, false};
    // Its values are shown as they are: they are sRGB already.
    auto made =
        gl::Texture::make2D(*device_, texels, gl::TexelEncoding::Linear, sampler, "photograph");
    if (!made) {
        workspace_.say(made.error().message(), true);
        return;
    }
    photographTexture_ = std::move(*made);
    around_.photograph.picture = photographTexture_.id();
    session_.wake();
}

void Editor::useLights(const ui::LightsWish& wish) {
    const auto& fit = around_.photograph.fit;
    const ImagePtr radiance = around_.photograph.radiance;
    if (!fit || !radiance) {
        return;
    }
    const auto use = [this] {
        if (auto set = model_.execute(model::SetLights{photographLights_}); !set) {
            workspace_.say(set.error().message(), true);
        }
        session_.wake();
    };
    if (fit->axis == wish.axis && fit->takesSun == wish.takesSun) {
        return use();
    }
    work_.start({"Fitting the sky of " + around_.photograph.name,
                 "Comparing lights with " + around_.photograph.name},
                [this, radiance, wish,
                 use](Background::Progress& progress) -> core::Result<Background::Finish> {
                    auto made = std::make_shared<Fitted>(
                        fitted(*radiance, wish.axis, wish.takesSun, progress));
                    return Background::Finish([this, radiance, made, use] {
                        if (around_.photograph.radiance == radiance) {
                            around_.photograph.fit = made->fit;
                            photographLights_ = made->lights;
                            use();
                        }
                    });
                });
    session_.wake(kWindowFrames);
}

void Editor::useMean(const ui::MeanWish& wish) {
    const ImagePtr radiance = around_.photograph.radiance;
    const auto place = model::findKey(model_.ids(), wish.key);
    if (!radiance || !place) {
        workspace_.say("no key is chosen for the photograph's gradient", true);
        return;
    }
    const lighting::LightKind kind = model_.document().lights[place->light].kind;
    const auto mean = [this, radiance, wish,
                       kind](Background::Progress&) -> core::Result<Background::Finish> {
        auto gradient = model::gradientOfPanorama(*radiance, wish.axis, kind, ui::kPhotographStops);
        if (!gradient) {
            return gradient.error();
        }
        return Background::Finish(
            [this, wish, made = std::move(*gradient)] { setMean(wish, made); });
    };
    work_.start({"Mean over azimuth of " + around_.photograph.name}, mean);
    session_.wake(kWindowFrames);
}

void Editor::setMean(const ui::MeanWish& wish, const document::Gradient& gradient) {
    const model::MergeToken token = model_.newToken();
    auto set = model_.execute(model::SetGradient{wish.key, gradient}, token);
    const document::Light* light = model_.light(model_.lightOf(wish.key));
    if (set && light != nullptr && !light->path) { // a path gives the axis
        const document::Key* key = model_.key(wish.key);
        const glm::dvec3 has =
            glm::normalize(key->axis.value_or(light->axis.value_or(glm::dvec3(0.0, 1.0, 0.0))));
        if (glm::dot(has, glm::normalize(wish.axis)) < 1.0 - 1e-12) {
            model::SetKey turned;
            turned.key = wish.key;
            turned.axis.emplace(wish.axis);
            set = model_.execute(turned, token);
        }
    }
    if (!set) {
        workspace_.say(set.error().message(), true);
    }
    session_.wake();
}

void Editor::answerPhotograph(const ui::Wishes& wishes) {
    if (wishes.cancelWork) {
        cancelWork();
    }
    if (wishes.openPhotograph) {
        openPhotograph(*wishes.openPhotograph);
    }
    if (wishes.closePhotograph) {
        closePhotograph();
    }
    if (wishes.lights) {
        useLights(*wishes.lights);
    }
    if (wishes.mean) {
        useMean(*wishes.mean);
    }
    if (photographSmall_ && photographExposure_ != workspace_.view().exposure) {
        session_.wake();
    }
    describeWork();
}

} // namespace lodestar::app
