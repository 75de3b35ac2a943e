/* highlight.c - what a surface reflects of light sources that are too small to be in an environment.
 *
 * Eq. 4 is the sum over lights of D(h_j) L_j omega_j by that of D(h_j) omega_j.  One light of E = L omega adds D(h) E
 * to the first, and the second is the integral W(o) whatever the lights are.  [Motegi Eq. 4]  Microfacets reflect
 * D G2 F / (4 (o.n) (w.n)) of the irradiance E (w.n).  [Heitz]  Of Phong's lobe the integral is 2 pi / (Lambda + 1).
 * [Okumura Eq. 1, 3] */
#include "denominator.h"
#include "horizon.h"
#include "ndf.h"
#include "prefenv.h"
#include "status.h"
#include "surface.h"
#include "vector.h"
#include "viewer.h"

#include <stdlib.h>

struct pe_highlights {
    pe_surface surface;
    pe_denominator *denominator; /* of PE_WEIGHT_NDF, else NULL */
};

pe_status pe_highlights_make(const pe_surface *surface, pe_highlights **out, pe_error *error)
{
    pe_status status = pe_surface_check(surface, error);
    pe_highlights *highlights;

    if (status != PE_OK)
        return status;
    highlights = malloc(sizeof *highlights);
    if (!highlights)
        return pe_fail_memory(error, "a surface's highlights");
    *highlights = (pe_highlights){ *surface, NULL };
    if (surface->weight == PE_WEIGHT_NDF)
        status = pe_denominator_make(&surface->ndf, &highlights->denominator, error);
    if (status != PE_OK)
        pe_highlights_free(highlights);
    else
        *out = highlights;
    return status;
}

void pe_highlights_free(pe_highlights *highlights)
{
    if (highlights)
        pe_denominator_free(highlights->denominator);
    free(highlights);
}

/* The weight of a light, times F, and with PE_WEIGHT_MICROFACET over 4 (o.n), so that nothing is left to divide by.
 * 0 if the light is below the horizon. */
static double reflect(const pe_surface *surface, const pe_viewer *v, const double light[3], double rgb[3])
{
    double world[3], w[3], weight;

    pe_normalize_any(light, world);
    pe_frame_coordinates(&v->frame, world, w);
    rgb[0] = rgb[1] = rgb[2] = 0;
    if (!(w[2] > PE_HORIZON))
        return 0;
    weight = pe_viewer_weight(surface, v, w, rgb);
    pe_scale(surface->weight == PE_WEIGHT_MICROFACET ? weight / (4 * v->o[2]) : weight, rgb, rgb);
    return weight;
}

void pe_highlight(const pe_highlights *highlights, const double direction[3], const double n[3], const double o[3],
                  const double light[3], double rgb[3])
{
    pe_viewer v;

    pe_viewer_make(&highlights->surface, direction, n, o, &v);
    if (reflect(&highlights->surface, &v, light, rgb) > 0 && highlights->denominator)
        pe_scale(1 / pe_denominator_at(highlights->denominator, v.o), rgb, rgb);
}

void pe_highlight_once(const pe_surface *surface, const double direction[3], const double n[3], const double o[3],
                       const double light[3], double rgb[3])
{
    pe_viewer v;

    pe_viewer_make(surface, direction, n, o, &v);
    if (reflect(surface, &v, light, rgb) > 0 && surface->weight == PE_WEIGHT_NDF)
        pe_scale(1 / pe_denominator_of(&surface->ndf, v.o), rgb, rgb);
}

double pe_phong_highlight(double exponent, pe_horizon horizon, const double n[3], const double r[3],
                          const double light[3])
{
    double unit[3], mirror[3], normal[3], cosine, share = 1;

    pe_normalize_any(light, unit);
    pe_normalize_any(r, mirror);
    cosine = pe_dot(mirror, unit);
    if (!(cosine > 0))
        return 0;
    if (horizon != PE_HORIZON_IGNORED) {
        pe_normalize_any(n, normal);
        if (!(pe_dot(normal, unit) > PE_HORIZON))
            return 0;
        if (horizon == PE_HORIZON_MEAN)
            share = pe_visible_share(exponent, pe_dot(normal, mirror));
    }
    return pow(cosine, exponent) * (exponent + 1) / (2 * M_PI * share);
}
