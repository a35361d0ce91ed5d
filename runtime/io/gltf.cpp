// SPDX-License-Identifier: MIT
#include "io/gltf.h"

#include "io/gltf_internal.h"

namespace lodestar::io {
namespace detail {
namespace {

constexpr std::size_t kMaxMessage = 300;

void shorten(std::string& text) {
    if (text.size() > kMaxMessage) {
        text.resize(kMaxMessage);
        text += "...";
    }
}

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

core::Result<GltfFile> convert(const Json& document, const tinygltf::Model& model,
                               const SideFiles& files, bool decodeImages) {
    GltfFile file;
    GltfContext context{document, model, file};
    listExtensions(context);
    convertTextures(context);
    convertLights(context);
    for (const auto step : {convertMaterials, convertCameras, convertNodes, convertScenes,
                            convertMeshes, convertSkins, convertAnimations}) {
        core::Result<void> done = step(context);
        if (!done) {
            return done.error();
        }
    }
    core::Result<void> images = loadImages(context, files, decodeImages);
    if (!images) {
        return images.error();
    }
    return file;
}

core::Result<GltfFile> load(const std::filesystem::path& path, const GltfOptions& options) {
    core::Result<Bytes> bytes = readFile(path);
    if (!bytes) {
        return bytes.error();
    }
    core::Result<GltfSource> source = readContainer(std::move(*bytes));
    if (!source) {
        return source.error();
    }
    for (const auto check : {checkAsset, checkSchema}) {
        core::Result<void> checked = check(source->document);
        if (!checked) {
            return checked.error();
        }
    }
    core::Result<SideFiles> files = SideFiles::open(path, options.assetRoot);
    if (!files) {
        return files.error();
    }
    core::Result<std::vector<Bytes>> buffers = loadBuffers(*source, *files);
    if (!buffers) {
        return buffers.error();
    }
    core::Result<void> ranges = checkRanges(source->document, *buffers);
    if (!ranges) {
        return ranges.error();
    }
    core::Result<tinygltf::Model> model = parseModel(source->document, std::move(*buffers));
    if (!model) {
        return model.error();
    }
    return convert(source->document, *model, *files, options.decodeImages);
}

} // namespace
} // namespace detail

core::Result<GltfFile> loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
    core::Result<GltfFile> file = detail::load(path, options);
    if (!file) {
        core::Error error = core::inFile(file.error(), path.string());
        detail::shorten(error.what);
        detail::shorten(error.where);
        return error;
    }
    return file;
}

} // namespace lodestar::io
