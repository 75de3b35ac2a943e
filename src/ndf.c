/* ndf.c - distributions of microscopic normals: evaluate and sample.
 *
 * Beckmann of slopes p = tan(theta_h) cos(phi_h), q = tan(theta_h) sin(phi_h): [Motegi Eq. 6]. */
#include "status.h"

#include <math.h>

pe_status pe_ndf_check(const pe_ndf *ndf, pe_error *error)
{
    if (ndf->kind != PE_NDF_BECKMANN)
        return pe_fail(error, PE_ERROR_ARGUMENT, "ndf: kind %d is not known; beckmann is", (int)ndf->kind);
    if (!(ndf->alpha_x >= PE_ALPHA_MIN && ndf->alpha_x <= PE_ALPHA_MAX && ndf->alpha_y >= PE_ALPHA_MIN &&
          ndf->alpha_y <= PE_ALPHA_MAX))
        return pe_fail(error, PE_ERROR_ARGUMENT, "alpha %g, %g is out of range; each lies between %g and %g",
                       ndf->alpha_x, ndf->alpha_y, PE_ALPHA_MIN, PE_ALPHA_MAX);
    return PE_OK;
}

pe_status pe_surface_check(const pe_surface *surface, pe_error *error)
{
    if (surface->weight != PE_WEIGHT_NDF)
        return pe_fail(error, PE_ERROR_ARGUMENT, "weight: kind %d is not known; ndf is", (int)surface->weight);
    return pe_ndf_check(&surface->ndf, error);
}

double pe_ndf_evaluate(const pe_ndf *ndf, const double h[3])
{
    double p, q, cos2;

    if (!(h[2] > 0))
        return 0;
    p = h[0] / h[2] / ndf->alpha_x;
    q = h[1] / h[2] / ndf->alpha_y;
    cos2 = h[2] * h[2];
    return exp(-(p * p + q * q)) / (M_PI * ndf->alpha_x * ndf->alpha_y * cos2 * cos2);
}

/* D cos(theta_h) d(omega_h) is a Gaussian of the slopes: exp(-(p/ax)^2 - (q/ay)^2) / (pi ax ay) dp dq, so the squared
 * radius of (p/ax, q/ay) is exponential and its angle uniform. */
void pe_ndf_sample(const pe_ndf *ndf, double u1, double u2, double h[3])
{
    double radius = sqrt(-log1p(-u1)), angle = 2 * M_PI * u2;
    double p = ndf->alpha_x * radius * cos(angle), q = ndf->alpha_y * radius * sin(angle);
    double cos_theta = 1 / sqrt(1 + p * p + q * q);

    h[0] = p * cos_theta;
    h[1] = q * cos_theta;
    h[2] = cos_theta;
}
