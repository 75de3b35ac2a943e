/* sample.c - maps + (n, o) to radiance: [Motegi Eq. 3], which representative normals are asked, and how they are mixed.
 *
 * Nearest [Fig. 4a], weighted [Eq. 7], or linear - barycentric over the geodesic triangle that holds n, which needs
 * three lookups, is exact at every n_k and continuous between. */
#include "sample.h"
#include "horizon.h"

int pe_nearest_vertex(const pe_maps *maps, const double n[3])
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

static void visit_triangle(const pe_maps *maps, const double n[3], pe_visit *visit, void *data)
{
    int vertices[3];
    double weights[3];

    pe_geodesic_locate(maps->geodesic, n, vertices, weights);
    for (int k = 0; k < 3; k++)
        if (weights[k] > 0)
            visit(vertices[k], weights[k], data);
}

/* Shares below this are lost in single precision and not looked up. */
#define WEIGHT_MIN 1e-8

/* [Motegi Eq. 7], each weight divided by the greatest so that no exponent underflows. */
static void visit_weighted(const pe_maps *maps, double exponent, const double n[3], pe_visit *visit, void *data)
{
    int count = pe_geodesic_count(maps->geodesic);
    double greatest = pe_dot(n, pe_geodesic_vertex(maps->geodesic, pe_nearest_vertex(maps, n)));

    for (int k = 0; k < count; k++) {
        double cosine = pe_dot(n, pe_geodesic_vertex(maps->geodesic, k));
        double weight = cosine > 0 ? pow(cosine / greatest, exponent) : 0;

        if (weight >= WEIGHT_MIN)
            visit(k, weight, data);
    }
}

void pe_visit_normals(const pe_maps *maps, const pe_sampling *sampling, const double n[3], pe_visit *visit, void *data)
{
    double half_frequency = maps->info.frequency / 2.0;

    switch (sampling->interpolation) {
    case PE_INTERPOLATION_NEAREST:
        visit(pe_nearest_vertex(maps, n), 1, data);
        break;
    case PE_INTERPOLATION_WEIGHTED:
        visit_weighted(maps, sampling->exponent > 0 ? sampling->exponent : 50 * half_frequency * half_frequency, n,
                       visit, data);
        break;
    case PE_INTERPOLATION_DEFAULT:
    case PE_INTERPOLATION_LINEAR:
        visit_triangle(maps, n, visit, data);
        break;
    }
}

/* What of the lobe the surface lets through, were the light of all of it alike. */
static void hide_below(const pe_maps *maps, const pe_view *view, double lambda, double rgb[3])
{
    double exponent = pe_smoothness_exponent(&maps->info.smoothness, lambda);

    pe_scale(pe_visible_share(exponent, pe_dot(view->n, view->r)), rgb, rgb);
}

static void sample_others(const pe_maps *maps, const pe_sampling *sampling, const pe_view *view, double roughness,
                          double rgb[3])
{
    switch (maps->info.method) {
    case PE_METHOD_DEFAULT:
    case PE_METHOD_HEMISPHERES:
        break;
    case PE_METHOD_REPRESENTATIVE:
    case PE_METHOD_BASELINE:
        pe_sample_latlong(maps, sampling, view, rgb);
        break;
    case PE_METHOD_LAYERS:
        pe_sample_layers(maps, view->r, fmin(fmax(roughness, 0), 1), rgb);
        break;
    case PE_METHOD_VOXELS:
        pe_sample_voxels(maps, view->r, fmin(fmax(roughness, 0), 1), rgb);
        break;
    case PE_METHOD_GRADES:
        pe_sample_grades(maps, sampling, view, roughness, rgb);
        break;
    }
    if (sampling->horizon == PE_HORIZON_DARK && pe_method_has_lambda(maps->info.method))
        hide_below(maps, view, fmin(fmax(roughness, 0), 1), rgb);
}

void pe_sample(const pe_maps *maps, const pe_sampling *sampling, const pe_point *point, double rgb[3])
{
    static const pe_sampling defaults = { PE_INTERPOLATION_DEFAULT, 0, PE_HORIZON_IGNORED };
    pe_view view = { .direction = maps->info.angles > 1 ? point->direction : NULL };

    pe_normalize_any(point->n, view.n);
    pe_normalize_any(point->o, view.o);
    if (pe_dot(view.n, view.o) < 0)
        pe_scale(-1, view.n, view.n);
    pe_reflect(view.o, view.n, view.r);
    sampling = sampling ? sampling : &defaults;
    /* The usual maps first: the switch becomes a table of jumps, whose target a processor guesses from the branches
     * before it; wrong, where views come in any order. */
    if (maps->info.method == PE_METHOD_HEMISPHERES)
        pe_sample_hemispheres(maps, sampling, &view, rgb);
    else
        sample_others(maps, sampling, &view, point->roughness, rgb);
}
