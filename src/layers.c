/* layers.c - see layers.h.
 *
 * In a lat-long picture the texels that have weight for a direction lie in a few rows, in each between two columns.
 * The sum runs along them, 16 at a time.  Turned about the pole by a number of columns a lobe has the same weights, so
 * that they are worked out once for all texels of a row that lie alike over the environment's.  A layer reads the
 * environment at a size whose texels are a good deal narrower than its lobe; what is left out is below e^-CUTOFF of the
 * lobe's peak. */
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

/* ---- a lobe in a row ---- */

/* Where a lobe has weight in one row of the environment. */
typedef struct span {
    int row, first, count;
    float cos_theta, sin_theta, solid_angle;
    double reach; /* from the lobe's azimuth, in turns */
} span;

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
 * which the square root of 2 is taken out, and the series again. */
INLINE floats bits_of_far(floats d)
{
    floats c = 1 - d;
    ints bits = (ints)c;
    ints k = (bits >> 23) - 127;
    floats m = (floats)((bits & 0x007fffff) | 0x3f800000) * 0.70710678f;

    return bits_of_near(1 - m) - (__builtin_convertvector(k, floats) + 0.5f);
}

/* The weights of a span's texels for the direction r, and zeros to the end of the last vector; where `far`, the lobe
 * reaches as far as a right angle.  Returns their sum. */
INLINE float weigh(const strip *s, const span *at, const float r[3], float exponent, int far, float *weights)
{
    static const float order[LANES] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };
    float dy = at->cos_theta - r[1], total = 0;
    floats lane = load(order), sum = { 0 };

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
        memcpy(weights + k, &weight, sizeof weight);
        sum += weight;
    }
    for (int k = 0; k < LANES; k++)
        total += sum[k];
    return total;
}

CLONES static float weigh_near(const strip *s, const span *at, const float r[3], float exponent, float *weights)
{
    return weigh(s, at, r, exponent, 0, weights);
}

CLONES static float weigh_far(const strip *s, const span *at, const float r[3], float exponent, float *weights)
{
    return weigh(s, at, r, exponent, 1, weights);
}

/* ---- a row of a layer ---- */

/* Texels of a row whose columns lie alike over the environment's: every `period`-th, which `step` columns are apart. */
typedef struct period {
    int texels, columns, count; /* count times texels, count times columns are the rows */
} period;

typedef struct job {
    strip strip;
    const pe_env *env; /* itself */
    int width, height;
    period period;
    double exponent, least_cosine;
    float *image;
} job;

/* What a row of a layer adds up: of each texel three vectors, and of each that is not like one before it the weight. */
typedef struct row_room {
    span *spans;
    float *weights, *sums, *totals;
} row_room;

/* The same weights for texel `first` of the layer and all that are like it. */
CLONES static void apply(const strip *s, const span *at, const period *p, const float *weights, int first, float *sums)
{
    int width = s->env->width, column = at->first;

    for (int m = 0; m < p->count; m++) {
        float *to = sums + (size_t)(first + m * p->texels) * 3 * LANES;

        for (int c = 0; c < 3; c++) {
            const float *from = s->channels[c] + (size_t)at->row * (size_t)s->stride + column;
            floats sum = load(to + c * LANES);

            for (int k = 0; k < at->count; k += LANES)
                sum += load(weights + k) * load(from + k);
            memcpy(to + c * LANES, &sum, sizeof sum);
        }
        column += p->columns;
        column -= column >= width ? width : 0;
    }
}

static int gcd(int a, int b)
{
    return b ? gcd(b, a % b) : a;
}

/* The rows of the environment where a lobe at this polar angle has weight. */
static int make_spans(const job *j, double polar, span *spans)
{
    const pe_grid *grid = &j->strip.env->grid;
    int count = 0;

    for (int y = 0; y < j->strip.env->height; y++) {
        double along = cos(polar) * grid->cos_theta[y], across = sin(polar) * grid->sin_theta[y];

        if (along + across < j->least_cosine)
            continue;
        spans[count] = (span){ .row = y,
                               .cos_theta = (float)grid->cos_theta[y],
                               .sin_theta = (float)grid->sin_theta[y],
                               .solid_angle = (float)(grid->solid_angle_sr[y] / grid->solid_angle_sr[0]) };
        spans[count++].reach =
            along - across >= j->least_cosine ? 0.5 : acos(fmax((j->least_cosine - along) / across, -1)) / (2 * M_PI);
    }
    return count;
}

/* Places a span about the azimuth u, in turns. */
static void turn_span(int width, double u, span *at)
{
    int first = (int)ceil((u - at->reach) * width - 0.5), last = (int)floor((u + at->reach) * width - 0.5);

    at->count = last - first + 1 < width ? last - first + 1 : width;
    at->first = (first + width) % width;
}

/* Exponents up to this one have lobes that reach beyond where the series holds. */
#define FAR_EXPONENT 15.0

/* Adds all spans to the texels that are like texel x. */
static void add_spans(const job *j, double polar, int x, int count, row_room *room)
{
    double r[3];
    float single[3];

    pe_latlong_direction((x + 0.5) / j->width, polar / M_PI, r);
    for (int c = 0; c < 3; c++)
        single[c] = (float)r[c];
    room->totals[x] = 0;
    for (int k = 0; k < count; k++) {
        span *at = &room->spans[k];

        turn_span(j->strip.env->width, (x + 0.5) / j->width, at);
        room->totals[x] += (j->exponent <= FAR_EXPONENT ? weigh_far : weigh_near)(&j->strip, at, single,
                                                                                  (float)j->exponent, room->weights);
        apply(&j->strip, at, &j->period, room->weights, x, room->sums);
    }
}

static void store_row(const job *j, int y, const row_room *room)
{
    for (int x = 0; x < j->width; x++) {
        float *texel = j->image + 3 * ((size_t)y * (size_t)j->width + (size_t)x);
        double total = (double)room->totals[x % j->period.texels], r[3], rgb[3] = { 0 };

        for (int v = 0; v < 3 * LANES; v++)
            rgb[v / LANES] += (double)room->sums[(size_t)x * 3 * LANES + (size_t)v] / total;
        if (!(total > 0)) { /* a lobe between the texels */
            pe_latlong_direction((x + 0.5) / j->width, (y + 0.5) / j->height, r);
            pe_env_lookup(j->env, r, rgb);
        }
        for (int c = 0; c < 3; c++)
            texel[c] = (float)rgb[c];
    }
}

static int fill_row(size_t y, void *data)
{
    job *j = data;
    const pe_env *env = j->strip.env;
    double polar = M_PI * ((double)y + 0.5) / j->height;
    int enough;
    row_room room = { malloc((size_t)env->height * sizeof *room.spans),
                      malloc(((size_t)env->width + LANES) * sizeof *room.weights),
                      calloc((size_t)j->width * 3 * LANES, sizeof *room.sums),
                      malloc((size_t)j->period.texels * sizeof *room.totals) };

    enough = room.spans && room.weights && room.sums && room.totals;
    if (enough) {
        int count = make_spans(j, polar, room.spans);

        for (int x = 0; x < j->period.texels; x++)
            add_spans(j, polar, x, count, &room);
        store_row(j, (int)y, &room);
    }
    free(room.spans);
    free(room.weights);
    free(room.sums);
    free(room.totals);
    return enough;
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
        j.period.count = gcd(j.width, j.strip.env->width);
        j.period.texels = j.width / j.period.count;
        j.period.columns = j.strip.env->width / j.period.count;
        status = pe_parallel_try((size_t)j.height, threads, fill_row, &j, &part, "a layer", error);
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
