// SPDX-License-Identifier: MIT
#include "hosts/osg/material.h"

#include <osg/Uniform>

namespace lodestar::osghost {
namespace {

constexpr const char* kDiffuse = "material_diffuse";
constexpr const char* kF0 = "material_f0";

bool read(const osg::StateSet& state, const char* name, osg::Vec4& value) {
    const osg::Uniform* uniform = state.getUniform(name);
    return uniform != nullptr && uniform->get(value);
}

} // namespace

Material materialOf(const float packed[8]) {
    return {.diffuse = {packed[0], packed[1], packed[2]},
            .f0 = {packed[4], packed[5], packed[6]},
            .exponent = packed[3]};
}

void setMaterial(osg::StateSet& state, const Material& material) {
    state.getOrCreateUniform(kDiffuse, osg::Uniform::FLOAT_VEC4)
        ->set(osg::Vec4(material.diffuse, material.exponent));
    state.getOrCreateUniform(kF0, osg::Uniform::FLOAT_VEC4)->set(osg::Vec4(material.f0, 1.0f));
}

std::optional<Material> materialOf(const osg::StateSet& state) {
    osg::Vec4 diffuse, f0;
    if (!read(state, kDiffuse, diffuse) || !read(state, kF0, f0)) {
        return {};
    }
    return Material{.diffuse = {diffuse.x(), diffuse.y(), diffuse.z()},
                    .f0 = {f0.x(), f0.y(), f0.z()},
                    .exponent = diffuse.w()};
}

} // namespace lodestar::osghost
