// SPDX-License-Identifier: MIT
#include "panels_host.h"

#include <cstdint>
#include <filesystem>

#include <glm/gtc/matrix_transform.hpp>
#include <imgui.h>

#include "document/document.h"
#include "lighting/day.h"

namespace lodestar::samples {
namespace {

/// A window whose first place is given; the user moves it.
void begin(const char* name, float x, float y, float width, float height) {
    ImGui::SetNextWindowPos({x, y}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({width, height}, ImGuiCond_FirstUseEver);
    ImGui::Begin(name);
}

} // namespace

PanelsHost::PanelsHost(const HostCall& call, HostScene scene, hosts::LitContext lit,
                       EngineLight::Loader loader)
    : call_(call), scene_(std::move(scene)), lit_(std::move(lit)), engine_(call.width, call.height),
      light_(lit_, loader) {}

core::Result<std::unique_ptr<PanelsHost>> PanelsHost::make(const HostCall& call,
                                                           EngineLight::Loader loader) {
    auto scene = loadScene(call);
    if (!scene) {
        return scene.error();
    }
    auto lit = hosts::LitContext::open(call.lighting);
    if (!lit) {
        return lit.error();
    }
    std::unique_ptr<PanelsHost> host(
        new PanelsHost(call, std::move(*scene), std::move(*lit), loader));
    if (auto prepared = host->light_.prepare(host->scene_.file, host->engine_); !prepared) {
        return core::inFile(prepared.error(), call.scene);
    }
    core::Tally warnings;
    auto file = model::DocumentFile::open(call.lighting, host->model_, warnings);
    if (!file) {
        return file.error();
    }
    host->file_ = std::move(*file);
    host->around_.sceneName = std::filesystem::path(call.scene).filename().string();
    host->litRevision_ = host->model_.revisions().document;
    host->workspace_.view().hour = call.hour;
    return host;
}

core::Result<void> PanelsHost::frame(double seconds) {
    drawWindows();
    ui::ViewState& view = workspace_.view();
    if (view.playing) {
        view.hour = lighting::wrappedHour(
            view.hour + view.hoursASecond * static_cast<double>(ImGui::GetIO().DeltaTime));
    }
    if (auto saved = file_.autosave(model_, seconds); !saved) {
        workspace_.say(saved.error().message(), true);
    }
    // The windows show the texture when ImGui draws, after this: what was edited is in it already.
    return drawPicture();
}

void PanelsHost::drawWindows() {
    drawEngineWindow();
    answer(workspace_.draw(model_, around_, [](const ui::Panels& panels) {
        begin("Lights", 700.0f, 8.0f, 420.0f, 160.0f);
        panels.scene();
        ImGui::End();
        begin("Light", 700.0f, 176.0f, 420.0f, 532.0f);
        panels.light();
        if (ImGui::IsWindowFocused()) {
            panels.answerKeys(); // elsewhere keys are the engine's
        }
        ImGui::End();
        begin("Day", 8.0f, 512.0f, 684.0f, 196.0f);
        panels.day();
        ImGui::End();
    }));
}

void PanelsHost::drawEngineWindow() {
    begin("Engine", 8.0f, 8.0f, 684.0f, 496.0f);
    ImGui::SliderFloat("camera", &turned_, -180.0f, 180.0f, "%.0f degrees");
    ImGui::Text("%.1f ms a frame%s", 1000.0 / static_cast<double>(ImGui::GetIO().Framerate),
                model_.dirty() ? ", the lighting is not saved" : "");
    const auto texture =
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(engine_.picture()));
    ImGui::Image(texture, {static_cast<float>(call_.width), static_cast<float>(call_.height)},
                 {0.0f, 1.0f}, {1.0f, 0.0f}); // its row 0 is at the bottom
    ImGui::End();
}

void PanelsHost::answer(const ui::Wishes& wishes) {
    if (wishes.save) {
        const auto saved = file_.save(model_);
        workspace_.say(saved ? "saved" : saved.error().message(), !saved);
    }
}

core::Result<void> PanelsHost::drawPicture() {
    if (litRevision_ != model_.revisions().document) {
        litRevision_ = model_.revisions().document;
        if (auto lit = lit_.relight(document::writeDocument(model_.document())); !lit) {
            return lit;
        }
    }
    scene::View view = scene_.view;
    view.cameraFromWorld =
        glm::rotate(view.cameraFromWorld, glm::radians(turned_), glm::vec3(0.0f, 1.0f, 0.0f));
    view.position = glm::vec3(glm::inverse(view.cameraFromWorld)[3]);
    if (auto set = light_.set(workspace_.view().hour, view, engine_); !set) {
        return set;
    }
    engine_.draw(view.clipFromWorld());
    return {};
}

} // namespace lodestar::samples
