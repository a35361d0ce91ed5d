// SPDX-License-Identifier: MIT
//
// lodestar::Lighting in OpenSceneGraph's own formats (.osgt, .osgx, .osgb).
#include <charconv>
#include <string>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

#include "hosts/osg/lighting.h"

namespace {

using lodestar::osghost::Lighting;

/// A text, with the folder that the scene is read from.
class Placed : public osgDB::StringSerializer<Lighting> {
public:
    using StringSerializer::StringSerializer;

    bool read(osgDB::InputStream& in, osg::Object& object) override {
        const osgDB::Options* const options = in.getOptions();
        if (options != nullptr && !options->getDatabasePathList().empty()) {
            OBJECT_CAST<Lighting&>(object).setFolder(options->getDatabasePathList().front());
        }
        return StringSerializer::read(in, object);
    }
};

/// A number as text that reads back as the same: OpenSceneGraph writes six digits of it.
class Exact : public osgDB::PropByValSerializer<Lighting, double> {
public:
    using PropByValSerializer::PropByValSerializer;

    bool read(osgDB::InputStream& in, osg::Object& object) override {
        if (in.isBinary()) {
            return PropByValSerializer::read(in, object);
        }
        if (in.matchString(_name)) {
            std::string text;
            in >> text;
            double value = _defaultValue;
            std::from_chars(text.data(), text.data() + text.size(), value);
            (OBJECT_CAST<Lighting&>(object).*_setter)(value);
        }
        return true;
    }

    bool write(osgDB::OutputStream& out, const osg::Object& object) override {
        const double value = (OBJECT_CAST<const Lighting&>(object).*_getter)();
        if (out.isBinary()) {
            return PropByValSerializer::write(out, object);
        }
        if (value != _defaultValue) {
            char text[32]; // the longest double has 24 characters
            const auto end = std::to_chars(text, text + sizeof text, value).ptr;
            out << out.PROPERTY(_name.c_str()) << std::string(text, end) << std::endl;
        }
        return true;
    }
};

} // namespace

REGISTER_OBJECT_WRAPPER2(lodestar_Lighting, new Lighting, lodestar::osghost::Lighting,
                         "lodestar::Lighting",
                         "osg::Object osg::Node osg::Group lodestar::Lighting") {
    wrapper->addSerializer(new Placed("Document", "", &MyClass::getDocument, &MyClass::setDocument),
                           osgDB::BaseSerializer::RW_STRING);
    wrapper->addSerializer(new Placed("File", "", &MyClass::getFile, &MyClass::setFile),
                           osgDB::BaseSerializer::RW_STRING);
    ADD_VEC3D_SERIALIZER(Up, osg::Vec3d(0.0, 1.0, 0.0));
    ADD_VEC3D_SERIALIZER(North, osg::Vec3d(0.0, 0.0, -1.0));
    wrapper->addSerializer(new Exact("Hour", 15.0, &MyClass::getHour, &MyClass::setHour),
                           osgDB::BaseSerializer::RW_DOUBLE);
    wrapper->addSerializer(
        new Exact("HoursPerSecond", 0.0, &MyClass::getHoursPerSecond, &MyClass::setHoursPerSecond),
        osgDB::BaseSerializer::RW_DOUBLE);
}
