// SPDX-License-Identifier: MIT
//
// lodestar-panels: an engine's own window and ImGui context, with the panels of Lodestar's editor
// in them (panels_host.h). Without a display it draws its frames by EGL and writes the last one.
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "gl/framebuffer.h"
#include "io/image_file.h"
#include "panels_host.h"
#include "platform/headless_context.h"

namespace lodestar::samples {
namespace {

constexpr int kWidth = 1128, kHeight = 716;

struct Call {
    HostCall host;
    int frames = 0; ///< 0: in a window, until it is closed
};

/// Dear ImGui's context of this program, drawn by OpenGL.
class Gui {
public:
    Gui() {
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui_ImplOpenGL3_Init("#version 330 core");
    }
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;
    ~Gui() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui::DestroyContext();
    }
};

core::Result<void> drawFrame(PanelsHost& host, double seconds, GLuint framebuffer, int width,
                             int height) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    auto drawn = host.frame(seconds);
    ImGui::Render();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    glClearColor(0.1f, 0.1f, 0.1f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    return drawn;
}

/// GLFW's number of a key, which is its place in ImGuiIO::KeysDown.
int placeOfKey(ui::Key key) {
    switch (key) {
    case ui::Key::Escape:
        return GLFW_KEY_ESCAPE;
    case ui::Key::Delete:
        return GLFW_KEY_DELETE;
    default:
        return key <= ui::Key::Z ? GLFW_KEY_A + static_cast<int>(key) : -1;
    }
}

core::Error noWindow() {
    const char* why = nullptr;
    glfwGetError(&why);
    return {core::ErrorCode::NoOpenGl, why != nullptr ? why : "no window", {}, {}};
}

core::Result<void> runInWindow(const Call& call, GLFWwindow* window) {
    glfwMakeContextCurrent(window);
    const Gui gui;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    auto host = PanelsHost::make(call.host, [](const char* name) {
        return reinterpret_cast<void*>(glfwGetProcAddress(name));
    });
    core::Result<void> done;
    if (!host) {
        done = host.error();
    } else {
        (*host)->setPlaceOfKey(placeOfKey);
    }
    while (done && !glfwWindowShouldClose(window)) {
        glfwPollEvents();
        ImGui_ImplGlfw_NewFrame();
        int width = 0, height = 0;
        glfwGetFramebufferSize(window, &width, &height);
        done = drawFrame(**host, glfwGetTime(), 0, width, height);
        glfwSwapBuffers(window);
    }
    ImGui_ImplGlfw_Shutdown();
    return done;
}

core::Result<void> showWindow(const Call& call) {
    if (glfwInit() != GLFW_TRUE) {
        return noWindow();
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow* window = glfwCreateWindow(kWidth, kHeight, "An engine", nullptr, nullptr);
    const auto done = window != nullptr ? runInWindow(call, window) : noWindow();
    glfwTerminate();
    return done;
}

core::Result<void> drawFrames(const Call& call) {
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return context.error();
    }
    auto device = gl::Device::create();
    if (!device) {
        return device.error();
    }
    auto target = gl::DisplayTarget::make(**device, kWidth, kHeight);
    if (!target) {
        return target.error();
    }
    const Gui gui;
    auto host = PanelsHost::make(call.host, [](const char* name) {
        return reinterpret_cast<void*>(eglGetProcAddress(name));
    });
    if (!host) {
        return host.error();
    }
    for (int i = 0; i < call.frames; ++i) {
        ImGui::GetIO().DisplaySize = {kWidth, kHeight};
        ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
        if (auto drawn = drawFrame(**host, i / 60.0, target->framebuffer(), kWidth, kHeight);
            !drawn) {
            return drawn;
        }
    }
    return io::writeImage(call.host.output, target->read());
}

std::optional<Call> parse(int argc, char** argv) {
    Call call;
    call.host.height = 412;
    call.host.width = 660;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        char rest = 0;
        if (word.empty() || word[0] != '-') {
            call.host.scene = word;
        } else if (i + 1 == argc) {
            return {};
        } else if (word == "--frames") {
            if (std::sscanf(argv[++i], "%d%c", &call.frames, &rest) != 1 || call.frames < 1) {
                return {};
            }
        } else if (!takeWord(call.host, word, argv[++i])) {
            return {};
        }
    }
    const bool whole = !call.host.scene.empty() && !call.host.lighting.empty();
    return whole && call.host.output.empty() == (call.frames == 0) ? std::optional(call)
                                                                   : std::nullopt;
}

int explain(int argc, char** argv) {
    const bool asked = argc == 2 && std::strcmp(argv[1], "--help") == 0;
    std::fputs("usage: lodestar-panels SCENE --lighting FILE [--frames N -o OUT.png] [--size WxH]\n"
               "           [--hour H] [--eye X,Y,Z --target X,Y,Z] [--fov DEGREES]\n"
               "An engine that draws a scene, with the panels of Lodestar's editor in its own\n"
               "windows: what is edited lights it in the same frame, Ctrl+S saves FILE. With\n"
               "--frames it draws so many without a display and writes the last; --size is the\n"
               "engine's picture.\n"
               "Example: lodestar-panels spheres.gltf --lighting dusk.lodestar.json --hour 18.5\n",
               asked ? stdout : stderr);
    return asked ? 0 : 2;
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    using namespace lodestar;
    const auto call = samples::parse(argc, argv);
    if (!call) {
        return samples::explain(argc, argv);
    }
    const auto done = call->frames > 0 ? samples::drawFrames(*call) : samples::showWindow(*call);
    if (!done) {
        std::fprintf(stderr, "lodestar-panels: %s\n", done.error().message().c_str());
        return static_cast<int>(done.error().code);
    }
    return 0;
}
