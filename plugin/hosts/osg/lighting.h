// SPDX-License-Identifier: MIT
//
// A lighting document as a node of OpenSceneGraph's: what stands below it is lit.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <osg/Group>
#include <osg/StateSet>
#include <osg/Vec3d>

#include "hosts/lit_context.h"

namespace osgUtil {
class CullVisitor;
}

namespace lodestar::osghost {

class Lights;
class ProbeFace;
class Probes;
class ThreadContexts;

/// A group whose children are drawn by `programOf` under a document's lights at an hour; each says
/// its material by `setMaterial`, or is white.
///
/// Properties are set as those of any node: between frames, or in event and update traversals.
/// `lodestar::Lighting` is its name in OpenSceneGraph's own formats, which keep the properties
/// alone: what it draws with is its own, not its StateSet. Copies share nothing but children.
///
/// The library's context is opened by the first update traversal, on that traversal's thread, and
/// anew where a later one comes on another thread. The node may be deleted on any thread. The first
/// of a program takes about a second to open: one that is to appear at once is updated before it is
/// shown.
///
/// A document's light probes are captured by cameras that draw the children before the picture, six
/// faces a frame at most, and light them from the frame after; those at a node follow the first
/// node of that name below. Of what stands below, the world boxes are compared from update to
/// update.
///
/// A document that is refused is said once, as osg::WARN, and children are drawn as below a Group.
class Lighting : public osg::Group {
public:
    Lighting();
    Lighting(const Lighting& other, const osg::CopyOp& copy = osg::CopyOp::SHALLOW_COPY);
    META_Node(lodestar, Lighting)

        /// The document's text; while it is not empty, no file is read.
        void setDocument(const std::string& text);
    [[nodiscard]] const std::string& getDocument() const { return document_; }
    /// The document's file: where osgDB finds data files, or below the folder.
    void setFile(const std::string& name);
    [[nodiscard]] const std::string& getFile() const { return file_; }
    /// Where the file, and a text's environment, are looked for first; reading a scene sets it to
    /// the scene's own.
    void setFolder(const std::string& folder);
    [[nodiscard]] const std::string& getFolder() const { return folder_; }

    /// The scene's up and north in world coordinates, of any length; (0, 1, 0) and (0, 0, -1) at
    /// first, a document's own. OpenSceneGraph's usual ones are (0, 0, 1) and (0, 1, 0).
    void setUp(const osg::Vec3d& up);
    [[nodiscard]] const osg::Vec3d& getUp() const { return up_; }
    void setNorth(const osg::Vec3d& north);
    [[nodiscard]] const osg::Vec3d& getNorth() const { return north_; }

    /// Local solar time [h, 0 to 24; others are wrapped, what is not finite is passed over].
    void setHour(double hour);
    [[nodiscard]] double getHour() const { return hour_; }
    /// How fast the hour goes on with the frame stamp's simulation time [h/s]; 0 at first.
    void setHoursPerSecond(double rate);
    [[nodiscard]] double getHoursPerSecond() const { return hoursPerSecond_; }

    /// What children are drawn with: texture units 0 to 4, to 8 with light probes, uniforms, the
    /// program. Null before the first update traversal and where the document is refused.
    [[nodiscard]] osg::StateSet* getLightState() const { return state_.get(); }

    void traverse(osg::NodeVisitor& visitor) override;
    void resizeGLObjectBuffers(unsigned int size) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;
    void setThreadSafeRefUnref(bool safe) override;

protected:
    ~Lighting() override;

private:
    void update(const osg::FrameStamp* stamp);
    void show(const osg::NodePath& path);
    void cull(osgUtil::CullVisitor& visitor);
    void open();
    void close();
    void refuse(const core::Error& why);

    std::string document_, file_, folder_;
    osg::Vec3d up_{0.0, 1.0, 0.0}, north_{0.0, 0.0, -1.0};
    double hour_ = 15.0, hoursPerSecond_ = 0.0;
    double lastTime_ = 0.0; ///< simulation time of the last update
    bool hasTime_ = false;
    bool refused_ = false; ///< what is set now; nothing more is said of it

    std::shared_ptr<ThreadContexts> contexts_; ///< of the thread that updates
    hosts::LitContext* lit_ = nullptr;         ///< one of theirs
    std::unique_ptr<Lights> lights_;
    std::unique_ptr<Probes> probes_; ///< null: the document has none
    /// Faces of probes before; they end in updates, once nothing draws them.
    std::vector<osg::ref_ptr<ProbeFace>> retired_;
    osg::ref_ptr<osg::StateSet> state_;
};

} // namespace lodestar::osghost
