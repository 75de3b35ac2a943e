/* disc.h - a hemisphere as a picture: the Lambert azimuthal equal-area projection of a normal's tangent frame.
 *
 * The unit direction (x, y, z), z >= 0, lies at (p, q) = (x, y) / sqrt(1 + z): the pole in the middle, the horizon on
 * the unit circle, equal areas everywhere, no seam, no crease, one square root and no trigonometry [Snyder].  Toward
 * the horizon its scale along the rim is 1.4 times that in the middle: where a glossy lobe is narrow across the plane
 * of incidence, and nowhere else, texels are denser. */
#ifndef PE_DISC_H
#define PE_DISC_H

#include "spline.h"

#include <math.h>

/* Texels between the unit circle and the picture's edge, so that the sixteen taps of a cubic stay inside. */
#define PE_DISC_MARGIN 1.5

#define PE_DISC_SIDE_MIN 8

typedef struct pe_disc {
    int width, height; /* along t and along b */
} pe_disc;

/* Half the unit circle's diameter, in texels. */
static inline double pe_disc_radius(int side)
{
    return side / 2.0 - PE_DISC_MARGIN;
}

/* The direction at the centre of texel (x, y), in the tangent frame.  Returns 1 if the texel is on the hemisphere; if
 * it lies beyond the horizon, 0, and direction is left alone. */
static inline int pe_disc_direction(const pe_disc *disc, int x, int y, double direction[3])
{
    double p = (x + 0.5 - disc->width / 2.0) / pe_disc_radius(disc->width);
    double q = (y + 0.5 - disc->height / 2.0) / pe_disc_radius(disc->height);
    double square = p * p + q * q, scale = sqrt(2 - square);

    if (!(square < 1))
        return 0;
    direction[0] = p * scale;
    direction[1] = q * scale;
    direction[2] = 1 - square;
    return 1;
}

/* Where the unit direction lies, in texels from the picture's corner; a direction below the horizon lies on it. */
static inline void pe_disc_point(const pe_disc *disc, const float direction[3], float point[2])
{
    float x = direction[0], y = direction[1], z = direction[2];
    float scale = 1 / sqrtf(z > 0 ? 1 + z : x * x + y * y + 1e-30f);

    point[0] = x * scale * (float)pe_disc_radius(disc->width) + 0.5f * (float)disc->width;
    point[1] = y * scale * (float)pe_disc_radius(disc->height) + 0.5f * (float)disc->height;
}

/* The 4 x 4 spline coefficients about a direction: those in the columns x - 1 to x + 2 of the rows y - 1 to y + 2, all
 * of them inside, and their shares. */
typedef struct pe_disc_taps {
    int x, y;
    float right, below; /* where the direction lies between them: from the texel (x, y), in texels */
    float across[4], down[4];
} pe_disc_taps;

static inline int pe_disc_tap(float point, int side)
{
    float tap = point - 0.5f, last = (float)(side - 3);

    tap = tap > 1 ? tap : 1;
    return (int)(tap < last ? tap : last);
}

static inline void pe_disc_taps_at(const pe_disc *disc, const float direction[3], pe_disc_taps *taps)
{
    float point[2];

    pe_disc_point(disc, direction, point);
    taps->x = pe_disc_tap(point[0], disc->width);
    taps->y = pe_disc_tap(point[1], disc->height);
    taps->right = point[0] - 0.5f - (float)taps->x;
    taps->below = point[1] - 0.5f - (float)taps->y;
    pe_spline_weights(taps->right, taps->across);
    pe_spline_weights(taps->below, taps->down);
}

/* Gives the texels beyond the horizon, which a cubic's taps reach, the values of the last texel within on their
 * radius.  channels: interleaved, of each texel. */
void pe_disc_continue(const pe_disc *disc, float *values, int channels);

#endif
