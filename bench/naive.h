/* naive.h - the bake as anyone would write it down, to be beaten. */
#ifndef NAIVE_H
#define NAIVE_H

#include "prefenv.h"

/* [Motegi Eq. 5] for one normal: for each of `count` viewers o[k] (unit, world, o.n > 0) the mean of the environment's
 * texels of the hemisphere of n, weighted by D(h) and solid angle.  Float, one thread. */
void naive_filter(const pe_env *env, double alpha, const float n[3], const float (*o)[3], int count, float (*rgb)[3]);

#endif
