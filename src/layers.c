/* layers.c - see layers.h.
 *
 * In a lat-long picture the texels that have weight for a direction lie in a few rows, in each between two columns.
 * The sum runs along them, 16 at a time.  A layer reads the environment at a size whose texels are a good deal narrower
 * than its lobe; what is left out is below e^-CUTOFF of the lobe's peak. */
#include "layers.h"

#include "lanes.h"
#include "pyramid.h"
#include "status.h"

#include <stdlib.h>

/* A layer's texels of the environment are at most this part of its lobe's standard deviation. */
#define TEXEL_PER_DEVIATION 0.3

#define CUTOFF 17.0
#define CUTOFF_BITS 24.5f /* the same, of 2 */

/* ---- an environment by rows of lanes ---- */

/* Each row twice, so that the columns about u = 0 follow each other, and some more, which a vector may load. */
typedef struct strip {
    const pe_env *env;
    int stride;
    float *cos_phi, *sin_phi;
    float *channels[3];
} strip;

static void free_strip(strip *s)
{
    free(s->cos_phi);
    free(s->sin_phi);
    for (int c = 0; c < 3; c++)
        free(s->channels[c]);
    *s = (strip){ 0 };
}

static pe_status make_strip(const pe_env *env, strip *s, pe_error *error)
{
    int width = env->width;
    int whole;

    *s = (strip){ .env = env, .stride = 2 * width + LANES };
    s->cos_phi = malloc((size_t)s->stride * sizeof *s->cos_phi);
    s->sin_phi = malloc((size_t)s->stride * sizeof *s->sin_phi);
    whole = s->cos_phi && s->sin_phi;
    for (int c = 0; c < 3; c++) {
        s->channels[c] = malloc((size_t)s->stride * (size_t)env->height * sizeof *s->channels[c]);
        whole = whole && s->channels[c];
    }
    if (!whole) {
        free_strip(s);
        return pe_fail_memory(error, "an environment by rows");
    }
    for (int x = 0; x < s->stride; x++) {
        s->cos_phi[x] = (float)env->grid.cos_phi[x % width];
        s->sin_phi[x] = (float)env->grid.sin_phi[x % width];
        for (int y = 0; y < env->height; y++)
            for (int c = 0; c < 3; c++)
                s->channels[c][y * s->stride + x] = env->rgb[3 * (y * width + x % width) + c];
    }
    return PE_OK;
}

/* ---- a lobe ---- */

/* Where a lobe has weight in one row, and what the row's texels count. */
typedef struct span {
    int offset; /* of its first texel in the strip's channels */
    int first, count;
    float cos_theta, sin_theta, solid_angle;
} span;

/* Weight, red, green, blue. */
typedef struct sums {
    floats of[4];
} sums;

/* -log2(1 - d) for d in [0, 0.7]: 1 - d = (1 - z) / (1 + z), whose logarithm is an odd series in z. */
INLINE floats bits_of_near(floats d)
{
    floats z = d / (2 - d), z2 = z * z;
    floats series = 1.0f / 13 * z2 + 1.0f / 11;

    series = series * z2 + 1.0f / 9;
    series = series * z2 + 1.0f / 7;
    series = series * z2 + 1.0f / 5;
    series = series * z2 + 1.0f / 3;
    series = series * z2 + 1.0f;
    return 2.885390082f * z * series; /* 2 / ln 2 */
}

/* The same for any d below 1, for exponents that a little less precision is enough for: 1 - d = 2^k m, m in [1, 2) of
 * which the square root is taken out, and the series again. */
INLINE floats bits_of_far(floats d)
{
    floats c = 1 - d;
    ints bits = (ints)c;
    ints k = (bits >> 23) - 127;
    floats m = (floats)((bits & 0x007fffff) | 0x3f800000) * 0.70710678f;

    return bits_of_near(1 - m) - (__builtin_convertvector(k, floats) + 0.5f);
}

/* Adds the texels of a span; where `far`, the lobe reaches as far as a right angle. */
INLINE void add_span(const strip *s, const span *at, const float r[3], float exponent, int far, sums *out)
{
    static const float order[LANES] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };
    float dy = at->cos_theta - r[1];
    floats lane = load(order);

    for (int k = 0; k < at->count; k += LANES) {
        floats dx = at->sin_theta * load(s->cos_phi + at->first + k) - r[0];
        floats dz = at->sin_theta * load(s->sin_phi + at->first + k) - r[2];
        floats d = 0.5f * (dx * dx + dz * dz + dy * dy);
        ints inside = (lane < (float)(at->count - k)) & (d < (far ? 0.9999999f : 0.7f));
        floats weight;

        d = (floats)((ints)d & inside);
        weight = exponent * (far ? bits_of_far(d) : bits_of_near(d));
        exp2_of_negative(&weight, CUTOFF_BITS);
        weight = (floats)((ints)(weight * at->solid_angle) & inside);
        out->of[0] += weight;
        for (int c = 0; c < 3; c++)
            out->of[c + 1] += weight * load(s->channels[c] + at->offset + k);
    }
}

CLONES static void add_near(const strip *s, const span *spans, int count, const float r[3], float exponent, sums *out)
{
    for (int k = 0; k < count; k++)
        add_span(s, &spans[k], r, exponent, 0, out);
}

CLONES static void add_far(const strip *s, const span *spans, int count, const float r[3], float exponent, sums *out)
{
    for (int k = 0; k < count; k++)
        add_span(s, &spans[k], r, exponent, 1, out);
}

/* ---- a layer ---- */

typedef struct job {
    strip strip;
    const pe_env *env; /* itself */
    int width, height;
    double exponent, least_cosine;
    float *image;
    unsigned char *done; /* memory sufficed for this row */
} job;

/* The spans of one row of the layer: those of its first texel, from which the others' are turned. */
static int make_spans(const job *j, double polar, span *spans)
{
    const pe_env *env = j->strip.env;
    int count = 0;

    for (int y = 0; y < env->height; y++) {
        double along = cos(polar) * env->grid.cos_theta[y], across = sin(polar) * env->grid.sin_theta[y];

        if (along + across < j->least_cosine)
            continue;
        spans[count++] = (span){ .offset = y * j->strip.stride,
                                 .cos_theta = (float)env->grid.cos_theta[y],
                                 .sin_theta = (float)env->grid.sin_theta[y],
                                 .solid_angle = (float)(env->grid.solid_angle_sr[y] / env->grid.solid_angle_sr[0]) };
    }
    return count;
}

/* How far from the lobe's azimuth texels of a row have weight; pi: all have. */
static double reach_of(const job *j, double polar, const span *at)
{
    double along = cos(polar) * (double)at->cos_theta, across = sin(polar) * (double)at->sin_theta;

    return along - across >= j->least_cosine ? M_PI : acos(fmax((j->least_cosine - along) / across, -1));
}

/* Places the spans about the azimuth u, in turns. */
static void turn_spans(const job *j, const double *reaches, double u, span *spans, int count)
{
    int width = j->strip.env->width;

    for (int k = 0; k < count; k++) {
        int row = spans[k].offset - spans[k].offset % j->strip.stride, first, last;

        first = (int)ceil((u - reaches[k] / (2 * M_PI)) * width - 0.5);
        last = (int)floor((u + reaches[k] / (2 * M_PI)) * width - 0.5);
        spans[k].count = last - first + 1 < width ? last - first + 1 : width;
        spans[k].first = (first + 2 * width) % width;
        spans[k].offset = row + spans[k].first;
    }
}

static void store(const job *j, const sums *s, const double r[3], float *texel)
{
    double total[4] = { 0 };

    for (int v = 0; v < 4; v++)
        for (int k = 0; k < LANES; k++)
            total[v] += (double)s->of[v][k];
    if (!(total[0] > 0)) /* a lobe between the texels */
        pe_env_lookup(j->env, r, total + 1);
    for (int c = 0; c < 3; c++)
        texel[c] = (float)(total[0] > 0 ? total[c + 1] / total[0] : total[c + 1]);
}

/* Exponents up to this one have lobes that reach beyond where the series holds. */
#define FAR_EXPONENT 15.0

static void fill_texels(const job *j, double polar, int y, span *spans, const double *reaches, int count)
{
    for (int x = 0; x < j->width; x++) {
        double r[3];
        float single[3];
        sums s = { { { 0 } } };

        pe_latlong_direction((x + 0.5) / j->width, polar / M_PI, r);
        for (int c = 0; c < 3; c++)
            single[c] = (float)r[c];
        turn_spans(j, reaches, (x + 0.5) / j->width, spans, count);
        (j->exponent <= FAR_EXPONENT ? add_far : add_near)(&j->strip, spans, count, single, (float)j->exponent, &s);
        store(j, &s, r, j->image + 3 * ((size_t)y * (size_t)j->width + (size_t)x));
    }
}

static void fill_row(size_t y, void *data)
{
    job *j = data;
    double polar = M_PI * ((double)y + 0.5) / j->height;
    span *spans = malloc((size_t)j->strip.env->height * sizeof *spans);
    double *reaches = malloc((size_t)j->strip.env->height * sizeof *reaches);

    if (spans && reaches) {
        int count = make_spans(j, polar, spans);

        for (int k = 0; k < count; k++)
            reaches[k] = reach_of(j, polar, &spans[k]);
        fill_texels(j, polar, (int)y, spans, reaches, count);
        j->done[y] = 1;
    }
    free(spans);
    free(reaches);
}

static pe_status fill_layer(job *j, int threads, const pe_report *report, pe_error *error)
{
    pe_status status;

    j->done = calloc((size_t)j->height, 1);
    if (!j->done)
        return pe_fail_memory(error, "a layer");
    status = pe_parallel_for((size_t)j->height, threads, fill_row, j, report);
    for (int y = 0; y < j->height && status == PE_OK; y++)
        if (!j->done[y])
            status = pe_fail_memory(error, "a layer");
    free(j->done);
    return status;
}

pe_status pe_fill_layers(const pe_env *env, int threads, const pe_report *report, pe_maps *maps, pe_error *error)
{
    pe_report part = report ? *report : (pe_report){ 0 };
    pe_pyramid pyramid;
    pe_status status = pe_pyramid_make(env, TEXEL_PER_DEVIATION, &pyramid, error);

    if (status != PE_OK)
        return status;
    for (int k = 0; k < maps->info.images && status == PE_OK; k++) {
        job j = { .env = env, .exponent = pe_maps_image_exponent(maps, k) };

        pe_maps_image_size(maps, k, &j.width, &j.height);
        j.least_cosine = exp(-CUTOFF / j.exponent);
        j.image = pe_maps_image_to_fill(maps, k);
        status = make_strip(pe_pyramid_level(&pyramid, TEXEL_PER_DEVIATION / sqrt(j.exponent)), &j.strip, error);
        if (status != PE_OK)
            break;
        status = fill_layer(&j, threads, &part, error);
        part.done += j.height;
        free_strip(&j.strip);
    }
    pe_pyramid_free(&pyramid);
    return status;
}

/* ---- exactly ---- */

static void fill_row_exactly(size_t y, void *data)
{
    const job *j = data;

    for (int x = 0; x < j->width; x++) {
        double r[3], rgb[3];

        pe_latlong_direction((x + 0.5) / j->width, ((double)y + 0.5) / j->height, r);
        pe_phong(j->env, j->exponent, PE_HORIZON_IGNORED, NULL, r, rgb);
        for (int c = 0; c < 3; c++)
            j->image[3 * (y * (size_t)j->width + (size_t)x) + (size_t)c] = (float)rgb[c];
    }
}

pe_status pe_fill_layers_exactly(const pe_env *env, int threads, const pe_report *report, pe_maps *maps)
{
    pe_report part = report ? *report : (pe_report){ 0 };
    pe_status status = PE_OK;

    for (int k = 0; k < maps->info.images && status == PE_OK; k++) {
        job j = { .env = env, .exponent = pe_maps_image_exponent(maps, k), .image = pe_maps_image_to_fill(maps, k) };

        pe_maps_image_size(maps, k, &j.width, &j.height);
        status = pe_parallel_for((size_t)j.height, threads, fill_row_exactly, &j, &part);
        part.done += j.height;
    }
    return status;
}
