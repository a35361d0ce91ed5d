// SPDX-License-Identifier: MIT
//
// What is known of the current OpenGL context, and the counters of work done in it. Every object of
// this room is made for a Device and counts through it, so that "nothing was done" can be proven.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"

namespace lodestar::gl {

/// Work done since the device was made. All are totals; a frame's are differences.
struct WorkCounters {
    std::uint64_t draws = 0;
    std::uint64_t passes = 0;        ///< framebuffer bindings with draws to follow
    std::uint64_t texelsWritten = 0; ///< by uploads, mipmap calls and passes (viewport area)
    std::uint64_t uploads = 0;       ///< texture and buffer uploads
    std::uint64_t uploadBytes = 0;
    std::uint64_t programSwitches = 0;
    std::uint64_t shaderCompilations = 0;
    std::uint64_t stateQueries = 0;
    std::uint64_t probeFaces = 0;   ///< of light probes, drawn
    std::uint64_t textureBytes = 0; ///< alive now, not a total
    std::uint64_t glErrors = 0;     ///< debug messages of type error, where the driver has them

    bool operator==(const WorkCounters&) const = default;
};

/// The work between two readings; textureBytes is the later reading's.
[[nodiscard]] WorkCounters difference(const WorkCounters& later, const WorkCounters& earlier);

struct Capabilities {
    int version = 33; ///< major * 10 + minor
    std::string renderer;
    std::string vendor;
    bool software = false; ///< draws on the processor: Mesa's llvmpipe or softpipe
    bool debugOutput = false;
    int maxTextureSize = 0;
    int maxCubeSize = 0;
    int maxBufferTexels = 0;  ///< of a buffer texture
    int uniformAlignment = 1; ///< of a uniform block's offset in its buffer, bytes
};

/// The current context. Must outlive every object made for it, and is used on its thread only.
class Device {
public:
    /// Reads the capabilities of the current context and hooks its debug output.
    /// @errors NoOpenGl if there is no current context of version 3.3
    [[nodiscard]] static core::Result<std::unique_ptr<Device>> create();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device();

    [[nodiscard]] const Capabilities& capabilities() const { return capabilities_; }
    /// Uses no more texels of a buffer texture than that: as on a driver that has no more.
    void limitBufferTexels(int most) {
        capabilities_.maxBufferTexels = std::min(capabilities_.maxBufferTexels, most);
    }
    /// Has no memory for targets beyond that many bytes of textures: as a device that has no more.
    void limitTargetBytes(std::uint64_t most) { targetBytes_ = most; }
    [[nodiscard]] bool hasBytesFor(std::uint64_t bytes) const {
        return counters_.textureBytes + bytes <= targetBytes_;
    }
    [[nodiscard]] WorkCounters& counters() { return counters_; }
    /// The texts of GL errors and undefined behaviour reported so far.
    [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

    /// Binds a program unless it is bound already; counts the switch.
    void useProgram(unsigned program);
    /// Forgets the bound program, for a program about to be deleted.
    void forgetProgram(unsigned program);
    /// Notes a debug message (called by the driver's callback).
    void note(std::string message);

private:
    Device() = default;
    Capabilities capabilities_;
    WorkCounters counters_;
    std::vector<std::string> messages_;
    unsigned boundProgram_ = 0;
    std::uint64_t targetBytes_ = std::numeric_limits<std::uint64_t>::max();
};

} // namespace lodestar::gl
