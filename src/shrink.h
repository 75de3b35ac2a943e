/* shrink.h - an environment no finer than a lobe can tell: what is beyond costs time and changes nothing. */
#ifndef PE_SHRINK_H
#define PE_SHRINK_H

#include "env.h"

/* The environment halved again and again, each texel the mean radiance of four by solid angle, while its texels stay
 * narrower than `pitch` in radians and its sides are even.  *out is NULL if it is coarse enough as it is; else the
 * caller frees it. */
pe_status pe_env_shrink(const pe_env *env, double pitch, pe_env **out, pe_error *error);

/* The luminance-weighted mean direction, unit, of the texels of `fine` from which texel (x, y) of `env` was shrunk. */
void pe_shrunk_direction(const pe_env *env, const pe_env *fine, int x, int y, double direction[3]);

#endif
