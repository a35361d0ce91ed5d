// SPDX-License-Identifier: MIT
#include "scene/gpu_batches.h"

#include <cstring>
#include <span>
#include <string>

#include <epoxy/gl.h>

#include "scene/gpu_scene.h"
#include "scene/programs.h"

namespace lodestar::scene {
namespace {

constexpr std::size_t kTexelsPerInstance = sizeof(Instance) / sizeof(glm::vec4);

std::span<const std::byte> bytesOf(const Instance* first, std::size_t count) {
    return std::as_bytes(std::span(first, count));
}

} // namespace

core::Result<void> GpuInstances::upload(gl::Device& device, std::vector<Instance> instances) {
    const auto most = static_cast<std::size_t>(device.capabilities().maxBufferTexels);
    if (instances.size() * kTexelsPerInstance > most) {
        return core::Error{core::ErrorCode::NoOpenGl,
                           std::to_string(instances.size()) +
                               " draws are visible, the driver's buffer textures hold " +
                               std::to_string(most / kTexelsPerInstance),
                           {},
                           {}};
    }
    const std::size_t both = std::min(instances.size(), uploaded_.size());
    std::size_t first = 0;
    while (first < both && instances[first] == uploaded_[first]) {
        ++first;
    }
    std::size_t end = instances.size();
    if (instances.size() > uploaded_.size()) {
        buffer_ =
            gl::Buffer(device, gl::BufferKind::Texel, bytesOf(instances.data(), instances.size()));
        unsigned id = 0;
        glGenTextures(1, &id);
        texture_ = gl::Texture::adopt(device, id, GL_TEXTURE_BUFFER);
        texture_.bind(kInstanceUnit);
        glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_.id());
    } else {
        while (end > first && instances[end - 1] == uploaded_[end - 1]) {
            --end;
        }
        if (end > first) {
            buffer_.updatePart(first * sizeof(Instance), bytesOf(&instances[first], end - first));
        }
        // What lies behind is still there: the buffer holds as many as ever.
        instances.insert(instances.end(), uploaded_.begin() + static_cast<std::ptrdiff_t>(both),
                         uploaded_.end());
    }
    uploaded_ = std::move(instances);
    return {};
}

void GpuInstances::bind() const {
    if (texture_) {
        texture_.bind(kInstanceUnit);
    }
}

void GpuMaterials::prepare(gl::Device& device, const Scene& scene,
                           const std::optional<MaterialOverride>& values) {
    if (written_ && written_->values == values) {
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
}

void GpuMaterials::bind(int material) const {
    const std::size_t index = material == io::kNone ? count_ : static_cast<std::size_t>(material);
    buffer_.bindBlock(kMaterialBinding, index * stride_, sizeof(blocks::LodestarMaterial));
}

} // namespace lodestar::scene
