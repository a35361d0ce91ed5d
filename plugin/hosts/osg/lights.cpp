// SPDX-License-Identifier: MIT
#include "hosts/osg/lights.h"

#include <algorithm>
#include <cstring>

#include <osg/Image>

#include <glm/gtc/packing.hpp>

#include "hosts/osg/cubes.h"
#include "hosts/shading.h"

#ifndef GL_RGBA32F_ARB
#define GL_RGBA32F_ARB 0x8814
#endif

namespace lodestar::osghost {
namespace {

constexpr unsigned kSeamless = 0x884F; // GL_TEXTURE_CUBE_MAP_SEAMLESS

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
    texture->setDataVariance(osg::Object::DYNAMIC);
    for (std::size_t i = 0; i < layers; ++i) {
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(static_cast<int>(width), static_cast<int>(height), 1, GL_RGBA,
                             GL_FLOAT);
        image->setInternalTextureFormat(GL_RGBA32F_ARB);
        std::memset(image->data(), 0, image->getTotalSizeInBytes());
        image->setDataVariance(osg::Object::DYNAMIC);
        texture->setImage(static_cast<unsigned>(i), image);
    }
    uploadAlone(*texture);
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

} // namespace

Lights::Lights(const LodestarApi& api, LodestarContext* context, osg::StateSet& state,
               int firstUnit)
    : api_(api), context_(context), state_(&state), firstUnit_(firstUnit) {
    // What a draw thread reads is left alone by the next update until it is drawn.
    state.setDataVariance(osg::Object::DYNAMIC);
    int unit = firstUnit;
    for (const LodestarUniform& info : hosts::uniforms(api_)) {
        if (info.type == LODESTAR_UNIFORM_VEC4) {
            values_.push_back({info, new osg::Uniform(osg::Uniform::FLOAT_VEC4, info.name,
                                                      static_cast<int>(info.count))});
            values_.back().uniform->setDataVariance(osg::Object::DYNAMIC);
            state.addUniform(values_.back().uniform);
            continue;
        }
        state.addUniform(new osg::Uniform(info.name, unit));
        if (info.texels == LODESTAR_TEXELS_ENVIRONMENT) {
            cubes_[0] = {info.texels, unit};
        } else if (info.texels == LODESTAR_TEXELS_IRRADIANCE) {
            cubes_[1] = {info.texels, unit};
        }
        ++unit;
    }
    state.setMode(kSeamless, osg::StateAttribute::ON);
}

LodestarStatus Lights::layOut() {
    std::size_t count = 0;
    LodestarStatus status = api_.lights(context_, nullptr, &count);
    std::vector<LodestarLight> handles(count);
    if (count > 0) {
        status = api_.lights(context_, handles.data(), &count);
    }
    LodestarMapLayout layout{};
    layout.struct_size = sizeof layout;
    status = status < 0 ? status : api_.context_map_layout(context_, &layout);
    if (status < 0) {
        return status;
    }
    const bool same = layout.rows == rows_ && handles.size() == layers_.size() &&
                      std::equal(handles.begin(), handles.end(), layers_.begin(),
                                 [](LodestarLight a, const Layer& b) { return a == b.light; });
    if (same) {
        return LODESTAR_OK;
    }
    layers_.clear();
    for (const LodestarLight handle : handles) {
        layers_.push_back({handle, 0});
    }
    rows_ = layout.rows;
    const std::uint32_t sizes[3][2] = {
        {layout.columns, layout.rows}, {layout.lambert_columns, 1}, {layout.gradient_columns, 1}};
    for (int texels = 0; texels < 3 && !layers_.empty(); ++texels) {
        arrays_[texels] = makeArray(sizes[texels][0], sizes[texels][1], layers_.size());
        state_->setTextureAttribute(static_cast<unsigned>(firstUnit_ + texels), arrays_[texels]);
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
    for (int texels = 0; texels < 3; ++texels) {
        const LodestarStatus status = read(light, texels, bytes);
        if (status != LODESTAR_OK) {
            return status;
        }
        fill(*arrays_[texels], layer,
             texels == LODESTAR_TEXELS_MAP       ? unpacked(bytes)
             : texels == LODESTAR_TEXELS_LAMBERT ? floatsOf(bytes)
                                                 : floatsOfHalves(bytes));
    }
    return LODESTAR_OK;
}

LodestarStatus Lights::showLights(LodestarPlan plan) {
    std::size_t count = 0;
    LodestarStatus status = api_.plan_lights(context_, plan, nullptr, &count);
    std::vector<LodestarPlannedLight> shown(count);
    for (LodestarPlannedLight& light : shown) {
        light.struct_size = sizeof light;
    }
    if (count > 0) {
        status = api_.plan_lights(context_, plan, shown.data(), &count);
    }
    for (std::size_t i = 0; status == LODESTAR_OK && i < shown.size(); ++i) {
        Layer& layer = layers_[shown[i].layer];
        if (layer.version != shown[i].version) {
            status = upload(shown[i].layer, shown[i].light);
            layer.version = shown[i].version;
        }
    }
    return status < 0 ? status : LODESTAR_OK;
}

LodestarStatus Lights::showCube(LodestarPlan plan, Cube& cube) {
    LodestarEnvironment of = 0;
    LodestarCube described{};
    described.struct_size = sizeof described;
    LodestarStatus status = api_.plan_environment(context_, plan, cube.texels, &of);
    if (status == LODESTAR_OK && of != 0) {
        status = api_.environment_cube(context_, of, cube.texels, &described);
    }
    if (status != LODESTAR_OK || (of == cube.of && described.version == cube.version)) {
        return status;
    }
    cube.of = of;
    cube.version = described.version;
    if (of == 0) {
        state_->removeTextureAttribute(static_cast<unsigned>(cube.unit),
                                       osg::StateAttribute::TEXTURE);
        return LODESTAR_OK;
    }
    const osg::ref_ptr<osg::TextureCubeMap> texture =
        cubeTexture(described, [&](std::uint32_t level, void* bytes, std::size_t* size) {
            return api_.environment_texels(context_, of, cube.texels, level, bytes, size);
        });
    if (!texture) {
        return LODESTAR_E_ARG;
    }
    state_->setTextureAttribute(static_cast<unsigned>(cube.unit), texture);
    return LODESTAR_OK;
}

LodestarStatus Lights::update(double hour) {
    LodestarFrame frame{};
    frame.struct_size = sizeof frame;
    frame.hour = hour;
    return update(frame);
}

LodestarStatus Lights::update(const LodestarFrame& frame) {
    LodestarPlan plan = 0;
    LodestarStatus status = api_.plan_make(context_, &frame, &plan);
    status = status == LODESTAR_OK ? layOut() : status;
    status = status == LODESTAR_OK ? showLights(plan) : status;
    for (Cube& cube : cubes_) {
        status = status == LODESTAR_OK ? showCube(plan, cube) : status;
    }
    if (status != LODESTAR_OK) {
        return status;
    }
    plan_ = plan;
    const std::vector<unsigned char> data = hosts::uniformData(api_, context_, plan);
    for (Value& value : values_) {
        for (std::uint32_t i = 0; i < value.info.count; ++i) {
            float v[4];
            std::memcpy(v, data.data() + value.info.offset + i * sizeof v, sizeof v);
            value.uniform->setElement(i, osg::Vec4(v[0], v[1], v[2], v[3]));
        }
    }
    return LODESTAR_OK;
}

} // namespace lodestar::osghost
