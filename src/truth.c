/* truth.c - the slow exact answers: every texel in double precision, and Monte Carlo. [Motegi Eq. 4] */
#include "env.h"
#include "ndf.h"
#include "prefenv.h"
#include "sequence.h"
#include "surface.h"
#include "vector.h"
#include "viewer.h"

/* What a mirror shows: where no texel has weight, the lobe is far narrower than they are. */
static void mirror(const pe_env *env, const pe_surface *surface, const pe_viewer *v, double rgb[3])
{
    double r[3] = { -v->o[0], -v->o[1], v->o[2] }, world[3];

    pe_frame_direction(&v->frame, r, world);
    pe_env_lookup(env, world, rgb);
    for (int c = 0; c < 3 && surface->weight == PE_WEIGHT_MICROFACET; c++)
        rgb[c] *= pe_reflectance(surface->eta[c], surface->k[c], v->o[2]);
}

/* Adds one row of texels to sums: weight, red, green, blue. */
static void add_row(const pe_env *env, const pe_surface *surface, const pe_viewer *v, int y, double sums[4])
{
    const float *texel = env->rgb + 3 * (size_t)y * (size_t)env->width;

    for (int x = 0; x < env->width; x++, texel += 3) {
        double world[3], w[3], weight, reflectance[3];

        pe_grid_direction(&env->grid, x, y, world);
        w[2] = pe_dot(v->frame.n, world);
        if (!(w[2] > PE_HORIZON))
            continue;
        pe_frame_coordinates(&v->frame, world, w);
        weight = pe_viewer_weight(surface, v, w, reflectance) * env->grid.solid_angle_sr[y];
        sums[0] += weight;
        for (int c = 0; c < 3; c++)
            sums[c + 1] += weight * reflectance[c] * (double)texel[c];
    }
}

#define ALBEDO_SIDE 256

void pe_exact(const pe_env *env, const pe_surface *surface, const double direction[3], const double n[3],
              const double o[3], double rgb[3])
{
    double sums[4] = { 0 };
    pe_viewer v;

    pe_viewer_make(surface, direction, n, o, &v);
    for (int y = 0; y < env->height; y++)
        add_row(env, surface, &v, y, sums);
    if (sums[0] > 0)
        pe_scale(1 / sums[0], sums + 1, rgb);
    else
        mirror(env, surface, &v, rgb);
    if (surface->weight == PE_WEIGHT_MICROFACET)
        pe_scale(pe_directional_albedo(&surface->ndf, v.o, ALBEDO_SIDE), rgb, rgb);
}

/* ---- Monte Carlo ---- */

/* A half vector drawn with density D cos(theta_h) sends the viewer's ray to w = reflect(o, h), with density
 * D cos(theta_h) / (4 o.h) per steradian of w.  Eq. 4 weighs w by D, so the sample counts (o.h) / cos(theta_h); and
 * microfacets reflect D G2 F / (4 cos(theta_o)), so it counts G2 F (o.h) / (cos(theta_o) cos(theta_h)). */
static void add_sample(const pe_env *env, const pe_surface *surface, const pe_viewer *v, const double h[3],
                       double sums[4])
{
    double w[3], world[3], weight, o_h = pe_dot(v->o, h), reflectance[3] = { 1, 1, 1 };
    const float *texel;

    if (!(o_h > 0))
        return;
    pe_reflect(v->o, h, w);
    if (!(w[2] > 0))
        return;
    pe_frame_direction(&v->frame, w, world);
    texel = pe_env_texel(env, world);
    weight = o_h / h[2];
    if (surface->weight == PE_WEIGHT_MICROFACET) {
        weight /= v->o[2] * (1 + v->lambda + pe_ndf_lambda(&surface->ndf, w));
        for (int c = 0; c < 3; c++)
            reflectance[c] = pe_reflectance(surface->eta[c], surface->k[c], o_h);
    }
    sums[0] += weight;
    for (int c = 0; c < 3; c++)
        sums[c + 1] += weight * reflectance[c] * (double)texel[c];
}

/* Lattice points shifted by the view's offsets: evenly spread in a pixel, unrelated between pixels. */
void pe_monte_carlo(const pe_env *env, const pe_surface *surface, const double direction[3], int samples,
                    const double n[3], const double o[3], double rgb[3])
{
    double sums[4] = { 0 }, offsets[2];
    pe_viewer v;

    pe_viewer_make(surface, direction, n, o, &v);
    pe_viewer_offsets(n, o, offsets);
    for (int k = 0; k < samples; k++) {
        double u[2], h[3];

        pe_lattice_point(k, offsets, u);
        pe_ndf_sample(&surface->ndf, u[0], u[1], h);
        add_sample(env, surface, &v, h, sums);
    }
    if (surface->weight == PE_WEIGHT_MICROFACET)
        pe_scale(1.0 / samples, sums + 1, rgb);
    else if (sums[0] > 0)
        pe_scale(1 / sums[0], sums + 1, rgb);
    else
        mirror(env, surface, &v, rgb);
}
