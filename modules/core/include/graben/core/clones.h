#pragma once

/// Before the definition of a function: it is compiled for AVX2 too, and the processor chooses when the program starts.
///
/// Only for loops over plain arrays, in files that include neither Eigen nor PCL, whose types change their layout with the processor. Results
/// do not depend on the choice: AVX2 alone brings no fused multiplication and addition. Nothing where the compiler or the processor knows no
/// such choice, nor under sanitizers, which are not ready when it is made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GRABEN_AVX2_CLONE __attribute__((target_clones("avx2", "default")))
#else
#define GRABEN_AVX2_CLONE
#endif
