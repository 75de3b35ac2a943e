/* sample.c - maps + (n, o) to radiance: one bilinear lookup a map, mixed between representative normals.
 *
 * [Motegi Eq. 3] with the map chosen by: nearest [Fig. 4a], weighted [Eq. 7], or linear - barycentric over the geodesic
 * triangle that holds n, which needs three lookups, is exact at every n_k and continuous between.
 *
 * The seam: n_k and -n_k share one image, half each. A tap across the pair's equator belongs to the other and is left
 * out; a normal with r.n_k <= 0 has no say; the weights that remain are divided by their sum. */
#include "maps.h"
#include "vector.h"

#include <stdbool.h>

/* One lookup direction, prepared once for all maps. */
typedef struct ray {
    double r[3];
    pe_tap taps[4];
    double tap_directions[4][3];
} ray;

/* What the maps looked up so far add up to. */
typedef struct mix {
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
static void add_map(const pe_maps *maps, const ray *at, int vertex, double weight, mix *sum)
{
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

static int nearest_vertex(const pe_maps *maps, const double n[3])
{
    int vertices[3], best = 0;
    double weights[3];

    /* The triangles are acute, so the nearest vertex of all is one of the triangle's. */
    pe_geodesic_locate(maps->geodesic, n, vertices, weights);
    for (int k = 1; k < 3; k++)
        if (pe_dot(n, pe_geodesic_vertex(maps->geodesic, vertices[k])) >
            pe_dot(n, pe_geodesic_vertex(maps->geodesic, vertices[best])))
            best = k;
    return vertices[best];
}

static void mix_linear(const pe_maps *maps, const ray *at, const double n[3], mix *sum)
{
    int vertices[3];
    double weights[3];

    pe_geodesic_locate(maps->geodesic, n, vertices, weights);
    for (int k = 0; k < 3; k++)
        if (weights[k] > 0)
            add_map(maps, at, vertices[k], weights[k], sum);
}

/* Shares below this are lost in single precision and not looked up. */
#define WEIGHT_MIN 1e-8

/* [Motegi Eq. 7], each weight divided by the greatest so that no exponent underflows. */
static void mix_weighted(const pe_maps *maps, const ray *at, const double n[3], double exponent, mix *sum)
{
    int count = pe_geodesic_count(maps->geodesic);
    double greatest = pe_dot(n, pe_geodesic_vertex(maps->geodesic, nearest_vertex(maps, n)));

    for (int k = 0; k < count; k++) {
        double cosine = pe_dot(n, pe_geodesic_vertex(maps->geodesic, k));
        double weight = cosine > 0 ? pow(cosine / greatest, exponent) : 0;

        if (weight >= WEIGHT_MIN)
            add_map(maps, at, k, weight, sum);
    }
}

/* Where the seam has left nothing (r lies within a texel of every equator nearby), the nearest map with r on its side
 * answers from its texel nearest to r. */
static void mix_rest(const pe_maps *maps, const double r[3], const double n[3], mix *sum)
{
    int vertex = nearest_vertex(maps, n);
    const double *n_k = pe_geodesic_vertex(maps->geodesic, vertex);

    for (int step = 0; step <= 16 && !(sum->weight > 0); step++) {
        double lifted[3];
        ray at;

        for (int c = 0; c < 3; c++)
            lifted[c] = r[c] + step / 16.0 * n_k[c];
        if (!(pe_dot(lifted, n_k) > 0))
            continue;
        pe_normalize(lifted, lifted);
        aim(maps, lifted, &at);
        add_map(maps, &at, vertex, 1, sum);
    }
}

static void sample_baseline(const pe_maps *maps, const ray *at, double rgb[3])
{
    for (int c = 0; c < 3; c++) {
        rgb[c] = 0;
        for (int k = 0; k < 4; k++)
            rgb[c] += at->taps[k].share * (double)texel_of(maps, 0, &at->taps[k])[c];
    }
}

static void sample_representative(const pe_maps *maps, const pe_sampling *sampling, const ray *at, const double n[3],
                                  double rgb[3])
{
    mix sum = { { 0 }, 0 };

    switch (sampling->interpolation) {
    case PE_INTERPOLATION_NEAREST:
        add_map(maps, at, nearest_vertex(maps, n), 1, &sum);
        break;
    case PE_INTERPOLATION_WEIGHTED: {
        double half_frequency = maps->info.frequency / 2.0;
        double exponent = sampling->exponent > 0 ? sampling->exponent : 50 * half_frequency * half_frequency;

        mix_weighted(maps, at, n, exponent, &sum);
        break;
    }
    case PE_INTERPOLATION_DEFAULT:
    case PE_INTERPOLATION_LINEAR:
        mix_linear(maps, at, n, &sum);
        break;
    }
    if (!(sum.weight > 0))
        mix_rest(maps, at->r, n, &sum);
    pe_scale(sum.weight > 0 ? 1 / sum.weight : 0, sum.rgb, rgb);
}

void pe_sample(const pe_maps *maps, const pe_sampling *sampling, const double n[3], const double o[3], double rgb[3])
{
    static const pe_sampling defaults = { PE_INTERPOLATION_DEFAULT, 0 };
    double unit_n[3], unit_o[3], r[3];
    ray at;

    pe_normalize_any(n, unit_n);
    pe_normalize_any(o, unit_o);
    if (pe_dot(unit_n, unit_o) < 0)
        pe_scale(-1, unit_n, unit_n);
    pe_reflect(unit_o, unit_n, r);
    aim(maps, r, &at);
    if (maps->geodesic)
        sample_representative(maps, sampling ? sampling : &defaults, &at, unit_n, rgb);
    else
        sample_baseline(maps, &at, rgb);
}
