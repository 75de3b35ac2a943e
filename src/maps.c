/* maps.c - a set of maps in memory: made, described, released. */
#include "maps.h"

#include "status.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

static pe_status check_normals(int normals, pe_error *error)
{
    int below = 12, above = 0;

    if (pe_geodesic_frequency(normals))
        return PE_OK;
    for (int f = 1; f <= PE_FREQUENCY_MAX && !above; f++) {
        if (10 * f * f + 2 < normals)
            below = 10 * f * f + 2;
        else
            above = 10 * f * f + 2;
    }
    if (above && above != below && normals > 12)
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "normals %d is not 10 f^2 + 2 for a whole f from 1 to %d; the nearest are %d and %d", normals,
                       PE_FREQUENCY_MAX, below, above);
    return pe_fail(error, PE_ERROR_ARGUMENT,
                   "normals %d is not 10 f^2 + 2 for a whole f from 1 to %d; the nearest is %d", normals,
                   PE_FREQUENCY_MAX, below);
}

/* Of a table that is known by name only, whatever was measured will do. */
static pe_status check_surface(const pe_surface *surface, pe_error *error)
{
    pe_surface likely = *surface;

    if (surface->ndf.kind == PE_NDF_TABLE) {
        if (!(surface->ndf.alpha_x >= 0 && surface->ndf.alpha_y >= 0))
            return pe_fail(error, PE_ERROR_ARGUMENT, "alpha %g, %g of a table is below 0", surface->ndf.alpha_x,
                           surface->ndf.alpha_y);
        likely.ndf = (pe_ndf){ .alpha_x = 1, .alpha_y = 1 };
    }
    return pe_surface_check(&likely, error);
}

static pe_status check_info(pe_maps_info *info, pe_error *error)
{
    pe_status status = check_surface(&info->surface, error);

    if (status != PE_OK)
        return status;
    if (info->method != PE_METHOD_REPRESENTATIVE && info->method != PE_METHOD_BASELINE)
        return pe_fail(error, PE_ERROR_ARGUMENT, "method %d is not known", (int)info->method);
    for (int c = 0; c < 3; c++)
        if (!isfinite(info->direction[c]))
            return pe_fail(error, PE_ERROR_ARGUMENT, "direction is not finite");
    if (info->direction[0] == 0 && info->direction[1] == 0 && info->direction[2] == 0)
        return pe_fail(error, PE_ERROR_ARGUMENT, "direction has no length");
    if (info->width < 2 || info->height < 2 || info->width > PE_MAPS_SIDE_MAX || info->height > PE_MAPS_SIDE_MAX)
        return pe_fail(error, PE_ERROR_ARGUMENT, "size %d x %d is out of range; each side lies between 2 and %d",
                       info->width, info->height, PE_MAPS_SIDE_MAX);
    if (info->method == PE_METHOD_REPRESENTATIVE)
        status = check_normals(info->normals, error);
    if (status != PE_OK)
        return status;
    info->normals = info->method == PE_METHOD_REPRESENTATIVE ? info->normals : 0;
    info->frequency = pe_geodesic_frequency(info->normals);
    info->images = info->method == PE_METHOD_REPRESENTATIVE ? info->normals / 2 : 1;
    if ((size_t)info->width * (size_t)info->height > PE_MAPS_TEXELS_MAX / (size_t)info->images)
        return pe_fail(error, PE_ERROR_LIMIT,
                       "%d maps of %d x %d are more than can be held; make them fewer, or smaller than %zu texels each",
                       info->images, info->width, info->height, PE_MAPS_TEXELS_MAX / (size_t)info->images);
    return PE_OK;
}

static pe_status allocate(pe_maps *maps, const char *source_name, const char *ndf_name, pe_error *error)
{
    pe_status status = pe_grid_make(maps->info.width, maps->info.height, &maps->grid, error);

    if (status == PE_OK && maps->info.frequency)
        status = pe_geodesic_make(maps->info.frequency, &maps->geodesic, error);
    if (status != PE_OK)
        return status;
    maps->source_name = strdup(source_name ? source_name : "");
    maps->ndf_name = strdup(ndf_name ? ndf_name : "");
    maps->rgb = calloc((size_t)maps->info.images * pe_maps_image_values(maps), sizeof *maps->rgb);
    if (!maps->source_name || !maps->ndf_name || !maps->rgb)
        return pe_fail(error, PE_ERROR_MEMORY, "not enough memory for %d maps of %d x %d", maps->info.images,
                       maps->info.width, maps->info.height);
    maps->info.source_name = maps->source_name;
    maps->info.ndf_name = maps->ndf_name;
    return PE_OK;
}

pe_status pe_maps_create(const pe_maps_info *info, pe_maps **out, pe_error *error)
{
    pe_maps_info checked = *info;
    pe_status status = check_info(&checked, error);
    pe_maps *maps;

    if (status != PE_OK)
        return status;
    maps = calloc(1, sizeof *maps);
    if (!maps)
        return pe_fail_memory(error, "maps");
    maps->info = checked;
    maps->info.format_version = PE_MAPS_FORMAT_VERSION;
    status = allocate(maps, info->source_name, info->ndf_name, error);
    if (status != PE_OK) {
        pe_maps_free(maps);
        return status;
    }
    *out = maps;
    return PE_OK;
}

void pe_maps_free(pe_maps *maps)
{
    if (!maps)
        return;
    pe_geodesic_free(maps->geodesic);
    pe_grid_free(&maps->grid);
    free(maps->source_name);
    free(maps->ndf_name);
    free(maps->rgb);
    free(maps);
}

const pe_maps_info *pe_maps_get_info(const pe_maps *maps)
{
    return &maps->info;
}

const float *pe_maps_image(const pe_maps *maps, int k)
{
    return maps->rgb + (size_t)k * pe_maps_image_values(maps);
}

void pe_maps_normal(const pe_maps *maps, int k, double n[3])
{
    static const double up[3] = { 0, 1, 0 };

    memcpy(n, maps->geodesic ? pe_geodesic_vertex(maps->geodesic, 2 * k) : up, 3 * sizeof *n);
}
