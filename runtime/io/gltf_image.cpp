// SPDX-License-Identifier: MIT
//
// A document's images: those that something shows, decoded side by side. A missing or damaged one
// is no reason to refuse a scene: it becomes one white texel, counted with its reason.
#include <algorithm>

#include "core/parallel.h"
#include "io/gltf_internal.h"
#include "io/image_file.h"

namespace lodestar::io::detail {
namespace {

core::Texels white() {
    core::Texels texels(1, 1);
    texels.bytes().assign(4, 255);
    return texels;
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

/// By image: whether a texture or an image-based light shows it.
std::vector<bool> shownImages(const GltfFile& file, std::size_t count) {
    std::vector<bool> shown(count);
    const auto show = [&](int image) {
        if (image != kNone && static_cast<std::size_t>(image) < count) {
            shown[static_cast<std::size_t>(image)] = true;
        }
    };
    for (const GltfTexture& texture : file.textures) {
        show(texture.image);
    }
    for (const GltfEnvironment& environment : file.environments) {
        std::for_each(environment.faces.begin(), environment.faces.end(), show);
    }
    return shown;
}

/// An image on its way to texels.
struct Encoded {
    std::size_t image = 0;
    Bytes bytes;
    core::Result<core::Texels> texels = core::Texels();
};

/// Reads and measures the images in order, within the limits; nothing where one is exceeded.
class Reader {
public:
    Reader(GltfContext& context, const SideFiles& files) : context_(context), files_(files) {}

    /// False where the images' limit is exceeded, which is refused then.
    bool read(std::size_t i) {
        const std::string at = pointer("/images", i);
        if (!context_.problems.clean(at)) {
            context_.file.images[i] = white();
            return true;
        }
        core::Result<Bytes> bytes = encodedImage(context_, context_.document["images"][i], files_);
        if (!bytes) {
            useWhite(i, bytes.error());
            return true;
        }
        const bool few = encodedLeft_.spend(bytes->size());
        const core::Result<ImageInfo> info = imageInfo(*bytes);
        if (few && !info) {
            useWhite(i, info.error());
            return true;
        }
        if (!few || !decodedLeft_.spend(static_cast<std::size_t>(info->width) *
                                        static_cast<std::size_t>(info->height) *
                                        (info->bits == 8 ? 4 : 8))) {
            context_.problems.refuse(tooMuch(at));
            return false;
        }
        describe(i, *info);
        encoded_.push_back({i, std::move(*bytes)});
        return true;
    }

    /// Reads an image that nothing shows, for what is wrong with it, and keeps nothing.
    void tryOut(std::size_t i) {
        const std::string at = pointer("/images", i);
        if (!context_.problems.clean(at)) {
            return;
        }
        const auto report = [&](const core::Error& error) {
            context_.problems.repaired(
                "image cannot be read, and nothing shows it: " + error.message(), at);
        };
        const core::Result<Bytes> bytes =
            encodedImage(context_, context_.document["images"][i], files_);
        if (!bytes) {
            report(bytes.error());
            return;
        }
        if (const core::Result<ImageInfo> info = imageInfo(*bytes)) {
            describe(i, *info);
        }
        if (const core::Result<core::Texels> texels = decodeTexels(*bytes); !texels) {
            report(texels.error());
        }
    }

    /// Decodes on as many threads as there are processors, and tells what failed in order.
    void decode() {
        core::inParallel(
            encoded_.size(),
            [&](std::size_t i) {
                encoded_[i].texels = decodeTexels(encoded_[i].bytes);
                encoded_[i].bytes = {};
            },
            {}, kMaxThreads);
        for (Encoded& image : encoded_) {
            if (image.texels) {
                context_.file.images[image.image] = std::move(*image.texels);
            } else {
                useWhite(image.image, image.texels.error());
            }
        }
    }

private:
    /// Each thread holds one image's working memory.
    static constexpr std::size_t kMaxThreads = 8;

    void describe(std::size_t i, const ImageInfo& info) {
        GltfImageInfo& described = context_.file.imageInfos[i];
        described.format = info.format;
        described.width = info.width;
        described.height = info.height;
        described.channels = info.channels;
    }

    void useWhite(std::size_t i, const core::Error& error) {
        context_.file.warnings.add("image " + std::to_string(i) +
                                   " taken as white: " + error.message());
        context_.file.images[i] = white();
        context_.problems.repaired("image taken as white: " + error.message(),
                                   pointer("/images", i));
    }

    GltfContext& context_;
    const SideFiles& files_;
    Budget encodedLeft_{kMaxImageBytes};
    Budget decodedLeft_{kMaxImageBytes};
    std::vector<Encoded> encoded_;
};

} // namespace

void loadImages(GltfContext& context, const SideFiles& files, bool all) {
    const std::size_t count = memberSize(context.document, "images");
    context.file.images.resize(count);
    context.file.imageInfos.resize(count);
    const std::vector<bool> shown = shownImages(context.file, count);
    Reader reader(context, files);
    for (std::size_t i = 0; i < count; ++i) {
        if (const Json* name = member(context.document["images"][i], "name")) {
            context.file.imageInfos[i].name = name->get<std::string>();
        }
        if (shown[i] && !reader.read(i)) {
            return;
        }
        if (!shown[i] && all) {
            reader.tryOut(i);
        }
    }
    reader.decode();
}

} // namespace lodestar::io::detail
