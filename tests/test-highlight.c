/* test-highlight.c - claims: a highlight is what pe_exact (of Phong's lobe pe_phong) says of an environment that is
 * black but for one texel, for every distribution and weight, from straight above to grazing; light from everywhere
 * adds up to the white of Eq. 4, or to the albedo of microfacets; without a table it is the same. */
#include "ndf.h"
#include "prefenv.h"
#include "reference.h"
#include "surface.h"
#include "tap.h"
#include "vector.h"

enum { WIDTH = 256, HEIGHT = 128 };

static const double brush[3] = { 0.3, 1, -0.2 }, n[3] = { 0.48, 0.6, 0.64 };
static const double lowest = 0.15; /* o.n of the viewers */

enum { CELLS = 64 };

static pe_ndf_table *make_table(double (*density_of)(double p, double q))
{
    static const double range[2] = { -1.2, 1.2 };
    static float density[CELLS * CELLS];
    pe_ndf_table *table;

    for (int k = 0; k < CELLS * CELLS; k++) {
        int row = k / CELLS;

        density[k] = (float)density_of(2.4 * (k % CELLS + 0.5) / CELLS - 1.2, 2.4 * (row + 0.5) / CELLS - 1.2);
    }
    need(pe_ndf_table_create(CELLS, CELLS, range, range, density, &table, NULL) == PE_OK, "no table");
    return table;
}

/* Two ridges, so that it is neither a Beckmann nor symmetric; its mean slope is 0. */
static double two_ridges(double p, double q)
{
    return 2 * exp(-30 * (p * p + (q - 0.2) * (q - 0.2))) + exp(-20 * (p * p + (q + 0.4) * (q + 0.4)));
}

/* A surface that leans, all of it, so that low viewers from one side see none of it. */
static double one_side(double p, double q)
{
    return exp(-400 * ((p + 0.5) * (p + 0.5) + (q + 0.5) * (q + 0.5)));
}

/* One of many viewers, spread evenly over the part of the hemisphere above `lowest`. */
static void viewer(int k, double o[3])
{
    double cosine = lowest + (1 - lowest) * fmod(0.5 + k * 0.61803398875, 1), sine = sqrt(1 - cosine * cosine);
    double local[3] = { sine * cos(2.4 * k), sine * sin(2.4 * k), cosine };
    pe_frame frame;

    pe_frame_make(n, brush, &frame);
    pe_frame_direction(&frame, local, o);
}

/* A lamp in one texel, its irradiance 1, and the direction to it. */
typedef struct lamp {
    pe_env *env;
    double direction[3];
} lamp;

static lamp make_lamp(int x, int y)
{
    const double pi = 3.14159265358979323846;
    double solid_angle = 2 * pi / WIDTH * (cos(pi * y / HEIGHT) - cos(pi * (y + 1) / HEIGHT)), theta;
    float *rgb = reference_constant(WIDTH, HEIGHT, 0);
    lamp made = { NULL, { 0 } };

    for (int c = 0; c < 3; c++)
        rgb[3 * (y * WIDTH + x) + c] = (float)(1 / solid_angle);
    need(pe_env_create(WIDTH, HEIGHT, rgb, &made.env, NULL) == PE_OK, "no environment");
    free(rgb);
    reference_direction(WIDTH, HEIGHT, x, y, made.direction, &theta);
    return made;
}

enum { LAMPS = 4 };

/* Near the normal, half high, low, and below the horizon. */
static lamp lamps[LAMPS];

/* ---- against the truth ---- */

typedef struct differences {
    double worst, largest; /* of the exact, to which the differences are relative */
} differences;

static void compare(const double got[3], const double exact[3], differences *d)
{
    for (int c = 0; c < 3; c++) {
        d->worst = worst_of(d->worst, fabs(got[c] - exact[c]) / fmax(exact[c], 1e-3));
        d->largest = worst_of(d->largest, exact[c]);
    }
}

static void follows_exact(const pe_surface *surface, const char *name)
{
    differences table = { 0 }, once = { 0 };
    pe_highlights *highlights = NULL;
    pe_error error;

    need(pe_highlights_make(surface, &highlights, &error) == PE_OK, "%s", error.message);
    for (int k = 0; k < 24; k++) {
        double o[3], got[3], exact[3];
        const lamp *l = &lamps[k % LAMPS];

        viewer(k, o);
        pe_exact(l->env, surface, brush, n, o, exact);
        pe_highlight(highlights, brush, n, o, l->direction, got);
        compare(got, exact, &table);
        pe_highlight_once(surface, brush, n, o, l->direction, got);
        compare(got, exact, &once);
    }
    ok(table.worst < 0.015 && table.largest > 0.1, "%s: as an environment of one lit texel", name);
    ok(once.worst < 0.015, "... and without a table");
    note("differences up to %.2g, %.2g; radiance up to %.3g", table.worst, once.worst, table.largest);
    pe_highlights_free(highlights);
}

/* Lights from everywhere above the horizon, evenly. */
static double gather(const pe_highlights *highlights, const double o[3])
{
    enum { SIDE = 400 };
    double sum = 0;
    pe_frame frame;

    pe_frame_make(n, brush, &frame);
    for (int k = 0; k < SIDE * SIDE; k++) {
        int row = k / SIDE;
        double z = (row + 0.5) / SIDE, phi = 2 * 3.14159265358979323846 * (k % SIDE + 0.5) / SIDE;
        double local[3] = { sqrt(1 - z * z) * cos(phi), sqrt(1 - z * z) * sin(phi), z }, light[3], rgb[3];

        pe_frame_direction(&frame, local, light);
        pe_highlight(highlights, brush, n, o, light, rgb);
        sum += rgb[1];
    }
    return sum * 2 * 3.14159265358979323846 / (SIDE * SIDE);
}

static void gathers_white(const pe_surface *surface, const char *name)
{
    pe_highlights *highlights = NULL;
    double worst = 0;

    need(pe_highlights_make(surface, &highlights, NULL) == PE_OK, "no highlights");
    for (int k = 0; k < 4; k++) {
        double o[3], local[3], white = 1;
        pe_frame frame;

        viewer(k, o);
        pe_frame_make(n, brush, &frame);
        pe_frame_coordinates(&frame, o, local);
        if (surface->weight == PE_WEIGHT_MICROFACET)
            white = pe_directional_albedo(&surface->ndf, local, 256);
        worst = worst_of(worst, fabs(gather(highlights, o) / white - 1));
    }
    ok(worst < 0.01, "%s: light from everywhere adds up", name);
    note("differences up to %.2g", worst);
    pe_highlights_free(highlights);
}

static void microfacets_follow(const pe_ndf_table *table)
{
    const struct {
        const char *name;
        pe_ndf ndf;
    } kinds[] = {
        { "beckmann", { PE_NDF_BECKMANN, 0.3, 0.3, NULL } }, { "brushed", { PE_NDF_BECKMANN, 0.15, 0.5, NULL } },
        { "ggx", { PE_NDF_GGX, 0.3, 0.2, NULL } },           { "phong", { PE_NDF_PHONG, 0.4, 0.4, NULL } },
        { "table", { PE_NDF_TABLE, 0, 0, table } },
    };

    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        pe_surface surface = { .ndf = kinds[k].ndf };
        char name[64];

        follows_exact(&surface, kinds[k].name);
        gathers_white(&surface, kinds[k].name);
        if (surface.ndf.kind == PE_NDF_PHONG)
            continue;
        surface.weight = PE_WEIGHT_MICROFACET;
        snprintf(name, sizeof name, "%s, microfacet", kinds[k].name);
        gathers_white(&surface, name); /* F is 1 */
        pe_material("copper", surface.eta, surface.k);
        snprintf(name, sizeof name, "%s, copper", kinds[k].name);
        follows_exact(&surface, name);
    }
}

/* The bounds that prefenv.h states for W's table, near the worst that there is: of GGX as wide as can be and drawn out
 * tenfold, 0.13, and of narrow lobes of any kind, 0.09. */
static void table_is_near(pe_ndf ndf)
{
    enum { HIGH = 40, LOW = 120, AROUND = 5 };
    static const double up[3] = { 0, 0, 1 }, along[3] = { 1, 0, 0 };
    const pe_surface surface = { .ndf = ndf };
    pe_highlights *highlights = NULL;
    double worst[2] = { 0, 0 }; /* low, high */

    need(pe_highlights_make(&surface, &highlights, NULL) == PE_OK, "no highlights");
    for (int k = 0; k < (HIGH + LOW) * AROUND; k++) {
        int row = k / AROUND, is_high = row >= LOW;
        double z = is_high ? 0.2 + 0.8 * (row - LOW + 0.5) / HIGH : 0.2 * (row + 0.5) / LOW, sine = sqrt(1 - z * z);
        double azimuth = 0.023 + 1.55 * (k % AROUND) / (AROUND - 1), table[3], once[3], off;
        const double o[3] = { sine * cos(azimuth), sine * sin(azimuth), z }, light[3] = { -o[0], -o[1], z };

        pe_highlight(highlights, along, up, o, light, table);
        pe_highlight_once(&surface, along, up, o, light, once);
        off = fabs(table[0] / once[0] - 1);
        if (!(off <= worst[is_high]))
            worst[is_high] = off;
    }
    ok(worst[1] < 0.03 && worst[0] < 0.15, "kind %d, %g, %g: the table of W is within %.3f, %.3f at low viewers",
       (int)ndf.kind, ndf.alpha_x, ndf.alpha_y, worst[1], worst[0]);
    pe_highlights_free(highlights);
}

static void tables_are_near(void)
{
    table_is_near((pe_ndf){ PE_NDF_GGX, 0.2, 2, NULL });
    table_is_near((pe_ndf){ PE_NDF_GGX, 2, 0.2, NULL });
    table_is_near((pe_ndf){ PE_NDF_GGX, 1.3, 2, NULL });
    table_is_near((pe_ndf){ PE_NDF_BECKMANN, 0.003, 0.001, NULL });
    table_is_near((pe_ndf){ PE_NDF_BECKMANN, 1.6, 2, NULL });
    table_is_near((pe_ndf){ PE_NDF_PHONG, 0.003, 0.003, NULL });
}

/* ---- Phong's lobe ---- */

static void lobes_follow(void)
{
    static const double exponents[] = { 0, 1, 20, 300 };
    static const char *const horizons[] = { "ignored", "dark", "mean" };

    for (int h = PE_HORIZON_IGNORED; h <= PE_HORIZON_MEAN; h++) {
        differences d = { 0 };

        for (int k = 0; k < 32; k++) {
            const lamp *l = &lamps[k % LAMPS];
            double exponent = exponents[k / LAMPS % 4], r[3], exact[3], got;

            viewer(k, r);
            pe_phong(l->env, exponent, (pe_horizon)h, n, r, exact);
            got = pe_phong_highlight(exponent, (pe_horizon)h, n, r, l->direction);
            compare((const double[3]){ got, got, got }, exact, &d);
        }
        ok(d.worst < 0.005 && d.largest > 0.3, "Phong's lobe, the horizon %s", horizons[h]);
        note("differences up to %.2g; radiance up to %.3g", d.worst, d.largest);
    }
}

/* ---- what callers may do ---- */

static void arguments_are_any(void)
{
    const pe_surface surface = { .ndf = { PE_NDF_GGX, 0.2, 0.3, NULL } };
    const pe_surface wrong = { .ndf = { PE_NDF_GGX, 0, 0.3, NULL } };
    const double below[3] = { -n[0], -n[1], -n[2] };
    const double *light = lamps[0].direction, far_light[3] = { 1e150 * light[0], 1e150 * light[1], 1e150 * light[2] };
    double o[3], rgb[3], same[3];
    pe_highlights *highlights = NULL;
    pe_error error;

    ok(pe_highlights_make(&wrong, &highlights, &error) == PE_ERROR_ARGUMENT && !highlights, "a wrong width is refused");
    note("%s", error.message);
    need(pe_highlights_make(&surface, &highlights, NULL) == PE_OK, "no highlights");
    viewer(1, o);
    pe_highlight(highlights, brush, n, o, light, rgb);
    pe_highlight(highlights, brush, below, (double[3]){ 3 * o[0], 3 * o[1], 3 * o[2] }, far_light, same);
    ok(rgb[0] > 0 && fabs(same[0] / rgb[0] - 1) < 1e-12, "lengths do not matter, and n is turned to the viewer");
    pe_highlight(highlights, brush, n, o, below, rgb);
    ok(rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0, "a light below the horizon leaves none");
    pe_highlights_free(highlights);
    pe_highlights_free(NULL);
}

/* What leans has highlights that are light, and seen from above white ones. */
static void leaning_is_finite(void)
{
    pe_ndf_table *table = make_table(one_side);
    const pe_surface surface = { .ndf = { PE_NDF_TABLE, 0, 0, table } };
    pe_highlights *highlights = NULL;
    double white;
    int wrong = 0;
    pe_error error;

    need(pe_highlights_make(&surface, &highlights, &error) == PE_OK, "%s", error.message);
    for (int k = 0; k < 4000; k++) {
        double z = fmod(0.5 + k * 0.61803398875, 1), sine = sqrt(1 - z * z), got[3], once[3];
        const double up[3] = { 0, 1, 0 }, o[3] = { sine * cos(2.4 * k), z, sine * sin(2.4 * k) };
        const double *light = lamps[k % LAMPS].direction;

        pe_highlight(highlights, brush, up, o, light, got);
        pe_highlight_once(&surface, brush, up, o, light, once);
        for (int c = 0; c < 3; c++)
            wrong += !(got[c] >= 0 && isfinite(got[c]) && once[c] >= 0 && isfinite(once[c]));
    }
    white = gather(highlights, n);
    ok(wrong == 0, "a surface that leans: highlights are finite and not negative");
    ok(fabs(white - 1) < 0.01, "... and, seen from above, light from everywhere adds up");
    note("to %.4f", white);
    pe_highlights_free(highlights);
    pe_ndf_table_free(table);
}

int main(void)
{
    static const int places[LAMPS][2] = { { 32, 40 }, { 10, 30 }, { 60, 70 }, { 160, 90 } };
    pe_ndf_table *table = make_table(two_ridges);

    for (int k = 0; k < LAMPS; k++)
        lamps[k] = make_lamp(places[k][0], places[k][1]);
    microfacets_follow(table);
    tables_are_near();
    lobes_follow();
    arguments_are_any();
    leaning_is_finite();
    for (int k = 0; k < LAMPS; k++)
        pe_env_free(lamps[k].env);
    pe_ndf_table_free(table);
    return done_testing();
}
