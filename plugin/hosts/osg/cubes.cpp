// SPDX-License-Identifier: MIT
#include "hosts/osg/cubes.h"

#include <algorithm>
#include <cstring>

#include <osg/GLExtensions>
#include <osg/Image>
#include <osg/State>

#include <glm/gtc/packing.hpp>

#ifndef GL_RGBA32F_ARB
#define GL_RGBA32F_ARB 0x8814
#endif

namespace lodestar::osghost {
namespace {

/// The images stand in the client's memory row by row, nothing between.
void readTightly() {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

/// The six faces with their levels, once: they do not change.
struct CubeUpload : osg::TextureCubeMap::SubloadCallback {
    void load(const osg::TextureCubeMap& texture, osg::State& state) const override {
        readTightly();
        const int levels = static_cast<int>(texture.getImage(0)->getNumMipmapLevels());
        const int width = texture.getImage(0)->s();
        for (unsigned face = 0; face < 6; ++face) {
            const osg::Image& image = *texture.getImage(face);
            for (int level = 0; level < levels; ++level) {
                const int side = std::max(width >> level, 1);
                glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, level, GL_RGBA32F_ARB, side,
                             side, 0, GL_RGBA, GL_FLOAT,
                             image.getMipmapData(static_cast<unsigned>(level)));
            }
            texture.getModifiedCount(face, state.getContextID()) = image.getModifiedCount();
        }
        glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, levels - 1);
        texture.getTextureObject(state.getContextID())
            ->setAllocated(levels, GL_RGBA32F_ARB, width, width, 1, 0);
    }
    void subload(const osg::TextureCubeMap&, osg::State&) const override {}
};

struct ArrayUpload : osg::Texture2DArray::SubloadCallback {
    void load(const osg::Texture2DArray& texture, osg::State& state) const override {
        const int width = texture.getTextureWidth();
        const int height = texture.getTextureHeight();
        const int depth = texture.getTextureDepth();
        state.get<osg::GLExtensions>()->glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA32F_ARB, width,
                                                     height, depth, 0, GL_RGBA, GL_FLOAT, nullptr);
        texture.getTextureObject(state.getContextID())
            ->setAllocated(1, GL_RGBA32F_ARB, width, height, depth, 0);
        subload(texture, state);
    }
    /// The layers that have changed.
    void subload(const osg::Texture2DArray& texture, osg::State& state) const override {
        readTightly();
        for (unsigned layer = 0; layer < texture.getNumImages(); ++layer) {
            const osg::Image& image = *texture.getImage(layer);
            unsigned& shown = texture.getModifiedCount(layer, state.getContextID());
            if (shown != image.getModifiedCount()) {
                shown = image.getModifiedCount();
                state.get<osg::GLExtensions>()->glTexSubImage3D(
                    GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<int>(layer), image.s(), image.t(), 1,
                    GL_RGBA, GL_FLOAT, image.data());
            }
        }
    }
};

void setCubeParameters(osg::TextureCubeMap& texture, bool mipmapped) {
    texture.setInternalFormat(GL_RGBA32F_ARB);
    texture.setFilter(osg::Texture::MIN_FILTER,
                      mipmapped ? osg::Texture::LINEAR_MIPMAP_LINEAR : osg::Texture::LINEAR);
    texture.setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T, osg::Texture::WRAP_R}) {
        texture.setWrap(wrap, osg::Texture::CLAMP_TO_EDGE);
    }
    texture.setResizeNonPowerOfTwoHint(false);
    texture.setUseHardwareMipMapGeneration(false);
}

/// A face with its levels, one behind the other.
osg::ref_ptr<osg::Image> faceImage(const std::vector<std::vector<float>>& levels, std::size_t face,
                                   int width) {
    std::size_t count = 0;
    osg::Image::MipmapDataType offsets; // of the levels behind the first
    for (const std::vector<float>& level : levels) {
        if (count > 0) {
            offsets.push_back(static_cast<unsigned>(count * sizeof(float)));
        }
        count += level.size() / 6;
    }
    auto* data = new unsigned char[count * sizeof(float)];
    std::size_t at = 0;
    for (const std::vector<float>& level : levels) {
        const std::size_t bytes = level.size() / 6 * sizeof(float);
        std::memcpy(data + at, level.data() + face * (level.size() / 6), bytes);
        at += bytes;
    }
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->setImage(width, width, 1, GL_RGBA32F_ARB, GL_RGBA, GL_FLOAT, data,
                    osg::Image::USE_NEW_DELETE);
    image->setMipmapLevels(offsets);
    return image;
}

} // namespace

std::vector<float> floatsOf(const std::vector<unsigned char>& bytes) {
    std::vector<float> texels(bytes.size() / sizeof(float));
    std::memcpy(texels.data(), bytes.data(), texels.size() * sizeof(float));
    return texels;
}

std::vector<float> floatsOfHalves(const std::vector<unsigned char>& bytes) {
    std::vector<float> texels(bytes.size() / sizeof(std::uint16_t));
    for (std::size_t i = 0; i < texels.size(); ++i) {
        std::uint16_t half = 0;
        std::memcpy(&half, bytes.data() + i * sizeof half, sizeof half);
        texels[i] = glm::unpackHalf1x16(half);
    }
    return texels;
}

osg::ref_ptr<osg::TextureCubeMap> cubeTexture(const LodestarCube& described,
                                              const ReadLevel& read) {
    std::vector<std::vector<float>> levels;
    for (std::uint32_t level = 0; level < described.levels; ++level) {
        std::size_t size = 0;
        read(level, nullptr, &size);
        std::vector<unsigned char> bytes(size);
        if (read(level, bytes.data(), &size) != LODESTAR_OK) {
            return nullptr;
        }
        levels.push_back(described.half_floats != 0 ? floatsOfHalves(bytes) : floatsOf(bytes));
    }
    osg::ref_ptr<osg::TextureCubeMap> texture = new osg::TextureCubeMap;
    setCubeParameters(*texture, described.levels > 1);
    for (unsigned face = 0; face < 6; ++face) {
        texture->setImage(face, faceImage(levels, face, static_cast<int>(described.width)));
    }
    texture->setSubloadCallback(new CubeUpload);
    return texture;
}

void uploadAlone(osg::Texture2DArray& texture) {
    texture.setSubloadCallback(new ArrayUpload);
}

} // namespace lodestar::osghost
