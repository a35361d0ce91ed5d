// SPDX-License-Identifier: MIT
//
// An engine with windows of its own in Dear ImGui, and the editor's panels among them. What it
// shows is lit by the document as it is edited, in the frame of the edit.
#pragma once

#include <memory>

#include "call.h"
#include "deferred_engine.h"
#include "engine_light.h"
#include "model/document_file.h"
#include "ui/workspace.h"

namespace lodestar::samples {

class PanelsHost {
public:
    /// @pre a context of OpenGL 3.3 is current, and stays so
    /// @errors InputRefused, Internal: a scene or a document that cannot be shown
    [[nodiscard]] static core::Result<std::unique_ptr<PanelsHost>> make(const HostCall& call,
                                                                        EngineLight::Loader loader);

    /// Where the host's back-end has a key in ImGuiIO::KeysDown (ui::Surroundings).
    void setPlaceOfKey(int (*placeOfKey)(ui::Key)) { around_.placeOfKey = placeOfKey; }

    /// All of a frame but its beginning and its end. @pre ImGui::NewFrame was called; ImGui::Render
    /// comes after it  @param seconds since the start, for autosaving
    /// @errors InputRefused: the document as edited
    [[nodiscard]] core::Result<void> frame(double seconds);

    [[nodiscard]] model::Model& model() { return model_; }
    [[nodiscard]] const ui::Workspace& workspace() const { return workspace_; }
    [[nodiscard]] const DeferredEngine& engine() const { return engine_; }

private:
    PanelsHost(const HostCall& call, HostScene scene, hosts::LitContext lit,
               EngineLight::Loader loader);
    void drawWindows();
    void drawEngineWindow();
    void answer(const ui::Wishes& wishes);
    [[nodiscard]] core::Result<void> drawPicture();

    // The engine.
    HostCall call_;
    HostScene scene_;
    hosts::LitContext lit_;
    DeferredEngine engine_;
    EngineLight light_;
    float turned_ = 0.0f; ///< of its camera, degrees

    // The editor.
    model::Model model_;
    model::DocumentFile file_;
    ui::Workspace workspace_;
    ui::Surroundings around_;
    std::uint64_t litRevision_ = 0; ///< the revision that lights the engine
};

} // namespace lodestar::samples
