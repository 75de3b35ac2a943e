/* pairs.h - lat-long maps, each shared by a normal and its opposite, half each. [Motegi 3.1, Fig. 3b] */
#ifndef PE_PAIRS_H
#define PE_PAIRS_H

#include "filter.h"
#include "maps.h"
#include "parallel.h"

/* Fills every image of maps with [Motegi Eq. 5] over the lights of the cloud.  lobe: the maps' surface;
 * lobe_reach: as for pe_lights_fill. */
pe_status pe_fill_pairs(const pe_cloud *cloud, const pe_lobe *lobe, double lobe_reach, int threads, pe_report *report,
                        pe_maps *maps, pe_error *error);

/* Fills every image of maps with what finished hemispheres of the same normals, surface and direction show. */
pe_status pe_fill_pairs_from_hemispheres(const pe_maps *hemispheres, int threads, const pe_report *report,
                                         pe_maps *maps);

#endif
