// SPDX-License-Identifier: MIT
//
// Lighting documents on disk.
#pragma once

#include <filesystem>

#include "core/result.h"
#include "core/tally.h"
#include "document/document.h"

namespace lodestar::io {

/// The document that lies beside a scene: SCENE-stem.lodestar.json in its folder.
[[nodiscard]] std::filesystem::path sidecarPath(const std::filesystem::path& scene);

/// @errors InputRefused: a file that cannot be read, or what document::parseDocument refuses; the
/// error names the file
[[nodiscard]] core::Result<document::Document> loadDocument(const std::filesystem::path& path,
                                                            core::Tally& warnings);

/// An environment's source as ENV, from where the program runs: a path lies in the document's
/// folder or below. @errors InputRefused with the JSON pointer; the error names the document's file
[[nodiscard]] core::Result<std::string> environmentSource(const std::string& source,
                                                          const std::filesystem::path& document);

/// Writes the whole document beside the old one, then renames it over: on failure the old one
/// stays. @errors OutputFailed
[[nodiscard]] core::Result<void> saveDocument(const std::filesystem::path& path,
                                              const document::Document& document);

} // namespace lodestar::io
