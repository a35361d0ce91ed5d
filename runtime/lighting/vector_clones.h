// SPDX-License-Identifier: MIT
//
// For the inner loops: a function marked so is compiled for AVX2 with fused multiply-add and for
// the plain processor, and the loader picks one when the program starts. Results are the same from
// run to run on one machine; between the two they differ by rounding. Not under the thread
// sanitizer, whose runtime is not ready yet when the loader asks.
#pragma once

#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) &&         \
    !defined(__SANITIZE_THREAD__)
#define LODESTAR_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define LODESTAR_VECTOR_CLONES
#endif
