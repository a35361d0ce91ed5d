/* SPDX-License-Identifier: MIT
 *
 * The header of light probes in C alone: its sizes are the same on both sides.
 */
#include "lodestar/lodestar_probes.h"

size_t lodestar_test_sizesInC(size_t* frame, size_t* draw, size_t* job, size_t* pair) {
    *frame = sizeof(LodestarProbeFrame);
    *draw = sizeof(LodestarProbeDraw);
    *job = sizeof(LodestarProbeJob);
    *pair = sizeof(LodestarDrawProbes);
    return sizeof(LodestarProbeDesc) + sizeof(LodestarProbesApi);
}
