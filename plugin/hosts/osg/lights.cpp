// SPDX-License-Identifier: MIT
#include "hosts/osg/lights.h"

#include <algorithm>
#include <cstring>

#include <osg/Image>

#include <glm/gtc/packing.hpp>

#include "hosts/shading.h"

#ifndef GL_RGBA32F_ARB
#define GL_RGBA32F_ARB 0x8814
#endif

namespace lodestar::osghost {
namespace {

osg::ref_ptr<osg::Texture2DArray> makeArray(std::uint32_t width, std::uint32_t height,
                                            std::size_t layers) {
    osg::ref_ptr<osg::Texture2DArray> texture = new osg::Texture2DArray;
    texture->setTextureSize(static_cast<int>(width), static_cast<int>(height),
                            static_cast<int>(layers));
    texture->setInternalFormat(GL_RGBA32F_ARB);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setUseHardwareMipMapGeneration(false);
    for (std::size_t i = 0; i < layers; ++i) {
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(static_cast<int>(width), static_cast<int>(height), 1, GL_RGBA,
                             GL_FLOAT);
        image->setInternalTextureFormat(GL_RGBA32F_ARB);
        std::memset(image->data(), 0, image->getTotalSizeInBytes());
        image->setDataVariance(osg::Object::DYNAMIC);
        texture->setImage(static_cast<unsigned>(i), image);
    }
    return texture;
}

void fill(osg::Texture2DArray& texture, std::size_t layer, const std::vector<float>& texels) {
    osg::Image* image = texture.getImage(static_cast<unsigned>(layer));
    std::memcpy(image->data(), texels.data(),
                std::min<std::size_t>(image->getTotalSizeInBytes(), texels.size() * sizeof(float)));
    image->dirty();
}

/// OpenSceneGraph 3.6 knows no shared exponents: floats of the same roots.
std::vector<float> unpacked(const std::vector<unsigned char>& bytes) {
    std::vector<float> texels;
    for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
        std::uint32_t packed = 0;
        std::memcpy(&packed, bytes.data() + i, sizeof packed);
        const glm::vec3 root = glm::unpackF3x9_E1x5(packed);
        texels.insert(texels.end(), {root.r, root.g, root.b, 1.0f});
    }
    return texels;
}

std::vector<float> floatsOf(const std::vector<unsigned char>& bytes) {
    std::vector<float> texels(bytes.size() / sizeof(float));
    std::memcpy(texels.data(), bytes.data(), texels.size() * sizeof(float));
    return texels;
}

} // namespace

Lights::Lights(const LodestarApi& api, LodestarContext* context, osg::StateSet& state,
               int firstUnit)
    : api_(api), context_(context), state_(&state), firstUnit_(firstUnit),
      count_(new osg::Uniform("lodestar_count", 0)),
      axes_(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "lodestar_axes", hosts::kMaxLights)) {
    layout_.struct_size = sizeof layout_;
    api_.map_layout(&layout_);
    state.addUniform(count_);
    state.addUniform(axes_);
    const hosts::MapUniforms map = hosts::mapUniforms(layout_);
    state.addUniform(new osg::Uniform(
        "lodestar_mapSize", osg::Vec4(map.size[0], map.size[1], map.size[2], map.size[3])));
    state.addUniform(new osg::Uniform(
        "lodestar_mapRows", osg::Vec4(map.rows[0], map.rows[1], map.rows[2], map.rows[3])));
    int unit = firstUnit;
    for (const char* name : {"lodestar_maps", "lodestar_lamberts", "lodestar_gradients"}) {
        state.addUniform(new osg::Uniform(name, unit++));
    }
}

LodestarStatus Lights::layOut() {
    std::size_t count = 0;
    LodestarStatus status = api_.lights(context_, nullptr, &count);
    std::vector<LodestarLight> handles(count);
    if (count > 0) {
        status = api_.lights(context_, handles.data(), &count);
    }
    if (status < 0) {
        return status;
    }
    handles.resize(std::min<std::size_t>(count, hosts::kMaxLights));
    const bool same = handles.size() == layers_.size() &&
                      std::equal(handles.begin(), handles.end(), layers_.begin(),
                                 [](LodestarLight a, const Layer& b) { return a == b.light; });
    if (same) {
        return LODESTAR_OK;
    }
    layers_.clear();
    for (const LodestarLight handle : handles) {
        layers_.push_back({handle, 0});
    }
    if (!layers_.empty()) {
        maps_ = makeArray(layout_.columns, layout_.rows, layers_.size());
        lamberts_ = makeArray(layout_.lambert_columns, 1, layers_.size());
        gradients_ = makeArray(layout_.gradient_columns, 1, layers_.size());
        int unit = firstUnit_;
        for (osg::Texture2DArray* texture : {maps_.get(), lamberts_.get(), gradients_.get()}) {
            state_->setTextureAttribute(static_cast<unsigned>(unit++), texture);
        }
    }
    return LODESTAR_OK;
}

LodestarStatus Lights::read(LodestarLight light, int which, std::vector<unsigned char>& bytes) {
    std::size_t size = 0;
    LodestarStatus status = api_.light_texels(context_, light, which, nullptr, &size);
    if (status == LODESTAR_MORE) {
        bytes.resize(size);
        status = api_.light_texels(context_, light, which, bytes.data(), &size);
    }
    return status;
}

LodestarStatus Lights::upload(std::size_t layer, LodestarLight light) {
    std::vector<unsigned char> bytes;
    LodestarStatus status = read(light, LODESTAR_TEXELS_MAP, bytes);
    if (status == LODESTAR_OK) {
        fill(*maps_, layer, unpacked(bytes));
        status = read(light, LODESTAR_TEXELS_LAMBERT, bytes);
    }
    if (status == LODESTAR_OK) {
        fill(*lamberts_, layer, floatsOf(bytes));
        status = read(light, LODESTAR_TEXELS_GRADIENT, bytes);
    }
    if (status == LODESTAR_OK) {
        fill(*gradients_, layer, floatsOf(bytes));
    }
    return status;
}

LodestarStatus Lights::update(double hour) {
    LodestarStatus status = api_.set_hour(context_, hour);
    status = status == LODESTAR_OK ? layOut() : status;
    int shining = 0;
    for (std::size_t i = 0; status == LODESTAR_OK && i < layers_.size(); ++i) {
        LodestarLightState state{};
        state.struct_size = sizeof state;
        status = api_.light_state(context_, layers_[i].light, &state);
        if (status != LODESTAR_OK || !(state.visibility > 0.0)) {
            continue;
        }
        if (layers_[i].version != state.version) {
            status = upload(i, layers_[i].light);
            layers_[i].version = state.version;
        }
        axes_->setElement(static_cast<unsigned>(shining++),
                          osg::Vec4(static_cast<float>(state.axis[0]),
                                    static_cast<float>(state.axis[1]),
                                    static_cast<float>(state.axis[2]), static_cast<float>(i)));
    }
    count_->set(shining);
    return status;
}

} // namespace lodestar::osghost
