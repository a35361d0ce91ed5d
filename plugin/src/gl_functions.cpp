// SPDX-License-Identifier: MIT
#include "gl_functions.h"

#include <type_traits>

namespace lodestar::plugin {

bool GlFunctions::load(void* (*procedure)(const char* name)) {
    const auto get = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(procedure(name));
        return function != nullptr;
    };
    const bool all = get(getIntegerv, "glGetIntegerv") && get(isTexture, "glIsTexture") &&
                     get(genTextures, "glGenTextures") && get(deleteTextures, "glDeleteTextures") &&
                     get(bindTexture, "glBindTexture") && get(texParameteri, "glTexParameteri") &&
                     get(pixelStorei, "glPixelStorei") && get(texImage2D, "glTexImage2D") &&
                     get(texImage3D, "glTexImage3D") && get(texSubImage3D, "glTexSubImage3D") &&
                     get(getTexLevelParameteriv, "glGetTexLevelParameteriv") &&
                     get(getTexImage, "glGetTexImage") && get(bindBuffer, "glBindBuffer");
    GLint major = 0, minor = 0;
    if (all) {
        getIntegerv(GL_MAJOR_VERSION, &major);
        getIntegerv(GL_MINOR_VERSION, &minor);
    }
    return 10 * major + minor >= 33;
}

StateGuard::StateGuard(const GlFunctions& gl, Way way, bool hostResets, std::uint64_t& queries)
    : gl_(gl), bufferTarget_(way == Way::Unpack ? GL_PIXEL_UNPACK_BUFFER : GL_PIXEL_PACK_BUFFER) {
    const bool unpack = way == Way::Unpack;
    stores_ = {{{unpack ? GLenum{GL_UNPACK_ALIGNMENT} : GLenum{GL_PACK_ALIGNMENT}, 4},
                {unpack ? GLenum{GL_UNPACK_ROW_LENGTH} : GLenum{GL_PACK_ROW_LENGTH}, 0},
                {unpack ? GLenum{GL_UNPACK_IMAGE_HEIGHT} : GLenum{GL_PACK_IMAGE_HEIGHT}, 0},
                {unpack ? GLenum{GL_UNPACK_SKIP_ROWS} : GLenum{GL_PACK_SKIP_ROWS}, 0},
                {unpack ? GLenum{GL_UNPACK_SKIP_PIXELS} : GLenum{GL_PACK_SKIP_PIXELS}, 0},
                {unpack ? GLenum{GL_UNPACK_SKIP_IMAGES} : GLenum{GL_PACK_SKIP_IMAGES}, 0},
                {unpack ? GLenum{GL_UNPACK_SWAP_BYTES} : GLenum{GL_PACK_SWAP_BYTES}, 0},
                {unpack ? GLenum{GL_UNPACK_LSB_FIRST} : GLenum{GL_PACK_LSB_FIRST}, 0}}};
    if (!hostResets) {
        const auto ask = [&](GLenum name, GLint& value) {
            gl_.getIntegerv(name, &value);
            ++queries;
        };
        ask(GL_TEXTURE_BINDING_2D_ARRAY, array_);
        ask(GL_TEXTURE_BINDING_CUBE_MAP, cube_);
        ask(unpack ? GL_PIXEL_UNPACK_BUFFER_BINDING : GL_PIXEL_PACK_BUFFER_BINDING, buffer_);
        for (Saved& store : stores_) {
            ask(store.name, store.value);
        }
    }
    for (const Saved& store : stores_) {
        const bool alignment = store.name == GL_UNPACK_ALIGNMENT || store.name == GL_PACK_ALIGNMENT;
        gl_.pixelStorei(store.name, alignment ? 1 : 0);
    }
    gl_.bindBuffer(bufferTarget_, 0);
}

StateGuard::~StateGuard() {
    for (const Saved& store : stores_) {
        gl_.pixelStorei(store.name, store.value);
    }
    gl_.bindBuffer(bufferTarget_, static_cast<GLuint>(buffer_));
    gl_.bindTexture(GL_TEXTURE_2D_ARRAY, static_cast<GLuint>(array_));
    gl_.bindTexture(GL_TEXTURE_CUBE_MAP, static_cast<GLuint>(cube_));
}

void StateGuard::forget(GLuint texture) {
    array_ = static_cast<GLuint>(array_) == texture ? 0 : array_;
    cube_ = static_cast<GLuint>(cube_) == texture ? 0 : cube_;
}

} // namespace lodestar::plugin
