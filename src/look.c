/* look.c - see look.h: a lookup where the spline may swing below zero. */
#include "look.h"

/* Of the bilinear lookup: what is lower is looked at twice. */
#define LOW 0.25f

static inline pe_quad lesser(pe_quad a, pe_quad b)
{
    pe_quad_bits is_less = a < b;

    return (pe_quad)(((pe_quad_bits)a & is_less) | ((pe_quad_bits)b & ~is_less));
}

/* A texel is the mean of the nine coefficients about it with the weights 1, 4, 1 in rows and columns. */
pe_quad pe_look_beside_lamp(const float *corner, int step, int stride, float right, float below, pe_quad sum)
{
    pe_quad first[4], second[4], texels[2][2], low;

    for (int j = 0; j < 4; j++, corner += stride) {
        pe_quad b = pe_quad_load(corner + step), c = pe_quad_load(corner + 2 * step);

        first[j] = (pe_quad_load(corner) + 4 * b + c) / 36;
        second[j] = (b + 4 * c + pe_quad_load(corner + 3 * step)) / 36;
    }
    for (int j = 0; j < 2; j++) {
        texels[j][0] = first[j] + 4 * first[j + 1] + first[j + 2];
        texels[j][1] = second[j] + 4 * second[j + 1] + second[j + 2];
    }
    low = (1 - below) * ((1 - right) * texels[0][0] + right * texels[0][1]) +
          below * ((1 - right) * texels[1][0] + right * texels[1][1]);
    low = lesser(LOW * low, lesser(lesser(texels[0][0], texels[0][1]), lesser(texels[1][0], texels[1][1])));
    return -lesser(-sum, -low);
}
