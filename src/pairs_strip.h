/* pairs_strip.h - pairs of normals' lat-long maps of several environments at once. */
#ifndef PE_PAIRS_STRIP_H
#define PE_PAIRS_STRIP_H

#include "hemispheres_strip.h"

/* What pe_fill_pairs_from_hemispheres makes of hemispheres of the kernel's size, which are made on the way; suns[k] are
 * frame k's and go into its images. */
pe_status pe_fill_pairs_of_strip(const pe_strip *strip, const pe_kernel *kernel, const pe_lobe *lobe,
                                 const pe_suns *suns, int threads, pe_report *report, pe_maps *const *maps,
                                 pe_error *error);

#endif
