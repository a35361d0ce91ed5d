// SPDX-License-Identifier: MIT
#include "io/gltf.h"

#include <algorithm>
#include <optional>

#include "io/gltf_internal.h"

namespace lodestar::io {
namespace detail {
namespace {

void listExtensions(GltfContext& context) {
    const auto list = [&](const char* key, std::vector<std::string>& names) {
        for (std::size_t i = 0; i < memberSize(context.document, key); ++i) {
            names.push_back(context.document[key][i].get<std::string>());
        }
    };
    list("extensionsUsed", context.file.extensionsUsed);
    list("extensionsRequired", context.file.extensionsRequired);
    for (const std::string& name : context.file.extensionsUsed) {
        if (!isSupportedExtension(name)) {
            context.file.warnings.add("extension " + name + " is not read, ignored");
        }
    }
}

/// Whether the next step is of use.
bool goOn(const GltfProblems& problems, bool all) {
    return all || !problems.refused();
}

void convert(GltfContext& context, const SideFiles& files, bool all) {
    listExtensions(context);
    for (const tinygltf::Buffer& buffer : context.model.buffers) {
        context.file.bufferBytes += buffer.data.size();
    }
    convertTextures(context);
    convertLights(context);
    for (const auto step : {convertMaterials, convertCameras, convertNodes, convertScenes,
                            convertEnvironments, convertMeshes, convertSkins, convertAnimations}) {
        step(context);
        if (!goOn(context.problems, all)) {
            return;
        }
    }
    loadImages(context, files, all);
    checkEnvironmentFaces(context);
}

/// The document and its buffers, checked. Nothing where nothing more can be said.
std::optional<std::vector<Bytes>> checkedBuffers(GltfSource& source, const SideFiles& files,
                                                 bool all, GltfProblems& problems) {
    checkRequired(source.document, problems);
    if (!goOn(problems, all) || !checkSchema(source.document, problems) || !goOn(problems, all)) {
        return std::nullopt;
    }
    std::vector<Bytes> buffers = loadBuffers(source, files, problems);
    if (!goOn(problems, all)) {
        return std::nullopt;
    }
    checkRanges(source.document, buffers, problems);
    if (!goOn(problems, all)) {
        return std::nullopt;
    }
    if (all) {
        checkRules(source.document, buffers, problems);
    }
    if (problems.refused()) {
        cutOutRefused(source.document, buffers, problems);
    }
    return buffers;
}

/// Every step of loading; `all` goes on behind a refusal as far as is safe.
core::Result<GltfFile> load(const std::filesystem::path& path, const GltfOptions& options, bool all,
                            GltfProblems& problems) {
    core::Result<Bytes> bytes = readFile(path);
    if (!bytes) {
        return bytes.error();
    }
    core::Result<GltfSource> source = readContainer(std::move(*bytes));
    if (!source) {
        return source.error();
    }
    core::Result<void> asset = checkAsset(source->document);
    if (!asset) {
        return asset.error();
    }
    core::Result<SideFiles> files = SideFiles::open(path, options.assetRoot);
    if (!files) {
        return files.error();
    }
    std::optional<std::vector<Bytes>> buffers = checkedBuffers(*source, *files, all, problems);
    if (!buffers) {
        return problems.first();
    }
    core::Result<tinygltf::Model> model = parseModel(source->document, std::move(*buffers));
    if (!model) {
        return model.error();
    }
    GltfFile file;
    GltfContext context{source->document, *model, file, problems};
    convert(context, *files, all);
    if (problems.refused()) {
        return problems.first();
    }
    return file;
}

} // namespace
} // namespace detail

bool GltfFile::extensionListed(const std::string& name) const {
    const auto in = [&](const std::vector<std::string>& names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    return in(extensionsUsed) || in(extensionsRequired);
}

core::Result<GltfFile> loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
    GltfProblems problems;
    core::Result<GltfFile> file = detail::load(path, options, false, problems);
    if (!file && !problems.refused()) {
        problems.refuse(file.error());
    }
    return file ? std::move(file) : core::inFile(problems.first(), path.string());
}

GltfCheck checkGltf(const std::filesystem::path& path, const GltfOptions& options) {
    GltfCheck check;
    core::Result<GltfFile> file = detail::load(path, options, true, check.problems);
    if (file) {
        check.file = std::move(*file);
    } else if (!check.problems.refused()) {
        check.problems.refuse(file.error());
    }
    return check;
}

} // namespace lodestar::io
