/* maps.h - inside a set of maps. */
#ifndef PE_MAPS_H
#define PE_MAPS_H

#include "env.h"
#include "geodesic.h"
#include "prefenv.h"

#define PE_MAPS_FORMAT_VERSION 1
#define PE_MAPS_SIDE_MAX 8192
#define PE_MAPS_TEXELS_MAX ((size_t)1 << 28) /* of all images together: 3 GiB of floats */

struct pe_maps {
    pe_maps_info info;
    char *source_name, *ndf_name;
    pe_geodesic *geodesic; /* NULL for baseline */
    pe_grid grid;          /* directions of the images' texels */
    float *rgb;            /* images, one after the other */
};

/* Checks info's method, ndf, direction, normals and size; completes frequency and images; allocates the rest. */
pe_status pe_maps_create(const pe_maps_info *info, pe_maps **out, pe_error *error);

static inline size_t pe_maps_image_values(const pe_maps *maps)
{
    return 3 * (size_t)maps->info.width * (size_t)maps->info.height;
}

#endif
