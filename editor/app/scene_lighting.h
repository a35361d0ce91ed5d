// SPDX-License-Identifier: MIT
//
// What lights a scene: the command line over its lighting document over the glTF.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/scene_options.h"
#include "document/document.h"
#include "lighting/day.h"
#include "scene/probe_observer.h"

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

/// The document's environment, its source below the document's own folder.
/// @param kept what has been read before, as it lies in its file; gets what is read
/// @pre the document has an environment  @errors InputRefused naming the file
[[nodiscard]] core::Result<DistantLight>
documentEnvironment(const OpenedDocument& opened, int cubeWidth, std::optional<DistantLight>& kept);

/// The distant light of a scene: the options', else the document's, else none where the document
/// has lights, else the scene's own, else a clear sky. None is a light with an empty cube.
/// @errors InputRefused
[[nodiscard]] core::Result<DistantLight>
distantLight(const SceneOptions& options, const OpenedFile& opened,
             const std::optional<OpenedDocument>& document);

/// Gives the materials of a scene what the document says, by name or "#index". What the document
/// names and the scene lacks is counted.
void applyMaterials(const document::Document& document, scene::Scene& scene, core::Tally& warnings);

/// Light of files that probes hold, by file and width of a face.
using ProbeMaps = std::map<std::pair<std::string, int>, scene::ProbeMap>;

/// Gives the scene the document's light probes, in place of those that it had; those that hold a
/// file's light read it. @param maps what has been read already; gets what is read
/// @errors InputRefused naming the file; the scene is as it was
[[nodiscard]] core::Result<void> setDocumentProbes(const OpenedDocument& opened,
                                                   scene::Scene& scene, ProbeMaps& maps,
                                                   core::Tally& warnings);

/// An hour in [0, 24); one outside is wrapped and counted. @errors Usage if it is not finite
[[nodiscard]] core::Result<double> hourOf(const SceneOptions& options, core::Tally& warnings);

} // namespace lodestar::app
