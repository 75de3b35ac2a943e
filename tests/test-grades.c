/* test-grades.c - claims: maps of grades show what pe_exact does for any normal, viewer and roughness in their range,
 * isotropic or not, of every distribution with a formula, by either weight, with suns; at a grade's own roughness they
 * are the maps of that roughness alone; a file keeps them. */
#include "parallel.h"
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define WIDTH 96
#define HEIGHT 48
#define VIEWS 600
#define COSINE_MIN 0.15

static const double brush[3] = { 1, 2, -0.5 };

typedef struct view {
    pe_point point;
    double exact[3];
} view;

typedef struct truth {
    const pe_env *env;
    const pe_maps *maps;
    view *views;
} truth;

static void find_truth(size_t k, void *data)
{
    const truth *t = data;
    view *v = &t->views[k];
    pe_surface surface = pe_maps_get_info(t->maps)->surface;
    double ratio = surface.ndf.alpha_y / surface.ndf.alpha_x;

    surface.ndf.alpha_x = v->point.roughness;
    surface.ndf.alpha_y = ratio * v->point.roughness;
    pe_exact(t->env, &surface, v->point.direction ? v->point.direction : brush, v->point.n, v->point.o, v->exact);
}

/* Normals and viewers from everywhere, roughness by its logarithm. */
static void make_views(const pe_env *env, const pe_maps *maps, view *views)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    truth t = { env, maps, views };
    unsigned state = 5;

    for (int k = 0; k < VIEWS; k++) {
        pe_point *p = &views[k].point;

        *p = (pe_point){ .roughness = info->surface.ndf.alpha_x *
                                      pow(info->alpha_max / info->surface.ndf.alpha_x, reference_random(&state)) };
        reference_random_direction(&state, p->n);
        do
            reference_random_direction(&state, p->o);
        while (!(pe_dot(p->n, p->o) > COSINE_MIN));
    }
    pe_parallel_for(VIEWS, 0, find_truth, &t, NULL);
}

/* Relative L2 error. */
static double measure(const pe_maps *maps, const view *views)
{
    double error2 = 0, norm2 = 0;

    for (int k = 0; k < VIEWS; k++) {
        double rgb[3];

        pe_sample(maps, NULL, &views[k].point, rgb);
        for (int c = 0; c < 3; c++) {
            error2 += (rgb[c] - views[k].exact[c]) * (rgb[c] - views[k].exact[c]);
            norm2 += views[k].exact[c] * views[k].exact[c];
        }
    }
    return sqrt(error2 / norm2);
}

static pe_env *make_env(float *rgb)
{
    pe_env *env;

    need(pe_env_create(WIDTH, HEIGHT, rgb, &env, NULL) == PE_OK, "no environment");
    free(rgb);
    return env;
}

/* Once: pe_bake would go on until it has the error that is asked for. */
static pe_maps *bake(const pe_env *env, const pe_bake_options *options)
{
    pe_baker *baker;
    pe_maps *maps;
    pe_error error;

    need(pe_baker_make(options, WIDTH, HEIGHT, &baker, &error) == PE_OK &&
             pe_baker_bake(baker, env, NULL, &maps, &error) == PE_OK,
         "%s", error.message);
    pe_baker_free(baker);
    return maps;
}

/* Options of `kind` from alpha_x 0.1 to 0.8, alpha_y a part of that. */
static pe_bake_options options_of(pe_ndf_kind kind, double alpha_y)
{
    return (pe_bake_options){ .method = PE_METHOD_GRADES,
                              .accuracy = PE_ACCURACY_FAST,
                              .error = 0.02,
                              .surface.ndf = { kind, 0.1, alpha_y, NULL },
                              .alpha_max = 0.8,
                              .direction = { brush[0], brush[1], brush[2] } };
}

/* ---- against the truth ---- */

static void test_twin(const char *name, pe_env *env, const pe_bake_options *options, double bound)
{
    static view views[VIEWS];
    pe_maps *maps = bake(env, options);
    const pe_maps_info *info = pe_maps_get_info(maps);
    double off;

    make_views(env, maps, views);
    off = measure(maps, views);
    ok(off < bound, "%s: %d grades of %d maps, %d suns, %.3f %% off, at most %g", name, info->grades, info->images,
       info->suns, 100 * off, 100 * bound);
    ok(info->lookup_error < 3 * off + 0.001 && info->lookup_error > off / 3 - 0.001, "... and they say %.3f %%",
       100 * info->lookup_error);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* A lamp of one texel in a room: of what is seen where it is, far more than of the rest. */
static float *lit_room(void)
{
    float *rgb = reference_room(WIDTH, HEIGHT);

    for (int c = 0; c < 3; c++)
        rgb[3 * (15 * WIDTH + 30) + c] = 30000;
    return rgb;
}

static void test_twins(void)
{
    pe_bake_options options = options_of(PE_NDF_BECKMANN, 0.1);

    test_twin("beckmann", make_env(reference_room(WIDTH, HEIGHT)), &options, 0.04);
    test_twin("beckmann, a sun", make_env(lit_room()), &options, 0.01);
    options = options_of(PE_NDF_GGX, 0.1);
    test_twin("ggx", make_env(reference_room(WIDTH, HEIGHT)), &options, 0.025);
    options = options_of(PE_NDF_PHONG, 0.1);
    test_twin("phong", make_env(reference_room(WIDTH, HEIGHT)), &options, 0.04);
    options = options_of(PE_NDF_BECKMANN, 0.1 / 3.3);
    test_twin("beckmann, 3.3:1", make_env(reference_room(WIDTH, HEIGHT)), &options, 0.045);
    options = options_of(PE_NDF_GGX, 0.1 / 3.3);
    test_twin("ggx, 3.3:1, a sun", make_env(lit_room()), &options, 0.03);
    options = options_of(PE_NDF_GGX, 0.1);
    options.surface.weight = PE_WEIGHT_MICROFACET;
    pe_material("copper", options.surface.eta, options.surface.k);
    test_twin("copper", make_env(lit_room()), &options, 0.01);
}

/* Brushes that point anywhere: a file of four angles at least. */
static void test_angles(void)
{
    static view views[VIEWS];
    static double directions[VIEWS][3];
    pe_env *env = make_env(reference_room(WIDTH, HEIGHT));
    pe_bake_options options = options_of(PE_NDF_BECKMANN, 0.05);
    pe_maps *maps;
    truth t;
    unsigned state = 8;
    double off;

    options.angles = 8;
    maps = bake(env, &options);
    make_views(env, maps, views);
    for (int k = 0; k < VIEWS; k++) {
        reference_random_direction(&state, directions[k]);
        views[k].point.direction = directions[k];
    }
    t = (truth){ env, maps, views };
    pe_parallel_for(VIEWS, 0, find_truth, &t, NULL);
    off = measure(maps, views);
    ok(off < 0.045, "8 brush angles: %.3f %% off for any", 100 * off);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- what they are made of ---- */

static pe_bake_options small_options(void)
{
    pe_bake_options options = options_of(PE_NDF_GGX, 0.07);

    options.normals = 42;
    options.width = 16;
    options.height = 18;
    options.layers = 5;
    return options;
}

static double largest_difference(const pe_maps *a, const pe_maps *b, const view *views)
{
    double worst = 0;

    for (int k = 0; k < VIEWS; k++) {
        double x[3], y[3];

        pe_sample(a, NULL, &views[k].point, x);
        pe_sample(b, NULL, &views[k].point, y);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fabs(x[c] - y[c]) / (fabs(y[c]) + 1e-3));
    }
    return worst;
}

static void set_roughness(view *views, double roughness)
{
    for (int k = 0; k < VIEWS; k++)
        views[k].point.roughness = roughness;
}

/* The grades of each roughness, and what lies out of their range. */
static void test_grades(void)
{
    static view views[VIEWS];
    pe_env *env = make_env(reference_room(WIDTH, HEIGHT));
    pe_bake_options options = small_options();
    pe_maps *maps = bake(env, &options);
    const pe_maps_info *info = pe_maps_get_info(maps);
    double worst = 0, ratio = 0;

    make_views(env, maps, views);
    options.method = PE_METHOD_HEMISPHERES;
    for (int k = 0; k < info->grades; k++) {
        const pe_maps_info *its = pe_maps_get_info(pe_maps_grade(maps, k));
        pe_maps *alone;

        options.surface = its->surface;
        alone = bake(env, &options);
        set_roughness(views, its->surface.ndf.alpha_x);
        worst = worst_of(worst, largest_difference(maps, alone, views));
        ratio = worst_of(ratio, fabs(its->surface.ndf.alpha_y / its->surface.ndf.alpha_x - 0.7));
        pe_maps_free(alone);
    }
    ok(info->grades == 5 && info->images >= 5 * 42 && ratio < 1e-12 && worst < 1e-4,
       "at their own roughness five grades are the maps of it alone, within %g", worst);
    set_roughness(views, 7);
    worst = largest_difference(maps, pe_maps_grade(maps, 4), views);
    set_roughness(views, NAN);
    worst = worst_of(worst, largest_difference(maps, pe_maps_grade(maps, 0), views));
    ok(worst < 1e-5, "beyond the roughest as the roughest, and what is no number as the smoothest");
    pe_maps_free(maps);
    pe_env_free(env);
}

/* Sizes that are given keep an error that no number of grades takes off. */
static void test_count(void)
{
    static const struct {
        double alpha_max, aim;
        int side, most;
    } rows[] = { { 0.12, 0, 12, 4 }, { 0.2, 0.0005, 16, 4 }, { 0.4, 0, 12, 6 } };

    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        pe_bake_options options = options_of(PE_NDF_BECKMANN, 0.1);
        pe_baker *baker;
        pe_error error;

        options.error = rows[k].aim;
        options.alpha_max = rows[k].alpha_max;
        options.normals = 12;
        options.width = options.height = rows[k].side;
        need(pe_baker_make(&options, WIDTH, HEIGHT, &baker, &error) == PE_OK, "%s", error.message);
        ok(pe_baker_get_info(baker)->grades <= rows[k].most, "maps of %d texels from alpha 0.1 to %g: %d grades",
           rows[k].side * rows[k].side, rows[k].alpha_max, pe_baker_get_info(baker)->grades);
        pe_baker_free(baker);
    }
}

static void test_white(void)
{
    static view views[VIEWS];
    pe_env *env = make_env(reference_constant(WIDTH, HEIGHT, 1));
    pe_bake_options options = small_options();
    pe_maps *maps = bake(env, &options);
    double worst = 0;

    make_views(env, maps, views);
    for (int k = 0; k < VIEWS; k++) {
        double rgb[3];

        pe_sample(maps, NULL, &views[k].point, rgb);
        worst = worst_of(worst, fabs(rgb[1] - 1));
    }
    ok(worst < 1e-5, "white surroundings stay white, within %g", worst);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- files, sequences ---- */

static void test_file(pe_maps *maps, const char *path)
{
    static view views[VIEWS];
    const pe_maps_info *info = pe_maps_get_info(maps), *read;
    pe_env *env = make_env(reference_room(WIDTH, HEIGHT));
    pe_maps *again = NULL;
    pe_error error;

    make_views(env, maps, views);
    need(pe_maps_write(maps, path, PE_PIXEL_FLOAT, &error) == PE_OK && pe_maps_read(path, &again, &error) == PE_OK,
         "%s", error.message);
    read = pe_maps_get_info(again);
    ok(read->method == PE_METHOD_GRADES && read->grades == info->grades && read->alpha_max == info->alpha_max &&
           read->images == info->images && read->suns == info->suns && info->suns > 0 &&
           read->lookup_error == info->lookup_error &&
           pe_maps_get_info(pe_maps_grade(again, 2))->lookup_error ==
               pe_maps_get_info(pe_maps_grade(maps, 2))->lookup_error,
       "a file keeps what they say of themselves, %d suns", info->suns);
    ok(largest_difference(again, maps, views) == 0, "... and a file of floats every bit of them");
    pe_maps_free(again);
    pe_env_free(env);
}

/* A sequence is baked one by one, to the same bits. */
static void test_frames(const pe_env *env, const pe_bake_options *options, const pe_maps *alone)
{
    static view views[VIEWS];
    const pe_env *envs[2] = { env, env };
    pe_maps *maps[2] = { NULL, NULL };
    pe_baker *baker;
    pe_error error;

    make_views(env, alone, views);
    need(pe_baker_make(options, WIDTH, HEIGHT, &baker, &error) == PE_OK &&
             pe_baker_bake_frames(baker, envs, 2, NULL, maps, &error) == PE_OK,
         "%s", error.message);
    ok(largest_difference(maps[0], alone, views) == 0 && largest_difference(maps[1], alone, views) == 0 &&
           pe_maps_get_info(maps[1])->lookup_error == pe_maps_get_info(alone)->lookup_error,
       "frames of a sequence are what each is alone, any number of threads");
    for (int k = 0; k < 2; k++)
        pe_maps_free(maps[k]);
    pe_baker_free(baker);
}

static void test_kept(void)
{
    char path[] = "/tmp/prefenv-test-grades-XXXXXX";
    pe_env *env = make_env(lit_room());
    pe_bake_options options = small_options();
    pe_maps *maps = bake(env, &options);

    close(mkstemp(path));
    test_file(maps, path);
    unlink(path);
    options.threads = 1;
    test_frames(env, &options, maps);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- no ---- */

static int cancel(double fraction, void *data)
{
    (void)data;
    return fraction > 0.3;
}

static void test_refusals(void)
{
    const struct {
        pe_bake_options options;
        pe_status status;
        const char *words;
    } rows[] = {
        { { .method = PE_METHOD_GRADES, .layers = 3 }, PE_ERROR_ARGUMENT, "grades 3 are out of range" },
        { { .method = PE_METHOD_GRADES, .alpha_max = 0.01 }, PE_ERROR_ARGUMENT, "alpha 0.02 to 0.01 is no range" },
        { { .method = PE_METHOD_GRADES, .alpha_max = 0.021 },
          PE_ERROR_ARGUMENT,
          "at least 1.1 times the smoothest, and" },
        { { .method = PE_METHOD_GRADES, .alpha_max = 3 }, PE_ERROR_ARGUMENT, "alpha 0.02 to 3 is no range" },
        { { .method = PE_METHOD_GRADES, .alpha_max = NAN }, PE_ERROR_ARGUMENT, "is no range" },
        { { .method = PE_METHOD_GRADES, .surface.ndf = { PE_NDF_GGX, 0.1, 1, NULL } },
          PE_ERROR_ARGUMENT,
          "alpha 1, 10 is out of range" },
        { { .method = PE_METHOD_GRADES, .normals = 43 }, PE_ERROR_ARGUMENT, "normals 43 is not" },
        { { .method = PE_METHOD_GRADES, .angles = 3 }, PE_ERROR_ARGUMENT, "angles 3 is out of range" },
        { { .method = PE_METHOD_GRADES, .progress = cancel }, PE_ERROR_CANCELLED, "cancelled" },
    };
    pe_env *env = make_env(reference_constant(WIDTH, HEIGHT, 1));

    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        pe_error error = { PE_OK, "" };
        pe_maps *maps = NULL;

        ok(pe_bake(env, &rows[k].options, &maps, &error) == rows[k].status && strstr(error.message, rows[k].words),
           "refused: %s", error.message);
    }
    pe_env_free(env);
}

int main(void)
{
    test_twins();
    test_angles();
    test_grades();
    test_count();
    test_white();
    test_kept();
    test_refusals();
    return done_testing();
}
