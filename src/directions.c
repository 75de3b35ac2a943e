/* directions.c - where a surface reflects the viewer's rays to, drawn: for renderers that trace them. [Motegi Eq. 4]
 *
 * Visible normals send the viewer's rays to w with density G1(o) D(h) / (4 o.n), G1 = 1 / (1 + Lambda(o)).  For Eq. 4,
 * which weighs w by D, all of them above the horizon count alike; microfacets, which reflect D G2 F / (4 o.n), count
 * F G2 / G1.  Where visible normals have no formula, all normals are drawn, with density D cos(theta_h), and w counts
 * (o.h) / cos(theta_h), and of microfacets F G2 / (o.n) times that: see truth.c. */
#include "ndf.h"
#include "prefenv.h"
#include "sequence.h"
#include "surface.h"
#include "vector.h"
#include "viewer.h"

#include <stdbool.h>

void pe_directions_begin(const pe_surface *surface, const double direction[3], const double n[3], const double o[3],
                         const double seed[3], pe_directions *directions)
{
    pe_viewer viewer;

    pe_viewer_make(surface, direction, n, o, &viewer);
    directions->surface = *surface;
    for (int c = 0; c < 3; c++) {
        directions->t[c] = viewer.frame.t[c];
        directions->b[c] = viewer.frame.b[c];
        directions->n[c] = viewer.frame.n[c];
        directions->o[c] = viewer.o[c];
    }
    directions->o[2] = fmax(directions->o[2], PE_HORIZON);
    directions->lambda = viewer.lambda;
    directions->visible = 0;
    if (surface->ndf.kind == PE_NDF_BECKMANN || surface->ndf.kind == PE_NDF_GGX)
        directions->visible = 1 / (1 + pe_ndf_lambda(&surface->ndf, directions->o));
    pe_viewer_offsets(seed, o, directions->offsets);
}

static void to_world(const pe_directions *d, const double local[3], double w[3])
{
    for (int c = 0; c < 3; c++)
        w[c] = local[0] * d->t[c] + local[1] * d->b[c] + local[2] * d->n[c];
}

/* The half vector at a point of the unit square; true if it is a visible normal. */
static bool draw_normal(const pe_directions *d, const double u[2], double h[3])
{
    if (pe_ndf_sample_visible(&d->surface.ndf, d->o, u[0], u[1], h))
        return true;
    pe_ndf_sample(&d->surface.ndf, u[0], u[1], h);
    return false;
}

/* As pe_directions_draw, at a point of the unit square. */
static double draw_at(const pe_directions *d, const double u[2], double w[3], double share[3])
{
    const pe_surface *surface = &d->surface;
    bool microfacet = surface->weight == PE_WEIGHT_MICROFACET, visible;
    double h[3], local[3] = { 0, 0, -1 }, o_h, weight = 1;

    visible = draw_normal(d, u, h);
    o_h = pe_dot(d->o, h);
    if (o_h > 0)
        pe_reflect(d->o, h, local);
    to_world(d, local, w);
    share[0] = share[1] = share[2] = 0;
    if (!(local[2] > PE_HORIZON))
        return microfacet ? 1 : 0;
    if (!visible)
        weight = o_h / h[2];
    if (!microfacet) {
        share[0] = share[1] = share[2] = weight;
        return weight;
    }
    weight *= visible ? 1 + d->lambda : 1 / d->o[2];
    weight /= 1 + d->lambda + pe_ndf_lambda(&surface->ndf, local);
    for (int c = 0; c < 3; c++)
        share[c] = weight * pe_reflectance(surface->eta[c], surface->k[c], o_h);
    return 1;
}

double pe_directions_draw(const pe_directions *d, int k, int count, double w[3], double share[3])
{
    double u[2];

    pe_golden_point(k, count, d->offsets, u);
    return draw_at(d, u, w, share);
}

double pe_directions_density(const pe_directions *d, const double w[3])
{
    double h[3] = { d->o[0] + pe_dot(d->t, w), d->o[1] + pe_dot(d->b, w), d->o[2] + pe_dot(d->n, w) }, density;

    if (!(h[2] > 0))
        return 0;
    pe_normalize(h, h);
    density = pe_ndf_evaluate(&d->surface.ndf, h) / 4;
    return d->visible > 0 ? density * d->visible / d->o[2] : density * h[2] / pe_dot(d->o, h);
}

/* ---- one alone ---- */

enum { CANDIDATES = 32, TRIES = 64 };

/* All directions above the horizon count alike: the first of them.  Of independent points, for of those of a lattice
 * the second depends on where the first was. */
static bool first_visible(const pe_directions *d, double w[3], double share[3])
{
    uint64_t state = (uint64_t)(d->offsets[0] * 0x1p53) ^ (uint64_t)(d->offsets[1] * 0x1p63);
    double u[2] = { d->offsets[0], d->offsets[1] };

    for (int k = 0; k < TRIES; k++) {
        if (draw_at(d, u, w, share) > 0)
            return true;
        u[0] = pe_random_unit(&state);
        u[1] = pe_random_unit(&state);
    }
    return false;
}

/* One of several by lot, each with a chance in proportion to what it counts: the first beyond a share of their sum. */
static bool choose_candidate(const pe_directions *d, double w[3], double share[3])
{
    double sum = 0, lot = d->offsets[0] * 7919;

    for (int k = 0; k < CANDIDATES; k++)
        sum += pe_directions_draw(d, k, CANDIDATES, w, share);
    lot = (lot - floor(lot)) * sum;
    for (int k = 0; k < CANDIDATES && sum > 0; k++) {
        lot -= pe_directions_draw(d, k, CANDIDATES, w, share);
        if (lot < 0)
            return true;
    }
    return false;
}

void pe_directions_one(const pe_directions *d, double w[3], double share[3])
{
    double mirror[3] = { -d->o[0], -d->o[1], d->o[2] };
    bool visible = d->surface.ndf.kind == PE_NDF_BECKMANN || d->surface.ndf.kind == PE_NDF_GGX;

    if (d->surface.weight == PE_WEIGHT_MICROFACET) {
        pe_directions_draw(d, 0, 1, w, share);
        return;
    }
    if (!(visible ? first_visible(d, w, share) : choose_candidate(d, w, share)))
        to_world(d, mirror, w);
    share[0] = share[1] = share[2] = 1;
}
