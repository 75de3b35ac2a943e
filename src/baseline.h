/* baseline.h - one map, every texel seen head on: the lobe as at normal incidence, whatever the direction.
 * [Motegi Fig. 3a] */
#ifndef PE_BASELINE_H
#define PE_BASELINE_H

#include "filter.h"
#include "maps.h"
#include "parallel.h"

/* A cloud of lights arranged for viewers who look along the normal, n = o = w.  Immutable once made. */
typedef struct pe_head_on pe_head_on;

/* lobe_reach: as for pe_lights_fill.  cloud and lobe must outlive it. */
pe_status pe_head_on_make(const pe_cloud *cloud, const pe_lobe *lobe, const double direction[3], double lobe_reach,
                          pe_head_on **head_on, pe_error *error);
void pe_head_on_free(pe_head_on *head_on); /* NULL is allowed */

#define PE_HEAD_ON_POINTS_MAX 64 /* most directions in one call */

/* sums[k]: as from pe_filter_points, of the unit direction world[k].  The nearer the directions are to each other, the
 * less there is to do. */
pe_status pe_head_on_filter(const pe_head_on *head_on, const double (*world)[3], size_t count, double (*sums)[4],
                            pe_error *error);

/* Fills the one image of baseline maps. */
pe_status pe_baseline_fill(const pe_head_on *head_on, pe_maps *maps, int threads, const pe_report *report,
                           pe_error *error);

#endif
