/* maps_layers.c - the layers of maps of many roughnesses: what each stands for, its size and its spline. */
#include "globe.h"
#include "layering.h"
#include "maps.h"
#include "parallel.h"
#include "status.h"

#include <stdlib.h>

/* No layer is rougher: a lobe as wide as a hemisphere, beyond which there is nothing to see. */
#define EXPONENT_MIN 1.0

/* However rough, a lobe ends at a right angle, and has a crease there.  Multiples of this go well with environments'
 * sizes: src/layers.c. */
#define HEIGHT_MIN 16 /* half of PE_LAYER_WIDTH_MIN */

static double step_of(const pe_maps_info *info)
{
    return log(pe_smoothness_exponent(&info->smoothness, 1) / EXPONENT_MIN) / (info->images - 1);
}

pe_layer pe_layer_of(const pe_maps_info *info, int k)
{
    pe_layer layer = { .exponent = pe_smoothness_exponent(&info->smoothness, 1) * exp(-step_of(info) * k) };

    if (k == 0)
        layer.height = info->height;
    else
        layer.height = HEIGHT_MIN * (int)ceil(info->height * exp(-step_of(info) * k / 2) / HEIGHT_MIN - 1e-9);
    layer.width = 2 * layer.height;
    return layer;
}

double pe_layer_place(const pe_maps_info *info, double exponent)
{
    double place = log(pe_smoothness_exponent(&info->smoothness, 1) / fmax(exponent, EXPONENT_MIN)) / step_of(info);

    return fmin(fmax(place, 0), info->images - 1);
}

pe_status pe_layers_make(pe_maps *maps, pe_error *error)
{
    size_t offset = 0;

    maps->layers = calloc((size_t)maps->info.images, sizeof *maps->layers);
    if (!maps->layers)
        return pe_fail_memory(error, "layers");
    for (int k = 0; k < maps->info.images; k++) {
        pe_layer *layer = &maps->layers[k];

        *layer = pe_layer_of(&maps->info, k);
        layer->offset = offset;
        offset += 3 * (size_t)layer->width * (size_t)layer->height;
    }
    return PE_OK;
}

void pe_layers_free(pe_maps *maps)
{
    for (int k = 0; maps->layers && k < maps->info.images; k++)
        free(maps->layers[k].coefficients);
    free(maps->layers);
}

static void make_spline(size_t k, void *data)
{
    pe_maps *maps = data;
    pe_layer *layer = &maps->layers[k];
    float *line = malloc(2 * (size_t)(layer->width + layer->height) * sizeof *line);

    layer->coefficients = malloc(pe_globe_values(layer->width, layer->height) * sizeof *layer->coefficients);
    if (line && layer->coefficients) {
        pe_globe_coefficients(pe_maps_image(maps, (int)k), layer->width, layer->height, line, layer->coefficients);
    } else {
        free(layer->coefficients);
        layer->coefficients = NULL;
    }
    free(line);
}

pe_status pe_layers_finish(pe_maps *maps, int threads, pe_error *error)
{
    pe_parallel_for((size_t)maps->info.images, threads, make_spline, maps, NULL);
    for (int k = 0; k < maps->info.images; k++)
        if (!maps->layers[k].coefficients)
            return pe_fail_memory(error, "the splines through the layers");
    return PE_OK;
}
