// SPDX-License-Identifier: MIT
#include "numerics/hazard_rows.h"

#include <limits>

#include "lodestar/cube.glsl"
#include "lodestar/display.glsl"
#include "lodestar/lobes.glsl"
#include "lodestar/power.glsl"
#include "lodestar/rsrm.glsl"
#include "lodestar/sg.glsl"
#include "lodestar/sh9.glsl"
#include "lodestar/sun.glsl"
#include "lodestar/taps.glsl"

namespace lodestar::shader {
namespace {

using lodestar::testing::GlslCase;
using lodestar::testing::HazardRow;

constexpr double u = 0x1p-23;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <class... Vectors>
GlslCase caseOf(const Vectors&... vectors) {
    GlslCase inputs{};
    std::size_t k = 0;
    ((inputs[k++] = vectors), ...);
    return inputs;
}

#define HAZARD_NOTHING(number, file, given, expected, bound, ...)
#define HAZARD_ROW(number, file, given, expected, bound, ...)                                      \
    rows.push_back({number, file, #__VA_ARGS__, caseOf given, expected, bound, 0.0});              \
    {                                                                                              \
        [[maybe_unused]] const vec4 p0(rows.back().inputs[0]), p1(rows.back().inputs[1]),          \
            p2(rows.back().inputs[2]);                                                             \
        rows.back().inCpp = static_cast<double>(__VA_ARGS__);                                      \
    }

void addFunctions(std::vector<HazardRow>& rows) {
#define HAZARD HAZARD_ROW
#define HAZARD_HOST HAZARD_NOTHING
#define HAZARD_RSRM HAZARD_NOTHING
#include "numerics/hazard_rows.inc"
#undef HAZARD
#undef HAZARD_HOST
}

#define LODESTAR_HOST_CLASS
#define HAZARD HAZARD_NOTHING

struct EnvironmentHost {
#include "lodestar/environment.glsl"
#include "numerics/hazard_hooks.glsl"
    void add(std::vector<HazardRow>& rows) {
#define HAZARD_HOST HAZARD_ROW
#include "numerics/hazard_rows.inc"
#undef HAZARD_HOST
#undef HAZARD_RSRM
    }
};

struct RsrmHost {
#include "lodestar/rsrm.glsl"
#include "numerics/hazard_rsrm_hooks.glsl"
    void add(std::vector<HazardRow>& rows) {
#define HAZARD_HOST HAZARD_NOTHING
#define HAZARD_RSRM HAZARD_ROW
#include "numerics/hazard_rows.inc"
    }
};

} // namespace
} // namespace lodestar::shader

std::vector<lodestar::testing::HazardRow> lodestar::testing::hazardRows() {
    std::vector<HazardRow> rows;
    shader::addFunctions(rows);
    shader::EnvironmentHost().add(rows);
    shader::RsrmHost().add(rows);
    return rows;
}
