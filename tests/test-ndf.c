/* test-ndf.c - claim: D is normalised, agrees with the formulas written out, and its sampler draws from D cos(theta);
 * and where pe_ndf_reach says so D is small, and not before. */
#include "ndf.h"
#include "prefenv.h"
#include "reference.h"
#include "tap.h"

#include <math.h>
#include <string.h>

static const char *const kinds[] = { "beckmann", "ggx", "phong" };

static const double alphas[][2] = {
    { 0.1, 0.1 }, { 0.1, 0.03 }, { 0.02, 0.02 }, { 0.6, 0.6 }, { 0.05, 0.5 }, { 2, 2 }
};
#define CASES (int)(sizeof alphas / sizeof *alphas)

static void spherical(double theta, double phi, double h[3])
{
    h[0] = sin(theta) * cos(phi);
    h[1] = sin(theta) * sin(phi);
    h[2] = cos(theta);
}

/* Integral of D cos over the hemisphere by the midpoint rule in theta and phi. */
static double integrate(const pe_ndf *ndf)
{
    const int rings = 4000, spokes = 720;
    double sum = 0;

    for (int i = 0; i < rings; i++)
        for (int j = 0; j < spokes; j++) {
            double theta = M_PI / 2 * (i + 0.5) / rings, h[3];

            spherical(theta, 2 * M_PI * (j + 0.5) / spokes, h);
            sum += pe_ndf_evaluate(ndf, h) * cos(theta) * sin(theta);
        }
    return sum * (M_PI / 2 / rings) * (2 * M_PI / spokes);
}

/* Largest relative difference from the formula written with angles. */
static double difference_from_formula(const pe_ndf *ndf)
{
    static const double t[3] = { 1, 0, 0 }, b[3] = { 0, 1, 0 }, n[3] = { 0, 0, 1 };
    double worst = 0;

    for (int i = 0; i < 60; i++)
        for (int j = 0; j < 36; j++) {
            double h[3], expected;

            spherical(0.02 * i, j * 0.17453, h);
            expected = reference_density((int)ndf->kind, ndf->alpha_x, ndf->alpha_y, h, t, b, n);
            worst = worst_of(worst, fabs(pe_ndf_evaluate(ndf, h) - expected) / (expected + 1e-250));
        }
    return worst;
}

/* Survival function of chi-square with k degrees of freedom, by Wilson and Hilferty's normal approximation. */
static double chi_square_p(double chi_square, int k)
{
    double z = (cbrt(chi_square / k) - (1 - 2.0 / (9 * k))) / sqrt(2.0 / (9 * k));

    return 0.5 * erfc(z / sqrt(2));
}

/* Counts samples in cells of a grid over the disk that the slopes (p/ax, q/ay) fill, where D cos is a unit Gaussian:
 * cells of equal probability would only test the inverse, so the expected counts come from integrating D cos itself. */
#define RINGS 16
#define SPOKES 24

static double cell_probability(const pe_ndf *ndf, int ring, int spoke)
{
    const int fine = 24;
    double sum = 0, theta_max = atan(3.5 * fmax(ndf->alpha_x, ndf->alpha_y));
    double d_theta = theta_max / RINGS / fine, d_phi = 2 * M_PI / SPOKES / fine;

    for (int i = 0; i < fine; i++)
        for (int j = 0; j < fine; j++) {
            double theta = theta_max * ring / RINGS + (i + 0.5) * d_theta, h[3];

            spherical(theta, 2 * M_PI * spoke / SPOKES + (j + 0.5) * d_phi, h);
            sum += pe_ndf_evaluate(ndf, h) * cos(theta) * sin(theta) * d_theta * d_phi;
        }
    return sum;
}

static double sampler_p(const pe_ndf *ndf)
{
    const int samples = 1000000;
    static int counts[RINGS][SPOKES];
    double theta_max = atan(3.5 * fmax(ndf->alpha_x, ndf->alpha_y)), chi_square = 0, rest = samples;
    int cells = 0, rest_count = samples;
    unsigned state = 7;

    memset(counts, 0, sizeof counts);
    for (int k = 0; k < samples; k++) {
        double h[3], u1 = reference_random(&state), phi;
        int ring;

        pe_ndf_sample(ndf, u1, reference_random(&state), h);
        phi = atan2(h[1], h[0]);
        ring = (int)(RINGS * atan2(hypot(h[0], h[1]), h[2]) / theta_max);
        if (ring < RINGS)
            counts[ring][(int)(SPOKES * (phi < 0 ? phi + 2 * M_PI : phi) / (2 * M_PI)) % SPOKES]++;
    }
    for (int i = 0; i < RINGS; i++)
        for (int j = 0; j < SPOKES; j++) {
            double expected = samples * cell_probability(ndf, i, j);

            if (expected < 10)
                continue;
            chi_square += pow(counts[i][j] - expected, 2) / expected;
            cells++;
            rest -= expected;
            rest_count -= counts[i][j];
        }
    if (rest > 10)
        chi_square += pow(rest_count - rest, 2) / rest;
    return chi_square_p(chi_square, cells);
}

static void test_closed_form(pe_ndf_kind kind, double alpha_x, double alpha_y)
{
    static const double below[3] = { 0.6, 0, -0.8 };
    pe_ndf ndf = { kind, alpha_x, alpha_y, NULL };
    double integral = integrate(&ndf), worst = difference_from_formula(&ndf), p = sampler_p(&ndf);
    char name[64];

    snprintf(name, sizeof name, "%s, alpha %g, %g", kinds[kind], alpha_x, alpha_y);
    ok(fabs(integral - 1) < 2e-4, "%s: integral of D cos = %.6f", name, integral);
    ok(worst < 1e-9, "%s: the formula within %.1e", name, worst);
    ok(p > 1e-4, "%s: sampler's chi-square test, p = %.3f", name, p);
    ok(pe_ndf_evaluate(&ndf, below) == 0, "%s: no normals below the surface", name);
}

/* How small D is at slopes p, q as pe_ndf_reach counts it, against its middle. */
static double smallness(const pe_ndf *ndf, double p, double q)
{
    double cos2 = 1 / (1 + p * p + q * q);

    if (ndf->kind == PE_NDF_GGX)
        return -log(pe_ndf_slope_density(ndf, p, q) / pe_ndf_slope_density(ndf, 0, 0) / (cos2 * cos2));
    return pe_ndf_exponent(ndf, p, q);
}

static void test_reach(pe_ndf_kind kind, double alpha_x, double alpha_y, double limit)
{
    pe_ndf ndf = { kind, alpha_x, alpha_y, NULL };
    double reach = pe_ndf_reach(&ndf, limit), least = INFINITY, before, m = 0.99 * reach;

    for (int k = 0; k < 360 * 50 && reach < INFINITY; k++) {
        double beyond = reach * (1 + 1e-9) * pow(1.3, k % 50), phi = 2 * M_PI * k / (360 * 50);

        least = least_of(least, smallness(&ndf, beyond * cos(phi), beyond * sin(phi)));
    }
    if (reach == INFINITY) /* nowhere so small */
        m = 1e9, least = limit;
    before = fmin(smallness(&ndf, m, 0), smallness(&ndf, 0, m));
    ok(least > limit - 1e-6 && before < limit, "%s, alpha %g, %g: D is below exp(-%g) beyond slopes of %g", kinds[kind],
       alpha_x, alpha_y, limit, reach);
}

static void test_reaches(void)
{
    for (int kind = 0; kind < 3; kind++)
        for (int limit = 1; limit < 60; limit += 17) {
            test_reach((pe_ndf_kind)kind, 0.1, 0.1, limit);
            test_reach((pe_ndf_kind)kind, 0.005, 0.02, limit);
        }
}

int main(void)
{
    pe_error error;
    pe_ndf bad = { PE_NDF_BECKMANN, 0, 0.1, NULL };

    for (int kind = 0; kind < 3; kind++)
        for (int k = 0; k < CASES; k++)
            if (kind != PE_NDF_PHONG || alphas[k][0] <= 1)
                test_closed_form((pe_ndf_kind)kind, alphas[k][0], alphas[k][1]);
    test_reaches();
    ok(pe_ndf_check(&bad, &error) == PE_ERROR_ARGUMENT && strstr(error.message, "alpha"), "alpha 0 is refused: %s",
       error.message);
    bad.alpha_x = NAN;
    ok(pe_ndf_check(&bad, NULL) == PE_ERROR_ARGUMENT, "alpha NaN is refused");
    bad = (pe_ndf){ PE_NDF_PHONG, 0.5, 1.01, NULL };
    ok(pe_ndf_check(&bad, NULL) == PE_ERROR_ARGUMENT, "alpha 1.01 is refused for phong, whose exponent is negative");
    bad = (pe_ndf){ .kind = PE_NDF_TABLE };
    ok(pe_ndf_check(&bad, NULL) == PE_ERROR_ARGUMENT, "a table that is not there is refused");
    return done_testing();
}
