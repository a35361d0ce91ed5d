// SPDX-License-Identifier: MIT
#include "hosts/osg/scene_draws.h"

#include <cmath>
#include <cstring>
#include <unordered_set>
#include <utility>

#include <osg/Camera>
#include <osg/NodeVisitor>
#include <osg/Transform>

namespace lodestar::osghost {
namespace {

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

class Collector : public osg::NodeVisitor {
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
        SceneDraw draw{&drawable,           world_,    folded(path_, &drawable),
                       placed(box, world_), material_, layers_ & drawable.getNodeMask()};
        if (const osg::StateSet* own = drawable.getStateSet()) {
            draw.material = materialOf(*own).value_or(material_);
        }
        while (!ids_.insert(draw.id).second) {
            ++draw.id;
        }
        if (isFinite(draw.box)) {
            found.draws.push_back(std::move(draw));
        }
    }

    SceneDraws found;

private:
    void entered(osg::Node& node, const osg::Matrixd& world) {
        if (std::strcmp(node.libraryName(), "lodestar") == 0) {
            return; // another light's
        }
        if (!node.getName().empty()) {
            found.nodes.try_emplace(node.getName(), world);
        }
        const osg::Matrixd outer = world_;
        const std::uint64_t path = path_;
        const Material material = material_;
        const osg::Node::NodeMask layers = layers_;
        if (const osg::StateSet* own = node.getStateSet()) {
            material_ = materialOf(*own).value_or(material_);
        }
        world_ = world;
        path_ = folded(path, &node);
        layers_ &= node.getNodeMask();
        traverse(node);
        world_ = outer;
        path_ = path;
        material_ = material;
        layers_ = layers;
    }

    osg::Matrixd world_;
    Material material_; // white, as Lighting has it
    osg::Node::NodeMask layers_ = ~osg::Node::NodeMask{0};
    std::uint64_t path_ = 14695981039346656037ull;
    std::unordered_set<std::uint64_t> ids_;
};

} // namespace

SceneDraws collectDraws(osg::Group& group, const osg::Matrixd& world) {
    Collector collector(world);
    for (unsigned i = 0; i < group.getNumChildren(); ++i) {
        group.getChild(i)->accept(collector);
    }
    return std::move(collector.found);
}

} // namespace lodestar::osghost
