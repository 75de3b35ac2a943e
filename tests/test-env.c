/* test-env.c - claim: direction and texel agree both ways, lookups hold everywhere, bad values are repaired. */
#include "env.h"
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

static pe_env *make(int width, int height, float *rgb)
{
    pe_env *env;
    pe_error error;

    need(pe_env_create(width, height, rgb, &env, &error) == PE_OK, "%s", error.message);
    free(rgb);
    return env;
}

static void test_round_trip(void)
{
    double worst = 0, worst_pole = 0;
    unsigned state = 1;

    for (int k = 0; k < 100000; k++) {
        double d[3], back[3], u, v, off = 0;

        reference_random_direction(&state, d);
        if (k % 3 == 0) { /* close to the poles */
            d[0] *= 1e-9;
            d[2] *= 1e-9;
            pe_normalize(d, d);
        }
        pe_latlong_coordinates(d, &u, &v);
        pe_latlong_direction(u, v, back);
        for (int c = 0; c < 3; c++)
            off = worst_of(off, fabs(back[c] - d[c]));
        if (k % 3 == 0)
            worst_pole = worst_of(worst_pole, off);
        else
            worst = worst_of(worst, off);
        if (!(u >= 0 && u < 1 && v >= 0 && v <= 1))
            ok(0, "u = %g, v = %g is out of range", u, v);
    }
    ok(worst < 1e-14 && worst_pole < 1e-14, "direction -> (u, v) -> direction within %.1e, at the poles %.1e", worst,
       worst_pole);
}

/* The frame as prefenv.h states it. */
static void test_frame(void)
{
    static const struct {
        double d[3], u, v;
    } known[] = { { { 1, 0, 0 }, 0, 0.5 },     { { 0, 0, 1 }, 0.25, 0.5 }, { { -1, 0, 0 }, 0.5, 0.5 },
                  { { 0, 0, -1 }, 0.75, 0.5 }, { { 0, 2, 0 }, 0, 0 },      { { 0, -3, 0 }, 0, 1 } };

    for (int k = 0; k < 6; k++) {
        double u, v;

        pe_latlong_coordinates(known[k].d, &u, &v);
        ok(fabs(u - known[k].u) < 1e-15 && fabs(v - known[k].v) < 1e-15, "<%g, %g, %g> is at u = %g, v = %g",
           known[k].d[0], known[k].d[1], known[k].d[2], u, v);
    }
}

static void test_texels(int width, int height)
{
    pe_env *env = make(width, height, reference_noise(width, height, 5));
    double solid_angle = 0, sum[3] = { 0 }, mean[3];
    int centres = 1, nearest = 1;

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const float *texel = pe_env_texels(env) + 3 * (y * width + x);
            double d[3], theta, rgb[3];

            reference_direction(width, height, x, y, d, &theta);
            solid_angle += env->grid.solid_angle_sr[y];
            pe_env_lookup(env, d, rgb);
            for (int c = 0; c < 3; c++) {
                centres &= fabs(rgb[c] - (double)texel[c]) < 1e-10;
                sum[c] += rgb[c] * env->grid.solid_angle_sr[y] / (4 * M_PI);
            }
            nearest &= pe_env_texel(env, d) == texel;
        }
    ok(centres && nearest, "%d x %d: a texel's centre looks up that texel", width, height);
    ok(fabs(solid_angle - 4 * M_PI) < 1e-12, "%d x %d: solid angles add up to 4 pi", width, height);
    pe_env_mean(env, mean);
    ok(fabs(mean[0] - sum[0]) + fabs(mean[1] - sum[1]) + fabs(mean[2] - sum[2]) < 1e-9, "%d x %d: the mean is %.6f",
       width, height, mean[0]);
    pe_env_free(env);
}

/* Steps of a lookup along circles that cross poles and the seam u = 0 are as small as the step. */
static void test_continuity(int width, int height)
{
    pe_env *env = make(width, height, reference_noise(width, height, 9));
    const int steps = 200000;
    double largest = 0;

    for (int circle = 0; circle < 4; circle++) {
        double before[3] = { 0 }, a = 0.1 + circle;

        for (int k = 0; k <= steps; k++) {
            double angle = 2 * M_PI * k / steps, rgb[3];
            double d[3] = { cos(angle) * cos(a), sin(angle), cos(angle) * sin(a) };

            if (circle == 3) {
                d[0] = cos(angle);
                d[1] = 0.2;
                d[2] = sin(angle);
            }
            pe_env_lookup(env, d, rgb);
            for (int c = 0; c < 3 && k; c++)
                largest = worst_of(largest, fabs(rgb[c] - before[c]));
            memcpy(before, rgb, sizeof before);
        }
    }
    ok(largest < 2 * (width + 2 * height) * 2 * M_PI / steps, "%d x %d: no step along a circle exceeds %.2e", width,
       height, largest);
    pe_env_free(env);
}

/* A picture that is odd as an environment is taken, and remarked on. */
static void test_remarks(void)
{
    static const char head[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X ";
    char wide[128] = { 0 }, square[128] = { 0 };
    pe_env *env;

    snprintf(wide, sizeof wide, "%s4\n", head);
    snprintf(square, sizeof square, "%s2\n", head);
    ok(pe_env_read_memory(wide, strlen(wide) + 32, "wide.hdr", &env, NULL) == PE_OK, "4 x 2 texels are read");
    ok(*pe_env_remark(env) == '\0', "twice as wide as high: no remark");
    pe_env_free(env);
    ok(pe_env_read_memory(square, strlen(square) + 16, "square.hdr", &env, NULL) == PE_OK, "2 x 2 texels are read");
    ok(strstr(pe_env_remark(env), "2 x 2 texels") != NULL, "2 x 2: %s", pe_env_remark(env));
    pe_env_free(env);
}

static void test_repairs(void)
{
    float *rgb = reference_constant(8, 4, 0.5f);
    pe_env *env;
    const float *t;

    rgb[0] = NAN;
    rgb[4] = INFINITY;
    rgb[6] = -INFINITY;
    rgb[10] = -0.25f;
    rgb[13] = 7;
    env = make(8, 4, rgb);
    t = pe_env_texels(env);
    ok(pe_env_repairs(env) == 4, "four texels were repaired: %zu", pe_env_repairs(env));
    ok(t[0] == 0 && t[4] == 7 && t[6] == 0 && t[10] == 0 && t[1] == 0.5f,
       "NaN and negatives become 0, infinity the brightest of its channel");
    pe_env_free(env);
}

static void test_limits(void)
{
    static const double nowhere[3] = { NAN, NAN, NAN }, zero[3] = { 0, 0, 0 };
    float one[3] = { 1, 2, 3 };
    pe_env *env = NULL;
    pe_error error = { PE_OK, "" };
    double rgb[3];

    ok(pe_env_create(0, 4, one, &env, &error) == PE_ERROR_ARGUMENT && !env, "0 x 4 is refused: %s", error.message);
    ok(pe_env_create(1 << 20, 1 << 20, one, &env, &error) == PE_ERROR_LIMIT && !env, "too large: %s", error.message);
    need(pe_env_create(1, 1, one, &env, NULL) == PE_OK, "1 x 1");
    pe_env_lookup(env, nowhere, rgb);
    pe_env_lookup(env, zero, rgb);
    ok(rgb[0] == 1 && rgb[1] == 2 && rgb[2] == 3, "a 1 x 1 environment answers even where no direction is given");
    pe_env_free(env);
}

int main(void)
{
    test_round_trip();
    test_frame();
    test_texels(64, 32);
    test_texels(33, 17);
    test_texels(3, 2);
    test_texels(1, 1);
    test_continuity(64, 32);
    test_continuity(32, 7);
    test_continuity(5, 3);
    test_repairs();
    test_remarks();
    test_limits();
    return done_testing();
}
