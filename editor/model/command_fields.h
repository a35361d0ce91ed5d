// SPDX-License-Identifier: MIT
//
// Commands as text, the one table: each command's name and its members, for reading, writing and
// naming alike. Internal to command_text.cpp.
//
// `text.command(NAME)` begins; `text(NAME, member)` is needed in the text where the member is no
// optional; what `text.given(NAME, member)` lacks has its default.
#pragma once

#include "model/command.h"

namespace lodestar::model {

// Stops.
template <class T>
void describe(T& text, AddStop& c) {
    text.command("AddStop")("key", c.key)("at", c.at);
}
template <class T>
void describe(T& text, InsertStops& c) {
    text.command("InsertStops")("key", c.key)("stops", c.stops);
}
template <class T>
void describe(T& text, StopMove& c) {
    text("stop", c.stop)("at", c.at);
}
template <class T>
void describe(T& text, MoveStops& c) {
    text.command("MoveStops")("moves", c.moves);
}
template <class T>
void describe(T& text, SetStops& c) {
    text.command("SetStops")("stops", c.stops)("at", c.at)("color", c.color)("ev", c.ev);
}
template <class T>
void describe(T& text, DeleteStops& c) {
    text.command("DeleteStops")("stops", c.stops);
}
template <class T>
void describe(T& text, ReverseStops& c) {
    text.command("ReverseStops")("key", c.key);
}
template <class T>
void describe(T& text, MirrorStops& c) {
    text.command("MirrorStops")("key", c.key);
}
template <class T>
void describe(T& text, DistributeStops& c) {
    text.command("DistributeStops")("key", c.key).given("fromLeft", c.fromLeft);
}
template <class T>
void describe(T& text, SimplifyStops& c) {
    text.command("SimplifyStops")("key", c.key).given("count", c.count);
}
template <class T>
void describe(T& text, SetGradient& c) {
    text.command("SetGradient")("key", c.key)("gradient", c.gradient);
}
template <class T>
void describe(T& text, SetInterpolation& c) {
    text.command("SetInterpolation")("key", c.key)("interpolation", c.interpolation);
}
template <class T>
void describe(T& text, SetSpace& c) {
    text.command("SetSpace")("key", c.key)("space", c.space);
}
template <class T>
void describe(T& text, Brush& c) {
    text.given("mode", c.mode)
        .given("size", c.size)
        .given("softness", c.softness)
        .given("strength", c.strength)
        .given("color", c.color);
}
template <class T>
void describe(T& text, BrushStroke& c) {
    text.command("BrushStroke")("key", c.key)("path", c.path).given("brush", c.brush);
}

// Keys and lights.
template <class T>
void describe(T& text, AddKey& c) {
    text.command("AddKey")("light", c.light)("hour", c.hour);
}
template <class T>
void describe(T& text, InsertKey& c) {
    text.command("InsertKey")("light", c.light)("value", c.key);
}
template <class T>
void describe(T& text, MoveKey& c) {
    text.command("MoveKey")("key", c.key)("hour", c.hour);
}
template <class T>
void describe(T& text, CopyKey& c) {
    text.command("CopyKey")("key", c.key)("hour", c.hour);
}
template <class T>
void describe(T& text, DeleteKey& c) {
    text.command("DeleteKey")("key", c.key);
}
template <class T>
void describe(T& text, SetKey& c) {
    text.command("SetKey")("key", c.key)("tint", c.tint)("axis", c.axis);
}
template <class T>
void describe(T& text, AddLight& c) {
    text.command("AddLight")("value", c.light);
}
template <class T>
void describe(T& text, RemoveLight& c) {
    text.command("RemoveLight")("light", c.light);
}
template <class T>
void describe(T& text, SetLight& c) {
    text.command("SetLight")("light", c.light)("name", c.name)("axis", c.axis)("path", c.path)(
        "visibility", c.visibility)("add", c.add);
}
template <class T>
void describe(T& text, SetLights& c) {
    text.command("SetLights")("lights", c.lights);
}

// The scene.
template <class T>
void describe(T& text, SetEnvironment& c) {
    text.command("SetEnvironment")("source", c.source).degrees("rotation", c.rotation)("ev", c.ev);
}
template <class T>
void describe(T& text, RemoveEnvironment&) {
    text.command("RemoveEnvironment");
}
template <class T>
void describe(T& text, SetMaterials& c) {
    text.command("SetMaterials")("names", c.names)
        .exponent("exponent", c.exponent)("diffuse", c.diffuse)("f0", c.f0)("specular", c.specular)(
            "tolerance", c.tolerance);
}
template <class T>
void describe(T& text, ResetMaterials& c) {
    text.command("ResetMaterials")("names", c.names).given("fields", c.fields);
}
template <class T>
void describe(T& text, AddProbe& c) {
    text.command("AddProbe")("value", c.probe);
}
template <class T>
void describe(T& text, SetProbe& c) {
    text.command("SetProbe")("probe", c.id)("value", c.probe);
}
template <class T>
void describe(T& text, RemoveProbes& c) {
    text.command("RemoveProbes")("probes", c.probes);
}
template <class T>
void describe(T& text, SetMapRow& c) {
    text.command("SetMapRow")("row", c.row)("exponent", c.exponent);
}
template <class T>
void describe(T& text, SetMapRows& c) {
    text.command("SetMapRows")("exponents", c.exponents);
}
template <class T>
void describe(T& text, ReplaceDocument& c) {
    text.command("ReplaceDocument")("document", c.document);
}

} // namespace lodestar::model
