/* hemispheres_strip.h - hemispheres of several environments at once. */
#ifndef PE_HEMISPHERES_STRIP_H
#define PE_HEMISPHERES_STRIP_H

#include "kernel.h"
#include "maps.h"
#include "parallel.h"
#include "strip.h"

/* What pe_fill_hemispheres_by_kernel does, approximately, for every frame of a strip; maps[k] is frame k's.  Each
 * frame's have the same bits whatever the others are. */
pe_status pe_fill_hemispheres_of_strip(const pe_strip *strip, const pe_lobe *lobe, const pe_kernel *kernel, int threads,
                                       pe_report *report, pe_maps *const *maps, pe_error *error);

/* ---- in steps ---- */

/* Room for two normals. */
typedef struct pe_strip_cells {
    float *grid[2];
} pe_strip_cells;

pe_status pe_strip_cells_allocate(const pe_kernel *kernel, pe_strip_cells *cells, pe_error *error);
void pe_strip_cells_free(pe_strip_cells *cells);

/* Calls the function, for every texel of the kernel's map, with the sums of two normals' lanes. */
void pe_strip_filter(const pe_strip *strip, const pe_kernel *kernel, const pe_frame frames[2],
                     const pe_strip_cells *cells, pe_kernel_lanes *function, void *data);

/* What the viewer o sees in each frame, from one normal's sums. */
void pe_strip_radiance(const pe_strip *strip, const pe_lobe *lobe, const pe_frame *frame, const float o[3],
                       const float sums[PE_STRIP_LANES], float rgb[PE_STRIP_FRAMES][3]);

#endif
