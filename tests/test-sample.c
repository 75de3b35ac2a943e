/* test-sample.c - claims: a white furnace is 1 everywhere; light behind a surface never leaks into it; at a
 * representative normal a lookup is the exact answer; between them the modes come closer in the order the papers
 * state. */
#include "prefenv.h"
#include "reference.h"
#include "sample_point.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

static const double plus_y[3] = { 0, 1, 0 };
static const pe_sampling modes[] = { { PE_INTERPOLATION_NEAREST, 0, PE_HORIZON_IGNORED },
                                     { PE_INTERPOLATION_WEIGHTED, 10, PE_HORIZON_IGNORED },
                                     { PE_INTERPOLATION_WEIGHTED, 0, PE_HORIZON_IGNORED },
                                     { PE_INTERPOLATION_LINEAR, 0, PE_HORIZON_IGNORED },
                                     { PE_INTERPOLATION_DEFAULT, 0, PE_HORIZON_IGNORED } };
static const char *const mode_names[] = { "nearest", "weighted 10", "weighted 50", "linear", "default" };
#define MODES 5

static pe_env *make_env(int width, int height, float *rgb)
{
    pe_env *env;

    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK, "no memory");
    free(rgb);
    return env;
}

static pe_maps *bake_as(const pe_env *env, pe_method method, pe_accuracy accuracy, double alpha_x, double alpha_y,
                        int width, int height)
{
    pe_bake_options options = { .method = method,
                                .surface.ndf = { PE_NDF_BECKMANN, alpha_x, alpha_y, NULL },
                                .width = width,
                                .height = height,
                                .accuracy = accuracy };
    pe_maps *maps;
    pe_error error;

    need(pe_bake(env, &options, &maps, &error) == PE_OK, "%s", error.message);
    return maps;
}

static pe_maps *bake(const pe_env *env, pe_method method, double alpha_x, double alpha_y, int width, int height)
{
    return bake_as(env, method, PE_ACCURACY_EXACT, alpha_x, alpha_y, width, height);
}

/* A view of random normal, its cosine at least cos_min. */
static void random_view(unsigned *state, double cos_min, double n[3], double o[3])
{
    do {
        reference_random_direction(state, n);
        reference_random_direction(state, o);
    } while (!(pe_dot(n, o) > cos_min));
}

/* At n = n_k the other two corners of its triangle have the weight of a rounding error. */
#define LEAK_MAX 1e-15

/* ---- furnace ---- */

static void test_furnace(pe_method method, double alpha_x, double alpha_y, int width, int height)
{
    pe_env *env = make_env(64, 32, reference_constant(64, 32, 1));
    pe_maps *maps = bake(env, method, alpha_x, alpha_y, width, height);
    double worst = 0;
    unsigned state = 1;

    for (int k = 0; k < 20000; k++) {
        double n[3], o[3], rgb[3];

        random_view(&state, k % 2 ? 0 : -1, n, o);
        if (k % 5 == 0) /* grazing to within rounding */
            for (int c = 0; c < 3; c++)
                o[c] -= pe_dot(n, o) * n[c] * (1 - 1e-15);
        sample_point(maps, &modes[k % MODES], NULL, n, o, rgb);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fabs(rgb[c] - 1));
    }
    ok(worst < 1e-6, "white furnace, %s, alpha %g, %g, %d x %d: 1 within %.1e",
       method == PE_METHOD_BASELINE ? "baseline" : "representative", alpha_x, alpha_y, width, height, worst);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- the seam ---- */

/* White below the horizon of n_k and black above: a surface of normal n_k sees black, whatever the view and however the
 * maps are baked. */
static void test_half_white(int k, int side, pe_accuracy accuracy)
{
    int width = accuracy == PE_ACCURACY_FAST ? 512 : 64, height = width / 2;
    pe_bake_options one = { .method = PE_METHOD_REPRESENTATIVE,
                            .normals = 42,
                            .width = 2,
                            .height = 2,
                            .surface.ndf = { PE_NDF_BECKMANN, 1, 1, NULL } };
    double n[3], below[3], worst = 0;
    pe_env *env = make_env(2, 2, reference_constant(2, 2, 0));
    pe_maps *maps;
    unsigned state = 2;

    need(pe_bake(env, &one, &maps, NULL) == PE_OK, "bake");
    pe_maps_normal(maps, k, n);
    pe_scale(side ? -1 : 1, n, n);
    pe_scale(-1, n, below);
    pe_maps_free(maps);
    pe_env_free(env);
    env = make_env(width, height, reference_half_white(width, height, below));
    maps = bake_as(env, PE_METHOD_REPRESENTATIVE, accuracy, 0.1, 0.1, 64, 32);
    for (int view = 0; view < 2000; view++) {
        double ignored[3], o[3], rgb[3], exact[3] = { 0 };

        random_view(&state, -1, ignored, o);
        if (view % 2) /* within two texels of the horizon */
            for (int c = 0; c < 3; c++)
                o[c] -= (1 - 0.1 * reference_random(&state)) * pe_dot(n, o) * n[c];
        if (!(pe_dot(n, o) > 0))
            continue;
        sample_point(maps, &modes[0], NULL, n, o, rgb);
        worst = worst_of(worst, rgb[0]);
        sample_point(maps, &modes[3], NULL, n, o, rgb);
        worst = worst_of(worst, rgb[0]);
        if (accuracy == PE_ACCURACY_EXACT)
            pe_exact(env, &pe_maps_get_info(maps)->surface, plus_y, n, o, exact);
        worst = worst_of(worst, exact[0]);
    }
    ok(worst < LEAK_MAX, "half-white environment, %s: nothing leaks into normal %d%s (%.1e)",
       accuracy == PE_ACCURACY_FAST ? "fast" : "exact", k, side ? ", opposite" : "", worst);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* A texel that touches the equator of n_k from the given side: one of its neighbours lies on the other. */
static void texel_at_equator(const double n[3], int side, int width, int height, unsigned *state, int *x, int *y)
{
    for (int attempt = 0; attempt < 1000000; attempt++) {
        int step = attempt & 1 ? 1 : -1, across = attempt & 2;
        double w[3], neighbour[3], theta;

        *x = (int)(reference_random(state) * width);
        *y = 1 + (int)(reference_random(state) * (height - 2));
        reference_direction(width, height, *x, *y, w, &theta);
        reference_direction(width, height, across ? *x + step : *x, across ? *y : *y + step, neighbour, &theta);
        if ((side ? -1 : 1) * pe_dot(w, n) > 1e-6 && (side ? -1 : 1) * pe_dot(neighbour, n) < -1e-6)
            return;
    }
    need(0, "no texel at the equator");
}

/* One lit texel just above the equator of n_k must be seen by n_k alone, and just below by -n_k alone, even where a
 * lookup's four taps lie on both sides. */
static void test_lit_texel(int k, int side)
{
    const int width = 64, height = 32;
    double n[3], own[3], leak = 0, seen = 0;
    int x = 0, y = 0;
    unsigned state = 4u + (unsigned)k;
    pe_env *env = make_env(width, height, reference_constant(width, height, 0));
    pe_maps *maps = bake(env, PE_METHOD_REPRESENTATIVE, 0.1, 0.1, width, height);

    pe_maps_normal(maps, k, n);
    pe_scale(side ? -1 : 1, n, own);
    texel_at_equator(n, side, width, height, &state, &x, &y);
    pe_maps_free(maps);
    pe_env_free(env);
    env = make_env(width, height, reference_lit_texel(width, height, x, y, 1000));
    maps = bake(env, PE_METHOD_REPRESENTATIVE, 0.1, 0.1, width, height);
    for (int view = 0; view < 4000; view++) {
        double r[3], o[3], rgb[3], facing[3], theta;

        /* r around the lit texel, on both sides of the equator */
        reference_direction(width, height, x, y, r, &theta);
        for (int c = 0; c < 3; c++)
            r[c] += 0.3 * (reference_random(&state) - 0.5);
        pe_normalize(r, r);
        pe_scale(pe_dot(r, n) > 0 ? 1 : -1, n, facing);
        pe_reflect(r, facing, o);
        sample_point(maps, &modes[view % 2 ? 0 : 3], NULL, facing, o, rgb);
        if (pe_dot(facing, own) > 0)
            seen = worst_of(seen, rgb[0]);
        else
            leak = worst_of(leak, rgb[0]);
    }
    ok(leak < 1000 * LEAK_MAX && seen > 1,
       "a lit texel %s the equator of normal %d: own side sees %.3g, the other %.3g", side ? "below" : "above", k, seen,
       leak);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* ---- against the truth ---- */

/* Relative RMS of lookups against the exact answer, over views of a sphere with n.o > 0.15. */
static double error_of(const pe_env *env, const pe_maps *maps, const pe_sampling *mode)
{
    double error2 = 0, norm2 = 0;
    unsigned state = 21;

    for (int k = 0; k < 1500; k++) {
        double n[3], o[3], got[3], exact[3];

        random_view(&state, 0.15, n, o);
        sample_point(maps, mode, NULL, n, o, got);
        pe_exact(env, &pe_maps_get_info(maps)->surface, plus_y, n, o, exact);
        for (int c = 0; c < 3; c++) {
            error2 += (got[c] - exact[c]) * (got[c] - exact[c]);
            norm2 += exact[c] * exact[c];
        }
    }
    return sqrt(error2 / norm2);
}

static void test_at_normals(const pe_env *env, const pe_maps *maps)
{
    double error2 = 0, norm2 = 0;
    unsigned state = 8;

    for (int k = 0; k < 1500; k++) {
        double n[3], ignored[3], o[3], got[3], exact[3];

        pe_maps_normal(maps, k % pe_maps_get_info(maps)->images, n);
        do
            random_view(&state, -1, ignored, o);
        while (!(fabs(pe_dot(n, o)) > 0.15));
        sample_point(maps, &modes[k % 2 ? 0 : 3], NULL, n, o, got);
        pe_exact(env, &pe_maps_get_info(maps)->surface, plus_y, n, o, exact);
        for (int c = 0; c < 3; c++) {
            error2 += (got[c] - exact[c]) * (got[c] - exact[c]);
            norm2 += exact[c] * exact[c];
        }
    }
    ok(sqrt(error2 / norm2) < 0.005, "at representative normals a lookup is exact but for bilinear: %.4f",
       sqrt(error2 / norm2));
}

static void test_order(void)
{
    pe_env *env = make_env(128, 64, reference_room(128, 64));
    pe_maps *maps = bake(env, PE_METHOD_REPRESENTATIVE, 0.15, 0.15, 200, 100);
    pe_maps *baseline = bake(env, PE_METHOD_BASELINE, 0.15, 0.15, 200, 100);
    double errors[MODES], error_baseline = error_of(env, baseline, NULL);

    test_at_normals(env, maps);
    for (int k = 0; k < MODES; k++) {
        errors[k] = error_of(env, maps, &modes[k]);
        note("%s: relative error %.4f", mode_names[k], errors[k]);
    }
    note("baseline: relative error %.4f", error_baseline);
    ok(error_baseline > errors[0] && errors[0] > errors[2] && errors[2] > errors[3],
       "errors: baseline > nearest > weighted a = 50 > linear");
    ok(errors[3] == errors[4], "linear is the default");
    ok(errors[3] < 0.1, "linear: %.4f", errors[3]);
    pe_maps_free(baseline);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* Walking over the sphere in small steps with the same mirror direction, linear takes no jumps. */
static void test_continuity(void)
{
    pe_env *env = make_env(64, 32, reference_noise(64, 32, 3));
    pe_maps *maps = bake(env, PE_METHOD_REPRESENTATIVE, 0.3, 0.3, 64, 32);
    const int steps = 20000;
    double largest = 0, before[3] = { 0 };

    for (int k = 0; k <= steps; k++) {
        double angle = 2 * M_PI * k / steps, tilt = 0.5 * sin(3 * angle), rgb[3];
        double n[3] = { cos(angle) * cos(tilt), sin(angle) * cos(tilt), sin(tilt) };

        sample_point(maps, NULL, NULL, n, n, rgb);
        for (int c = 0; c < 3 && k; c++)
            largest = worst_of(largest, fabs(rgb[c] - before[c]));
        memcpy(before, rgb, sizeof before);
    }
    ok(largest < 0.002, "linear: no step of %d around the sphere exceeds %.2e", steps, largest);
    pe_maps_free(maps);
    pe_env_free(env);
}

static void test_no_direction(void)
{
    static const double nowhere[3] = { NAN, 1, 0 }, zero[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    pe_env *env = make_env(16, 8, reference_constant(16, 8, 1));
    pe_maps *maps = bake(env, PE_METHOD_REPRESENTATIVE, 0.3, 0.3, 16, 8);
    double rgb[3];
    int finite = 1;

    for (int k = 0; k < MODES; k++) {
        sample_point(maps, &modes[k], NULL, nowhere, up, rgb);
        finite &= isfinite(rgb[0]);
        sample_point(maps, &modes[k], NULL, up, zero, rgb);
        finite &= isfinite(rgb[0]);
        sample_point(maps, &modes[k], NULL, zero, nowhere, rgb);
        finite &= isfinite(rgb[0]);
    }
    ok(finite, "a normal or viewer that is no direction gives a finite colour");
    pe_maps_free(maps);
    pe_env_free(env);
}

int main(void)
{
    test_furnace(PE_METHOD_REPRESENTATIVE, 0.1, 0.1, 100, 50);
    test_furnace(PE_METHOD_REPRESENTATIVE, 0.1, 0.03, 33, 17);
    test_furnace(PE_METHOD_REPRESENTATIVE, 0.6, 0.6, 8, 4);
    test_furnace(PE_METHOD_REPRESENTATIVE, 0.001, 0.001, 40, 20);
    test_furnace(PE_METHOD_BASELINE, 0.1, 0.03, 33, 17);
    for (int k = 0; k < 21; k += 4)
        for (int side = 0; side < 2; side++) {
            test_half_white(k, side, PE_ACCURACY_EXACT);
            test_lit_texel(k, side);
        }
    test_half_white(0, 0, PE_ACCURACY_FAST);
    test_half_white(12, 1, PE_ACCURACY_FAST);
    test_half_white(16, 0, PE_ACCURACY_FAST);
    test_order();
    test_continuity();
    test_no_direction();
    return done_testing();
}
