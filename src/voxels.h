/* voxels.h - the multi-scale environment map: a cube of voxels whose direction from the centre is the mirror direction
 * and whose distance is the smoothness lambda. [Okumura 2.2, Fig. 2]
 *
 * Image z of the maps is the slice of all voxels (x, y, z), x along its rows.  Voxels out of a lookup's reach are
 * black. */
#ifndef PE_VOXELS_H
#define PE_VOXELS_H

#include "maps.h"
#include "weights.h"

/* By the table: [Okumura Eq. 14]. */
pe_status pe_fill_voxels(const pe_weights *weights, pe_lost_weight lost, const pe_env *env, int threads, pe_maps *maps,
                         pe_error *error);

/* Every texel of the environment for every voxel: [Okumura Eq. 8]. */
pe_status pe_fill_voxels_exactly(const pe_env *env, int threads, const pe_report *report, pe_maps *maps);

#endif
