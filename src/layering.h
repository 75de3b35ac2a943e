/* layering.h - layers along an axis: which are about a place on it, and their shares. */
#ifndef PE_LAYERING_H
#define PE_LAYERING_H

#include "spline.h"

#define PE_LAYERS_MIN 4
#define PE_LAYERS_MAX 64

/* Of `count` layers at 0, 1, 2, ... the four whose mixture is what a smooth curve through all shows at `place`, which
 * lies between the first and the last: Catmull and Rom's spline; beyond its ends the curve goes on as a parabola.
 * Returns the first of the four. */
static inline int pe_layering_weights(int count, float place, float weights[4])
{
    int at = (int)place < count - 2 ? (int)place : count - 2;
    float w[4];

    pe_interpolating_weights(place - (float)at, w);
    if (at == 0) { /* f(-1) = 3 f(0) - 3 f(1) + f(2) */
        weights[0] = w[1] + 3 * w[0];
        weights[1] = w[2] - 3 * w[0];
        weights[2] = w[3] + w[0];
        weights[3] = 0;
        return 0;
    }
    if (at == count - 2) {
        weights[0] = 0;
        weights[1] = w[0] + w[3];
        weights[2] = w[1] - 3 * w[3];
        weights[3] = w[2] + 3 * w[3];
        return count - 4;
    }
    for (int k = 0; k < 4; k++)
        weights[k] = w[k];
    return at - 1;
}

#endif
