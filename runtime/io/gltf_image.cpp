// SPDX-License-Identifier: MIT
//
// A document's images. A missing or damaged one is no reason to refuse a scene: it becomes one
// white texel, counted with its reason.
#include <algorithm>

#include "io/gltf_internal.h"
#include "io/image_file.h"

namespace lodestar::io::detail {
namespace {

core::Image white() {
    core::Image image(1, 1, 4);
    std::fill(image.pixels().begin(), image.pixels().end(), 1.0f);
    return image;
}

core::Error tooMuch(const std::string& at) {
    return core::refused("images take more than " + std::to_string(kMaxImageBytes >> 20) + " MiB",
                         at);
}

/// The encoded bytes: a buffer view's (its range was checked), a data: URI's or a file's.
core::Result<Bytes> encodedImage(const GltfContext& context, const Json& json,
                                 const SideFiles& files) {
    if (const Json* index = member(json, "bufferView")) {
        const tinygltf::BufferView& view = context.model.bufferViews[index->get<std::size_t>()];
        const Bytes& buffer = context.model.buffers[static_cast<std::size_t>(view.buffer)].data;
        const auto begin = buffer.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
        return Bytes(begin, begin + static_cast<std::ptrdiff_t>(view.byteLength));
    }
    const Json* uri = member(json, "uri");
    if (uri == nullptr) {
        return core::refused("it has neither uri nor bufferView");
    }
    return files.read(uri->get_ref<const std::string&>(), kMaxFileBytes);
}

} // namespace

void loadImages(GltfContext& context, const SideFiles& files, bool decode) {
    Budget encodedLeft(kMaxImageBytes);
    Budget decodedLeft(kMaxImageBytes);
    for (std::size_t i = 0; i < memberSize(context.document, "images"); ++i) {
        GltfImageInfo& described = context.file.imageInfos.emplace_back();
        if (const Json* name = member(context.document["images"][i], "name")) {
            described.name = name->get<std::string>();
        }
        if (!decode) {
            context.file.images.emplace_back();
            continue;
        }
        const std::string at = pointer("/images", i);
        const auto useWhite = [&](const core::Error& error) {
            context.file.warnings.add("image " + std::to_string(i) +
                                      " taken as white: " + error.message());
            context.file.images.push_back(white());
            context.problems.repaired("image taken as white: " + error.message(), at);
        };
        if (!context.problems.clean(at)) {
            context.file.images.push_back(white());
            continue;
        }
        core::Result<Bytes> bytes = encodedImage(context, context.document["images"][i], files);
        if (!bytes) {
            useWhite(bytes.error());
            continue;
        }
        if (!encodedLeft.spend(bytes->size())) {
            context.problems.refuse(tooMuch(at));
            return;
        }
        core::Result<ImageInfo> info = imageInfo(*bytes);
        if (!info) {
            useWhite(info.error());
            continue;
        }
        described.format = info->format;
        described.width = info->width;
        described.height = info->height;
        described.channels = info->channels;
        if (!decodedLeft.spend(static_cast<std::size_t>(info->width) *
                               static_cast<std::size_t>(info->height) * 4 * sizeof(float))) {
            context.problems.refuse(tooMuch(at));
            return;
        }
        core::Result<DecodedImage> image = decodeImage(*bytes, 4);
        if (!image) {
            useWhite(image.error());
            continue;
        }
        context.file.images.push_back(std::move(image->image));
    }
}

} // namespace lodestar::io::detail
