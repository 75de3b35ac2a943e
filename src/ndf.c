/* ndf.c - distributions of microscopic normals: evaluate and sample.
 *
 * With slopes p = tan(theta_h) cos(phi_h), q = tan(theta_h) sin(phi_h), m^2 = p^2 + q^2 = tan^2(theta_h),
 * c = 1 + m^2 = 1 / cos^2(theta_h) and s = (p / ax)^2 + (q / ay)^2, each is D = P(p, q) c^2 with
 *
 *     Beckmann    P = exp(-s) / (pi ax ay)                       [Motegi Eq. 6]
 *     GGX         P = 1 / (pi ax ay (1 + s)^2)                   [Trowbridge], [Walter]; stretched as in [Heitz]
 *     Phong       P = c^-(K + 1) / (pi ax ay),  K = s / m^2      [Ashikhmin]
 *
 * Phong's D is N cos^e(theta_h), e = e_x cos^2(phi_h) + e_y sin^2(phi_h) and e_x = 2 / ax^2 - 2: then e + 2 = 2 K. */
#include "ndf.h"

#include "status.h"

#include <math.h>

static pe_status check_alphas(const pe_ndf *ndf, double most, const char *who, pe_error *error)
{
    if (!(ndf->alpha_x >= PE_ALPHA_MIN && ndf->alpha_x <= most && ndf->alpha_y >= PE_ALPHA_MIN && ndf->alpha_y <= most))
        return pe_fail(error, PE_ERROR_ARGUMENT, "alpha %g, %g is out of range%s; each lies between %g and %g",
                       ndf->alpha_x, ndf->alpha_y, who, PE_ALPHA_MIN, most);
    return PE_OK;
}

pe_status pe_ndf_check(const pe_ndf *ndf, pe_error *error)
{
    switch (ndf->kind) {
    case PE_NDF_BECKMANN:
    case PE_NDF_GGX:
        return check_alphas(ndf, PE_ALPHA_MAX, "", error);
    case PE_NDF_PHONG:
        return check_alphas(ndf, PE_PHONG_ALPHA_MAX, " for phong", error);
    case PE_NDF_TABLE:
        return ndf->table ? PE_OK : pe_fail(error, PE_ERROR_ARGUMENT, "ndf: a table is asked for and none is given");
    }
    return pe_fail(error, PE_ERROR_ARGUMENT, "ndf: kind %d is not known; beckmann, ggx, phong and table are",
                   (int)ndf->kind);
}

/* s of the slopes p, q. */
static double stretched(const pe_ndf *ndf, double p, double q)
{
    return p / ndf->alpha_x * (p / ndf->alpha_x) + q / ndf->alpha_y * (q / ndf->alpha_y);
}

double pe_ndf_exponent(const pe_ndf *ndf, double p, double q)
{
    double m2 = p * p + q * q;

    switch (ndf->kind) {
    case PE_NDF_BECKMANN:
        return stretched(ndf, p, q);
    case PE_NDF_PHONG:
        return m2 > 0 ? stretched(ndf, p, q) / m2 * log1p(m2) : 0;
    default:
        return 0;
    }
}

double pe_ndf_slope_density(const pe_ndf *ndf, double p, double q)
{
    double peak, s;

    if (ndf->kind == PE_NDF_TABLE)
        return pe_ndf_table_density(ndf->table, p, q);
    peak = 1 / (M_PI * ndf->alpha_x * ndf->alpha_y);
    if (ndf->kind == PE_NDF_GGX) {
        s = 1 + stretched(ndf, p, q);
        return peak / (s * s);
    }
    s = peak * exp(-pe_ndf_exponent(ndf, p, q));
    return ndf->kind == PE_NDF_PHONG ? s / (1 + p * p + q * q) : s;
}

double pe_ndf_evaluate(const pe_ndf *ndf, const double h[3])
{
    double cos2 = h[2] * h[2];

    if (!(h[2] > 0))
        return 0;
    return pe_ndf_slope_density(ndf, h[0] / h[2], h[1] / h[2]) / (cos2 * cos2);
}

/* D cos(theta_h) d(omega_h) = P dp dq.  Of Beckmann and GGX, s = (p/ax)^2 + (q/ay)^2 has the cumulative distributions
 * 1 - exp(-s) and s / (1 + s), and the angle of (p/ax, q/ay) is even.  Of Phong, that angle is even too: the density of
 * phi_h is proportional to 1 / K; and c has the cumulative distribution 1 - c^-K. */
void pe_ndf_sample(const pe_ndf *ndf, double u1, double u2, double h[3])
{
    double angle = 2 * M_PI * u2, p = ndf->alpha_x * cos(angle), q = ndf->alpha_y * sin(angle), radius = 0, cos_theta;

    switch (ndf->kind) {
    case PE_NDF_BECKMANN:
        radius = sqrt(-log1p(-u1));
        break;
    case PE_NDF_GGX:
        radius = sqrt(u1 / (1 - u1));
        break;
    case PE_NDF_PHONG: /* K = 1 / |(p, q)|^2 for the p, q above */
        radius = sqrt(expm1(-log1p(-u1) * (p * p + q * q)) / (p * p + q * q));
        break;
    case PE_NDF_TABLE:
        pe_ndf_table_sample(ndf->table, u1, u2, &p, &q);
        radius = 1;
        break;
    }
    p *= radius;
    q *= radius;
    cos_theta = 1 / sqrt(1 + p * p + q * q);
    h[0] = p * cos_theta;
    h[1] = q * cos_theta;
    h[2] = cos_theta;
}

/* GGX, with a = max(ax, ay): D / D(n) = ((1 + m^2) / (1 + s))^2 is at most ((1 + m^2) / (1 + m^2 / a^2))^2, which falls
 * from 1 to a^4; it is exp(-limit) where m^2 = (1 - e) / (e / a^2 - 1), e = exp(-limit / 2). */
double pe_ndf_reach(const pe_ndf *ndf, double limit)
{
    double a = fmax(ndf->alpha_x, ndf->alpha_y), e = exp(-limit / 2);

    switch (ndf->kind) {
    case PE_NDF_BECKMANN:
        return a * sqrt(limit);
    case PE_NDF_GGX:
        return e > a * a ? sqrt((1 - e) / (e / (a * a) - 1)) : INFINITY;
    case PE_NDF_PHONG:
        return sqrt(expm1(limit * a * a));
    case PE_NDF_TABLE:
        return ndf->table->reach[limit < PE_NDF_LIMITS - 1 ? (int)ceil(limit) : PE_NDF_LIMITS - 1];
    }
    return INFINITY;
}

double pe_ndf_spread(const pe_ndf *ndf, double share)
{
    double a = fmax(ndf->alpha_x, ndf->alpha_y);

    switch (ndf->kind) {
    case PE_NDF_BECKMANN:
        return atan(a * sqrt(-log(share)));
    case PE_NDF_GGX:
        return atan(a * sqrt(1 / share - 1));
    case PE_NDF_PHONG:
        return acos(pow(share, a * a / 2));
    case PE_NDF_TABLE:
        return pe_ndf_table_spread(ndf->table, share);
    }
    return M_PI / 2;
}

void pe_ndf_fineness(const pe_ndf *ndf, double width[2])
{
    width[0] = ndf->kind == PE_NDF_TABLE ? ndf->table->fineness[0] : ndf->alpha_x;
    width[1] = ndf->kind == PE_NDF_TABLE ? ndf->table->fineness[1] : ndf->alpha_y;
}
