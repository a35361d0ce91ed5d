// SPDX-License-Identifier: MIT
#include "io/document_file.h"

#include <string_view>

#include "io/file.h"
#include "lighting/environment.h"

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

core::Result<std::string> environmentSource(const std::string& source,
                                            const std::filesystem::path& document) {
    if (lighting::isAnalytic(source)) {
        return source;
    }
    const std::filesystem::path path(source);
    for (const std::filesystem::path& part : path) {
        if (path.is_absolute() || part == "..") {
            return core::inFile(core::refused("a source lies in the document's folder or below",
                                              "/environment/source"),
                                document.string());
        }
    }
    return (document.parent_path() / path).string();
}

core::Result<void> saveDocument(const std::filesystem::path& path,
                                const document::Document& document) {
    const std::string text = document::writeDocument(document);
    return writeFile(path, text.data(), text.size());
}

} // namespace lodestar::io
