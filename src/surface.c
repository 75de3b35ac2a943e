/* surface.c - surfaces: checked, and what they reflect. [Heitz], [Born]
 *
 * D G2 F / (4 cos theta_o cos theta_w), the microfacet reflection of single scattering, times the light's cosine
 * theta_w. */
#include "surface.h"

#include "ndf.h"
#include "status.h"
#include "vector.h"

#include <string.h>

/* ---- check ---- */

static int is_mirror(const pe_surface *surface)
{
    for (int c = 0; c < 3; c++)
        if (surface->eta[c] != 0 || surface->k[c] != 0)
            return 0;
    return 1;
}

static pe_status check_index(const pe_surface *surface, pe_error *error)
{
    static const char *const channels[3] = { "red", "green", "blue" };

    for (int c = 0; c < 3 && !is_mirror(surface); c++) {
        double eta = surface->eta[c], k = surface->k[c], size = hypot(eta, k);

        if (!(eta > 0 && k >= 0 && size >= 1 && size <= PE_INDEX_MAX))
            return pe_fail(
                error, PE_ERROR_ARGUMENT,
                "the index of refraction %g + %g i of %s is no conductor's; eta is above 0, k not below, and "
                "the size from 1 to %g",
                eta, k, channels[c], PE_INDEX_MAX);
    }
    return PE_OK;
}

pe_status pe_surface_check(const pe_surface *surface, pe_error *error)
{
    pe_status status = pe_ndf_check(&surface->ndf, error);

    if (status != PE_OK || surface->weight == PE_WEIGHT_NDF)
        return status;
    if (surface->weight != PE_WEIGHT_MICROFACET)
        return pe_fail(error, PE_ERROR_ARGUMENT, "weight: kind %d is not known; ndf and microfacet are",
                       (int)surface->weight);
    if (surface->ndf.kind == PE_NDF_PHONG)
        return pe_fail(
            error, PE_ERROR_ARGUMENT,
            "weight microfacet does not go with ndf phong, whose masking has no formula; take beckmann or ggx");
    return check_index(surface, error);
}

/* ---- reflectance ---- */

/* With a + i b = sqrt((eta + i k)^2 - sin^2): R_s = |c - (a + i b)|^2 / |c + (a + i b)|^2, and R_p = R_s times
 * (c^2 A - 2 a c s^2 + s^4) / (c^2 A + 2 a c s^2 + s^4), where c, s are cosine and sine and A = a^2 + b^2.  [Born] */
double pe_reflectance(double eta, double k, double cosine)
{
    double c2 = cosine * cosine, s2 = 1 - c2, real = eta * eta - k * k - s2;
    double size = hypot(real, 2 * eta * k), a = sqrt(fmax((size + real) / 2, 0));
    double straight = size + c2, across = 2 * a * cosine, straight_p = c2 * size + s2 * s2, across_p = across * s2;
    double r_s = (straight - across) / (straight + across);

    if (eta == 0 && k == 0)
        return 1;
    return r_s * straight_p / (straight_p + across_p); /* (R_s + R_p) / 2 */
}

/* ---- materials ---- */

typedef struct material {
    const char *name;
    double eta[3], k[3];
} material;

/* At 617, 549 and 451 nm. [Johnson 1972] for the noble metals, [Johnson 1974] for the others, [Rakic] for aluminium,
 * the last interpolated. */
static const material materials[] = {
    { "aluminium", { 1.350, 1.009, 0.636 }, { 7.371, 6.611, 5.465 } },
    { "chromium", { 3.17, 3.18, 2.33 }, { 3.30, 3.33, 3.14 } },
    { "copper", { 0.30, 1.02, 1.24 }, { 3.205, 2.577, 2.397 } },
    { "gold", { 0.21, 0.43, 1.38 }, { 3.272, 2.455, 1.914 } },
    { "iron", { 2.88, 2.95, 2.59 }, { 3.05, 2.93, 2.77 } },
    { "nickel", { 1.99, 1.92, 1.73 }, { 4.02, 3.61, 2.95 } },
    { "palladium", { 1.75, 1.64, 1.41 }, { 4.21, 3.84, 3.26 } },
    { "silver", { 0.06, 0.06, 0.04 }, { 4.152, 3.586, 2.657 } },
    { "titanium", { 2.67, 2.54, 2.27 }, { 3.72, 3.43, 3.04 } },
};

enum { MATERIALS = sizeof materials / sizeof *materials };

const char *pe_material_name(int index)
{
    return index >= 0 && index < MATERIALS ? materials[index].name : NULL;
}

int pe_material(const char *name, double eta[3], double k[3])
{
    for (int m = 0; m < MATERIALS; m++)
        if (strcmp(materials[m].name, name) == 0) {
            memcpy(eta, materials[m].eta, sizeof materials[m].eta);
            memcpy(k, materials[m].k, sizeof materials[m].k);
            return 1;
        }
    return 0;
}

/* ---- albedo ---- */

/* What one slope adds to the mean over P dp dq: G2 (o.h) / (cos theta_o cos theta_h), as in Monte Carlo. */
static double albedo_of(const pe_ndf *ndf, const double o[3], double lambda_o, const double h[3])
{
    double w[3], o_h = pe_dot(o, h);

    if (!(o_h > 0))
        return 0;
    pe_reflect(o, h, w);
    if (!(w[2] > 0))
        return 0;
    return o_h / (o[2] * h[2] * (1 + lambda_o + pe_ndf_lambda(ndf, w)));
}

/* A product rule over the unit square that pe_ndf_sample fills slopes from.  Its u is a cubic of evenly spaced t, which
 * draws out the tails: of closed forms those of the radius, of tables both ends of both slopes. */
static double stretch(const pe_ndf *ndf, double t, double *u)
{
    if (ndf->kind == PE_NDF_TABLE) {
        *u = t * t * (3 - 2 * t);
        return 6 * t * (1 - t);
    }
    *u = 1 - (1 - t) * (1 - t) * (1 - t);
    return 3 * (1 - t) * (1 - t);
}

double pe_directional_albedo(const pe_ndf *ndf, const double o[3], int side)
{
    double lambda_o = pe_ndf_lambda(ndf, o), sum = 0, weights = 0;

    for (int k = 0; k < side * side; k++) {
        int row = k / side;
        double t = (k % side + 0.5) / side, u1, u2 = (row + 0.5) / side, h[3];
        double weight = stretch(ndf, t, &u1);

        if (ndf->kind == PE_NDF_TABLE)
            weight *= stretch(ndf, u2, &u2);
        pe_ndf_sample(ndf, u1, u2, h);
        sum += weight * albedo_of(ndf, o, lambda_o, h);
        weights += weight;
    }
    return sum / weights;
}
