/* layers.h - roughness as layers, from the smoothest to the roughest, evenly spaced in the logarithm of the exponent:
 * each a lat-long picture of what Phong's lobe gathers, as fine as its lobe needs. */
#ifndef PE_LAYERS_H
#define PE_LAYERS_H

#include "maps.h"
#include "parallel.h"

/* Fills all layers. */
pe_status pe_fill_layers(const pe_env *env, int threads, const pe_report *report, pe_maps *maps, pe_error *error);

/* The same by pe_phong, every texel of the environment for every texel of the layers. */
pe_status pe_fill_layers_exactly(const pe_env *env, int threads, const pe_report *report, pe_maps *maps);

#endif
