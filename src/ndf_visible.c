/* ndf_visible.c - the normals that a viewer sees of a rough surface, drawn. [Heitz], [Heitz 2018], [Dupuy]
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
 * that from x = -c / s on has a closed form, whose inverse has none: Newton's steps, kept in by halving. */

enum { STEPS = 60 };

#define FARTHEST 6.0 /* exp(-36) = 2e-16 */

static double share_below(double c, double s, double least, double x)
{
    return c / 2 * (erf(x) - erf(least)) + s / (2 * sqrt(M_PI)) * (exp(-least * least) - exp(-x * x));
}

static double beckmann_slope(double c, double s, double u)
{
    double low = c < FARTHEST * s ? -c / s : -FARTHEST, high = FARTHEST, least = low, x = 0;
    double wanted = u * share_below(c, s, least, high);

    for (int k = 0; k < STEPS && high - low > 1e-13; k++) {
        double off = share_below(c, s, least, x) - wanted, slope = (c + s * x) * exp(-x * x) / sqrt(M_PI);

        if (off > 0)
            high = x;
        else
            low = x;
        if (fabs(off) <= 1e-15)
            break;
        x -= off / slope;
        if (!(x > low && x < high))
            x = (low + high) / 2;
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
        double along, across = beckmann_slope(1, 0, u2), x = 1, y = 0;

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
