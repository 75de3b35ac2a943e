/* test-frames.c - claims: maps of several environments baked at once are within the same bound of the exact ones as
 * those of one alone (test-fast.c), of lat-long maps and of hemispheres; each one's have the same bits in whatever
 * company, place and number of threads; a white furnace is 1; bakers that cannot, bake one by one.
 *
 * On real HDRIs where the data is at hand (PREFENV_DATA), and on an environment with small suns of 30,000. */
#include "disc.h"
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

#define ERROR_MAX 0.01

static pe_baker *make_baker(const pe_env *env, const pe_bake_options *options)
{
    pe_baker *baker;
    pe_error error;

    need(pe_baker_make(options, pe_env_width(env), pe_env_height(env), &baker, &error) == PE_OK, "%s", error.message);
    return baker;
}

static void bake_frames(const pe_baker *baker, const pe_env *const *envs, int count, pe_maps **maps)
{
    const pe_bake_errors known = { 0.5, 0.25 };
    pe_error error;

    need(pe_baker_bake_frames(baker, envs, count, &known, maps, &error) == PE_OK, "%s", error.message);
}

static size_t bytes_of(const pe_maps *maps)
{
    const pe_maps_info *info = pe_maps_get_info(maps);

    return (size_t)info->images * (size_t)(3 * info->width * info->height) * sizeof(float);
}

static int are_same(const pe_maps *a, const pe_maps *b)
{
    return bytes_of(a) == bytes_of(b) && memcmp(pe_maps_image(a, 0), pe_maps_image(b, 0), bytes_of(a)) == 0 &&
           pe_maps_get_info(a)->suns == pe_maps_get_info(b)->suns;
}

/* ---- against the exact ones ---- */

/* The cosine of n and the direction of a texel of image k; -1 where it has none. */
static double cosine_of(const pe_maps *maps, int k, int texel)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    const pe_disc disc = { info->width, info->height };
    double n[3], r[3] = { 0, 0, -1 }, theta;

    if (info->method == PE_METHOD_HEMISPHERES)
        return pe_disc_direction(&disc, texel % info->width, texel / info->width, r) ? r[2] : -1;
    pe_maps_normal(maps, k, n);
    reference_direction(info->width, info->height, texel % info->width, texel / info->width, r, &theta);
    return fabs(pe_dot(n, r));
}

static double relative_error(const pe_maps *got, const pe_maps *exact, double cosine_min)
{
    const pe_maps_info *info = pe_maps_get_info(exact);
    double error2 = 0, norm2 = 0;

    for (int k = 0; k < info->images; k++)
        for (int texel = 0; texel < info->width * info->height; texel++) {
            if (!(cosine_of(exact, k, texel) > cosine_min))
                continue;
            for (int c = 0; c < 3; c++) {
                double truth = (double)pe_maps_image(exact, k)[3 * texel + c];
                double difference = (double)pe_maps_image(got, k)[3 * texel + c] - truth;

                error2 += difference * difference;
                norm2 += truth * truth;
            }
        }
    return sqrt(error2 / norm2);
}

static void test_error(const char *name, const pe_env *env, pe_method method, pe_weight weight, double alpha_x,
                       double alpha_y)
{
    pe_bake_options options = { .method = method,
                                .surface.ndf = { PE_NDF_BECKMANN, alpha_x, alpha_y, NULL },
                                .normals = 12,
                                .width = method == PE_METHOD_HEMISPHERES ? 44 : 80,
                                .height = method == PE_METHOD_HEMISPHERES ? 44 : 40,
                                .accuracy = PE_ACCURACY_FAST };
    pe_baker *baker;
    pe_maps *got, *alone, *exact;
    double error, alone_error;
    pe_error why;

    options.surface.weight = weight;
    if (weight == PE_WEIGHT_MICROFACET)
        pe_material("copper", options.surface.eta, options.surface.k);
    baker = make_baker(env, &options);
    bake_frames(baker, &env, 1, &got);
    need(pe_bake(env, &options, &alone, &why) == PE_OK, "%s", why.message);
    options.accuracy = PE_ACCURACY_EXACT;
    need(pe_bake(env, &options, &exact, &why) == PE_OK, "%s", why.message);
    error = relative_error(got, exact, 0.15);
    alone_error = relative_error(alone, exact, 0.15);
    ok(error <= ERROR_MAX && error < 2 * alone_error + 0.001,
       "%s, %s%s, alpha %g, %g: within %.3f %% (%.3f %% with grazing); alone %.3f %% (%.3f %%)", name,
       method == PE_METHOD_HEMISPHERES ? "hemispheres" : "lat-long",
       weight == PE_WEIGHT_MICROFACET ? ", microfacets" : "", alpha_x, alpha_y, 100 * error,
       100 * relative_error(got, exact, 0), 100 * alone_error, 100 * relative_error(alone, exact, 0));
    pe_maps_free(got);
    pe_maps_free(alone);
    pe_maps_free(exact);
    pe_baker_free(baker);
}

static pe_env *make_suns(unsigned seed)
{
    const int width = 512, height = 256;
    float *rgb = reference_noise(width, height, seed);
    unsigned state = seed;
    pe_env *env;

    for (int sun = 0; sun < 6; sun++)
        rgb[3 * (int)(reference_random(&state) * width * height) + 1] = 30000;
    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK, "no memory");
    free(rgb);
    return env;
}

static void test_suns(void)
{
    pe_env *env = make_suns(17);

    test_error("noise with six suns", env, PE_METHOD_REPRESENTATIVE, PE_WEIGHT_NDF, 0.1, 0.1);
    test_error("noise with six suns", env, PE_METHOD_HEMISPHERES, PE_WEIGHT_NDF, 0.1, 0.03);
    test_error("noise with six suns", env, PE_METHOD_REPRESENTATIVE, PE_WEIGHT_NDF, 0.6, 0.6);
    test_error("noise with six suns", env, PE_METHOD_REPRESENTATIVE, PE_WEIGHT_MICROFACET, 0.1, 0.1);
    test_error("noise with six suns", env, PE_METHOD_HEMISPHERES, PE_WEIGHT_MICROFACET, 0.1, 0.1);
    pe_env_free(env);
}

static void test_hdri(const char *name)
{
    const char *data = getenv("PREFENV_DATA");
    char path[4096];
    pe_env *env;
    pe_error error;

    snprintf(path, sizeof path, "%s/hdri/%s.exr", data ? data : ".", name);
    if (pe_env_read(path, &env, &error) != PE_OK) {
        ok(1, "%s # SKIP %s", name, error.message);
        return;
    }
    test_error(name, env, PE_METHOD_REPRESENTATIVE, PE_WEIGHT_NDF, 0.1, 0.1);
    test_error(name, env, PE_METHOD_HEMISPHERES, PE_WEIGHT_NDF, 0.1, 0.1);
    if (strcmp(name, "city") == 0) {
        test_error(name, env, PE_METHOD_HEMISPHERES, PE_WEIGHT_NDF, 0.03, 0.03);
        test_error(name, env, PE_METHOD_REPRESENTATIVE, PE_WEIGHT_NDF, 0.2, 0.02);
    }
    pe_env_free(env);
}

/* ---- in whatever company ---- */

static void test_company(pe_method method)
{
    pe_env *envs[PE_FRAMES_MAX];
    const pe_env *turned[PE_FRAMES_MAX];
    pe_bake_options options = { .method = method,
                                .surface.ndf = { PE_NDF_BECKMANN, 0.3, 0.2, NULL },
                                .normals = 12,
                                .width = 20,
                                .height = 16,
                                .threads = 1,
                                .accuracy = PE_ACCURACY_FAST };
    pe_maps *together[PE_FRAMES_MAX], *again[PE_FRAMES_MAX], *alone;
    pe_baker *one_thread, *three_threads;

    for (int k = 0; k < PE_FRAMES_MAX; k++)
        envs[k] = make_suns(20 + (unsigned)k);
    for (int k = 0; k < PE_FRAMES_MAX; k++)
        turned[k] = envs[PE_FRAMES_MAX - 1 - k];
    one_thread = make_baker(envs[0], &options);
    options.threads = 3;
    three_threads = make_baker(envs[0], &options);
    bake_frames(one_thread, (const pe_env *const *)envs, PE_FRAMES_MAX, together);
    bake_frames(three_threads, turned, PE_FRAMES_MAX, again);
    for (int k = 0; k < PE_FRAMES_MAX; k++) {
        bake_frames(one_thread, (const pe_env *const *)&envs[k], 1, &alone);
        ok(are_same(together[k], alone) && are_same(together[k], again[PE_FRAMES_MAX - 1 - k]),
           "method %d: frame %d of %d, of one, and the other way round by three threads: the same bits", (int)method, k,
           PE_FRAMES_MAX);
        pe_maps_free(alone);
    }
    ok(!are_same(together[0], together[1]), "method %d: and others for others", (int)method);
    for (int k = 0; k < PE_FRAMES_MAX; k++) {
        pe_maps_free(together[k]);
        pe_maps_free(again[k]);
        pe_env_free(envs[k]);
    }
    pe_baker_free(one_thread);
    pe_baker_free(three_threads);
}

/* ---- furnace ---- */

static void test_furnace(pe_method method)
{
    enum { WIDTH = 256, HEIGHT = 128 };
    float *rgb = malloc((size_t)3 * WIDTH * HEIGHT * sizeof *rgb);
    pe_bake_options options = {
        .method = method, .normals = 12, .width = 40, .height = 40, .accuracy = PE_ACCURACY_FAST
    };
    pe_baker *baker;
    double worst = 0;
    pe_maps *maps;
    pe_env *env;

    for (int k = 0; rgb && k < 3 * WIDTH * HEIGHT; k++)
        rgb[k] = 1;
    need(rgb != NULL, "no memory");
    need(pe_env_create(WIDTH, HEIGHT, rgb, &env, NULL) == PE_OK, "no memory");
    baker = make_baker(env, &options);
    bake_frames(baker, (const pe_env *const *)&env, 1, &maps);
    for (size_t k = 0; k < bytes_of(maps) / sizeof(float); k++)
        worst = worst_of(worst, fabs((double)pe_maps_image(maps, 0)[k] - 1));
    ok(worst < 2e-5, "method %d: a white furnace is 1 within %.1e", (int)method, worst);
    pe_maps_free(maps);
    pe_baker_free(baker);
    pe_env_free(env);
    free(rgb);
}

/* ---- what cannot be baked at once ---- */

static void test_exact(void)
{
    pe_env *env = make_suns(30);
    const pe_env *envs[2] = { env, env };
    pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, 0.3, 0.2, NULL },
                                .normals = 12,
                                .width = 12,
                                .height = 12,
                                .accuracy = PE_ACCURACY_EXACT };
    pe_baker *baker = make_baker(env, &options);
    pe_maps *maps[2], *alone;
    pe_error error;

    bake_frames(baker, envs, 2, maps);
    need(pe_bake(env, &options, &alone, &error) == PE_OK, "%s", error.message);
    ok(are_same(maps[0], alone) && are_same(maps[1], alone), "exact ones are those of one alone");
    ok(pe_maps_get_info(maps[1])->lookup_error == 0.25, "errors that are given are recorded");
    ok(pe_baker_bake_frames(baker, envs, 0, NULL, maps, &error) == PE_ERROR_ARGUMENT &&
           strstr(error.message, "0 frames at once are out of range; give 1 to 5"),
       "none is refused: %s", error.message);
    pe_maps_free(maps[0]);
    pe_maps_free(maps[1]);
    pe_maps_free(alone);
    pe_baker_free(baker);
    pe_env_free(env);
}

/* ---- what fails ---- */

static int stop_if(double fraction, void *data)
{
    (void)fraction;
    return *(const int *)data;
}

static void test_failure(pe_accuracy accuracy)
{
    pe_env *env = make_suns(30);
    const pe_env *envs[2] = { env, env };
    int stop = 0;
    pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, 0.3, 0.2, NULL },
                                .normals = 12,
                                .width = 40,
                                .height = 40,
                                .accuracy = accuracy,
                                .progress = stop_if,
                                .progress_data = &stop };
    pe_baker *baker = make_baker(env, &options);
    pe_maps *earlier, *maps[2];
    pe_error error;

    bake_frames(baker, envs, 1, &earlier);
    maps[0] = maps[1] = earlier;
    stop = 1;
    ok(pe_baker_bake_frames(baker, envs, 2, NULL, maps, &error) == PE_ERROR_CANCELLED && maps[0] == earlier &&
           maps[1] == earlier,
       "accuracy %d: where the bake fails, what was there stays", (int)accuracy);
    pe_maps_free(earlier);
    pe_baker_free(baker);
    pe_env_free(env);
}

int main(void)
{
    static const char *const hdris[] = { "city", "studio", "forest", "courtyard", "sunrise" };

    test_suns();
    for (int k = 0; k < 5; k++)
        test_hdri(hdris[k]);
    test_company(PE_METHOD_HEMISPHERES);
    test_company(PE_METHOD_REPRESENTATIVE);
    test_furnace(PE_METHOD_HEMISPHERES);
    test_furnace(PE_METHOD_REPRESENTATIVE);
    test_exact();
    test_failure(PE_ACCURACY_EXACT);
    test_failure(PE_ACCURACY_FAST);
    return done_testing();
}
