/* voxels.c - see voxels.h. */
#include "voxels.h"

#include "lanes.h"
#include "status.h"

#include <stdlib.h>

/* ---- by the table ---- */

#define VOXELS_PER_TURN 256

typedef struct job {
    const pe_weights *weights;
    pe_lost_weight lost;
    float *values[PE_DOMES]; /* what the domes show */
    pe_maps *maps;
} job;

_Static_assert(PE_DOME_VALUES == 5 * LANES, "the sums below are five vectors");

/* [Okumura Eq. 14] for a voxel and its images, side by side. */
CLONES static void gather(const float *values, const uint32_t *vertex, const float *weight, size_t count,
                          float sums[PE_DOME_VALUES])
{
    floats sum[5] = { { 0 } };

    for (size_t k = 0; k < count; k++) {
        const float *from = values + (size_t)vertex[k] * PE_DOME_VALUES;

        for (int v = 0; v < 5; v++)
            sum[v] += weight[k] * load(from + v * LANES);
    }
    memcpy(sums, sum, sizeof sum);
}

static float *voxel_at(pe_maps *maps, const int at[3])
{
    return pe_maps_image_to_fill(maps, at[2]) + 3 * (at[1] * maps->info.width + at[0]);
}

static void fill_voxel(const job *j, size_t k)
{
    const pe_weights *w = j->weights;
    const int at[3] = { w->voxels[k].at[0], w->voxels[k].at[1], w->voxels[k].at[2] };
    float sums[PE_DOME_VALUES], scale = j->lost == PE_LOST_DARK ? w->kept[k] : 1;

    gather(j->values[w->voxels[k].dome], w->vertex + w->first[k], w->weight + w->first[k],
           (size_t)(w->first[k + 1] - w->first[k]), sums);
    for (int g = 0; g < PE_DOME_IMAGES; g++) {
        int image[3];
        float *voxel;

        pe_dome_image(g, w->scale.size, at, image);
        voxel = voxel_at(j->maps, image);
        for (int c = 0; c < 3; c++)
            voxel[c] = scale * sums[3 * g + c];
    }
}

static void fill_voxels(size_t turn, void *data)
{
    const job *j = data;
    size_t end = (turn + 1) * VOXELS_PER_TURN;

    for (size_t k = turn * VOXELS_PER_TURN; k < end && k < j->weights->count; k++)
        fill_voxel(j, k);
}

/* A dome reads the level of the pyramid whose texels are a little closer than its vertices. */
#define TEXEL_PER_PITCH 0.75

static pe_status fill_domes(job *j, const pe_pyramid *pyramid, int threads, pe_error *error)
{
    for (int d = 0; d < PE_DOMES; d++) {
        const pe_dome *dome = &j->weights->domes[d];
        double pitch;

        if (!dome->count)
            continue;
        pitch = sqrt(4 * M_PI / dome->count * 2 / sqrt(3));
        j->values[d] = malloc((size_t)dome->count * PE_DOME_VALUES * sizeof *j->values[d]);
        if (!j->values[d])
            return pe_fail_memory(error, "a dome");
        pe_dome_fill(dome, pe_pyramid_level(pyramid, TEXEL_PER_PITCH * pitch), threads, j->values[d]);
    }
    return PE_OK;
}

pe_status pe_fill_voxels(const pe_weights *weights, pe_lost_weight lost, const pe_env *env, int threads, pe_maps *maps,
                         pe_error *error)
{
    job j = { .weights = weights, .lost = lost, .maps = maps };
    pe_pyramid pyramid;
    pe_status status = pe_pyramid_make(env, TEXEL_PER_PITCH * pe_dome_pitch(9), &pyramid, error);

    if (status != PE_OK)
        return status;
    status = fill_domes(&j, &pyramid, threads, error);
    if (status == PE_OK)
        status =
            pe_parallel_for((weights->count + VOXELS_PER_TURN - 1) / VOXELS_PER_TURN, threads, fill_voxels, &j, NULL);
    for (int d = 0; d < PE_DOMES; d++)
        free(j.values[d]);
    pe_pyramid_free(&pyramid);
    return status;
}

/* ---- exactly ---- */

typedef struct exact_job {
    const pe_env *env;
    pe_maps *maps;
} exact_job;

static void fill_row(size_t row, void *data)
{
    const exact_job *j = data;
    int size = j->maps->info.width;

    for (int x = 0; x < size; x++) {
        const int at[3] = { x, (int)row % size, (int)row / size };
        double t[3], lambda, rgb[3];

        pe_voxel_centre(size, at, t);
        lambda = sqrt(pe_dot(t, t));
        if (lambda > pe_voxel_reach(size))
            continue;
        pe_phong(j->env, pe_smoothness_exponent(&j->maps->info.smoothness, lambda), PE_HORIZON_IGNORED, NULL, t, rgb);
        for (int c = 0; c < 3; c++)
            voxel_at(j->maps, at)[c] = (float)rgb[c];
    }
}

pe_status pe_fill_voxels_exactly(const pe_env *env, int threads, const pe_report *report, pe_maps *maps)
{
    exact_job j = { env, maps };
    size_t rows = (size_t)maps->info.width * (size_t)maps->info.width;

    return pe_parallel_for(rows, threads, fill_row, &j, report);
}
