/* denominator.c - see denominator.h.
 *
 * With dw = 4 (o.h) dh, W(o) is the mean of 4 (o.h) / cos(theta_h) over half vectors drawn with density D cos(theta_h),
 * those left out that send the light below the horizon.  Each is drawn with its opposite, (-x, -y, z), so that the
 * mean is exact to first order however few they are; but for tables, which need not hold both alike.
 *
 * Seen from above, W is 4 (o.n); toward the horizon it falls to W_h, within as narrow a rim as the lobe is narrow,
 * which no table holds.  With 2 a = W_h, 2 ((o.n) + sqrt((o.n)^2 + a^2)) does likewise; W by that is tabulated. */
#include "denominator.h"

#include "disc.h"
#include "filter.h"
#include "ndf.h"
#include "sequence.h"
#include "spline.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>

#define SIDE 48
#define NORMALS 2048

/* A sun whose half vector has a density below exp(-LIMIT) = 4e-11 of the greatest is not seen. */
#define LIMIT 24

struct pe_denominator {
    pe_disc disc;
    double farthest;
    double along, across; /* a for viewers at the horizon, along t and along b */
    float coefficients[SIDE * SIDE];
};

typedef double direction[3];

static double weigh(const double h[3], const double o[3])
{
    double o_h = pe_dot(o, h);

    return o_h > 0 && 2 * o_h * h[2] > o[2] ? 4 * o_h / h[2] : 0;
}

/* Of a distribution that leans to one side there are viewers who see no normal at all: nothing is reflected there,
 * which is what remains of anything over this. */
#define WEIGHT_MIN 1e-6

static double divisor(double weight)
{
    return weight > WEIGHT_MIN ? weight : (double)INFINITY;
}

static double mean_weight(const direction *h, const double o[3])
{
    double sum = 0;

    for (int k = 0; k < NORMALS; k++)
        sum += weigh(h[k], o);
    return sum / NORMALS;
}

static void draw(const pe_ndf *ndf, direction *h)
{
    static const double middle[2] = { 0.5, 0.5 };
    int drawn = ndf->kind == PE_NDF_TABLE ? NORMALS : NORMALS / 2;

    for (int k = 0; k < drawn; k++) {
        double point[2];

        pe_lattice_point(k, middle, point);
        pe_ndf_sample(ndf, point[0], point[1], h[k]);
    }
    for (int k = drawn; k < NORMALS; k++) {
        h[k][0] = -h[k - drawn][0];
        h[k][1] = -h[k - drawn][1];
        h[k][2] = h[k - drawn][2];
    }
}

double pe_denominator_of(const pe_ndf *ndf, const double o[3])
{
    direction h[NORMALS];

    draw(ndf, h);
    return divisor(mean_weight(h, o));
}

/* a^2 goes around as that of an ellipse, which it is for distributions that are stretched. */
static double approximate(const pe_denominator *denominator, const double o[3])
{
    double x = denominator->along * o[0], y = denominator->across * o[1];

    return 2 * (o[2] + sqrt(o[2] * o[2] + x * x + y * y));
}

/* Half of what viewers at the horizon see from either side, who may see nothing. */
static double at_horizon(const direction *h, double x, double y)
{
    double here = mean_weight(h, (const double[3]){ x, y, 0 }), there = mean_weight(h, (const double[3]){ -x, -y, 0 });

    return fmax((here + there) / 4, WEIGHT_MIN);
}

/* Texels beyond the horizon carry on with the horizon's. */
static void fill(const direction *h, pe_denominator *denominator)
{
    denominator->along = at_horizon(h, 1, 0);
    denominator->across = at_horizon(h, 0, 1);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            double o[3] = { 0, 0, 1 };

            if (!pe_disc_direction(&denominator->disc, x, y, o)) {
                o[0] = x + 0.5 - SIDE / 2.0;
                o[1] = y + 0.5 - SIDE / 2.0;
                o[2] = 0;
                pe_normalize(o, o);
            }
            denominator->coefficients[y * SIDE + x] = (float)(mean_weight(h, o) / approximate(denominator, o));
        }
    pe_spline_coefficients(denominator->coefficients, SIDE, SIDE, 1);
}

pe_status pe_denominator_make(const pe_ndf *ndf, pe_denominator **out, pe_error *error)
{
    pe_denominator *denominator = malloc(sizeof *denominator);
    direction *h = malloc(NORMALS * sizeof *h);
    double reach;

    if (!denominator || !h) {
        free(denominator);
        free(h);
        return pe_fail_memory(error, "the weights of a lobe");
    }
    denominator->disc = (pe_disc){ SIDE, SIDE };
    reach = pe_ndf_reach(ndf, LIMIT);
    denominator->farthest = 1 + reach * reach;
    draw(ndf, h);
    fill(h, denominator);
    free(h);
    *out = denominator;
    return PE_OK;
}

void pe_denominator_free(pe_denominator *denominator)
{
    free(denominator);
}

double pe_denominator_at(const pe_denominator *denominator, const double o[3])
{
    const float toward[3] = { (float)o[0], (float)o[1], (float)o[2] };
    pe_disc_taps taps;
    double sum = 0;

    pe_disc_taps_at(&denominator->disc, toward, &taps);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++)
            sum += (double)(taps.down[j] * taps.across[i] *
                            denominator->coefficients[(taps.y + j - 1) * SIDE + taps.x + i - 1]);
    return divisor(sum * approximate(denominator, o));
}

double pe_denominator_farthest(const pe_denominator *denominator)
{
    return denominator->farthest;
}

void pe_denominators_add(pe_denominators *d, const pe_denominator *denominator, double share)
{
    if (!denominator)
        return;
    d->of[d->count] = denominator;
    d->shares[d->count++] = share;
    d->farthest = fmax(d->farthest, denominator->farthest);
}

double pe_denominators_at(const pe_denominators *d, const double o[3])
{
    double sum = 0;

    for (int k = 0; k < d->count; k++)
        sum += d->shares[k] * pe_denominator_at(d->of[k], o);
    return sum;
}
