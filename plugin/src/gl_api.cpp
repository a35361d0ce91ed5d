// SPDX-License-Identifier: MIT
//
// The functions of the extension "lodestar.gl".
#include "answers.h"

namespace lodestar::plugin {
namespace {

LodestarStatus attach(LodestarContext* context, void* (*getProcedure)(const char*)) noexcept {
    if (!lives(context)) {
        return LODESTAR_E_ARG;
    }
    // From here on what fails is this thread's; a second attachment is refused, whoever makes it.
    std::thread::id none;
    if (!context->glThread.compare_exchange_strong(none, std::this_thread::get_id())) {
        return none == std::this_thread::get_id()
                   ? context->fail(LODESTAR_E_ARG, "an OpenGL context is attached already")
                   : LODESTAR_E_THREAD;
    }
    const LodestarStatus status = guarded(*context, [&]() -> LodestarStatus {
        if (getProcedure == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no way to ask for functions");
        }
        GlFunctions functions;
        if (!functions.load(getProcedure)) {
            return context->fail(LODESTAR_E_UNSUPPORTED,
                                 "OpenGL 3.3 is needed, or a function of it is missing");
        }
        context->gl = std::make_unique<GlTextures>(functions);
        return LODESTAR_OK;
    });
    if (status != LODESTAR_OK) {
        context->glThread = std::thread::id();
    }
    return status;
}

LodestarStatus detach(LodestarContext* context, int32_t alive) noexcept {
    return attached(context, [&]() -> LodestarStatus {
        if (alive != 0) {
            context->gl->destroy();
        }
        context->gl.reset();
        context->glThread = std::thread::id();
        return LODESTAR_OK;
    });
}

LodestarStatus execute(LodestarContext* context, LodestarPlan plan) noexcept {
    return attached(context, [&]() -> LodestarStatus {
        const std::shared_ptr<const Packet> packet = context->plans.find(plan);
        if (!packet) {
            return context->fail(LODESTAR_E_ARG, "no such plan, or four have been made since");
        }
        context->gl->execute(*packet);
        return LODESTAR_OK;
    });
}

LodestarStatus texture(LodestarContext* context, int32_t texels, LodestarGlTexture* into) noexcept {
    return attached(context, [&]() -> LodestarStatus {
        if (texels < 0 || texels >= kTexelKinds) {
            return context->fail(LODESTAR_E_ARG, "no such texels");
        }
        return writeStruct(context->gl->texture(texels), into)
                   ? LODESTAR_OK
                   : context->fail(LODESTAR_E_ABI, "the texture's struct_size is none");
    });
}

LodestarStatus readCube(LodestarContext* context, uint32_t name, float* rgba,
                        size_t* size) noexcept {
    return attached(context, [&]() -> LodestarStatus {
        if (size == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no place for the size");
        }
        const int width = context->gl->cubeWidth(name);
        if (width == 0) {
            return context->fail(LODESTAR_E_ARG, "no cube texture whose faces have level 0");
        }
        const auto w = static_cast<std::size_t>(width);
        const std::size_t room = *size;
        *size = 6 * w * w * 4 * sizeof(float);
        if (rgba == nullptr || room < *size) {
            return LODESTAR_MORE;
        }
        context->gl->readCube(name, width, rgba);
        return LODESTAR_OK;
    });
}

LodestarStatus setHostResets(LodestarContext* context, int32_t resets) noexcept {
    return attached(context, [&]() -> LodestarStatus {
        context->gl->setHostResets(resets != 0);
        return LODESTAR_OK;
    });
}

LodestarStatus work(LodestarContext* context, LodestarWork* into) noexcept {
    return attached(context, [&]() -> LodestarStatus {
        return writeStruct(context->gl->work(), into)
                   ? LODESTAR_OK
                   : context->fail(LODESTAR_E_ABI, "the work's struct_size is none");
    });
}

constexpr LodestarGlApi kApi{sizeof(LodestarGlApi), 0,   attach, detach, execute, texture, readCube,
                             setHostResets,         work};

} // namespace

const LodestarGlApi* glApi() {
    return &kApi;
}

} // namespace lodestar::plugin
