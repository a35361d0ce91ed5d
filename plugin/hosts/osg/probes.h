// SPDX-License-Identifier: MIT
//
// A document's light probes in OpenSceneGraph: faces drawn by cameras before the picture, the pair
// of each drawable set where it is drawn. Nothing of the scene is changed.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include <osg/Drawable>
#include <osg/Group>
#include <osg/Matrixd>
#include <osg/StateSet>
#include <osg/TextureCubeMap>
#include <osgUtil/CullVisitor>

#include <lodestar/lodestar_probes.h>

#include "hosts/osg/probe_face.h"
#include "hosts/osg/scene_draws.h"

namespace lodestar::osghost {

/// The probes of a context over what stands below a group.
class Probes {
public:
    /// @param context with a document's probes, that outlives this  @param firstUnit of four
    /// texture units  @param lit whose children are captured and lit, that outlives this
    Probes(const LodestarApi& api, LodestarContext* context, osg::StateSet& state, int firstUnit,
           osg::Group& lit);
    ~Probes();
    Probes(const Probes&) = delete;
    Probes& operator=(const Probes&) = delete;

    /// Whether a context has any.
    [[nodiscard]] static bool wanted(const LodestarApi& api, LodestarContext* context);

    /// Before a plan is made: hands over the faces that have been drawn, says where things are.
    /// @param path of nodes down to the group  @return the first status that is not LODESTAR_OK
    LodestarStatus prepare(const osg::NodePath& path);
    /// The frame to plan: the draws, with their materials, and how many faces may be asked for.
    /// What it points to lasts until it is prepared again.
    [[nodiscard]] LodestarFrame frame(double hour) const;
    /// After it is made: cameras for the faces, light for the drawables.
    LodestarStatus show(LodestarPlan plan);

    /// In a cull traversal, before the children's: those cameras that wait.
    void cullFaces(osgUtil::CullVisitor& cull);
    /// After it: what has been added below a state is drawn with its drawables' pairs.
    void dress(osgUtil::CullVisitor& cull, osgUtil::StateGraph* top) const;

    void releaseGLObjects(osg::State* state) const;
    /// Hands over its faces, which threads that draw may hold yet. None is culled any more.
    void retire(std::vector<osg::ref_ptr<ProbeFace>>& into);

private:
    /// By what they hold. Draws that hold the same share one.
    using States = std::map<std::string, osg::ref_ptr<osg::StateSet>>;
    /// A probe's textures at a version of its light.
    struct Light {
        std::uint64_t version = 0;
        osg::ref_ptr<osg::TextureCubeMap> texels, irradiance;
    };

    void leave(osg::ref_ptr<ProbeFace> face);
    void takeFaces();
    void describe();
    LodestarStatus follow(LodestarProbe probe, const std::map<std::string, osg::Matrixd>& nodes);
    LodestarStatus refresh(LodestarPlan plan, LodestarProbe probe);
    [[nodiscard]] osg::ref_ptr<osg::StateSet> pairState(LodestarPlan plan,
                                                        const LodestarDrawProbes& pair);
    LodestarStatus showJob(LodestarPlan plan, std::uint32_t index, const LodestarProbeJob& job);
    /// @param onlyKnown what has no pair is not drawn
    void dress(osgUtil::CullVisitor& cull, osgUtil::StateGraph* top, const DrawStates& pairs,
               bool onlyKnown) const;
    void dressBin(osgUtil::RenderBin& bin, osgUtil::StateGraph* top, const osg::Matrixd& view,
                  const DrawStates& pairs, bool onlyKnown) const;
    [[nodiscard]] std::size_t drawOf(const osgUtil::RenderLeaf& leaf,
                                     const osg::Matrixd& view) const;

    const LodestarApi& api_;
    const LodestarProbesApi& probes_;
    LodestarContext* context_;
    osg::ref_ptr<osg::StateSet> state_; ///< of the picture
    osg::ref_ptr<osg::StateSet> faceState_;
    int firstUnit_;
    osg::Group& lit_;
    std::vector<SceneDraw> draws_;
    std::vector<LodestarMaterial> materials_; ///< by draw
    std::vector<LodestarDraw> described_;     ///< the same, pointing to those
    std::unordered_map<const osg::Drawable*, std::vector<std::size_t>> drawsOf_;
    DrawStates pairs_;
    std::map<LodestarProbe, std::string> nodes_; ///< that probes follow
    std::map<LodestarProbe, Light> lights_;
    States states_, before_; ///< of the last plan, of the one before
    /// Awaited; culled, and not awaited any more; free.
    std::vector<osg::ref_ptr<ProbeFace>> waiting_, late_, idle_;
};

} // namespace lodestar::osghost
