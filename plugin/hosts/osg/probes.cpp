// SPDX-License-Identifier: MIT
#include "hosts/osg/probes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_set>

#include <osg/GLExtensions>
#include <osg/Image>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <osg/Transform>

#include "hosts/osg/cubes.h"
#include "hosts/osg/scene.h"

#ifndef GL_RGBA32F_ARB
#define GL_RGBA32F_ARB 0x8814
#endif

namespace lodestar::osghost {
namespace {

constexpr std::uint32_t kFacesAFrame = 6;
/// Samples of a captured texel, as the built-in renderer takes them.
constexpr unsigned kSamples = 4;
constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();
constexpr unsigned kForced =
    osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

osg::BoundingBoxd placed(const osg::BoundingBox& box, const osg::Matrixd& worldFromLocal) {
    osg::BoundingBoxd result;
    for (unsigned corner = 0; corner < 8; ++corner) {
        result.expandBy(osg::Vec3d(box.corner(corner)) * worldFromLocal);
    }
    return result;
}

/// Folds a pointer into a number that tells paths apart.
std::uint64_t folded(std::uint64_t path, const void* node) {
    path = (path ^ reinterpret_cast<std::uintptr_t>(node)) * 1099511628211ull;
    return path ^ (path >> 29);
}

/// Finite where a box of floats is.
bool isFinite(const osg::BoundingBoxd& box) {
    return box.valid() && std::isfinite(box._min.length2()) && std::isfinite(box._max.length2());
}

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

/// All drawables below a group, and where the nodes are that have names.
class Probes::Collector : public osg::NodeVisitor {
public:
    explicit Collector(const osg::Matrixd& world)
        : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), world_(world) {}

    void apply(osg::Node& node) override { entered(node, world_); }
    void apply(osg::Transform& transform) override {
        osg::Matrixd world = world_;
        transform.computeLocalToWorldMatrix(world, this);
        entered(transform, world);
    }
    void apply(osg::Camera&) override {} // pictures of their own
    void apply(osg::Drawable& drawable) override {
        const osg::BoundingBox& box = drawable.getBoundingBox();
        if (!box.valid()) {
            return;
        }
        Draw draw{&drawable, world_, folded(path_, &drawable), placed(box, world_), material_};
        if (const osg::StateSet* own = drawable.getStateSet()) {
            draw.material = materialOf(*own).value_or(material_);
        }
        while (!ids_.insert(draw.id).second) {
            ++draw.id;
        }
        if (isFinite(draw.box)) {
            draws.push_back(std::move(draw));
        }
    }

    std::vector<Draw> draws;
    std::map<std::string, osg::Matrixd> nodes; ///< the first of each name

private:
    void entered(osg::Node& node, const osg::Matrixd& world) {
        if (std::strcmp(node.libraryName(), "lodestar") == 0) {
            return; // another light's
        }
        if (!node.getName().empty()) {
            nodes.try_emplace(node.getName(), world);
        }
        const osg::Matrixd outer = world_;
        const std::uint64_t path = path_;
        const Material material = material_;
        if (const osg::StateSet* own = node.getStateSet()) {
            material_ = materialOf(*own).value_or(material_);
        }
        world_ = world;
        path_ = folded(path, &node);
        traverse(node);
        world_ = outer;
        path_ = path;
        material_ = material;
    }

    osg::Matrixd world_;
    Material material_; // white, as Lighting has it
    std::uint64_t path_ = 14695981039346656037ull;
    std::unordered_set<std::uint64_t> ids_;
};

/// A face that is drawn: a camera over the group's children.
class Probes::Face : public osg::Camera {
public:
    enum Stage { Waits, Culled, Drawn };

    Face(const Probes& owner, unsigned width)
        : owner_(owner), texture_(new osg::Texture2D), image(new osg::Image) {
        image->allocateImage(static_cast<int>(width), static_cast<int>(width), 1, GL_RGBA,
                             GL_FLOAT);
        image->setInternalTextureFormat(GL_RGBA32F_ARB);
        setRenderOrder(PRE_RENDER);
        setRenderTargetImplementation(FRAME_BUFFER_OBJECT);
        setReferenceFrame(ABSOLUTE_RF);
        setViewport(0, 0, static_cast<int>(width), static_cast<int>(width));
        setClearColor(osg::Vec4(0, 0, 0, 0));
        setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        setComputeNearFarMode(DO_NOT_COMPUTE_NEAR_FAR);
        setCullingActive(false);
        setDataVariance(DYNAMIC);
        texture_->setTextureSize(static_cast<int>(width), static_cast<int>(width));
        texture_->setInternalFormat(GL_RGBA32F_ARB);
        texture_->setSourceFormat(GL_RGBA);
        texture_->setSourceType(GL_FLOAT);
        texture_->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
        texture_->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
        attach(COLOR_BUFFER, texture_.get(), 0, 0, false, kSamples, kSamples);
        setInitialDrawCallback(new Begun);
        setFinalDrawCallback(new Done);
    }
    void take(LodestarPlan of, const LodestarProbeJob& asked, Pairs wanted) {
        plan = of;
        job = asked;
        pairs = std::move(wanted);
        const osg::Matrixd view(job.view); // both lie column after column for column vectors
        setViewMatrix(view);
        setProjectionMatrix(osg::Matrixd(job.projection));
        getOrCreateStateSet()->addUniform(
            new osg::Uniform("osg_ViewMatrixInverse", osg::Matrixf(osg::Matrixd::inverse(view))),
            kForced);
        stage = Waits;
    }
    /// In place of children: those of the group that is lit.
    void traverse(osg::NodeVisitor& visitor) override {
        osgUtil::CullVisitor* const cull = visitor.asCullVisitor();
        if (cull == nullptr) {
            return;
        }
        cull->pushStateSet(owner_.faceState_.get());
        osgUtil::StateGraph* const top = cull->getCurrentStateGraph();
        owner_.lit_.osg::Group::traverse(visitor);
        owner_.dress(*cull, top, pairs, true);
        cull->popStateSet();
    }

    LodestarPlan plan = 0;
    LodestarProbeJob job{};
    Pairs pairs;
    std::atomic<int> stage{Waits};

protected:
    ~Face() override = default;

private:
    /// OpenSceneGraph asks the loader alone whether a driver has NVIDIA's samples of coverage;
    /// GLVND's has a stub for any name.
    struct Begun : osg::Camera::DrawCallback {
        void operator()(osg::RenderInfo& info) const override {
            const unsigned context = info.getContextID();
            if (!osg::isGLExtensionSupported(context, "GL_NV_framebuffer_multisample_coverage")) {
                osg::GLExtensions::Get(context, true)->glRenderbufferStorageMultisampleCoverageNV =
                    nullptr;
            }
        }
    };
    struct Done : osg::Camera::DrawCallback {
        void operator()(osg::RenderInfo& info) const override {
            auto* face = dynamic_cast<Face*>(info.getCurrentCamera());
            if (face == nullptr) {
                return;
            }
            osg::State& state = *info.getState();
            state.setActiveTextureUnit(0);
            state.applyTextureAttribute(0, face->texture_.get());
            face->image->readImageFromCurrentTexture(state.getContextID(), false, GL_FLOAT);
            face->stage = Drawn;
        }
    };
    const Probes& owner_;
    osg::ref_ptr<osg::Texture2D> texture_;

public:
    osg::ref_ptr<osg::Image> image;
};

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

void Probes::takeFaces() {
    std::vector<osg::ref_ptr<Face>> still;
    for (osg::ref_ptr<Face>& face : waiting_) {
        if (face->stage != Face::Drawn) {
            still.push_back(face);
            continue;
        }
        // One that came too late is asked for again.
        probes_.probe_face(context_, face->plan, face->job.probe, face->job.face,
                           reinterpret_cast<const float*>(face->image->data()));
        face->pairs.clear();
        idle_.push_back(face);
    }
    waiting_ = std::move(still);
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
    Collector collector(osg::computeLocalToWorld(path));
    for (unsigned i = 0; i < lit_.getNumChildren(); ++i) {
        lit_.getChild(i)->accept(collector);
    }
    draws_ = std::move(collector.draws);
    drawsOf_.clear();
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        drawsOf_[draws_[i].drawable.get()].push_back(i);
    }
    for (const auto& [probe, name] : nodes_) {
        if (const LodestarStatus status = follow(probe, collector.nodes); status != LODESTAR_OK) {
            return status;
        }
    }
    describe();
    std::vector<LodestarProbeDraw> boxes(draws_.size());
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        boxes[i].struct_size = sizeof boxes[i];
        boxes[i].id = draws_[i].id;
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
    Pairs pairs(draws_.size());
    for (const LodestarDrawProbes& draw : seen) {
        pairs[draw.draw] = pairState(plan, draw);
        if (!pairs[draw.draw]) {
            return LODESTAR_E_ARG;
        }
    }
    // An earlier job of the face was never drawn.
    std::erase_if(waiting_, [&](const osg::ref_ptr<Face>& face) {
        return face->job.probe == job.probe && face->job.face == job.face;
    });
    const auto fits = std::find_if(idle_.begin(), idle_.end(), [&](const osg::ref_ptr<Face>& face) {
        return face->job.width == job.width;
    });
    osg::ref_ptr<Face> face;
    if (fits != idle_.end()) {
        face = *fits;
        idle_.erase(fits);
    } else {
        face = new Face(*this, job.width);
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
        }
    }
    return LODESTAR_OK;
}

void Probes::cullFaces(osgUtil::CullVisitor& cull) {
    for (const osg::ref_ptr<Face>& face : waiting_) {
        int expected = Face::Waits;
        if (face->stage.compare_exchange_strong(expected, Face::Culled)) {
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
                      const Pairs& pairs, bool onlyKnown) const {
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

void Probes::dress(osgUtil::CullVisitor& cull, osgUtil::StateGraph* top, const Pairs& pairs,
                   bool onlyKnown) const {
    osgUtil::RenderStage& stage = *cull.getCurrentRenderStage();
    dressBin(stage, top, stage.getCamera()->getViewMatrix(), pairs, onlyKnown);
}

void Probes::dress(osgUtil::CullVisitor& cull, osgUtil::StateGraph* top) const {
    dress(cull, top, pairs_, false);
}

void Probes::releaseGLObjects(osg::State* state) const {
    for (const auto* faces : {&waiting_, &idle_}) {
        for (const osg::ref_ptr<Face>& face : *faces) {
            face->releaseGLObjects(state);
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
