/* suns.h - the few texels that outshine all others, drawn out of an environment as lights of their own.
 *
 * A sun of 33,000 in one texel makes a highlight whose shape changes with every degree of the surface's tilt, more than
 * interpolation between maps can follow.  As a light it costs one evaluation of D, and its highlight is exact. */
#ifndef PE_SUNS_H
#define PE_SUNS_H

#include "denominator.h"
#include "prefenv.h"
#include "vector.h"

#define PE_SUNS_MAX 32

typedef struct pe_suns {
    int count;
    double direction[PE_SUNS_MAX][3]; /* unit, in the world */
    double power[PE_SUNS_MAX][3];     /* radiance times solid angle */
    float axes[3][PE_SUNS_MAX];       /* direction once more: all x, all y, all z; 0 beyond count */
} pe_suns;

/* Adds one; there is room for PE_SUNS_MAX. */
void pe_suns_add_sun(pe_suns *suns, const double direction[3], const double power[3]);

/* Can lights be told apart from the maps of this surface at all? */
int pe_suns_possible(const pe_surface *surface);

/* The suns of env: none, or up to PE_SUNS_MAX texels beside which every other is dim, bright enough to matter in this
 * surface's lobe.  *rest is env with those texels black; the caller frees it.  fine: what env was shrunk from, which
 * knows better where the suns are; or env. */
pe_status pe_suns_draw_out(const pe_env *env, const pe_env *fine, const pe_surface *surface, pe_suns *suns,
                           pe_env **rest, pe_error *error);

/* Adds their part of Eq. 5's quotient for the viewer o of a surface of normal n, unit vectors of the world, with
 * o.n > 0: sum of power D(h) / W(o).  PE_WEIGHT_MICROFACET: of power D G2 F / (4 o.n).  direction: the brush's. */
void pe_suns_add(const pe_suns *suns, const pe_surface *surface, const pe_denominators *denominators,
                 const double direction[3], const double n[3], const double o[3], double rgb[3]);

#endif
