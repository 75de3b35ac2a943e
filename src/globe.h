/* globe.h - a lat-long picture looked up with a cubic B-spline that has neither seam nor poles: rows go round and
 * round, and a column goes on over the pole as the one opposite. */
#ifndef PE_GLOBE_H
#define PE_GLOBE_H

#include "quad.h"
#include "spline.h"

#include <stddef.h>

/* Texels around a picture that its coefficients are repeated in. */
#define PE_GLOBE_MARGIN 2

/* Floats of the coefficients of a picture: three each with their margins, and one that is loaded and ignored. */
static inline size_t pe_globe_values(int width, int height)
{
    return 3 * (size_t)(width + 2 * PE_GLOBE_MARGIN) * (size_t)(height + 2 * PE_GLOBE_MARGIN) + 1;
}

/* Of a picture of 3 * width * height floats, width even, both at least 8.  `line` is room for 2 * (width + height). */
void pe_globe_coefficients(const float *rgb, int width, int height, float *line, float *coefficients);

/* The spline at (u, v), u in [0, 1], v in [0, 1]: red, green, blue, and a fourth value without meaning. */
static inline pe_quad pe_globe_look(const float *coefficients, int width, int height, float u, float v)
{
    float x = u * (float)width + 0.5f, y = v * (float)height + 0.5f; /* both at least 1/2 from the margin on */
    int column = (int)x, row = (int)y, stride = 3 * (width + 2 * PE_GLOBE_MARGIN);
    float across[4], down[4];
    const float *at = coefficients + (size_t)row * (size_t)stride + 3 * column;
    pe_quad sum = { 0, 0, 0, 0 };

    pe_spline_weights(x - (float)column, across);
    pe_spline_weights(y - (float)row, down);
    for (int j = 0; j < 4; j++, at += stride) {
        pe_quad a = pe_quad_load(at), b = pe_quad_load(at + 3), c = pe_quad_load(at + 6), d = pe_quad_load(at + 9);

        sum += down[j] * (across[0] * a + across[1] * b + across[2] * c + across[3] * d);
    }
    return sum;
}

#endif
