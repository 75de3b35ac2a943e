/* weights.h - what each voxel of a multi-scale environment map gathers from which vertex of which dome: a table that
 * depends on the geometry alone, made once for any number of environments. [Okumura 2.4, Table 1, Eq. 14]
 *
 * Voxels that are images of each other - see dome.h - share their weights, and one in 24 stands for all. */
#ifndef PE_WEIGHTS_H
#define PE_WEIGHTS_H

#include "dome.h"
#include "parallel.h"
#include "pyramid.h"

#include <stdint.h>

#define PE_DOMES 5
#define PE_WEIGHTS_VERSION 1

typedef struct pe_voxel {
    unsigned char at[3]; /* x, y, z, from 0 to size - 1 */
    unsigned char dome;
} pe_voxel;

typedef struct pe_weights {
    pe_smoothness scale;
    double threshold;
    pe_dome domes[PE_DOMES]; /* the first ones may be empty: not asked */
    size_t count;
    pe_voxel *voxels;
    float *kept;      /* what part of each voxel's whole weight is in the table */
    uint64_t *first;  /* of each voxel's entries, and the end of all */
    uint32_t *vertex; /* entries: a vertex of the voxel's dome, and its weight; the weights of a voxel add up to 1 */
    float *weight;
} pe_weights;

/* scale whole and checked, threshold in [0, 1). */
pe_status pe_weights_make(const pe_smoothness *scale, double threshold, int threads, const pe_report *report,
                          pe_weights **out, pe_error *error);
void pe_weights_free(pe_weights *weights); /* NULL is allowed */

/* Bytes of the table in memory and in a file. */
size_t pe_weights_bytes(const pe_weights *weights);

/* A file of a table: see weights_file.c.  The file appears whole or not at all. */
pe_status pe_weights_write(const pe_weights *weights, const char *path, pe_error *error);
pe_status pe_weights_read(const char *path, pe_weights **out, pe_error *error);
void pe_weights_seal(unsigned char *bytes, size_t size); /* puts the sum right that a file ends with */
pe_status pe_weights_read_memory(const void *bytes, size_t size, const char *name, pe_weights **out, pe_error *error);

/* Inside: the voxels that stand for all and their domes, without entries. */
pe_status pe_weights_make_voxels(const pe_smoothness *scale, double threshold, pe_weights **out, pe_error *error);

/* From the cube's centre to a voxel's, in half edges of the cube: length lambda. */
static inline void pe_voxel_centre(int size, const int at[3], double t[3])
{
    for (int c = 0; c < 3; c++)
        t[c] = (2 * at[c] + 1) / (double)size - 1;
}

/* A lookup within the sphere takes no voxel farther out than this. */
static inline double pe_voxel_reach(int size)
{
    return 1 + 2 * 1.7320508075688772 / size;
}

#endif
