// SPDX-License-Identifier: MIT
#include "model/presets.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "io/document_file.h"

namespace lodestar::model {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".lodestar.json";
constexpr std::size_t kLongestName = 100;
/// A folder of more is not one of presets.
constexpr std::size_t kMostPresets = 1000;

core::Result<fs::path> pathOf(const fs::path& folder, const std::string& name) {
    const bool control = std::any_of(name.begin(), name.end(), [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return code < 0x20 || code == 0x7f || c == '/';
    });
    if (name.empty() || name.size() > kLongestName || name.front() == '.' || control) {
        return core::refused("a preset's name has 1 to 100 bytes, no slash and no leading dot");
    }
    if (folder.empty()) {
        return core::refused("there is no folder for presets: HOME is not set");
    }
    return folder / (name + std::string(kSuffix));
}

core::Error cannot(const fs::path& path, const std::error_code& code) {
    return {
        core::ErrorCode::OutputFailed, "cannot be written: " + code.message(), path.string(), {}};
}

} // namespace

fs::path userPresetFolder() {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here changes the environment
    const char* const data = std::getenv("XDG_DATA_HOME");
    if (data != nullptr && *data == '/') { // relative ones are to be ignored, says the standard
        return fs::path(data) / "lodestar" / "presets";
    }
    // NOLINTNEXTLINE(concurrency-mt-unsafe)
    const char* const home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') {
        return fs::path(home) / ".local" / "share" / "lodestar" / "presets";
    }
    return {};
}

std::vector<Preset> loadPresets(const fs::path& folder, core::Tally& warnings) {
    std::vector<fs::path> files;
    std::error_code code;
    fs::directory_iterator entry(folder, code);
    for (; !code && entry != fs::directory_iterator(); entry.increment(code)) {
        const std::string name = entry->path().filename().string();
        if (name.size() > kSuffix.size() && name.ends_with(kSuffix) && name.front() != '.') {
            files.push_back(entry->path());
        }
    }
    std::sort(files.begin(), files.end());
    if (files.size() > kMostPresets) {
        warnings.add("presets beyond 1000, left out", files.size() - kMostPresets);
        files.resize(kMostPresets);
    }
    std::vector<Preset> presets;
    for (const fs::path& path : files) {
        core::Tally mended;
        auto document = io::loadDocument(path, mended);
        if (!document) {
            warnings.add("preset left out: " + document.error().message());
        } else if (document->lights.empty()) {
            warnings.add("preset left out: " + path.string() + ": it has no lights");
        } else {
            const std::string file = path.filename().string();
            presets.push_back(
                {file.substr(0, file.size() - kSuffix.size()), std::move(document->lights)});
        }
    }
    return presets;
}

core::Result<void> savePreset(const fs::path& folder, const Preset& preset) {
    const auto path = pathOf(folder, preset.name);
    if (!path) {
        return path.error();
    }
    if (preset.lights.empty()) {
        return core::refused("a preset needs a light");
    }
    std::error_code code;
    fs::create_directories(folder, code);
    if (code) {
        return cannot(folder, code);
    }
    document::Document document;
    document.lights = preset.lights;
    return io::saveDocument(*path, document);
}

core::Result<void> removePreset(const fs::path& folder, const std::string& name) {
    const auto path = pathOf(folder, name);
    if (!path) {
        return path.error();
    }
    std::error_code code;
    if (!fs::remove(*path, code) || code) {
        return code ? cannot(*path, code)
                    : core::inFile(core::refused("there is no such preset"), path->string());
    }
    return {};
}

} // namespace lodestar::model
