/* sequence.h - points spread evenly over the unit square, for any number of them. */
#ifndef PE_SEQUENCE_H
#define PE_SEQUENCE_H

#include <math.h>

/* Point k of the lattice of the plastic number, shifted by `offsets`: [Roberts]. */
static inline void pe_lattice_point(double k, const double offsets[2], double point[2])
{
    const double plastic = 1.32471795724474602596;

    point[0] = offsets[0] + k / plastic;
    point[1] = offsets[1] + k / (plastic * plastic);
    point[0] -= floor(point[0]);
    point[1] -= floor(point[1]);
}

#endif
