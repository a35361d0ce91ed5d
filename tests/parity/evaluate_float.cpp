// SPDX-License-Identifier: MIT
#include "parity/evaluate_body.h"

std::vector<lodestar::testing::Evaluation> lodestar::testing::floatEvaluations() {
    return lodestar::shader::evaluations();
}
