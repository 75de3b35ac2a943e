/* fis.h - a rival without a bake: filtered importance sampling. [Křivánek] */
#ifndef FIS_H
#define FIS_H

#include "prefenv.h"

/* An environment, each level half as wide and high as the one before. */
typedef struct fis_pyramid fis_pyramid;

fis_pyramid *fis_pyramid_make(const pe_env *env); /* or the program ends */
void fis_pyramid_free(fis_pyramid *pyramid);

/* [Motegi Eq. 4] for a Beckmann surface, from `samples` half vectors drawn from its distribution, each of which looks
 * up as large a part of the environment as falls to it. */
void fis_reflect(const fis_pyramid *pyramid, const double alpha[2], const double direction[3], int samples,
                 const double n[3], const double o[3], double rgb[3]);

#endif
