/* lobe.h - a surface made ready for filtering: what depends on it alone, worked out once. */
#ifndef PE_LOBE_H
#define PE_LOBE_H

#include "ndf.h"
#include "prefenv.h"

typedef struct pe_lobe {
    pe_surface surface;
    /* in single precision: what p^2 and q^2 are multiplied with - 1 / alpha^2, times log2(e) before an exponential - */
    float x, y;
    float scale_x, scale_y, offset_x, offset_y; /* or, for a table, the way from slopes to places in it */
} pe_lobe;

/* A table's must outlive it.  Release with pe_lobe_free. */
pe_status pe_lobe_make(const pe_surface *surface, int threads, pe_lobe **lobe, pe_error *error);
void pe_lobe_free(pe_lobe *lobe); /* NULL is allowed */

/* The angle from the mirror direction beyond which half vectors are steeper than pe_ndf_reach; at most pi.  A half
 * vector moves by at least half of what its light moves, since midpoints on a sphere are never nearer than half. */
double pe_lobe_reach(const pe_lobe *lobe, double limit);

#endif
