/* sample_layers.c - four layers about a roughness, in each a bicubic lookup in the mirror direction. */
#include "globe.h"
#include "layering.h"
#include "sample.h"

void pe_sample_layers(const pe_maps *maps, const double r[3], double lambda, double rgb[3])
{
    double place = pe_layer_place(&maps->info, pe_smoothness_exponent(&maps->info.smoothness, lambda)), u, v;
    pe_quad sum = { 0, 0, 0, 0 };
    float weights[4];
    int first = pe_layering_weights(maps->info.images, (float)place, weights);

    pe_latlong_coordinates(r, &u, &v);
    for (int k = 0; k < 4; k++) {
        const pe_layer *layer = &maps->layers[first + k];

        if (weights[k] != 0)
            sum += weights[k] * pe_globe_look(layer->coefficients, layer->width, layer->height, (float)u, (float)v);
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = fmax((double)sum[c], 0);
}
