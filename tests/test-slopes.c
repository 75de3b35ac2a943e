/* test-slopes.c - claim: slopes are the surface's own, their density is that of the closed form where a machined
 * surface has one, and what was not measured, lies beyond the range or was rounded away is told. */
#include "prefenv.h"
#include "reference.h"
#include "tap.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

static pe_heights make_heights(int width, int height, double pitch)
{
    pe_heights heights = { .width = width, .height = height, .pitch = pitch };

    heights.values = calloc((size_t)width * (size_t)height, sizeof *heights.values);
    need(heights.values != NULL, "out of memory");
    return heights;
}

static pe_slopes slopes_of(const pe_heights *heights, pe_edges edges)
{
    pe_error error = { PE_OK, "" };
    pe_slopes slopes = { 0 };
    pe_status status = pe_slopes_of_heights(heights, edges, &slopes, &error);

    need(status == PE_OK, "%s", error.message);
    return slopes;
}

/* ---- the derivative ---- */

/* z = -0.1 x + 0.2 y: p = 0.1, q = -0.2 everywhere. */
static void test_plane(void)
{
    pe_heights heights = make_heights(12, 9, 0.5);
    pe_slope_statistics s;
    pe_slopes slopes;

    for (int y = 0; y < 9; y++)
        for (int x = 0; x < 12; x++)
            heights.values[12 * y + x] = (float)(0.5 * (-0.1 * x + 0.2 * y));
    slopes = slopes_of(&heights, PE_EDGES_OPEN);
    pe_slopes_measure(&slopes, &s);
    ok(slopes.count == 6 * 3 && slopes.missing == 12 * 9 - 6 * 3, "three texels along each edge have no slope");
    ok(fabs(s.mean[0] - 0.1) < 1e-6 && fabs(s.mean[1] + 0.2) < 1e-6, "a plane's slopes are %g, %g", s.mean[0],
       s.mean[1]);
    pe_slopes_turn(&slopes);
    pe_slopes_measure(&slopes, &s);
    ok(fabs(s.mean[0] + 0.2) < 1e-6 && fabs(s.mean[1] + 0.1) < 1e-6, "turned by a quarter: %g, %g", s.mean[0],
       s.mean[1]);
    pe_slopes_level(&slopes);
    pe_slopes_measure(&slopes, &s);
    ok(fabs(s.mean[0]) < 1e-7 && fabs(s.mean[1]) < 1e-7 && s.steepest < 1e-6, "levelled, it is flat");
    pe_slopes_free(&slopes);
    heights.values[12 * 4 + 6] = NAN; /* the middle of the 6 x 3 that have slopes */
    slopes = slopes_of(&heights, PE_EDGES_OPEN);
    ok(slopes.count == 6 * 3 - 8, "a hole takes %d slopes with it", 18 - (int)slopes.count);
    pe_slopes_free(&slopes);
    pe_heights_free(&heights);
}

/* Two waves: the slopes are known, and the formula is of the sixth order.  They come in the order that prefenv.h says:
 * black squares first. */
static void note_errors(const pe_slopes *slopes, int side, int white, size_t *next, double worst[2])
{
    double turn = 2 * M_PI / side, pitch = 10.0 / side;

    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            double p = -0.3 * 3 * turn * cos(3 * turn * x) / pitch, q = 0.2 * 2 * turn * sin(2 * turn * y) / pitch;

            if ((x * 8 / side + y * 8 / side) % 2 != white)
                continue;
            worst[0] = worst_of(worst[0], fabs((double)slopes->p[*next] - p));
            worst[1] = worst_of(worst[1], fabs((double)slopes->q[(*next)++] - q));
        }
}

static double wave_error(int side, double *q_error)
{
    pe_heights heights = make_heights(side, side, 10.0 / side);
    double turn = 2 * M_PI / side, worst[2] = { 0, 0 };
    pe_slopes slopes;
    size_t next = 0;

    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++)
            heights.values[side * y + x] = (float)(0.3 * sin(3 * turn * x) + 0.2 * cos(2 * turn * y));
    slopes = slopes_of(&heights, PE_EDGES_WRAP);
    note_errors(&slopes, side, 0, &next, worst);
    ok(next == slopes.black, "%d x %d: the black squares come first", side, side);
    note_errors(&slopes, side, 1, &next, worst);
    pe_slopes_free(&slopes);
    pe_heights_free(&heights);
    *q_error = worst[1];
    return worst[0];
}

static void test_waves(void)
{
    double q_fine, q_coarse, fine = wave_error(48, &q_fine), coarse = wave_error(24, &q_coarse);

    ok(fine < 2e-5 && q_fine < 2e-5, "16 texels a wave: slopes of 0.57 within %.1e, %.1e", fine, q_fine);
    ok(coarse > 40 * fine, "of the sixth order: at twice the pitch the error is %.0f times as large", coarse / fine);
}

/* ---- normal maps ---- */

/* One normal, stored as a normal map does, in the precision of floats. */
static void test_normals(void)
{
    static const double p = 0.3, q = -0.15;
    double length = sqrt(1 + p * p + q * q);
    float rgb[6] = {
        0, 0, 0, (float)(0.5 + 0.5 * p / length), (float)(0.5 + 0.5 * q / length), (float)(0.5 + 0.5 / length)
    };
    pe_image image = { 2, 1, rgb, NULL };
    pe_slopes down, up;
    pe_error error;

    need(pe_slopes_of_normals(&image, "map", PE_GREEN_DOWN, &down, NULL) == PE_OK &&
             pe_slopes_of_normals(&image, "map", PE_GREEN_UP, &up, NULL) == PE_OK,
         "a normal map is not taken");
    ok(down.count == 1 && down.missing == 1, "black is no normal");
    ok(fabs((double)down.p[0] - p) < 1e-6 && fabs((double)down.q[0] - q) < 1e-6, "green down: %g, %g",
       (double)down.p[0], (double)down.q[0]);
    ok(fabs((double)up.p[0] - p) < 1e-6 && fabs((double)up.q[0] + q) < 1e-6, "green up: %g, %g", (double)up.p[0],
       (double)up.q[0]);
    image.width = 1;
    ok(pe_slopes_of_normals(&image, "map", PE_GREEN_UP, &up, &error) == PE_ERROR_FORMAT &&
           strstr(error.message, "map: no texel"),
       "nothing but black: %s", error.message);
    pe_slopes_free(&up);
    pe_slopes_free(&down);
}

/* ---- densities ---- */

static pe_slope_density density_of(const pe_slopes *slopes, double range, double smooth)
{
    pe_density_options options = { range, smooth > 0 ? PE_SMOOTHING_GIVEN : PE_SMOOTHING_NONE, smooth };
    pe_slope_density density = { 0 };
    pe_error error = { PE_OK, "" };
    pe_status status = pe_slopes_density(slopes, &options, &density, &error);

    need(status == PE_OK, "%s", error.message);
    return density;
}

/* Integral of p^a q^b over the cells, as the density has it: each cell's weight at its centre. */
static double moment(const pe_slope_density *d, int a, int b)
{
    double cell = 4 * d->range[0] * d->range[1] / d->width / d->height, sum = 0;

    for (int j = 0; j < d->height; j++)
        for (int i = 0; i < d->width; i++) {
            double p = ((2 * i + 1.0) / d->width - 1) * d->range[0];
            double q = ((2 * j + 1.0) / d->height - 1) * d->range[1];

            sum += pow(p, a) * pow(q, b) * (double)d->values[(size_t)j * (size_t)d->width + (size_t)i] * cell;
        }
    return sum;
}

static void test_few_slopes(void)
{
    float p[4] = { 0.1f, 0.1f, -0.2f, 0.5f }, q[4] = { 0.02f, 0.02f, -0.03f, 0.01f };
    pe_slopes slopes = { .count = 4, .p = p, .q = q };
    pe_slope_density d = density_of(&slopes, 0, 0);
    double mean[2] = { moment(&d, 1, 0), moment(&d, 0, 1) };

    ok(fabs(moment(&d, 0, 0) - 1) < 1e-6, "the density integrates to 1");
    ok(fabs(mean[0] - 0.125) < 1e-5 && fabs(mean[1] - 0.005) < 1e-6, "and keeps the mean: %g, %g", mean[0], mean[1]);
    ok(d.beyond < 1e-12, "nothing lies beyond");
    pe_slope_density_free(&d);
    d = density_of(&slopes, 0.3, 0);
    ok(fabs(d.beyond - 0.25) < 1e-12 && fabs(moment(&d, 0, 0) - 1) < 1e-6 && fabs(moment(&d, 1, 0)) < 1e-5,
       "of four slopes one lies beyond 0.3: %g; the rest integrates to 1", d.beyond);
    pe_slope_density_free(&d);
}

static void test_smooth(void)
{
    float p[1] = { 0.01f }, q[1] = { 0 };
    pe_slopes slopes = { .count = 1, .p = p, .q = q };
    pe_slope_density d = density_of(&slopes, 0, 0.02);
    double variance[2] = { moment(&d, 2, 0) - pow(moment(&d, 1, 0), 2), moment(&d, 0, 2) };

    ok(fabs(sqrt(variance[0]) - 0.02) < 3e-4 && fabs(sqrt(variance[1]) - 0.02) < 3e-4,
       "smoothed by 0.02, a single slope spreads by %.4f, %.4f", sqrt(variance[0]), sqrt(variance[1]));
    pe_slope_density_free(&d);
}

/* A ramp of p whose values come in steps: no cell within may stay empty. */
static void test_steps(void)
{
    enum { HALF = 100, STEPS = 2 * HALF + 1 };
    float p[STEPS], q[STEPS];
    pe_slopes slopes = { .count = STEPS, .p = p, .q = q, .step = 0.01 };
    pe_slope_density d;
    double least = INFINITY, most = 0;

    for (int k = 0; k < STEPS; k++) {
        p[k] = (float)(0.01 * (k - HALF));
        q[k] = 0;
    }
    d = density_of(&slopes, 0, 0);
    for (int i = d.width / 8; i < d.width * 7 / 8; i++) {
        double value = (double)d.values[(size_t)(d.height / 2) * (size_t)d.width + (size_t)i];

        least = least_of(least, value);
        most = worst_of(most, value);
    }
    ok(least > 0.99 * most, "rounded slopes leave no comb: %d cells from %g to %g", d.width, least, most);
    pe_slope_density_free(&d);
}

/* ---- machined surfaces ---- */

static double normal_cdf(double x)
{
    return 0.5 * erfc(-x / M_SQRT2);
}

/* Integral of the normal distribution function. */
static double normal_cdf_integral(double x)
{
    return x * normal_cdf(x) + exp(-x * x / 2) / sqrt(2 * M_PI);
}

/* What part of the area has a slope below x: even over +-a, two ridges at +-a, or nothing; blurred with a Gaussian. */
static double turned_cdf(double x, double a, double sigma)
{
    return sigma * (normal_cdf_integral((x + a) / sigma) - normal_cdf_integral((x - a) / sigma)) / (2 * a);
}

static double milled_cdf(double x, double a, double sigma)
{
    return 0.5 * (normal_cdf((x + a) / sigma) + normal_cdf((x - a) / sigma));
}

static double gaussian_cdf(double x, double a, double sigma)
{
    (void)a;
    return normal_cdf(x / sigma);
}

typedef double slope_cdf(double x, double a, double sigma);

/* Kolmogorov's distance of the density's marginal along an axis from a closed form. */
static double distance(const pe_slope_density *d, int along, slope_cdf *cdf, double a, double sigma)
{
    int cells = along == 0 ? d->width : d->height, others = along == 0 ? d->height : d->width;
    double area = 4 * d->range[0] * d->range[1] / d->width / d->height, sum = 0, worst = 0;

    for (int i = 0; i < cells; i++) {
        for (int j = 0; j < others; j++)
            sum += area * (double)(along == 0 ? d->values[(size_t)j * (size_t)d->width + (size_t)i]
                                              : d->values[(size_t)i * (size_t)d->width + (size_t)j]);
        worst = worst_of(worst, fabs(sum - cdf(((2 * i + 2.0) / cells - 1) * d->range[along], a, sigma)));
    }
    return worst;
}

typedef struct machined {
    const char *name;
    pe_machining_options options;
    slope_cdf *across; /* along y; along x it is the roughness alone */
    double bound;      /* of the distance */
} machined;

/* Half the width of the even slopes, or the place of the ridges. */
static double groove_slope(const pe_machining_options *o)
{
    return o->kind == PE_TURNED ? o->feed / 2 / o->radius : o->kind == PE_MILLED ? o->slope : 0;
}

/* sqrt 2 times the rms slope of roughness and grooves together. */
static double total_alpha(const pe_machining_options *o, double alpha)
{
    double a = groove_slope(o);

    return sqrt(alpha * alpha + 2 * a * a * (o->kind == PE_TURNED ? 1.0 / 3 : 1));
}

static void test_machined(const machined *m)
{
    pe_machining_options o = m->options;
    double alpha[2], expected[2], distances[2];
    pe_slope_statistics s;
    pe_slope_density d;
    pe_heights heights;
    pe_slopes slopes;

    need(pe_machining_complete(&o, NULL) == PE_OK && pe_heights_machine(&o, &heights, NULL) == PE_OK,
         "%s cannot be made", m->name);
    slopes = slopes_of(&heights, PE_EDGES_WRAP);
    pe_slopes_measure(&slopes, &s);
    d = density_of(&slopes, 0, 0);
    for (int k = 0; k < 2; k++)
        alpha[k] = 2 * o.roughness / o.length[k];
    expected[0] = alpha[0];
    expected[1] = total_alpha(&o, alpha[1]);
    ok(hypot(s.mean[0], s.mean[1]) < 1e-6, "%s: repeats itself, so it is level", m->name);
    for (int k = 0; k < 2; k++)
        ok(fabs(s.alpha[k] / expected[k] - 1) < 0.03, "%s: alpha_%c is %.4f, the formula's %.4f", m->name, "xy"[k],
           s.alpha[k], expected[k]);
    distances[0] = distance(&d, 0, gaussian_cdf, 0, alpha[0] / M_SQRT2);
    distances[1] = distance(&d, 1, m->across, groove_slope(&o), alpha[1] / M_SQRT2);
    ok(distances[0] < m->bound, "%s: the slopes along are a Gaussian within %.4f", m->name, distances[0]);
    ok(distances[1] < m->bound, "%s: the slopes across are the closed form within %.4f", m->name, distances[1]);
    ok(d.beyond < 3e-4, "%s: %.1e of the area lies beyond %d x %d cells to %.3f, %.3f", m->name, d.beyond, d.width,
       d.height, d.range[0], d.range[1]);
    pe_slope_density_free(&d);
    pe_slopes_free(&slopes);
    pe_heights_free(&heights);
}

/* Root of the integral of the squared difference from Beckmann's density, over that of Beckmann's density squared. */
static double error_of_density(const pe_slope_density *d, double alpha)
{
    double differences = 0, squares = 0;

    for (int j = 0; j < d->height; j++)
        for (int i = 0; i < d->width; i++) {
            double p = ((2 * i + 1.0) / d->width - 1) * d->range[0] / alpha;
            double q = ((2 * j + 1.0) / d->height - 1) * d->range[1] / alpha;
            double wanted = exp(-p * p - q * q) / (M_PI * alpha * alpha);

            differences += pow((double)d->values[(size_t)j * (size_t)d->width + (size_t)i] - wanted, 2);
            squares += wanted * wanted;
        }
    return sqrt(differences / squares);
}

static double error_smoothed(const pe_slopes *slopes, pe_smoothing smoothing, double smooth, double *chosen)
{
    pe_density_options options = { 0.4, smoothing, smooth };
    pe_slope_density d;
    double error;

    need(pe_slopes_density(slopes, &options, &d, NULL) == PE_OK, "a density cannot be made");
    error = error_of_density(&d, 0.1);
    *chosen = d.smooth[0];
    pe_slope_density_free(&d);
    return error;
}

/* The smoothing that is found is about the best one: neither much more nor much less does better. */
static void test_choice(void)
{
    pe_machining_options o = { .kind = PE_BLASTED, .width = 512, .height = 512, .seed = 11 };
    double chosen, given, raw, found, least = INFINITY;
    pe_heights heights;
    pe_slopes slopes;

    need(pe_heights_machine(&o, &heights, NULL) == PE_OK, "a surface cannot be made");
    slopes = slopes_of(&heights, PE_EDGES_WRAP);
    raw = error_smoothed(&slopes, PE_SMOOTHING_NONE, 0, &given);
    found = error_smoothed(&slopes, PE_SMOOTHING_AUTO, 0, &chosen);
    for (int k = 0; k < 18; k++) /* up to 0.044 */
        least = least_of(least, error_smoothed(&slopes, PE_SMOOTHING_GIVEN, 0.001 * pow(1.25, k), &given));
    ok(found < 0.5 * raw, "smoothing by %.4f leaves an error of %.3f, of %.3f without", chosen, found, raw);
    ok(found < 1.2 * least, "the best smoothing would leave %.3f", least);
    pe_slopes_free(&slopes);
    pe_heights_free(&heights);
}

static const machined surfaces[] = {
    { "turned", { .kind = PE_TURNED }, turned_cdf, 0.01 },
    { "turned, odd feed",
      { .kind = PE_TURNED, .height = 1000, .feed = 73.7, .radius = 150, .roughness = 0.2, .length = { 10, 20 } },
      turned_cdf,
      0.02 },
    { "milled", { .kind = PE_MILLED }, milled_cdf, 0.02 },
    { "milled, coarse tool",
      { .kind = PE_MILLED, .pitch = 2, .feed = 512, .slope = 0.3, .length = { 60, 40 }, .seed = 5 },
      milled_cdf,
      0.02 },
    { "blasted", { .kind = PE_BLASTED }, gaussian_cdf, 0.01 },
    { "blasted, finely sampled", { .kind = PE_BLASTED, .pitch = 0.5, .seed = 9, .roughness = 2 }, gaussian_cdf, 0.02 },
    { "brushed", { .kind = PE_BRUSHED }, gaussian_cdf, 0.01 },
};
#define SURFACES (int)(sizeof surfaces / sizeof *surfaces)

static int same_heights(unsigned seed_a, unsigned seed_b)
{
    pe_machining_options a = { .kind = PE_BLASTED, .width = 96, .height = 80, .seed = seed_a }, b = a;
    pe_heights first = { 0 }, second = { 0 };
    int same;

    b.seed = seed_b;
    need(pe_heights_machine(&a, &first, NULL) == PE_OK && pe_heights_machine(&b, &second, NULL) == PE_OK,
         "a small surface cannot be made");
    same = first.values && second.values && memcmp(first.values, second.values, sizeof(float) * 96 * 80) == 0;
    pe_heights_free(&first);
    pe_heights_free(&second);
    return same;
}

static void refuses(pe_machining_options options, const char *pattern)
{
    pe_heights heights;
    pe_error error = { PE_OK, "" };

    ok(pe_heights_machine(&options, &heights, &error) == PE_ERROR_ARGUMENT && strstr(error.message, pattern),
       "refused: %s", error.message);
}

static void test_options(void)
{
    ok(same_heights(7, 7), "the same seed makes the same surface");
    ok(!same_heights(7, 8), "another seed another");
    refuses((pe_machining_options){ .kind = PE_BLASTED, .width = 7 }, "7 x 1024");
    refuses((pe_machining_options){ .kind = PE_BLASTED, .length = { 2, 20 } }, "length of 2 along x");
    refuses((pe_machining_options){ .kind = PE_BLASTED, .length = { 20, 300 } }, "length of 300 along y");
    refuses((pe_machining_options){ .kind = PE_TURNED, .feed = -1 }, "feed of -1");
    refuses((pe_machining_options){ .kind = PE_TURNED, .feed = 500 }, "feed of 500 with a radius of 400");
    refuses((pe_machining_options){ .kind = PE_MILLED, .slope = NAN }, "slope of nan");
    refuses((pe_machining_options){ .kind = PE_MILLED, .roughness = -1 }, "roughness of -1");
    refuses((pe_machining_options){ .kind = (pe_machining)9 }, "kind 9");
}

/* ---- files ---- */

static void test_files(void)
{
    char path[] = "/tmp/prefenv-test-slopes-XXXXXX";
    pe_heights made = make_heights(8, 9, 1.5), read;
    pe_image image = { 16, 16, reference_noise(16, 16, 5), NULL }, stored;
    pe_error error;
    int steps = 1;

    close(mkstemp(path));
    for (int k = 0; k < 72; k++)
        made.values[k] = (float)(k % 7 == 3 ? NAN : 0.013 * k * k - 20);
    need(pe_heights_write(&made, path, NULL) == PE_OK, "heights cannot be written");
    need(pe_heights_read(path, 0, 0, &read, NULL) == PE_OK, "heights cannot be read");
    ok(read.width == 8 && read.height == 9 && read.pitch == 1.5 && read.step == 0 &&
           memcmp(read.values, made.values, 72 * sizeof(float)) == 0,
       "heights are read as they were written, with their pitch");
    pe_heights_free(&read);
    need(pe_heights_read(path, 2, 0.5, &read, NULL) == PE_OK, "heights cannot be read");
    ok(read.pitch == 0.5 && read.values[2] == 2 * made.values[2], "a scale that is given counts instead");
    pe_heights_free(&read);
    need(pe_image_write_png(path, &image, NULL) == PE_OK && pe_image_read_data(path, &stored, NULL) == PE_OK,
         "a PNG cannot be written and read");
    for (int k = 0; k < 3 * 256; k++)
        steps &= fabs((double)stored.rgb[k] - floor(pe_srgb_encode((double)image.rgb[k]) * 255 + 0.5) / 255) < 1e-7;
    ok(steps, "a PNG's data are as stored, not made linear");
    ok(pe_heights_read(path, 1, 1, &read, &error) == PE_ERROR_FORMAT && strstr(error.message, "is it a normal map"),
       "colours are no heights: %s", error.message);
    for (int k = 0; k < 3 * 256; k++)
        image.rgb[k] = image.rgb[k - k % 3];
    need(pe_image_write_png(path, &image, NULL) == PE_OK, "a PNG cannot be written");
    ok(pe_heights_read(path, 0, 0, &read, &error) == PE_ERROR_ARGUMENT && strstr(error.message, "its scale"),
       "a PNG has no scale of its own: %s", error.message);
    ok(pe_heights_read(path, 1, -1, &read, &error) == PE_ERROR_ARGUMENT, "a scale is positive: %s", error.message);
    need(pe_heights_read(path, 51, 1, &read, NULL) == PE_OK, "heights cannot be read");
    ok(fabs(read.step - 0.2) < 1e-12, "8 bits over 51 units are steps of %g", read.step);
    pe_heights_free(&read);
    pe_heights_free(&made);
    pe_image_free(&image);
    pe_image_free(&stored);
    unlink(path);
}

/* ---- rounding ---- */

/* The step that heights are read with: of a PNG that holds value(k), of 255, at texel k. */
static double step_of_png(int (*value)(int k), const char *path)
{
    pe_image image = { 16, 16, reference_constant(16, 16, 0), NULL };
    pe_heights read;
    double step;

    for (int k = 0; k < 3 * 256; k++)
        image.rgb[k] = (float)pe_srgb_decode(value(k / 3) / 255.0);
    need(pe_image_write_png(path, &image, NULL) == PE_OK && pe_heights_read(path, 1, 1, &read, NULL) == PE_OK,
         "heights cannot be written as PNG and read");
    step = read.step;
    pe_heights_free(&read);
    pe_image_free(&image);
    return step;
}

/* Of five floats, multiples of `scale`, and gaps, the first texel among them. */
static double step_of_exr(double scale, const char *path)
{
    pe_heights made = make_heights(16, 16, 1), read;
    double step;

    for (int k = 0; k < 256; k++)
        made.values[k] = (float)(k % 50 == 0 ? NAN : scale * (k * 7 % 5 - 2));
    need(pe_heights_write(&made, path, NULL) == PE_OK && pe_heights_read(path, 0, 0, &read, NULL) == PE_OK,
         "heights cannot be written and read");
    step = read.step;
    pe_heights_free(&made);
    pe_heights_free(&read);
    return step;
}

static int of_4_bits(int k)
{
    return k * 7 % 16 * 17;
}

static int of_2_bits(int k)
{
    return k * 7 % 4 * 85;
}

static int of_1_bit(int k)
{
    return k * 7 % 5 / 4 * 255;
}

static int flat(int k)
{
    (void)k;
    return 85;
}

static void test_rounding(void)
{
    char path[] = "/tmp/prefenv-test-slopes-XXXXXX";
    double bits[3], whole, tens, fine;

    close(mkstemp(path));
    bits[0] = step_of_png(of_4_bits, path);
    bits[1] = step_of_png(of_2_bits, path);
    bits[2] = step_of_png(of_1_bit, path);
    ok(fabs(bits[0] - 1.0 / 15) < 1e-12 && fabs(bits[1] - 1.0 / 3) < 1e-12 && fabs(bits[2] - 1) < 1e-12,
       "4, 2 and 1 bits are steps of %g, %g and %g", bits[0], bits[1], bits[2]);
    whole = step_of_exr(1, path);
    tens = step_of_exr(10, path);
    fine = step_of_exr(0.013, path);
    ok(fabs(whole - 1) < 1e-12 && fabs(tens - 10) < 1e-12, "whole heights, and whole tens, are steps of %g and %g",
       whole, tens);
    ok(fabs(fine) + fabs(step_of_png(flat, path)) == 0, "floats have none, nor have flat surfaces");
    unlink(path);
}

int main(void)
{
    test_rounding();
    test_plane();
    test_waves();
    test_normals();
    test_few_slopes();
    test_smooth();
    test_steps();
    for (int k = 0; k < SURFACES; k++)
        test_machined(&surfaces[k]);
    test_choice();
    test_options();
    test_files();
    return done_testing();
}
