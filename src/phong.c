/* phong.c - Phong's lobe about the mirror direction, and the scales of its roughness. [Okumura 2.1, 2.2]
 *
 * Its sum runs over texels whose weight is above e^-CUTOFF of the greatest there can be: those lie in a cone about r,
 * and so between two columns of each row of a lat-long image. */
#include "phong.h"
#include "env.h"
#include "filter.h"
#include "status.h"
#include "vector.h"

#define CUTOFF 40.0

/* ---- scales ---- */

#define SIZE_DEFAULT 128
#define WINDOW_DEFAULT 6.2
#define LEVELS_DEFAULT 256

/* Of lambda = 1. */
#define EXPONENT_MIN 16.0
#define EXPONENT_MAX 1e5

void pe_smoothness_complete(pe_smoothness *scale)
{
    scale->size = scale->size ? scale->size : SIZE_DEFAULT;
    scale->window = scale->window != 0 ? scale->window : WINDOW_DEFAULT;
    scale->levels = scale->levels != 0 ? scale->levels : LEVELS_DEFAULT;
}

pe_status pe_smoothness_check(const pe_smoothness *scale, pe_error *error)
{
    pe_smoothness whole = *scale;

    pe_smoothness_complete(&whole);
    if (whole.size < PE_SMOOTHNESS_SIZE_MIN || whole.size > PE_SMOOTHNESS_SIZE_MAX || whole.size % 2)
        return pe_fail(error, PE_ERROR_ARGUMENT, "size %d is not an even number from %d to %d", whole.size,
                       PE_SMOOTHNESS_SIZE_MIN, PE_SMOOTHNESS_SIZE_MAX);
    if (!(whole.window >= 0.1 && whole.window <= 100))
        return pe_fail(error, PE_ERROR_ARGUMENT, "window %g is out of range; it lies between 0.1 and 100",
                       whole.window);
    if (!(whole.levels >= 2 && whole.levels <= 1e6))
        return pe_fail(error, PE_ERROR_ARGUMENT, "levels %g is out of range; it lies between 2 and 1000000",
                       whole.levels);
    if (!(pe_smoothness_exponent(&whole, 1) <= EXPONENT_MAX))
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "window %g is too narrow for size %d: lambda = 1 would be the exponent %g, above %g",
                       whole.window, whole.size, pe_smoothness_exponent(&whole, 1), EXPONENT_MAX);
    if (!(pe_smoothness_exponent(&whole, 1) >= EXPONENT_MIN))
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "window %g is too wide for size %d: lambda = 1 would be the exponent %g, below %g", whole.window,
                       whole.size, pe_smoothness_exponent(&whole, 1), EXPONENT_MIN);
    return PE_OK;
}

/* [Okumura Eq. 13], with cos(arctan x) = 1 / sqrt(1 + x^2). */
double pe_smoothness_exponent(const pe_smoothness *scale, double lambda)
{
    pe_smoothness s = *scale;
    double x;

    pe_smoothness_complete(&s);
    if (!(lambda > 0))
        return 0;
    x = s.window / (lambda * s.size);
    return 2 * log(s.levels) / log1p(x * x);
}

double pe_smoothness_lambda(const pe_smoothness *scale, double exponent)
{
    pe_smoothness s = *scale;

    pe_smoothness_complete(&s);
    if (!(exponent > 0))
        return 0;
    return s.window / (s.size * sqrt(expm1(2 * log(s.levels) / exponent)));
}

/* Seen head on, the half vector of a light at the angle theta to r lies at theta / 2, and the distribution of Phong's
 * kind gives it the power 2 / alpha^2 - 2 of cos(theta / 2): for small angles exp(-(1 / alpha^2 - 1) theta^2 / 4),
 * which is cos^Lambda theta, exp(-Lambda theta^2 / 2), where Lambda = (1 / alpha^2 - 1) / 2. */
double pe_phong_exponent(double alpha)
{
    return alpha < 1 ? (1 / (alpha * alpha) - 1) / 2 : 0;
}

double pe_phong_alpha(double exponent)
{
    return exponent > 0 ? 1 / sqrt(2 * exponent + 1) : 1;
}

/* ---- the lobe ---- */

/* A lobe and what of the environment it has gathered. */
typedef struct lobe {
    double r[3], n[3];
    double exponent, least_cosine;
    int sees_below;       /* the light below the horizon counts, too */
    double azimuth, flat; /* of r, and the length of its part along the ground */
    double all;           /* weight of the whole lobe */
    double sums[4];       /* of what counts: weight, red, green, blue */
} lobe;

static void add_texels(lobe *l, const pe_env *env, int y, int first, int count)
{
    for (int k = 0; k < count; k++) {
        int x = (first + k) % env->width;
        const float *texel = env->rgb + 3 * ((size_t)y * (size_t)env->width + (size_t)x);
        double w[3], cosine, weight;

        pe_grid_direction(&env->grid, x, y, w);
        cosine = pe_dot(l->r, w);
        if (!(cosine > l->least_cosine))
            continue;
        weight = exp(l->exponent * log(cosine)) * env->grid.solid_angle_sr[y];
        l->all += weight;
        if (!l->sees_below && !(pe_dot(l->n, w) > PE_HORIZON))
            continue;
        l->sums[0] += weight;
        for (int c = 0; c < 3; c++)
            l->sums[c + 1] += weight * (double)texel[c];
    }
}

/* In row y the cosine to r is r_y cos(theta) + flat sin(theta) cos(phi - azimuth). */
static void add_row(lobe *l, const pe_env *env, int y)
{
    double along = l->r[1] * env->grid.cos_theta[y], across = l->flat * env->grid.sin_theta[y], reach;
    int first, last;

    if (along + across < l->least_cosine)
        return;
    if (along - across > l->least_cosine) {
        add_texels(l, env, y, 0, env->width);
        return;
    }
    reach = acos((l->least_cosine - along) / across) + 1e-9;
    first = (int)floor((l->azimuth - reach) / (2 * M_PI) * env->width - 0.5);
    last = (int)ceil((l->azimuth + reach) / (2 * M_PI) * env->width - 0.5);
    if (last - first + 1 >= env->width)
        add_texels(l, env, y, 0, env->width);
    else
        add_texels(l, env, y, (first + env->width) % env->width, last - first + 1);
}

void pe_phong(const pe_env *env, double exponent, pe_horizon horizon, const double n[3], const double r[3],
              double rgb[3])
{
    lobe l = { .exponent = exponent, .sees_below = horizon == PE_HORIZON_IGNORED };
    double whole;

    pe_normalize_any(r, l.r);
    if (!l.sees_below)
        pe_normalize_any(n, l.n);
    l.least_cosine = exponent > 0 ? exp(-CUTOFF / exponent) : 0;
    l.azimuth = atan2(l.r[2], l.r[0]);
    l.azimuth += l.azimuth < 0 ? 2 * M_PI : 0;
    l.flat = hypot(l.r[0], l.r[2]);
    for (int y = 0; y < env->height; y++)
        add_row(&l, env, y);
    whole = horizon == PE_HORIZON_DARK ? l.all : l.sums[0];
    if (whole > 0)
        pe_scale(1 / whole, l.sums + 1, rgb);
    else
        pe_env_lookup(env, l.r, rgb);
}
