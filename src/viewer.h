/* viewer.h - a surface point and who looks at it, in the point's tangent frame: where every exact answer starts. */
#ifndef PE_VIEWER_H
#define PE_VIEWER_H

#include "prefenv.h"
#include "vector.h"

/* The viewer o is unit and above the surface. */
typedef struct pe_viewer {
    pe_frame frame;
    double o[3];   /* tangent coordinates */
    double lambda; /* of o, for PE_WEIGHT_MICROFACET */
} pe_viewer;

/* n, o and the brush's direction in the world, of any length; n is turned to face o. */
void pe_viewer_make(const pe_surface *surface, const double direction[3], const double n[3], const double o[3],
                    pe_viewer *viewer);

/* The weight D(h) of a light in the direction w, unit, in tangent coordinates, above the surface; with
 * PE_WEIGHT_MICROFACET times G2.  And its reflectance F, else 1. */
double pe_viewer_weight(const pe_surface *surface, const pe_viewer *viewer, const double w[3], double reflectance[3]);

/* Two offsets in [0, 1) that depend on two vectors' bits alone. */
void pe_viewer_offsets(const double a[3], const double b[3], double offsets[2]);

#endif
