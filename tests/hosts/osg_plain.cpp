// SPDX-License-Identifier: MIT
//
// osg-plain IN OUT: a program that knows OpenSceneGraph alone reads a scene, updates it once and
// writes it. What else is in the scene comes by OSG_LIBRARY_PATH.
#include <osg/FrameStamp>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgUtil/UpdateVisitor>

int main(int argc, char** argv) {
    const osg::ref_ptr<osg::Node> scene = argc == 3 ? osgDB::readRefNodeFile(argv[1]) : nullptr;
    if (!scene) {
        return 1;
    }
    osgUtil::UpdateVisitor update;
    update.setFrameStamp(new osg::FrameStamp);
    scene->accept(update);
    return osgDB::writeNodeFile(*scene, argv[2]) ? 0 : 1;
}
