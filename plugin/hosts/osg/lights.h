// SPDX-License-Identifier: MIT
//
// Lodestar's lights in OpenSceneGraph, by its own textures and uniforms: nothing of the library
// touches GL. Everything here runs in the update traversal.
#pragma once

#include <string>
#include <vector>

#include <osg/StateSet>
#include <osg/Texture2DArray>
#include <osg/Uniform>

#include <lodestar/lodestar.h>

namespace lodestar::osghost {

/// The lights of a context in a StateSet, as hosts::shadingText reads them: texture units from
/// `firstUnit` on, three of them.
class Lights {
public:
    /// @param context that outlives this  @param state what is lit below
    Lights(const LodestarApi& api, LodestarContext* context, osg::StateSet& state, int firstUnit);

    /// Moves to an hour: axes as uniforms, texels where they have changed.
    /// @return the first status that is not LODESTAR_OK; last_error says it in words
    LodestarStatus update(double hour);

private:
    /// What a layer of the textures holds.
    struct Layer {
        LodestarLight light = 0;
        std::uint64_t version = 0;
    };
    LodestarStatus layOut();
    LodestarStatus upload(std::size_t layer, LodestarLight light);
    LodestarStatus read(LodestarLight light, int which, std::vector<unsigned char>& bytes);

    const LodestarApi& api_;
    LodestarContext* context_;
    osg::ref_ptr<osg::StateSet> state_;
    int firstUnit_;
    LodestarMapLayout layout_{};
    std::vector<Layer> layers_;
    osg::ref_ptr<osg::Texture2DArray> maps_, lamberts_, gradients_;
    osg::ref_ptr<osg::Uniform> count_, axes_;
};

} // namespace lodestar::osghost
