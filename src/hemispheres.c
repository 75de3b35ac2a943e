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
    unsigned char *done; /* memory sufficed for this image */
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

static void filter_image(size_t k, void *data)
{
    job *j = data;
    float *image = pe_maps_image_to_fill(j->maps, (int)k);
    pe_lights lights;
    pe_frame frame;

    if (pe_lights_allocate(j->cloud, &lights, NULL) != PE_OK)
        return;
    pe_maps_frame(j->maps, (int)k, &frame);
    pe_lights_fill(j->cloud, j->lobe, &frame, j->lobe_reach, &lights);
    filter_texels(j, &frame, &lights, image);
    pe_disc_continue(&j->maps->disc, image);
    pe_lights_free(&lights);
    j->done[k] = 1;
}

pe_status pe_fill_hemispheres(const pe_cloud *cloud, const pe_lobe *lobe, double lobe_reach, int threads,
                              const pe_report *report, pe_maps *maps, pe_error *error)
{
    job j = { .cloud = cloud, .lobe = lobe, .lobe_reach = lobe_reach, .maps = maps };
    pe_status status = make_texels(&maps->disc, &j.texels, error);

    if (status != PE_OK)
        return status;
    j.done = calloc((size_t)maps->info.images, sizeof *j.done);
    if (j.done)
        status = pe_parallel_for((size_t)maps->info.images, threads, filter_image, &j, report);
    else
        status = pe_fail_memory(error, "a table of images");
    for (int k = 0; status == PE_OK && k < maps->info.images; k++)
        if (!j.done[k])
            status = pe_fail_memory(error, "a hemisphere of lights");
    free(j.done);
    free_texels(&j.texels);
    return status;
}
