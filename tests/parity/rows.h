// SPDX-License-Identifier: MIT
//
// The rows of the parity table: every function of shaders/lodestar once, environment.glsl's once a
// value of LODESTAR_SPECULAR. Evaluations in C++ stand in the order of parityRows().
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

#include "support/glsl_function.h"

namespace lodestar::testing {

/// One error bound a channel.
using Tolerance = std::array<double, 4>;

inline constexpr int kSpecularVariants = 8;

struct ParityRow {
    std::string function;
    const char* file;
    int specular; ///< LODESTAR_SPECULAR
    const char* expression;
    std::vector<GlslCase> (*cases)();
    /// How far the driver may be from the exact value of the case.
    Tolerance (*tolerance)(const GlslCase& inputs, const glm::dvec4& exactValue, int specular);
    const char* helpers; ///< the file of hooks and arguments that the text needs, null for none
};

[[nodiscard]] std::vector<ParityRow> parityRows();

using Evaluation = glm::dvec4 (*)(const GlslCase& inputs);
[[nodiscard]] std::vector<Evaluation> floatEvaluations();
[[nodiscard]] std::vector<Evaluation> doubleEvaluations();

} // namespace lodestar::testing
