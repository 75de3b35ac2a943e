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
