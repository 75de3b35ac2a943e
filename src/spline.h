/* spline.h - cubic B-splines through the texels of a picture: twice continuously differentiable, fourth order. */
#ifndef PE_SPLINE_H
#define PE_SPLINE_H

#include "prefenv.h"

/* Replaces the values of a picture of `channels` interleaved floats by the coefficients of the cubic B-spline that
 * passes through them; beyond its edges the picture is mirrored about the outermost texel centres.  [Unser]
 * Both sides at least 2. */
void pe_spline_coefficients(float *values, int width, int height, int channels);

/* The shares of the four coefficients about a point, the first at the texel before the one that precedes the point by
 * t in [0, 1]. */
static inline void pe_spline_weights(float t, float weights[4])
{
    float s = 1 - t;

    weights[0] = s * s * s / 6;
    weights[1] = (4 - 3 * t * t * (2 - t)) / 6;
    weights[2] = (4 - 3 * s * s * (2 - s)) / 6;
    weights[3] = t * t * t / 6;
}

/* The same for values instead of coefficients: Catmull and Rom's spline, which passes through them, third order. */
static inline void pe_interpolating_weights(float t, float weights[4])
{
    float s = 1 - t;

    weights[0] = -t * s * s / 2;
    weights[1] = s * (2 + 2 * t - 3 * t * t) / 2;
    weights[2] = t * (2 + 2 * s - 3 * s * s) / 2;
    weights[3] = -s * t * t / 2;
}

#endif
