/* look.h - one bicubic lookup in one hemisphere: the innermost of what a renderer waits for. */
#ifndef PE_LOOK_H
#define PE_LOOK_H

#include "maps.h"
#include "quad.h"
#include "spline.h"

/* Beside a lamp narrower than its texels a spline swings below zero, which needs a coefficient below zero.  There a
 * lookup `sum` at the taps t, the first of which is at `corner`, `step` floats from the next and `stride` from the one
 * below, is not left lower than a lookup can be: than the least texel about, or a quarter of the bilinear lookup. */
pe_quad pe_look_beside_lamp(const float *corner, int step, int stride, const pe_disc_taps *t, pe_quad sum);

/* Where a lookup's 4 x 4 coefficients are, and their shares. */
typedef struct pe_aim {
    const float *corner;
    pe_disc_taps taps;
} pe_aim;

/* At image k of hemispheres in the direction `local` of its frame, unit; below the horizon: at the horizon.  The
 * coefficients are on their way from memory then: whoever looks at several images aims at all of them first. */
static inline void pe_look_aim(const pe_maps *maps, int image, const float local[3], pe_aim *aim)
{
    int stride = 3 * maps->info.width;
    const float *row = maps->coefficients + (size_t)image * pe_maps_image_values(maps);

    pe_disc_taps_at(&maps->disc, local, &aim->taps);
    aim->corner = row += (aim->taps.y - 1) * stride + 3 * (aim->taps.x - 1);
    for (int j = 0; j < 4; j++, row += stride) {
        __builtin_prefetch(row);
        __builtin_prefetch(row + 11);
    }
}

/* What an image shows there: red, green, blue, and a fourth value without meaning. */
static inline pe_quad pe_look_at(const pe_maps *maps, const pe_aim *aim)
{
    int stride = 3 * maps->info.width;
    const float *row = aim->corner;
    const pe_disc_taps *t = &aim->taps;
    pe_quad sum = { 0, 0, 0, 0 };
    pe_quad_bits signs = { 0, 0, 0, 0 };

    for (int j = 0; j < 4; j++, row += stride) {
        pe_quad a = pe_quad_load(row), b = pe_quad_load(row + 3), c = pe_quad_load(row + 6), d = pe_quad_load(row + 9);

        sum += t->down[j] * (t->across[0] * a + t->across[1] * b + t->across[2] * c + t->across[3] * d);
        signs |= (pe_quad_bits)a | (pe_quad_bits)b | (pe_quad_bits)c | (pe_quad_bits)d;
    }
    return (signs[0] | signs[1] | signs[2]) < 0 ? pe_look_beside_lamp(aim->corner, 3, stride, t, sum) : sum;
}

/* One alone. */
static inline pe_quad pe_look(const pe_maps *maps, int image, const float local[3])
{
    pe_aim aim;

    pe_look_aim(maps, image, local, &aim);
    return pe_look_at(maps, &aim);
}

#endif
