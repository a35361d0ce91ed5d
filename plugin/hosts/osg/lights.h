// SPDX-License-Identifier: MIT
//
// Lodestar's lighting in OpenSceneGraph, by its own textures and uniforms: nothing of the library
// touches GL. Everything here runs in the update traversal.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <osg/StateSet>
#include <osg/Texture2DArray>
#include <osg/TextureCubeMap>
#include <osg/Uniform>

#include <lodestar/lodestar.h>

namespace lodestar::osghost {

/// The lighting of a context in a StateSet, as hosts::shadingText reads it: texture units from
/// `firstUnit` on, five of them.
class Lights {
public:
    /// @param context that outlives this  @param state what is lit below
    Lights(const LodestarApi& api, LodestarContext* context, osg::StateSet& state, int firstUnit);

    /// Plans an hour: uniforms always, texels where they have changed.
    /// @return the first status that is not LODESTAR_OK; last_error says it in words
    LodestarStatus update(double hour);
    /// The same of a frame that says more.
    LodestarStatus update(const LodestarFrame& frame);
    /// The plan that was made last; 0: none.
    [[nodiscard]] LodestarPlan plan() const { return plan_; }

private:
    /// What a layer of the arrays holds.
    struct Layer {
        LodestarLight light = 0;
        std::uint64_t version = 0;
    };
    /// A cube of the environment's.
    struct Cube {
        int texels = LODESTAR_TEXELS_ENVIRONMENT;
        int unit = 0;
        LodestarEnvironment of = 0;
        std::uint64_t version = 0;
    };
    LodestarStatus layOut();
    LodestarStatus showLights(LodestarPlan plan);
    LodestarStatus upload(std::size_t layer, LodestarLight light);
    LodestarStatus read(LodestarLight light, int which, std::vector<unsigned char>& bytes);
    LodestarStatus showCube(LodestarPlan plan, Cube& cube);

    const LodestarApi& api_;
    LodestarContext* context_;
    osg::ref_ptr<osg::StateSet> state_;
    int firstUnit_;
    LodestarPlan plan_ = 0;
    std::vector<Layer> layers_;
    std::uint32_t rows_ = 0; ///< of the arrays' maps
    osg::ref_ptr<osg::Texture2DArray> arrays_[3];
    Cube cubes_[2];
    struct Value {
        LodestarUniform info;
        osg::ref_ptr<osg::Uniform> uniform;
    };
    std::vector<Value> values_; ///< vec4 each
};

} // namespace lodestar::osghost
