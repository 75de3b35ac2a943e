/* hemispheres_strip.c - hemispheres of several environments at once: two normals by turns, all frames in the lanes. */
#include "hemispheres_strip.h"

#include "status.h"

#include <stdlib.h>
#include <string.h>

/* ---- two normals ---- */

pe_status pe_strip_cells_allocate(const pe_kernel *kernel, pe_strip_cells *cells, pe_error *error)
{
    for (int side = 0; side < 2; side++)
        cells->grid[side] = pe_kernel_allocate_cells(kernel);
    if (cells->grid[0] && cells->grid[1])
        return PE_OK;
    pe_strip_cells_free(cells);
    return pe_fail_memory(error, "grids of cells");
}

void pe_strip_cells_free(pe_strip_cells *cells)
{
    for (int side = 0; side < 2; side++)
        free(cells->grid[side]);
    *cells = (pe_strip_cells){ { NULL, NULL } };
}

void pe_strip_filter(const pe_strip *strip, const pe_kernel *kernel, const pe_frame frames[2],
                     const pe_strip_cells *cells, pe_kernel_lanes *function, void *data)
{
    const float *const grids[2] = { cells->grid[0], cells->grid[1] };

    for (int side = 0; side < 2; side++) {
        pe_kernel_clear_cells(kernel, cells->grid[side]);
        pe_strip_spread(strip, &frames[side], pe_kernel_disc(kernel), cells->grid[side]);
    }
    pe_kernel_apply_twice(kernel, grids, function, data);
}

/* Where no light has weight, what a mirror shows. */
static void reflect_in_mirror(const pe_strip *strip, const pe_lobe *lobe, const pe_frame *frame, const float o[3],
                              float rgb[PE_STRIP_FRAMES][3])
{
    const double local[3] = { -(double)o[0], -(double)o[1], (double)o[2] };
    const double no_sums[4] = { 0 };
    double world[3], shown[3];

    pe_frame_direction(frame, local, world);
    for (int k = 0; k < strip->count; k++) {
        pe_filter_radiance(lobe, strip->env[k], no_sums, world, o, shown);
        for (int c = 0; c < 3; c++)
            rgb[k][c] = (float)shown[c];
    }
}

void pe_strip_radiance(const pe_strip *strip, const pe_lobe *lobe, const pe_frame *frame, const float o[3],
                       const float sums[PE_STRIP_LANES], float rgb[PE_STRIP_FRAMES][3])
{
    float scale = 1 / sums[PE_STRIP_WEIGHT];

    if (!(sums[PE_STRIP_WEIGHT] > 0)) {
        reflect_in_mirror(strip, lobe, frame, o, rgb);
        return;
    }
    if (lobe->surface.weight == PE_WEIGHT_MICROFACET)
        scale *= (float)pe_lobe_albedo(lobe, (const double[3]){ (double)o[0], (double)o[1], (double)o[2] });
    for (int k = 0; k < PE_STRIP_FRAMES; k++)
        for (int c = 0; c < 3; c++)
            rgb[k][c] = sums[3 * k + c] > 0 ? scale * sums[3 * k + c] : 0;
}

/* ---- all ---- */

typedef struct job {
    const pe_strip *strip;
    const pe_lobe *lobe;
    const pe_kernel *kernel;
    pe_maps *const *maps; /* of each frame */
} job;

/* Two consecutive images; the last twice, where their count is odd. */
typedef struct pair {
    const job *job;
    int images[2];
    pe_frame frames[2];
} pair;

static void store(int place, const float o[3], const float (*sums)[PE_STRIP_LANES], void *data)
{
    const pair *p = data;
    const job *j = p->job;

    for (int side = 0; side < 2; side++) {
        float rgb[PE_STRIP_FRAMES][3];

        pe_strip_radiance(j->strip, j->lobe, &p->frames[side], o, sums[side], rgb);
        for (int k = 0; k < j->strip->count; k++)
            memcpy(pe_maps_image_to_fill(j->maps[k], p->images[side]) + 3 * place, rgb[k], sizeof rgb[k]);
    }
}

static int filter_pair(size_t index, void *data)
{
    const job *j = data;
    int last = j->maps[0]->info.images - 1, first = 2 * (int)index;
    pair p = { .job = j, .images = { first, first < last ? first + 1 : last } };
    pe_strip_cells cells;

    if (pe_strip_cells_allocate(j->kernel, &cells, NULL) != PE_OK)
        return 0;
    for (int side = 0; side < 2; side++)
        pe_maps_frame(j->maps[0], p.images[side], &p.frames[side]);
    pe_strip_filter(j->strip, j->kernel, p.frames, &cells, store, &p);
    pe_strip_cells_free(&cells);
    for (int k = 0; k < j->strip->count; k++)
        for (int image = first; image <= p.images[1]; image++)
            pe_disc_continue(&j->maps[k]->disc, pe_maps_image_to_fill(j->maps[k], image), 3);
    return 1;
}

pe_status pe_fill_hemispheres_of_strip(const pe_strip *strip, const pe_lobe *lobe, const pe_kernel *kernel, int threads,
                                       pe_report *report, pe_maps *const *maps, pe_error *error)
{
    size_t pairs = ((size_t)maps[0]->info.images + 1) / 2;
    job j = { strip, lobe, kernel, maps };

    report->total = (double)pairs;
    return pe_parallel_try(pairs, threads, filter_pair, &j, report, "grids of cells", error);
}
