// SPDX-License-Identifier: MIT
//
// Programs from the embedded shader text, compiler messages mapped back to file and line.
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "gl/device.h"
#include "gl/shader_source.h"

namespace lodestar::gl {

/// A linked program of a vertex and a fragment shader. Move-only.
class Program {
public:
    Program() = default;
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    ~Program();

    /// @errors Internal with the driver's first message, as FILE: message (line)
    [[nodiscard]] static core::Result<Program> make(Device& device, std::string_view vertexFile,
                                                    std::string_view fragmentFile,
                                                    const Defines& defines);
    /// The same from whole texts.
    [[nodiscard]] static core::Result<Program> makeFromText(Device& device,
                                                            const std::string& vertex,
                                                            const std::string& fragment,
                                                            const std::string& label);

    [[nodiscard]] unsigned id() const { return id_; }
    [[nodiscard]] explicit operator bool() const { return id_ != 0; }
    void use() const;
    /// Location of a uniform, -1 if the program has none of that name.
    [[nodiscard]] int uniform(const char* name) const;
    /// Gives a sampler its texture unit; does nothing where the program has no such sampler.
    void setSampler(const char* name, int unit) const;
    /// Gives a uniform block its binding point; does nothing where the program lacks the block.
    void setBlock(const char* name, unsigned binding) const;

private:
    Device* device_ = nullptr;
    unsigned id_ = 0;
};

} // namespace lodestar::gl
