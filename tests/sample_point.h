/* sample_point.h - pe_sample of a point that is given by its vectors. */
#ifndef SAMPLE_POINT_H
#define SAMPLE_POINT_H

#include "prefenv.h"

static inline void sample_point(const pe_maps *maps, const pe_sampling *sampling, const double *direction,
                                const double n[3], const double o[3], double rgb[3])
{
    const pe_point point = { { n[0], n[1], n[2] }, { o[0], o[1], o[2] }, direction, 0 };

    pe_sample(maps, sampling, &point, rgb);
}

#endif
