/* test-hemispheres.c - claims: every texel of a hemisphere is the naive reference's; suns drawn out come back exact;
 * the kernel agrees with the loop over lights that it stands for, of D and of microfacets, and any number of threads
 * gives the same bytes; a white furnace is 1 everywhere; lookups are continuous; a brush direction given at each point
 * costs less than half as much error again as one that the file fixes; a file keeps all that. */
#include "hemispheres.h"
#include "ndf.h"
#include "reference.h"
#include "sample_point.h"
#include "suns.h"
#include "tap.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const kinds[] = { "beckmann", "ggx", "phong", "table" };
static const double aslant[3] = { 1, 0.2, -0.3 };

static pe_env *make_env(int width, int height, float *rgb)
{
    pe_env *env;

    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK, "no memory");
    free(rgb);
    return env;
}

static pe_maps *bake(const pe_env *env, const pe_bake_options *options)
{
    pe_maps *maps;
    pe_error error;

    need(pe_bake(env, options, &maps, &error) == PE_OK, "%s", error.message);
    return maps;
}

/* A surface of random normal n and a viewer o of it, their cosine above cos_min. */
static void random_view(unsigned *state, double cos_min, double n[3], double o[3])
{
    do {
        reference_random_direction(state, n);
        reference_random_direction(state, o);
    } while (!(pe_dot(n, o) > cos_min));
}

typedef struct difference {
    double error2, norm2, worst;
} difference;

static void compare(const double got[3], const double expected[3], difference *d)
{
    for (int c = 0; c < 3; c++) {
        double miss = fabs(got[c] - expected[c]);

        d->error2 += miss * miss;
        d->norm2 += expected[c] * expected[c];
        d->worst = worst_of(d->worst, miss / (expected[c] + 1e-30));
    }
}

static double relative(const difference *d)
{
    return sqrt(d->error2 / d->norm2);
}

/* ---- texels ---- */

/* The brush direction of image k: the file's, turned about n from t towards b. */
static void turned_brush(const pe_maps_info *info, int k, const double n[3], double d[3])
{
    double turn = M_PI * (k % info->angles) / info->angles;
    pe_frame frame;

    pe_frame_make(n, info->direction, &frame);
    pe_frame_direction(&frame, (const double[3]){ cos(turn), sin(turn), 0 }, d);
}

/* What the reference says of a texel, whose direction in the tangent frame is `local`. */
static void reference_texel(const float *rgb, int width, int height, const pe_maps *maps, int image,
                            const double local[3], double out[3])
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    double n[3], d[3], w[3], o[3];
    pe_frame frame;

    pe_maps_normal(maps, image, n);
    turned_brush(info, image, n, d);
    pe_frame_make(n, d, &frame);
    pe_frame_direction(&frame, local, w);
    pe_reflect(w, n, o);
    reference_reflection_of((int)info->surface.ndf.kind, rgb, width, height, info->surface.ndf.alpha_x,
                            info->surface.ndf.alpha_y, d, n, o, out);
}

/* In single precision, bounds as in test-filter.c. */
static void test_texels(pe_ndf_kind kind, double alpha_x, double alpha_y, int angles)
{
    enum { ENV_WIDTH = 48, ENV_HEIGHT = 25 };
    float *rgb = reference_noise(ENV_WIDTH, ENV_HEIGHT, 6);
    pe_env *env;
    pe_bake_options options = { .surface.ndf = { kind, alpha_x, alpha_y, NULL },
                                .direction = { aslant[0], aslant[1], aslant[2] },
                                .normals = 12,
                                .width = 21,
                                .height = 16,
                                .angles = angles,
                                .accuracy = PE_ACCURACY_EXACT };
    difference d = { 0, 0, 0 };
    pe_disc disc = { 21, 16 };
    pe_maps *maps;

    need(pe_env_create(ENV_WIDTH, ENV_HEIGHT, rgb, &env, NULL) == PE_OK, "no memory");
    maps = bake(env, &options);
    for (int k = 0; k < 12 * angles * 21 * 16; k += 7 * angles - 1) {
        int image = k / (21 * 16), texel = k % (21 * 16);
        double local[3], expected[3], got[3];

        if (!pe_disc_direction(&disc, texel % 21, texel / 21, local))
            continue;
        reference_texel(rgb, ENV_WIDTH, ENV_HEIGHT, maps, image, local, expected);
        for (int c = 0; c < 3; c++)
            got[c] = (double)pe_maps_image(maps, image)[3 * texel + c];
        compare(got, expected, &d);
    }
    ok(d.worst < 1e-5 && relative(&d) < 3e-6, "texels, %s, alpha %g, %g, %d angles: worst %.1e, rms %.1e", kinds[kind],
       alpha_x, alpha_y, angles, d.worst, relative(&d));
    pe_maps_free(maps);
    pe_env_free(env);
    free(rgb);
}

/* ---- between texels ---- */

/* A room with lamps a thousand times as bright as its walls. */
static pe_env *make_studio(int width, int height)
{
    float *rgb = reference_room(width, height);

    for (int k = 0; k < 3 * width * height; k++)
        rgb[k] *= rgb[k] > 1 ? 200 : 1;
    return make_env(width, height, rgb);
}

/* Where a lobe at grazing angles is narrower than a texel, no lookup comes out dark: a spline that swings below zero
 * beside a lamp would. */
static void test_dark(void)
{
    enum { WIDTH = 128, HEIGHT = 64, VIEWS = 4000 };
    const pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, 0.1, 0.1, NULL } };
    pe_env *env = make_studio(WIDTH, HEIGHT);
    pe_maps *maps = bake(env, &options);
    double darkest = 1;
    unsigned state = 3;

    for (int k = 0; k < VIEWS; k++) {
        double n[3], o[3], got[3], expected[3];

        do
            random_view(&state, 0.02, n, o);
        while (pe_dot(n, o) > 0.3);
        pe_exact(env, &options.surface, (const double[3]){ 0, 1, 0 }, n, o, expected);
        sample_point(maps, NULL, NULL, n, o, got);
        for (int c = 0; c < 3; c++)
            darkest = least_of(darkest, got[c] / expected[c]);
    }
    ok(darkest > 0.05, "at grazing angles in a room of lamps: no lookup below %.3f of the truth", darkest);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- suns ---- */

/* What suns add, those left out that are too far from the mirror direction, against the sum over all of them, in parts
 * of one sun's brightest highlight. */
static void test_sum_of_suns(pe_ndf_kind kind, double alpha_x, double alpha_y)
{
    enum { COUNT = 13, VIEWS = 20000 };
    static const double up[3] = { 0, 0, 1 };
    const pe_surface surface = { .ndf = { kind, alpha_x, alpha_y, NULL } };
    pe_suns suns = { 0 };
    pe_denominators denominators = { 0 };
    pe_denominator *denominator;
    unsigned state = 21;
    double worst = 0;

    need(pe_denominator_make(&surface.ndf, &denominator, NULL) == PE_OK, "no memory");
    pe_denominators_add(&denominators, denominator, 1);
    for (int k = 0; k < COUNT; k++) {
        double w[3], power[3] = { 1, reference_random(&state), reference_random(&state) };

        reference_random_direction(&state, w);
        pe_suns_add_sun(&suns, w, power);
    }
    for (int view = 0; view < VIEWS; view++) {
        double n[3], o[3], local[3], got[3] = { 0, 0, 0 }, sum[3] = { 0, 0, 0 };
        pe_frame frame;

        random_view(&state, 0, n, o);
        pe_suns_add(&suns, &surface, &denominators, aslant, n, o, got);
        pe_frame_make(n, aslant, &frame);
        for (int k = 0; k < COUNT; k++) {
            const double *w = suns.direction[k];
            double h[3] = { o[0] + w[0], o[1] + w[1], o[2] + w[2] };

            pe_frame_coordinates(&frame, h, local);
            pe_normalize(local, local);
            for (int c = 0; c < 3 && pe_dot(w, n) > 0; c++)
                sum[c] += pe_ndf_evaluate(&surface.ndf, local) * suns.power[k][c];
        }
        pe_frame_coordinates(&frame, o, local);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fabs(got[c] * pe_denominator_at(denominator, local) - sum[c]));
    }
    worst /= pe_ndf_evaluate(&surface.ndf, up);
    ok(worst < 5e-9, "%s, alpha %g, %g: %d suns add up to within %.1e", kinds[kind], alpha_x, alpha_y, COUNT, worst);
    pe_denominator_free(denominator);
}

/* In the highlights of suns, for any normal.  Beckmann's bound is the discreteness of the truth's own denominator: it
 * falls with the environment's texels; GGX's is that of the mean over half vectors that stands for the integral. */
static void test_suns(pe_ndf_kind kind, double alpha_x, double alpha_y, double worst_max, double rms_max)
{
    enum { WIDTH = 256, HEIGHT = 128 };
    static const int places[4][2] = { { 40, 26 }, { 41, 26 }, { 154, 80 }, { 200, 4 } };
    float *rgb = reference_noise(WIDTH, HEIGHT, 9);
    pe_bake_options options = { .surface.ndf = { kind, alpha_x, alpha_y, NULL },
                                .direction = { aslant[0], aslant[1], aslant[2] },
                                .normals = 42,
                                .accuracy = PE_ACCURACY_EXACT };
    difference d = { 0, 0, 0 };
    unsigned state = 12;
    pe_env *env;
    pe_maps *maps;

    for (int k = 0; k < 4; k++)
        for (int c = 0; c < 3; c++)
            rgb[3 * (places[k][1] * WIDTH + places[k][0]) + c] = (float)(30000 - 9000 * c);
    env = make_env(WIDTH, HEIGHT, rgb);
    maps = bake(env, &options);
    for (int k = 0; k < 400; k++) {
        double w[3], theta, h[3], n[3], o[3], got[3], exact[3];

        reference_direction(WIDTH, HEIGHT, places[k % 4][0], places[k % 4][1], w, &theta);
        reference_random_direction(&state, n);
        if (!(pe_dot(n, w) > 0.25))
            continue;
        for (int c = 0; c < 3; c++)
            h[c] = n[c] + alpha_y * (reference_random(&state) - 0.5);
        pe_normalize(h, h);
        pe_reflect(w, h, o);
        if (!(pe_dot(n, o) > 0.15))
            continue;
        sample_point(maps, NULL, NULL, n, o, got);
        pe_exact(env, &options.surface, aslant, n, o, exact);
        compare(got, exact, &d);
    }
    ok(pe_maps_get_info(maps)->suns == 4 && d.worst < worst_max && relative(&d) < rms_max,
       "%d suns, %s, alpha %g, %g: highlights within %.2f %%, rms %.2f %%", pe_maps_get_info(maps)->suns, kinds[kind],
       alpha_x, alpha_y, 100 * d.worst, 100 * relative(&d));
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- the kernel ---- */

/* All texels with n.r > 0.15. */
/* The viewer's point lies on the rim of the table of denominators, where a tap too far would read beside it. */
static void test_suns_on_horizon(void)
{
    enum { WIDTH = 64, HEIGHT = 32, TURNS = 64 };
    static const double up[3] = { 0, 1, 0 };
    float *rgb = reference_constant(WIDTH, HEIGHT, 0.5f);
    pe_bake_options options = {
        .direction = { 1, 0, 0 }, .normals = 42, .width = 16, .height = 16, .surface.ndf = { 0, 0.3, 0.3, NULL }
    };
    int wrong = 0;
    pe_env *env;
    pe_maps *maps;

    for (int x = 0; x < WIDTH; x += 4)
        rgb[3 * (15 * WIDTH + x)] = 20000;
    env = make_env(WIDTH, HEIGHT, rgb);
    maps = bake(env, &options);
    for (int k = 0; k < TURNS; k++) {
        double turn = 2 * M_PI * k / TURNS, o[3] = { cos(turn), k % 2 ? 0 : 1e-12, sin(turn) }, got[3];

        sample_point(maps, NULL, NULL, up, o, got);
        for (int c = 0; c < 3; c++)
            wrong += !(got[c] >= 0 && got[c] < 1e6);
    }
    ok(pe_maps_get_info(maps)->suns == 16 && wrong == 0, "%d suns seen along the horizon: radiance finite, %d not",
       pe_maps_get_info(maps)->suns, wrong);
    pe_maps_free(maps);
    pe_env_free(env);
}

static difference compare_maps(const pe_maps *a, const pe_maps *b)
{
    const pe_maps_info *info = pe_maps_get_info(b);
    pe_disc disc = { info->width, info->height };
    difference d = { 0, 0, 0 };

    for (int k = 0; k < info->images * info->width * info->height; k++) {
        int image = k / (info->width * info->height), texel = k % (info->width * info->height);
        double local[3], got[3], expected[3];

        if (!pe_disc_direction(&disc, texel % info->width, texel / info->width, local) || !(local[2] > 0.15))
            continue;
        for (int c = 0; c < 3; c++) {
            got[c] = (double)pe_maps_image(a, image)[3 * texel + c];
            expected[c] = (double)pe_maps_image(b, image)[3 * texel + c];
        }
        compare(got, expected, &d);
    }
    return d;
}

static pe_maps *make_maps(const pe_surface *surface)
{
    pe_maps_info info = { .method = PE_METHOD_HEMISPHERES,
                          .surface = *surface,
                          .direction = { aslant[0], aslant[1], aslant[2] },
                          .normals = 12,
                          .angles = 1,
                          .width = 25,
                          .height = 25 };
    pe_maps *maps;

    need(pe_maps_create(&info, &maps, NULL) == PE_OK, "maps");
    return maps;
}

/* Filled from the same lights by kernel and by loop: relative L2 below what the kernel is asked for. */
static void test_kernel(pe_weight weight, pe_ndf_kind kind, double alpha_x, double alpha_y, double wanted)
{
    pe_surface surface = { .ndf = { kind, alpha_x, alpha_y, NULL }, .weight = weight };
    pe_env *env = make_env(64, 32, reference_noise(64, 32, 10));
    pe_maps *by_loop, *by_kernel;
    pe_kernel *kernel = NULL;
    pe_lobe *lobe = NULL;
    pe_cloud cloud;
    pe_disc cells;
    difference d;

    if (weight == PE_WEIGHT_MICROFACET)
        pe_material("copper", surface.eta, surface.k);
    by_loop = make_maps(&surface);
    by_kernel = make_maps(&surface);
    need(pe_lobe_make(&surface, 2, &lobe, NULL) == PE_OK && pe_cloud_from_env(env, &cloud, NULL) == PE_OK, "lobe");
    cells = pe_kernel_cells(lobe, wanted);
    need(pe_kernel_make(lobe, &by_kernel->disc, &cells, 2, NULL, &kernel, NULL) == PE_OK &&
             pe_fill_hemispheres_by_kernel(&cloud, lobe, kernel, 2, NULL, by_kernel, NULL) == PE_OK &&
             pe_fill_hemispheres(&cloud, lobe, pe_lobe_reach(lobe, PE_LOBE_CUTOFF), 2, NULL, by_loop, NULL) == PE_OK,
         "fill");
    d = compare_maps(by_kernel, by_loop);
    ok(relative(&d) < wanted, "kernel, %s, %s, alpha %g, %g, asked for %g: within %.2e of the loop, worst %.1e",
       weight == PE_WEIGHT_NDF ? "ndf" : "microfacet", kinds[kind], alpha_x, alpha_y, wanted, relative(&d), d.worst);
    pe_kernel_free(kernel);
    pe_cloud_free(&cloud);
    pe_lobe_free(lobe);
    pe_maps_free(by_loop);
    pe_maps_free(by_kernel);
    pe_env_free(env);
}

static void test_threads(pe_accuracy accuracy)
{
    pe_env *env = make_env(64, 32, reference_noise(64, 32, 11));
    pe_maps *maps[3];
    int same = 1;

    for (int k = 0; k < 3; k++) {
        pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, 0.4, 0.2, NULL },
                                    .normals = 12,
                                    .width = 19,
                                    .height = 24,
                                    .accuracy = accuracy,
                                    .threads = k + 1 };

        maps[k] = bake(env, &options);
        same &= memcmp(pe_maps_image(maps[k], 0), pe_maps_image(maps[0], 0), sizeof(float) * 3 * 12 * 19 * 24) == 0 &&
                pe_maps_get_info(maps[k])->error_estimate == pe_maps_get_info(maps[0])->error_estimate &&
                pe_maps_get_info(maps[k])->lookup_error == pe_maps_get_info(maps[0])->lookup_error;
    }
    ok(same, "%s: the same bytes from 1, 2 and 3 threads", accuracy == PE_ACCURACY_FAST ? "fast" : "exact");
    for (int k = 0; k < 3; k++)
        pe_maps_free(maps[k]);
    pe_env_free(env);
}

/* ---- furnace ---- */

static void test_furnace(const pe_ndf *ndf, pe_accuracy accuracy, int angles)
{
    pe_env *env = make_env(64, 32, reference_constant(64, 32, 1));
    pe_bake_options options = {
        .surface.ndf = *ndf, .normals = 42, .width = 17, .height = 14, .angles = angles, .accuracy = accuracy
    };
    pe_maps *maps = bake(env, &options);
    double worst = 0;
    unsigned state = 1;

    for (int k = 0; k < 5000; k++) {
        double n[3], o[3], d[3], rgb[3];
        pe_sampling sampling = { (pe_interpolation)(k % 4), 0, PE_HORIZON_IGNORED };

        random_view(&state, -1, n, o);
        reference_random_direction(&state, d);
        if (k % 5 == 0)
            pe_maps_normal(maps, k % (42 * angles), n);
        if (k % 3 == 0) /* grazing to within rounding */
            for (int c = 0; c < 3; c++)
                o[c] -= pe_dot(n, o) * n[c] * (1 - 1e-15);
        sample_point(maps, &sampling, d, n, o, rgb);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fabs(rgb[c] - 1));
    }
    ok(worst < 1e-5, "white furnace, %s, alpha %g, %g, %s, %d angles: 1 within %.1e", kinds[ndf->kind], ndf->alpha_x,
       ndf->alpha_y, accuracy == PE_ACCURACY_FAST ? "fast" : "exact", angles, worst);
    pe_maps_free(maps);
    pe_env_free(env);
}

static void test_furnaces(void)
{
    static const double range[2] = { -0.5, 0.5 };
    float *density = reference_noise(8, 3, 5);
    pe_ndf_table *table = NULL;

    need(pe_ndf_table_create(24, 3, range, range, density, &table, NULL) == PE_OK, "table");
    free(density);
    for (int accuracy = PE_ACCURACY_EXACT; accuracy <= PE_ACCURACY_FAST; accuracy++) {
        test_furnace(&(pe_ndf){ PE_NDF_BECKMANN, 0.4, 0.15, NULL }, (pe_accuracy)accuracy, 1);
        test_furnace(&(pe_ndf){ PE_NDF_BECKMANN, 0.1, 0.1, NULL }, (pe_accuracy)accuracy, 5);
        test_furnace(&(pe_ndf){ PE_NDF_GGX, 0.3, 0.2, NULL }, (pe_accuracy)accuracy, 1);
        test_furnace(&(pe_ndf){ PE_NDF_PHONG, 0.3, 0.3, NULL }, (pe_accuracy)accuracy, 4);
        test_furnace(&(pe_ndf){ PE_NDF_TABLE, 0, 0, table }, (pe_accuracy)accuracy, 1);
    }
    pe_ndf_table_free(table);
}

/* ---- continuity ---- */

#define STEP 1e-5

/* Two views closer than STEP: of random n and o, the second turned a little.  Grazing ones, and n on the edge of a
 * triangle - half way between two vertices of frequency 2 -, among them. */
static void neighbours(const pe_maps *maps, int k, unsigned *state, double n[2][3], double o[2][3])
{
    double grazing = k % 3 == 0 ? 1e-4 + 0.02 * reference_random(state) : 0, aside[3];

    random_view(state, 0.01, n[0], o[0]);
    if (k % 4 == 1) {
        double other[3], least = 4;

        for (int vertex = 0; vertex < 42; vertex++) { /* the nearest of another, and a point between */
            double candidate[3], miss = 0;

            pe_maps_normal(maps, k % 42, n[0]);
            pe_maps_normal(maps, vertex, candidate);
            for (int c = 0; c < 3; c++)
                miss += pow(candidate[c] - n[0][c], 2);
            if (vertex != k % 42 && miss * (1 + 0.5 * reference_random(state)) < least) {
                least = miss;
                memcpy(other, candidate, sizeof other);
            }
        }
        for (int c = 0; c < 3; c++)
            n[0][c] += reference_random(state) * other[c];
        pe_normalize(n[0], n[0]);
    }
    if (grazing > 0 || pe_dot(n[0], o[0]) < 0.01) {
        double along = pe_dot(n[0], o[0]);

        for (int c = 0; c < 3; c++)
            o[0][c] += (grazing + 1e-3 - along) * n[0][c];
        pe_normalize(o[0], o[0]);
    }
    for (int v = 0; v < 2; v++) {
        reference_random_direction(state, aside);
        for (int c = 0; c < 3; c++) {
            double from[2] = { n[0][c], o[0][c] };

            (v ? o : n)[1][c] = from[v] + STEP * aside[c];
        }
    }
    for (int c = 0; c < 3; c++) { /* the first a step to the other side, so that an edge lies between */
        n[0][c] = 2 * n[0][c] - n[1][c];
        o[0][c] = 2 * o[0][c] - o[1][c];
    }
}

/* Lookups of alpha 0.3 change, over a radian of tilt, by a few times the difference between black and white: a jump
 * would be some thousand times that. */
static void test_continuity(int angles)
{
    pe_env *env = make_env(64, 32, reference_noise(64, 32, 3));
    pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, 0.3, 0.3, NULL },
                                .direction = { aslant[0], aslant[1], aslant[2] },
                                .normals = 42,
                                .angles = angles,
                                .accuracy = PE_ACCURACY_EXACT };
    pe_maps *maps = bake(env, &options);
    double steepest = 0;
    unsigned state = 4;

    for (int k = 0; k < 12000; k++) {
        double n[2][3], o[2][3], rgb[2][3];

        neighbours(maps, k, &state, n, o);
        for (int v = 0; v < 2; v++)
            sample_point(maps, NULL, aslant, n[v], o[v], rgb[v]);
        for (int c = 0; c < 3; c++)
            steepest = worst_of(steepest, fabs(rgb[1][c] - rgb[0][c]) / (2 * STEP));
    }
    ok(steepest < 10, "%d angles: lookups change by %.2f a radian at most, edges and horizons included", angles,
       steepest);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- brush directions ---- */

typedef enum brush { BRUSH_OF_FILE, BRUSH_GIVEN, BRUSH_RANDOM } brush;

/* Relative error of lookups: the file's brush, left out or given, or another for each view. */
static double brush_error(const pe_env *env, const pe_maps *maps, const pe_surface *surface, brush kind)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    difference d = { 0, 0, 0 };
    unsigned state = 21;

    for (int k = 0; k < 600; k++) {
        double n[3], o[3], direction[3], got[3], exact[3];

        random_view(&state, 0.15, n, o);
        reference_random_direction(&state, direction);
        if (kind != BRUSH_RANDOM)
            memcpy(direction, info->direction, sizeof direction);
        sample_point(maps, NULL, kind == BRUSH_OF_FILE ? NULL : direction, n, o, got);
        pe_exact(env, surface, direction, n, o, exact);
        compare(got, exact, &d);
    }
    return relative(&d);
}

static void test_brush(double alpha_x, double alpha_y, int angles)
{
    pe_env *env = make_env(128, 64, reference_room(128, 64));
    pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, alpha_x, alpha_y, NULL },
                                .normals = 162,
                                .width = 43,
                                .height = 43,
                                .accuracy = PE_ACCURACY_FAST };
    pe_maps *fixed = bake(env, &options), *turning;
    double error = brush_error(env, fixed, &options.surface, BRUSH_OF_FILE), given, any;

    options.angles = angles;
    turning = bake(env, &options);
    given = brush_error(env, turning, &options.surface, BRUSH_GIVEN);
    any = brush_error(env, turning, &options.surface, BRUSH_RANDOM);
    ok(any < 1.5 * error && given < 1.5 * error && brush_error(env, turning, &options.surface, BRUSH_OF_FILE) == given,
       "alpha %g, %g, %d angles: error %.2f %% with random brushes, %.2f %% with the file's; fixed %.2f %%", alpha_x,
       alpha_y, angles, 100 * any, 100 * given, 100 * error);
    pe_maps_free(turning);
    pe_maps_free(fixed);
    pe_env_free(env);
}

/* Slopes about one that is not 0, and none about its opposite: after half a turn it is another surface. */
static pe_ndf_table *make_slope(void)
{
    enum { CELLS = 40 };
    static const double p_range[2] = { -0.2, 0.6 }, q_range[2] = { -0.4, 0.4 };
    static float density[CELLS * CELLS];
    pe_ndf_table *table;
    pe_error error;

    for (int k = 0; k < CELLS * CELLS; k++) {
        int row = k / CELLS;
        double p = (k % CELLS + 0.5 - CELLS / 2.0) / CELLS * 0.8, q = (row + 0.5 - CELLS / 2.0) / CELLS * 0.8;

        density[k] = (float)exp(-(p * p + q * q) / (0.12 * 0.12));
    }
    need(pe_ndf_table_create(CELLS, CELLS, p_range, q_range, density, &table, &error) == PE_OK, "%s", error.message);
    return table;
}

static void test_brush_of_table(void)
{
    pe_env *env = make_env(64, 32, reference_room(64, 32));
    pe_ndf_table *table = make_slope();
    pe_bake_options options = { .surface.ndf = { PE_NDF_TABLE, 0, 0, table },
                                .normals = 162,
                                .width = 36,
                                .height = 36,
                                .accuracy = PE_ACCURACY_FAST };
    const char *path = "test-hemispheres.turn.exr";
    pe_maps *fixed = bake(env, &options), *turning, *read = NULL;
    double error = brush_error(env, fixed, &options.surface, BRUSH_OF_FILE), any;
    pe_error why;

    options.angles = 16;
    turning = bake(env, &options);
    any = brush_error(env, turning, &options.surface, BRUSH_RANDOM);
    ok(any < error, "a table that half a turn changes, 16 angles: error %.2f %% with random brushes, fixed %.2f %%",
       100 * any, 100 * error);
    need(pe_maps_write(turning, path, PE_PIXEL_FLOAT, &why) == PE_OK && pe_maps_read(path, &read, &why) == PE_OK, "%s",
         why.message);
    ok(fabs(brush_error(env, read, &options.surface, BRUSH_RANDOM) - any) < 1e-6, "its file reads as it was written");
    unlink(path);
    pe_maps_free(read);
    pe_maps_free(turning);
    pe_maps_free(fixed);
    pe_ndf_table_free(table);
    pe_env_free(env);
}

/* ---- the brush's poles ---- */

/* A viewer of a normal within 8 degrees of the brush. */
static void pole_view(unsigned *state, const double direction[3], double n[3], double o[3])
{
    double axis[3];

    pe_normalize(direction, axis);
    do
        random_view(state, 0.3, n, o);
    while (!(fabs(pe_dot(n, axis)) > cos(8 * M_PI / 180)));
}

/* About the brush's poles, where tangents turn fast, lookups are as good as a few angles more make them: without those
 * the error is three times the bound.  And a file keeps the angles. */
static void test_poles(void)
{
    enum { WIDTH = 128, HEIGHT = 64, VIEWS = 1500 };
    char path[] = "/tmp/prefenv-test-hemispheres-XXXXXX";
    const pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, 0.3, 0.1, NULL },
                                      .direction = { aslant[0], aslant[1], aslant[2] } };
    pe_env *env = make_env(WIDTH, HEIGHT, reference_room(WIDTH, HEIGHT));
    pe_maps *maps = bake(env, &options), *back = NULL;
    const pe_maps_info *info = pe_maps_get_info(maps);
    difference d = { 0, 0, 0 }, kept = { 0, 0, 0 };
    unsigned state = 8;

    close(mkstemp(path));
    need(pe_maps_write(maps, path, PE_PIXEL_FLOAT, NULL) == PE_OK && pe_maps_read(path, &back, NULL) == PE_OK, "%s",
         path);
    unlink(path);
    for (int k = 0; k < VIEWS; k++) {
        double n[3], o[3], got[3], again[3], expected[3];

        pole_view(&state, aslant, n, o);
        pe_exact(env, &options.surface, aslant, n, o, expected);
        sample_point(maps, NULL, NULL, n, o, got);
        sample_point(back, NULL, NULL, n, o, again);
        compare(got, expected, &d);
        compare(again, got, &kept);
    }
    ok(relative(&d) < 0.05 && info->images > info->normals,
       "%d normals, %d images: within 8 degrees of the brush, %.2f %%", info->normals, info->images,
       100 * relative(&d));
    ok(kept.worst < 1e-6 && pe_maps_get_info(back)->images == info->images, "a file keeps them: within %.1e",
       kept.worst);
    pe_maps_free(back);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- errors asked for ---- */

/* What is asked for is reached, with no more than it takes. */
static void test_error(void)
{
    enum { WIDTH = 128, HEIGHT = 64 };
    static const double wanted[] = { 0.006, 0.06 };
    pe_env *env = make_studio(WIDTH, HEIGHT);
    size_t texels[2];

    for (int k = 0; k < 2; k++) {
        const pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, 0.2, 0.2, NULL }, .error = wanted[k] };
        pe_maps *maps = bake(env, &options);
        const pe_maps_info *info = pe_maps_get_info(maps);

        texels[k] = (size_t)info->images * (size_t)info->width * (size_t)info->height;
        ok(info->lookup_error <= wanted[k] && info->error_wanted == wanted[k],
           "asked for %g %%: %.2g %% with %zu texels", 100 * wanted[k], 100 * info->lookup_error, texels[k]);
        pe_maps_free(maps);
    }
    ok(3 * texels[1] < texels[0], "ten times the error takes 1/%.1f of the texels",
       (double)texels[0] / (double)texels[1]);
    pe_env_free(env);
}

/* ---- files ---- */

/* Half floats have 11 bits, and where suns are, they are as they were. */
static void test_file(pe_pixel_type type, double bound)
{
    enum { WIDTH = 64, HEIGHT = 32 };
    char path[] = "/tmp/prefenv-test-hemispheres-XXXXXX";
    float *rgb = reference_noise(WIDTH, HEIGHT, 9);
    pe_bake_options options = { .surface.ndf = { PE_NDF_GGX, 0.4, 0.2, NULL },
                                .direction = { aslant[0], aslant[1], aslant[2] },
                                .normals = 12,
                                .angles = 5,
                                .width = 21,
                                .height = 24 };
    difference d = { 0, 0, 0 };
    unsigned state = 2;
    pe_env *env;
    pe_maps *maps, *back = NULL;
    const pe_maps_info *info;

    rgb[3 * (9 * WIDTH + 20)] = rgb[3 * (20 * WIDTH + 40) + 1] = 30000;
    env = make_env(WIDTH, HEIGHT, rgb);
    maps = bake(env, &options);
    close(mkstemp(path));
    need(pe_maps_write(maps, path, type, NULL) == PE_OK && pe_maps_read(path, &back, NULL) == PE_OK, "%s", path);
    unlink(path);
    for (int k = 0; k < 4000; k++) {
        double n[3], o[3], direction[3], got[3], expected[3];

        random_view(&state, 0, n, o);
        reference_random_direction(&state, direction);
        sample_point(maps, NULL, direction, n, o, expected);
        sample_point(back, NULL, direction, n, o, got);
        compare(got, expected, &d);
    }
    info = pe_maps_get_info(back);
    ok(d.worst < bound && info->suns == 2 && info->angles == 5, "%s file: lookups within %.1e, %d suns, %d angles",
       type == PE_PIXEL_HALF ? "half" : "float", d.worst, info->suns, info->angles);
    pe_maps_free(back);
    pe_maps_free(maps);
    pe_env_free(env);
}

int main(void)
{
    test_dark();
    test_suns_on_horizon();
    test_texels(PE_NDF_BECKMANN, 0.3, 0.3, 1);
    test_texels(PE_NDF_BECKMANN, 0.4, 0.2, 5);
    test_texels(PE_NDF_GGX, 0.2, 0.5, 1);
    test_texels(PE_NDF_PHONG, 0.3, 0.3, 4);
    test_sum_of_suns(PE_NDF_BECKMANN, 0.1, 0.1);
    test_sum_of_suns(PE_NDF_BECKMANN, 0.4, 0.2);
    test_sum_of_suns(PE_NDF_GGX, 0.2, 0.2);
    test_sum_of_suns(PE_NDF_PHONG, 0.3, 0.3);
    test_suns(PE_NDF_BECKMANN, 0.2, 0.2, 0.006, 0.002);
    test_suns(PE_NDF_BECKMANN, 0.4, 0.2, 0.006, 0.002);
    test_suns(PE_NDF_GGX, 0.2, 0.2, 0.015, 0.005);
    test_kernel(PE_WEIGHT_NDF, PE_NDF_BECKMANN, 0.3, 0.3, 0.002);
    test_kernel(PE_WEIGHT_NDF, PE_NDF_BECKMANN, 0.4, 0.2, 0.002);
    test_kernel(PE_WEIGHT_NDF, PE_NDF_BECKMANN, 0.3, 0.3, 0.0005);
    test_kernel(PE_WEIGHT_NDF, PE_NDF_GGX, 0.4, 0.4, 0.002);
    test_kernel(PE_WEIGHT_MICROFACET, PE_NDF_BECKMANN, 0.3, 0.3, 0.002);
    test_kernel(PE_WEIGHT_MICROFACET, PE_NDF_BECKMANN, 0.4, 0.2, 0.0005);
    test_kernel(PE_WEIGHT_MICROFACET, PE_NDF_GGX, 0.4, 0.4, 0.002);
    test_threads(PE_ACCURACY_EXACT);
    test_threads(PE_ACCURACY_FAST);
    test_furnaces();
    test_continuity(1);
    test_continuity(6);
    test_brush(0.3, 0.1, 12);
    test_brush_of_table();
    test_poles();
    test_error();
    test_file(PE_PIXEL_HALF, 1e-3);
    test_file(PE_PIXEL_FLOAT, 1e-6);
    return done_testing();
}
