/* fis.c - filtered importance sampling of a lat-long environment. [Křivánek]
 *
 * A half vector h drawn with density D cos(theta_h) makes a direction w with density p = D cos(theta_h) / (4 o.h). Each
 * of N samples speaks for the solid angle 1 / (N p), and is looked up in the level whose texels there are as large. */
#include "fis.h"

#include <math.h>
#include <stdlib.h>

#define LEVELS_MAX 16

typedef struct level {
    int width, height;
    float *rgb;
} level;

struct fis_pyramid {
    int levels;
    level level[LEVELS_MAX];
};

static level level_make(int width, int height)
{
    level l = { width, height, calloc((size_t)width * (size_t)height * 3, sizeof *l.rgb) };

    if (l.rgb == NULL)
        abort();
    return l;
}

/* A texel of the next level: the texels it covers, weighted by their solid angle. */
static void shrink_texel(const level *from, const level *to, int x, int y)
{
    double sum[4] = { 0, 0, 0, 0 };

    for (int v = y * from->height / to->height; v < (y + 1) * from->height / to->height; v++)
        for (int u = x * from->width / to->width; u < (x + 1) * from->width / to->width; u++) {
            double weight = sin(M_PI * (v + 0.5) / from->height);

            for (int c = 0; c < 3; c++)
                sum[c] += weight * (double)from->rgb[3 * (v * from->width + u) + c];
            sum[3] += weight;
        }
    for (int c = 0; c < 3; c++)
        to->rgb[3 * (y * to->width + x) + c] = (float)(sum[c] / sum[3]);
}

fis_pyramid *fis_pyramid_make(const pe_env *env)
{
    fis_pyramid *p = calloc(1, sizeof *p);
    level *last;

    if (p == NULL)
        abort();
    last = &p->level[0];
    *last = level_make(pe_env_width(env), pe_env_height(env));
    for (int k = 0; k < 3 * last->width * last->height; k++)
        last->rgb[k] = pe_env_texels(env)[k];
    for (p->levels = 1; p->levels < LEVELS_MAX && last->height > 1 && last->width > 1; p->levels++) {
        level *next = last + 1;

        *next = level_make(last->width / 2, last->height / 2);
        for (int y = 0; y < next->height; y++)
            for (int x = 0; x < next->width; x++)
                shrink_texel(last, next, x, y);
        last = next;
    }
    return p;
}

void fis_pyramid_free(fis_pyramid *p)
{
    for (int k = 0; k < p->levels; k++)
        free(p->level[k].rgb);
    free(p);
}

/* Adds weight times the light at (u, v) of a lat-long map, bilinear; rows beyond a pole are that of the pole. */
static void add_bilinear(const level *l, double u, double v, double weight, double rgb[3])
{
    double x = u * l->width - 0.5, y = v * l->height - 0.5;
    int left = (int)floor(x), top = (int)floor(y);

    for (int k = 0; k < 4; k++) {
        int column = left + k % 2, row = top + k / 2;
        double share = (k % 2 ? x - left : 1 - (x - left)) * (k / 2 ? y - top : 1 - (y - top));
        const float *texel;

        column = (column + l->width) % l->width;
        row = row < 0 ? 0 : row >= l->height ? l->height - 1 : row;
        texel = l->rgb + 3 * (row * l->width + column);
        for (int c = 0; c < 3; c++)
            rgb[c] += weight * share * (double)texel[c];
    }
}

/* Adds weight times the light from w, of the level whose texels are `solid_angle` large there. */
static void add_filtered(const fis_pyramid *p, const double w[3], double solid_angle, double weight, double rgb[3])
{
    double u, v, texel, depth;
    int fine;

    pe_latlong_coordinates(w, &u, &v);
    texel = 2 * M_PI * M_PI / ((double)p->level[0].width * p->level[0].height) * fmax(sin(M_PI * v), 1e-3);
    depth = fmin(fmax(0.5 * log2(solid_angle / texel), 0), p->levels - 1);
    fine = (int)depth;
    add_bilinear(&p->level[fine], u, v, weight * (1 - (depth - fine)), rgb);
    if (depth > fine)
        add_bilinear(&p->level[fine + 1], u, v, weight * (depth - fine), rgb);
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Base 2 digits of k, mirrored at the point. */
static double radical_inverse(unsigned k)
{
    double value = 0, digit = 0.5;

    while (k) {
        value += digit * (k & 1);
        k >>= 1;
        digit /= 2;
    }
    return value;
}

void fis_reflect(const fis_pyramid *p, const double alpha[2], const double direction[3], int samples, const double n[3],
                 const double o[3], double rgb[3])
{
    double t[3], b[3], sum = 0, along = dot(direction, n), length;

    for (int c = 0; c < 3; c++)
        t[c] = direction[c] - along * n[c];
    length = sqrt(dot(t, t));
    for (int c = 0; c < 3; c++) {
        t[c] /= length;
        rgb[c] = 0;
    }
    cross(n, t, b);
    for (int k = 0; k < samples; k++) {
        double tan2 = -log(1 - (k + 0.5) / samples), phi = 2 * M_PI * radical_inverse((unsigned)k);
        double x = alpha[0] * sqrt(tan2) * cos(phi), y = alpha[1] * sqrt(tan2) * sin(phi);
        double z = 1 / sqrt(1 + x * x + y * y), h[3], w[3], o_h, density;

        for (int c = 0; c < 3; c++)
            h[c] = z * (x * t[c] + y * b[c] + n[c]);
        o_h = dot(o, h);
        for (int c = 0; c < 3; c++)
            w[c] = 2 * o_h * h[c] - o[c];
        if (o_h <= 0 || dot(w, n) <= 0)
            continue;
        density = exp(-tan2) / (M_PI * alpha[0] * alpha[1] * z * z * z) / (4 * o_h);
        add_filtered(p, w, 1 / (samples * density), o_h / z, rgb);
        sum += o_h / z;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] /= sum > 0 ? sum : 1;
}
