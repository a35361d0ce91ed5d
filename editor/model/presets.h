// SPDX-License-Identifier: MIT
//
// Skies and suns to start from: some that are built in, and the user's own, which are lighting
// documents in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/tally.h"
#include "document/document.h"

namespace lodestar::model {

/// Lights that stand together. Use: the SetLights command, or SetGradient with one of its keys.
struct Preset {
    std::string name;
    std::vector<document::Light> lights;
};

/// What a new light starts as: a sky of two stops, brighter above, or a sun's disc of 0.27 degrees;
/// one key at noon. The gradient alone is what "reset" gives.
[[nodiscard]] document::Light plainLight(lighting::LightKind kind, std::string name);

/// Clear noon, golden hour, overcast, dusk, night, studio: a sky each, and a sun where there is
/// one. Radiances fit exposure 0.
[[nodiscard]] const std::vector<Preset>& builtInPresets();

/// The user's folder: $XDG_DATA_HOME/lodestar/presets, else ~/.local/share/lodestar/presets; empty
/// where neither is set.
[[nodiscard]] std::filesystem::path userPresetFolder();

/// A folder's presets by name: every NAME.lodestar.json with lights. A folder that is not there has
/// none; a file that is refused is left out and counted with its reason.
[[nodiscard]] std::vector<Preset> loadPresets(const std::filesystem::path& folder,
                                              core::Tally& warnings);

/// Writes FOLDER/NAME.lodestar.json, making the folder; replaces one of that name.
/// @errors InputRefused: a name that is no file's (empty, over 100 bytes, with a slash, a control
/// character or a leading dot), no lights; OutputFailed
[[nodiscard]] core::Result<void> savePreset(const std::filesystem::path& folder,
                                            const Preset& preset);

/// @errors InputRefused as `savePreset`; OutputFailed
[[nodiscard]] core::Result<void> removePreset(const std::filesystem::path& folder,
                                              const std::string& name);

} // namespace lodestar::model
