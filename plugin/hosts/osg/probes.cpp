// SPDX-License-Identifier: MIT
#include "hosts/osg/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <osg/NodeVisitor>

#include "hosts/osg/cubes.h"
#include "hosts/osg/scene.h"

namespace lodestar::osghost {
namespace {

constexpr std::uint32_t kFacesAFrame = 6;
/// Updates after which a face's pixels are not awaited any more (lodestar_probes.h, probe_face).
constexpr int kPatience = 4;
constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();
constexpr unsigned kForced =
    osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

const LodestarProbesApi& extensionOf(const LodestarApi& api) {
    return *static_cast<const LodestarProbesApi*>(api.get_extension(LODESTAR_EXTENSION_PROBES));
}

/// A uniform array of a draw's probes and the factors, as a StateSet's own.
void setVectors(osg::StateSet& state, const float* vectors) {
    constexpr unsigned kCount = LODESTAR_PROBE_UNIFORMS - 1;
    osg::ref_ptr<osg::Uniform> probes =
        new osg::Uniform(osg::Uniform::FLOAT_VEC4, "lodestar_probes", static_cast<int>(kCount));
    for (unsigned i = 0; i < kCount; ++i) {
        probes->setElement(i, osg::Vec4(vectors[4 * i], vectors[4 * i + 1], vectors[4 * i + 2],
                                        vectors[4 * i + 3]));
    }
    const float* factors = vectors + 4 * kCount;
    state.addUniform(probes);
    state.addUniform(new osg::Uniform("lodestar_probeFactors",
                                      osg::Vec4(factors[0], factors[1], factors[2], 0.0f)));
}

} // namespace

Probes::Probes(const LodestarApi& api, LodestarContext* context, osg::StateSet& state,
               int firstUnit, osg::Group& lit)
    : api_(api), probes_(extensionOf(api)), context_(context), state_(&state),
      firstUnit_(firstUnit), lit_(lit) {
    faceState_ = new osg::StateSet(state, osg::CopyOp::SHALLOW_COPY); // its uniforms and textures
    faceState_->setAttributeAndModes(faceProgramOf(api), kForced);
    faceState_->setDataVariance(osg::Object::DYNAMIC);
    const float none[4 * LODESTAR_PROBE_UNIFORMS] = {};
    std::vector<float> open(none, none + 4 * LODESTAR_PROBE_UNIFORMS);
    open[4 * (LODESTAR_PROBE_UNIFORMS - 1) + 2] = 1.0f;
    constexpr const char* kSamplers[] = {"lodestar_probeTexels0", "lodestar_probeIrradiance0",
                                         "lodestar_probeTexels1", "lodestar_probeIrradiance1"};
    for (osg::StateSet* each : {state_.get(), faceState_.get()}) {
        setVectors(*each, open.data());
        for (int i = 0; i < 4; ++i) {
            each->addUniform(new osg::Uniform(kSamplers[i], firstUnit + i));
        }
    }
    std::size_t count = 0;
    probes_.probes(context, nullptr, &count);
    std::vector<LodestarProbe> all(count);
    probes_.probes(context, all.data(), &count);
    for (const LodestarProbe probe : all) {
        std::size_t size = 0;
        if (probes_.probe_node(context, probe, nullptr, &size) == LODESTAR_MORE) {
            std::string name(size, '\0');
            probes_.probe_node(context, probe, name.data(), &size);
            name.resize(size - 1);
            nodes_.emplace(probe, std::move(name));
        }
    }
}

Probes::~Probes() = default;

bool Probes::wanted(const LodestarApi& api, LodestarContext* context) {
    std::size_t count = 0;
    extensionOf(api).probes(context, nullptr, &count);
    return count > 0;
}

LodestarFrame Probes::frame(double hour) const {
    LodestarFrame frame{};
    frame.struct_size = sizeof frame;
    frame.hour = hour;
    frame.draws = described_.data();
    frame.draw_count = static_cast<std::uint32_t>(described_.size());
    frame.draw_stride = sizeof(LodestarDraw);
    frame.max_faces = kFacesAFrame - static_cast<std::uint32_t>(
                                         std::min<std::size_t>(waiting_.size(), kFacesAFrame));
    return frame;
}

/// Draws as the library is told of them.
void Probes::describe() {
    materials_.assign(draws_.size(), {});
    described_.assign(draws_.size(), {});
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        const Material& from = draws_[i].material;
        LodestarMaterial& material = materials_[i];
        material.struct_size = sizeof material;
        material.given =
            LODESTAR_MATERIAL_DIFFUSE | LODESTAR_MATERIAL_F0 | LODESTAR_MATERIAL_EXPONENT;
        for (int c = 0; c < 3; ++c) {
            material.diffuse[c] = std::clamp(static_cast<double>(from.diffuse[c]), 0.0, 1.0);
            material.f0[c] = std::clamp(static_cast<double>(from.f0[c]), 0.0, 1.0);
        }
        material.exponent = std::max(static_cast<double>(from.exponent), 0.0);
        LodestarDraw& draw = described_[i];
        draw.struct_size = sizeof draw;
        draw.visible = 1;
        const std::string& name = draws_[i].drawable->getName();
        draw.name = name.empty() ? nullptr : name.c_str();
        draw.material = &material;
    }
}

/// A draw thread may hold one that has been culled: it is drawn yet, or never, as where the
/// threading model changes. Until then it is not taken again.
void Probes::leave(osg::ref_ptr<ProbeFace> face) {
    (face->beginCull() ? idle_ : late_).push_back(std::move(face));
}

void Probes::takeFaces() {
    std::vector<osg::ref_ptr<ProbeFace>> still;
    for (osg::ref_ptr<ProbeFace>& face : waiting_) {
        if (face->isDrawn()) {
            probes_.probe_face(context_, face->plan(), face->job().probe, face->job().face,
                               face->pixels());
            face->forgetStates();
            idle_.push_back(face);
        } else if (face->countUpdate() < kPatience) {
            still.push_back(face);
        } else {
            leave(face);
        }
    }
    waiting_ = std::move(still);
    std::erase_if(late_, [this](const osg::ref_ptr<ProbeFace>& face) {
        const bool drawn = face->isDrawn();
        if (drawn) {
            face->forgetStates();
            idle_.push_back(face);
        }
        return drawn;
    });
}

LodestarStatus Probes::follow(LodestarProbe probe,
                              const std::map<std::string, osg::Matrixd>& nodes) {
    const auto found = nodes.find(nodes_.at(probe));
    const osg::Matrixd flat(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1); // it is nowhere
    return probes_.probe_move(context_, probe,
                              found != nodes.end() ? found->second.ptr() : flat.ptr());
}

LodestarStatus Probes::prepare(const osg::NodePath& path) {
    takeFaces();
    SceneDraws found = collectDraws(lit_, osg::computeLocalToWorld(path));
    draws_ = std::move(found.draws);
    drawsOf_.clear();
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        drawsOf_[draws_[i].drawable.get()].push_back(i);
    }
    for (const auto& [probe, name] : nodes_) {
        if (const LodestarStatus status = follow(probe, found.nodes); status != LODESTAR_OK) {
            return status;
        }
    }
    describe();
    std::vector<LodestarProbeDraw> boxes(draws_.size());
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        boxes[i].struct_size = sizeof boxes[i];
        boxes[i].id = draws_[i].id;
        boxes[i].layers = draws_[i].layers;
        boxes[i].hidden = draws_[i].layers == 0 ? 1 : 0;
        for (int axis = 0; axis < 3; ++axis) {
            boxes[i].low[axis] = draws_[i].box._min[axis];
            boxes[i].high[axis] = draws_[i].box._max[axis];
        }
    }
    LodestarProbeFrame frame{};
    frame.struct_size = sizeof frame;
    frame.draw_count = static_cast<std::uint32_t>(boxes.size());
    frame.draw_stride = sizeof(LodestarProbeDraw);
    frame.draws = boxes.data();
    return probes_.frame_boxes(context_, &frame);
}

/// A probe's textures, made anew where its light is another.
LodestarStatus Probes::refresh(LodestarPlan plan, LodestarProbe probe) {
    LodestarCube described{};
    described.struct_size = sizeof described;
    LodestarStatus status =
        probes_.plan_probe_cube(context_, plan, probe, LODESTAR_TEXELS_ENVIRONMENT, &described);
    Light& light = lights_[probe];
    if (status != LODESTAR_OK || described.version == light.version) {
        return status;
    }
    light.version = described.version;
    for (const int texels : {LODESTAR_TEXELS_ENVIRONMENT, LODESTAR_TEXELS_IRRADIANCE}) {
        status = probes_.plan_probe_cube(context_, plan, probe, texels, &described);
        osg::ref_ptr<osg::TextureCubeMap> made =
            cubeTexture(described, [&](std::uint32_t level, void* bytes, std::size_t* size) {
                return probes_.plan_probe_texels(context_, plan, probe, texels, level, bytes, size);
            });
        if (status != LODESTAR_OK || !made) {
            return status != LODESTAR_OK ? status : LODESTAR_E_ARG;
        }
        (texels == LODESTAR_TEXELS_ENVIRONMENT ? light.texels : light.irradiance) = made;
    }
    return LODESTAR_OK;
}

/// What a draw with a pair is drawn by; null where the library refuses. Never changed once it is
/// made: a draw thread may read it.
osg::ref_ptr<osg::StateSet> Probes::pairState(LodestarPlan plan, const LodestarDrawProbes& pair) {
    float vectors[4 * LODESTAR_PROBE_UNIFORMS] = {};
    if (probes_.plan_probe_uniforms(context_, plan, &pair, vectors) != LODESTAR_OK) {
        return nullptr;
    }
    std::string holds(reinterpret_cast<const char*>(vectors), sizeof vectors);
    osg::TextureCubeMap* textures[4] = {};
    for (int k = 0; k < 2; ++k) {
        if (pair.probe[k] == 0 || pair.dark[k] != 0) {
            continue;
        }
        if (refresh(plan, pair.probe[k]) != LODESTAR_OK) {
            return nullptr;
        }
        const Light& light = lights_[pair.probe[k]];
        textures[2 * k] = light.texels;
        textures[2 * k + 1] = light.irradiance;
    }
    holds.append(reinterpret_cast<const char*>(textures), sizeof textures);
    osg::ref_ptr<osg::StateSet>& state = states_[holds];
    if (!state && before_.contains(holds)) {
        state = before_.at(holds);
    }
    if (!state) {
        state = new osg::StateSet;
        setVectors(*state, vectors);
        for (int i = 0; i < 4; ++i) {
            if (textures[i] != nullptr) {
                state->setTextureAttribute(static_cast<unsigned>(firstUnit_ + i), textures[i]);
            }
        }
    }
    return state;
}

LodestarStatus Probes::showJob(LodestarPlan plan, std::uint32_t index,
                               const LodestarProbeJob& job) {
    std::vector<LodestarDrawProbes> seen(job.draw_count);
    std::size_t count = seen.size();
    if (count > 0) {
        seen[0].struct_size = sizeof seen[0];
        const LodestarStatus status =
            probes_.plan_job_draws(context_, plan, index, seen.data(), &count);
        if (status != LODESTAR_OK) {
            return status;
        }
    }
    DrawStates pairs(draws_.size());
    for (const LodestarDrawProbes& draw : seen) {
        pairs[draw.draw] = pairState(plan, draw);
        if (!pairs[draw.draw]) {
            return LODESTAR_E_ARG;
        }
    }
    // An earlier job of the face: its pixels would be passed over.
    std::erase_if(waiting_, [&](const osg::ref_ptr<ProbeFace>& face) {
        const bool same = face->job().probe == job.probe && face->job().face == job.face;
        if (same) {
            leave(face);
        }
        return same;
    });
    const auto fits =
        std::find_if(idle_.begin(), idle_.end(), [&](const osg::ref_ptr<ProbeFace>& face) {
            return face->job().width == job.width;
        });
    osg::ref_ptr<ProbeFace> face;
    if (fits != idle_.end()) {
        face = *fits;
        idle_.erase(fits);
    } else {
        face =
            new ProbeFace(job.width, [this](osgUtil::CullVisitor& cull, const DrawStates& states) {
                cull.pushStateSet(faceState_.get());
                osgUtil::StateGraph* const top = cull.getCurrentStateGraph();
                lit_.osg::Group::traverse(cull);
                dress(cull, top, states, true);
                cull.popStateSet();
            });
    }
    face->take(plan, job, std::move(pairs));
    waiting_.push_back(std::move(face));
    return LODESTAR_OK;
}

LodestarStatus Probes::show(LodestarPlan plan) {
    std::vector<LodestarDrawProbes> drawn(draws_.size());
    std::size_t count = drawn.size();
    if (count > 0) {
        drawn[0].struct_size = sizeof drawn[0];
        const LodestarStatus status =
            probes_.plan_draw_probes(context_, plan, drawn.data(), &count);
        if (status != LODESTAR_OK) {
            return status;
        }
    }
    before_ = std::move(states_);
    states_.clear();
    pairs_.assign(draws_.size(), nullptr);
    for (const LodestarDrawProbes& draw : drawn) {
        pairs_[draw.draw] = pairState(plan, draw);
    }
    count = 0;
    probes_.plan_probe_jobs(context_, plan, nullptr, &count);
    std::vector<LodestarProbeJob> jobs(count);
    if (count > 0) {
        jobs[0].struct_size = sizeof jobs[0];
        probes_.plan_probe_jobs(context_, plan, jobs.data(), &count);
    }
    for (std::uint32_t i = 0; i < jobs.size(); ++i) {
        if (const LodestarStatus status = showJob(plan, i, jobs[i]); status != LODESTAR_OK) {
            return status;
        }
    }
    // What lights is the picture's: Lights has set it there.
    for (unsigned unit = 0; unit < static_cast<unsigned>(firstUnit_); ++unit) {
        osg::StateAttribute* texture =
            state_->getTextureAttribute(unit, osg::StateAttribute::TEXTURE);
        if (texture != nullptr) {
            faceState_->setTextureAttribute(unit, texture);
        } else {
            faceState_->removeTextureAttribute(unit, osg::StateAttribute::TEXTURE);
        }
    }
    return LODESTAR_OK;
}

void Probes::cullFaces(osgUtil::CullVisitor& cull) {
    for (const osg::ref_ptr<ProbeFace>& face : waiting_) {
        if (face->beginCull()) {
            face->accept(cull);
        }
    }
}

std::size_t Probes::drawOf(const osgUtil::RenderLeaf& leaf, const osg::Matrixd& view) const {
    const auto found = drawsOf_.find(leaf.getDrawable());
    if (found == drawsOf_.end()) {
        return kUnknown;
    }
    std::size_t best = found->second.front();
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t draw : found->second) {
        if (found->second.size() == 1 || !leaf._modelview) {
            break;
        }
        const osg::Matrixd seen = draws_[draw].worldFromLocal * view;
        double apart = 0.0;
        for (int i = 0; i < 16; ++i) {
            apart += std::abs(seen.ptr()[i] - osg::Matrixd(*leaf._modelview).ptr()[i]);
        }
        if (apart < least) {
            least = apart;
            best = draw;
        }
    }
    return best;
}

void Probes::dressBin(osgUtil::RenderBin& bin, osgUtil::StateGraph* top, const osg::Matrixd& view,
                      const DrawStates& pairs, bool onlyKnown) const {
    for (const auto& [number, inner] : bin.getRenderBinList()) {
        dressBin(*inner, top, view, pairs, onlyKnown);
    }
    const osgUtil::RenderBin::StateGraphList graphs = bin.getStateGraphList();
    for (osgUtil::StateGraph* graph : graphs) {
        const osgUtil::StateGraph* up = graph;
        while (up != nullptr && up != top) {
            up = up->_parent;
        }
        if (up == nullptr) {
            continue;
        }
        osgUtil::StateGraph::LeafList kept, leaves;
        leaves.swap(graph->_leaves);
        for (const osg::ref_ptr<osgUtil::RenderLeaf>& leaf : leaves) {
            const std::size_t draw = drawOf(*leaf, view);
            const bool known = draw < pairs.size() && pairs[draw];
            if (!known) {
                if (!onlyKnown) {
                    kept.push_back(leaf);
                }
                continue;
            }
            osgUtil::StateGraph* const own = graph->find_or_insert(pairs[draw].get());
            if (own->leaves_empty()) {
                bin.addStateGraph(own);
            }
            own->addLeaf(leaf.get());
        }
        graph->_leaves.swap(kept);
    }
    // A graph without leaves is pruned: it must not be listed.
    std::erase_if(bin.getStateGraphList(),
                  [](const osgUtil::StateGraph* graph) { return graph->leaves_empty(); });
}

void Probes::dress(osgUtil::CullVisitor& cull, osgUtil::StateGraph* top, const DrawStates& pairs,
                   bool onlyKnown) const {
    osgUtil::RenderStage& stage = *cull.getCurrentRenderStage();
    dressBin(stage, top, stage.getCamera()->getViewMatrix(), pairs, onlyKnown);
}

void Probes::dress(osgUtil::CullVisitor& cull, osgUtil::StateGraph* top) const {
    dress(cull, top, pairs_, false);
}

void Probes::retire(std::vector<osg::ref_ptr<ProbeFace>>& into) {
    for (auto* faces : {&waiting_, &late_, &idle_}) {
        for (osg::ref_ptr<ProbeFace>& face : *faces) {
            face->forgetStates();
            into.push_back(std::move(face));
        }
        faces->clear();
    }
}

void Probes::releaseGLObjects(osg::State* state) const {
    for (const auto* faces : {&waiting_, &late_, &idle_}) {
        for (const osg::ref_ptr<ProbeFace>& face : *faces) {
            face->releaseGLObjects(state);
            // OpenSceneGraph's cache of render stages locks itself, then the cull visitors that it
            // watches; one that ends locks these the other way round. Without the cache none does.
            face->setRenderingCache(nullptr);
        }
    }
    faceState_->releaseGLObjects(state);
    for (const auto& [probe, light] : lights_) {
        for (const osg::TextureCubeMap* texture : {light.texels.get(), light.irradiance.get()}) {
            if (texture != nullptr) {
                texture->releaseGLObjects(state);
            }
        }
    }
}

} // namespace lodestar::osghost
