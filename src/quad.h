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

#endif
