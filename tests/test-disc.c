/* test-disc.c - claims: the disc is an equal-area picture of a hemisphere, there and back, its horizon on the unit
 * circle; the spline passes through its values and is twice continuously differentiable; an atlas gives back what was
 * put in.  Small, odd and oblong sizes. */
#include "atlas.h"
#include "disc.h"
#include "reference.h"
#include "spline.h"
#include "tap.h"

#include <math.h>
#include <string.h>

static const int sizes[][2] = { { 8, 8 }, { 9, 13 }, { 48, 48 }, { 31, 200 }, { 2, 5 } };
#define DISCS 4 /* of the sizes; the last is for splines alone */
#define SIZES 5

/* ---- the disc ---- */

static void test_round_trip(int width, int height)
{
    const pe_disc disc = { width, height };
    double worst = 0, unit = 0;
    int inside = 0;

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double w[3];
            float direction[3], point[2];

            if (!pe_disc_direction(&disc, x, y, w))
                continue;
            inside++;
            for (int c = 0; c < 3; c++)
                direction[c] = (float)w[c];
            pe_disc_point(&disc, direction, point);
            unit = worst_of(unit, fabs(w[0] * w[0] + w[1] * w[1] + w[2] * w[2] - 1));
            worst = worst_of(worst, worst_of(fabs((double)point[0] - x - 0.5), fabs((double)point[1] - y - 0.5)));
        }
    ok(inside > 0 && unit < 1e-12 && worst < 1e-6 * fmax(width, height),
       "%d x %d: texel to direction and back within %.1e of a texel", width, height, worst);
}

/* A texel's solid angle by the cross product of central differences: everywhere 2 pi over the ellipse's area. */
static void test_equal_area(void)
{
    const pe_disc disc = { 1001, 751 };
    double expected = 2 / (pe_disc_radius(disc.width) * pe_disc_radius(disc.height)), worst = 0;
    int count = 0;

    for (int y = 3; y < disc.height; y += 11)
        for (int x = 3; x < disc.width; x += 11) {
            double w[3], left[3], right[3], up[3], down[3], a[3], b[3], area;

            if (!pe_disc_direction(&disc, x, y, w) || !pe_disc_direction(&disc, x - 1, y, left) ||
                !pe_disc_direction(&disc, x + 1, y, right) || !pe_disc_direction(&disc, x, y - 1, up) ||
                !pe_disc_direction(&disc, x, y + 1, down))
                continue;
            for (int c = 0; c < 3; c++) {
                a[c] = (right[c] - left[c]) / 2;
                b[c] = (down[c] - up[c]) / 2;
            }
            area = w[0] * (a[1] * b[2] - a[2] * b[1]) + w[1] * (a[2] * b[0] - a[0] * b[2]) +
                   w[2] * (a[0] * b[1] - a[1] * b[0]);
            worst = worst_of(worst, fabs(area / expected - 1));
            count++;
        }
    ok(count > 1000 && worst < 1e-4, "every texel has the same solid angle within %.1e", worst);
}

/* What is below the horizon lies where its nearest point of the horizon does, and nothing jumps there. */
static void test_horizon(int width, int height)
{
    static const double heights[] = { 0, 1e-6, -1e-6, -0.3, -0.99 };
    const pe_disc disc = { width, height };
    double worst = 0;

    for (int k = 0; k < 64; k++)
        for (int z = 0; z < 5; z++) {
            double angle = 2 * M_PI * k / 64, across = sqrt(1 - heights[z] * heights[z]), dx, dy;
            const float w[3] = { (float)(across * cos(angle)), (float)(across * sin(angle)), (float)heights[z] };
            float point[2];

            pe_disc_point(&disc, w, point);
            dx = ((double)point[0] - width / 2.0) / pe_disc_radius(width) - cos(angle);
            dy = ((double)point[1] - height / 2.0) / pe_disc_radius(height) - sin(angle);
            worst = worst_of(worst, hypot(dx, dy));
        }
    ok(worst < 2e-6, "%d x %d: the horizon, and all below it, on the unit circle within %.1e", width, height, worst);
}

/* Distance of the texel from the straight line through the picture's middle and another texel, in texels. */
static double off_radius(const pe_disc *disc, int x, int y, double to_x, double to_y)
{
    double dx = x + 0.5 - disc->width / 2.0, dy = y + 0.5 - disc->height / 2.0;

    to_x -= disc->width / 2.0;
    to_y -= disc->height / 2.0;
    return fabs(dx * to_y - dy * to_x) / hypot(to_x, to_y) + 1000 * (dx * to_x + dy * to_y < 0);
}

/* Each texel holds its own place, so that a texel beyond the horizon says where its value comes from. */
static void test_continuation(int width, int height)
{
    const pe_disc disc = { width, height };
    float *rgb = reference_constant(width, height, 0);
    double off = 0, deep = 0;
    int kept = 1, inside = 1;

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            rgb[3 * (y * width + x)] = (float)x;
            rgb[3 * (y * width + x) + 1] = (float)y;
        }
    pe_disc_continue(&disc, rgb, 3);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int from_x = (int)rgb[3 * (y * width + x)], from_y = (int)rgb[3 * (y * width + x) + 1];
            double w[3], p = (from_x + 0.5 - width / 2.0) / pe_disc_radius(width),
                         q = (from_y + 0.5 - height / 2.0) / pe_disc_radius(height);

            if (pe_disc_direction(&disc, x, y, w)) {
                kept &= from_x == x && from_y == y;
                continue;
            }
            inside &= pe_disc_direction(&disc, from_x, from_y, w);
            off = worst_of(off, off_radius(&disc, from_x, from_y, x + 0.5, y + 0.5));
            deep = worst_of(deep, (1 - hypot(p, q)) * pe_disc_radius(width < height ? width : height));
        }
    ok(kept && inside && off < 1 && deep < 2,
       "%d x %d: beyond the horizon as at it: off the radius by %.2f texels, inside by %.2f", width, height, off, deep);
    free(rgb);
}

/* ---- splines ---- */

static int mirror(int k, int count)
{
    return abs(k < count ? k : 2 * (count - 1) - k);
}

/* The spline at (x + tx, y + ty), any texel of the picture, whose coefficients are mirrored as its values are. */
static double evaluate(const float *coefficients, const int size[2], const int at[2], const float t[2], int channel)
{
    float across[4], down[4];
    double sum = 0;

    pe_spline_weights(t[0], across);
    pe_spline_weights(t[1], down);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++) {
            int x = mirror(at[0] + i - 1, size[0]), y = mirror(at[1] + j - 1, size[1]);

            sum += (double)across[i] * (double)down[j] * (double)coefficients[3 * (y * size[0] + x) + channel];
        }
    return sum;
}

/* Largest difference of the spline through the values from them; float and mirrored edges included. */
static double worst_miss(const float *values, const int size[2])
{
    size_t count = 3 * (size_t)size[0] * (size_t)size[1];
    float *coefficients = reference_constant(size[0], size[1], 0);
    double worst = 0;

    memcpy(coefficients, values, count * sizeof *coefficients);
    pe_spline_coefficients(coefficients, size[0], size[1], 3);
    for (int k = 0; k < (int)count; k++) {
        const int at[2] = { k / 3 % size[0], k / 3 / size[0] };

        worst = worst_of(worst,
                         fabs(evaluate(coefficients, size, at, (const float[2]){ 0, 0 }, k % 3) - (double)values[k]));
    }
    free(coefficients);
    return worst;
}

static void test_through_values(const int size[2])
{
    float *noise = reference_noise(size[0], size[1], 3), *grey = reference_constant(size[0], size[1], 0.7F);
    double miss = worst_miss(noise, size), miss_grey = worst_miss(grey, size);

    ok(miss < 2e-6 && miss_grey < 5e-7, "%d x %d: the spline passes its values by %.1e, a constant by %.1e", size[0],
       size[1], miss, miss_grey);
    free(noise);
    free(grey);
}

/* Value, slope and curvature of the cubic through four values a quarter apart, at the last or, with -1 for `sign`, the
 * first of them: formulas that are exact for cubics. */
static void differentiate(const double f[4], int sign, double out[3])
{
    const double h = 0.25;

    out[0] = f[3];
    out[1] = sign * (11 * f[3] - 18 * f[2] + 9 * f[1] - 2 * f[0]) / (6 * h);
    out[2] = (2 * f[3] - 5 * f[2] + 4 * f[1] - f[0]) / (h * h);
}

/* Across a texel's centre, seen from both sides. */
static void test_smooth(const int size[2])
{
    float *values = reference_noise(size[0], size[1], 4);
    double worst[3] = { 0 };

    pe_spline_coefficients(values, size[0], size[1], 3);
    for (int x = 2; x < size[0] - 2; x++)
        for (int axis = 0; axis < 2; axis++) {
            const int after[2] = { x, size[1] / 2 }, before[2] = { after[0] - !axis, after[1] - axis };
            double left[4], right[4], from_left[3], from_right[3];

            for (int k = 0; k < 4; k++) {
                float t[2] = { 0.3F, 0.3F };

                t[axis] = 0.25F * (float)(k + 1);
                left[k] = evaluate(values, size, before, t, 0);
                t[axis] = 0.25F * (float)(3 - k);
                right[k] = evaluate(values, size, after, t, 0);
            }
            differentiate(left, 1, from_left);
            differentiate(right, -1, from_right);
            for (int d = 0; d < 3; d++)
                worst[d] = worst_of(worst[d], fabs(from_left[d] - from_right[d]));
        }
    ok(worst[0] < 1e-6 && worst[1] < 1e-5 && worst[2] < 1e-4,
       "%d x %d: no jump at a texel: value %.1e, slope %.1e, curvature %.1e", size[0], size[1], worst[0], worst[1],
       worst[2]);
    free(values);
}

/* Both sets of shares add up to 1; those for values give back any parabola. */
static void test_weights(void)
{
    double sum_off = 0, parabola_off = 0;

    for (int k = 0; k <= 64; k++) {
        float t = (float)k / 64, spline[4], interpolating[4];
        double sums[2] = { 0 }, moments[2] = { 0 };

        pe_spline_weights(t, spline);
        pe_interpolating_weights(t, interpolating);
        for (int i = 0; i < 4; i++) {
            sums[0] += (double)spline[i];
            sums[1] += (double)interpolating[i];
            moments[0] += (double)interpolating[i] * (i - 1);
            moments[1] += (double)interpolating[i] * (i - 1) * (i - 1);
        }
        sum_off = worst_of(sum_off, worst_of(fabs(sums[0] - 1), fabs(sums[1] - 1)));
        parabola_off =
            worst_of(parabola_off, worst_of(fabs(moments[0] - (double)t), fabs(moments[1] - (double)(t * t))));
    }
    ok(sum_off < 5e-7 && parabola_off < 1e-6, "shares add up to 1 within %.1e, parabolas return within %.1e", sum_off,
       parabola_off);
}

/* ---- atlases ---- */

static void test_atlas(int count, int width, int height)
{
    pe_atlas atlas = pe_atlas_of(count, width, height);
    size_t values = 3 * (size_t)width * (size_t)height;
    float *picture = reference_constant(atlas.width, atlas.height, -1), *back = reference_constant(width, height, 0);
    int same = 1, fits = atlas.columns * atlas.rows >= count && (atlas.columns) * (atlas.rows - 1) < count;
    double aspect = (double)atlas.width / atlas.height;

    for (int k = 0; k < count; k++) {
        float *tile = reference_noise(width, height, (unsigned)k);

        pe_atlas_insert(&atlas, k, tile, picture);
        free(tile);
    }
    for (int k = 0; k < count; k++) {
        float *tile = reference_noise(width, height, (unsigned)k);

        pe_atlas_extract(&atlas, k, picture, back);
        same &= memcmp(tile, back, values * sizeof *back) == 0;
        free(tile);
    }
    ok(same && fits && (count < 9 || (aspect > 0.5 && aspect < 2)),
       "%d tiles of %d x %d return from an atlas of %d x %d", count, width, height, atlas.width, atlas.height);
    free(picture);
    free(back);
}

int main(void)
{
    for (int k = 0; k < DISCS; k++) {
        test_round_trip(sizes[k][0], sizes[k][1]);
        test_horizon(sizes[k][0], sizes[k][1]);
        test_continuation(sizes[k][0], sizes[k][1]);
    }
    test_equal_area();
    for (int k = 0; k < SIZES; k++)
        test_through_values(sizes[k]);
    for (int k = 0; k < DISCS - 1; k++)
        test_smooth(sizes[k]);
    test_weights();
    test_atlas(1, 8, 9);
    test_atlas(12, 8, 8);
    test_atlas(42, 9, 13);
    test_atlas(47, 31, 20);
    return done_testing();
}
