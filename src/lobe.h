/* lobe.h - a surface made ready for filtering: what depends on it alone, worked out once. */
#ifndef PE_LOBE_H
#define PE_LOBE_H

#include "ndf.h"
#include "prefenv.h"

#define PE_REFLECTANCE_TERMS 8

typedef struct pe_lobe {
    pe_surface surface;
    /* in single precision: what p^2 and q^2 are multiplied with - 1 / alpha^2, times log2(e) before an exponential - */
    float x, y;
    float scale_x, scale_y, offset_x, offset_y; /* or, for a table, the way from slopes to places in it */
    float gain;                                 /* and what its D is multiplied with, to be at most 1 */
    /* PE_WEIGHT_MICROFACET: reflectance as a polynomial of 2 c (1 + d) / (c + d) - 1, c = o.h and d the knee; and
     * pe_directional_albedo of viewers, places from grazing to straight above for each of `azimuths` around */
    float knee, reflectance[3][PE_REFLECTANCE_TERMS];
    int azimuths;
    float *albedo;
} pe_lobe;

/* A table's must outlive it.  Release with pe_lobe_free. */
pe_status pe_lobe_make(const pe_surface *surface, int threads, pe_lobe **lobe, pe_error *error);
void pe_lobe_free(pe_lobe *lobe); /* NULL is allowed */

/* What the tangents' viewer o sees in a white furnace of F = 1: from the table, cubic between its places. */
double pe_lobe_albedo(const pe_lobe *lobe, const double o[3]);

/* The angle from the mirror direction beyond which half vectors are steeper than pe_ndf_reach; at most pi.  A half
 * vector moves by at least half of what its light moves, since midpoints on a sphere are never nearer than half. */
double pe_lobe_reach(const pe_lobe *lobe, double limit);

#endif
