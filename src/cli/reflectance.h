/* reflectance.h - what the options say of the surface: --ndf, --alpha, --aspect, --weight, --material, --ior, --k. */
#ifndef CLI_REFLECTANCE_H
#define CLI_REFLECTANCE_H

#include "prefenv.h"

/* As the options fill it; zeros: not given. */
typedef struct cli_surface {
    const char *ndf;
    double alpha[3]; /* along; across, 0: as along; and where a range ends, which is of those along */
    double aspect;
    int weight;
    const char *material;
    double eta[3], k[3];
} cli_surface;

/* The surface asked for.  *table is what it was measured as, to be freed when the surface is no longer used, or NULL.
 * CLI_FAILURE, with its error printed, if there is no such surface. */
int cli_make_surface(const char *command, const cli_surface *asked, pe_surface *surface, pe_ndf_table **table);

#endif
