/* ndf_visible.c - the normals that a viewer sees of a rough surface, drawn. [Heitz], [Heitz 2018], [Dupuy], [Giles]
 *
 * Of the microfacets of normal h the viewer o sees the share G1(o) max(o.h, 0) D(h) / (o.n), which is a density over
 * h.  In the plane of slopes p = h_x / h_z, q = h_y / h_z it is P(p, q) max(o_z + o_x p + o_y q, 0) over its integral
 * o_z (1 + Lambda).  Stretched distributions are drawn at width 1, from the viewer (ax o_x, ay o_y, o_z), and their
 * slopes stretched afterwards. */
#include "ndf.h"
#include "vector.h"

#include <math.h>

/* ---- Beckmann ----
 *
 * At width 1, P = exp(-p^2) exp(-q^2) / pi: across the viewer's direction the slope is normal; along it, its density is
 * in proportion to max(c + s x, 0) exp(-x^2), c and s the cosine and sine of the viewer's polar angle.  The integral of
 * that from x = -c / s on has a closed form, whose inverse has none: Halley's steps, kept in by halving.  One or two
 * leave an error of 4e-10; near the horizon it may take three. */

enum { STEPS = 60 };

#define FARTHEST 6.0 /* exp(-36) = 2e-16 */
#define NEAR 1e-3    /* a step of that leaves its third power */

/* The normal quantile, erf^-1(2 u - 1), but for 4e-7. [Giles] */
static double normal_slope(double u)
{
    static const double middle[] = { 2.81022636e-08, 3.43273939e-07, -3.5233877e-06, -4.39150654e-06, 0.00021858087,
                                     -0.00125372503, -0.00417768164, 0.246640727,    1.50140941 };
    static const double tail[] = { -0.000200214257, 0.000100950558, 0.00134934322, -0.00367342844, 0.00573950773,
                                   -0.0076224613,   0.00943887047,  1.00167406,    2.83297682 };
    double w = -log(fmax(4 * u * (1 - u), 1e-16)), sum = 0;
    const double *series = w < 5 ? middle : tail;

    w = w < 5 ? w - 2.5 : sqrt(w) - 3;
    for (int k = 0; k < 9; k++)
        sum = sum * w + series[k];
    return sum * (2 * u - 1);
}

/* Where Halley's steps begin: the quantile's series in s / c, or a mean of the inverses at s = 0 and c = 0. */
static double first_slope(double c, double s, double u)
{
    double x = normal_slope(u), t = s / c;

    if (2 * s < c)
        return x + t / 2 - x * t * t / 4;
    return c * x + s * sqrt(-log(fmax(1 - u, 1e-16)));
}

static double beckmann_slope(double c, double s, double u)
{
    double least = c < FARTHEST * s ? -c / s : -FARTHEST, low = least, high = FARTHEST, above = s / sqrt(M_PI);
    double erf_least = least > -FARTHEST ? erf(least) : -1, exp_least = least > -FARTHEST ? exp(-least * least) : 0;
    double wanted = u * (c * (1 - erf_least) + above * exp_least), x = first_slope(c, s, u);

    for (int k = 0; k < STEPS && high - low > 1e-12; k++) {
        double density, off, step;

        if (!(x > low && x < high))
            x = (low + high) / 2;
        density = exp(-x * x);
        off = c * (erf(x) - erf_least) + above * (exp_least - density) - wanted;
        density *= 2 / sqrt(M_PI) * (c + s * x);
        if (off > 0)
            high = x;
        else
            low = x;
        step = off / density;
        step /= fmax(1 - step * (s / (c + s * x) - 2 * x) / 2, 0.5);
        x -= step;
        if (fabs(step) < NEAR * fmin(x - least, 1))
            break;
    }
    return x;
}

/* ---- GGX ----
 *
 * At width 1, the half vectors of mirrored rays that a viewer o sees are those towards the directions of the sphere's
 * cap z > -o_z, evenly spread.  [Dupuy] */
static void ggx_normal(const double o[3], double u1, double u2, double h[3])
{
    double z = (1 - u1) * (1 + o[2]) - o[2], radius = sqrt(fmax(1 - z * z, 0)), angle = 2 * M_PI * u2;

    h[0] = radius * cos(angle) + o[0];
    h[1] = radius * sin(angle) + o[1];
    h[2] = z + o[2];
}

int pe_ndf_sample_visible(const pe_ndf *ndf, const double o[3], double u1, double u2, double h[3])
{
    double viewer[3] = { ndf->alpha_x * o[0], ndf->alpha_y * o[1], o[2] }, sine;

    if (ndf->kind != PE_NDF_BECKMANN && ndf->kind != PE_NDF_GGX)
        return 0;
    pe_normalize(viewer, viewer);
    if (ndf->kind == PE_NDF_GGX) {
        ggx_normal(viewer, u1, u2, h);
    } else {
        double along, across = normal_slope(u2), x = 1, y = 0;

        sine = hypot(viewer[0], viewer[1]);
        if (sine > 0) {
            x = viewer[0] / sine;
            y = viewer[1] / sine;
        }
        along = beckmann_slope(viewer[2], sine, u1);
        h[0] = along * x - across * y;
        h[1] = along * y + across * x;
        h[2] = 1;
    }
    h[0] *= ndf->alpha_x;
    h[1] *= ndf->alpha_y;
    if (!(h[2] > 0))
        h[2] = 1e-12;
    pe_normalize(h, h);
    return 1;
}
