/* mipmap.c - an environment as footprints of any size see it. [Křivánek]
 *
 * Levels are geodesic spheres, each of half the frequency of the one before, a quarter of its vertices.  A vertex holds
 * the mean of what lies in the triangles around it, by solid angle and barycentric weight: as round at a pole as
 * elsewhere, without a seam, and for environments of any size. */
#include "env.h"
#include "geodesic.h"
#include "shrink.h"
#include "status.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>

enum { LEVELS_MAX = 7, FREQUENCY_MAX = 1 << (LEVELS_MAX - 1) };

#define TEXELS_AT_LEAST 3.0 /* to a vertex, at the equator */

/* How large a footprint through a level is, in vertices: its light is spread to them, and between them again. */
#define VERTICES 2.0

typedef struct level {
    pe_geodesic *sphere;
    float (*rgb)[3]; /* of each vertex */
} level;

struct pe_mipmap {
    const pe_env *env;
    double texel_sr; /* how large footprints are: the environment's own, at its equator, */
    double first_sr; /* and those through the first level; through each of the others four of the one before */
    int count;
    level levels[LEVELS_MAX]; /* the finest first */
};

static double vertex_sr(int frequency)
{
    return 4 * M_PI / (10.0 * frequency * frequency + 2);
}

/* ---- making ---- */

typedef double sums[4]; /* of light and of what it counts */

static void spread_light(const pe_geodesic *sphere, const double direction[3], double sr, const float rgb[3], sums *of)
{
    int vertices[3];
    double weights[3];

    pe_geodesic_locate(sphere, direction, vertices, weights);
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++)
            of[vertices[k]][c] += weights[k] * sr * (double)rgb[c];
        of[vertices[k]][3] += weights[k] * sr;
    }
}

static void spread_texels(const pe_env *env, const pe_geodesic *sphere, sums *of)
{
    for (int y = 0; y < env->height; y++)
        for (int x = 0; x < env->width; x++) {
            double direction[3];

            pe_grid_direction(&env->grid, x, y, direction);
            spread_light(sphere, direction, env->grid.solid_angle_sr[y],
                         env->rgb + 3 * ((size_t)y * (size_t)env->width + (size_t)x), of);
        }
}

static void spread_level(const level *finer, const pe_geodesic *sphere, sums *of)
{
    for (int k = 0; k < pe_geodesic_count(finer->sphere); k++)
        spread_light(sphere, pe_geodesic_vertex(finer->sphere, k), pe_geodesic_share(finer->sphere, k), finer->rgb[k],
                     of);
}

/* Where texels are wider than triangles, no texel lies in some. */
static void set_vertices(const pe_env *env, const sums *of, level *l)
{
    for (int k = 0; k < pe_geodesic_count(l->sphere); k++) {
        double rgb[3];

        pe_env_lookup(env, pe_geodesic_vertex(l->sphere, k), rgb);
        for (int c = 0; c < 3; c++)
            l->rgb[k][c] = (float)(of[k][3] > 0 ? of[k][c] / of[k][3] : rgb[c]);
    }
}

/* Of the level before it, or (NULL) of the environment. */
static pe_status make_level(const pe_env *env, const level *finer, int frequency, level *l, pe_error *error)
{
    pe_status status = pe_geodesic_make(frequency, &l->sphere, error);
    size_t count = status == PE_OK ? (size_t)pe_geodesic_count(l->sphere) : 0;
    sums *of;

    if (status != PE_OK)
        return status;
    of = calloc(count, sizeof *of);
    l->rgb = calloc(count, sizeof *l->rgb);
    if (of && l->rgb) {
        if (finer)
            spread_level(finer, l->sphere, of);
        else
            spread_texels(env, l->sphere, of);
        set_vertices(env, of, l);
    } else
        status = pe_fail_memory(error, "the footprints of an environment");
    free(of);
    return status;
}

static pe_status make_levels(const pe_env *env, pe_mipmap *m, pe_error *error)
{
    double texel_sr = 2 * M_PI / env->width * M_PI / env->height;
    pe_status status = PE_OK;

    for (int f = FREQUENCY_MAX; f >= 1 && status == PE_OK; f /= 2)
        if (f == 1 || vertex_sr(f) > TEXELS_AT_LEAST * texel_sr) {
            const level *finer = m->count > 0 ? &m->levels[m->count - 1] : NULL;

            status = make_level(env, finer, f, &m->levels[m->count++], error);
        }
    return status;
}

pe_status pe_mipmap_make(const pe_env *env, pe_mipmap **out, pe_error *error)
{
    pe_mipmap *m = calloc(1, sizeof *m);
    pe_env *small = NULL;
    pe_status status;

    if (!m)
        return pe_fail_memory(error, "the footprints of an environment");
    m->env = env;
    status = pe_env_shrink(env, sqrt(vertex_sr(FREQUENCY_MAX) / TEXELS_AT_LEAST), &small, error);
    if (status == PE_OK)
        status = make_levels(small ? small : env, m, error);
    pe_env_free(small);
    if (status != PE_OK) {
        pe_mipmap_free(m);
        return status;
    }
    m->first_sr = VERTICES * 4 * M_PI / pe_geodesic_count(m->levels[0].sphere);
    m->texel_sr = fmin(2 * M_PI / env->width * M_PI / env->height, m->first_sr / TEXELS_AT_LEAST);
    *out = m;
    return PE_OK;
}

void pe_mipmap_free(pe_mipmap *m)
{
    if (!m)
        return;
    for (int k = 0; k < m->count; k++) {
        pe_geodesic_free(m->levels[k].sphere);
        free(m->levels[k].rgb);
    }
    free(m);
}

/* ---- lookup ---- */

static void add_level(const level *l, const double direction[3], double share, double rgb[3])
{
    int vertices[3];
    double weights[3];

    pe_geodesic_locate(l->sphere, direction, vertices, weights);
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            rgb[c] += share * weights[k] * (double)l->rgb[vertices[k]][c];
}

/* The share of the finer of two footprints in one between them that shows a single texel as bright as it should: by
 * their inverses. */
static double share_of_finer(double finer_sr, double coarser_sr, double sr)
{
    return (1 / sr - 1 / coarser_sr) / (1 / finer_sr - 1 / coarser_sr);
}

void pe_mipmap_lookup(const pe_mipmap *m, const double direction[3], double solid_angle_sr, double rgb[3])
{
    double texel_sr = m->texel_sr * sqrt(fmax(1 - direction[1] * direction[1], 0)), level_sr = m->first_sr, share;
    int k = 0;

    rgb[0] = rgb[1] = rgb[2] = 0;
    if (solid_angle_sr < m->first_sr) {
        share = solid_angle_sr > texel_sr ? share_of_finer(texel_sr, m->first_sr, solid_angle_sr) : 1;
        pe_env_lookup(m->env, direction, rgb);
        pe_scale(share, rgb, rgb);
        if (share < 1)
            add_level(&m->levels[0], direction, 1 - share, rgb);
        return;
    }
    while (k < m->count - 1 && 4 * level_sr <= solid_angle_sr) {
        level_sr *= 4;
        k++;
    }
    share = k < m->count - 1 ? share_of_finer(level_sr, 4 * level_sr, solid_angle_sr) : 1;
    add_level(&m->levels[k], direction, share, rgb);
    if (share < 1)
        add_level(&m->levels[k + 1], direction, 1 - share, rgb);
}
