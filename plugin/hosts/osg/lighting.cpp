// SPDX-License-Identifier: MIT
#include "hosts/osg/lighting.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include <osg/FrameStamp>
#include <osg/Notify>
#include <osgDB/FileUtils>
#include <osgDB/Options>
#include <osgUtil/CullVisitor>

#include "hosts/osg/lights.h"
#include "hosts/osg/material.h"
#include "hosts/osg/probes.h"
#include "hosts/osg/scene.h"
#include "hosts/osg/thread_contexts.h"

namespace lodestar::osghost {
namespace {

/// The first of four texture units behind those of Lights.
constexpr int kProbeUnit = 5;

double wrapped(double hour) {
    const double rest = std::fmod(hour, 24.0);
    const double positive = rest < 0.0 ? rest + 24.0 : rest;
    return positive < 24.0 ? positive : 0.0; // -1e-300 + 24 is 24
}

std::string found(const std::string& file, const std::string& folder) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    if (!folder.empty()) {
        options->getDatabasePathList().push_front(folder);
    }
    const std::string path = osgDB::findDataFile(file, options.get());
    return path.empty() ? file : path; // the reader says what is wrong with it
}

} // namespace

Lighting::Lighting() {
    setNumChildrenRequiringUpdateTraversal(getNumChildrenRequiringUpdateTraversal() + 1);
}

Lighting::Lighting(const Lighting& other, const osg::CopyOp& copy)
    : osg::Group(other, copy), document_(other.document_), file_(other.file_),
      folder_(other.folder_), up_(other.up_), north_(other.north_), hour_(other.hour_),
      hoursPerSecond_(other.hoursPerSecond_) {
    setNumChildrenRequiringUpdateTraversal(getNumChildrenRequiringUpdateTraversal() + 1);
}

Lighting::~Lighting() {
    close();
}

void Lighting::setDocument(const std::string& text) {
    if (text != document_) {
        document_ = text;
        close();
    }
}

void Lighting::setFile(const std::string& name) {
    if (name != file_) {
        file_ = name;
        close();
    }
}

void Lighting::setFolder(const std::string& folder) {
    if (folder != folder_) {
        folder_ = folder;
        close();
    }
}

void Lighting::setUp(const osg::Vec3d& up) {
    if (up != up_) {
        up_ = up;
        close();
    }
}

void Lighting::setNorth(const osg::Vec3d& north) {
    if (north != north_) {
        north_ = north;
        close();
    }
}

void Lighting::setHour(double hour) {
    if (std::isfinite(hour)) {
        hour_ = wrapped(hour);
    }
}

void Lighting::setHoursPerSecond(double rate) {
    if (std::isfinite(rate)) {
        hoursPerSecond_ = rate;
    }
}

void Lighting::traverse(osg::NodeVisitor& visitor) {
    const bool updates = visitor.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR;
    if (updates) {
        update(visitor.getFrameStamp());
    }
    if (osgUtil::CullVisitor* const culls = state_.valid() ? visitor.asCullVisitor() : nullptr) {
        cull(*culls);
    } else {
        osg::Group::traverse(visitor);
    }
    if (updates) {
        show(visitor.getNodePath()); // where things are now
    }
}

void Lighting::cull(osgUtil::CullVisitor& visitor) {
    if (probes_) {
        probes_->cullFaces(visitor);
    }
    visitor.pushStateSet(state_.get());
    osgUtil::StateGraph* const top = visitor.getCurrentStateGraph();
    osg::Group::traverse(visitor);
    if (probes_) {
        probes_->dress(visitor, top);
    }
    visitor.popStateSet();
}

void Lighting::update(const osg::FrameStamp* stamp) {
    if (stamp != nullptr) {
        const double time = stamp->getSimulationTime();
        if (hasTime_) {
            setHour(hour_ + hoursPerSecond_ * (time - lastTime_));
        }
        lastTime_ = time;
        hasTime_ = true;
    }
    const std::shared_ptr<ThreadContexts> here = ThreadContexts::ofThisThread();
    here->endReleased();
    std::erase_if(retired_, [](const osg::ref_ptr<ProbeFace>& face) { return face->isLeft(); });
    if (lit_ != nullptr && contexts_ != here) {
        close(); // updates have moved to another thread
    }
    if (lit_ == nullptr && !refused_ && !(document_.empty() && file_.empty())) {
        open();
    }
}

void Lighting::show(const osg::NodePath& path) {
    if (lit_ == nullptr) {
        return;
    }
    LodestarStatus status = probes_ ? probes_->prepare(path) : LODESTAR_OK;
    if (status == LODESTAR_OK) {
        status = probes_ ? lights_->update(probes_->frame(hour_)) : lights_->update(hour_);
    }
    status = status == LODESTAR_OK && probes_ ? probes_->show(lights_->plan()) : status;
    if (status != LODESTAR_OK) {
        refuse(lit_->refusal());
    }
}

void Lighting::open() {
    const hosts::Frame frame{.up = {up_.x(), up_.y(), up_.z()},
                             .north = {north_.x(), north_.y(), north_.z()}};
    const std::string beside = (std::filesystem::path(folder_) / "document").string();
    auto opened = document_.empty() ? hosts::LitContext::open(found(file_, folder_), frame)
                                    : hosts::LitContext::read(document_, beside, frame);
    if (!opened) {
        refuse(opened.error());
        return;
    }
    contexts_ = ThreadContexts::ofThisThread();
    lit_ = contexts_->keep(std::move(*opened));
    // A new one each time: the draw thread may still be leaving the last.
    state_ = new osg::StateSet;
    const bool probes = Probes::wanted(lit_->api(), lit_->get());
    state_->setAttributeAndModes(probes ? probeProgramOf(lit_->api()) : programOf(lit_->api()));
    setMaterial(*state_, Material{});
    lights_ = std::make_unique<Lights>(lit_->api(), lit_->get(), *state_, 0);
    if (probes) {
        probes_ = std::make_unique<Probes>(lit_->api(), lit_->get(), *state_, kProbeUnit, *this);
    }
}

void Lighting::close() {
    if (probes_) {
        probes_->retire(retired_);
    }
    probes_.reset();
    lights_.reset();
    state_ = nullptr;
    if (lit_ != nullptr) {
        contexts_->release(lit_);
        lit_ = nullptr;
    }
    refused_ = false;
}

void Lighting::refuse(const core::Error& why) {
    OSG_WARN << "lodestar::Lighting" << (getName().empty() ? "" : " \"" + getName() + "\"") << ": "
             << why.message() << std::endl;
    close();
    refused_ = true;
}

void Lighting::resizeGLObjectBuffers(unsigned int size) {
    osg::Group::resizeGLObjectBuffers(size);
    if (state_.valid()) {
        state_->resizeGLObjectBuffers(size);
    }
}

void Lighting::releaseGLObjects(osg::State* state) const {
    osg::Group::releaseGLObjects(state);
    if (state_.valid()) {
        state_->releaseGLObjects(state);
    }
    if (probes_) {
        probes_->releaseGLObjects(state);
    }
}

void Lighting::setThreadSafeRefUnref(bool safe) {
    osg::Group::setThreadSafeRefUnref(safe);
    if (state_.valid()) {
        state_->setThreadSafeRefUnref(safe);
    }
}

} // namespace lodestar::osghost
