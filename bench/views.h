/* views.h - normals and viewers that measurements look at. */
#ifndef BENCH_VIEWS_H
#define BENCH_VIEWS_H

#include "prefenv.h"
#include "sequence.h"
#include "vector.h"

#include <math.h>

#define COSINE_MIN 0.15 /* of n.o */

static const double plus_y[3] = { 0, 1, 0 };

typedef struct view {
    pe_point point;
    double exact[3]; /* the truth */
} view;

/* View k of so many: normals evenly over the sphere, viewers by solid angle times cosine, as many as a sphere shows. */
static inline void place_view(int k, int views, pe_point *point)
{
    static const double here[2] = { 0.5, 0.5 }, there[2] = { 0.3, 0.7 };
    double a[2], b[2], z, radius2, up;
    pe_frame frame;

    pe_lattice_point(k, here, a);
    pe_lattice_point(views * 7 + 13 * k, there, b);
    z = 2 * a[0] - 1;
    *point = (pe_point){ .n = { sqrt(1 - z * z) * cos(2 * M_PI * a[1]), z, sqrt(1 - z * z) * sin(2 * M_PI * a[1]) } };
    radius2 = b[0] * (1 - COSINE_MIN * COSINE_MIN);
    up = sqrt(1 - radius2);
    pe_frame_make(point->n, plus_y, &frame);
    pe_frame_direction(
        &frame, (const double[3]){ sqrt(radius2) * cos(2 * M_PI * b[1]), sqrt(radius2) * sin(2 * M_PI * b[1]), up },
        point->o);
}

#endif
