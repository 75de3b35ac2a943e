/* multiscale.h - maps of many roughnesses: what is decided beforehand, what is kept between environments, and the
 * bake. [Okumura] */
#ifndef PE_MULTISCALE_H
#define PE_MULTISCALE_H

#include "maps.h"

typedef struct pe_multiscale pe_multiscale;

/* Checks the options and decides what they leave open: sizes of layers for the error `aim`.  Voxels: makes the table of
 * weights, or reads it. */
pe_status pe_multiscale_make(const pe_bake_options *options, double aim, int width, int height, pe_multiscale **out,
                             pe_error *error);
void pe_multiscale_free(pe_multiscale *m); /* NULL is allowed */

const pe_maps_info *pe_multiscale_get_info(const pe_multiscale *m);

/* As pe_baker_bake. */
pe_status pe_multiscale_bake(const pe_multiscale *m, const pe_env *env, const pe_bake_errors *known, pe_maps **out,
                             pe_error *error);

#endif
