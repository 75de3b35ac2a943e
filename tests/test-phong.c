/* test-phong.c - claim: pe_phong is the sum of [Okumura Eq. 8], with the light test of Eq. 2 and without, and the three
 * scales of roughness agree with each other. */
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

/* ---- the slow twin ---- */

/* Every texel, the power as it is written. */
static void naive(const float *rgb, int width, int height, double exponent, pe_horizon horizon, const double n[3],
                  const double r[3], double out[3])
{
    double all = 0, seen = 0, sums[3] = { 0 };

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double w[3], theta, cosine, weight;

            reference_direction(width, height, x, y, w, &theta);
            cosine = r[0] * w[0] + r[1] * w[1] + r[2] * w[2];
            weight = cosine > 0 ? pow(cosine, exponent) * sin(theta) : 0;
            all += weight;
            if (horizon != PE_HORIZON_IGNORED && n[0] * w[0] + n[1] * w[1] + n[2] * w[2] <= REFERENCE_HORIZON)
                continue;
            seen += weight;
            for (int c = 0; c < 3; c++)
                sums[c] += weight * (double)rgb[3 * (y * width + x) + c];
        }
    for (int c = 0; c < 3; c++)
        out[c] = sums[c] / (horizon == PE_HORIZON_DARK ? all : seen);
}

#define WIDTH 96
#define HEIGHT 48

static void test_against_naive(pe_horizon horizon, const char *name)
{
    static const double exponents[] = { 0, 0.3, 1, 7, 60, 500, 4730 };
    float *rgb = reference_noise(WIDTH, HEIGHT, 3);
    double worst = 0;
    unsigned state = 5;
    pe_env *env;

    rgb[3 * (5 * WIDTH + 7)] = 30000;
    need(pe_env_create(WIDTH, HEIGHT, rgb, &env, NULL) == PE_OK, "no environment");
    for (int k = 0; k < 700; k++) {
        double n[3], r[3], got[3], expected[3];

        reference_random_direction(&state, n);
        reference_random_direction(&state, r);
        if (k % 3 == 0)
            pe_latlong_direction((k + 0.5) / WIDTH, (k % HEIGHT + 0.5) / HEIGHT, r); /* on a texel */
        if (k % 11 == 0)
            r[0] = r[2] = 1e-12 * r[0]; /* a pole */
        pe_normalize(r, r);
        if (pe_dot(n, r) < 0)
            pe_scale(-1, n, n);
        pe_phong(env, exponents[k % 7], horizon, n, r, got);
        naive(rgb, WIDTH, HEIGHT, exponents[k % 7], horizon, n, r, expected);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fabs(got[c] - expected[c]) / (expected[c] + 1e-3));
    }
    ok(worst < 1e-7, "horizon %s: within %.1e of every texel's sum", name, worst);
    pe_env_free(env);
    free(rgb);
}

/* Half of a lobe about a horizontal r lies below a floor. */
static void test_horizon(void)
{
    static const double up[3] = { 0, 1, 0 }, r[3] = { 0.8, 0, 0.6 };
    static const double expected[] = { 1, 0.5, 1 };
    float *rgb = reference_constant(WIDTH, HEIGHT, 1);
    pe_env *env;

    need(pe_env_create(WIDTH, HEIGHT, rgb, &env, NULL) == PE_OK, "no environment");
    for (int h = 0; h < 3; h++) {
        double got[3];

        pe_phong(env, 40, (pe_horizon)h, up, r, got);
        ok(fabs(got[0] - expected[h]) < 1e-9, "white surroundings, grazing, horizon %d: %.9f", h, got[0]);
    }
    pe_env_free(env);
    free(rgb);
}

static void test_scales(void)
{
    static const pe_smoothness paper = { 0 }, other = { 64, 3, 1000 };
    double worst = 0, below = 0, step = 0;

    for (int k = 1; k <= 200; k++) {
        double lambda = k / 100.0, exponent = pe_smoothness_exponent(&paper, lambda);
        double as_written = -log(256) / log(cos(atan(6.2 / (lambda * 128))));

        worst = worst_of(worst, fabs(exponent / as_written - 1));
        worst = worst_of(worst, fabs(pe_smoothness_lambda(&paper, exponent) / lambda - 1));
        worst =
            worst_of(worst, fabs(pe_smoothness_lambda(&other, pe_smoothness_exponent(&other, lambda)) / lambda - 1));
        worst = worst_of(worst, fabs(pe_phong_exponent(pe_phong_alpha(exponent)) / exponent - 1));
        step = least_of(step, exponent - below);
        below = exponent;
    }
    ok(worst < 1e-9 && step >= 0, "lambda, Lambda and alpha go there and back within %.1e", worst);
    ok(pe_smoothness_exponent(&paper, 0) == 0 && pe_smoothness_lambda(&paper, 0) == 0 && pe_phong_alpha(0) == 1 &&
           pe_phong_exponent(1) == 0,
       "nothing is rougher than Lambda = 0");
    ok(fabs(pe_smoothness_exponent(&paper, 1) - 4730) < 5, "lambda = 1 is Lambda = %.1f with the paper's numbers",
       pe_smoothness_exponent(&paper, 1));
}

/* alpha is meant to give lobes of one width: head on, Phong's distribution against Phong's lobe about r. */
static void test_alpha(void)
{
    static const double up[3] = { 0, 1, 0 }, along[3] = { 1, 0, 0 };
    const int width = 512, height = 256;
    float *rgb = reference_constant(width, height, 0);
    double worst = 0;
    pe_env *env;

    for (int k = 0; k < 3 * width * 20; k++) /* a white cap about the pole */
        rgb[k] = 1;
    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK, "no environment");
    for (int k = 0; k < 4; k++) {
        const double alphas[] = { 0.05, 0.1, 0.2, 0.3 };
        pe_surface surface = { .ndf = { PE_NDF_PHONG, alphas[k], alphas[k], NULL } };
        double a[3], b[3];

        pe_exact(env, &surface, along, up, up, a);
        pe_phong(env, pe_phong_exponent(alphas[k]), PE_HORIZON_IGNORED, NULL, up, b);
        worst = worst_of(worst, fabs(a[0] - b[0]));
    }
    ok(worst < 0.02, "a lobe by its alpha gathers within %.4f of the normal distribution's, head on", worst);
    pe_env_free(env);
    free(rgb);
}

static void test_errors(void)
{
    static const pe_smoothness bad[] = { { .size = 7 },     { .size = 65 },  { .size = 512 },       { .window = -1 },
                                         { .window = NAN }, { .levels = 1 }, { .levels = INFINITY } };
    static const char *const words[] = { "size 7",     "size 65",  "size 512",  "window -1",
                                         "window nan", "levels 1", "levels inf" };
    static const pe_smoothness zeros = { 0 };

    ok(pe_smoothness_check(&zeros, NULL) == PE_OK, "zeros are the defaults");
    for (int k = 0; k < 7; k++) {
        pe_error error = { PE_OK, "" };

        ok(pe_smoothness_check(&bad[k], &error) == PE_ERROR_ARGUMENT && strstr(error.message, words[k]), "refused: %s",
           error.message);
    }
}

int main(void)
{
    test_against_naive(PE_HORIZON_IGNORED, "ignored");
    test_against_naive(PE_HORIZON_DARK, "dark");
    test_against_naive(PE_HORIZON_MEAN, "mean");
    test_horizon();
    test_scales();
    test_alpha();
    test_errors();
    return done_testing();
}
