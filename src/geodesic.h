/* geodesic.h - geodesic spheres: representative normals in opposite pairs, and the triangle that holds a direction. */
#ifndef PE_GEODESIC_H
#define PE_GEODESIC_H

#include "prefenv.h"

#define PE_FREQUENCY_MAX 32       /* of the normals of maps */
#define PE_DOME_FREQUENCY_MAX 144 /* of what stands for an environment */

/* Vertices 2k and 2k + 1 are opposite: n[2k + 1] = -n[2k]. */
typedef struct pe_geodesic pe_geodesic;

/* A geodesic sphere whose icosahedron's edges are split in `frequency` in [1, PE_DOME_FREQUENCY_MAX]. */
pe_status pe_geodesic_make(int frequency, pe_geodesic **out, pe_error *error);
void pe_geodesic_free(pe_geodesic *g);

int pe_geodesic_count(const pe_geodesic *g); /* 10 f^2 + 2 */
const double *pe_geodesic_vertex(const pe_geodesic *g, int index);

/* What part of the sphere lies nearest to a vertex, about; of all vertices the sum is 1. */
double pe_geodesic_share(const pe_geodesic *g, int index);

/* The vertices of the triangle that holds the unit vector n, and its barycentric weights: n is a positive multiple of
 * sum_k weight[k] vertex[k], weights not negative and of sum 1. */
void pe_geodesic_locate(const pe_geodesic *g, const double n[3], int vertices[3], double weights[3]);

/* The f with 10 f^2 + 2 = count, or 0 if there is none. */
int pe_geodesic_frequency(int count);

#endif
