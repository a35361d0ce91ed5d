// SPDX-License-Identifier: MIT
//
// A GLSL expression over a table of inputs, evaluated by the driver in 32-bit float: one pixel of a
// row a case, its inputs fetched from a float texture, its output read back unrounded.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

#include "core/result.h"
#include "gl/program.h"

namespace lodestar::testing {

/// Inputs of one case: p0 to p9 in the expression.
inline constexpr std::size_t kInputVectors = 10;
using GlslCase = std::array<glm::vec4, kInputVectors>;

class GlslFunction {
public:
    /// @param text whole declarations, version line first  @param expression a vec4 of p0 to p9
    /// @errors Internal with the driver's message
    [[nodiscard]] static core::Result<GlslFunction>
    make(gl::Device& device, int version, const std::string& text, const std::string& expression);

    /// Gives a sampler of the text its texture unit, which is not 0.
    void setSampler(const char* name, int unit) const { program_.setSampler(name, unit); }
    /// The expression's value for each case. @pre 1 to 4096 cases
    [[nodiscard]] std::vector<glm::vec4> evaluate(const std::vector<GlslCase>& cases);

private:
    gl::Device* device_ = nullptr;
    gl::Program program_;
};

} // namespace lodestar::testing
