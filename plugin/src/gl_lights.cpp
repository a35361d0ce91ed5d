// SPDX-License-Identifier: MIT
#include "gl_lights.h"

#include <array>
#include <optional>

#include "context.h"

namespace lodestar::plugin {
namespace {

struct Kind {
    GLint internal;
    GLenum format, type;
    GLsizei width, height;
};

std::array<Kind, kTexelKinds> kinds() {
    const lighting::RsrmLayout& map = lighting::kRsrm;
    return {{{GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, map.columns, map.rows},
             {GL_RGBA32F, GL_RGBA, GL_FLOAT, lighting::kLambertColumns, 1},
             {GL_RGBA32F, GL_RGBA, GL_FLOAT, lighting::kGradientColumns, 1}}};
}

/// Saves what uploads touch, sets what they need, and puts back what was. For a host that resets
/// its own state nothing is asked: OpenGL's initial values are left.
class UploadGuard {
public:
    UploadGuard(const GlFunctions& gl, bool hostResets) : gl_(gl) {
        if (!hostResets) {
            gl_.getIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &texture_);
            gl_.getIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &buffer_);
            for (Store& store : stores_) {
                gl_.getIntegerv(store.name, &store.value);
            }
        }
        for (const Store& store : stores_) {
            gl_.pixelStorei(store.name, store.name == GL_UNPACK_ALIGNMENT ? 1 : 0);
        }
        gl_.bindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    }
    UploadGuard(const UploadGuard&) = delete;
    UploadGuard& operator=(const UploadGuard&) = delete;
    ~UploadGuard() {
        for (const Store& store : stores_) {
            gl_.pixelStorei(store.name, store.value);
        }
        gl_.bindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(buffer_));
        gl_.bindTexture(GL_TEXTURE_2D_ARRAY, static_cast<GLuint>(texture_));
    }
    /// A texture that is about to be deleted: its name cannot be bound again, so 0 will be, as
    /// OpenGL itself does.
    void forget(GLuint texture) {
        if (static_cast<GLuint>(texture_) == texture) {
            texture_ = 0;
        }
    }

private:
    struct Store {
        GLenum name;
        GLint value; ///< the host's; at first OpenGL's
    };
    const GlFunctions& gl_;
    GLint texture_ = 0, buffer_ = 0;
    std::array<Store, 8> stores_ = {{{GL_UNPACK_ALIGNMENT, 4},
                                     {GL_UNPACK_ROW_LENGTH, 0},
                                     {GL_UNPACK_IMAGE_HEIGHT, 0},
                                     {GL_UNPACK_SKIP_ROWS, 0},
                                     {GL_UNPACK_SKIP_PIXELS, 0},
                                     {GL_UNPACK_SKIP_IMAGES, 0},
                                     {GL_UNPACK_SWAP_BYTES, 0},
                                     {GL_UNPACK_LSB_FIRST, 0}}};
};

std::vector<glm::vec4> withAlpha(const std::vector<glm::vec3>& line) {
    std::vector<glm::vec4> texels;
    texels.reserve(line.size());
    for (const glm::vec3& value : line) {
        texels.emplace_back(value, 1.0f);
    }
    return texels;
}

} // namespace

bool GlFunctions::load(void* (*procedure)(const char* name)) {
    const auto get = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(procedure(name));
        return function != nullptr;
    };
    const bool all = get(getIntegerv, "glGetIntegerv") && get(genTextures, "glGenTextures") &&
                     get(deleteTextures, "glDeleteTextures") && get(bindTexture, "glBindTexture") &&
                     get(texParameteri, "glTexParameteri") && get(pixelStorei, "glPixelStorei") &&
                     get(texImage3D, "glTexImage3D") && get(texSubImage3D, "glTexSubImage3D") &&
                     get(bindBuffer, "glBindBuffer");
    GLint major = 0, minor = 0;
    if (all) {
        getIntegerv(GL_MAJOR_VERSION, &major);
        getIntegerv(GL_MINOR_VERSION, &minor);
    }
    return 10 * major + minor >= 33;
}

void GlLights::allocate(std::size_t layers) {
    destroy();
    if (layers == 0) {
        return;
    }
    gl_.genTextures(kTexelKinds, names_);
    for (std::size_t which = 0; which < kTexelKinds; ++which) {
        const Kind kind = kinds()[which];
        gl_.bindTexture(GL_TEXTURE_2D_ARRAY, names_[which]);
        gl_.texImage3D(GL_TEXTURE_2D_ARRAY, 0, kind.internal, kind.width, kind.height,
                       static_cast<GLsizei>(layers), 0, kind.format, kind.type, nullptr);
        gl_.texParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
        for (const GLenum filter : {GLenum{GL_TEXTURE_MIN_FILTER}, GLenum{GL_TEXTURE_MAG_FILTER}}) {
            gl_.texParameteri(GL_TEXTURE_2D_ARRAY, filter, GL_LINEAR);
        }
        for (const GLenum wrap : {GLenum{GL_TEXTURE_WRAP_S}, GLenum{GL_TEXTURE_WRAP_T}}) {
            gl_.texParameteri(GL_TEXTURE_2D_ARRAY, wrap, GL_CLAMP_TO_EDGE);
        }
    }
}

void GlLights::upload(int which, std::size_t layer, const void* texels) {
    const Kind kind = kinds()[static_cast<std::size_t>(which)];
    gl_.bindTexture(GL_TEXTURE_2D_ARRAY, names_[which]);
    gl_.texSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(layer), kind.width,
                      kind.height, 1, kind.format, kind.type, texels);
}

void GlLights::update(LodestarContext& context) {
    std::vector<Layer> wanted;
    for (const LodestarLight light : context.order) {
        wanted.push_back({light, 0});
    }
    const bool same = wanted.size() == layers_.size() &&
                      std::equal(wanted.begin(), wanted.end(), layers_.begin(),
                                 [](const Layer& a, const Layer& b) { return a.light == b.light; });
    std::optional<UploadGuard> guard; // a frame in which nothing changed makes no GL call
    if (!same) {
        guard.emplace(gl_, hostResets_);
        for (const GLuint name : names_) {
            guard->forget(name);
        }
        allocate(wanted.size());
        layers_ = std::move(wanted);
    }
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        PlacedLight& light = *context.lights.find(layers_[i].light);
        if (!(look(light, context.hour).visibility > 0.0) || layers_[i].version == light.version) {
            continue;
        }
        const lighting::LightMap::Blend& blend = texelsOf(light);
        if (!guard) {
            guard.emplace(gl_, hostResets_);
        }
        upload(LODESTAR_TEXELS_MAP, i, blend.texels.bytes.data());
        upload(LODESTAR_TEXELS_LAMBERT, i, withAlpha(blend.texels.lambert).data());
        upload(LODESTAR_TEXELS_GRADIENT, i, withAlpha(blend.gradient).data());
        layers_[i].version = light.version;
    }
}

void GlLights::destroy() {
    if (names_[0] != 0) {
        gl_.deleteTextures(kTexelKinds, names_);
    }
    std::fill(std::begin(names_), std::end(names_), 0u);
    layers_.clear();
}

LodestarGlTexture GlLights::texture(int which) const {
    const Kind kind = kinds()[static_cast<std::size_t>(which)];
    LodestarGlTexture answer{};
    answer.target = GL_TEXTURE_2D_ARRAY;
    answer.name = names_[which];
    answer.width = static_cast<std::uint32_t>(kind.width);
    answer.height = static_cast<std::uint32_t>(kind.height);
    answer.layers = static_cast<std::uint32_t>(layers_.size());
    answer.internal_format = static_cast<std::uint32_t>(kind.internal);
    return answer;
}

int GlLights::layer(LodestarLight light) const {
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        if (layers_[i].light == light && layers_[i].version != 0) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

} // namespace lodestar::plugin
