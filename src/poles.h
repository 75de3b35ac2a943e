/* poles.h - the normals about a brush direction, where tangents turn fast from each normal to the next: two caps. */
#ifndef PE_POLES_H
#define PE_POLES_H

#include "geodesic.h"
#include "prefenv.h"

typedef struct pe_poles {
    int count;     /* of vertices in the caps */
    int *vertices; /* in rising order */
    int *ranks;    /* of every vertex: its place among those in the caps, or -1; NULL if there are none */
} pe_poles;

/* The vertices n with |n . direction| > cosine; direction need not be unit. */
pe_status pe_poles_make(const pe_geodesic *g, const double direction[3], double cosine, pe_poles *poles,
                        pe_error *error);
void pe_poles_free(pe_poles *poles);

/* How many vertices those are of the geodesic sphere of this frequency. */
pe_status pe_poles_count(int frequency, const double direction[3], double cosine, int *count, pe_error *error);

#endif
