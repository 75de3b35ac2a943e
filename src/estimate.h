/* estimate.h - how far baked maps are from the exact ones. */
#ifndef PE_ESTIMATE_H
#define PE_ESTIMATE_H

#include "lobe.h"
#include "maps.h"
#include "parallel.h"

/* Completes the info of finished maps.  error_estimate, unless they are exact: the relative L2 error of their texels
 * with n.r > 0.15 against [Motegi Eq. 5] over every texel of env, the root of sum |baked - exact|^2 / sum |exact|^2
 * over a fixed, even choice of about two thousand.  lookup_error, of hemispheres: the same of what is looked up for
 * normals anywhere. */
pe_status pe_estimate_errors(const pe_env *env, pe_maps *maps, const pe_lobe *lobe, int threads, pe_report *report,
                             pe_error *error);

/* error_estimate alone, of hemispheres without suns. */
pe_status pe_estimate_texels(const pe_env *env, pe_maps *maps, const pe_lobe *lobe, int threads, pe_error *error);

/* Sums of squares of what is looked up, off the truth and in truth. */
typedef struct pe_estimate {
    double error2, norm2;
} pe_estimate;

#define PE_ESTIMATE_FRAMES 96

/* Of maps of grades: lookups for normals anywhere and of any roughness, evenly spread over their range, whose nearest
 * grade is the given one.  The sums of all grades belong together.  The report counts to PE_ESTIMATE_FRAMES. */
pe_status pe_estimate_grade(const pe_env *env, const pe_maps *maps, int grade, int threads, pe_report *report,
                            pe_estimate *sum, pe_error *error);

#endif
