// SPDX-License-Identifier: MIT
//
// What lights a scene: the command line over its lighting document over the glTF.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/scene_options.h"
#include "document/document.h"
#include "lighting/day.h"

namespace lodestar::app {

/// A lighting document and where it lies.
struct OpenedDocument {
    std::string file;
    document::Document document;
    std::vector<lighting::DayLight> lights; ///< in order
    core::Tally warnings;
};

/// The document that the options name, else the one beside the scene; none where there is neither.
/// @errors InputRefused
[[nodiscard]] core::Result<std::optional<OpenedDocument>> openDocument(const SceneOptions& options);

/// The distant light of a scene: the options', else the document's, else none where the document
/// has lights, else the scene's own, else a clear sky. None is a light with an empty cube.
/// @errors InputRefused
[[nodiscard]] core::Result<DistantLight>
distantLight(const SceneOptions& options, const OpenedFile& opened,
             const std::optional<OpenedDocument>& document);

/// Gives the materials of a scene what the document says, by name or "#index". What the document
/// names and the scene lacks is counted.
void applyMaterials(const document::Document& document, scene::Scene& scene, core::Tally& warnings);

/// Gives the scene the document's light probes; those that hold a file's light read it.
/// @errors InputRefused naming the file
[[nodiscard]] core::Result<void> addDocumentProbes(const OpenedDocument& opened,
                                                   scene::Scene& scene, core::Tally& warnings);

/// An hour in [0, 24); one outside is wrapped and counted. @errors Usage if it is not finite
[[nodiscard]] core::Result<double> hourOf(const SceneOptions& options, core::Tally& warnings);

} // namespace lodestar::app
