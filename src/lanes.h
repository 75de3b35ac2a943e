/* lanes.h - vectors of 16 floats of GCC's vector extension, which become AVX-512, AVX2 or SSE2: every lane does its own
 * sums, so that the bits are the same for any number of threads.  For files with a hot loop alone: its names are as
 * short as theirs. */
#ifndef PE_LANES_H
#define PE_LANES_H

#include <string.h>

#define LANES 16

/* Vectors never cross a function that is not inlined, so how they would be passed does not matter. */
#pragma GCC diagnostic ignored "-Wpsabi"

typedef float floats __attribute__((vector_size(4 * LANES)));
typedef int ints __attribute__((vector_size(4 * LANES)));
typedef unsigned unsigneds __attribute__((vector_size(4 * LANES)));

/* Before a function with a hot loop.  Contraction makes a product and a sum one rounding where the processor can, which
 * is worth half as much speed again; bits then depend on the processor, and with SAME_CLONES they do not.
 * ThreadSanitizer starts after the resolvers of target_clones run, and crashes in them. */
#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__) && !defined(PE_NO_TARGET_CLONES)
#define SAME_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define CLONES SAME_CLONES __attribute__((optimize("fp-contract=fast")))
#else
#define SAME_CLONES
#define CLONES
#endif

#define INLINE static inline __attribute__((always_inline))

INLINE floats load(const float *from)
{
    floats v;

    memcpy(&v, from, sizeof v);
    return v;
}

/* e becomes 2^-e for 0 <= e <= cutoff, 0 beyond, anything below 0.  2^k 2^f with k whole and |f| <= 1/2, 2^f by the
 * polynomial of degree 6 through 2^f at f = 0 and at six Chebyshev points (relative error below 1e-8). */
INLINE void exp2_of_negative(floats *e, float cutoff)
{
    const float round_to_whole = 12582912.0f; /* 1.5 * 2^23: adding it leaves the whole part in the low bits */
    ints inside = *e <= cutoff;
    floats near = (floats)((ints)*e & inside);
    floats shifted = round_to_whole - near;
    floats f = -near - (shifted - round_to_whole);
    unsigneds k = (unsigneds)shifted << 23;
    floats p = 0.000154531634f * f + 0.00133908633f;

    p = p * f + 0.00961808302f;
    p = p * f + 0.0555035695f;
    p = p * f + 0.240226507f;
    p = p * f + 0.693147182f;
    p = p * f + 1.0f;
    *e = (floats)(((unsigneds)p + k) & (unsigneds)inside);
}

#endif
