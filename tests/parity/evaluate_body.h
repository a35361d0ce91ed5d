// SPDX-License-Identifier: MIT
//
// The C++ side of the rows, included once a precision.
#define LODESTAR_RSRM_ROWS 1
#include "lodestar/cube.glsl"
#include "lodestar/display.glsl"
#include "lodestar/lobes.glsl"
#include "lodestar/power.glsl"
#include "lodestar/probes.glsl"
#include "lodestar/reference.glsl"
#include "lodestar/rsrm.glsl"
#include "lodestar/sg.glsl"
#include "lodestar/sh9.glsl"
#include "lodestar/sun.glsl"
#include "lodestar/taps.glsl"

#include "parity/rows.h"

#define PARITY_INPUTS                                                                              \
    [[maybe_unused]] const vec4 p0(p[0]), p1(p[1]), p2(p[2]), p3(p[3]), p4(p[4]), p5(p[5]),        \
        p6(p[6]), p7(p[7]), p8(p[8]), p9(p[9]);

namespace lodestar::LODESTAR_NAMESPACE {
namespace {

using lodestar::testing::Evaluation;
using lodestar::testing::GlslCase;

#define PARITY_ROW(function, file, cases, tolerance, ...)                                          \
    glm::dvec4 row_##function(const GlslCase& p) {                                                 \
        PARITY_INPUTS                                                                              \
        return glm::dvec4(__VA_ARGS__);                                                            \
    }
#include "parity/function_rows.inc"
#undef PARITY_ROW

#define PARITY_ROW(function, file, cases, tolerance, ...)                                          \
    glm::dvec4 row_##function(const GlslCase& p) {                                                 \
        PARITY_INPUTS                                                                              \
        return glm::dvec4(__VA_ARGS__);                                                            \
    }
#define LODESTAR_HOST_CLASS
struct Host0 {
#define LODESTAR_SPECULAR 0
#include "lodestar/environment.glsl"
#include "parity/environment_rows.inc"
#include "parity/helpers.glsl"
#undef LODESTAR_SPECULAR
};
struct Host1 {
#define LODESTAR_SPECULAR 1
#include "lodestar/environment.glsl"
#include "parity/environment_rows.inc"
#include "parity/helpers.glsl"
#undef LODESTAR_SPECULAR
};
struct Host2 {
#define LODESTAR_SPECULAR 2
#include "lodestar/environment.glsl"
#include "parity/environment_rows.inc"
#include "parity/helpers.glsl"
#undef LODESTAR_SPECULAR
};
struct Host3 {
#define LODESTAR_SPECULAR 3
#include "lodestar/environment.glsl"
#include "parity/environment_rows.inc"
#include "parity/helpers.glsl"
#undef LODESTAR_SPECULAR
};
struct Host4 {
#define LODESTAR_SPECULAR 4
#include "lodestar/environment.glsl"
#include "parity/environment_rows.inc"
#include "parity/helpers.glsl"
#undef LODESTAR_SPECULAR
};
struct Host5 {
#define LODESTAR_SPECULAR 5
#include "lodestar/environment.glsl"
#include "parity/environment_rows.inc"
#include "parity/helpers.glsl"
#undef LODESTAR_SPECULAR
};
struct Host6 {
#define LODESTAR_SPECULAR 6
#include "lodestar/environment.glsl"
#include "parity/environment_rows.inc"
#include "parity/helpers.glsl"
#undef LODESTAR_SPECULAR
};
struct Host7 {
#define LODESTAR_SPECULAR 7
#include "lodestar/environment.glsl"
#include "parity/environment_rows.inc"
#include "parity/helpers.glsl"
#undef LODESTAR_SPECULAR
};
struct RsrmHost {
#include "lodestar/rsrm.glsl"
#include "parity/rsrm_helpers.glsl"
#include "parity/rsrm_rows.inc"
};
#undef LODESTAR_HOST_CLASS
#undef PARITY_ROW

template <class Host>
void addHost(std::vector<Evaluation>& rows) {
#define PARITY_ROW(function, file, cases, tolerance, ...)                                          \
    rows.push_back([](const GlslCase& p) { return Host().row_##function(p); });
#include "parity/environment_rows.inc"
#undef PARITY_ROW
}

std::vector<Evaluation> evaluations() {
    std::vector<Evaluation> rows;
#define PARITY_ROW(function, file, cases, tolerance, ...) rows.push_back(row_##function);
#include "parity/function_rows.inc"
#undef PARITY_ROW
    addHost<Host0>(rows);
    addHost<Host1>(rows);
    addHost<Host2>(rows);
    addHost<Host3>(rows);
    addHost<Host4>(rows);
    addHost<Host5>(rows);
    addHost<Host6>(rows);
    addHost<Host7>(rows);
#define PARITY_ROW(function, file, cases, tolerance, ...)                                          \
    rows.push_back([](const GlslCase& p) { return RsrmHost().row_##function(p); });
#include "parity/rsrm_rows.inc"
#undef PARITY_ROW
    return rows;
}

} // namespace
} // namespace lodestar::LODESTAR_NAMESPACE
