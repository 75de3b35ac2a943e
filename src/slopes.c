/* slopes.c - slopes of a surface, from heights or a normal map, and their mean and spread. */
#include "image.h"
#include "status.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#define MARGIN 3 /* of the seven-point formula */

void pe_slopes_free(pe_slopes *slopes)
{
    if (!slopes)
        return;
    free(slopes->p);
    free(slopes->q);
    *slopes = (pe_slopes){ 0 };
}

static pe_status allocate(size_t count, pe_slopes *slopes, pe_error *error)
{
    *slopes = (pe_slopes){ .p = malloc(count * sizeof(float)), .q = malloc(count * sizeof(float)) };
    if (slopes->p && slopes->q)
        return PE_OK;
    pe_slopes_free(slopes);
    return pe_fail_memory(error, "slopes");
}

/* Slopes that are not numbers, for a height that was not measured is near, are none. */
static void add(pe_slopes *slopes, double p, double q)
{
    if (!isfinite((float)p) || !isfinite((float)q))
        return;
    slopes->p[slopes->count] = (float)p;
    slopes->q[slopes->count++] = (float)q;
}

/* ---- the chess board ---- */

#define SQUARES 8 /* along a side */

/* So that either half holds some of every row and every column, whatever the grooves are. */
static bool is_white(int x, int y, int width, int height)
{
    return (int)((long long)x * SQUARES / width + (long long)y * SQUARES / height) % 2;
}

/* ---- heights ---- */

/* The derivative at the middle of seven values a texel apart, exact up to the sixth power.  [ISO 25178-2] */
static double seven_point(const float *values, const size_t at[7])
{
    const double far = (double)values[at[6]] - (double)values[at[0]];
    const double between = (double)values[at[5]] - (double)values[at[1]];
    const double near = (double)values[at[4]] - (double)values[at[2]];

    return (far - 9 * between + 45 * near) / 60;
}

/* Indices of the seven texels around `middle` on a line of `count`, repeating, as multiples of `step` from `start`. */
static void indices_around(int middle, int count, size_t start, size_t step, size_t at[7])
{
    for (int k = -MARGIN; k <= MARGIN; k++)
        at[k + MARGIN] = start + (size_t)((middle + k + count) % count) * step;
}

static void add_texel(const pe_heights *heights, int x, int y, pe_slopes *slopes)
{
    size_t width = (size_t)heights->width, row[7], column[7];

    indices_around(x, heights->width, (size_t)y * width, 1, row);
    indices_around(y, heights->height, (size_t)x, width, column);
    if (isfinite(heights->values[row[MARGIN]]))
        add(slopes, -seven_point(heights->values, row) / heights->pitch,
            -seven_point(heights->values, column) / heights->pitch);
}

static void add_squares(const pe_heights *heights, int margin, bool white, pe_slopes *slopes)
{
    for (int y = margin; y < heights->height - margin; y++)
        for (int x = margin; x < heights->width - margin; x++)
            if (is_white(x, y, heights->width, heights->height) == white)
                add_texel(heights, x, y, slopes);
}

static pe_status check_heights(const pe_heights *heights, pe_error *error)
{
    if (heights->width < PE_HEIGHTS_SIDE_MIN || heights->height < PE_HEIGHTS_SIDE_MIN ||
        (long long)heights->width * heights->height > PE_IMAGE_TEXELS_MAX)
        return pe_fail(error, PE_ERROR_ARGUMENT, "%d x %d heights are out of range: each side is at least %d",
                       heights->width, heights->height, PE_HEIGHTS_SIDE_MIN);
    if (!(heights->pitch > 0 && isfinite(heights->pitch)))
        return pe_fail(error, PE_ERROR_ARGUMENT, "a pitch of %g is no distance of texels", heights->pitch);
    return PE_OK;
}

/* A formula with weights w makes sqrt(sum w^2) of a root mean square error; rounding to a step makes step / sqrt 12. */
static double noise_of_step(double step)
{
    return step * sqrt(2 * (1 * 1 + 9 * 9 + 45 * 45)) / 60 / sqrt(12);
}

pe_status pe_slopes_of_heights(const pe_heights *heights, pe_edges edges, pe_slopes *slopes, pe_error *error)
{
    int margin = edges == PE_EDGES_WRAP ? 0 : MARGIN;
    pe_slopes found;
    pe_status status = check_heights(heights, error);

    if (status == PE_OK)
        status = allocate((size_t)heights->width * (size_t)heights->height, &found, error);
    if (status != PE_OK)
        return status;
    add_squares(heights, margin, false, &found);
    found.black = found.count;
    add_squares(heights, margin, true, &found);
    found.missing = (size_t)heights->width * (size_t)heights->height - found.count;
    found.noise = noise_of_step(heights->step / heights->pitch);
    if (found.count == 0) {
        pe_slopes_free(&found);
        return pe_fail(error, PE_ERROR_FORMAT, "no texel has measured heights all around it, three to each side");
    }
    *slopes = found;
    return PE_OK;
}

/* ---- normals ---- */

static void add_normals(const pe_image *image, double down, bool white, pe_slopes *slopes)
{
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            size_t k = (size_t)y * (size_t)image->width + (size_t)x;
            const float *c = image->rgb + 3 * k;
            double h[3] = { 2 * (double)c[0] - 1, down * (2 * (double)c[1] - 1), 2 * (double)c[2] - 1 };
            bool faces_out = h[2] > 0 && !(image->alpha && image->alpha[k] <= 0.5f);

            if (faces_out && is_white(x, y, image->width, image->height) == white)
                add(slopes, h[0] / h[2], h[1] / h[2]);
        }
}

pe_status pe_slopes_of_normals(const pe_image *image, const char *name, pe_green green, pe_slopes *slopes,
                               pe_error *error)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    double down = green == PE_GREEN_DOWN ? 1 : -1;
    pe_slopes found;
    pe_status status = allocate(count, &found, error);

    if (status != PE_OK)
        return status;
    add_normals(image, down, false, &found);
    found.black = found.count;
    add_normals(image, down, true, &found);
    found.missing = count - found.count;
    found.step = 2 * pe_image_step(image);
    found.noise = found.step / sqrt(12);
    if (found.count == 0) {
        pe_slopes_free(&found);
        return pe_fail(error, PE_ERROR_FORMAT, "%s: no texel holds a normal that faces out of the surface", name);
    }
    *slopes = found;
    return PE_OK;
}

/* ---- statistics ---- */

void pe_slopes_measure(const pe_slopes *slopes, pe_slope_statistics *statistics)
{
    double sum[2] = { 0, 0 }, squares[2] = { 0, 0 }, n = (double)slopes->count;
    pe_slope_statistics s = { .steepest = 0 };

    for (size_t k = 0; k < slopes->count; k++) {
        sum[0] += (double)slopes->p[k];
        sum[1] += (double)slopes->q[k];
    }
    for (int axis = 0; axis < 2; axis++)
        s.mean[axis] = sum[axis] / n;
    for (size_t k = 0; k < slopes->count; k++) {
        double p = (double)slopes->p[k] - s.mean[0], q = (double)slopes->q[k] - s.mean[1];

        squares[0] += p * p;
        squares[1] += q * q;
        s.steepest = fmax(s.steepest, hypot(p, q));
    }
    for (int axis = 0; axis < 2; axis++) {
        s.rms[axis] = sqrt(squares[axis] / n);
        s.alpha[axis] = M_SQRT2 * s.rms[axis];
    }
    *statistics = s;
}

void pe_slopes_level(pe_slopes *slopes)
{
    pe_slope_statistics statistics;

    pe_slopes_measure(slopes, &statistics);
    for (size_t k = 0; k < slopes->count; k++) {
        slopes->p[k] = (float)((double)slopes->p[k] - statistics.mean[0]);
        slopes->q[k] = (float)((double)slopes->q[k] - statistics.mean[1]);
    }
}

/* t' = b, b' = n x b = -t: so p' = q, q' = -p. */
void pe_slopes_turn(pe_slopes *slopes)
{
    for (size_t k = 0; k < slopes->count; k++) {
        float p = slopes->p[k];

        slopes->p[k] = slopes->q[k];
        slopes->q[k] = -p;
    }
}
