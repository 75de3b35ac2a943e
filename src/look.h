/* look.h - one bicubic lookup in one hemisphere: the innermost of what a renderer waits for. */
#ifndef PE_LOOK_H
#define PE_LOOK_H

#include "maps.h"
#include "spline.h"

#include <string.h>

typedef float pe_quad __attribute__((vector_size(16)));

/* Four floats from a texel on: its three channels and one more, which is ignored. */
static inline pe_quad pe_look_load(const float *texel)
{
    pe_quad v;

    memcpy(&v, texel, sizeof v);
    return v;
}

/* What image k of hemispheres shows in the direction `local` of its frame, unit; below the horizon: what the horizon
 * shows.  Red, green, blue, and a fourth value without meaning. */
static inline pe_quad pe_look(const pe_maps *maps, int image, const float local[3])
{
    int width = maps->info.width;
    const float *row;
    pe_disc_taps t;
    pe_quad sum = { 0, 0, 0, 0 };

    pe_disc_taps_at(&maps->disc, local, &t);
    row = maps->coefficients + (size_t)image * pe_maps_image_values(maps) + 3 * ((t.y - 1) * width + t.x - 1);
    for (int j = 0; j < 4; j++, row += 3 * width)
        sum += t.down[j] * (t.across[0] * pe_look_load(row) + t.across[1] * pe_look_load(row + 3) +
                            t.across[2] * pe_look_load(row + 6) + t.across[3] * pe_look_load(row + 9));
    return sum;
}

#endif
