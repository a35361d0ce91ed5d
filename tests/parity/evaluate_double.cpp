// SPDX-License-Identifier: MIT
#define LODESTAR_DOUBLE_PRECISION
#include "parity/evaluate_body.h"

std::vector<lodestar::testing::Evaluation> lodestar::testing::doubleEvaluations() {
    return lodestar::shader_double::evaluations();
}
