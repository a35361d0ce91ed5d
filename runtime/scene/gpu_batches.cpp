// SPDX-License-Identifier: MIT
#include "scene/gpu_batches.h"

#include <algorithm>
#include <cstring>

#include <epoxy/gl.h>

#include "scene/gpu_scene.h"
#include "scene/programs.h"

namespace lodestar::scene {
namespace {

constexpr std::size_t kTexelsPerInstance = sizeof(Instance) / sizeof(glm::vec4);

} // namespace

std::size_t GpuInstances::pageSize(const gl::Device& device) {
    return std::max(static_cast<std::size_t>(device.capabilities().maxBufferTexels) /
                        kTexelsPerInstance,
                    std::size_t{1});
}

void GpuInstances::upload(gl::Device& device, std::span<const Instance> instances, Page& page) {
    std::vector<Instance>& uploaded = page.uploaded;
    const std::size_t both = std::min(instances.size(), uploaded.size());
    std::size_t first = 0;
    while (first < both && instances[first] == uploaded[first]) {
        ++first;
    }
    if (instances.size() > uploaded.size()) {
        page.buffer = gl::Buffer(device, gl::BufferKind::Texel, std::as_bytes(instances));
        unsigned id = 0;
        glGenTextures(1, &id);
        page.texture = gl::Texture::adopt(device, id, GL_TEXTURE_BUFFER);
        page.texture.bind(kInstanceUnit);
        glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, page.buffer.id());
        uploaded.assign(instances.begin(), instances.end());
        return;
    }
    std::size_t end = instances.size();
    while (end > first && instances[end - 1] == uploaded[end - 1]) {
        --end;
    }
    if (end > first) {
        const auto changed = instances.subspan(first, end - first);
        page.buffer.updatePart(first * sizeof(Instance), std::as_bytes(changed));
        std::copy(changed.begin(), changed.end(),
                  uploaded.begin() + static_cast<std::ptrdiff_t>(first));
    }
    // What lies behind is still there: the buffer holds as many as ever.
}

void GpuInstances::upload(gl::Device& device, const std::vector<Instance>& instances) {
    pageSize_ = pageSize(device);
    bound_ = kNone;
    const std::span<const Instance> all(instances);
    for (std::size_t first = 0; first < all.size(); first += pageSize_) {
        const std::size_t page = first / pageSize_;
        if (page == pages_.size()) {
            pages_.emplace_back();
        }
        upload(device, all.subspan(first, std::min(pageSize_, all.size() - first)), pages_[page]);
    }
}

std::size_t GpuInstances::bind(std::size_t instance) {
    const std::size_t page = instance / pageSize_;
    if (bound_ != page) {
        bound_ = page;
        pages_[page].texture.bind(kInstanceUnit);
    }
    return instance % pageSize_;
}

void GpuMaterials::prepare(gl::Device& device, const Scene& scene,
                           const std::optional<MaterialOverride>& values) {
    if (written_ && written_->values == values && !stale_) {
        return;
    }
    const auto alignment = static_cast<std::size_t>(device.capabilities().uniformAlignment);
    count_ = scene.materials.size();
    stride_ = (sizeof(blocks::LodestarMaterial) + alignment - 1) / alignment * alignment;
    std::vector<std::byte> bytes((count_ + 1) * stride_);
    for (std::size_t i = 0; i <= count_; ++i) {
        const blocks::LodestarMaterial block =
            materialBlock(i < count_ ? scene.materials[i] : io::GltfMaterial{}, values);
        std::memcpy(bytes.data() + i * stride_, &block, sizeof block);
    }
    if (written_) {
        buffer_.update(bytes);
    } else {
        buffer_ = gl::Buffer(device, gl::BufferKind::Uniform, bytes);
    }
    written_ = Written{values};
    stale_ = false;
}

void GpuMaterials::bind(int material) const {
    const std::size_t index = material == io::kNone ? count_ : static_cast<std::size_t>(material);
    buffer_.bindBlock(kMaterialBinding, index * stride_, sizeof(blocks::LodestarMaterial));
}

} // namespace lodestar::scene
