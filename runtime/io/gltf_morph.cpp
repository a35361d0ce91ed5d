// SPDX-License-Identifier: MIT
//
// Morph targets and their weights. Source: glTF 2.0 specification, section 3.7.2.2.
#include <algorithm>
#include <cmath>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

/// One attribute of a target; empty where the target lacks it.
core::Result<std::vector<glm::vec3>> readDeltas(GltfContext& context, const Json& target,
                                                const char* name, std::size_t vertexCount,
                                                const std::string& at) {
    std::vector<glm::vec3> deltas;
    const Json* accessor = member(target, name);
    if (accessor == nullptr) {
        return deltas;
    }
    const auto index = accessor->get<std::size_t>();
    core::Result<void> allowed =
        checkComponents(context, name, context.model.accessors[index], at + "/" + name, true);
    if (!allowed) {
        return allowed.error();
    }
    core::Result<std::vector<float>> values = readTyped(context, static_cast<int>(index), "VEC3",
                                                        {5120, 5122, 5126}, false, at + "/" + name);
    if (!values) {
        return values.error();
    }
    if (values->size() != 3 * vertexCount) {
        return core::refused(std::string(name) + " of a morph target has " +
                                 std::to_string(values->size() / 3) + " elements, POSITION has " +
                                 std::to_string(vertexCount),
                             at + "/" + name);
    }
    std::uint64_t repaired = 0;
    for (float& value : *values) {
        repaired += std::isfinite(value) ? 0U : 1U;
        value = std::isfinite(value) ? value : 0.0f;
    }
    context.file.warnings.add("morph target's delta not finite, set to 0", repaired);
    deltas.reserve(vertexCount);
    for (std::size_t i = 0; i < values->size(); i += 3) {
        deltas.emplace_back((*values)[i], (*values)[i + 1], (*values)[i + 2]);
    }
    return deltas;
}

std::string weightsFor(std::size_t given, std::size_t targets) {
    return "there are " + std::to_string(given) + " weights for " + std::to_string(targets) +
           " morph targets";
}

} // namespace

core::Result<void> readTargets(GltfContext& context, const Json& json, const std::string& at,
                               GltfPrimitive& primitive) {
    const std::size_t count = memberSize(json, "targets");
    for (std::size_t t = 0; t < count; ++t) {
        const Json& source = json["targets"][t];
        const std::string here = pointer(at + "/targets", t);
        GltfMorphTarget& target = primitive.targets.emplace_back();
        for (const auto& [name, list] :
             {std::pair("POSITION", &target.positions), std::pair("NORMAL", &target.normals),
              std::pair("TANGENT", &target.tangents)}) {
            core::Result<std::vector<glm::vec3>> deltas =
                readDeltas(context, source, name, primitive.positions.size(), here);
            if (!deltas) {
                return deltas.error();
            }
            *list = std::move(*deltas);
        }
        const bool normals = primitive.normals.empty() && !target.normals.empty();
        const bool tangents = primitive.tangents.empty() && !target.tangents.empty();
        context.file.warnings.add(
            "morph target moves normals or tangents that its primitive lacks, not moved",
            normals || tangents ? 1 : 0);
        if (normals) {
            target.normals.clear();
        }
        if (tangents) {
            target.tangents.clear();
        }
        const auto others =
            std::count_if(source.items().begin(), source.items().end(), [](const auto& entry) {
                return entry.key() != "POSITION" && entry.key() != "NORMAL" &&
                       entry.key() != "TANGENT";
            });
        context.file.warnings.add("morph target of another attribute, not applied",
                                  static_cast<std::uint64_t>(others));
    }
    return {};
}

void readTargetWeights(GltfContext& context, std::size_t mesh, GltfMesh& converted) {
    const Json& json = context.document["meshes"][mesh];
    const std::string at = pointer("/meshes", mesh);
    const Json& primitives = json["primitives"];
    const std::size_t count = primitives.empty() ? 0 : memberSize(primitives[0], "targets");
    for (std::size_t p = 1; p < primitives.size(); ++p) {
        if (memberSize(primitives[p], "targets") != count) {
            context.problems.refuse(
                "primitive has " + std::to_string(memberSize(primitives[p], "targets")) +
                    " morph targets, the mesh's first has " + std::to_string(count),
                pointer(at + "/primitives", p));
            return;
        }
    }
    converted.weights.assign(count, 0.0f);
    const std::size_t given = memberSize(json, "weights");
    if (given != 0 && given != count) {
        context.problems.refuse(weightsFor(given, count), at + "/weights");
        return;
    }
    for (std::size_t i = 0; i < given; ++i) {
        converted.weights[i] = json["weights"][i].get<float>();
    }
}

void checkNodeWeights(GltfContext& context) {
    for (std::size_t n = 0; n < context.file.nodes.size(); ++n) {
        const GltfNode& node = context.file.nodes[n];
        if (node.mesh == kNone || node.weights.empty()) {
            continue;
        }
        const auto mesh = static_cast<std::size_t>(node.mesh);
        const std::size_t count = context.file.meshes[mesh].weights.size();
        if (node.weights.size() != count && context.problems.clean(pointer("/meshes", mesh))) {
            context.problems.refuse(weightsFor(node.weights.size(), count),
                                    pointer("/nodes", n) + "/weights");
        }
    }
}

} // namespace lodestar::io::detail
