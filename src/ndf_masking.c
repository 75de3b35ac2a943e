/* ndf_masking.c - how much of a rough surface hides behind the rest: Smith's Lambda. [Heitz]
 *
 * With P_phi the density of the slope s towards the viewer's foot, a viewer at the polar angle theta sees of the
 * surface the share 1 / (1 + Lambda),
 *
 *     Lambda = tan(theta) H(cot(theta)),   H(a) = integral of (s - a) P_phi(s) ds over s > a,
 *
 * if the mean slope is 0.  Stretched distributions have P_phi of the width alpha_phi alone; with
 * a = 1 / (alpha_phi tan(theta))
 *
 *     Beckmann    Lambda = (exp(-a^2) / (a sqrt(pi)) - erfc(a)) / 2
 *     GGX         Lambda = (sqrt(1 + 1 / a^2) - 1) / 2
 *
 * Of a table, H is tabulated over phi and a. */
#include "ndf.h"

#include <math.h>
#include <stdlib.h>

/* 1 / a; w above the horizon. */
static double stretched_tangent(const pe_ndf *ndf, const double w[3])
{
    return hypot(ndf->alpha_x * w[0], ndf->alpha_y * w[1]) / w[2];
}

static double beckmann(double inverse)
{
    double a = 1 / inverse;

    if (a > 5) /* 1e-12 and less */
        return 0;
    return (exp(-a * a) / (a * sqrt(M_PI)) - erfc(a)) / 2;
}

/* sqrt(1 + x^2) - 1 without what cancels. */
static double ggx(double inverse)
{
    double square = inverse * inverse;

    return square / (sqrt(1 + square) + 1) / 2;
}

/* ---- tables ---- */

enum { AZIMUTHS = 64, PLACES = 256, BINS = 4096, SIDE = 512 };

/* Root mean square of the slope towards the direction (x, y), of any length, times that length. */
static double width_towards(const pe_ndf_table *t, double x, double y)
{
    return sqrt(fmax(t->moments[0] * x * x + 2 * t->moments[1] * x * y + t->moments[2] * y * y, 1e-30));
}

/* H / width at place x = a / (a + width), of PLACES + 1 from 0 to 1. */
static double masking_at(const pe_ndf_table *t, double azimuth, double place)
{
    double u = azimuth * AZIMUTHS / (2 * M_PI), v = place * PLACES;
    int i = (int)floor(u), j = v < PLACES - 1 ? (int)v : PLACES - 1;
    const float *from, *to;

    u -= i;
    v -= j;
    from = t->masking + (size_t)((i % AZIMUTHS + AZIMUTHS) % AZIMUTHS) * (PLACES + 1) + (size_t)j;
    to = t->masking + (size_t)(((i + 1) % AZIMUTHS + AZIMUTHS) % AZIMUTHS) * (PLACES + 1) + (size_t)j;
    return (1 - u) * ((1 - v) * (double)from[0] + v * (double)from[1]) +
           u * ((1 - v) * (double)to[0] + v * (double)to[1]);
}

static double table(const pe_ndf_table *t, const double w[3])
{
    double sine = hypot(w[0], w[1]), width, a;

    if (sine < 1e-9 * w[2])
        return 0;
    width = width_towards(t, w[0] / sine, w[1] / sine);
    a = w[2] / sine;
    return width * masking_at(t, atan2(w[1], w[0]), a / (a + width)) / a;
}

/* The slopes' shares in bins of s = -(p cos + q sin), of +-s_max; blocks of samples count as one at their middle, up to
 * SIDE a side. */
static void fill_bins(const pe_ndf_table *t, double azimuth, double s_max, double bins[BINS])
{
    int step_x = (t->width + SIDE - 1) / SIDE, step_y = (t->height + SIDE - 1) / SIDE;
    double cell = t->p_step * t->q_step, x = -cos(azimuth), y = -sin(azimuth);

    for (int k = 0; k < BINS; k++)
        bins[k] = 0;
    for (int top = 0; top < t->height; top += step_y)
        for (int left = 0; left < t->width; left += step_x) {
            double share = 0, s, place;
            int k;

            for (int j = top; j < top + step_y && j < t->height; j++)
                for (int i = left; i < left + step_x && i < t->width; i++)
                    share += (double)t->density[(size_t)(j + 1) * (size_t)t->row + (size_t)i + 1];
            s = x * (t->p_min + (left + 0.5 * step_x) * t->p_step) + y * (t->q_min + (top + 0.5 * step_y) * t->q_step);
            place = (s / s_max + 1) / 2 * BINS - 0.5;
            k = (int)fmin(fmax(place, 0), BINS - 2);
            bins[k] += cell * share * (1 - (place - k));
            bins[k + 1] += cell * share * (place - k);
        }
}

static void fill_azimuth(const pe_ndf_table *t, double azimuth, float *masking)
{
    double bins[BINS], p_max = fmax(fabs(t->p_min), fabs(t->p_min + t->width * t->p_step));
    double q_max = fmax(fabs(t->q_min), fabs(t->q_min + t->height * t->q_step));
    double s_max = hypot(p_max, q_max) * (1 + 4.0 / BINS), width = width_towards(t, cos(azimuth), sin(azimuth));
    double share = 0, sum = 0;
    int k = BINS - 1;

    fill_bins(t, azimuth, s_max, bins);
    masking[PLACES] = 0;
    for (int place = PLACES - 1; place >= 0; place--) {
        double x = (double)place / PLACES, a = width * x / (1 - x);

        for (; k >= 0; k--) { /* the bins beyond a */
            double s = ((k + 0.5) / BINS * 2 - 1) * s_max;

            if (s <= a)
                break;
            share += bins[k];
            sum += bins[k] * s;
        }
        masking[place] = (float)(fmax(sum - a * share, 0) / width);
    }
}

int pe_ndf_table_mask(pe_ndf_table *t)
{
    t->masking = malloc((size_t)AZIMUTHS * (PLACES + 1) * sizeof *t->masking);
    if (!t->masking)
        return 0;
    for (int k = 0; k < AZIMUTHS; k++)
        fill_azimuth(t, 2 * M_PI * k / AZIMUTHS, t->masking + (size_t)k * (PLACES + 1));
    return 1;
}

double pe_ndf_lambda(const pe_ndf *ndf, const double w[3])
{
    switch (ndf->kind) {
    case PE_NDF_BECKMANN:
        return beckmann(stretched_tangent(ndf, w));
    case PE_NDF_GGX:
        return ggx(stretched_tangent(ndf, w));
    case PE_NDF_TABLE:
        return table(ndf->table, w);
    case PE_NDF_PHONG:
        break;
    }
    return 0;
}
