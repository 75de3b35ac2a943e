/* slopes_density.c - the density of slopes: how much of the area has each.
 *
 * A histogram whose every sample is spread over a box of one cell's width (linear weights to the cells that the box
 * overlaps), so that where samples fall within a cell is not lost and no cell stays empty for the comb of a source that
 * rounds.  The box adds cell^2 / 12 to the variance.
 *
 * SMOOTHING.  A picture holds some thousand slopes that are independent of each other, and their histogram is grainy.
 * Let A and B be the densities of the two halves of the slopes, A_s and B_s the same blurred.  The squared error of
 * A_s, the integral of (A_s - P)^2, is that of A_s^2 - 2 A_s P and a constant, and B, which knows nothing of the chance
 * in A, can stand for P.  So s is chosen for the least of
 *
 *     A_s^2 + B_s^2 - 2 A_s B - 2 B_s A
 *
 * [Bowman], among some shares of the rms slope of each axis.  Both halves together bear 2^(-1/6) of that: the best
 * width shrinks with the sixth root of how much is known. */
#include "status.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define BEYOND 1e-4     /* of the area, which the default range leaves out */
#define RANGE_MIN 0.004 /* of a surface however smooth: four times PE_ALPHA_MIN */
#define RANGE_MAX 100.0 /* 89.4 degrees */
#define CELL_MIN 0.0005 /* slope */
#define CELL_MAX 0.0025 /* a quarter of alpha 0.01 */
#define CELLS_HALF 64   /* from 0 to the range, if that lies between the two */
#define CELLS_MAX 1024  /* along an axis */
#define STEP_CELLS 16   /* cells in a step of the source, at most */
#define BOX_CELLS (STEP_CELLS + 3)
#define SMOOTH_REACH 4 /* in standard deviations */
#define AUTO_TAIL 0.25 /* of the rms slope: room for what smoothing may be chosen */

/* ---- the range ---- */

/* Floats above 0 are ordered as their bits are, and the upper 16 of these tell them apart to 1/128. */
static uint32_t class_of(float magnitude)
{
    uint32_t bits;

    memcpy(&bits, &magnitude, sizeof bits);
    return bits >> 16;
}

static double upper_end_of(uint32_t class)
{
    uint32_t bits = (class << 16) + 0xffff;
    float value;

    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* What holds all but BEYOND of the magnitudes. */
static pe_status find_range(const float *values, size_t count, double *range, pe_error *error)
{
    size_t *classes = calloc(0x8000, sizeof *classes), left = (size_t)(BEYOND * (double)count);
    uint32_t class = 0x7fff;

    if (!classes)
        return pe_fail_memory(error, "a table of slopes");
    for (size_t k = 0; k < count; k++)
        classes[class_of(fabsf(values[k]))]++;
    while (class > 0 && classes[class] <= left)
        left -= classes[class --];
    *range = upper_end_of(class);
    free(classes);
    return PE_OK;
}

/* Room for half a box beyond the outermost sample, and for the tail that smoothing makes. */
static pe_status choose_range(const pe_slopes *slopes, const float *values, const pe_density_options *options,
                              double rms, double *range, pe_error *error)
{
    double tail = options->smoothing == PE_SMOOTHING_GIVEN  ? SMOOTH_REACH * options->smooth
                  : options->smoothing == PE_SMOOTHING_AUTO ? AUTO_TAIL * rms
                                                            : 0;
    pe_status status;

    *range = options->range;
    if (options->range > 0)
        return PE_OK;
    status = find_range(values, slopes->count, range, error);
    if (status == PE_OK)
        *range = fmin(RANGE_MAX, fmax(*range, RANGE_MIN) * (1 + 1.0 / CELLS_HALF) + slopes->step / 2 + tail);
    return status;
}

static int choose_cells(double range, double step)
{
    double cell = fmax(fmin(fmax(range / CELLS_HALF, CELL_MIN), CELL_MAX), step / STEP_CELLS);

    return (int)fmin(fmax(ceil(2 * range / cell), 4), CELLS_MAX);
}

/* ---- the histogram ---- */

typedef struct axis {
    int cells;
    double range, cell, width; /* width: of the box */
} axis;

static axis make_axis(double range, int cells, double step)
{
    double cell = 2 * range / cells;

    return (axis){ cells, range, cell, fmin(fmax(cell, step), STEP_CELLS * cell) };
}

/* The cells that the box around `slope` overlaps, the first of them and its share in each; `first` may lie outside. */
static int spread(const axis *a, double slope, int *first, double shares[BOX_CELLS])
{
    double low = (slope - a->width / 2 + a->range) / a->cell, high = (slope + a->width / 2 + a->range) / a->cell;
    int count;

    *first = (int)floor(low);
    count = (int)ceil(high) - *first;
    count = count < BOX_CELLS ? count : BOX_CELLS;
    for (int k = 0; k < count; k++)
        shares[k] = (fmin(high, *first + k + 1) - fmax(low, *first + k)) / (high - low);
    return count;
}

static bool reaches(const axis *a, double slope)
{
    return fabs(slope) < a->range + a->width;
}

/* Returns how much of the sample fell into the cells. */
static double count_sample(const axis axes[2], double p, double q, double *cells)
{
    double p_shares[BOX_CELLS], q_shares[BOX_CELLS], inside = 0;
    int p_first, q_first, p_count, q_count;

    if (!reaches(&axes[0], p) || !reaches(&axes[1], q))
        return 0;
    p_count = spread(&axes[0], p, &p_first, p_shares);
    q_count = spread(&axes[1], q, &q_first, q_shares);
    for (int j = 0; j < q_count; j++)
        for (int i = 0; i < p_count; i++) {
            int x = p_first + i, y = q_first + j;
            double share = p_shares[i] * q_shares[j];

            if (x < 0 || x >= axes[0].cells || y < 0 || y >= axes[1].cells)
                continue;
            cells[(size_t)y * (size_t)axes[0].cells + (size_t)x] += share;
            inside += share;
        }
    return inside;
}

/* ---- smoothing ---- */

static void smooth_line(const double *weights, int reach, int count, size_t step, double *line, double *copy)
{
    for (int k = 0; k < count; k++)
        copy[k] = line[(size_t)k * step];
    for (int k = 0; k < count; k++) {
        double sum = 0;

        for (int i = -reach; i <= reach; i++)
            if (k + i >= 0 && k + i < count)
                sum += weights[i + reach] * copy[k + i];
        line[(size_t)k * step] = sum;
    }
}

static pe_status smooth_axis(const axis axes[2], int along, double sigma, double *cells, pe_error *error)
{
    const axis *a = &axes[along];
    size_t width = (size_t)axes[0].cells;
    size_t step = along == 0 ? 1 : width, stride = along == 0 ? width : 1;
    int reach = (int)fmin(ceil(SMOOTH_REACH * sigma / a->cell), a->cells), taps = 2 * reach + 1;
    double *weights = calloc((size_t)taps, sizeof *weights), *copy = calloc(CELLS_MAX, sizeof *copy);
    double sum = 0;
    pe_status status = weights && copy ? PE_OK : pe_fail_memory(error, "a density of slopes");

    for (int i = -reach; status == PE_OK && i <= reach; i++)
        sum += weights[i + reach] = i == 0 ? 1 : exp(-0.5 * pow(i * a->cell / sigma, 2));
    for (int i = 0; status == PE_OK && i < taps; i++)
        weights[i] /= sum;
    for (int line = 0; status == PE_OK && line < axes[1 - along].cells; line++)
        smooth_line(weights, reach, a->cells, step, cells + (size_t)line * stride, copy);
    free(weights);
    free(copy);
    return status;
}

static pe_status smooth_cells(const axis axes[2], const double sigma[2], double *cells, pe_error *error)
{
    pe_status status = PE_OK;

    for (int along = 0; along < 2 && status == PE_OK; along++)
        if (sigma[along] > 0)
            status = smooth_axis(axes, along, sigma[along], cells, error);
    return status;
}

/* ---- the choice of smoothing ---- */

/* Shares of the rms slope. */
static const double rms_shares[] = { 0.005, 0.01, 0.015, 0.02, 0.03, 0.04, 0.06, 0.08, 0.12, 0.16, 0.25 };
#define SHARES (int)(sizeof rms_shares / sizeof *rms_shares)

/* The counts of the black and the white half, each of `size` cells and divided by the half's own number. */
typedef struct halves {
    size_t size;
    double *black, *white, *blurred;
} halves;

static double product(const double *a, const double *b, size_t size)
{
    double sum = 0;

    for (size_t k = 0; k < size; k++)
        sum += a[k] * b[k];
    return sum;
}

/* Integral of A_s^2 - 2 A_s B, but for a factor. */
static pe_status half_score(const axis axes[2], const double sigma[2], const double *a, const double *b, halves *h,
                            double *score, pe_error *error)
{
    pe_status status;

    memcpy(h->blurred, a, h->size * sizeof *a);
    status = smooth_cells(axes, sigma, h->blurred, error);
    *score += product(h->blurred, h->blurred, h->size) - 2 * product(h->blurred, b, h->size);
    return status;
}

/* Shares grow until the score does: to the least score, as far as the list goes. */
static pe_status choose_smoothing(const axis axes[2], const double rms[2], halves *h, double sigma[2], pe_error *error)
{
    double least = INFINITY;
    pe_status status = PE_OK;

    for (int k = 0; k < SHARES && status == PE_OK; k++) {
        const double tried[2] = { rms_shares[k] * rms[0], rms_shares[k] * rms[1] };
        double score = 0;

        status = half_score(axes, tried, h->black, h->white, h, &score, error);
        if (status == PE_OK)
            status = half_score(axes, tried, h->white, h->black, h, &score, error);
        if (score >= least)
            break;
        least = score;
        for (int along = 0; along < 2; along++)
            sigma[along] = tried[along] * pow(2, -1.0 / 6);
    }
    return status;
}

/* ---- the density ---- */

static pe_status check_options(const pe_density_options *options, pe_error *error)
{
    if (options->range != 0 && !(options->range >= RANGE_MIN && options->range <= RANGE_MAX))
        return pe_fail(error, PE_ERROR_ARGUMENT, "a range of slopes of %g is out of range: %g to %g", options->range,
                       RANGE_MIN, RANGE_MAX);
    if (options->smoothing == PE_SMOOTHING_GIVEN && !(options->smooth > 0 && options->smooth <= 1))
        return pe_fail(error, PE_ERROR_ARGUMENT, "smoothing by a slope of %g is out of range: above 0, at most 1",
                       options->smooth);
    return PE_OK;
}

/* Fills *density, whose smoothing is known, from the cells. */
static pe_status conclude(const axis axes[2], const double *cells, size_t count, pe_slope_density *density,
                          pe_error *error)
{
    double sum = 0;

    for (size_t k = 0; k < count; k++)
        sum += cells[k];
    if (!(sum > 0))
        return pe_fail(error, PE_ERROR_ARGUMENT, "no slope lies within the range of %g, %g; widen it", axes[0].range,
                       axes[1].range);
    density->values = malloc(count * sizeof *density->values);
    if (!density->values)
        return pe_fail_memory(error, "a density of slopes");
    density->width = axes[0].cells;
    density->height = axes[1].cells;
    for (int k = 0; k < 2; k++)
        density->range[k] = axes[k].range;
    for (size_t k = 0; k < count; k++)
        density->values[k] = (float)(cells[k] / (sum * axes[0].cell * axes[1].cell));
    return PE_OK;
}

/* The black slopes' counts and the white ones', each as a share of its own; returns the share of all that fell in. */
static double count_halves(const pe_slopes *slopes, const axis axes[2], halves *h)
{
    size_t white = slopes->count - slopes->black;
    double inside[2] = { 0, 0 };

    for (size_t k = 0; k < slopes->count; k++)
        inside[k >= slopes->black] +=
            count_sample(axes, (double)slopes->p[k], (double)slopes->q[k], k < slopes->black ? h->black : h->white);
    for (size_t k = 0; k < h->size; k++) {
        h->black[k] /= slopes->black ? (double)slopes->black : 1;
        h->white[k] /= white ? (double)white : 1;
    }
    return (inside[0] + inside[1]) / (double)slopes->count;
}

static pe_status fill_density(const pe_slopes *slopes, const axis axes[2], const double rms[2],
                              const pe_density_options *options, halves *h, pe_slope_density *density, pe_error *error)
{
    pe_slope_density d = { .beyond = fmax(0, 1 - count_halves(slopes, axes, h)) };
    double part = (double)slopes->black / (double)slopes->count;
    pe_status status = PE_OK;

    if (options->smoothing == PE_SMOOTHING_GIVEN)
        d.smooth[0] = d.smooth[1] = options->smooth;
    else if (options->smoothing == PE_SMOOTHING_AUTO && part > 0 && part < 1)
        status = choose_smoothing(axes, rms, h, d.smooth, error);
    for (size_t k = 0; k < h->size; k++)
        h->blurred[k] = part * h->black[k] + (1 - part) * h->white[k];
    if (status == PE_OK)
        status = smooth_cells(axes, d.smooth, h->blurred, error);
    if (status == PE_OK)
        status = conclude(axes, h->blurred, h->size, &d, error);
    if (status == PE_OK)
        *density = d;
    return status;
}

pe_status pe_slopes_density(const pe_slopes *slopes, const pe_density_options *options, pe_slope_density *density,
                            pe_error *error)
{
    const float *values[2] = { slopes->p, slopes->q };
    pe_slope_statistics statistics;
    axis axes[2];
    halves h;
    pe_status status = check_options(options, error);

    pe_slopes_measure(slopes, &statistics);
    for (int k = 0; k < 2 && status == PE_OK; k++) {
        double range = 0;

        status = choose_range(slopes, values[k], options, statistics.rms[k], &range, error);
        if (status == PE_OK)
            axes[k] = make_axis(range, choose_cells(range, slopes->step), slopes->step);
    }
    if (status != PE_OK)
        return status;
    h.size = (size_t)axes[0].cells * (size_t)axes[1].cells;
    h.black = calloc(h.size, sizeof *h.black);
    h.white = calloc(h.size, sizeof *h.white);
    h.blurred = calloc(h.size, sizeof *h.blurred);
    status = h.black && h.white && h.blurred ? fill_density(slopes, axes, statistics.rms, options, &h, density, error)
                                             : pe_fail_memory(error, "a density of slopes");
    free(h.black);
    free(h.white);
    free(h.blurred);
    return status;
}

void pe_slope_density_free(pe_slope_density *density)
{
    if (!density)
        return;
    free(density->values);
    *density = (pe_slope_density){ 0 };
}
