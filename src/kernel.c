/* kernel.c - see kernel.h.
 *
 * A cell has one weight, D, or, for PE_WEIGHT_MICROFACET, four: D G2, and that times F of each channel.
 *
 * Of a texel's kernel, a window about the mirror direction is evaluated and turned into spline coefficients; in each of
 * its rows, what is not negligible is kept, as a span. */
#include "kernel.h"

#include "lanes.h"
#include "parallel.h"
#include "quad.h"
#include "spline.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>

/* Half vectors of a density below exp(-LIMIT) of the greatest do not count. */
#define LIMIT 14.0
#define SLOPE_MAX 100.0 /* where a density never falls so low */
/* Coefficients below this share of the greatest are left out; of several weights, the first decides. */
#define NEGLIGIBLE 1e-5
#define PAST 8 /* floats after a row's weights: they are read eight at a time, of which four may count */

typedef struct span {
    int cell, count; /* neighbours in a row of cells */
    size_t weights;  /* number of the first one's, of `terms` each */
} span;

typedef struct texel {
    int place;
    float o[3];
    size_t spans, span_count;
} texel;

/* A row of the picture. */
typedef struct row {
    texel *texels;
    span *spans;
    float *weights;
    size_t texel_count, span_count, span_room, weight_count, weight_room;
    int failed;
} row;

enum { TERMS = 4 };

struct pe_kernel {
    const pe_lobe *lobe; /* while it is made */
    pe_disc map, cells;
    int terms;       /* weights of each cell: 1 or TERMS */
    float *lambda;   /* while it is made, of TERMS: Lambda of each cell */
    double reach[2]; /* the slopes along t and b that count */
    row *rows;
};

/* ---- sizes ---- */

#define PITCH 0.25 /* of alpha, for an error of PITCH_ERROR, which goes with its fourth power */
#define PITCH_ERROR 0.002
#define MICROFACET_ERROR 3.0 /* times as large: G2 has a crease on the horizon */
#define PITCH_MIN 0.12
#define PITCH_MAX 0.42

pe_disc pe_kernel_cells(const pe_lobe *lobe, double wanted)
{
    double scale = lobe->surface.weight == PE_WEIGHT_MICROFACET ? MICROFACET_ERROR : 1;
    double pitch = PITCH * pow(wanted / (scale * PITCH_ERROR), 0.25), fineness[2];

    pitch = fmin(fmax(pitch, PITCH_MIN), PITCH_MAX);
    pe_ndf_fineness(&lobe->surface.ndf, fineness);
    return (pe_disc){ (int)fmin(2 / (pitch * fineness[0]) + 2 * PE_DISC_MARGIN, 8192) + 1,
                      (int)fmin(2 / (pitch * fineness[1]) + 2 * PE_DISC_MARGIN, 8192) + 1 };
}

#define BYTES_MAX 5e8
#define SPAN_CELLS 600.0 /* that a lobe covers */
#define CELLS_MAX 1e6    /* each thread holds 64 bytes of each */
#define WIDE_CELLS_MAX 1.6e4

static int terms_of(const pe_lobe *lobe)
{
    return lobe->surface.weight == PE_WEIGHT_MICROFACET ? TERMS : 1;
}

int pe_kernel_suits(const pe_lobe *lobe, const pe_disc *cells, int width, int height)
{
    /* What is not Gaussian may cover all cells. */
    int is_narrow = lobe->surface.ndf.kind == PE_NDF_BECKMANN;

    return 0.8 * width * height * SPAN_CELLS * terms_of(lobe) * sizeof(float) < BYTES_MAX &&
           (double)cells->width * cells->height < (is_narrow ? CELLS_MAX : WIDE_CELLS_MAX);
}

/* ---- make ---- */

/* The direction of a cell, in its turn below the horizon, which the spline reaches across. */
static void cell_direction(const pe_disc *cells, int x, int y, double w[3])
{
    double p = (x + 0.5 - cells->width / 2.0) / pe_disc_radius(cells->width);
    double q = (y + 0.5 - cells->height / 2.0) / pe_disc_radius(cells->height);
    double square = fmin(p * p + q * q, 1.9), scale = sqrt(2 - square);

    w[0] = p * scale;
    w[1] = q * scale;
    w[2] = 1 - square;
}

static float density(const pe_kernel *k, const double o[3], const double w[3])
{
    double h[3] = { o[0] + w[0], o[1] + w[1], o[2] + w[2] };

    double p = h[0] / k->reach[0], q = h[1] / k->reach[1];

    if (!(h[2] > 0) || p * p + q * q > h[2] * h[2])
        return 0;
    pe_normalize(h, h);
    return (float)pe_ndf_evaluate(&k->lobe->surface.ndf, h);
}

/* Where the viewer o sees a light in a mirror of normal h, on the unit disc; h is not unit. */
static void mirror_point(const double o[3], const double h[3], double point[2])
{
    double unit[3], w[3], scale;

    pe_normalize(h, unit);
    pe_reflect(o, unit, w);
    scale = 1 / sqrt(fmax(1 + w[2], 0.1));
    point[0] = w[0] * scale;
    point[1] = w[1] * scale;
}

enum { RIM = 24, RINGS = 4 }; /* half vectors around the lobe */
#define REACH_OF_ALL 1.5      /* reflects to everywhere */

/* The cells that may matter: those about the lights that half vectors on the lobe's rim reflect to the viewer, and on
 * rings within, for the rim's may be below the horizon and beyond; widened by a part, and a few more for the spline. */
static pe_rect window_of(const pe_kernel *k, const double o[3])
{
    double centre[2], extent[2] = { 0, 0 }, middle[2];
    static const double straight[3] = { 0, 0, 1 };

    if (fmax(k->reach[0], k->reach[1]) > REACH_OF_ALL)
        return (pe_rect){ 0, 0, k->cells.width, k->cells.height };
    mirror_point(o, straight, centre);
    for (int i = 0; i < RIM * RINGS; i++) {
        double angle = 2 * M_PI * i / (RIM * RINGS), ring = (i % RINGS + 1.0) / RINGS, point[2];
        const double h[3] = { ring * k->reach[0] * cos(angle), ring * k->reach[1] * sin(angle), 1 };

        mirror_point(o, h, point);
        for (int c = 0; c < 2; c++)
            extent[c] = fmax(extent[c], fabs(point[c] - centre[c]));
    }
    for (int c = 0; c < 2; c++) {
        int side = c ? k->cells.height : k->cells.width;

        middle[c] = centre[c] * pe_disc_radius(side) + side / 2.0;
        extent[c] = 1.1 * extent[c] * pe_disc_radius(side) + 3;
    }
    return (pe_rect){ (int)fmax(0, middle[0] - extent[0]), (int)fmax(0, middle[1] - extent[1]),
                      (int)fmin(k->cells.width, middle[0] + extent[0] + 1),
                      (int)fmin(k->cells.height, middle[1] + extent[1] + 1) };
}

/* F of a channel of the lobe, o.h = c: filter.c has the same. */
static float reflectance(const pe_lobe *lobe, int channel, double c)
{
    const float *terms = lobe->reflectance[channel];
    float x = (float)(2 * c * (1 + (double)lobe->knee) / (c + (double)lobe->knee) - 1), f;

    f = terms[PE_REFLECTANCE_TERMS - 1];
    for (int k = PE_REFLECTANCE_TERMS - 2; k >= 0; k--)
        f = f * x + terms[k];
    return f;
}

/* The four weights of a cell, of the D given.  G2 falls to 0 on the horizon, and goes on below as it came. */
static void scatter(const pe_kernel *k, const double o[3], float lambda_o, int cell, const double w[3], float d,
                    float weights[TERMS])
{
    double c = sqrt(fmax(0.5 * (1 + pe_dot(o, w)), 0));

    weights[0] = (w[2] < 0 ? -d : d) / (1 + lambda_o + k->lambda[cell]);
    for (int channel = 0; channel < 3; channel++)
        weights[1 + channel] = weights[0] != 0 ? weights[0] * reflectance(k->lobe, channel, c) : 0;
}

static void fill_window(const pe_kernel *k, const pe_rect *window, const double o[3], float *values)
{
    int width = window->right - window->left, height = window->bottom - window->top;
    float lambda_o = k->lambda ? (float)pe_ndf_lambda(&k->lobe->surface.ndf, o) : 0;

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int column = window->left + x, line = window->top + y;
            float *weights = values + k->terms * (y * width + x);
            double w[3];

            cell_direction(&k->cells, column, line, w);
            weights[0] = density(k, o, w);
            if (k->lambda)
                scatter(k, o, lambda_o, line * k->cells.width + column, w, weights[0], weights);
        }
    pe_spline_coefficients(values, width, height, k->terms);
}

/* Of a cell below the horizon, that of its mirror image. */
static int make_lambda(pe_kernel *k)
{
    k->lambda = malloc((size_t)k->cells.width * (size_t)k->cells.height * sizeof *k->lambda);
    for (int cell = 0; k->lambda && cell < k->cells.width * k->cells.height; cell++) {
        double w[3];

        cell_direction(&k->cells, cell % k->cells.width, cell / k->cells.width, w);
        w[2] = fmax(fabs(w[2]), PE_HORIZON);
        k->lambda[cell] = (float)pe_ndf_lambda(&k->lobe->surface.ndf, w);
    }
    return k->lambda != NULL;
}

/* Room for `more` elements; false if there is no memory. */
static int make_room(void **array, size_t *room, size_t needed, size_t size)
{
    void *larger;

    if (needed <= *room)
        return 1;
    *room = 2 * needed + 256;
    larger = realloc(*array, *room * size);
    if (!larger)
        return 0;
    *array = larger;
    return 1;
}

/* What is not negligible of a row of the window. */
static void keep_span(row *r, int terms, int cell, const float *values, int width, float least)
{
    int first = 0, last = width - 1;
    int count;

    while (first < width && !(fabsf(values[first * terms]) > least))
        first++;
    while (last > first && !(fabsf(values[last * terms]) > least))
        last--;
    if (first > last)
        return;
    if (!make_room((void **)&r->spans, &r->span_room, r->span_count + 1, sizeof *r->spans) ||
        !make_room((void **)&r->weights, &r->weight_room, (r->weight_count + (size_t)width) * (size_t)terms + PAST,
                   sizeof *r->weights)) {
        r->failed = 1;
        return;
    }
    count = last - first + 1;
    r->spans[r->span_count++] = (span){ cell + first, count, r->weight_count };
    memcpy(r->weights + (size_t)terms * r->weight_count, values + first * terms,
           (size_t)count * (size_t)terms * sizeof *values);
    r->weight_count += (size_t)count;
}

static void keep_window(const pe_kernel *k, const pe_rect *window, const float *values, row *r)
{
    int width = window->right - window->left, height = window->bottom - window->top;
    float greatest = 0;

    for (int i = 0; i < width * height; i++)
        greatest = fmaxf(greatest, fabsf(values[i * k->terms]));
    for (int y = 0; y < height && !r->failed; y++)
        keep_span(r, k->terms, (window->top + y) * k->cells.width + window->left, values + y * width * k->terms, width,
                  (float)NEGLIGIBLE * greatest);
}

static void make_texel(const pe_kernel *k, int place, const double mirror[3], float *values, row *r)
{
    const double o[3] = { -mirror[0], -mirror[1], mirror[2] };
    texel *t = &r->texels[r->texel_count++];
    pe_rect window = window_of(k, o);

    *t = (texel){ place, { (float)o[0], (float)o[1], (float)o[2] }, r->span_count, 0 };
    fill_window(k, &window, o, values);
    keep_window(k, &window, values, r);
    t->span_count = r->span_count - t->spans;
}

static void make_row(size_t y, void *data)
{
    pe_kernel *k = data;
    row *r = &k->rows[y];
    float *values = malloc((size_t)k->cells.width * (size_t)k->cells.height * (size_t)k->terms * sizeof *values);

    r->texels = malloc((size_t)k->map.width * sizeof *r->texels);
    r->failed = !values || !r->texels;
    for (int x = 0; x < k->map.width && !r->failed; x++) {
        double w[3];

        if (pe_disc_direction(&k->map, x, (int)y, w))
            make_texel(k, (int)y * k->map.width + x, w, values, r);
    }
    free(values);
}

/* Closed forms reach along each axis as far as their alpha; what has a long tail, or is measured, everywhere as far. */
static void set_reach(pe_kernel *k)
{
    const pe_ndf *ndf = &k->lobe->surface.ndf;
    double farthest = fmin(pe_ndf_reach(ndf, LIMIT), SLOPE_MAX), widest = fmax(ndf->alpha_x, ndf->alpha_y);
    int is_elliptic = ndf->kind == PE_NDF_BECKMANN;

    k->reach[0] = is_elliptic ? farthest * ndf->alpha_x / widest : farthest;
    k->reach[1] = is_elliptic ? farthest * ndf->alpha_y / widest : farthest;
}

pe_status pe_kernel_make(const pe_lobe *lobe, const pe_disc *map, const pe_disc *cells, int threads,
                         const pe_report *report, pe_kernel **out, pe_error *error)
{
    pe_kernel *k = calloc(1, sizeof *k);
    pe_status status = PE_OK;
    int failed = 0;

    if (!k)
        return pe_fail_memory(error, "a kernel");
    k->lobe = lobe;
    k->map = *map;
    k->cells = *cells;
    k->terms = terms_of(lobe);
    set_reach(k);
    if (k->terms > 1 && !make_lambda(k)) {
        pe_kernel_free(k);
        return pe_fail_memory(error, "a kernel");
    }
    k->rows = calloc((size_t)map->height, sizeof *k->rows);
    if (k->rows)
        status = pe_parallel_for((size_t)map->height, threads, make_row, k, report);
    for (int y = 0; k->rows && y < map->height; y++)
        failed |= k->rows[y].failed;
    if (!k->rows || failed || status != PE_OK) {
        pe_kernel_free(k);
        return status != PE_OK ? status : pe_fail_memory(error, "a kernel");
    }
    *out = k;
    return PE_OK;
}

void pe_kernel_free(pe_kernel *k)
{
    if (!k)
        return;
    for (int y = 0; k->rows && y < k->map.height; y++) {
        free(k->rows[y].texels);
        free(k->rows[y].spans);
        free(k->rows[y].weights);
    }
    free(k->rows);
    free(k->lambda);
    free(k);
}

/* ---- use ---- */

const pe_disc *pe_kernel_map(const pe_kernel *k)
{
    return &k->map;
}

const pe_disc *pe_kernel_disc(const pe_kernel *k)
{
    return &k->cells;
}

static size_t cell_bytes(const pe_kernel *k)
{
    return (size_t)k->cells.width * (size_t)k->cells.height * LANES * sizeof(float);
}

float *pe_kernel_allocate_cells(const pe_kernel *k)
{
    return aligned_alloc(LANES * sizeof(float), cell_bytes(k));
}

void pe_kernel_clear_cells(const pe_kernel *k, float *cells)
{
    memset(cells, 0, cell_bytes(k));
}

static void spread_light(const pe_disc *cells, const float direction[3], const pe_quad *value, float *to)
{
    pe_disc_taps t;

    pe_disc_taps_at(cells, direction, &t);
    for (int j = 0; j < 4; j++) {
        float *cell = to + 4 * PE_KERNEL_GROUP * ((t.y + j - 1) * cells->width + t.x - 1);
        pe_quad part = t.down[j] * *value;

        for (int i = 0; i < 4; i++, cell += 4 * PE_KERNEL_GROUP)
            pe_quad_store(cell, pe_quad_load(cell) + t.across[i] * part);
    }
}

void pe_kernel_spread(const pe_kernel *k, const pe_lights *lights, int member, float *cells)
{
    for (size_t light = 0; light < lights->blocks * PE_LIGHT_BLOCK; light++) {
        float direction[3];
        pe_quad value;

        pe_light_at(lights, light, direction, (float *)&value);
        spread_light(&k->cells, direction, &value, cells + 4 * member);
    }
}

/* How the lanes of a cell are weighed: all by one weight, or, of four, by that of the weight itself or of the channel,
 * in the order of a group's normals, or of a strip's frames. */
typedef enum order { ONE_WEIGHT, OF_GROUP, OF_STRIP } order;

/* Half of a cell: a vector that AVX2 has, too, and that GCC's clones make well of one weight, where they fill that of a
 * whole cell lane by lane. */
typedef float half __attribute__((vector_size(32)));

INLINE half load_half(const float *from)
{
    half v;

    memcpy(&v, from, sizeof v);
    return v;
}

/* Adds a cell's half, weighed: `which` is 0 or 1. */
INLINE void add_half(order lanes, const float *weights, const float *cell, int which, half *sum)
{
    half value = load_half(cell + 8 * which), four = load_half(weights);

    if (lanes == ONE_WEIGHT)
        *sum += *weights * value;
    else if (lanes == OF_GROUP)
        *sum += __builtin_shufflevector(four, four, 0, 1, 2, 3, 0, 1, 2, 3) * value;
    else if (which == 0)
        *sum += __builtin_shufflevector(four, four, 1, 2, 3, 1, 2, 3, 1, 2) * value;
    else
        *sum += __builtin_shufflevector(four, four, 3, 1, 2, 3, 1, 2, 3, 0) * value;
}

INLINE void add_cell(order lanes, int grids, const float *weights, const float *const cells[2], size_t cell,
                     half sums[2][2])
{
    for (int g = 0; g < grids; g++)
        for (int which = 0; which < 2; which++)
            add_half(lanes, weights, cells[g] + LANES * cell, which, &sums[g][which]);
}

/* A texel's sums over one or two grids of cells, which share the reading of its weights; each by way of four partial
 * sums, so that none waits for the one before it. */
INLINE void sum_cells(order lanes, int grids, const row *r, const texel *t, const float *const cells[2], floats out[2])
{
    const size_t terms = lanes == ONE_WEIGHT ? 1 : TERMS;
    half sums[4][2][2] = { { { { 0 } } } };

    for (size_t s = t->spans; s < t->spans + t->span_count; s++) {
        const float *weights = r->weights + terms * r->spans[s].weights;
        size_t first = (size_t)r->spans[s].cell, count = (size_t)r->spans[s].count, k = 0;

        for (; k + 4 <= count; k += 4)
            for (size_t i = 0; i < 4; i++)
                add_cell(lanes, grids, weights + terms * (k + i), cells, first + k + i, sums[i]);
        for (; k < count; k++)
            add_cell(lanes, grids, weights + terms * k, cells, first + k, sums[0]);
    }
    for (int g = 0; g < grids; g++)
        for (int which = 0; which < 2; which++) {
            half sum = (sums[0][g][which] + sums[1][g][which]) + (sums[2][g][which] + sums[3][g][which]);

            memcpy((float *)&out[g] + 8 * which, &sum, sizeof sum);
        }
}

typedef void sum_function(const row *r, const texel *t, const float *const cells[2], floats out[2]);

#define SUM(name, lanes, grids) \
    CLONES static void name(const row *r, const texel *t, const float *const cells[2], floats out[2]) \
    { \
        sum_cells(lanes, grids, r, t, cells, out); \
    }

SUM(sum_group, ONE_WEIGHT, 1)
SUM(sum_group_of_four, OF_GROUP, 1)
SUM(sum_strips, ONE_WEIGHT, 2)
SUM(sum_strips_of_four, OF_STRIP, 2)

void pe_kernel_apply(const pe_kernel *k, const float *cells, pe_kernel_texel *function, void *data)
{
    sum_function *sum = k->terms > 1 ? sum_group_of_four : sum_group;
    const float *const grids[2] = { cells, cells };

    for (int y = 0; y < k->map.height; y++)
        for (size_t x = 0; x < k->rows[y].texel_count; x++) {
            const texel *t = &k->rows[y].texels[x];
            double sums[PE_KERNEL_GROUP][4];
            floats sums_of_lanes[2];

            sum(&k->rows[y], t, grids, sums_of_lanes);
            for (int lane = 0; lane < LANES; lane++)
                sums[lane / 4][lane % 4] = (double)sums_of_lanes[0][lane];
            function(t->place, t->o, (const double(*)[4])sums, data);
        }
}

void pe_kernel_apply_twice(const pe_kernel *k, const float *const cells[2], pe_kernel_lanes *function, void *data)
{
    sum_function *sum = k->terms > 1 ? sum_strips_of_four : sum_strips;

    for (int y = 0; y < k->map.height; y++)
        for (size_t x = 0; x < k->rows[y].texel_count; x++) {
            const texel *t = &k->rows[y].texels[x];
            float lanes[2][LANES];
            floats sums[2];

            sum(&k->rows[y], t, cells, sums);
            for (int g = 0; g < 2; g++)
                memcpy(lanes[g], &sums[g], sizeof lanes[g]);
            function(t->place, t->o, (const float(*)[LANES])lanes, data);
        }
}
