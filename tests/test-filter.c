/* test-filter.c - claim: production filter and exact twin agree with the naive reference, environments that hurt
 * included.
 *
 * Production is single precision, so its bound is relative: 1e-5 of a texel's value, where a sun many lobes away is all
 * there is to see; the root mean square over a map is held to 3e-6. */
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

#define WORST_MAX 1e-5
#define RMS_MAX 3e-6

static const char *const kinds[] = { "beckmann", "ggx", "phong", "table" };

typedef struct environment {
    const char *name;
    int width, height;
    float *rgb;
} environment;

static const double plus_y[3] = { 0, 1, 0 }, aslant[3] = { 1, 0.2, -0.3 };

static pe_env *make(const environment *e)
{
    pe_env *env;
    pe_error error;

    need(pe_env_create(e->width, e->height, e->rgb, &env, &error) == PE_OK, "%s", error.message);
    return env;
}

/* What the reference says of the texel in direction w of the image that +-n share. */
static void reference_texel(const environment *e, const pe_maps_info *info, const double n_k[3], const double w[3],
                            double out[3])
{
    double n[3], o[3], d[3];

    pe_scale(pe_dot(w, n_k) > 0 ? 1 : -1, n_k, n);
    pe_reflect(w, n, o);
    pe_normalize(info->direction, d);
    reference_reflection_of((int)info->surface.ndf.kind, e->rgb, e->width, e->height, info->surface.ndf.alpha_x,
                            info->surface.ndf.alpha_y, d, n, o, out);
}

/* Differences over every `stride`-th texel of every image. */
static void compare(const environment *e, const pe_maps *maps, int stride, double *worst, double *rms)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    double error2 = 0, norm2 = 0;

    *worst = 0;
    for (int k = 0; k < info->images * info->width * info->height; k += stride) {
        int image = k / (info->width * info->height), texel = k % (info->width * info->height);
        const float *got = pe_maps_image(maps, image) + 3 * texel;
        double w[3], theta, n[3], expected[3];

        reference_direction(info->width, info->height, texel % info->width, texel / info->width, w, &theta);
        if (info->method == PE_METHOD_BASELINE)
            memcpy(n, w, sizeof n);
        else
            pe_maps_normal(maps, image, n);
        if (fabs(pe_dot(w, n)) < 1e-9)
            continue; /* on the equator either side may have it */
        reference_texel(e, info, n, w, expected);
        for (int c = 0; c < 3; c++) {
            double difference = fabs((double)got[c] - expected[c]);

            *worst = worst_of(*worst, difference / (expected[c] + 1e-30));
            error2 += difference * difference;
            norm2 += expected[c] * expected[c];
        }
    }
    *rms = sqrt(error2 / norm2);
}

static void test_bake(const environment *e, pe_method method, pe_ndf_kind kind, double alpha_x, double alpha_y,
                      const double direction[3])
{
    pe_bake_options options = { .method = method,
                                .surface.ndf = { kind, alpha_x, alpha_y, NULL },
                                .direction = { direction[0], direction[1], direction[2] },
                                .normals = 12,
                                .width = 37,
                                .height = 18,
                                .accuracy = PE_ACCURACY_EXACT };
    pe_env *env = make(e);
    pe_maps *maps;
    pe_error error;
    double worst, rms;

    need(pe_bake(env, &options, &maps, &error) == PE_OK, "%s", error.message);
    compare(e, maps, 7, &worst, &rms);
    ok(worst < WORST_MAX && rms < RMS_MAX, "%s, %s, %s, alpha %g, %g: worst %.1e, rms %.1e", e->name, kinds[kind],
       method == PE_METHOD_BASELINE ? "baseline" : "representative", alpha_x, alpha_y, worst, rms);
    pe_maps_free(maps);
    pe_env_free(env);
}

static void test_exact(const environment *e, pe_ndf_kind kind, double alpha_x, double alpha_y,
                       const double direction[3])
{
    pe_env *env = make(e);
    pe_surface surface = { .ndf = { kind, alpha_x, alpha_y, NULL } };
    double worst = 0, unit_direction[3];
    unsigned state = 11;

    pe_normalize(direction, unit_direction);
    for (int k = 0; k < 200; k++) {
        double n[3], o[3], long_n[3], long_o[3], got[3], expected[3];

        reference_random_direction(&state, n);
        reference_random_direction(&state, o);
        pe_scale(3, n, long_n);
        pe_scale(0.2, o, long_o);
        pe_exact(env, &surface, direction, long_n, long_o, got);
        if (pe_dot(n, o) < 0)
            pe_scale(-1, n, n);
        reference_reflection_of((int)kind, e->rgb, e->width, e->height, alpha_x, alpha_y, unit_direction, n, o,
                                expected);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fabs(got[c] - expected[c]) / (expected[c] + 1e-30));
    }
    ok(worst < 1e-9, "%s, %s, alpha %g, %g: pe_exact within %.1e", e->name, kinds[kind], alpha_x, alpha_y, worst);
    pe_env_free(env);
}

/* The rounding of h = o + w in single precision is a part of 1e-7 of the lobe: its effect grows as 1 / alpha. */
static void test_narrow(double alpha)
{
    environment e = { "noise", 128, 64, reference_noise(128, 64, 8) };
    pe_bake_options options = { .method = PE_METHOD_REPRESENTATIVE,
                                .surface.ndf = { PE_NDF_BECKMANN, alpha, alpha, NULL },
                                .normals = 12,
                                .width = 37,
                                .height = 18,
                                .accuracy = PE_ACCURACY_EXACT };
    pe_env *env = make(&e);
    pe_maps *maps;
    double rms = 0, norm2 = 0;
    const pe_maps_info *info;

    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
    info = pe_maps_get_info(maps);
    for (int texel = 0; texel < 37 * 18; texel++) {
        double n[3], w[3], o[3], theta, exact[3];

        reference_direction(37, 18, texel % 37, texel / 37, w, &theta);
        pe_maps_normal(maps, 0, n);
        pe_scale(pe_dot(w, n) > 0 ? 1 : -1, n, n);
        pe_reflect(w, n, o);
        pe_exact(env, &info->surface, plus_y, n, o, exact);
        for (int c = 0; c < 3; c++) {
            rms += pow((double)pe_maps_image(maps, 0)[3 * texel + c] - exact[c], 2);
            norm2 += exact[c] * exact[c];
        }
    }
    ok(sqrt(rms / norm2) < 1e-6 / alpha, "alpha %g: rms %.1e", alpha, sqrt(rms / norm2));
    pe_maps_free(maps);
    pe_env_free(env);
    free(e.rgb);
}

/* Odd heights and widths of 4 k + 2 put texels on the equators of normals along the axes, in environment and maps:
 * they must be like their neighbours and not a mirror's. */
static void test_equator(int width, int height)
{
    float *rgb = reference_constant(width, height, 0);
    pe_bake_options options = { .method = PE_METHOD_REPRESENTATIVE,
                                .surface.ndf = { PE_NDF_BECKMANN, 0.2, 0.2, NULL },
                                .width = width,
                                .height = height };
    pe_env *env = NULL;
    pe_maps *maps = NULL;
    double worst = 0;
    int on_equators = 0;

    for (int k = 0; k < 3 * width * height; k++) /* a checkerboard that a mirror shows and the lobe does not */
        rgb[k] = (k / 3 % width + k / 3 / width) % 2 ? 2 : 0;
    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK && pe_bake(env, &options, &maps, NULL) == PE_OK,
         "bake");
    for (int k = 0; k < 21 * width * height; k++) {
        double n[3], w[3], theta;

        reference_direction(width, height, k % (width * height) % width, k % (width * height) / width, w, &theta);
        pe_maps_normal(maps, k / (width * height), n);
        if (fabs(pe_dot(n, w)) > 1e-9)
            continue;
        on_equators++;
        worst =
            worst_of(worst, fabs((double)pe_maps_image(maps, k / (width * height))[3 * (k % (width * height))] - 1));
    }
    ok(on_equators > 0 && worst < 0.7, "%d x %d: %d texels on equators, none a mirror's (%.2g)", width, height,
       on_equators, worst);
    pe_maps_free(maps);
    pe_env_free(env);
    free(rgb);
}

/* Monte Carlo's mean is Eq. 4: many views, each answered by many samples, a Z-test on the mean difference of each. */
static void test_monte_carlo(pe_ndf_kind kind, double alpha_x, double alpha_y)
{
    environment e = { "gradient", 256, 128, reference_gradient(256, 128) };
    pe_env *env = make(&e);
    pe_surface surface = { .ndf = { kind, alpha_x, alpha_y, NULL } };
    double sum = 0, sum2 = 0, count = 0;
    unsigned state = 5;

    for (int k = 0; k < 300; k++) {
        double n[3], o[3], got[3], expected[3];

        reference_random_direction(&state, n);
        reference_random_direction(&state, o);
        if (fabs(pe_dot(n, o)) < 0.1)
            continue;
        pe_monte_carlo(env, &surface, plus_y, 2048, n, o, got);
        pe_exact(env, &surface, plus_y, n, o, expected);
        for (int c = 0; c < 3; c++) {
            sum += got[c] - expected[c];
            sum2 += (got[c] - expected[c]) * (got[c] - expected[c]);
            count++;
        }
    }
    ok(fabs(sum / count) < 4 * sqrt(sum2 / count / count), "%s, alpha %g, %g: Monte Carlo's mean, z = %.2f",
       kinds[kind], alpha_x, alpha_y, sum / count / sqrt(sum2 / count / count));
    ok(sqrt(sum2 / count) < (kind == PE_NDF_GGX ? 0.01 : 0.003),
       "%s, alpha %g, %g: Monte Carlo with 2048 samples within %.4f rms", kinds[kind], alpha_x, alpha_y,
       sqrt(sum2 / count));
    pe_env_free(env);
    free(e.rgb);
}

/* Errors of neighbouring views are unrelated: with few samples they look like grain, not like stripes. */
static void test_decorrelated(void)
{
    environment e = { "gradient", 64, 32, reference_gradient(64, 32) };
    pe_env *env = make(&e);
    pe_surface surface = { .ndf = { PE_NDF_BECKMANN, 0.5, 0.5, NULL } };
    double before = 0, product = 0, square = 0;

    for (int k = 0; k < 4000; k++) {
        double n[3] = { sin(1e-4 * k), cos(1e-4 * k), 0 }, o[3] = { 0.3, 0.8, 0.1 }, got[3], exact[3], difference;

        pe_monte_carlo(env, &surface, plus_y, 4, n, o, got);
        pe_exact(env, &surface, plus_y, n, o, exact);
        difference = got[0] - exact[0];
        product += difference * before;
        square += difference * difference;
        before = difference;
    }
    ok(fabs(product / square) < 0.1, "errors of neighbouring views correlate by %.3f", product / square);
    pe_env_free(env);
    free(e.rgb);
}

static void test_all(const environment *e, pe_ndf_kind kind)
{
    int coarse = e->width < 10; /* lobes narrower than its texels are a mirror, which the reference has not */

    test_bake(e, PE_METHOD_REPRESENTATIVE, kind, coarse ? 0.6 : 0.1, coarse ? 0.6 : 0.1, plus_y);
    test_bake(e, PE_METHOD_REPRESENTATIVE, kind, coarse ? 0.8 : 0.15, coarse ? 0.5 : 0.07, aslant);
    test_bake(e, PE_METHOD_BASELINE, kind, coarse ? 0.6 : 0.1, coarse ? 0.6 : 0.1, plus_y);
    test_bake(e, PE_METHOD_BASELINE, kind, coarse ? 0.8 : 0.15, coarse ? 0.5 : 0.07, aslant);
    test_exact(e, kind, coarse ? 0.6 : 0.2, coarse ? 0.6 : 0.15, aslant);
}

int main(void)
{
    environment all[] = {
        { "noise", 64, 32, reference_noise(64, 32, 1) },
        { "odd noise", 33, 17, reference_noise(33, 17, 2) },
        { "a sun of 30,000", 64, 32, reference_noise(64, 32, 4) },
        { "a lit pole", 64, 32, reference_noise(64, 32, 6) },
        { "3 x 2", 3, 2, reference_noise(3, 2, 7) },
    };

    for (int c = 0; c < 3; c++) {
        all[2].rgb[3 * (9 * 64 + 50) + c] = 30000;
        all[3].rgb[3 * 17 + c] = 30000;
    }
    for (int k = 0; k < 3 * (int)(sizeof all / sizeof *all); k++)
        test_all(&all[k / 3], (pe_ndf_kind)(k % 3));
    test_monte_carlo(PE_NDF_BECKMANN, 0.1, 0.1);
    test_monte_carlo(PE_NDF_BECKMANN, 0.1, 0.03);
    test_monte_carlo(PE_NDF_BECKMANN, 0.6, 0.6);
    test_monte_carlo(PE_NDF_GGX, 0.1, 0.03);
    test_monte_carlo(PE_NDF_PHONG, 0.1, 0.03);
    test_decorrelated();
    test_narrow(0.02);
    test_narrow(0.005);
    test_equator(40, 21);
    test_equator(42, 20);
    for (int k = 0; k < (int)(sizeof all / sizeof *all); k++)
        free(all[k].rgb);
    return done_testing();
}
