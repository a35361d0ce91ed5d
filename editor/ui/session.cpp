// SPDX-License-Identifier: MIT
#include "ui/session.h"

#include <algorithm>
#include <cmath>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "ui/assertions.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

/// Frames until a layout stands still after an input: one that shows it, one in which widgets that
/// were measured in it take their places, one in which what follows from those does.
constexpr int kFramesToSettle = 3;

/// Where Escape goes down Dear ImGui 1.86 asks the last popup for its window, and one that was
/// opened in place of another has none until the next frame (BeginMenu): Escape closes it here.
void closeUnseenPopups(const ImGuiIO& io) {
    const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
    while (io.KeysDown[static_cast<int>(Key::Escape)] && !open.empty() &&
           open.back().Window == nullptr) {
        ImGui::ClosePopupToLevel(open.Size - 1, false);
    }
}

} // namespace

Session::Session(Drawing drawing, Clipboard clipboard)
    : drawing_(drawing), clipboard_(std::move(clipboard)) {
    start();
}

Session::~Session() {
    ImGui::SetCurrentContext(context_);
    if (drawing_ == Drawing::OpenGl) {
        ImGui_ImplOpenGL3_Shutdown();
    }
    ImGui::DestroyContext(context_);
}

void Session::start() {
    IMGUI_CHECKVERSION();
    context_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigInputTextCursorBlink = false; // an editor at rest draws nothing
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.BackendPlatformName = "lodestar";
    mapKeys(io);
    if (clipboard_.text && clipboard_.set) {
        io.ClipboardUserData = this;
        io.GetClipboardTextFn = [](void* self) {
            auto& session = *static_cast<Session*>(self);
            session.clipboardText_ = session.clipboard_.text();
            return session.clipboardText_.c_str();
        };
        io.SetClipboardTextFn = [](void* self, const char* text) {
            static_cast<Session*>(self)->clipboard_.set(text);
        };
    }
    if (drawing_ == Drawing::OpenGl) {
        ImGui_ImplOpenGL3_Init("#version 330 core");
    } else { // as there: lists of more than 65536 vertices
        io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    }
    scale_ = 0.0f;
    framesWanted_ = kFramesToSettle;
}

void Session::push(const Input& input) {
    queue_.push(input);
    framesWanted_ = kFramesToSettle;
}

void Session::useScale(float scale) {
    const float wanted = std::isfinite(scale) ? std::clamp(scale, 1.0f, 8.0f) : 1.0f;
    if (wanted == scale_) {
        return;
    }
    const bool first = scale_ == 0.0f;
    scale_ = wanted;
    applyTheme(scale_);
    if (drawing_ == Drawing::OpenGl && !first) {
        // Its other objects stay: Dear ImGui 1.86 would take new buffers to be as large as the old.
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    } else if (drawing_ != Drawing::OpenGl) {
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
}

void Session::frame(int width, int height, float scale, double seconds,
                    const std::function<void()>& contents) {
    ImGui::SetCurrentContext(context_);
    framesWanted_ = std::max(framesWanted_ - 1, 0);
    ++framesBuilt_;
    failure_ = guarded([&] {
        useScale(scale);
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
        io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 1.0));
        queue_.feed(io);
        closeUnseenPopups(io);
        if (drawing_ == Drawing::OpenGl) {
            ImGui_ImplOpenGL3_NewFrame();
        }
        ImGui::NewFrame();
        if (io.MouseClicked[0]) {
            // An arrow and a double click on where it leads, in one frame: a field would be
            // activated for the arrow, which hides the pointer from it, and assert that it is not.
            ImGui::GetCurrentContext()->NavJustMovedToId = 0;
        }
        contents();
        ImGui::Render();
    });
    whole_ = failure_.empty();
    if (!whole_) {
        // What the old context holds of the frame cannot be told: it is left as it is, but for
        // the letters, which are most of it.
        ImGui::GetIO().Fonts->Locked = false;
        ImGui::GetIO().Fonts->ClearTexData();
        if (drawing_ == Drawing::OpenGl) {
            ImGui_ImplOpenGL3_Shutdown();
        }
        start();
    } else if (!queue_.empty()) {
        framesWanted_ = kFramesToSettle;
    }
}

void Session::render() {
    if (whole_) {
        ImGui::SetCurrentContext(context_);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    }
}

} // namespace lodestar::ui
