// SPDX-License-Identifier: MIT
//
// Commands on the environment, materials, light probes and the document as a whole.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/document_file.h"
#include "model/perform.h"
#include "model/rules.h"

namespace lodestar::model {
namespace {

constexpr const char* kNoNumber = "a number is needed, not NaN or infinity";
constexpr const char* kNoProbe = "there is no such probe";

bool finite(const lighting::ProbeVolume& volume) {
    return model::finite(volume.center) && model::finite(volume.size) &&
           std::all_of(volume.blend.begin(), volume.blend.end(),
                       [](double metres) { return model::finite(metres); });
}

lighting::ProbeVolume plain(lighting::ProbeVolume volume) {
    volume.center = model::plain(volume.center);
    volume.size = model::plain(volume.size);
    for (double& metres : volume.blend) {
        metres = model::plain(metres);
    }
    return volume;
}

/// A probe as it is read again. @errors InputRefused: not finite; what the reader refuses
core::Result<document::Probe> checkedProbe(document::Probe probe) {
    lighting::Probe& values = probe.probe;
    if (!model::finite(values.position) || !finite(values.influence) ||
        (values.proxy && !finite(*values.proxy)) || !model::finite(values.capture.nearPlane) ||
        !model::finite(values.capture.farPlane) || !model::finite(values.tint) ||
        !model::finite(values.intensity)) {
        return core::refused(kNoNumber);
    }
    values.position = model::plain(values.position);
    values.influence = plain(values.influence);
    if (values.proxy) {
        values.proxy = plain(*values.proxy);
    }
    values.tint = model::plain(values.tint);
    values.intensity = model::plain(values.intensity);
    document::Document document;
    document.probes.push_back(std::move(probe));
    auto read = asRead(document);
    if (!read) {
        return core::refused(read.error().what);
    }
    return std::move(read->probes.front());
}

core::Result<document::Material> checkedMaterial(const std::string& name,
                                                 document::Material material) {
    document::Document document;
    document.materials[name] = std::move(material);
    auto read = asRead(document);
    if (!read) {
        return core::refused(read.error().what);
    }
    const auto found = read->materials.find(name);
    if (name.empty() || found == read->materials.end()) {
        return core::refused("a material has a name in UTF-8, or # and its index");
    }
    return std::move(found->second);
}

/// Numbers that a text would not tell.
core::Result<void> checkedNumbers(const SetMaterials& command) {
    if ((command.exponent && std::isnan(*command.exponent)) ||
        (command.exponent && std::isinf(*command.exponent) && *command.exponent < 0.0) ||
        (command.diffuse && !model::finite(*command.diffuse)) ||
        (command.f0 && !model::finite(*command.f0)) ||
        (command.tolerance && !model::finite(*command.tolerance))) {
        return core::refused(kNoNumber);
    }
    if (command.names.empty()) {
        return core::refused("no material is named");
    }
    return {};
}

} // namespace

Performed performOn(State& state, const SetEnvironment& command) {
    document::Document document;
    document.environment = state.document.environment.value_or(document::Environment());
    document::Environment& environment = *document.environment;
    environment.source = command.source.value_or(environment.source);
    environment.rotation = command.rotation.value_or(environment.rotation);
    environment.ev = command.ev.value_or(environment.ev);
    if (!model::finite(environment.rotation) || !model::finite(environment.ev)) {
        return core::refused(kNoNumber);
    }
    environment.rotation = model::plain(environment.rotation);
    environment.ev = model::plain(environment.ev);
    if (command.source) {
        if (const auto source = io::environmentSource(*command.source, {}); !source) {
            return core::refused(source.error().what);
        }
    }
    auto read = asRead(document);
    if (!read) {
        return core::refused(read.error().what);
    }
    state.document.environment = std::move(read->environment);
    return std::vector<Id>();
}

Performed performOn(State& state, const RemoveEnvironment&) {
    state.document.environment.reset();
    return std::vector<Id>();
}

Performed performOn(State& state, const SetMaterials& command) {
    if (const auto numbers = checkedNumbers(command); !numbers) {
        return numbers.error();
    }
    for (const std::string& name : command.names) {
        const auto found = state.document.materials.find(name);
        document::Material material =
            found == state.document.materials.end() ? document::Material() : found->second;
        if (command.exponent) {
            material.exponent = model::plain(*command.exponent);
        }
        if (command.diffuse) {
            material.diffuse = model::plain(*command.diffuse);
        }
        if (command.f0) {
            material.f0 = model::plain(*command.f0);
        }
        if (command.specular) {
            material.specular = command.specular;
        }
        if (command.tolerance) {
            material.tolerance = model::plain(*command.tolerance);
        }
        auto checked = checkedMaterial(name, std::move(material));
        if (!checked) {
            return checked.error();
        }
        state.document.materials[name] = std::move(*checked);
    }
    return std::vector<Id>();
}

Performed performOn(State& state, const ResetMaterials& command) {
    const auto has = [&](MaterialField field) {
        return (static_cast<unsigned>(command.fields) & static_cast<unsigned>(field)) != 0;
    };
    for (const std::string& name : command.names) {
        const auto found = state.document.materials.find(name);
        if (found == state.document.materials.end()) {
            continue; // the scene's own values hold already
        }
        document::Material& material = found->second;
        if (has(MaterialField::Exponent)) {
            material.exponent.reset();
        }
        if (has(MaterialField::Diffuse)) {
            material.diffuse.reset();
        }
        if (has(MaterialField::F0)) {
            material.f0.reset();
        }
        if (has(MaterialField::Specular)) {
            material.specular.reset();
        }
        if (has(MaterialField::Tolerance)) {
            material.tolerance.reset();
        }
        if (material == document::Material()) {
            state.document.materials.erase(found);
        }
    }
    return std::vector<Id>();
}

Performed performOn(State& state, const AddProbe& command) {
    auto probe = checkedProbe({command.probe, {}, {}, {}, {}, {}});
    if (!probe) {
        return probe.error();
    }
    state.document.probes.push_back(std::move(*probe));
    state.ids.probes.push_back(state.ids.make());
    return std::vector<Id>{state.ids.probes.back()};
}

Performed performOn(State& state, const SetProbe& command) {
    const auto place = findProbe(state.ids, command.id);
    if (!place) {
        return core::refused(kNoProbe);
    }
    document::Probe probe = state.document.probes[*place];
    probe.probe = command.probe;
    auto checked = checkedProbe(std::move(probe));
    if (!checked) {
        return checked.error();
    }
    state.document.probes[*place] = std::move(*checked);
    return std::vector<Id>();
}

Performed performOn(State& state, const RemoveProbes& command) {
    for (const Id id : command.probes) {
        const auto place = findProbe(state.ids, id);
        if (!place) {
            return core::refused(kNoProbe);
        }
        const auto offset = static_cast<std::ptrdiff_t>(*place);
        state.document.probes.erase(state.document.probes.begin() + offset);
        state.ids.probes.erase(state.ids.probes.begin() + offset);
    }
    return std::vector<Id>();
}

Performed performOn(State& state, const ReplaceDocument& command) {
    auto read = asRead(command.document);
    if (!read) {
        return read.error();
    }
    Identities& ids = state.ids;
    const document::Document& document = *read;
    // Names go on by place, so that a selection outlives a reading from the disk.
    ids.lights.resize(std::min(ids.lights.size(), document.lights.size()));
    for (std::size_t i = 0; i < document.lights.size(); ++i) {
        const std::vector<document::Key>& keys = document.lights[i].keys;
        if (i == ids.lights.size()) {
            ids.lights.push_back({ids.make(), {}});
        }
        std::vector<KeyIds>& names = ids.lights[i].keys;
        names.resize(std::min(names.size(), keys.size()));
        for (std::size_t k = 0; k < keys.size(); ++k) {
            if (k == names.size()) {
                names.push_back({ids.make(), {}});
            }
            std::vector<Id>& stops = names[k].stops;
            stops.resize(std::min(stops.size(), keys[k].gradient.stops.size()));
            while (stops.size() < keys[k].gradient.stops.size()) {
                stops.push_back(ids.make());
            }
        }
    }
    ids.probes.resize(std::min(ids.probes.size(), document.probes.size()));
    while (ids.probes.size() < document.probes.size()) {
        ids.probes.push_back(ids.make());
    }
    state.document = std::move(*read);
    return std::vector<Id>();
}

} // namespace lodestar::model
