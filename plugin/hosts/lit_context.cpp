// SPDX-License-Identifier: MIT
#include "hosts/lit_context.h"

#include "io/file.h"

namespace lodestar::hosts {

core::Result<LitContext> LitContext::open(const std::string& file) {
    const auto text = io::readFile(file);
    if (!text) {
        return text.error();
    }
    LodestarApi api{};
    api.struct_size = sizeof api;
    LodestarContext* context = nullptr;
    if (lodestar_get_api(LODESTAR_ABI_VERSION, &api) != LODESTAR_OK ||
        api.context_create(nullptr, &context) != LODESTAR_OK) {
        return core::Error{core::ErrorCode::Internal, "the library cannot be used", {}, {}};
    }
    LitContext result(api, Owned(context, api.context_destroy));
    if (api.document_load(context, reinterpret_cast<const char*>(text->data()), text->size(),
                          &result.document_) != LODESTAR_OK ||
        api.document_apply(context, result.document_) != LODESTAR_OK) {
        return core::inFile(result.refusal(), file);
    }
    std::size_t lights = 0;
    api.lights(context, nullptr, &lights);
    if (lights == 0) {
        return core::inFile(core::refused("has neither a sky nor a sun", "/lights"), file);
    }
    return result;
}

core::Error LitContext::refusal() const {
    return core::refused(api_.last_error(get()));
}

} // namespace lodestar::hosts
