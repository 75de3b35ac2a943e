/* estimate.h - how far baked maps are from the exact ones. */
#ifndef PE_ESTIMATE_H
#define PE_ESTIMATE_H

#include "lobe.h"
#include "maps.h"

/* Relative L2 error of the maps' texels with n.r > 0.15 against [Motegi Eq. 5] over every texel of env: the root of
 * sum |baked - exact|^2 / sum |exact|^2 over a fixed, even choice of a few thousand of them. */
pe_status pe_estimate_error(const pe_env *env, const pe_maps *maps, const pe_lobe *lobe, int threads, double *estimate,
                            pe_error *error);

#endif
