/* sample_voxels.c - one trilinear lookup at t = lambda r, as a graphics card does it. [Okumura Eq. 6]
 *
 * The cube's faces are half a voxel beyond the outermost centres; what lies there is as at these. */
#include "sample.h"

/* The two voxels about a coordinate of t, and the second one's share. */
static double place(int size, double t, int at[2])
{
    double x = fmin(fmax((t + 1) / 2 * size - 0.5, 0), size - 1);

    at[0] = (int)x;
    at[1] = at[0] + 1 < size ? at[0] + 1 : at[0];
    return x - at[0];
}

void pe_sample_voxels(const pe_maps *maps, const double r[3], double lambda, double rgb[3])
{
    int size = maps->info.width, at[3][2];
    double second[3];

    for (int c = 0; c < 3; c++) {
        second[c] = place(size, lambda * r[c], at[c]);
        rgb[c] = 0;
    }
    for (int k = 0; k < 8; k++) {
        const float *voxel =
            pe_maps_image(maps, at[2][k >> 2]) + 3 * ((size_t)at[1][k >> 1 & 1] * (size_t)size + (size_t)at[0][k & 1]);
        double share = 1;

        for (int c = 0; c < 3; c++)
            share *= k >> c & 1 ? second[c] : 1 - second[c];
        for (int c = 0; c < 3; c++)
            rgb[c] += share * (double)voxel[c];
    }
}
