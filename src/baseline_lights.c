/* baseline_lights.c - the lights of a cloud in blocks, each with the cone that holds it. */
#include "baseline_lights.h"

#include "status.h"

#include <stdlib.h>

void pe_block_set(pe_block *to, int lane, const double direction[3], const float values[4])
{
    for (int c = 0; c < 3; c++) {
        to->direction[c][lane] = direction[c];
        to->rounded[c][lane] = (float)direction[c];
    }
    for (int c = 0; c < 4; c++)
        to->values[c][lane] = values[c];
}

static void set_cloud_light(const pe_cloud *cloud, size_t light, pe_block *to, int lane)
{
    const double direction[3] = { cloud->x[light], cloud->y[light], cloud->z[light] };
    const float values[4] = { cloud->weight_sr[light], cloud->r[light], cloud->g[light], cloud->b[light] };

    pe_block_set(to, lane, direction, values);
}

void pe_block_direction(const pe_block *from, int lane, double direction[3])
{
    for (int c = 0; c < 3; c++)
        direction[c] = from->direction[c][lane];
}

void pe_block_pad(pe_block *to, int used)
{
    const float nothing[4] = { 0 };
    double direction[3];

    pe_block_direction(to, used - 1, direction);
    for (int lane = used; lane < LANES; lane++)
        pe_block_set(to, lane, direction, nothing);
}

void pe_cone_around(pe_cone *to, const double (*directions)[3], size_t count)
{
    double sum[3] = { 0 }, narrowest = 1;

    *to = (pe_cone){ { 0, 0, 1 }, M_PI, M_PI };
    for (size_t k = 0; k < count; k++)
        for (int c = 0; c < 3; c++)
            sum[c] += directions[k][c];
    if (!(pe_dot(sum, sum) > 1e-12))
        return;
    pe_normalize(sum, to->axis);
    for (size_t k = 0; k < count; k++)
        narrowest = fmin(narrowest, pe_dot(to->axis, directions[k]));
    to->radius = to->extent = acos(fmax(narrowest, -1)) + 1e-6;
}

/* The angle that a chord of the unit sphere is seen under. */
static double angle_of(double chord)
{
    return 2 * asin(fmin(chord / 2, 1));
}

static void set_block(pe_head_on *h, size_t index)
{
    double directions[LANES][3];
    size_t first = index * LANES;
    pe_cone *at = &h->cones[index];
    int used = 0;

    for (; used < LANES && first + (size_t)used < h->cloud->count; used++)
        set_cloud_light(h->cloud, first + (size_t)used, &h->blocks[index], used);
    pe_block_pad(&h->blocks[index], used);
    for (int lane = 0; lane < LANES; lane++)
        pe_block_direction(&h->blocks[index], lane, directions[lane]);
    pe_cone_around(at, (const double(*)[3])directions, LANES);
    for (int lane = 0; lane < used && h->takes_apart; lane++) {
        double apart = acos(fmin(pe_dot(at->axis, directions[lane]), 1));

        at->extent = fmax(at->extent, apart + angle_of((double)h->cloud->chord[first + (size_t)lane]));
    }
}

/* Beyond exp(-7), a thousandth of the mirror's weight, it does not matter on which side of a light the horizon is. */
#define LIMIT_OF_HORIZON 7

pe_status pe_head_on_make(const pe_cloud *cloud, const pe_lobe *lobe, const double direction[3], double lobe_reach,
                          pe_head_on **out, pe_error *error)
{
    pe_head_on *h = calloc(1, sizeof *h);

    if (!h)
        return pe_fail_memory(error, "the lights of a baseline map");
    *h = (pe_head_on){ .cloud = cloud,
                       .lobe = lobe,
                       .direction = { direction[0], direction[1], direction[2] },
                       .lobe_reach = lobe_reach,
                       .count = (cloud->count + LANES - 1) / LANES,
                       .takes_apart = cloud->chord && pe_lobe_reach(lobe, LIMIT_OF_HORIZON) > M_PI / 2 };
    h->blocks = aligned_alloc(64, h->count * sizeof *h->blocks);
    h->cones = malloc(h->count * sizeof *h->cones);
    if (!h->blocks || !h->cones) {
        pe_head_on_free(h);
        return pe_fail_memory(error, "the lights of a baseline map");
    }
    for (size_t k = 0; k < h->count; k++) {
        set_block(h, k);
        h->radius_max = fmax(h->radius_max, h->cones[k].radius);
    }
    *out = h;
    return PE_OK;
}

void pe_head_on_free(pe_head_on *h)
{
    if (!h)
        return;
    free(h->blocks);
    free(h->cones);
    free(h);
}
