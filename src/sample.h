/* sample.h - between the files of the lookup. */
#ifndef PE_SAMPLE_H
#define PE_SAMPLE_H

#include "maps.h"

/* A surface point and its viewer: unit vectors of the world, o.n >= 0, r the mirror direction. */
typedef struct pe_view {
    double n[3], o[3], r[3];
    const double *direction; /* the brush's here; NULL: the file's */
} pe_view;

/* The vertex of the maps' geodesic sphere nearest to n. */
int pe_nearest_vertex(const pe_maps *maps, const double n[3]);

/* The representative normals that have a say at n, and their shares, in proportion. */
typedef void pe_visit(int vertex, double weight, void *data);
void pe_visit_normals(const pe_maps *maps, const pe_sampling *sampling, const double n[3], pe_visit *visit, void *data);

void pe_sample_latlong(const pe_maps *maps, const pe_sampling *sampling, const pe_view *view, double rgb[3]);
/* Phong's lobe about r, of the smoothness lambda. */
void pe_sample_layers(const pe_maps *maps, const double r[3], double lambda, double rgb[3]);
void pe_sample_voxels(const pe_maps *maps, const double r[3], double lambda, double rgb[3]);

/* Microfacets of the width alpha. */
void pe_sample_grades(const pe_maps *maps, const pe_sampling *sampling, const pe_view *view, double alpha,
                      double rgb[3]);
void pe_sample_hemispheres(const pe_maps *maps, const pe_sampling *sampling, const pe_view *view, double rgb[3]);

#endif
