// SPDX-License-Identifier: MIT
#include "model/command.h"

#include "model/perform.h"
#include "model/rules.h"

namespace lodestar::model {
namespace {

struct Namer {
    std::string_view operator()(const AddStop&) const { return "Add stop"; }
    std::string_view operator()(const InsertStops&) const { return "Insert stops"; }
    std::string_view operator()(const MoveStops& c) const {
        return c.moves.size() > 1 ? "Move stops" : "Move stop";
    }
    std::string_view operator()(const SetStops& c) const {
        return c.color ? "Set colour" : c.ev ? "Set EV" : "Set position";
    }
    std::string_view operator()(const DeleteStops& c) const {
        return c.stops.size() > 1 ? "Delete stops" : "Delete stop";
    }
    std::string_view operator()(const ReverseStops&) const { return "Reverse gradient"; }
    std::string_view operator()(const MirrorStops&) const { return "Mirror gradient"; }
    std::string_view operator()(const DistributeStops&) const { return "Distribute stops"; }
    std::string_view operator()(const SimplifyStops&) const { return "Simplify gradient"; }
    std::string_view operator()(const SetGradient&) const { return "Replace gradient"; }
    std::string_view operator()(const SetInterpolation&) const { return "Set interpolation"; }
    std::string_view operator()(const SetSpace&) const { return "Set colour space"; }
    std::string_view operator()(const BrushStroke& c) const {
        return c.brush.mode == BrushMode::Paint ? "Paint" : "Smooth";
    }
    std::string_view operator()(const AddKey&) const { return "Add key"; }
    std::string_view operator()(const InsertKey&) const { return "Insert key"; }
    std::string_view operator()(const MoveKey&) const { return "Move key"; }
    std::string_view operator()(const CopyKey&) const { return "Copy key"; }
    std::string_view operator()(const DeleteKey&) const { return "Delete key"; }
    std::string_view operator()(const SetKey& c) const { return c.tint ? "Set tint" : "Set axis"; }
    std::string_view operator()(const AddLight&) const { return "Add light"; }
    std::string_view operator()(const RemoveLight&) const { return "Remove light"; }
    std::string_view operator()(const SetLight& c) const {
        return c.name         ? "Rename light"
               : c.axis       ? "Set axis"
               : c.path       ? "Set sun path"
               : c.visibility ? "Set visibility"
                              : "Set light";
    }
    std::string_view operator()(const SetLights&) const { return "Replace lights"; }
    std::string_view operator()(const SetEnvironment& c) const {
        return c.source     ? "Set environment"
               : c.rotation ? "Turn environment"
                            : "Set environment EV";
    }
    std::string_view operator()(const RemoveEnvironment&) const { return "Remove environment"; }
    std::string_view operator()(const SetMaterials& c) const {
        return c.names.size() > 1 ? "Set materials" : "Set material";
    }
    std::string_view operator()(const ResetMaterials& c) const {
        return c.names.size() > 1 ? "Reset materials" : "Reset material";
    }
    std::string_view operator()(const AddProbe&) const { return "Add probe"; }
    std::string_view operator()(const SetProbe&) const { return "Set probe"; }
    std::string_view operator()(const RemoveProbes& c) const {
        return c.probes.size() > 1 ? "Remove probes" : "Remove probe";
    }
    std::string_view operator()(const SetMapRow&) const { return "Move map row"; }
    std::string_view operator()(const SetMapRows& c) const {
        return c.exponents.empty() ? "Reset map rows" : "Set map rows";
    }
    std::string_view operator()(const ReplaceDocument&) const { return "Replace document"; }
};

} // namespace

std::string_view nameOf(const Command& command) {
    return std::visit(Namer(), command);
}

core::Result<std::vector<Id>> perform(const Command& command, State& state) {
    auto performed = std::visit([&](const auto& each) { return performOn(state, each); }, command);
    if (performed) {
        if (auto size = checkedSize(state.document); !size) {
            return size.error();
        }
    }
    return performed;
}

} // namespace lodestar::model
