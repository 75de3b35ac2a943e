/* suns.c - see suns.h. */
#include "suns.h"

#include "env.h"
#include "filter.h"
#include "ndf.h"
#include "shrink.h"
#include "status.h"
#include "surface.h"

/* The texels of greatest power, in falling order; one more than can be suns. */
typedef struct ranking {
    int count, texel[PE_SUNS_MAX + 1];
    double power[PE_SUNS_MAX + 1];
} ranking;

static double texel_power(const pe_env *env, int texel)
{
    return pe_luminance(env->rgb + 3 * (size_t)texel) * env->grid.solid_angle_sr[texel / env->width];
}

static void insert(ranking *r, int texel, double power)
{
    int k = r->count <= PE_SUNS_MAX ? r->count++ : PE_SUNS_MAX;

    for (; k > 0 && r->power[k - 1] < power; k--) {
        r->power[k] = r->power[k - 1];
        r->texel[k] = r->texel[k - 1];
    }
    r->power[k] = power;
    r->texel[k] = texel;
}

/* Returns the sum of all powers. */
static double rank(const pe_env *env, ranking *r)
{
    double sum = 0;

    r->count = 0;
    for (int texel = 0; texel < env->width * env->height; texel++) {
        double power = texel_power(env, texel);

        sum += power;
        if (r->count <= PE_SUNS_MAX || power > r->power[PE_SUNS_MAX])
            insert(r, texel, power);
    }
    return sum;
}

int pe_suns_possible(const pe_surface *surface)
{
    return surface->ndf.kind != PE_NDF_TABLE; /* a file of maps does not keep the table */
}

/* The brightest must add SHARE_MIN of the mean radiance in the middle of its highlight; the first texel left behind
 * must be DIM, or, where the suns are as many as can be, STILL_DIM beside the brightest.  And the lobe must be wider
 * than a texel, which else is no point. */
#define SHARE_MIN 0.05
#define DIM 0.004
#define STILL_DIM 0.2

static int count_suns(const pe_env *env, const pe_ndf *ndf, const ranking *r, double total)
{
    double width[2], highlight;

    pe_ndf_fineness(ndf, width);
    highlight = r->power[0] / (4 * M_PI * width[0] * width[1]);

    if (r->count <= PE_SUNS_MAX || !(highlight > SHARE_MIN * total / (4 * M_PI)) ||
        fmin(width[0], width[1]) < 2 * M_PI / env->width)
        return 0;
    for (int k = 1; k <= PE_SUNS_MAX; k++)
        if (r->power[k] < DIM * r->power[0])
            return k;
    return r->power[PE_SUNS_MAX] < STILL_DIM * r->power[0] ? PE_SUNS_MAX : 0;
}

void pe_suns_add_sun(pe_suns *suns, const double direction[3], const double power[3])
{
    int k = suns->count++;

    for (int c = 0; c < 3; c++) {
        suns->direction[k][c] = direction[c];
        suns->power[k][c] = power[c];
        suns->axes[c][k] = (float)direction[c];
    }
}

static void take(const pe_env *env, const pe_env *fine, int texel, pe_suns *suns, float *rgb)
{
    int y = texel / env->width;
    double direction[3], power[3];

    pe_shrunk_direction(env, fine, texel % env->width, y, direction);
    for (int c = 0; c < 3; c++) {
        power[c] = (double)rgb[3 * (size_t)texel + (size_t)c] * env->grid.solid_angle_sr[y];
        rgb[3 * (size_t)texel + (size_t)c] = 0;
    }
    pe_suns_add_sun(suns, direction, power);
}

pe_status pe_suns_draw_out(const pe_env *env, const pe_env *fine, const pe_surface *surface, pe_suns *suns,
                           pe_env **rest, pe_error *error)
{
    ranking r = { 0 };
    double total;
    int count = 0;
    pe_status status = pe_env_create(env->width, env->height, env->rgb, rest, error);

    if (status != PE_OK)
        return status;
    *suns = (pe_suns){ 0 };
    if (pe_suns_possible(surface)) {
        total = rank(env, &r);
        count = count_suns(env, &surface->ndf, &r, total);
    }
    for (int k = 0; k < count; k++)
        take(env, fine, r.texel[k], suns, (*rest)->rgb);
    return PE_OK;
}

/* D(h) of one sun, h of any length, above the horizon. */
static double density(const pe_ndf *ndf, const pe_frame *frame, const double h[3])
{
    double up = 1 / pe_dot(frame->n, h), p = up * pe_dot(frame->t, h), q = up * pe_dot(frame->b, h);
    double square = 1 + p * p + q * q;

    return pe_ndf_slope_density(ndf, p, q) * square * square;
}

/* D G2 F / (4 cos theta_o) of one sun, all vectors in the tangent frame. */
static void scatter(const pe_surface *surface, const double o[3], double lambda_o, const double w[3],
                    const double power[3], double rgb[3])
{
    double h[3] = { o[0] + w[0], o[1] + w[1], o[2] + w[2] }, share;

    pe_normalize(h, h);
    share = pe_ndf_evaluate(&surface->ndf, h) / (4 * o[2] * (1 + lambda_o + pe_ndf_lambda(&surface->ndf, w)));
    for (int c = 0; c < 3; c++)
        rgb[c] += share * pe_reflectance(surface->eta[c], surface->k[c], pe_dot(o, h)) * power[c];
}

/* What the maps hold is scaled to the albedo, so that their denominator is the closed form's: nothing is to be divided
 * by. */
static void add_scattered(const pe_suns *suns, const pe_surface *surface, const double direction[3], const double n[3],
                          const double world_o[3], double rgb[3])
{
    double o[3], lambda_o;
    pe_frame frame;

    pe_frame_make(n, direction, &frame);
    pe_frame_coordinates(&frame, world_o, o);
    o[2] = fmax(o[2], PE_HORIZON);
    lambda_o = pe_ndf_lambda(&surface->ndf, o);
    for (int k = 0; k < suns->count; k++) {
        double w[3];

        pe_frame_coordinates(&frame, suns->direction[k], w);
        if (w[2] > PE_HORIZON)
            scatter(surface, o, lambda_o, w, suns->power[k], rgb);
    }
}

/* Whether the half vector with any sun may be one that counts: most lookups are nowhere near a sun.  Half vectors
 * within theta of n have their suns within 2 theta of the mirror direction. */
static int is_any_near(const pe_suns *suns, double farthest, const double n[3], const double o[3])
{
    const float least = (float)(2 / farthest - 1.00001); /* cos(2 theta) = 2 cos^2(theta) - 1 */
    int count = (suns->count + 3) & ~3, found = 0;
    double r[3];
    float x, y, z;

    pe_reflect(o, n, r);
    x = (float)r[0];
    y = (float)r[1];
    z = (float)r[2];
    for (int k = 0; k < count; k++)
        found |= x * suns->axes[0][k] + y * suns->axes[1][k] + z * suns->axes[2][k] > least;
    return found;
}

static void add_weighted(const pe_suns *suns, const pe_surface *surface, const pe_denominators *denominators,
                         const double direction[3], const double n[3], const double o[3], double rgb[3])
{
    double farthest = denominators->farthest, local[3], weight, sum[3] = { 0, 0, 0 };
    int seen = 0;
    pe_frame frame;

    if (!is_any_near(suns, farthest, n, o))
        return;
    for (int k = 0; k < suns->count; k++) {
        const double *w = suns->direction[k];
        double h[3] = { o[0] + w[0], o[1] + w[1], o[2] + w[2] }, up = pe_dot(h, n), d;

        if (!(pe_dot(w, n) > PE_HORIZON) || pe_dot(h, h) > farthest * up * up)
            continue;
        if (!seen++)
            pe_frame_make(n, direction, &frame);
        d = density(&surface->ndf, &frame, h);
        for (int c = 0; c < 3; c++)
            sum[c] += d * suns->power[k][c];
    }
    if (!seen)
        return;
    pe_frame_coordinates(&frame, o, local);
    weight = pe_denominators_at(denominators, local);
    for (int c = 0; c < 3; c++)
        rgb[c] += sum[c] / weight;
}

void pe_suns_add(const pe_suns *suns, const pe_surface *surface, const pe_denominators *denominators,
                 const double direction[3], const double n[3], const double o[3], double rgb[3])
{
    if (surface->weight == PE_WEIGHT_MICROFACET)
        add_scattered(suns, surface, direction, n, o, rgb);
    else
        add_weighted(suns, surface, denominators, direction, n, o, rgb);
}
