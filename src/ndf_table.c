/* ndf_table.c - a measured distribution: a grid over the plane of slopes, bilinear between its samples.
 *
 * Sample (x, y) stands for a tent, 1 at its point and 0 at its neighbours', so that
 *
 *     P(p, q) = sum_xy d_xy tent((p - p_x) / p_step) tent((q - q_y) / q_step),
 *
 * whose integral is p_step q_step sum_xy d_xy whatever the samples are.  It is also how a slope is drawn: a row, one of
 * its samples, and a place under the tent of each. */
#include "ndf.h"

#include "exr.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define VERSION 1
#define SIDE_MIN 2
#define SIDE_MAX 8192
#define SAMPLES_MAX ((size_t)1 << 24)
#define SLOPE_MAX 1000.0 /* tan(theta_h): 89.94 degrees */

/* ---- make ---- */

static pe_status check_range(const char *which, const double range[2], pe_error *error)
{
    if (range[0] >= -SLOPE_MAX && range[1] <= SLOPE_MAX && range[1] - range[0] >= 1e-6)
        return PE_OK;
    return pe_fail(error, PE_ERROR_ARGUMENT,
                   "a table's range of slopes %s from %g to %g is not one within -%g to %g, at least 1e-6 wide", which,
                   range[0], range[1], SLOPE_MAX, SLOPE_MAX);
}

static pe_status check_samples(long long width, long long height, pe_error *error)
{
    int is_small = width < SIDE_MIN || height < SIDE_MIN;

    if (!is_small && width <= SIDE_MAX && height <= SIDE_MAX && (size_t)(width * height) <= SAMPLES_MAX)
        return PE_OK;
    return pe_fail(error, is_small ? PE_ERROR_ARGUMENT : PE_ERROR_LIMIT,
                   "a table of %lld x %lld slopes is out of range; each side lies between %d and %d, and there are at "
                   "most %zu in all",
                   width, height, SIDE_MIN, SIDE_MAX, SAMPLES_MAX);
}

static pe_status sum_up(int width, int height, const float *density, double *sum, pe_error *error)
{
    *sum = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double d = (double)density[(size_t)y * (size_t)width + (size_t)x];

            if (!(d >= 0 && d < INFINITY))
                return pe_fail(error, PE_ERROR_ARGUMENT, "the density of slopes at %d, %d of the table is %g", x, y, d);
            *sum += d;
        }
    if (!(*sum > 0))
        return pe_fail(error, PE_ERROR_ARGUMENT, "the table's density of slopes is 0 everywhere");
    return PE_OK;
}

/* The samples in their frame, scaled; and the sums to draw from. */
static void fill(pe_ndf_table *t, const float *density, double sum)
{
    double scale = 1 / (sum * t->p_step * t->q_step), before = 0;

    for (int y = 0; y < t->height; y++) {
        const float *from = density + (size_t)y * (size_t)t->width;
        float *to = t->density + (size_t)(y + 1) * (size_t)t->row + 1;
        float *sums = t->sums + (size_t)y * (size_t)(t->width + 1);
        double row = 0, within = 0;

        for (int x = 0; x < t->width; x++) {
            to[x] = (float)((double)from[x] * scale);
            row += (double)from[x];
        }
        t->row_sums[y] = (float)(before / sum);
        before += row;
        for (int x = 0; x < t->width; x++) {
            within += (double)from[x];
            sums[x + 1] = row > 0 ? (float)(within / row) : 0;
        }
    }
    t->row_sums[t->height] = 1;
}

static double p_of(const pe_ndf_table *t, int x)
{
    return t->p_min + (x + 0.5) * t->p_step;
}

static double q_of(const pe_ndf_table *t, int y)
{
    return t->q_min + (y + 0.5) * t->q_step;
}

/* The mean square of slopes and of the density's steps from sample to sample. */
static void measure_widths(pe_ndf_table *t)
{
    double pp = 0, pq = 0, qq = 0, square = 0, steps[2] = { 0, 0 }, cell = t->p_step * t->q_step;

    for (int y = 0; y <= t->height; y++)
        for (int x = 0; x <= t->width; x++) {
            const float *d = t->density + (size_t)y * (size_t)t->row + (size_t)x;
            double here = (double)d[0], right = (double)d[1] - here, down = (double)d[t->row] - here;

            pp += here * p_of(t, x - 1) * p_of(t, x - 1);
            pq += here * p_of(t, x - 1) * q_of(t, y - 1);
            qq += here * q_of(t, y - 1) * q_of(t, y - 1);
            square += here * here;
            steps[0] += right * right;
            steps[1] += down * down;
        }
    /* a tent of half width w has the mean square w^2 / 6 */
    t->moments[0] = pp * cell + t->p_step * t->p_step / 6;
    t->moments[1] = pq * cell;
    t->moments[2] = qq * cell + t->q_step * t->q_step / 6;
    t->alpha[0] = sqrt(2 * t->moments[0]);
    t->alpha[1] = sqrt(2 * t->moments[2]);
    t->fineness[0] = t->p_step * sqrt(square / steps[0]);
    t->fineness[1] = t->q_step * sqrt(square / steps[1]);
}

/* Each sample reaches to its tent's far corner, and its D is at most what it would be there. */
static void measure_reach(pe_ndf_table *t)
{
    double greatest = 0;

    for (int pass = 0; pass < 2; pass++)
        for (int y = 0; y < t->height; y++)
            for (int x = 0; x < t->width; x++) {
                double density = (double)t->density[(size_t)(y + 1) * (size_t)t->row + (size_t)x + 1];
                double m = hypot(fabs(p_of(t, x)) + t->p_step, fabs(q_of(t, y)) + t->q_step);
                double d = density * (1 + m * m) * (1 + m * m), limit = ceil(log(greatest / d));

                if (pass == 0)
                    greatest = fmax(greatest, d);
                else if (d > 0 && limit < PE_NDF_LIMITS)
                    t->reach[(int)limit] = fmax(t->reach[(int)limit], m);
                else if (d > 0)
                    t->reach[PE_NDF_LIMITS - 1] = fmax(t->reach[PE_NDF_LIMITS - 1], m);
            }
    t->peak = greatest;
    for (int limit = 1; limit < PE_NDF_LIMITS; limit++)
        t->reach[limit] = fmax(t->reach[limit], t->reach[limit - 1]);
}

static pe_status allocate(int width, int height, const char *name, pe_ndf_table **out, pe_error *error)
{
    pe_ndf_table *t = calloc(1, sizeof *t);

    if (t) {
        t->width = width;
        t->height = height;
        t->row = width + 2;
        t->name = strdup(name);
        t->density = calloc((size_t)t->row * (size_t)(height + 2), sizeof *t->density);
        t->row_sums = calloc((size_t)height + 1, sizeof *t->row_sums);
        t->sums = calloc((size_t)(width + 1) * (size_t)height, sizeof *t->sums);
    }
    if (!t || !t->name || !t->density || !t->row_sums || !t->sums) {
        pe_ndf_table_free(t);
        return pe_fail(error, PE_ERROR_MEMORY, "not enough memory for a table of %d x %d slopes", width, height);
    }
    *out = t;
    return PE_OK;
}

static pe_status create(int width, int height, const double p_range[2], const double q_range[2], const float *density,
                        const char *name, pe_ndf_table **table, pe_error *error)
{
    pe_ndf_table *t;
    double sum;
    pe_status status = check_samples(width, height, error);

    if (status == PE_OK)
        status = check_range("p", p_range, error);
    if (status == PE_OK)
        status = check_range("q", q_range, error);
    if (status == PE_OK)
        status = sum_up(width, height, density, &sum, error);
    if (status == PE_OK)
        status = allocate(width, height, name, &t, error);
    if (status != PE_OK)
        return status;
    t->p_min = p_range[0];
    t->q_min = q_range[0];
    t->p_step = (p_range[1] - p_range[0]) / width;
    t->q_step = (q_range[1] - q_range[0]) / height;
    fill(t, density, sum);
    measure_widths(t);
    measure_reach(t);
    if (!pe_ndf_table_mask(t)) {
        pe_ndf_table_free(t);
        return pe_fail_memory(error, "a table of slopes");
    }
    *table = t;
    return PE_OK;
}

pe_status pe_ndf_table_create(int width, int height, const double p_range[2], const double q_range[2],
                              const float *density, pe_ndf_table **table, pe_error *error)
{
    return create(width, height, p_range, q_range, density, "", table, error);
}

void pe_ndf_table_free(pe_ndf_table *table)
{
    if (!table)
        return;
    free(table->name);
    free(table->density);
    free(table->masking);
    free(table->row_sums);
    free(table->sums);
    free(table);
}

const char *pe_ndf_table_name(const pe_ndf_table *table)
{
    return table->name;
}

void pe_ndf_table_size(const pe_ndf_table *table, int *width, int *height, double p_range[2], double q_range[2])
{
    *width = table->width;
    *height = table->height;
    p_range[0] = table->p_min;
    p_range[1] = table->p_min + table->width * table->p_step;
    q_range[0] = table->q_min;
    q_range[1] = table->q_min + table->height * table->q_step;
}

void pe_ndf_table_alpha(const pe_ndf_table *table, double alpha[2])
{
    alpha[0] = table->alpha[0];
    alpha[1] = table->alpha[1];
}

/* ---- look up and draw ---- */

double pe_ndf_table_density(const pe_ndf_table *t, double p, double q)
{
    double x = (p - t->p_min) / t->p_step + 0.5, y = (q - t->q_min) / t->q_step + 0.5, u, v;
    const float *d;

    if (!(x > 0 && y > 0 && x < t->width + 1 && y < t->height + 1))
        return 0;
    d = t->density + (size_t)y * (size_t)t->row + (size_t)x;
    u = x - floor(x);
    v = y - floor(y);
    return (1 - v) * ((1 - u) * (double)d[0] + u * (double)d[1]) +
           v * ((1 - u) * (double)d[t->row] + u * (double)d[t->row + 1]);
}

/* A place under a tent of half width 1, from u in [0, 1]. */
static double draw_tent(double u)
{
    return u < 0.5 ? sqrt(2 * u) - 1 : 1 - sqrt(2 * (1 - u));
}

/* The last index k below `count` with sums[k] <= u; what is left of u within it goes to *rest. */
static int draw_index(const float *sums, int count, double u, double *rest)
{
    int low = 0, high = count;

    while (high - low > 1) {
        int middle = (low + high) / 2;

        if ((double)sums[middle] <= u)
            low = middle;
        else
            high = middle;
    }
    *rest = fmin(fmax((u - (double)sums[low]) / (double)(sums[low + 1] - sums[low]), 0), 1);
    return low;
}

void pe_ndf_table_sample(const pe_ndf_table *t, double u1, double u2, double *p, double *q)
{
    double rest;
    int y = draw_index(t->row_sums, t->height, u1, &rest), x;

    *q = q_of(t, y) + t->q_step * draw_tent(rest);
    x = draw_index(t->sums + (size_t)y * (size_t)(t->width + 1), t->width, u2, &rest);
    *p = p_of(t, x) + t->p_step * draw_tent(rest);
}

/* ---- file: one float channel Y, the first row at the least q ---- */

static pe_attribute number(const char *name, double value)
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_DOUBLE, .number = value };
}

static pe_attribute version_attribute(void)
{
    return (pe_attribute){ .name = "prefenv:ndf-version", .type = PE_ATTRIBUTE_INT, .integer = VERSION };
}

pe_status pe_ndf_table_write(const pe_ndf_table *t, const char *path, pe_error *error)
{
    const pe_attribute attributes[] = {
        version_attribute(),
        number("prefenv:ndf-p-min", t->p_min),
        number("prefenv:ndf-p-max", t->p_min + t->width * t->p_step),
        number("prefenv:ndf-q-min", t->q_min),
        number("prefenv:ndf-q-max", t->q_min + t->height * t->q_step),
    };
    float *plain = malloc((size_t)t->width * (size_t)t->height * sizeof *plain);
    unsigned char *bytes;
    size_t size;
    pe_status status;

    if (!plain)
        return pe_fail_memory(error, "a table of slopes");
    for (int y = 0; y < t->height; y++)
        memcpy(plain + (size_t)y * (size_t)t->width, t->density + (size_t)(y + 1) * (size_t)t->row + 1,
               (size_t)t->width * sizeof *plain);
    status = pe_exr_encode_gray(plain, t->width, t->height, attributes, sizeof attributes / sizeof *attributes, &bytes,
                                &size, error);
    free(plain);
    if (status != PE_OK)
        return status;
    status = pe_file_write(path, bytes, size, error);
    free(bytes);
    return status;
}

static pe_status read_ranges(const pe_exr_file *file, const char *name, double p_range[2], double q_range[2],
                             pe_error *error)
{
    static const char *const names[4] = { "prefenv:ndf-p-min", "prefenv:ndf-p-max", "prefenv:ndf-q-min",
                                          "prefenv:ndf-q-max" };
    double *const values[4] = { &p_range[0], &p_range[1], &q_range[0], &q_range[1] };
    pe_attribute version = version_attribute();

    if (!pe_exr_get_attribute(file, 0, &version))
        return pe_fail(error, PE_ERROR_FORMAT,
                       "%s: is not a table of slopes; make one of a height field or a normal map with prefenv ndf",
                       name);
    if (version.integer != VERSION)
        return pe_fail(error, PE_ERROR_FORMAT, "%s: is a table of slopes of version %d, and %d is read here", name,
                       version.integer, VERSION);
    for (int k = 0; k < 4; k++) {
        pe_attribute a = number(names[k], 0);

        if (!pe_exr_get_attribute(file, 0, &a))
            return pe_fail(error, PE_ERROR_FORMAT, "%s: has no attribute %s", name, names[k]);
        *values[k] = a.number;
    }
    return PE_OK;
}

/* The channel Y comes three times, as red, green and blue. */
static pe_status read_density(const pe_exr_file *file, int width, int height, float **density, pe_error *error)
{
    size_t count = (size_t)width * (size_t)height;
    float *rgb = malloc(3 * count * sizeof *rgb);
    pe_status status;

    if (!rgb)
        return pe_fail_memory(error, "a table of slopes");
    status = pe_exr_read_part(file, 0, rgb, error);
    if (status != PE_OK) {
        free(rgb);
        return status;
    }
    for (size_t k = 0; k < count; k++)
        rgb[k] = rgb[3 * k];
    *density = rgb;
    return PE_OK;
}

static pe_status read_table(const pe_exr_file *file, const char *name, pe_ndf_table **table, pe_error *error)
{
    double p_range[2] = { 0, 0 }, q_range[2] = { 0, 0 };
    long long width, height;
    float *density = NULL;
    pe_error inner = { PE_OK, "" };
    pe_status status = read_ranges(file, name, p_range, q_range, error);

    if (status != PE_OK)
        return status;
    pe_exr_part_size(file, 0, &width, &height);
    status = check_samples(width, height, &inner);
    if (status == PE_OK)
        status = read_density(file, (int)width, (int)height, &density, &inner);
    if (status == PE_OK)
        status = create((int)width, (int)height, p_range, q_range, density, pe_base_name(name), table, &inner);
    free(density);
    if (status != PE_OK)
        return pe_fail(error, status == PE_ERROR_ARGUMENT ? PE_ERROR_FORMAT : status, "%s: %s", name, inner.message);
    return PE_OK;
}

int pe_ndf_table_detect(const void *bytes, size_t size)
{
    pe_attribute version = version_attribute();

    return pe_exr_carries(bytes, size, &version);
}

pe_status pe_ndf_table_read_memory(const void *bytes, size_t size, const char *name, pe_ndf_table **table,
                                   pe_error *error)
{
    pe_exr_file *file;
    pe_status status;

    if (!pe_exr_detect(bytes, size))
        return pe_fail(error, PE_ERROR_FORMAT, "%s: is not an OpenEXR file; make a table of slopes with prefenv ndf",
                       name);
    status = pe_exr_open(bytes, size, name, &file, error);
    if (status != PE_OK)
        return status;
    status = read_table(file, name, table, error);
    pe_exr_close(file);
    return status;
}

pe_status pe_ndf_table_read(const char *path, pe_ndf_table **table, pe_error *error)
{
    unsigned char *bytes;
    size_t size;
    pe_status status = pe_file_read(path, &bytes, &size, error);

    if (status != PE_OK)
        return status;
    status = pe_ndf_table_read_memory(bytes, size, path, table, error);
    free(bytes);
    return status;
}

/* From the horizon down, by angles of a four thousandth of a quarter turn.  Between the centres of cells the density is
 * bilinear, so that what one holds may be as far out as its neighbours' centres. */
double pe_ndf_table_spread(const pe_ndf_table *table, double share)
{
    enum { STEPS = 4000 };
    double held[STEPS + 1] = { 0 }, sum = 0, beyond = 0;
    int step = STEPS;

    for (int y = 0; y < table->height; y++)
        for (int x = 0; x < table->width; x++) {
            double p = fabs(table->p_min + (x + 0.5) * table->p_step) + table->p_step;
            double q = fabs(table->q_min + (y + 0.5) * table->q_step) + table->q_step;
            float density = table->density[(size_t)(y + 1) * (size_t)table->row + (size_t)x + 1];

            held[(int)(atan(hypot(p, q)) / (M_PI / 2) * STEPS)] += density;
            sum += density;
        }
    while (step > 0 && (beyond += held[step]) <= share * sum)
        step--;
    return (step + 1.0) / STEPS * (M_PI / 2);
}
