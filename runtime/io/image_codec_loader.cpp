// SPDX-License-Identifier: MIT
#include "io/image_codec.h"

#include <filesystem>
#include <string>
#include <system_error>

#include <dlfcn.h>

namespace lodestar::io {
namespace {

/// The module in the folder of the program or library that this code is part of. The run path would
/// find it too, but not under the address sanitizer, whose own dlopen has the run path of libasan.
std::string besideThis() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&besideThis), &info) == 0 ||
        info.dli_fname == nullptr) {
        return LODESTAR_CODEC_MODULE;
    }
    std::error_code code;
    const std::filesystem::path here = std::filesystem::canonical(info.dli_fname, code);
    return code ? LODESTAR_CODEC_MODULE : (here.parent_path() / LODESTAR_CODEC_MODULE).string();
}

core::Result<const ImageCodec*> load() {
    // Never unloaded: OpenImageIO keeps threads and tables.
    constexpr int kFlags = RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE;
    void* module = dlopen(besideThis().c_str(), kFlags);
    if (module == nullptr) {
        module = dlopen(LODESTAR_CODEC_MODULE, kFlags);
    }
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
