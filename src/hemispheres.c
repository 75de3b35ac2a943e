/* hemispheres.c - see hemispheres.h.
 *
 * In their own frames all hemispheres have the same texels, and so the same viewers: made once, used by all. */
#include "hemispheres.h"

#include "status.h"

#include <stdlib.h>

/* The texels on the hemisphere: where they are in the picture, and who sees them in a mirror. */
typedef struct texels {
    size_t count;
    int *index;
    float (*o)[3];
} texels;

typedef struct job {
    const pe_cloud *cloud;
    const pe_lobe *lobe;
    double lobe_reach;
    texels texels;
    pe_maps *maps;
} job;

static void free_texels(texels *t)
{
    free(t->index);
    free(t->o);
}

static pe_status make_texels(const pe_disc *disc, texels *t, pe_error *error)
{
    size_t room = (size_t)disc->width * (size_t)disc->height;

    t->count = 0;
    t->index = malloc(room * sizeof *t->index);
    t->o = malloc(room * sizeof *t->o);
    if (!t->index || !t->o) {
        free_texels(t);
        *t = (texels){ 0 };
        return pe_fail_memory(error, "the texels of a hemisphere");
    }
    for (int k = 0; k < (int)room; k++) {
        double w[3];

        if (!pe_disc_direction(disc, k % disc->width, k / disc->width, w))
            continue;
        t->index[t->count] = k;
        t->o[t->count][0] = (float)-w[0];
        t->o[t->count][1] = (float)-w[1];
        t->o[t->count][2] = (float)w[2];
        t->count++;
    }
    return PE_OK;
}

static void store(const job *j, const pe_frame *frame, const float o[3], const double sums[4], float *out)
{
    const double local[3] = { -(double)o[0], -(double)o[1], (double)o[2] };
    double world[3], rgb[3];

    pe_frame_direction(frame, local, world);
    pe_filter_radiance(j->lobe, j->cloud->env, sums, world, o, rgb);
    for (int c = 0; c < 3; c++)
        out[c] = (float)rgb[c];
}

static void filter_texels(const job *j, const pe_frame *frame, const pe_lights *lights, float *image)
{
    const texels *t = &j->texels;

    for (size_t begin = 0; begin < t->count; begin += PE_FILTER_POINTS_MAX) {
        size_t count = t->count - begin < PE_FILTER_POINTS_MAX ? t->count - begin : PE_FILTER_POINTS_MAX;
        double sums[PE_FILTER_POINTS_MAX][4];

        pe_filter_points(j->lobe, lights, (const float(*)[3])t->o + begin, count, sums);
        for (size_t k = 0; k < count; k++)
            store(j, frame, t->o[begin + k], sums[k], image + 3 * t->index[begin + k]);
    }
}

static int filter_image(size_t k, void *data)
{
    job *j = data;
    float *image = pe_maps_image_to_fill(j->maps, (int)k);
    pe_lights lights;
    pe_frame frame;

    if (pe_lights_allocate(j->cloud, &lights, NULL) != PE_OK)
        return 0;
    pe_maps_frame(j->maps, (int)k, &frame);
    pe_lights_fill(j->cloud, j->lobe, &frame, j->lobe_reach, &lights);
    filter_texels(j, &frame, &lights, image);
    pe_disc_continue(&j->maps->disc, image, 3);
    pe_lights_free(&lights);
    return 1;
}

pe_status pe_fill_hemispheres(const pe_cloud *cloud, const pe_lobe *lobe, double lobe_reach, int threads,
                              const pe_report *report, pe_maps *maps, pe_error *error)
{
    job j = { .cloud = cloud, .lobe = lobe, .lobe_reach = lobe_reach, .maps = maps };
    pe_status status = make_texels(&maps->disc, &j.texels, error);

    if (status != PE_OK)
        return status;
    status =
        pe_parallel_try((size_t)maps->info.images, threads, filter_image, &j, report, "a hemisphere of lights", error);
    free_texels(&j.texels);
    return status;
}

/* ---- by a kernel ---- */

typedef struct kernel_job {
    const pe_cloud *cloud;
    const pe_lobe *lobe;
    const pe_kernel *kernel;
    pe_maps *maps;
} kernel_job;

/* A group of images with consecutive numbers. */
typedef struct group {
    const kernel_job *job;
    int first, count;
    pe_frame frames[PE_KERNEL_GROUP];
} group;

static void store_group(int place, const float o[3], const double (*sums)[4], void *data)
{
    const group *g = data;
    const kernel_job *j = g->job;
    const double local[3] = { -(double)o[0], -(double)o[1], (double)o[2] };

    for (int k = 0; k < g->count; k++) {
        float *out = pe_maps_image_to_fill(j->maps, g->first + k) + 3 * place;
        double world[3], rgb[3];

        pe_frame_direction(&g->frames[k], local, world);
        pe_filter_radiance(j->lobe, j->cloud->env, sums[k], world, o, rgb);
        for (int c = 0; c < 3; c++)
            out[c] = (float)fmax(rgb[c], 0);
    }
}

static void filter_group(group *g, pe_lights *lights, float *cells)
{
    const kernel_job *j = g->job;

    pe_kernel_clear_cells(j->kernel, cells);
    for (int k = 0; k < g->count; k++) {
        pe_maps_frame(j->maps, g->first + k, &g->frames[k]);
        pe_lights_fill(j->cloud, j->lobe, &g->frames[k], M_PI, lights);
        pe_kernel_spread(j->kernel, lights, k, cells);
    }
    pe_kernel_apply(j->kernel, cells, store_group, g);
    for (int k = 0; k < g->count; k++)
        pe_disc_continue(&j->maps->disc, pe_maps_image_to_fill(j->maps, g->first + k), 3);
}

static int run_group(size_t index, void *data)
{
    kernel_job *j = data;
    group g = { .job = j, .first = (int)index * PE_KERNEL_GROUP };
    float *cells = pe_kernel_allocate_cells(j->kernel);
    pe_lights lights = { 0 };
    int enough = cells && pe_lights_allocate(j->cloud, &lights, NULL) == PE_OK;

    g.count = j->maps->info.images - g.first < PE_KERNEL_GROUP ? j->maps->info.images - g.first : PE_KERNEL_GROUP;
    if (enough)
        filter_group(&g, &lights, cells);
    pe_lights_free(&lights);
    free(cells);
    return enough;
}

pe_status pe_fill_hemispheres_by_kernel(const pe_cloud *cloud, const pe_lobe *lobe, const pe_kernel *kernel,
                                        int threads, const pe_report *report, pe_maps *maps, pe_error *error)
{
    size_t groups = ((size_t)maps->info.images + PE_KERNEL_GROUP - 1) / PE_KERNEL_GROUP;
    kernel_job j = { cloud, lobe, kernel, maps };

    return pe_parallel_try(groups, threads, run_group, &j, report, "a grid of cells", error);
}
