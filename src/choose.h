/* choose.h - how many normals, and how large a map, for a lobe and a tolerance. */
#ifndef PE_CHOOSE_H
#define PE_CHOOSE_H

#include "prefenv.h"

/* The relative error to aim at: what the options ask for, or what their quality means. */
double pe_wanted_error(const pe_bake_options *options);

/* What AUTO means for an environment of this size. */
pe_accuracy pe_choose_accuracy(pe_accuracy asked, int width, int height);

/* Completes info's normals, width and height for hemispheres, as far as they are 0, and the angles at its poles, for an
 * environment of info's source size: the least memory that should reach the error `aim`, and if none does within the
 * quality's budget, the least error within it. */
void pe_choose_hemispheres(const pe_bake_options *options, double aim, pe_maps_info *info);

/* The same for grades: completes how many there are, if the options do not say, and each one's normals, width, height
 * and angles at the poles: the least memory that should reach the error, or the least error within the budget. */
pe_status pe_choose_grades(const pe_bake_options *options, double aim, pe_maps_info *info, pe_maps_info *each,
                           pe_error *error);

/* A width and height for hemispheres whose splines follow the lobe to about a tenth of a percent. */
void pe_choose_fine_size(const pe_ndf *ndf, int *width, int *height);

#endif
