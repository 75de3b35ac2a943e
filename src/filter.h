/* filter.h - the hot loop: lights in a tangent frame, weighted by the NDF as a viewer sees it. [Motegi Eq. 5] */
#ifndef PE_FILTER_H
#define PE_FILTER_H

#include "env.h"
#include "lobe.h"
#include "prefenv.h"
#include "surface.h"
#include "vector.h"

/* Half-open rectangle of texels. */
typedef struct pe_rect {
    int left, top, right, bottom;
} pe_rect;

/* Lights of the whole sphere: unit directions in the world, solid angle, and radiance times solid angle.  A light may
 * stand for several texels of env, none farther from its direction than chord (of unit vectors). */
typedef struct pe_cloud {
    const pe_env *env;
    size_t count;
    double *x, *y, *z;
    float *weight_sr, *r, *g, *b;
    float *chord;   /* NULL where each light is one texel */
    pe_rect *areas; /* likewise */
    double floor;   /* what is added to a texel's luminance when directions are averaged */
} pe_cloud;

/* Room for `count` lights of one texel each, or of several. */
pe_status pe_cloud_allocate(const pe_env *env, size_t count, pe_cloud *cloud, pe_error *error);
pe_status pe_cloud_allocate_areas(const pe_env *env, size_t count, pe_cloud *cloud, pe_error *error);
void pe_cloud_free(pe_cloud *cloud);

/* One light a texel, neighbours close to each other. */
pe_status pe_cloud_from_env(const pe_env *env, pe_cloud *cloud, pe_error *error);

#define PE_LIGHT_BLOCK 128

/* x, y, z, weight, r, g, b, and Lambda, which counts for PE_WEIGHT_MICROFACET alone. */
#define PE_LIGHT_VALUES 8

/* A block's lights all lie within a cone about `axis`: seen from a mirror direction farther than reach from it, none
 * of them matters.  cos_reach is the cosine of the cone's half angle plus the lobe's. */
typedef struct pe_light_block {
    float axis[3], cos_reach;
} pe_light_block;

/* The lights of one hemisphere, z > 0, in the tangent frame of its normal; padded to whole blocks with weight 0. */
typedef struct pe_lights {
    size_t blocks;
    float *values; /* PE_LIGHT_VALUES times PE_LIGHT_BLOCK floats of block 0, then block 1 … */
    pe_light_block *cones;
} pe_lights;

/* Room for as many lights as a cloud may put into one hemisphere: all of them. */
pe_status pe_lights_allocate(const pe_cloud *cloud, pe_lights *lights, pe_error *error);
void pe_lights_free(pe_lights *lights);

/* Fills lights with the hemisphere of the frame's normal.  Of a light whose texels lie on both sides of the horizon,
 * those above make a light of their own, so that nothing from behind the surface counts.  lobe_reach: an angle from
 * the mirror direction beyond which a light does not matter. */
void pe_lights_fill(const pe_cloud *cloud, const pe_lobe *lobe, const pe_frame *frame, double lobe_reach,
                    pe_lights *lights);

/* Light number `light` of the blocks: its direction, and weight, red, green and blue; a light of padding has none. */
void pe_light_at(const pe_lights *lights, size_t light, float direction[3], float values[4]);

/* For each viewer o[k] (unit, tangent frame, z > 0): sums[k] = sum of weight, of red, green and blue over the lights,
 * each times D(h), and for PE_WEIGHT_MICROFACET times G2, and the colours times F.  A common factor is left out: only
 * ratios of sums mean anything. */
void pe_filter_points(const pe_lobe *lobe, const pe_lights *lights, const float (*o)[3], size_t count,
                      double (*sums)[4]);

/* The other way round, one light w and many viewers: D(h) of each of `count` viewers, whose x, y and z stand in arrays
 * with room for a multiple of 16, as has `densities`.  Of closed forms times pi alpha_x alpha_y, of tables times the
 * lobe's gain. */
void pe_filter_densities(const pe_lobe *lobe, const float w[3], const float *const o[3], size_t count,
                         float *densities);

#define PE_FILTER_POINTS_MAX 64 /* most points in one call */

/* The viewer who sees the direction `world` in a mirror of the frame's normal: with world = (x, y, z) in the frame,
 * o = (-x, -y, z). */
void pe_mirror_viewer(const pe_frame *frame, const double world[3], float o[3]);

/* What the viewer o (tangent frame) sees who would see `world` in a mirror.  PE_WEIGHT_NDF: the quotient of Eq. 5;
 * where no light has weight, what a mirror shows.  PE_WEIGHT_MICROFACET: that times the albedo.  The plain sum would
 * do while texels resolve the lobe; of 1024 x 512 it is off by 1e-4 at alpha 0.01 where o.n = 0.15, and at alpha 0.004
 * by 28 %. */
void pe_filter_radiance(const pe_lobe *lobe, const pe_env *env, const double sums[4], const double world[3],
                        const float o[3], double rgb[3]);

#endif
