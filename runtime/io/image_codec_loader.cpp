// SPDX-License-Identifier: MIT
#include <dlfcn.h>

#include "io/image_codec.h"

namespace lodestar::io {
namespace {

core::Result<const ImageCodec*> load() {
    // Found by the run path of the program, which names its own folder. Never unloaded: OpenImageIO
    // keeps threads and tables.
    void* module = dlopen(LODESTAR_CODEC_MODULE, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
    void* entry = module != nullptr ? dlsym(module, "lodestarImageCodec") : nullptr;
    if (entry == nullptr) {
        const char* reason = dlerror();
        return core::Error{core::ErrorCode::Internal,
                           std::string("the image module cannot be loaded: ") +
                               (reason != nullptr ? reason : "it has no entry point"),
                           LODESTAR_CODEC_MODULE,
                           {}};
    }
    return reinterpret_cast<decltype(&lodestarImageCodec)>(entry)();
}

} // namespace

core::Result<const ImageCodec*> imageCodec() {
    static const core::Result<const ImageCodec*> codec = load();
    return codec;
}

} // namespace lodestar::io
