/* kernel.h - the one kernel that all normals share.
 *
 * In its own tangent frame every normal filters alike: the weight D(h) of the light w for the viewer o depends on w and
 * o alone.  So it is worked out once, for every texel of a hemisphere's picture, as a cubic B-spline over a grid of
 * cells of the hemisphere; spreading a normal's lights over the cells with the same spline's shares, what was a loop
 * over lights with an exponential each becomes a sum of products over a few hundred cells. */
#ifndef PE_KERNEL_H
#define PE_KERNEL_H

#include "disc.h"
#include "filter.h"
#include "parallel.h"

typedef struct pe_kernel pe_kernel;

/* The grid of cells that carries a lobe with the relative error wanted. */
pe_disc pe_kernel_cells(const pe_lobe *lobe, double wanted);

/* Is a kernel for maps of this size of use?  It is a table of D alone, has to be held in memory, and must not take
 * longer to make than to do without. */
int pe_kernel_suits(const pe_lobe *lobe, const pe_disc *cells, int width, int height);

/* The report, or NULL, may cancel. */
pe_status pe_kernel_make(const pe_lobe *lobe, const pe_disc *map, const pe_disc *cells, int threads,
                         const pe_report *report, pe_kernel **kernel, pe_error *error);
void pe_kernel_free(pe_kernel *kernel); /* NULL is allowed */

/* Normals that are filtered together: in every cell, weight, red, green and blue of each, one after the other. */
#define PE_KERNEL_GROUP 4

/* The pictures that it is for. */
const pe_disc *pe_kernel_map(const pe_kernel *kernel);

/* The grid of cells; and one of 16 floats each for a group, to be freed, without values until it is cleared.  NULL if
 * there is no memory. */
const pe_disc *pe_kernel_disc(const pe_kernel *kernel);
float *pe_kernel_allocate_cells(const pe_kernel *kernel);
void pe_kernel_clear_cells(const pe_kernel *kernel, float *cells);

/* Adds lights in the tangent frame of the group's normal `member` to zeroed cells. */
void pe_kernel_spread(const pe_kernel *kernel, const pe_lights *lights, int member, float *cells);

/* For every texel on the hemisphere, in order, calls the function with its place in the picture, its viewer o in the
 * tangent frame, and for each of the group sums as from pe_filter_points. */
typedef void pe_kernel_texel(int place, const float o[3], const double (*sums)[4], void *data);
void pe_kernel_apply(const pe_kernel *kernel, const float *cells, pe_kernel_texel *function, void *data);

/* The same for two grids whose 16 lanes mean something else, which takes less time than one after the other. */
typedef void pe_kernel_lanes(int place, const float o[3], const float (*sums)[16], void *data);
void pe_kernel_apply_twice(const pe_kernel *kernel, const float *const cells[2], pe_kernel_lanes *function, void *data);

#endif
