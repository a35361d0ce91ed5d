// SPDX-License-Identifier: MIT
//
// The table's functions of environments.
#include "context.h"

namespace lodestar::plugin {
namespace {

LodestarStatus noEnvironment(LodestarContext& context) {
    return context.fail(LODESTAR_E_ARG, "no such environment");
}

LodestarStatus create(LodestarContext* context, const LodestarEnvironmentDesc* desc,
                      LodestarEnvironment* handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        LodestarEnvironmentDesc given{};
        if (handle == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no place for the environment");
        }
        if (!readStruct(desc, given)) {
            return context->fail(LODESTAR_E_ABI,
                                 "the environment's struct_size is none, or members are unknown");
        }
        core::Tally warnings;
        auto made = PlacedEnvironment::make(given, context->hostFromDocument, warnings);
        if (!made) {
            return context->fail(LODESTAR_E_ARG, made.error());
        }
        *handle = context->environments.add(std::move(*made));
        context->log(warnings);
        return LODESTAR_OK;
    });
}

LodestarStatus destroy(LodestarContext* context, LodestarEnvironment handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!context->environments.remove(handle)) {
            return noEnvironment(*context);
        }
        if (context->environment == handle) {
            context->environment = 0;
        }
        return LODESTAR_OK;
    });
}

LodestarStatus setDistant(LodestarContext* context, LodestarEnvironment handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (handle != 0 && context->environments.find(handle) == nullptr) {
            return noEnvironment(*context);
        }
        context->environment = handle;
        return LODESTAR_OK;
    });
}

LodestarStatus setFace(LodestarContext* context, LodestarEnvironment handle, int32_t face,
                       const float* pixels, uint32_t channels) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        PlacedEnvironment* environment = context->environments.find(handle);
        if (environment == nullptr) {
            return noEnvironment(*context);
        }
        if (!environment->isCaptured()) {
            return context->fail(LODESTAR_E_ARG, "the environment is not captured");
        }
        if (face < 0 || face >= 6 || pixels == nullptr || (channels != 3 && channels != 4)) {
            return context->fail(LODESTAR_E_ARG,
                                 "a face is 0 to 5, its pixels are there, of 3 or 4 channels");
        }
        core::Tally warnings;
        environment->setFace(face, pixels, channels, warnings);
        context->log(warnings);
        return LODESTAR_OK;
    });
}

LodestarStatus request(LodestarContext* context, LodestarEnvironment handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        PlacedEnvironment* environment = context->environments.find(handle);
        if (environment == nullptr) {
            return noEnvironment(*context);
        }
        if (!environment->isCaptured()) {
            return context->fail(LODESTAR_E_ARG, "the environment is not captured");
        }
        environment->request();
        return LODESTAR_OK;
    });
}

bool isCube(int32_t texels) {
    return texels == LODESTAR_TEXELS_ENVIRONMENT || texels == LODESTAR_TEXELS_IRRADIANCE;
}

LodestarStatus cube(LodestarContext* context, LodestarEnvironment handle, int32_t texels,
                    LodestarCube* into) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        PlacedEnvironment* environment = context->environments.find(handle);
        if (environment == nullptr) {
            return noEnvironment(*context);
        }
        if (!isCube(texels)) {
            return context->fail(LODESTAR_E_ARG, "no such texels of an environment");
        }
        LodestarCube answer{};
        answer.version = environment->version();
        answer.faces_missing = environment->missing();
        if (answer.version != 0) {
            const lighting::CubeTexels& made = *environment->texels(texels);
            answer.width = static_cast<std::uint32_t>(made.width);
            answer.levels = static_cast<std::uint32_t>(made.levels.size());
            answer.half_floats = made.half ? 1 : 0;
            answer.scale = double{made.scale};
        }
        return writeStruct(answer, into)
                   ? LODESTAR_OK
                   : context->fail(LODESTAR_E_ABI, "the cube's struct_size is none");
    });
}

LodestarStatus cubeTexels(LodestarContext* context, LodestarEnvironment handle, int32_t texels,
                          uint32_t level, void* buffer, size_t* size) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        PlacedEnvironment* environment = context->environments.find(handle);
        if (environment == nullptr) {
            return noEnvironment(*context);
        }
        if (size == nullptr || !isCube(texels)) {
            return context->fail(LODESTAR_E_ARG, "no place for the size, or no such texels");
        }
        if (environment->version() == 0) {
            return context->fail(LODESTAR_E_ARG, "the capture has never been whole");
        }
        const lighting::CubeTexels& made = *environment->texels(texels);
        if (level >= made.levels.size()) {
            return context->fail(LODESTAR_E_ARG, "no such level");
        }
        return answerQuery(made.levels[level].data(), made.levels[level].size(), 1, buffer, size);
    });
}

LodestarStatus ofDocument(LodestarContext* context, LodestarDocument handle, char* source,
                          size_t* size, double* rotation, double* ev) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        const document::Document* document = context->documents.find(handle);
        if (document == nullptr || size == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no such document, or no place for the size");
        }
        if (!document->environment) {
            *size = 0;
            return LODESTAR_OK;
        }
        const document::Environment& environment = *document->environment;
        if (rotation != nullptr) {
            *rotation = environment.rotation;
        }
        if (ev != nullptr) {
            *ev = environment.ev;
        }
        return answerQuery(environment.source.c_str(), environment.source.size() + 1, 1, source,
                           size);
    });
}

} // namespace

void addEnvironmentApi(LodestarApi& api) {
    api.environment_create = create;
    api.environment_destroy = destroy;
    api.set_environment = setDistant;
    api.environment_face = setFace;
    api.environment_request = request;
    api.environment_cube = cube;
    api.environment_texels = cubeTexels;
    api.document_environment = ofDocument;
}

} // namespace lodestar::plugin
