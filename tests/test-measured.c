/* test-measured.c - claim: a table measured from a surface's heights reflects an environment as the surface does.
 *
 * The truth is every facet of the height field, one a texel, each a mirror: its slope gives its normal h, the viewer's
 * mirror image in it is the direction of the light.  [Motegi Eq. 4] integrates L D over directions of light; with
 * d(omega_i) = 4 (h.o) d(omega_h) and D (h.n) d(omega_h) = P dp dq, the share of the area, a facet counts as 4 (h.o) /
 * (h.n) and only if its light comes from in front of the surface.  No table, no histogram. */
#include "prefenv.h"
#include "reference.h"
#include "sample_point.h"
#include "tap.h"

#include <math.h>

#define ENV_WIDTH 512
#define ENV_HEIGHT 256
#define VIEWS 12

static const double brush[3] = { 0, 1, 0 };

/* Stripes of another direction in each channel, half as wide as the widest lobe here, known in every direction. */
static void radiance(const double w[3], double rgb[3])
{
    for (int c = 0; c < 3; c++)
        rgb[c] = 1 + 0.5 * w[c] + 0.4 * sin(12 * w[(c + 1) % 3]);
}

static pe_env *make_env(void)
{
    float *rgb = reference_constant(ENV_WIDTH, ENV_HEIGHT, 0);
    pe_env *env = NULL;

    for (int y = 0; y < ENV_HEIGHT; y++)
        for (int x = 0; x < ENV_WIDTH; x++) {
            double w[3], theta, value[3];

            reference_direction(ENV_WIDTH, ENV_HEIGHT, x, y, w, &theta);
            radiance(w, value);
            for (int c = 0; c < 3; c++)
                rgb[3 * ((size_t)y * ENV_WIDTH + (size_t)x) + (size_t)c] = (float)value[c];
        }
    need(pe_env_create(ENV_WIDTH, ENV_HEIGHT, rgb, &env, NULL) == PE_OK, "no environment");
    free(rgb);
    return env;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalize(double v[3])
{
    double length = sqrt(dot(v, v));

    for (int c = 0; c < 3; c++)
        v[c] /= length;
}

/* t = normalize(d - (d.n) n), b = n x t. */
static void make_frame(const double n[3], double t[3], double b[3])
{
    for (int c = 0; c < 3; c++)
        t[c] = brush[c] - dot(brush, n) * n[c];
    normalize(t);
    for (int c = 0; c < 3; c++)
        b[c] = n[(c + 1) % 3] * t[(c + 2) % 3] - n[(c + 2) % 3] * t[(c + 1) % 3];
}

/* The reflection of all facets. */
static void reflect_facets(const pe_slopes *slopes, const double n[3], const double o[3], double rgb[3])
{
    double t[3], b[3], sum[4] = { 0 };

    make_frame(n, t, b);
    for (size_t k = 0; k < slopes->count; k++) {
        double h[3], w[3], value[3], cos_o, weight, length;

        for (int c = 0; c < 3; c++)
            h[c] = (double)slopes->p[k] * t[c] + (double)slopes->q[k] * b[c] + n[c];
        length = sqrt(dot(h, h)); /* 1 / (h.n) */
        normalize(h);
        cos_o = dot(h, o);
        for (int c = 0; c < 3; c++)
            w[c] = 2 * cos_o * h[c] - o[c];
        if (cos_o <= 0 || dot(w, n) <= 0)
            continue;
        weight = 4 * cos_o * length;
        radiance(w, value);
        for (int c = 0; c < 3; c++)
            sum[c] += weight * value[c];
        sum[3] += weight;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = sum[c] / sum[3];
}

/* View k: a normal anywhere, and a viewer up to 60 degrees away from it. */
static void make_view(int k, double n[3], double o[3])
{
    unsigned state = 1000u + 77u * (unsigned)k;
    double away[3];

    reference_random_direction(&state, n);
    do {
        reference_random_direction(&state, away);
        for (int c = 0; c < 3; c++)
            o[c] = n[c] + 0.8 * away[c];
        normalize(o);
    } while (dot(o, n) < 0.5);
}

/* Relative L2 error over the views of what `answer` says. */
typedef void answer(const void *data, const double n[3], const double o[3], double rgb[3]);

static double error_of(const pe_slopes *slopes, answer *say, const void *data)
{
    double squares = 0, differences = 0;

    for (int k = 0; k < VIEWS; k++) {
        double n[3], o[3], truth[3], said[3];

        make_view(k, n, o);
        reflect_facets(slopes, n, o, truth);
        say(data, n, o, said);
        for (int c = 0; c < 3; c++) {
            squares += truth[c] * truth[c];
            differences += (said[c] - truth[c]) * (said[c] - truth[c]);
        }
    }
    return sqrt(differences / squares);
}

typedef struct exact_data {
    const pe_env *env;
    pe_surface surface;
} exact_data;

static void say_exact(const void *data, const double n[3], const double o[3], double rgb[3])
{
    const exact_data *e = data;

    pe_exact(e->env, &e->surface, brush, n, o, rgb);
}

static void say_baked(const void *data, const double n[3], const double o[3], double rgb[3])
{
    sample_point(data, NULL, NULL, n, o, rgb);
}

static pe_ndf_table *make_table(const pe_slopes *slopes)
{
    pe_density_options options = { 0 };
    pe_slope_density d;
    pe_ndf_table *table = NULL;
    pe_error error = { PE_OK, "" };

    need(pe_slopes_density(slopes, &options, &d, &error) == PE_OK, "%s", error.message);
    need(pe_ndf_table_create(d.width, d.height, (double[2]){ -d.range[0], d.range[0] },
                             (double[2]){ -d.range[1], d.range[1] }, d.values, &table, &error) == PE_OK,
         "%s", error.message);
    pe_slope_density_free(&d);
    return table;
}

typedef struct measured {
    const char *name;
    pe_machining_options options;
    double exact_bound, baked_bound;
    double beckmann; /* at least so far off is Beckmann's distribution of the same rms slopes */
    double rise[2];  /* of a ramp below it, along x and y: the others are the same seen from either side */
} measured;

static void add_ramp(const double rise[2], pe_heights *heights)
{
    for (int y = 0; y < heights->height; y++)
        for (int x = 0; x < heights->width; x++)
            heights->values[(size_t)y * (size_t)heights->width + (size_t)x] +=
                (float)((rise[0] * x + rise[1] * y) * heights->pitch);
}

/* Rough enough along the lay for the environment's texels to resolve; the maps are small, for the test's time. */
static const measured surfaces[] = {
    { "turned", { .kind = PE_TURNED, .feed = 64, .radius = 160, .roughness = 0.16 }, 0.008, 0.03, 0.03, { 0, 0 } },
    { "milled", { .kind = PE_MILLED, .feed = 64, .slope = 0.25, .roughness = 0.16 }, 0.008, 0.09, 0.08, { 0, 0 } },
    { "blasted", { .kind = PE_BLASTED, .roughness = 0.8 }, 0.003, 0.02, 0, { 0, 0 } },
    { "brushed", { .kind = PE_BRUSHED }, 0.004, 0.03, 0, { 0, 0 } },
    { "brushed, askew", { .kind = PE_BRUSHED }, 0.008, 0.06, 0.05, { 0.15, -0.1 } },
};
#define SURFACES (int)(sizeof surfaces / sizeof *surfaces)

static void test_surface(const pe_env *env, const measured *m)
{
    exact_data exact = { env, { .ndf = { .kind = PE_NDF_TABLE } } };
    exact_data beckmann = { env, { .ndf = { .kind = PE_NDF_BECKMANN } } };
    pe_bake_options options = { .normals = 42, .width = 64, .height = 32 };
    pe_machining_options o = m->options;
    pe_slope_statistics s;
    pe_heights heights;
    pe_slopes slopes = { 0 };
    pe_ndf_table *table;
    pe_maps *maps = NULL;
    double exact_error, baked_error, beckmann_error;

    o.width = o.height = 256;
    need(pe_heights_machine(&o, &heights, NULL) == PE_OK, "%s cannot be made", m->name);
    add_ramp(m->rise, &heights);
    need(pe_slopes_of_heights(&heights, PE_EDGES_OPEN, &slopes, NULL) == PE_OK, "%s has no slopes", m->name);
    table = make_table(&slopes);
    exact.surface.ndf.table = table;
    exact_error = error_of(&slopes, say_exact, &exact);
    ok(exact_error < m->exact_bound, "%s: exact with the table is %.3f %% from the surface itself", m->name,
       100 * exact_error);
    pe_slopes_measure(&slopes, &s);
    beckmann.surface.ndf.alpha_x = s.alpha[0];
    beckmann.surface.ndf.alpha_y = s.alpha[1];
    beckmann_error = error_of(&slopes, say_exact, &beckmann);
    ok(beckmann_error >= m->beckmann, "%s: Beckmann of the same rms slopes is %.2f %% from it", m->name,
       100 * beckmann_error);
    options.surface = exact.surface;
    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "%s cannot be baked", m->name);
    baked_error = error_of(&slopes, say_baked, maps);
    ok(baked_error < m->baked_bound, "%s: the bake is %.2f %% from the surface itself", m->name, 100 * baked_error);
    pe_maps_free(maps);
    pe_ndf_table_free(table);
    pe_slopes_free(&slopes);
    pe_heights_free(&heights);
}

int main(void)
{
    pe_env *env = make_env();

    for (int k = 0; k < SURFACES; k++)
        test_surface(env, &surfaces[k]);
    pe_env_free(env);
    return done_testing();
}
