// SPDX-License-Identifier: MIT
#include "io/document_file.h"

#include <string_view>

#include "io/file.h"

namespace lodestar::io {

std::filesystem::path sidecarPath(const std::filesystem::path& scene) {
    return scene.parent_path() / (scene.stem().string() + ".lodestar.json");
}

core::Result<document::Document> loadDocument(const std::filesystem::path& path,
                                              core::Tally& warnings) {
    const auto bytes = readFile(path, document::kMaxTextBytes);
    if (!bytes) {
        return core::inFile(bytes.error(), path.string());
    }
    auto parsed = document::parseDocument(
        std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()), warnings);
    if (!parsed) {
        return core::inFile(parsed.error(), path.string());
    }
    return parsed;
}

core::Result<void> saveDocument(const std::filesystem::path& path,
                                const document::Document& document) {
    const std::string text = document::writeDocument(document);
    return writeFile(path, text.data(), text.size());
}

} // namespace lodestar::io
