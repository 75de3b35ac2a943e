/* pyramid.h - an environment at half its size, again and again, each texel the mean of four by solid angle. */
#ifndef PE_PYRAMID_H
#define PE_PYRAMID_H

#include "env.h"

#define PE_PYRAMID_LEVELS_MAX 16

typedef struct pe_pyramid {
    int count;
    const pe_env *levels[PE_PYRAMID_LEVELS_MAX]; /* the first is the environment itself */
    pe_env *own[PE_PYRAMID_LEVELS_MAX];
} pe_pyramid;

/* Halves until texels are wider than `pitch` (radians, at the equator) or a side is odd. */
pe_status pe_pyramid_make(const pe_env *env, double pitch, pe_pyramid *pyramid, pe_error *error);
void pe_pyramid_free(pe_pyramid *pyramid);

/* The smallest whose texels are not wider than `pitch`; if there is none, the environment itself. */
const pe_env *pe_pyramid_level(const pe_pyramid *pyramid, double pitch);

#endif
