/* sample_latlong.c - one bilinear lookup a lat-long map, mixed between representative normals.
 *
 * The seam: n_k and -n_k share one image, half each. A tap across the pair's equator belongs to the other and is left
 * out; a normal with r.n_k <= 0 has no say; the weights that remain are divided by their sum. */
#include "sample.h"

#include <string.h>

/* One lookup direction, prepared once for all maps. */
typedef struct ray {
    double r[3];
    pe_tap taps[4];
    double tap_directions[4][3];
} ray;

/* What the maps looked up so far add up to. */
typedef struct mix {
    const pe_maps *maps;
    const ray *at;
    double rgb[3], weight;
} mix;

static void aim(const pe_maps *maps, const double r[3], ray *out)
{
    double u, v;

    for (int c = 0; c < 3; c++)
        out->r[c] = r[c];
    pe_latlong_coordinates(r, &u, &v);
    pe_latlong_taps(maps->info.width, maps->info.height, u, v, out->taps);
    for (int k = 0; k < 4; k++)
        pe_grid_direction(&maps->grid, out->taps[k].x, out->taps[k].y, out->tap_directions[k]);
}

static const float *texel_of(const pe_maps *maps, int image, const pe_tap *tap)
{
    return pe_maps_image(maps, image) + 3 * ((size_t)tap->y * (size_t)maps->info.width + (size_t)tap->x);
}

/* Adds the map of representative normal `vertex` with the given weight; nothing if the seam leaves it no tap. */
static void add_map(int vertex, double weight, void *data)
{
    mix *sum = data;
    const pe_maps *maps = sum->maps;
    const ray *at = sum->at;
    const double *n_k = pe_geodesic_vertex(maps->geodesic, vertex);
    double rgb[3] = { 0 }, share = 0;

    if (!(pe_dot(at->r, n_k) > 0))
        return;
    for (int k = 0; k < 4; k++) {
        const float *texel;

        if (!(pe_dot(at->tap_directions[k], n_k) > 0))
            continue;
        texel = texel_of(maps, vertex / 2, &at->taps[k]);
        share += at->taps[k].share;
        for (int c = 0; c < 3; c++)
            rgb[c] += at->taps[k].share * (double)texel[c];
    }
    if (!(share > 0))
        return;
    for (int c = 0; c < 3; c++)
        sum->rgb[c] += weight / share * rgb[c];
    sum->weight += weight;
}

/* Where the seam has left nothing (r lies within a texel of every equator nearby), the nearest map with r on its side
 * answers from its texel nearest to r. */
static void mix_rest(const pe_maps *maps, const double r[3], const double n[3], mix *sum)
{
    int vertex = pe_nearest_vertex(maps, n);
    const double *n_k = pe_geodesic_vertex(maps->geodesic, vertex);
    ray at;
    mix lifted_sum = { .maps = maps, .at = &at };

    for (int step = 0; step <= 16 && !(lifted_sum.weight > 0); step++) {
        double lifted[3];

        for (int c = 0; c < 3; c++)
            lifted[c] = r[c] + step / 16.0 * n_k[c];
        if (!(pe_dot(lifted, n_k) > 0))
            continue;
        pe_normalize(lifted, lifted);
        aim(maps, lifted, &at);
        add_map(vertex, 1, &lifted_sum);
    }
    memcpy(sum->rgb, lifted_sum.rgb, sizeof sum->rgb);
    sum->weight = lifted_sum.weight;
}

static void sample_baseline(const pe_maps *maps, const ray *at, double rgb[3])
{
    for (int c = 0; c < 3; c++) {
        rgb[c] = 0;
        for (int k = 0; k < 4; k++)
            rgb[c] += at->taps[k].share * (double)texel_of(maps, 0, &at->taps[k])[c];
    }
}

void pe_sample_latlong(const pe_maps *maps, const pe_sampling *sampling, const pe_view *view, double rgb[3])
{
    ray at;
    mix sum = { maps, &at, { 0 }, 0 };

    aim(maps, view->r, &at);
    if (!maps->geodesic) {
        sample_baseline(maps, &at, rgb);
        return;
    }
    pe_visit_normals(maps, sampling, view->n, add_map, &sum);
    if (!(sum.weight > 0))
        mix_rest(maps, view->r, view->n, &sum);
    pe_scale(sum.weight > 0 ? 1 / sum.weight : 0, sum.rgb, rgb);
}
