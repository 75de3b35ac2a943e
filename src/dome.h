/* dome.h - an environment on the vertices of a geodesic sphere, 24 times over: as it is, and as each of the turns and
 * mirrorings shows it that bring both a cube and an icosahedron onto themselves. [Okumura 2.4]
 *
 * These map (x, y, z) to itself, (y, z, x) or (z, x, y), with any of the three signs changed.  What a voxel of a cube
 * gathers from a vertex has the same weight for the 24 images of both: worked out once, it is applied to all side by
 * side. */
#ifndef PE_DOME_H
#define PE_DOME_H

#include "env.h"
#include "geodesic.h"

#define PE_DOME_IMAGES 24
#define PE_DOME_VALUES 80 /* of a vertex: three for each of its images, and some to fill vectors of 16 */

typedef struct pe_dome {
    int count;
    pe_geodesic *sphere;
    int *from_top;                      /* the vertices, the greatest y first */
    unsigned (*images)[PE_DOME_IMAGES]; /* of each vertex, where it comes to lie */
} pe_dome;

pe_status pe_dome_make(int frequency, pe_dome *dome, pe_error *error);
void pe_dome_free(pe_dome *dome);

/* How far vertices of a sphere of that frequency are from each other, on average, in radians. */
double pe_dome_pitch(int frequency);

/* Image g of a place in a cube whose coordinates count from 0 to side - 1. */
static inline void pe_dome_image(int g, int side, const int at[3], int image[3])
{
    for (int c = 0; c < 3; c++) {
        int coordinate = at[(c + g / 8) % 3];

        image[c] = g >> c & 1 ? side - 1 - coordinate : coordinate;
    }
}

/* What the environment shows at all vertices: PE_DOME_VALUES floats of each. */
void pe_dome_fill(const pe_dome *dome, const pe_env *env, int threads, float *values);

#endif
