/* look.h - one bicubic lookup in one hemisphere: the innermost of what a renderer waits for. */
#ifndef PE_LOOK_H
#define PE_LOOK_H

#include "maps.h"
#include "quad.h"
#include "spline.h"

/* Beside a lamp narrower than its texels a spline swings below zero, which needs a coefficient below zero.  There a
 * lookup `sum`, so far right of and below the second coefficient of the second row, is not left lower than a lookup can
 * be: than the least texel about, or a quarter of the bilinear lookup.  The first coefficient is at `corner`, `step`
 * floats from the next and `stride` from the one below. */
pe_quad pe_look_beside_lamp(const float *corner, int step, int stride, float right, float below, pe_quad sum);

/* Where the 4 x 4 coefficients of up to four lookups are, and their shares: a lookup a lane. */
#define PE_AIMS 4

typedef struct pe_aims {
    _Alignas(pe_quad) float across[4][PE_AIMS];
    float down[4][PE_AIMS], right[PE_AIMS], below[PE_AIMS];
    const float *corners[PE_AIMS];
    int count;
} pe_aims;

/* At `count` images of hemispheres in directions of their frames, unit: x by x, y by y and z by z, and anything finite
 * beyond count.  Below the horizon: at the horizon.  The coefficients are on their way from memory then: whoever looks
 * at many images aims at all of them first. */
static inline void pe_look_aim(const pe_maps *maps, const int *images, int count, const pe_quad locals[3],
                               pe_aims *restrict aims)
{
    const pe_disc disc = maps->disc;
    int stride = 3 * disc.width, corners[PE_AIMS];

    for (int k = 0; k < PE_AIMS; k++) {
        const float direction[3] = { locals[0][k], locals[1][k], locals[2][k] };
        pe_disc_taps t;

        pe_disc_taps_at(&disc, direction, &t);
        corners[k] = (t.y - 1) * stride + 3 * (t.x - 1);
        aims->right[k] = t.right;
        aims->below[k] = t.below;
        for (int j = 0; j < 4; j++) {
            aims->across[j][k] = t.across[j];
            aims->down[j][k] = t.down[j];
        }
    }
    aims->count = count;
    for (int k = 0; k < count; k++) {
        const float *row = maps->coefficients + (size_t)images[k] * pe_maps_image_values(maps) + corners[k];

        aims->corners[k] = row;
        for (int j = 0; j < 4; j++, row += stride) {
            __builtin_prefetch(row);
            __builtin_prefetch(row + 11);
        }
    }
}

/* What lookup k shows: red, green, blue, and a fourth value without meaning. */
static inline pe_quad pe_look_at(const pe_maps *maps, const pe_aims *aims, int k)
{
    int stride = 3 * maps->info.width;
    const float *row = aims->corners[k];
    pe_quad sum = { 0, 0, 0, 0 };
    pe_quad_bits signs = { 0, 0, 0, 0 };

    for (int j = 0; j < 4; j++, row += stride) {
        pe_quad a = pe_quad_load(row), b = pe_quad_load(row + 3), c = pe_quad_load(row + 6), d = pe_quad_load(row + 9);

        sum += aims->down[j][k] *
               (aims->across[0][k] * a + aims->across[1][k] * b + aims->across[2][k] * c + aims->across[3][k] * d);
        signs |= (pe_quad_bits)a | (pe_quad_bits)b | (pe_quad_bits)c | (pe_quad_bits)d;
    }
    if ((signs[0] | signs[1] | signs[2]) < 0)
        sum = pe_look_beside_lamp(aims->corners[k], 3, stride, aims->right[k], aims->below[k], sum);
    return sum;
}

#endif
