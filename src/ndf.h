/* ndf.h - what the filter wants to know of a normal distribution, and the inside of a measured one.
 *
 * All are densities P of slopes p = h_x / h_z and q = h_y / h_z: D(h) = P(p, q) / cos^4(theta_h), and the integral of P
 * over the plane, which is that of D cos over the hemisphere, is 1. */
#ifndef PE_NDF_H
#define PE_NDF_H

#include "prefenv.h"

/* exp(-x) with x beyond this counts as 0, in production and in truth alike: single precision would turn denormal.
 * Where no texel at all has weight, the lobe is far narrower than they are, and pe_bake and pe_exact show a mirror; a
 * lobe that is not quite so narrow shows the texel nearest to its middle. */
#define PE_LOBE_CUTOFF 55.0

/* P(p, q). */
double pe_ndf_slope_density(const pe_ndf *ndf, double p, double q);

/* The x of the exp(-x) in D at slopes p, q: Beckmann and Phong fall exponentially, the others do not (0). */
double pe_ndf_exponent(const pe_ndf *ndf, double p, double q);

/* tan(theta_h) beyond which D is below exp(-limit) of its greatest value: of Beckmann and Phong the exponential alone,
 * of a table what it holds.  INFINITY where D is nowhere so small: the tail of a GGX of width alpha ends at alpha^4 of
 * its greatest value. */
double pe_ndf_reach(const pe_ndf *ndf, double limit);

/* The width of the finest feature of D along t and along b: of closed forms their alphas. */
void pe_ndf_fineness(const pe_ndf *ndf, double width[2]);

/* Smith's Lambda of a direction above the surface, unit, tangent frame: of the microfacets that face it 1 / (1 +
 * Lambda) are seen.  Not of Phong: 0. */
double pe_ndf_lambda(const pe_ndf *ndf, const double w[3]);

/* h (unit, tangent frame) with density G1(o) max(o.h, 0) D(h) / (o.n) per steradian, o unit and above the surface: of
 * Beckmann and GGX.  Others: 0, and nothing is drawn. */
int pe_ndf_sample_visible(const pe_ndf *ndf, const double o[3], double u1, double u2, double h[3]);

/* ---- tables ---- */

enum { PE_NDF_LIMITS = 64 };

/* The samples stand in a frame of zeros, so that `row` = width + 2 floats a row: sample (x, y) is at
 * density[(y + 1) * row + x + 1], and the point (p, q) at ((p - p_min) / p_step + 1/2, (q - q_min) / q_step + 1/2). */
struct pe_ndf_table {
    char *name;
    int width, height, row;
    double p_min, q_min, p_step, q_step;
    float *density;
    float *row_sums;             /* of height + 1: what the rows above each hold, of 1 in all */
    float *sums;                 /* likewise within each row, of width + 1 each */
    double moments[3];           /* mean of p^2, p q and q^2 */
    float *masking;              /* what ndf_masking.c keeps */
    double alpha[2];             /* sqrt 2 times the root mean square of the slopes */
    double fineness[2];          /* root of the integral of P^2 over that of its derivative squared */
    double peak;                 /* D is nowhere above it */
    double reach[PE_NDF_LIMITS]; /* pe_ndf_reach for each whole limit */
};

double pe_ndf_table_density(const pe_ndf_table *table, double p, double q);
void pe_ndf_table_sample(const pe_ndf_table *table, double u1, double u2, double *p, double *q);

double pe_ndf_table_spread(const pe_ndf_table *table, double share);

/* Fills in `masking`; 0 if memory does not suffice. */
int pe_ndf_table_mask(pe_ndf_table *table);

#endif
