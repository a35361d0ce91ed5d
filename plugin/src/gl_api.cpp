// SPDX-License-Identifier: MIT
//
// The functions of the extension "lodestar.gl".
#include "context.h"

namespace lodestar::plugin {
namespace {

LodestarStatus notAttached(LodestarContext& context) {
    return context.fail(LODESTAR_E_ARG, "no OpenGL context is attached");
}

LodestarStatus attach(LodestarContext* context, void* (*getProcedure)(const char*)) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (getProcedure == nullptr || context->gl) {
            return context->fail(LODESTAR_E_ARG,
                                 "no way to ask for functions, or attached already");
        }
        GlFunctions functions;
        if (!functions.load(getProcedure)) {
            return context->fail(LODESTAR_E_UNSUPPORTED,
                                 "OpenGL 3.3 is needed, or a function of it is missing");
        }
        context->gl = std::make_unique<GlLights>(functions);
        return LODESTAR_OK;
    });
}

LodestarStatus detach(LodestarContext* context, int32_t alive) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!context->gl) {
            return notAttached(*context);
        }
        if (alive != 0) {
            context->gl->destroy();
        }
        context->gl.reset();
        return LODESTAR_OK;
    });
}

LodestarStatus update(LodestarContext* context) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!context->gl) {
            return notAttached(*context);
        }
        context->gl->update(*context);
        return LODESTAR_OK;
    });
}

LodestarStatus texture(LodestarContext* context, int32_t which, LodestarGlTexture* into) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!context->gl) {
            return notAttached(*context);
        }
        if (which < 0 || which >= kTexelKinds) {
            return context->fail(LODESTAR_E_ARG, "no such texels");
        }
        return writeStruct(context->gl->texture(which), into)
                   ? LODESTAR_OK
                   : context->fail(LODESTAR_E_ABI, "the texture's struct_size is none");
    });
}

LodestarStatus layer(LodestarContext* context, LodestarLight light, uint32_t* layer) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!context->gl) {
            return notAttached(*context);
        }
        const int found = context->gl->layer(light);
        if (layer == nullptr || found < 0) {
            return context->fail(LODESTAR_E_ARG, "no place for the layer, or the light has none");
        }
        *layer = static_cast<std::uint32_t>(found);
        return LODESTAR_OK;
    });
}

LodestarStatus setHostResets(LodestarContext* context, int32_t resets) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!context->gl) {
            return notAttached(*context);
        }
        context->gl->setHostResets(resets != 0);
        return LODESTAR_OK;
    });
}

constexpr LodestarGlApi kApi{sizeof(LodestarGlApi), 0, attach, detach, update, texture, layer,
                             setHostResets};

} // namespace

const LodestarGlApi* glApi() {
    return &kApi;
}

} // namespace lodestar::plugin
