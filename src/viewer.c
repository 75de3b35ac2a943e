/* viewer.c - a surface point and who looks at it. */
#include "viewer.h"

#include "ndf.h"
#include "sequence.h"
#include "surface.h"

#include <string.h>

static const double plus_y[3] = { 0, 1, 0 };

void pe_viewer_make(const pe_surface *surface, const double direction[3], const double n[3], const double o[3],
                    pe_viewer *viewer)
{
    double unit_n[3], unit_o[3];

    pe_normalize_any(n, unit_n);
    pe_normalize_any(o, unit_o);
    if (pe_dot(unit_n, unit_o) < 0)
        pe_scale(-1, unit_n, unit_n);
    pe_frame_make(unit_n, pe_dot(direction, direction) > 0 ? direction : plus_y, &viewer->frame);
    pe_frame_coordinates(&viewer->frame, unit_o, viewer->o);
    viewer->lambda = 0;
    if (surface->weight == PE_WEIGHT_MICROFACET) {
        viewer->o[2] = fmax(viewer->o[2], PE_HORIZON); /* seen from the horizon itself, Lambda is infinite */
        viewer->lambda = pe_ndf_lambda(&surface->ndf, viewer->o);
    }
}

double pe_viewer_weight(const pe_surface *surface, const pe_viewer *v, const double w[3], double reflectance[3])
{
    double h[3] = { v->o[0] + w[0], v->o[1] + w[1], v->o[2] + w[2] }, d;

    reflectance[0] = reflectance[1] = reflectance[2] = 1;
    if (!(pe_ndf_exponent(&surface->ndf, h[0] / h[2], h[1] / h[2]) <= PE_LOBE_CUTOFF))
        return 0;
    pe_normalize(h, h);
    d = pe_ndf_evaluate(&surface->ndf, h);
    if (surface->weight == PE_WEIGHT_NDF || !(d > 0))
        return d;
    for (int c = 0; c < 3; c++)
        reflectance[c] = pe_reflectance(surface->eta[c], surface->k[c], pe_dot(v->o, h));
    return d / (1 + v->lambda + pe_ndf_lambda(&surface->ndf, w));
}

void pe_viewer_offsets(const double a[3], const double b[3], double offsets[2])
{
    uint64_t state = 0;

    for (int c = 0; c < 3; c++) {
        uint64_t bits[2];

        memcpy(&bits[0], &a[c], sizeof bits[0]);
        memcpy(&bits[1], &b[c], sizeof bits[1]);
        for (int k = 0; k < 2; k++) {
            state ^= bits[k];
            state = pe_random_bits(&state);
        }
    }
    offsets[0] = pe_random_unit(&state);
    offsets[1] = pe_random_unit(&state);
}
