/* disc.c - see disc.h. */
#include "disc.h"

#include <string.h>

static double radius_of(const pe_disc *disc, int x, int y)
{
    double p = (x + 0.5 - disc->width / 2.0) / pe_disc_radius(disc->width);
    double q = (y + 0.5 - disc->height / 2.0) / pe_disc_radius(disc->height);

    return sqrt(p * p + q * q);
}

/* The texel on the hemisphere that lies on the radius through (x, y), as near to the horizon as can be. */
static void nearest_inside(const pe_disc *disc, int x, int y, int *inside_x, int *inside_y)
{
    double dx = x + 0.5 - disc->width / 2.0, dy = y + 0.5 - disc->height / 2.0;
    double step = 0.25 / fmax(fabs(dx), fabs(dy)), along = 1 / radius_of(disc, x, y);

    do {
        *inside_x = (int)(disc->width / 2.0 + along * dx);
        *inside_y = (int)(disc->height / 2.0 + along * dy);
        along -= step;
    } while (!(radius_of(disc, *inside_x, *inside_y) < 1));
}

void pe_disc_continue(const pe_disc *disc, float *values, int channels)
{
    for (int y = 0; y < disc->height; y++)
        for (int x = 0; x < disc->width; x++) {
            float *texel = values + channels * (y * disc->width + x);
            int from_x, from_y;

            if (radius_of(disc, x, y) < 1)
                continue;
            nearest_inside(disc, x, y, &from_x, &from_y);
            memcpy(texel, values + channels * (from_y * disc->width + from_x), (size_t)channels * sizeof *texel);
        }
}
