/* test-baseline.c - claims: a baseline map is what pe_exact says of a viewer who looks along the normal, whatever the
 * surface; fast ones are within 1 % of it and say how far they are within a factor of 2 or 0.1 %; and nothing from
 * behind a surface counts where the lobe reaches the horizon. */
#include "hdri.h"
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>

#define WORST_MAX 1e-5
#define ERROR_MAX 0.01

static const double plus_y[3] = { 0, 1, 0 }, aslant[3] = { 1, 0.2, -0.3 };
static const char *const names[] = { "beckmann", "ggx", "phong" };

static pe_maps *bake(const pe_env *env, const pe_ndf *ndf, const double direction[3], int width, pe_accuracy accuracy)
{
    pe_bake_options options = { .method = PE_METHOD_BASELINE,
                                .surface.ndf = *ndf,
                                .direction = { direction[0], direction[1], direction[2] },
                                .width = width,
                                .height = width / 2,
                                .accuracy = accuracy };
    pe_maps *maps;
    pe_error error;

    need(pe_bake(env, &options, &maps, &error) == PE_OK, "%s", error.message);
    return maps;
}

/* Exact maps against pe_exact. */
static void test_exact(const char *name, int width, int height, const pe_ndf *ndf, const double direction[3])
{
    enum { WIDTH = 34, HEIGHT = 17 };
    float *rgb = reference_noise(width, height, 3);
    pe_surface surface = { .ndf = *ndf };
    pe_env *env = NULL;
    pe_maps *maps;
    double worst = 0;

    rgb[3 * (height / 3 * width + width / 5)] = 30000;
    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK, "no memory");
    maps = bake(env, ndf, direction, WIDTH, PE_ACCURACY_EXACT);
    for (int texel = 0; texel < WIDTH * HEIGHT; texel++) {
        double w[3], theta, exact[3];

        reference_direction(WIDTH, HEIGHT, texel % WIDTH, texel / WIDTH, w, &theta);
        pe_exact(env, &surface, direction, w, w, exact);
        for (int c = 0; c < 3; c++)
            worst =
                worst_of(worst, fabs((double)pe_maps_image(maps, 0)[3 * texel + c] - exact[c]) / (exact[c] + 1e-30));
    }
    ok(worst < WORST_MAX, "%s, %s, alpha %g, %g: worst %.1e", name, names[ndf->kind], ndf->alpha_x, ndf->alpha_y,
       worst);
    pe_maps_free(maps);
    pe_env_free(env);
    free(rgb);
}

static void test_fast(const char *name, const pe_env *env, const pe_ndf *ndf)
{
    pe_maps *fast = bake(env, ndf, plus_y, 80, PE_ACCURACY_FAST),
            *exact = bake(env, ndf, plus_y, 80, PE_ACCURACY_EXACT);
    double error2 = 0, norm2 = 0, error, estimate = pe_maps_get_info(fast)->error_estimate;

    for (int k = 0; k < 3 * 80 * 40; k++) {
        double truth = (double)pe_maps_image(exact, 0)[k], difference = (double)pe_maps_image(fast, 0)[k] - truth;

        error2 += difference * difference;
        norm2 += truth * truth;
    }
    error = sqrt(error2 / norm2);
    ok(error <= ERROR_MAX, "%s, %s, alpha %g, %g: fast within %.3f %%", name, names[ndf->kind], ndf->alpha_x,
       ndf->alpha_y, 100 * error);
    ok(estimate < 2 * error + 0.001 && estimate > error / 2 - 0.001, "%s, %s, alpha %g, %g: says %.3f %%", name,
       names[ndf->kind], ndf->alpha_x, ndf->alpha_y, 100 * estimate);
    pe_maps_free(fast);
    pe_maps_free(exact);
}

static void test_all_fast(const char *name, const pe_env *env, int count)
{
    static const pe_ndf ndfs[] = {
        { PE_NDF_BECKMANN, 0.1, 0.1, NULL }, { PE_NDF_GGX, 0.1, 0.1, NULL },  { PE_NDF_BECKMANN, 0.1, 0.03, NULL },
        { PE_NDF_BECKMANN, 0.6, 0.6, NULL }, { PE_NDF_GGX, 0.1, 0.03, NULL }, { PE_NDF_GGX, 0.3, 0.3, NULL },
    };

    for (int k = 0; k < count; k++)
        test_fast(name, env, &ndfs[k]);
}

static void test_suns(void)
{
    const int width = 512, height = 256;
    float *rgb = reference_noise(width, height, 17);
    unsigned state = 2;
    pe_env *env = NULL;

    for (int sun = 0; sun < 6; sun++)
        rgb[3 * (int)(reference_random(&state) * width * height) + 1] = 30000;
    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK, "no memory");
    free(rgb);
    test_all_fast("noise with six suns", env, 6);
    pe_env_free(env);
}

static void test_hdri(const char *name)
{
    pe_env *env = hdri_read(name);

    if (!env)
        return;
    test_all_fast(name, env, 2);
    pe_env_free(env);
}

/* White above a slanting plane: texels near its other pole see nothing of it, however large the lights are. */
static void test_behind(pe_ndf_kind kind, double alpha, double bound)
{
    const double n[3] = { 0.36, 0.48, 0.8 };
    float *rgb = reference_half_white(512, 256, n);
    const pe_ndf ndf = { kind, alpha, alpha, NULL };
    pe_env *env = NULL;
    pe_maps *maps;
    double brightest = 0;

    need(pe_env_create(512, 256, rgb, &env, NULL) == PE_OK, "no memory");
    maps = bake(env, &ndf, plus_y, 400, PE_ACCURACY_FAST);
    for (int texel = 0; texel < 400 * 200; texel++) {
        double w[3], theta;

        reference_direction(400, 200, texel % 400, texel / 400, w, &theta);
        if (pe_dot(w, n) < -0.9999)
            brightest = worst_of(brightest, (double)pe_maps_image(maps, 0)[3 * texel]);
    }
    /* Where w is not -n itself it does see a sliver, at most 0.9 degrees high. */
    ok(brightest < bound, "%s, alpha %g: with the light behind it, a texel is %.1e", names[kind], alpha, brightest);
    pe_maps_free(maps);
    pe_env_free(env);
    free(rgb);
}

int main(void)
{
    static const pe_ndf ndfs[] = {
        { PE_NDF_BECKMANN, 0.1, 0.1, NULL }, { PE_NDF_BECKMANN, 0.7, 0.7, NULL }, { PE_NDF_BECKMANN, 0.15, 0.07, NULL },
        { PE_NDF_GGX, 0.1, 0.1, NULL },      { PE_NDF_GGX, 0.7, 0.7, NULL },      { PE_NDF_GGX, 0.15, 0.07, NULL },
        { PE_NDF_PHONG, 0.2, 0.2, NULL },
    };

    for (int k = 0; k < (int)(sizeof ndfs / sizeof *ndfs); k++) {
        test_exact("64 x 32", 64, 32, &ndfs[k], plus_y);
        test_exact("33 x 17", 33, 17, &ndfs[k], aslant);
        test_exact("34 x 17, as the map", 34, 17, &ndfs[k], plus_y);
    }
    test_suns();
    test_hdri("courtyard");
    test_hdri("city");
    test_behind(PE_NDF_BECKMANN, 0.2, 1e-9);
    test_behind(PE_NDF_BECKMANN, 0.6, 5e-3);
    test_behind(PE_NDF_GGX, 0.1, 2e-4);
    test_behind(PE_NDF_GGX, 0.3, 1e-3);
    return done_testing();
}
