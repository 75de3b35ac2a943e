/* test-microfacet.c - claims: --weight microfacet reflects D G2 F / (4 cos theta_o) as the formulas say: a white
 * furnace loses what is masked, no more; colours are the conductor's; bake, baseline, exact and Monte Carlo agree. */
#include "lobe.h"
#include "ndf.h"
#include "prefenv.h"
#include "reference.h"
#include "sample_point.h"
#include "surface.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

static const char *const kinds[] = { "beckmann", "ggx", "phong", "table" };

static const double plus_y[3] = { 0, 1, 0 };

static pe_env *make_env(int width, int height, float *rgb)
{
    pe_env *env;
    pe_error error;

    need(pe_env_create(width, height, rgb, &env, &error) == PE_OK, "%s", error.message);
    free(rgb);
    return env;
}

static pe_surface make_surface(pe_ndf_kind kind, double alpha_x, double alpha_y, const char *metal)
{
    pe_surface surface = { .ndf = { kind, alpha_x, alpha_y, NULL }, .weight = PE_WEIGHT_MICROFACET };

    if (metal)
        need(pe_material(metal, surface.eta, surface.k), "no %s", metal);
    return surface;
}

static pe_lobe *make_lobe(const pe_surface *surface)
{
    pe_lobe *lobe;
    pe_error error;

    need(pe_lobe_make(surface, 0, &lobe, &error) == PE_OK, "%s", error.message);
    return lobe;
}

static void polar(double theta, double phi, double v[3])
{
    v[0] = sin(theta) * cos(phi);
    v[1] = sin(theta) * sin(phi);
    v[2] = cos(theta);
}

/* ---- reflectance ---- */

/* Largest difference between the polynomial of a lobe and F, over cosines that are dense at grazing. */
static double polynomial_error(const pe_surface *surface)
{
    pe_lobe *lobe = make_lobe(surface);
    double worst = 0;

    for (int k = 0; k <= 3000; k++) {
        double cosine = pow(k / 1000.0 / 3, 2),
               x = 2 * cosine * (1 + (double)lobe->knee) / (cosine + (double)lobe->knee) - 1;

        for (int c = 0; c < 3; c++) {
            double f = 0;

            for (int term = PE_REFLECTANCE_TERMS - 1; term >= 0; term--)
                f = f * x + (double)lobe->reflectance[c][term];
            worst = worst_of(worst, fabs(f - pe_reflectance(surface->eta[c], surface->k[c], cosine)));
        }
    }
    pe_lobe_free(lobe);
    return worst;
}

static void test_reflectance(void)
{
    unsigned state = 4;
    double worst = 0, polynomial = 0, metals = 0;

    for (int k = 0; k < 20000; k++) {
        double eta = 6 * reference_random(&state), kappa = 9 * reference_random(&state);
        double cosine = reference_random(&state);

        worst = worst_of(worst, fabs(pe_reflectance(eta, kappa, cosine) - reference_reflectance(eta, kappa, cosine)));
    }
    ok(worst < 1e-12, "reflectance is that of complex arithmetic within %.1e", worst);
    for (int k = 0; k < 60; k++) {
        pe_surface surface = make_surface(PE_NDF_GGX, 0.3, 0.3, NULL);
        double size = 1 + 9 * reference_random(&state);

        for (int c = 0; c < 3; c++) { /* a metal's channels are of a kind */
            double angle = M_PI / 2 * (0.01 + 0.98 * reference_random(&state));
            double own = fmax(size * (0.7 + 0.6 * reference_random(&state)), 1);

            surface.eta[c] = own * cos(angle);
            surface.k[c] = own * sin(angle);
        }
        polynomial = worst_of(polynomial, polynomial_error(&surface));
    }
    ok(polynomial < 1e-3, "in the filter within %.1e of any conductor's", polynomial);
    for (int m = 0; pe_material_name(m); m++) {
        pe_surface surface = make_surface(PE_NDF_GGX, 0.3, 0.3, pe_material_name(m));

        metals = worst_of(metals, polynomial_error(&surface));
    }
    ok(metals < 2e-4, "and within %.1e of the metals'", metals);
}

/* Normal incidence, as anyone may look it up: gold is yellow, copper red, silver bright. */
static void test_materials(void)
{
    double f[3][3], eta[3], k[3];
    static const char *const names[3] = { "gold", "copper", "silver" };

    for (int m = 0; m < 3; m++) {
        need(pe_material(names[m], eta, k), "no %s", names[m]);
        for (int c = 0; c < 3; c++)
            f[m][c] = pe_reflectance(eta[c], k[c], 1);
    }
    ok(f[0][0] > 0.9 && f[0][1] > 0.7 && f[0][2] < 0.45, "gold is %.2f %.2f %.2f", f[0][0], f[0][1], f[0][2]);
    ok(f[1][0] > 0.85 && f[1][1] < 0.65 && f[1][2] < 0.6, "copper is %.2f %.2f %.2f", f[1][0], f[1][1], f[1][2]);
    ok(f[2][0] > 0.95 && f[2][2] > 0.94, "silver is %.2f %.2f %.2f", f[2][0], f[2][1], f[2][2]);
    ok(!pe_material("unobtainium", eta, k), "unobtainium is not known");
}

/* ---- masking ---- */

/* Smith's definition: 1 + Lambda = the integral of D max(o.h, 0) over cos theta_o. */
static double lambda_by_quadrature(const pe_ndf *ndf, const double o[3])
{
    enum { SIDE = 1000 };
    double sum = 0, reach = 5.5;

    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++) {
            double p = ndf->alpha_x * reach * (2 * (i + 0.5) / SIDE - 1);
            double q = ndf->alpha_y * reach * (2 * (j + 0.5) / SIDE - 1);

            sum += fmax(o[0] * p + o[1] * q + o[2], 0) * pe_ndf_slope_density(ndf, p, q);
        }
    return sum * 4 * reach * reach * ndf->alpha_x * ndf->alpha_y / SIDE / SIDE / o[2] - 1;
}

static pe_ndf_table *tabulate(double alpha_x, double alpha_y)
{
    enum { CELLS = 256 };
    const double p_range[2] = { -5 * alpha_x, 5 * alpha_x }, q_range[2] = { -5 * alpha_y, 5 * alpha_y };
    static float density[CELLS * CELLS];
    pe_ndf_table *table;

    for (int k = 0; k < CELLS * CELLS; k++) {
        int row = k / CELLS;
        double p = 10 * (k % CELLS + 0.5) / CELLS - 5, q = 10 * (row + 0.5) / CELLS - 5;

        density[k] = (float)exp(-p * p - q * q);
    }
    need(pe_ndf_table_create(CELLS, CELLS, p_range, q_range, density, &table, NULL) == PE_OK, "no table");
    return table;
}

static void test_masking(double alpha_x, double alpha_y)
{
    pe_ndf beckmann = { PE_NDF_BECKMANN, alpha_x, alpha_y, NULL }, table = { .kind = PE_NDF_TABLE };
    pe_ndf_table *tabulated = tabulate(alpha_x, alpha_y);
    double worst = 0, worst_table = 0;

    table.table = tabulated;
    for (int k = 0; k < 8; k++) {
        double o[3], expected;

        polar(0.5 + 0.14 * k, 0.9 * k, o);
        expected = lambda_by_quadrature(&beckmann, o);
        worst = worst_of(worst, fabs(pe_ndf_lambda(&beckmann, o) - expected) / (1 + expected));
    }
    ok(worst < 1e-5, "alpha %g, %g: Lambda of beckmann within %.1e", alpha_x, alpha_y, worst);
    for (int k = 0; k < 2000; k++) {
        double o[3], closed;

        polar(M_PI / 2 * k / 2000, 0.37 * k, o);
        closed = pe_ndf_lambda(&beckmann, o);
        worst_table = worst_of(worst_table, fabs(pe_ndf_lambda(&table, o) - closed) / (1 + closed));
    }
    ok(worst_table < 1e-3, "alpha %g, %g: Lambda of its table within %.1e", alpha_x, alpha_y, worst_table);
    pe_ndf_table_free(tabulated);
}

/* ---- the white furnace ---- */

static void viewer_of(double theta, double phi, const pe_frame *frame, double o[3])
{
    double local[3];

    polar(theta, phi, local);
    pe_frame_direction(frame, local, o);
}

/* pe_exact, Monte Carlo and the lobe's table against the reference's quadrature. */
static void test_furnace(pe_ndf_kind kind, double alpha_x, double alpha_y, const char *metal)
{
    static const double thetas[] = { 0, 0.6, 1.1, 1.35, 1.5 };
    static const double n[3] = { 0.48, 0.6, 0.64 };
    pe_surface surface = make_surface(kind, alpha_x, alpha_y, metal);
    pe_env *env = make_env(64, 32, reference_constant(64, 32, 1));
    pe_lobe *lobe = make_lobe(&surface);
    double worst[3] = { 0 }, greatest = 0;
    pe_frame frame;

    pe_frame_make(n, plus_y, &frame);
    for (int k = 0; k < 5; k++) {
        double local[3], o[3], exact[3], drawn[3], expected, alone;

        polar(thetas[k], 0.7 + k, local);
        viewer_of(thetas[k], 0.7 + k, &frame, o);
        expected = reference_furnace((int)kind, alpha_x, alpha_y, surface.eta[1], surface.k[1], local, 900);
        alone = metal ? reference_furnace((int)kind, alpha_x, alpha_y, 0, 0, local, 900) : expected;
        pe_exact(env, &surface, plus_y, n, o, exact);
        pe_monte_carlo(env, &surface, plus_y, 40000, n, o, drawn);
        worst[0] = worst_of(worst[0], fabs(exact[1] - expected));
        worst[1] = worst_of(worst[1], fabs(drawn[1] - expected));
        worst[2] = worst_of(worst[2], fabs(pe_lobe_albedo(lobe, local) - alone));
        greatest = worst_of(greatest, exact[1]);
    }
    ok(worst[0] < (metal ? 1e-3 : 1e-4), "%s %g, %g, %s: exact within %.1e of the furnace's", kinds[kind], alpha_x,
       alpha_y, metal ? metal : "F = 1", worst[0]);
    ok(worst[1] < 3e-3, "%s %g, %g: Monte Carlo within %.1e", kinds[kind], alpha_x, alpha_y, worst[1]);
    ok(worst[2] < 1e-3, "%s %g, %g: the table of albedos within %.1e", kinds[kind], alpha_x, alpha_y, worst[2]);
    ok(greatest <= 1 + 1e-6, "%s %g, %g: at most %.6f comes back", kinds[kind], alpha_x, alpha_y, greatest);
    pe_lobe_free(lobe);
    pe_env_free(env);
}

/* ---- an environment ---- */

/* Where texels resolve the lobe, the sum over texels as it stands. */
static void test_exact(pe_ndf_kind kind, double alpha_x, double alpha_y)
{
    pe_surface surface = make_surface(kind, alpha_x, alpha_y, "gold");
    float *rgb = reference_gradient(256, 128);
    pe_env *env = NULL;
    double worst = 0;
    unsigned state = 6;

    need(pe_env_create(256, 128, rgb, &env, NULL) == PE_OK, "no memory");
    for (int k = 0; k < 20; k++) {
        double n[3], o[3], exact[3], expected[3];

        reference_random_direction(&state, n);
        reference_random_direction(&state, o);
        if (pe_dot(n, o) < 0)
            pe_scale(-1, n, n);
        if (pe_dot(n, o) < 0.2)
            continue;
        pe_exact(env, &surface, plus_y, n, o, exact);
        reference_scattering((int)kind, rgb, 256, 128, alpha_x, alpha_y, surface.eta, surface.k, plus_y, n, o,
                             expected);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fabs(exact[c] / expected[c] - 1));
    }
    ok(worst < 1e-3, "%s %g, %g: exact is the plain sum within %.1e", kinds[kind], alpha_x, alpha_y, worst);
    free(rgb);
    pe_env_free(env);
}

/* The lobe's table of albedos is all that bake and exact do not share. */
static void test_bake(const pe_surface *surface, pe_method method)
{
    pe_env *env = make_env(64, 32, reference_noise(64, 32, 9));
    pe_bake_options options = {
        .method = method, .surface = *surface, .normals = 12, .width = 32, .height = 16, .accuracy = PE_ACCURACY_EXACT
    };
    pe_maps *maps, *alone;
    double error2 = 0, norm2 = 0;

    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
    options.threads = 1;
    need(pe_bake(env, &options, &alone, NULL) == PE_OK, "bake");
    for (int texel = 0; texel < 32 * 16; texel += 5) {
        double r[3], n[3], o[3], theta, exact[3];

        reference_direction(32, 16, texel % 32, texel / 32, r, &theta);
        memcpy(n, r, sizeof n);
        if (method == PE_METHOD_REPRESENTATIVE)
            pe_maps_normal(maps, 1, n);
        pe_scale(pe_dot(r, n) > 0 ? 1 : -1, n, n);
        pe_reflect(r, n, o);
        pe_exact(env, surface, plus_y, n, o, exact);
        for (int c = 0; c < 3; c++) {
            error2 += pow((double)pe_maps_image(maps, method == PE_METHOD_REPRESENTATIVE)[3 * texel + c] - exact[c], 2);
            norm2 += exact[c] * exact[c];
        }
    }
    ok(sqrt(error2 / norm2) < 1e-3, "%s %g, %g, %s: bake within %.1e of exact", kinds[surface->ndf.kind],
       surface->ndf.alpha_x, surface->ndf.alpha_y, method == PE_METHOD_BASELINE ? "baseline" : "representative",
       sqrt(error2 / norm2));
    ok(memcmp(pe_maps_image(maps, 0), pe_maps_image(alone, 0), 3 * 32 * 16 * sizeof(float)) == 0,
       "and the same with one thread");
    pe_maps_free(maps);
    pe_maps_free(alone);
    pe_env_free(env);
}

static void test_bakes(void)
{
    pe_surface round = make_surface(PE_NDF_BECKMANN, 0.2, 0.2, "copper");
    pe_surface brushed = make_surface(PE_NDF_GGX, 0.1, 0.3, "titanium");
    pe_surface white = make_surface(PE_NDF_GGX, 0.6, 0.6, NULL);
    pe_surface narrow = make_surface(PE_NDF_BECKMANN, 0.004, 0.004, "silver");
    pe_surface measured = make_surface(PE_NDF_TABLE, 0, 0, "aluminium");
    pe_ndf_table *table = tabulate(0.1, 0.3);

    measured.ndf.table = table;
    test_bake(&round, PE_METHOD_REPRESENTATIVE);
    test_bake(&round, PE_METHOD_BASELINE);
    test_bake(&brushed, PE_METHOD_REPRESENTATIVE);
    test_bake(&brushed, PE_METHOD_BASELINE);
    test_bake(&white, PE_METHOD_REPRESENTATIVE);
    test_bake(&narrow, PE_METHOD_REPRESENTATIVE);
    test_bake(&measured, PE_METHOD_REPRESENTATIVE);
    test_bake(&measured, PE_METHOD_BASELINE);
    pe_ndf_table_free(table);
}

/* A sun of 10,000 in a gradient: a light of its own. */
static float *gradient_with_sun(int width, int height)
{
    float *rgb = reference_gradient(width, height);

    for (int c = 0; c < 3; c++)
        rgb[3 * (width * height / 3) + c] = 10000;
    return rgb;
}

/* What a renderer sees of the default maps: gold in a white furnace and in a coloured one, from any side. */
static void test_lookups(const char *name, float *rgb, double bound)
{
    pe_surface gold = make_surface(PE_NDF_GGX, 0.3, 0.3, "gold");
    pe_env *env = make_env(64, 32, rgb);
    pe_bake_options options = { .surface = gold };
    pe_maps *maps;
    double error2 = 0, norm2 = 0;
    unsigned state = 21;

    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
    note("%s: %d suns", name, pe_maps_get_info(maps)->suns);
    for (int k = 0; k < 300; k++) {
        double n[3], o[3], seen[3], exact[3];

        reference_random_direction(&state, n);
        reference_random_direction(&state, o);
        if (fabs(pe_dot(n, o)) < 0.15)
            continue;
        sample_point(maps, NULL, NULL, n, o, seen);
        pe_exact(env, &gold, plus_y, n, o, exact);
        for (int c = 0; c < 3; c++) {
            error2 += pow(seen[c] - exact[c], 2);
            norm2 += exact[c] * exact[c];
        }
    }
    ok(sqrt(error2 / norm2) < bound, "%s: lookups within %.1e of exact", name, sqrt(error2 / norm2));
    pe_maps_free(maps);
    pe_env_free(env);
}

static void refuse(const pe_surface *surface, const char *word)
{
    pe_error error = { PE_OK, "" };

    ok(pe_surface_check(surface, &error) == PE_ERROR_ARGUMENT && strstr(error.message, word), "refused: %s",
       error.message);
}

static void test_refusals(void)
{
    pe_surface phong = make_surface(PE_NDF_PHONG, 0.1, 0.1, NULL), bad = make_surface(PE_NDF_GGX, 0.1, 0.1, "gold");

    refuse(&phong, "phong");
    bad.eta[1] = 0;
    refuse(&bad, "green");
    bad.eta[1] = NAN;
    refuse(&bad, "nan");
    bad.eta[1] = 0.5, bad.k[1] = 0.5;
    refuse(&bad, "0.5 + 0.5 i");
    bad.k[1] = 100;
    refuse(&bad, "100 i");
    bad.k[1] = 2, bad.weight = (pe_weight)7;
    refuse(&bad, "weight");
}

int main(void)
{
    test_reflectance();
    test_materials();
    test_masking(0.1, 0.1);
    test_masking(0.5, 0.05);
    for (int kind = PE_NDF_BECKMANN; kind <= PE_NDF_GGX; kind++) {
        test_furnace((pe_ndf_kind)kind, 0.1, 0.1, NULL);
        test_furnace((pe_ndf_kind)kind, 0.1, 0.03, NULL);
        test_furnace((pe_ndf_kind)kind, 0.5, 0.5, NULL);
        test_furnace((pe_ndf_kind)kind, 0.2, 1, NULL);
        test_furnace((pe_ndf_kind)kind, 0.3, 0.3, "copper");
        test_exact((pe_ndf_kind)kind, 0.2, 0.2);
        test_exact((pe_ndf_kind)kind, 0.3, 0.15);
    }
    test_bakes();
    test_lookups("white furnace", reference_constant(64, 32, 1), 0.006);
    test_lookups("gradient", reference_gradient(64, 32), 0.006);
    test_lookups("a sun", gradient_with_sun(64, 32), 0.006);
    test_refusals();
    return done_testing();
}
