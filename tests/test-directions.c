/* test-directions.c - claims: directions drawn for a viewer reflect what pe_exact says, many of them at a point or one
 * at each of many points, for every distribution and weight, from straight above to grazing; visible normals make all
 * directions of Eq. 4 count alike; each stands for its solid angle; whatever is asked, directions are unit and shares
 * are numbers. */
#include "ndf.h"
#include "prefenv.h"
#include "reference.h"
#include "surface.h"
#include "tap.h"
#include "vector.h"

#include <stdbool.h>

static const char *const kinds[] = { "beckmann", "ggx", "phong", "table" };
static const double brush[3] = { 0.3, 1, -0.2 }, n[3] = { 0.48, 0.6, 0.64 };

static pe_env *make_env(int width, int height)
{
    float *rgb = reference_gradient(width, height);
    pe_env *env;
    pe_error error;

    need(pe_env_create(width, height, rgb, &env, &error) == PE_OK, "%s", error.message);
    free(rgb);
    return env;
}

/* Two ridges, so that it is neither a Beckmann nor symmetric. */
static pe_ndf_table *make_table(void)
{
    enum { CELLS = 64 };
    static const double range[2] = { -1.2, 1.2 };
    static float density[CELLS * CELLS];
    pe_ndf_table *table;

    for (int k = 0; k < CELLS * CELLS; k++) {
        int row = k / CELLS;
        double p = 2.4 * (k % CELLS + 0.5) / CELLS - 1.2, q = 2.4 * (row + 0.5) / CELLS - 1.2;

        density[k] =
            (float)(2 * exp(-30 * (p * p + (q - 0.2) * (q - 0.2))) + exp(-20 * (p * p + (q + 0.4) * (q + 0.4))));
    }
    need(pe_ndf_table_create(CELLS, CELLS, range, range, density, &table, NULL) == PE_OK, "no table");
    return table;
}

static void viewer_at(double theta, double phi, double o[3])
{
    double local[3] = { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
    pe_frame frame;

    pe_frame_make(n, brush, &frame);
    pe_frame_direction(&frame, local, o);
}

/* `count` directions at one point. */
static void reflect_many(const pe_env *env, const pe_surface *surface, const double o[3], int count, double rgb[3])
{
    static const double seed[3] = { 1, 2, 3 };
    double sums[3] = { 0 }, total = 0;
    pe_directions d;

    pe_directions_begin(surface, brush, n, o, seed, &d);
    for (int k = 0; k < count; k++) {
        double w[3], share[3], light[3];

        total += pe_directions_draw(&d, k, count, w, share);
        pe_env_lookup(env, w, light);
        for (int c = 0; c < 3; c++)
            sums[c] += share[c] * light[c];
    }
    pe_scale(1 / total, sums, rgb);
}

/* One direction at each of `count` points: mean, and its standard error. */
static void reflect_one(const pe_env *env, const pe_surface *surface, const double o[3], int count, double rgb[3],
                        double error[3])
{
    double sums[3] = { 0 }, squares[3] = { 0 };

    for (int k = 0; k < count; k++) {
        double w[3], share[3], light[3], seed[3] = { 0.01 * k, 1 - 0.02 * k, 5 };
        pe_directions d;

        pe_directions_begin(surface, brush, n, o, seed, &d);
        pe_directions_one(&d, w, share);
        pe_env_lookup(env, w, light);
        for (int c = 0; c < 3; c++) {
            double value = share[c] * light[c];

            sums[c] += value;
            squares[c] += value * value;
        }
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = sums[c] / count;
        error[c] = sqrt(fmax(squares[c] / count - rgb[c] * rgb[c], 0) / count);
    }
}

static void test_surface(const pe_env *env, const pe_surface *surface)
{
    static const double thetas[] = { 0, 0.4, 0.9, 1.3, 1.5 };
    bool nearly = surface->weight == PE_WEIGHT_NDF && surface->ndf.kind >= PE_NDF_PHONG;
    double worst = 0, furthest = 0, tolerance = nearly ? 0.01 : 0.001;
    const char *what = surface->weight == PE_WEIGHT_NDF ? "Eq. 4" : "microfacets";

    for (int k = 0; k < 5; k++) {
        double o[3], exact[3], many[3], one[3], error[3];

        viewer_at(thetas[k], 0.7 + 1.3 * k, o);
        pe_exact(env, surface, brush, n, o, exact);
        reflect_many(env, surface, o, 20000, many);
        reflect_one(env, surface, o, 4000, one, error);
        for (int c = 0; c < 3; c++) {
            worst = worst_of(worst, fabs(many[c] / exact[c] - 1));
            furthest = worst_of(furthest, worst_of(fabs(one[c] - exact[c]) - tolerance * exact[c], 0) / error[c]);
        }
    }
    ok(worst < 4e-3, "%s %g, %g, %s: 20000 directions within %.1e of exact", kinds[surface->ndf.kind],
       surface->ndf.alpha_x, surface->ndf.alpha_y, what, worst);
    ok(furthest < 4, "%s %g, %g, %s: 4000 points of one direction within %.1f standard errors, beyond %g",
       kinds[surface->ndf.kind], surface->ndf.alpha_x, surface->ndf.alpha_y, what, furthest, tolerance);
}

/* What directions in a cap about the mirrored one stand for, 1 / density, adds up to its solid angle. */
static void test_density(const pe_surface *surface)
{
    enum { COUNT = 20000 };
    static const double seed[3] = { 4, 1, 7 };
    double furthest = 0, radius = surface->ndf.table ? 0.3 : fmin(surface->ndf.alpha_y, 0.3);

    for (int k = 0; k < 4; k++) {
        double o[3], mirrored[3], sum = 0, squares = 0, cap = 2 * M_PI * (1 - cos(radius)), mean, error;
        pe_directions d;

        viewer_at(0.4 * k, 0.7 + 1.3 * k, o);
        pe_reflect(o, n, mirrored);
        pe_directions_begin(surface, brush, n, o, seed, &d);
        for (int i = 0; i < COUNT; i++) {
            double w[3], share[3], sr;

            pe_directions_draw(&d, i, COUNT, w, share);
            sr = pe_dot(w, mirrored) > cos(radius) ? 1 / pe_directions_density(&d, w) : 0;
            sum += sr;
            squares += sr * sr;
        }
        mean = sum / COUNT;
        error = sqrt((squares / COUNT - mean * mean) / COUNT);
        furthest = worst_of(furthest, worst_of(fabs(mean - cap) - 0.005 * cap, 0) / error);
    }
    ok(furthest < 3, "%s %g, %g: directions stand for their solid angle, within %.1f standard errors, beyond half a %%",
       kinds[surface->ndf.kind], surface->ndf.alpha_x, surface->ndf.alpha_y, furthest);
}

enum { SIDE = 8, DRAWS = 40000, FINE = 40 };

/* How often a half vector of DRAWS should fall into the square (x, y) of SIDE * SIDE over slopes of +-2 alpha. */
static double expected_in(const pe_ndf *ndf, const double o[3], int x, int y)
{
    double cell = 16 * ndf->alpha_x * ndf->alpha_y / SIDE / SIDE / FINE / FINE, sum = 0;

    for (int j = 0; j < FINE; j++)
        for (int i = 0; i < FINE; i++) {
            double p = ((x + (i + 0.5) / FINE) * 2 / SIDE - 1) * 2 * ndf->alpha_x;
            double q = ((y + (j + 0.5) / FINE) * 2 / SIDE - 1) * 2 * ndf->alpha_y;

            sum += pe_ndf_slope_density(ndf, p, q) * fmax(o[0] * p + o[1] * q + o[2], 0) * cell;
        }
    return DRAWS * sum / (o[2] * (1 + pe_ndf_lambda(ndf, o)));
}

/* Half vectors fall into squares of slopes as often as the density says. */
static void test_visible(pe_ndf_kind kind, double alpha_x, double alpha_y, double theta)
{
    pe_ndf ndf = { kind, alpha_x, alpha_y, NULL };
    double o[3] = { sin(theta) * 0.6, sin(theta) * 0.8, cos(theta) }, chi = 0;
    int found[SIDE][SIDE] = { { 0 } }, cells = 0;
    unsigned state = 5;

    for (int k = 0; k < DRAWS; k++) {
        double h[3], u1 = reference_random(&state), u2 = reference_random(&state), x, y;

        pe_ndf_sample_visible(&ndf, o, u1, u2, h);
        x = (h[0] / h[2] / alpha_x / 2 + 1) * SIDE / 2;
        y = (h[1] / h[2] / alpha_y / 2 + 1) * SIDE / 2;
        if (x >= 0 && y >= 0 && x < SIDE && y < SIDE)
            found[(int)y][(int)x]++;
    }
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            double expected = expected_in(&ndf, o, x, y);

            if (expected < 8)
                continue;
            cells++;
            chi += (found[y][x] - expected) * (found[y][x] - expected) / expected;
        }
    ok(chi < cells + 4 * sqrt(2.0 * cells),
       "%s %g, %g from %g: visible normals as often as they should be, chi^2 %.0f of %d", kinds[kind], alpha_x, alpha_y,
       theta, chi, cells);
}

/* Beckmann's slopes along the viewer's direction are the inverse of their distribution function. */
static void test_inverse(void)
{
    static const double shares[] = { 1e-9, 1e-4, 0.01, 0.2, 0.5, 0.8, 0.99, 1 - 1e-6 };
    pe_ndf ndf = { PE_NDF_BECKMANN, 1, 1, NULL };
    double worst = 0;

    for (int degrees = 0; degrees < 90; degrees++)
        for (int k = 0; k < 8; k++) {
            double s = sin(degrees * M_PI / 180), c = cos(degrees * M_PI / 180), o[3] = { s, 0, c }, h[3];
            double least = c < 6 * s ? -c / s : -6, gauss = exp(-least * least), x, below, all;

            pe_ndf_sample_visible(&ndf, o, shares[k], 0.5, h);
            x = h[0] / h[2];
            below = c / 2 * (erf(x) - erf(least)) + s / (2 * sqrt(M_PI)) * (gauss - exp(-x * x));
            all = c / 2 * erfc(least) + s / (2 * sqrt(M_PI)) * gauss;
            worst = worst_of(worst, fabs(below / all - shares[k]));
        }
    ok(worst < 1e-7, "visible slopes of Beckmann's are inverted but for %.1e", worst);
}

/* Any viewer, any width: directions are unit, shares numbers, and those of Eq. 4 by visible normals 1 or nothing. */
static void test_everything(void)
{
    static const double alphas[] = { PE_ALPHA_MIN, 0.1, PE_ALPHA_MAX };
    static const double zero[3] = { 0 };
    int wrong = 0;

    for (int trial = 0; trial < 2 * 2 * 9 * 6; trial++) {
        pe_surface surface = { .ndf = { trial % 2 ? PE_NDF_GGX : PE_NDF_BECKMANN, alphas[trial / 4 % 3],
                                        alphas[trial / 12 % 3], NULL },
                               .weight = trial / 2 % 2 ? PE_WEIGHT_MICROFACET : PE_WEIGHT_NDF };
        double o[3], w[3], share[3];
        pe_directions d;

        viewer_at(trial / 36 % 6 * 0.31415, trial, o);
        pe_directions_begin(&surface, zero, n, o, zero, &d);
        for (int k = 0; k < 100; k++) {
            double counts = pe_directions_draw(&d, k, 100, w, share);

            wrong += !(fabs(pe_dot(w, w) - 1) < 1e-9) || !(counts == 0 || counts == 1);
            wrong += !(share[0] >= 0 && share[0] <= 1 + 1e-9 && share[0] == share[2]);
            wrong += share[0] > 0 && !(pe_dot(w, n) > 0);
            wrong += surface.weight == PE_WEIGHT_NDF && share[0] != counts;
        }
        pe_directions_one(&d, w, share);
        wrong += !(fabs(pe_dot(w, w) - 1) < 1e-9) || !(share[0] >= 0 && share[0] <= 1 + 1e-9);
    }
    ok(wrong == 0, "from above to the horizon, alpha from 0.001 to 2: %d directions or shares are wrong", wrong);
}

int main(void)
{
    static const double alphas[][2] = { { 0.1, 0.1 }, { 0.4, 0.15 }, { 0.9, 0.9 } };
    pe_env *env = make_env(1024, 512);
    pe_ndf_table *table = make_table();

    for (int k = 0; k < 3; k++)
        for (int kind = PE_NDF_BECKMANN; kind <= PE_NDF_PHONG; kind++) {
            pe_surface surface = { .ndf = { (pe_ndf_kind)kind, alphas[k][0], alphas[k][1], NULL } };

            test_surface(env, &surface);
            test_density(&surface);
            surface.weight = PE_WEIGHT_MICROFACET;
            need(pe_material("copper", surface.eta, surface.k), "no copper");
            if (kind != PE_NDF_PHONG)
                test_surface(env, &surface);
        }
    for (int weight = PE_WEIGHT_NDF; weight <= PE_WEIGHT_MICROFACET; weight++) {
        pe_surface surface = { .ndf = { .kind = PE_NDF_TABLE, .table = table }, .weight = (pe_weight)weight };

        test_surface(env, &surface);
        test_density(&surface);
    }
    for (int k = 0; k < 8; k++)
        test_visible(k % 2 ? PE_NDF_GGX : PE_NDF_BECKMANN, 0.3, k / 2 % 2 ? 0.3 : 0.8, k / 4 ? 1.45 : 0.8);
    test_inverse();
    test_everything();
    pe_ndf_table_free(table);
    pe_env_free(env);
    return done_testing();
}
