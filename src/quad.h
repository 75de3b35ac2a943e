/* quad.h - four floats at once, by GCC's vector extension: what every processor that this is built for has. */
#ifndef PE_QUAD_H
#define PE_QUAD_H

#include <string.h>

typedef float pe_quad __attribute__((vector_size(16)));
typedef int pe_quad_bits __attribute__((vector_size(16)));

/* From anywhere.  Of a texel of three channels: these and one float more, which is ignored. */
static inline pe_quad pe_quad_load(const float *from)
{
    pe_quad v;

    memcpy(&v, from, sizeof v);
    return v;
}

static inline void pe_quad_store(float *to, pe_quad v)
{
    memcpy(to, &v, sizeof v);
}

/* The columns of four rows. */
static inline void pe_quad_transpose(const pe_quad rows[4], pe_quad columns[4])
{
    pe_quad a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
    pe_quad b = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
    pe_quad c = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
    pe_quad d = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);

    columns[0] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
    columns[1] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
    columns[2] = __builtin_shufflevector(c, d, 0, 1, 4, 5);
    columns[3] = __builtin_shufflevector(c, d, 2, 3, 6, 7);
}

#endif
