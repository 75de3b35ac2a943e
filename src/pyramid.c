/* pyramid.c - see pyramid.h. */
#include "pyramid.h"

#include "shrink.h"

#include <math.h>

static double texel_of(const pe_env *env)
{
    return 2 * M_PI / env->width;
}

pe_status pe_pyramid_make(const pe_env *env, double pitch, pe_pyramid *pyramid, pe_error *error)
{
    *pyramid = (pe_pyramid){ .count = 1, .levels = { env } };
    while (pyramid->count < PE_PYRAMID_LEVELS_MAX && 2 * texel_of(pyramid->levels[pyramid->count - 1]) <= pitch) {
        const pe_env *last = pyramid->levels[pyramid->count - 1];
        pe_env *half;
        pe_status status = pe_env_shrink(last, 2 * texel_of(last), &half, error);

        if (status != PE_OK) {
            pe_pyramid_free(pyramid);
            return status;
        }
        if (!half)
            break;
        pyramid->own[pyramid->count] = half;
        pyramid->levels[pyramid->count++] = half;
    }
    return PE_OK;
}

void pe_pyramid_free(pe_pyramid *pyramid)
{
    for (int k = 0; k < pyramid->count; k++)
        pe_env_free(pyramid->own[k]);
    pyramid->count = 0;
}

const pe_env *pe_pyramid_level(const pe_pyramid *pyramid, double pitch)
{
    const pe_env *best = pyramid->levels[0];

    for (int k = 1; k < pyramid->count; k++)
        if (texel_of(pyramid->levels[k]) <= pitch)
            best = pyramid->levels[k];
    return best;
}
