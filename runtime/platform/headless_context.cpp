// SPDX-License-Identifier: MIT
#include "platform/headless_context.h"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#ifndef EGL_PLATFORM_SURFACELESS_MESA
#define EGL_PLATFORM_SURFACELESS_MESA 0x31DD
#endif

namespace lodestar::platform {
namespace {

constexpr int kMajor = 3;
constexpr int kMinor = 3;

std::string hex(EGLint value) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "0x%04X", static_cast<unsigned>(value));
    return text.data();
}

core::Error noOpenGl(const std::string& found) {
    return {core::ErrorCode::NoOpenGl,
            "no usable OpenGL: asked EGL for an OpenGL " + std::to_string(kMajor) + "." +
                std::to_string(kMinor) + " core context without a window, found " + found,
            {},
            {}};
}

/// The displays worth trying, best first. Entry points are fetched by name: the loader refuses its
/// own EGL 1.5 wrappers before a display exists.
std::vector<EGLDisplay> candidateDisplays() {
    std::vector<EGLDisplay> displays;
    auto* getPlatformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    auto* queryDevices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    if (getPlatformDisplay == nullptr) {
        return displays;
    }
    displays.push_back(
        getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    std::array<EGLDeviceEXT, 8> devices{};
    EGLint count = 0;
    if (queryDevices != nullptr &&
        queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
        for (EGLint i = 0; i < count; ++i) {
            displays.push_back(getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT,
                                                  devices[static_cast<std::size_t>(i)], nullptr));
        }
    }
    return displays;
}

EGLContext createContext(EGLDisplay display, bool egl15, bool debug) {
    std::vector<EGLint> attributes = {
        EGL_CONTEXT_MAJOR_VERSION_KHR,       kMajor,
        EGL_CONTEXT_MINOR_VERSION_KHR,       kMinor,
        EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR};
    if (debug && egl15) {
        attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
    } else if (debug) {
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
    }
    attributes.push_back(EGL_NONE);
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

} // namespace

struct HeadlessContext::Handles {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    ~Handles() {
        if (display != EGL_NO_DISPLAY) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            if (context != EGL_NO_CONTEXT) {
                eglDestroyContext(display, context);
            }
            eglTerminate(display);
        }
    }
};

HeadlessContext::HeadlessContext(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}
HeadlessContext::HeadlessContext(HeadlessContext&& other) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&& other) noexcept = default;
HeadlessContext::~HeadlessContext() = default;

core::Result<HeadlessContext> HeadlessContext::create() {
    std::string found = "no EGL display";
    for (EGLDisplay display : candidateDisplays()) {
        EGLint major = 0;
        EGLint minor = 0;
        if (display == EGL_NO_DISPLAY || eglInitialize(display, &major, &minor) != EGL_TRUE) {
            continue;
        }
        auto handles = std::make_unique<Handles>();
        handles->display = display;
        const bool egl15 = major > 1 || minor >= 5;
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
            found = "EGL without desktop OpenGL";
            continue;
        }
        handles->context = createContext(display, egl15, true);
        if (handles->context == EGL_NO_CONTEXT) {
            handles->context = createContext(display, egl15, false);
        }
        if (handles->context == EGL_NO_CONTEXT) {
            const char* vendor = eglQueryString(display, EGL_VENDOR);
            found = "EGL " + std::to_string(major) + "." + std::to_string(minor) + " (" +
                    (vendor != nullptr ? vendor : "unknown vendor") +
                    ") that refuses it with error " + hex(eglGetError());
            continue;
        }
        if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles->context) != EGL_TRUE) {
            found = "a context that cannot be made current without a surface, error " +
                    hex(eglGetError());
            continue;
        }
        if (epoxy_gl_version() < kMajor * 10 + kMinor) {
            found = "OpenGL " + std::to_string(epoxy_gl_version() / 10) + "." +
                    std::to_string(epoxy_gl_version() % 10);
            continue;
        }
        return HeadlessContext(std::move(handles));
    }
    return noOpenGl(found);
}

} // namespace lodestar::platform
