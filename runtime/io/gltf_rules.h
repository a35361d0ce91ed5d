// SPDX-License-Identifier: MIT
//
// What the files of checkRules share.
#pragma once

#include "io/gltf_internal.h"

namespace lodestar::io::detail {

/// Calls act(element, its pointer) for the elements of an array that stand unrefused.
template <class Act>
void eachClean(const Json& document, const char* array, const GltfProblems& problems, Act act) {
    for (std::size_t i = 0; i < memberSize(document, array); ++i) {
        const std::string at = pointer(std::string("/") + array, i);
        if (problems.clean(at)) {
            act(document[array][i], at);
        }
    }
}

/// Names, formats and alignment of what primitives use, and what views are used for.
void checkMeshRules(const Json& document, GltfProblems& problems);
/// The numbers in accessors: finite, within their min and max, unit normals.
void checkDataRules(const Json& document, const std::vector<Bytes>& buffers,
                    GltfProblems& problems);

} // namespace lodestar::io::detail
