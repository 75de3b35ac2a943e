/* env.h - inside a lat-long environment. */
#ifndef PE_ENV_H
#define PE_ENV_H

#include "prefenv.h"

/* Texel (x, y) looks along (sin_theta[y] cos_phi[x], cos_theta[y], sin_theta[y] sin_phi[x]). */
typedef struct pe_grid {
    int width, height;
    double *sin_theta, *cos_theta; /* of each row, theta from +y */
    double *sin_phi, *cos_phi;     /* of each column, phi from +x towards +z */
    double *solid_angle_sr;        /* of one texel in each row */
} pe_grid;

pe_status pe_grid_make(int width, int height, pe_grid *grid, pe_error *error);
void pe_grid_free(pe_grid *grid);

static inline void pe_grid_direction(const pe_grid *grid, int x, int y, double direction[3])
{
    direction[0] = grid->sin_theta[y] * grid->cos_phi[x];
    direction[1] = grid->cos_theta[y];
    direction[2] = grid->sin_theta[y] * grid->sin_phi[x];
}

struct pe_env {
    int width, height;
    float *rgb;
    char *name;
    size_t repairs;
    char remark[512]; /* see pe_env_remark */
    pe_grid grid;
};

/* Rec. 709 luminance of linear RGB. */
static inline double pe_luminance(const float rgb[3])
{
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

/* The texel that `direction` (any length but zero) falls into. */
const float *pe_env_texel(const pe_env *env, const double direction[3]);

/* ---- bilinear lookup in any lat-long image; the sampler of maps shares it ---- */

/* One texel of the four around a point, and its share.  Shares of a point's taps add up to 1. */
typedef struct pe_tap {
    int x, y;
    double share;
} pe_tap;

/* The four texels around (u, v).  Beyond a pole lies the same row, half a turn on, which for an
 * odd width is between two texels. */
void pe_latlong_taps(int width, int height, double u, double v, pe_tap taps[4]);

#endif
