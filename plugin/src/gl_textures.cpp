// SPDX-License-Identifier: MIT
#include "gl_textures.h"

#include <algorithm>
#include <array>

#include "lighting/rsrm.h"

namespace lodestar::plugin {
namespace {

struct Kind {
    GLint internal;
    GLenum format, type;
    GLsizei width, height;
};

/// Of the arrays.
Kind kindOf(int texels, const lighting::RsrmLayout& map) {
    switch (texels) {
    case LODESTAR_TEXELS_MAP:
        return {GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, map.columns, map.rows};
    case LODESTAR_TEXELS_LAMBERT:
        return {GL_RGBA32F, GL_RGBA, GL_FLOAT, lighting::kLambertColumns, 1};
    default:
        return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, lighting::kGradientColumns, 1};
    }
}

} // namespace

void GlTextures::guard(Guard& guard) {
    if (!guard) {
        guard.emplace(gl_, StateGuard::Way::Unpack, hostResets_, work_.state_queries);
    }
}

void GlTextures::count(std::uint64_t uploads, std::uint64_t bytes, std::uint64_t texels) {
    work_.uploads += uploads;
    work_.upload_bytes += bytes;
    work_.texels_written += texels;
}

/// Arrays of as many layers as there are lights, made anew where those or their maps are others.
void GlTextures::layOut(const Packet& packet, Guard& kept) {
    const std::vector<LodestarLight>& layers = packet.layers;
    const bool same = packet.maps == maps_ && layers.size() == layers_.size() &&
                      std::equal(layers.begin(), layers.end(), layers_.begin(),
                                 [](LodestarLight a, const Layer& b) { return a == b.light; });
    if (same) {
        return;
    }
    guard(kept);
    std::vector<Layer> wanted;
    wanted.reserve(layers.size());
    for (const LodestarLight light : layers) {
        wanted.push_back({light, 0});
    }
    if (arrays_[0] != 0) {
        std::for_each(std::begin(arrays_), std::end(arrays_),
                      [&](GLuint name) { kept->forget(name); });
        gl_.deleteTextures(3, arrays_);
        std::fill(std::begin(arrays_), std::end(arrays_), 0u);
    }
    layers_ = std::move(wanted);
    maps_ = packet.maps;
    if (layers_.empty()) {
        return;
    }
    gl_.genTextures(3, arrays_);
    for (int texels = 0; texels < 3; ++texels) {
        const Kind kind = kindOf(texels, maps_);
        gl_.bindTexture(GL_TEXTURE_2D_ARRAY, arrays_[texels]);
        gl_.texImage3D(GL_TEXTURE_2D_ARRAY, 0, kind.internal, kind.width, kind.height,
                       static_cast<GLsizei>(layers_.size()), 0, kind.format, kind.type, nullptr);
        gl_.texParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
        for (const GLenum filter : {GLenum{GL_TEXTURE_MIN_FILTER}, GLenum{GL_TEXTURE_MAG_FILTER}}) {
            gl_.texParameteri(GL_TEXTURE_2D_ARRAY, filter, GL_LINEAR);
        }
        for (const GLenum wrap : {GLenum{GL_TEXTURE_WRAP_S}, GLenum{GL_TEXTURE_WRAP_T}}) {
            gl_.texParameteri(GL_TEXTURE_2D_ARRAY, wrap, GL_CLAMP_TO_EDGE);
        }
    }
}

void GlTextures::uploadLayer(int texels, std::size_t layer,
                             const std::vector<std::uint8_t>& bytes) {
    const Kind kind = kindOf(texels, maps_);
    gl_.bindTexture(GL_TEXTURE_2D_ARRAY, arrays_[texels]);
    gl_.texSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(layer), kind.width,
                      kind.height, 1, kind.format, kind.type, bytes.data());
    count(1, bytes.size(),
          static_cast<std::uint64_t>(kind.width) * static_cast<std::uint64_t>(kind.height));
}

void GlTextures::uploadCube(const Packet::Cube& from, Cube& to, Guard& kept) {
    if (!from.texels || (to.of == from.of && to.version == from.version)) {
        return;
    }
    guard(kept);
    const lighting::CubeTexels& texels = *from.texels;
    if (to.name == 0) {
        gl_.genTextures(1, &to.name);
    }
    gl_.bindTexture(GL_TEXTURE_CUBE_MAP, to.name);
    const GLenum internal = texels.half ? GL_RGBA16F : GL_RGBA32F;
    for (std::size_t level = 0; level < texels.levels.size(); ++level) {
        const std::vector<std::uint8_t>& bytes = texels.levels[level];
        const GLsizei width = std::max(1, texels.width >> level);
        for (GLenum face = 0; face < 6; ++face) {
            gl_.texImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, static_cast<GLint>(level),
                           static_cast<GLint>(internal), width, width, 0, GL_RGBA,
                           texels.half ? GL_HALF_FLOAT : GL_FLOAT, &bytes[face * bytes.size() / 6]);
        }
    }
    gl_.texParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL,
                      static_cast<GLint>(texels.levels.size()) - 1);
    gl_.texParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl_.texParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    constexpr GLenum kWraps[] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};
    for (const GLenum wrap : kWraps) {
        gl_.texParameteri(GL_TEXTURE_CUBE_MAP, wrap, GL_CLAMP_TO_EDGE);
    }
    count(6 * texels.levels.size(), texels.bytes(), texels.texels());
    to.of = from.of;
    to.version = from.version;
    const auto width = static_cast<std::uint32_t>(texels.width);
    to.described = {
        sizeof(LodestarGlTexture), GL_TEXTURE_CUBE_MAP, to.name, width, width, 6, internal, 0};
}

/// Cubes of probes that have ended go; those that light the frame are brought up to date.
void GlTextures::uploadProbes(const ProbePacket& probes, Guard& kept) {
    std::erase_if(probes_, [&](const ProbeCubes& held) {
        if (std::find(probes.all.begin(), probes.all.end(), held.of) != probes.all.end()) {
            return false;
        }
        guard(kept);
        for (const Cube& cube : held.cubes) {
            kept->forget(cube.name);
            gl_.deleteTextures(1, &cube.name);
        }
        return true;
    });
    for (const ProbePacket::Light& light : probes.lights) {
        if (!light.shines) {
            continue;
        }
        auto held = std::find_if(probes_.begin(), probes_.end(),
                                 [&](const ProbeCubes& one) { return one.of == light.of; });
        if (held == probes_.end()) {
            held = probes_.insert(held, ProbeCubes{light.of, {}});
        }
        for (std::size_t k = 0; k < 2; ++k) {
            uploadCube({light.of, light.version, light.texels[k]}, held->cubes[k], kept);
        }
    }
}

void GlTextures::execute(const Packet& packet) {
    Guard kept; // a frame in which nothing changed makes no GL call
    layOut(packet, kept);
    for (const Packet::Light& light : packet.lights) {
        Layer& layer = layers_[light.shown.layer];
        if (layer.version == light.shown.version) {
            continue;
        }
        guard(kept);
        const lighting::LightMap::Blend& blend = *light.blend;
        uploadLayer(LODESTAR_TEXELS_MAP, light.shown.layer, blend.texels.bytes);
        uploadLayer(LODESTAR_TEXELS_LAMBERT, light.shown.layer,
                    lighting::LightMap::lambertTexels(blend));
        uploadLayer(LODESTAR_TEXELS_GRADIENT, light.shown.layer,
                    lighting::LightMap::gradientTexels(blend));
        layer.version = light.shown.version;
    }
    uploadCube(packet.environment, environment_, kept);
    uploadCube(packet.irradiance, irradiance_, kept);
    uploadProbes(packet.probes, kept);
}

void GlTextures::destroy() {
    const GLuint names[] = {arrays_[0], arrays_[1], arrays_[2], environment_.name,
                            irradiance_.name};
    gl_.deleteTextures(5, names); // those that are 0 are passed over
    for (const ProbeCubes& held : probes_) {
        for (const Cube& cube : held.cubes) {
            gl_.deleteTextures(1, &cube.name);
        }
    }
    probes_.clear();
    std::fill(std::begin(arrays_), std::end(arrays_), 0u);
    layers_.clear();
    environment_ = {};
    irradiance_ = {};
}

LodestarGlTexture GlTextures::texture(int texels) const {
    if (texels == LODESTAR_TEXELS_ENVIRONMENT || texels == LODESTAR_TEXELS_IRRADIANCE) {
        const Cube& cube = texels == LODESTAR_TEXELS_ENVIRONMENT ? environment_ : irradiance_;
        LodestarGlTexture answer = cube.described;
        answer.target = GL_TEXTURE_CUBE_MAP;
        return answer;
    }
    const Kind kind = kindOf(texels, maps_);
    return {sizeof(LodestarGlTexture),
            GL_TEXTURE_2D_ARRAY,
            arrays_[texels],
            static_cast<std::uint32_t>(kind.width),
            static_cast<std::uint32_t>(kind.height),
            static_cast<std::uint32_t>(layers_.size()),
            static_cast<std::uint32_t>(kind.internal),
            0};
}

LodestarGlTexture GlTextures::probeTexture(LodestarProbe probe, int texels) const {
    const auto held = std::find_if(probes_.begin(), probes_.end(),
                                   [&](const ProbeCubes& one) { return one.of == probe; });
    LodestarGlTexture answer{};
    if (held != probes_.end()) {
        answer = held->cubes[texels == LODESTAR_TEXELS_IRRADIANCE ? 1 : 0].described;
    }
    answer.target = GL_TEXTURE_CUBE_MAP;
    return answer;
}

int GlTextures::cubeWidth(GLuint name) {
    if (name == 0 || gl_.isTexture(name) == GL_FALSE) {
        return 0;
    }
    const StateGuard kept(gl_, StateGuard::Way::Pack, hostResets_, work_.state_queries);
    gl_.bindTexture(GL_TEXTURE_CUBE_MAP, name);
    GLint bound = 0, width = 0;
    gl_.getIntegerv(GL_TEXTURE_BINDING_CUBE_MAP, &bound);
    for (GLenum face = 0; static_cast<GLuint>(bound) == name && face < 6; ++face) {
        GLint one = 0;
        gl_.getTexLevelParameteriv(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_TEXTURE_WIDTH,
                                   &one);
        if (face > 0 && one != width) {
            return 0;
        }
        width = one;
    }
    return width;
}

void GlTextures::readCube(GLuint name, int width, float* rgba) {
    const StateGuard kept(gl_, StateGuard::Way::Pack, hostResets_, work_.state_queries);
    gl_.bindTexture(GL_TEXTURE_CUBE_MAP, name);
    const std::size_t face = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(width);
    for (std::size_t i = 0; i < 6; ++i) {
        gl_.getTexImage(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(i), 0, GL_RGBA,
                        GL_FLOAT, rgba + i * face);
    }
}

} // namespace lodestar::plugin
