/* estimate.c - how far baked maps are from the exact ones: some texels done again with every light. */
#include "estimate.h"

#include "baseline.h"
#include "filter.h"
#include "parallel.h"
#include "sequence.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>

#define FRAMES 16            /* normals looked at; of a baseline map, where each texel has its own, texels */
#define POINTS_PER_FRAME 192 /* texels for each */
#define COSINE_MIN 0.15

/* One normal, the texels chosen for it, and what came out. */
typedef struct trial {
    const pe_cloud *cloud;
    const pe_maps *maps;
    const pe_lobe *lobe;
    const pe_head_on *head_on; /* NULL for maps of representative normals */
    int index;
    double error2, norm2;
    int failed;
} trial;

/* Adds the squared difference of one texel, looking along `world`, done again as `sums`. */
static void compare(trial *t, const double world[3], const float o[3], const float *baked, const double sums[4])
{
    double exact[3];

    pe_filter_radiance(t->lobe, t->cloud->env, sums, world, o, exact);
    for (int c = 0; c < 3; c++) {
        double difference = (double)baked[c] - exact[c];

        t->error2 += difference * difference;
        t->norm2 += exact[c] * exact[c];
    }
}

/* The texel of a trial's point k: evenly spread for any number of points. */
static void place_texel(const trial *t, int k, int *x, int *y)
{
    static const double middle[2] = { 0.5, 0.5 };
    double point[2];

    pe_lattice_point(t->index * POINTS_PER_FRAME + k, middle, point);
    *x = (int)(point[0] * t->maps->info.width);
    *y = (int)(point[1] * t->maps->info.height);
}

static void try_texels(trial *t, int image, const pe_frame *frame, const pe_lights *lights)
{
    for (int k = 0; k < POINTS_PER_FRAME; k++) {
        double world[3], sums[1][4];
        float o[1][3];
        int x, y;

        place_texel(t, k, &x, &y);
        pe_grid_direction(&t->maps->grid, x, y, world);
        if (!(pe_dot(frame->n, world) > COSINE_MIN))
            continue;
        pe_mirror_viewer(frame, world, o[0]);
        pe_filter_points(t->lobe, lights, (const float(*)[3])o, 1, sums);
        compare(t, world, o[0], pe_maps_image(t->maps, image) + 3 * (y * t->maps->info.width + x), sums[0]);
    }
}

static void try_normal(trial *t, pe_lights *lights)
{
    int vertex = (int)((long long)t->index * pe_geodesic_count(t->maps->geodesic) / FRAMES);
    pe_frame frame;

    pe_frame_make(pe_geodesic_vertex(t->maps->geodesic, vertex), t->maps->info.direction, &frame);
    pe_lights_fill(t->cloud, t->lobe, &frame, pe_lobe_reach(t->lobe, PE_LOBE_CUTOFF), lights);
    try_texels(t, vertex / 2, &frame, lights);
}

/* Of a baseline map, each texel has its own frame. */
static void try_baseline(trial *t)
{
    static const float head_on[3] = { 0, 0, 1 };

    for (int k = 0; k < POINTS_PER_FRAME / FRAMES && !t->failed; k++) {
        double world[1][3], sums[1][4];
        int x, y;

        place_texel(t, k, &x, &y);
        pe_grid_direction(&t->maps->grid, x, y, world[0]);
        t->failed = pe_head_on_filter(t->head_on, (const double(*)[3])world, 1, sums, NULL) != PE_OK;
        if (!t->failed)
            compare(t, world[0], head_on, pe_maps_image(t->maps, 0) + 3 * (y * t->maps->info.width + x), sums[0]);
    }
}

static void run_trial(size_t index, void *data)
{
    trial *t = (trial *)data + index;
    pe_lights lights;

    if (!t->maps->geodesic) {
        try_baseline(t);
        return;
    }
    t->failed = pe_lights_allocate(t->cloud, &lights, NULL) != PE_OK;
    if (t->failed)
        return;
    try_normal(t, &lights);
    pe_lights_free(&lights);
}

static double run_trials(trial trials[FRAMES], int threads, int *failed)
{
    double error2 = 0, norm2 = 0;

    pe_parallel_for(FRAMES, threads, run_trial, trials, NULL);
    for (int k = 0; k < FRAMES; k++) {
        *failed |= trials[k].failed;
        error2 += trials[k].error2;
        norm2 += trials[k].norm2;
    }
    return norm2 > 0 ? sqrt(error2 / norm2) : 0;
}

pe_status pe_estimate_error(const pe_env *env, const pe_maps *maps, const pe_lobe *lobe, int threads, double *estimate,
                            pe_error *error)
{
    trial trials[FRAMES];
    pe_head_on *head_on = NULL;
    pe_cloud cloud;
    double found;
    int failed = 0;
    pe_status status = pe_cloud_from_env(env, &cloud, error);

    if (status != PE_OK)
        return status;
    if (!maps->geodesic)
        status =
            pe_head_on_make(&cloud, lobe, maps->info.direction, pe_lobe_reach(lobe, PE_LOBE_CUTOFF), &head_on, error);
    if (status == PE_OK) {
        for (int k = 0; k < FRAMES; k++)
            trials[k] = (trial){ .cloud = &cloud, .maps = maps, .lobe = lobe, .head_on = head_on, .index = k };
        found = run_trials(trials, threads, &failed);
        if (failed)
            status = pe_fail_memory(error, "the estimate of the error");
        else
            *estimate = found;
    }
    pe_head_on_free(head_on);
    pe_cloud_free(&cloud);
    return status;
}
