/* sequence.h - points spread evenly over the unit square, for any number of them; and random bits. */
#ifndef PE_SEQUENCE_H
#define PE_SEQUENCE_H

#include <math.h>
#include <stdint.h>

/* Point k of the lattice of the plastic number, shifted by `offsets`: [Roberts]. */
static inline void pe_lattice_point(double k, const double offsets[2], double point[2])
{
    const double plastic = 1.32471795724474602596;

    point[0] = offsets[0] + k / plastic;
    point[1] = offsets[1] + k / (plastic * plastic);
    point[0] -= floor(point[0]);
    point[1] -= floor(point[1]);
}

/* Point k of `count`, which is known beforehand: the golden ratio one way, even steps the other, shifted likewise.  In
 * what a half plane takes off a lobe the lattice above errs 1.1 times as much with three points, 1.4 times with 16. */
static inline void pe_golden_point(int k, int count, const double offsets[2], double point[2])
{
    const double golden = 0.61803398874989484820;

    point[0] = offsets[0] + k * golden;
    point[1] = offsets[1] + (double)k / count;
    point[0] -= floor(point[0]);
    point[1] -= floor(point[1]);
}

/* The next of a sequence of 64 random bits. [SplitMix] */
static inline uint64_t pe_random_bits(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;

    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* The same as a number in [0, 1). */
static inline double pe_random_unit(uint64_t *state)
{
    return (double)(pe_random_bits(state) >> 11) * 0x1p-53;
}

#endif
