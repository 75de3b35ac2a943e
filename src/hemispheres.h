/* hemispheres.h - maps of hemispheres, each in its normal's own tangent frame. */
#ifndef PE_HEMISPHERES_H
#define PE_HEMISPHERES_H

#include "filter.h"
#include "kernel.h"
#include "maps.h"
#include "parallel.h"

/* Fills every image of maps: each texel is [Motegi Eq. 5] for its vertex's normal over the lights of the cloud.
 * lobe: the maps' surface; lobe_reach: as for pe_lights_fill. */
pe_status pe_fill_hemispheres(const pe_cloud *cloud, const pe_lobe *lobe, double lobe_reach, int threads,
                              const pe_report *report, pe_maps *maps, pe_error *error);

/* The same, approximately, by a kernel made for the lobe and maps of this size. */
pe_status pe_fill_hemispheres_by_kernel(const pe_cloud *cloud, const pe_lobe *lobe, const pe_kernel *kernel,
                                        int threads, const pe_report *report, pe_maps *maps, pe_error *error);

#endif
