/* pairs_strip.c - see pairs_strip.h.
 *
 * The two hemispheres of an image are filtered side by side, made splines of, and looked up for all frames at once. */
#include "pairs_strip.h"

#include "lanes.h"
#include "spline.h"
#include "status.h"

#include <stdlib.h>

typedef struct job {
    const pe_strip *strip;
    const pe_kernel *kernel;
    pe_disc disc; /* of the hemispheres */
    const pe_suns *suns;
    pe_denominator *denominator; /* NULL where no frame has suns */
    pe_maps *const *maps;
    unsigned char *failed; /* of each image */
} job;

/* An image's two hemispheres: lanes of every texel. */
typedef struct image {
    const job *job;
    pe_frame frames[2];
    float *sides[2];
} image;

/* ---- filter ---- */

static void store(int place, const float o[3], const float (*sums)[PE_STRIP_LANES], void *data)
{
    const image *i = data;

    for (int side = 0; side < 2; side++) {
        float rgb[PE_STRIP_FRAMES][3] = { { 0 } };

        pe_strip_radiance(i->job->strip, &i->frames[side], o, sums[side], rgb);
        memcpy(i->sides[side] + (size_t)PE_STRIP_LANES * (size_t)place, rgb, sizeof rgb);
    }
}

static int filter_sides(image *i)
{
    const job *j = i->job;
    pe_strip_cells cells;

    if (pe_strip_cells_allocate(j->kernel, &cells, NULL) != PE_OK)
        return 0;
    pe_strip_filter(j->strip, j->kernel, i->frames, &cells, store, i);
    pe_strip_cells_free(&cells);
    for (int side = 0; side < 2; side++) {
        pe_disc_continue(&j->disc, i->sides[side], PE_STRIP_LANES);
        pe_spline_coefficients(i->sides[side], j->disc.width, j->disc.height, PE_STRIP_LANES);
    }
    return 1;
}

/* ---- look up ---- */

CLONES static void look(const float *corner, int width, const pe_disc_taps *t, float lanes[LANES])
{
    floats sum = { 0 };

    for (int j = 0; j < 4; j++, corner += LANES * width)
        sum += t->down[j] * (t->across[0] * load(corner) + t->across[1] * load(corner + LANES) +
                             t->across[2] * load(corner + 2 * LANES) + t->across[3] * load(corner + 3 * LANES));
    memcpy(lanes, &sum, sizeof sum);
}

static void look_at(const image *i, int side, const double world[3], float lanes[LANES])
{
    const pe_disc *disc = &i->job->disc;
    float toward[3];
    double local[3];
    pe_disc_taps t;

    pe_frame_coordinates(&i->frames[side], world, local);
    for (int c = 0; c < 3; c++)
        toward[c] = (float)local[c];
    pe_disc_taps_at(disc, toward, &t);
    look(i->sides[side] + (size_t)LANES * (size_t)((t.y - 1) * disc->width + t.x - 1), disc->width, &t, lanes);
}

static void add_suns(const image *i, int side, int frame, const double world[3], const float shown[3], float *out)
{
    const job *j = i->job;
    const pe_maps_info *info = &j->maps[frame]->info;
    double o[3], rgb[3];

    for (int c = 0; c < 3; c++)
        rgb[c] = fmax((double)shown[c], 0);
    if (j->suns[frame].count) {
        pe_reflect(world, i->frames[side].n, o);
        pe_suns_add(&j->suns[frame], &info->surface, j->denominator, info->direction, i->frames[side].n, o, rgb);
    }
    for (int c = 0; c < 3; c++)
        out[c] = (float)rgb[c];
}

static void look_up_image(const image *i, int index)
{
    const pe_maps *first = i->job->maps[0];
    int width = first->info.width, texels = width * first->info.height;

    for (int texel = 0; texel < texels; texel++) {
        float lanes[LANES];
        double world[3];
        int side;

        pe_grid_direction(&first->grid, texel % width, texel / width, world);
        side = !(pe_dot(world, i->frames[0].n) > 0);
        look_at(i, side, world, lanes);
        for (int k = 0; k < i->job->strip->count; k++)
            add_suns(i, side, k, world, lanes + 3 * k,
                     pe_maps_image_to_fill(i->job->maps[k], index) + (size_t)3 * (size_t)texel);
    }
}

/* ---- all ---- */

static float *allocate_side(const pe_disc *disc)
{
    return aligned_alloc(LANES * sizeof(float), (size_t)disc->width * (size_t)disc->height * LANES * sizeof(float));
}

static void fill_image(size_t index, void *data)
{
    const job *j = data;
    image i = { .job = j, .sides = { allocate_side(&j->disc), allocate_side(&j->disc) } };

    for (int side = 0; side < 2; side++)
        pe_frame_make(pe_geodesic_vertex(j->maps[0]->geodesic, 2 * (int)index + side), j->maps[0]->info.direction,
                      &i.frames[side]);
    j->failed[index] = !i.sides[0] || !i.sides[1] || !filter_sides(&i);
    if (!j->failed[index])
        look_up_image(&i, (int)index);
    free(i.sides[0]);
    free(i.sides[1]);
}

static int any_suns(const pe_strip *strip, const pe_suns *suns)
{
    int any = 0;

    for (int k = 0; k < strip->count; k++)
        any |= suns[k].count;
    return any;
}

static pe_status fill_images(job *j, int threads, pe_report *report, pe_error *error)
{
    size_t images = (size_t)j->maps[0]->info.images;
    pe_status status;

    report->total = (double)images;
    status = pe_parallel_for(images, threads, fill_image, j, report);
    for (size_t k = 0; status == PE_OK && k < images; k++)
        if (j->failed[k])
            status = pe_fail_memory(error, "the hemispheres of an image");
    return status;
}

pe_status pe_fill_pairs_of_strip(const pe_strip *strip, const pe_kernel *kernel, const pe_suns *suns, int threads,
                                 pe_report *report, pe_maps *const *maps, pe_error *error)
{
    job j = { strip, kernel, *pe_kernel_map(kernel), suns, NULL, maps, calloc((size_t)maps[0]->info.images, 1) };
    pe_status status = PE_OK;

    if (!j.failed)
        return pe_fail_memory(error, "a table of images");
    if (any_suns(strip, suns))
        status = pe_denominator_make(&maps[0]->info.surface.ndf, &j.denominator, error);
    if (status == PE_OK)
        status = fill_images(&j, threads, report, error);
    pe_denominator_free(j.denominator);
    free(j.failed);
    return status;
}
