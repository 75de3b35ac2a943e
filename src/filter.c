/* filter.c - the hot loop of [Motegi Eq. 5].
 *
 * In the tangent frame of the normal, with the unnormalised half vector h = o + w (o to the viewer, w to the light):
 *
 *     tan^2(theta_h) = (h_x^2 + h_y^2) / h_z^2,   1 / cos^2(theta_h) = 1 + tan^2(theta_h)
 *     Beckmann    D ~ (1 / cos^2)^2 exp(-s),   s = (h_x^2 / ax^2 + h_y^2 / ay^2) / h_z^2       [Motegi Eq. 6]
 *     GGX         D ~ ((1 / cos^2) / (1 + s))^2
 *     Phong       D ~ (1 / cos^2) exp(-s log(1 + tan^2) / tan^2)
 *     table       D = (1 / cos^2)^2 P(h_x / h_z, h_y / h_z)
 *
 * (ndf.c), so a weight costs a division or two and one exponential, no square root and no trigonometry; the factor 1 /
 * (pi ax ay) cancels in the quotient.  PE_WEIGHT_MICROFACET adds G2 = 1 / (1 + Lambda(o) + Lambda(w)) of
 * height-correlated masking and shadowing [Heitz], with Lambda worked out once for each light and viewer, and F
 * (lobe.c). */
#include "filter.h"

#include "lanes.h"
#include "status.h"
#include "surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- clouds ---- */

pe_status pe_cloud_allocate(const pe_env *env, size_t count, pe_cloud *cloud, pe_error *error)
{
    *cloud = (pe_cloud){ .env = env, .count = count };
    cloud->x = malloc(count * 3 * sizeof *cloud->x);
    cloud->weight_sr = malloc(count * 4 * sizeof *cloud->weight_sr);
    if (!cloud->x || !cloud->weight_sr) {
        pe_cloud_free(cloud);
        return pe_fail(error, PE_ERROR_MEMORY, "not enough memory for %zu lights", count);
    }
    cloud->y = cloud->x + count;
    cloud->z = cloud->y + count;
    cloud->r = cloud->weight_sr + count;
    cloud->g = cloud->r + count;
    cloud->b = cloud->g + count;
    return PE_OK;
}

pe_status pe_cloud_allocate_areas(const pe_env *env, size_t count, pe_cloud *cloud, pe_error *error)
{
    pe_status status = pe_cloud_allocate(env, count, cloud, error);

    if (status != PE_OK)
        return status;
    cloud->chord = malloc(count * sizeof *cloud->chord);
    cloud->areas = malloc(count * sizeof *cloud->areas);
    if (!cloud->chord || !cloud->areas) {
        pe_cloud_free(cloud);
        return pe_fail(error, PE_ERROR_MEMORY, "not enough memory for %zu lights", count);
    }
    return PE_OK;
}

void pe_cloud_free(pe_cloud *cloud)
{
    free(cloud->x);
    free(cloud->weight_sr);
    free(cloud->chord);
    free(cloud->areas);
    *cloud = (pe_cloud){ 0 };
}

static void set_light(const pe_env *env, int x, int y, size_t light, pe_cloud *cloud)
{
    const float *texel = env->rgb + 3 * ((size_t)y * (size_t)env->width + (size_t)x);
    float weight = (float)env->grid.solid_angle_sr[y];
    double direction[3];

    pe_grid_direction(&env->grid, x, y, direction);
    cloud->x[light] = direction[0];
    cloud->y[light] = direction[1];
    cloud->z[light] = direction[2];
    cloud->weight_sr[light] = weight;
    cloud->r[light] = weight * texel[0];
    cloud->g[light] = weight * texel[1];
    cloud->b[light] = weight * texel[2];
}

/* Tile by tile, so that a block of lights is compact and its cone narrow. */
pe_status pe_cloud_from_env(const pe_env *env, pe_cloud *cloud, pe_error *error)
{
    enum { TILE_WIDTH = 16, TILE_HEIGHT = PE_LIGHT_BLOCK / TILE_WIDTH };
    size_t light = 0;
    pe_status status = pe_cloud_allocate(env, (size_t)env->width * (size_t)env->height, cloud, error);

    if (status != PE_OK)
        return status;
    for (int top = 0; top < env->height; top += TILE_HEIGHT)
        for (int left = 0; left < env->width; left += TILE_WIDTH)
            for (int y = top; y < top + TILE_HEIGHT && y < env->height; y++)
                for (int x = left; x < left + TILE_WIDTH && x < env->width; x++)
                    set_light(env, x, y, light++, cloud);
    return PE_OK;
}

/* ---- lights of a hemisphere ---- */

enum { X, Y, Z, WEIGHT, RED, GREEN, BLUE, LAMBDA, VALUES = PE_LIGHT_VALUES };

pe_status pe_lights_allocate(const pe_cloud *cloud, pe_lights *lights, pe_error *error)
{
    size_t blocks = (cloud->count + PE_LIGHT_BLOCK - 1) / PE_LIGHT_BLOCK;

    *lights = (pe_lights){ 0 };
    lights->values = aligned_alloc(64, blocks * VALUES * PE_LIGHT_BLOCK * sizeof *lights->values);
    lights->cones = malloc(blocks * sizeof *lights->cones);
    if (!lights->values || !lights->cones) {
        pe_lights_free(lights);
        return pe_fail(error, PE_ERROR_MEMORY, "not enough memory for %zu lights", cloud->count);
    }
    return PE_OK;
}

void pe_lights_free(pe_lights *lights)
{
    free(lights->values);
    free(lights->cones);
    *lights = (pe_lights){ 0 };
}

static float *block_values(const pe_lights *lights, size_t block, int value)
{
    return lights->values + (block * VALUES + (size_t)value) * PE_LIGHT_BLOCK;
}

/* Lights of weight 0 straight above fill up the last block: they add exactly nothing. */
static void pad_block(const pe_lights *lights, size_t block, size_t used)
{
    for (size_t k = used; k < PE_LIGHT_BLOCK; k++)
        for (int value = 0; value < VALUES; value++)
            block_values(lights, block, value)[k] = value == Z;
}

static void set_cone(const pe_lights *lights, size_t block, size_t used, double lobe_reach)
{
    pe_light_block *cone = &lights->cones[block];
    const float *x = block_values(lights, block, X), *y = block_values(lights, block, Y);
    const float *z = block_values(lights, block, Z);
    double axis[3] = { 0, 0, 0 }, narrowest = 1, reach;

    for (size_t k = 0; k < used; k++) {
        axis[0] += (double)x[k];
        axis[1] += (double)y[k];
        axis[2] += (double)z[k];
    }
    pe_normalize(axis, axis);
    for (size_t k = 0; k < used; k++)
        narrowest = fmin(narrowest, axis[0] * (double)x[k] + axis[1] * (double)y[k] + axis[2] * (double)z[k]);
    reach = acos(fmax(narrowest, -1)) + lobe_reach;
    for (int c = 0; c < 3; c++)
        cone->axis[c] = (float)axis[c];
    /* A hair wider than it need be, for what single precision rounds away in matters(). */
    cone->cos_reach = reach < M_PI ? (float)cos(reach) - 1e-5f : -2;
}

/* Lights being filled: `used` of them in the block after the last whole one. */
typedef struct filling {
    const pe_lobe *lobe;
    const pe_frame *frame;
    double lobe_reach;
    pe_lights *lights;
    size_t used;
} filling;

/* One light, if it is above the horizon; color is radiance times solid angle. */
static void add_light(filling *f, const double world[3], float weight_sr, const float color[3])
{
    double local[3];
    float *values;

    local[2] = pe_dot(f->frame->n, world);
    if (!(local[2] > PE_HORIZON))
        return;
    pe_frame_coordinates(f->frame, world, local);
    values = block_values(f->lights, f->lights->blocks, X) + f->used;
    for (int c = 0; c < 3; c++) {
        values[(X + c) * PE_LIGHT_BLOCK] = (float)local[c];
        values[(RED + c) * PE_LIGHT_BLOCK] = color[c];
    }
    values[WEIGHT * PE_LIGHT_BLOCK] = weight_sr;
    if (f->lobe->surface.weight == PE_WEIGHT_MICROFACET)
        values[LAMBDA * PE_LIGHT_BLOCK] = (float)pe_ndf_lambda(&f->lobe->surface.ndf, local);
    if (++f->used == PE_LIGHT_BLOCK) {
        set_cone(f->lights, f->lights->blocks++, f->used, f->lobe_reach);
        f->used = 0;
    }
}

/* One light for those of the area's texels that are above the horizon. */
static void add_upper_part(filling *f, const pe_cloud *cloud, const pe_rect *area)
{
    const pe_env *env = cloud->env;
    double sum[3] = { 0 }, solid_angle = 0, rgb[3] = { 0 }, world[3];

    for (int y = area->top; y < area->bottom; y++)
        for (int x = area->left; x < area->right; x++) {
            const float *texel = env->rgb + 3 * ((size_t)y * (size_t)env->width + (size_t)x);
            double weight = env->grid.solid_angle_sr[y];

            pe_grid_direction(&env->grid, x, y, world);
            if (!(pe_dot(f->frame->n, world) > PE_HORIZON))
                continue;
            solid_angle += weight;
            for (int c = 0; c < 3; c++) {
                sum[c] += weight * (pe_luminance(texel) + cloud->floor) * world[c];
                rgb[c] += weight * (double)texel[c];
            }
        }
    if (solid_angle > 0) {
        const float color[3] = { (float)rgb[0], (float)rgb[1], (float)rgb[2] };

        pe_normalize(sum, world);
        add_light(f, world, (float)solid_angle, color);
    }
}

void pe_lights_fill(const pe_cloud *cloud, const pe_lobe *lobe, const pe_frame *frame, double lobe_reach,
                    pe_lights *lights)
{
    filling f = { lobe, frame, lobe_reach, lights, 0 };

    lights->blocks = 0;
    for (size_t k = 0; k < cloud->count; k++) {
        const double world[3] = { cloud->x[k], cloud->y[k], cloud->z[k] };
        const float color[3] = { cloud->r[k], cloud->g[k], cloud->b[k] };

        if (cloud->chord && fabs(pe_dot(frame->n, world)) <= (double)cloud->chord[k])
            add_upper_part(&f, cloud, &cloud->areas[k]);
        else
            add_light(&f, world, cloud->weight_sr[k], color);
    }
    if (f.used) {
        pad_block(lights, lights->blocks, f.used);
        set_cone(lights, lights->blocks++, f.used, lobe_reach);
    }
}

void pe_light_at(const pe_lights *lights, size_t light, float direction[3], float values[4])
{
    const float *value = block_values(lights, light / PE_LIGHT_BLOCK, X) + light % PE_LIGHT_BLOCK;

    for (int c = 0; c < 3; c++)
        direction[c] = value[(X + c) * PE_LIGHT_BLOCK];
    for (int c = 0; c < 4; c++)
        values[c] = value[(WEIGHT + c) * PE_LIGHT_BLOCK];
}

/* ---- the hot loop ---- */

/* The sum of a viewer's direction and of each lane's light's. */
typedef struct half {
    floats x, y, z;
} half;

typedef struct lane_sums {
    floats weight, r, g, b;
} lane_sums;

INLINE void exp2_negative(floats *e)
{
    exp2_of_negative(e, (float)(PE_LOBE_CUTOFF * M_LOG2E));
}

/* t becomes log(1 + t) / t, t >= 0.  With 1 + t = 2^k (1 + f), -0.3 < f < 0.42, that is (k log 2 + f g(f)) / t, and
 * g(t) where k = 0; g(f) = log(1 + f) / f by the polynomial of degree 8 through nine Chebyshev points (relative error
 * below 3e-8). */
INLINE void log1p_quotient(floats *t)
{
    ints bits = (ints)(1.0f + *t);
    ints k = (bits - 0x3f3504f3) >> 23; /* the bits of 2^-1/2 */
    ints small = k == 0;
    floats m = (floats)(bits - (k << 23)) - 1.0f;
    floats f = (floats)(((ints)*t & small) | ((ints)m & ~small));
    floats divisor = (floats)(((ints)*t & ~small) | ((ints)(f * 0.0f + 1.0f) & small));
    floats g = 0.0853331313f * f - 0.142692582f, large;

    g = g * f + 0.149774013f;
    g = g * f - 0.165779929f;
    g = g * f + 0.199559334f;
    g = g * f - 0.250013522f;
    g = g * f + 0.333341933f;
    g = g * f - 0.499999964f;
    g = g * f + 0.999999974f;
    large = __builtin_convertvector(k, floats) * 0.693147182f + f * g;
    *t = (floats)(((ints)g & small) | ((ints)large & ~small)) / divisor;
}

INLINE void beckmann(const pe_lobe *l, const half *h, floats *d)
{
    floats inverse = 1.0f / (h->z * h->z);
    floats xx = h->x * h->x, yy = h->y * h->y;
    floats cos2_inverse = 1.0f + (xx + yy) * inverse;
    floats e = (xx * l->x + yy * l->y) * inverse;

    exp2_negative(&e);
    *d = e * (cos2_inverse * cos2_inverse);
}

INLINE void ggx(const pe_lobe *l, const half *h, floats *d)
{
    floats xx = h->x * h->x, yy = h->y * h->y, zz = h->z * h->z;
    floats root = (xx + yy + zz) / (xx * l->x + yy * l->y + zz);

    *d = root * root;
}

INLINE void phong(const pe_lobe *l, const half *h, floats *d)
{
    floats inverse = 1.0f / (h->z * h->z);
    floats xx = h->x * h->x, yy = h->y * h->y;
    floats tan2 = (xx + yy) * inverse;
    floats e = tan2;

    log1p_quotient(&e);
    e *= (xx * l->x + yy * l->y) * inverse;
    exp2_negative(&e);
    *d = e * (1.0f + tan2);
}

/* To [0, most]. */
INLINE void clamp(floats *v, float most)
{
    ints below = *v <= most;
    floats greatest = most + (floats){ 0 };

    *v = (floats)((((ints)*v & below) | ((ints)greatest & ~below)) & (*v > 0));
}

INLINE void gather(const float *from, const ints *places, floats *out)
{
    int index[LANES];
    float found[LANES];

    memcpy(index, places, sizeof index);
    for (int k = 0; k < LANES; k++)
        found[k] = from[index[k]];
    memcpy(out, found, sizeof found);
}

/* Slopes beyond the frame of zeros find the zeros. */
INLINE void table(const pe_lobe *l, const half *h, floats *d)
{
    const pe_ndf_table *t = l->surface.ndf.table;
    const float *density = t->density;
    const int row = t->row;
    const float last_x = (float)(t->width + 1), last_y = (float)(t->height + 1);
    floats inverse = 1.0f / h->z;
    floats p = h->x * inverse, q = h->y * inverse;
    floats cos2_inverse = 1.0f + p * p + q * q;
    floats x = p * l->scale_x + l->offset_x, y = q * l->scale_y + l->offset_y, d00, d01, d10, d11;
    ints column, line;

    clamp(&x, last_x);
    clamp(&y, last_y);
    column = __builtin_convertvector(x, ints);
    line = __builtin_convertvector(y, ints);
    column += column == t->width + 1;
    line += line == t->height + 1;
    x -= __builtin_convertvector(column, floats);
    y -= __builtin_convertvector(line, floats);
    line = line * row + column;
    gather(density, &line, &d00);
    gather(density + 1, &line, &d01);
    gather(density + row, &line, &d10);
    gather(density + row + 1, &line, &d11);
    d00 += x * (d01 - d00);
    d10 += x * (d11 - d10);
    *d = l->gain * (d00 + y * (d10 - d00)) * (cos2_inverse * cos2_inverse);
}

INLINE void square_root(floats *v)
{
    float lanes[LANES];

    memcpy(lanes, v, sizeof lanes);
    for (int k = 0; k < LANES; k++)
        lanes[k] = sqrtf(lanes[k]);
    memcpy(v, lanes, sizeof lanes);
}

/* F of a channel at x, as pe_lobe has it. */
INLINE void reflectance(const float terms[PE_REFLECTANCE_TERMS], const floats *x, floats *f)
{
    *f = terms[PE_REFLECTANCE_TERMS - 1] + (floats){ 0 };
    for (int k = PE_REFLECTANCE_TERMS - 2; k >= 0; k--)
        *f = *f * *x + terms[k];
}

/* D to D G2, and a factor for each channel; o.h is half the length of the sum h. */
INLINE void microfacet(const pe_lobe *l, const half *h, const float *lambda, float lambda_o, floats *d, floats f[3])
{
    floats c = h->x * h->x + h->y * h->y + h->z * h->z;

    *d /= load(lambda) + (1.0f + lambda_o);
    square_root(&c);
    c = c * (1.0f + l->knee) / (0.5f * c + l->knee) - 1.0f;
    for (int k = 0; k < 3; k++)
        reflectance(l->reflectance[k], &c, &f[k]);
}

INLINE void density(pe_ndf_kind kind, const pe_lobe *l, const half *h, floats *d)
{
    switch (kind) {
    case PE_NDF_BECKMANN:
        beckmann(l, h, d);
        break;
    case PE_NDF_GGX:
        ggx(l, h, d);
        break;
    case PE_NDF_PHONG:
        phong(l, h, d);
        break;
    case PE_NDF_TABLE:
        table(l, h, d);
        break;
    }
}

/* Adds one block's lights, seen from o, to the sums.  `kind` and `weight` are constants where this is inlined. */
INLINE void add_block(pe_ndf_kind kind, pe_weight weight, const pe_lobe *l, const float *values, const float o[3],
                      float lambda_o, lane_sums *sums)
{
    lane_sums s = *sums;

    for (int k = 0; k < PE_LIGHT_BLOCK; k += LANES) {
        half h = {
            load(values + X * PE_LIGHT_BLOCK + k) + o[0],
            load(values + Y * PE_LIGHT_BLOCK + k) + o[1],
            load(values + Z * PE_LIGHT_BLOCK + k) + o[2],
        };
        floats d, f[3];

        density(kind, l, &h, &d);
        if (weight == PE_WEIGHT_MICROFACET) {
            microfacet(l, &h, values + LAMBDA * PE_LIGHT_BLOCK + k, lambda_o, &d, f);
            s.weight += d * load(values + WEIGHT * PE_LIGHT_BLOCK + k);
            s.r += d * f[0] * load(values + RED * PE_LIGHT_BLOCK + k);
            s.g += d * f[1] * load(values + GREEN * PE_LIGHT_BLOCK + k);
            s.b += d * f[2] * load(values + BLUE * PE_LIGHT_BLOCK + k);
        } else {
            s.weight += d * load(values + WEIGHT * PE_LIGHT_BLOCK + k);
            s.r += d * load(values + RED * PE_LIGHT_BLOCK + k);
            s.g += d * load(values + GREEN * PE_LIGHT_BLOCK + k);
            s.b += d * load(values + BLUE * PE_LIGHT_BLOCK + k);
        }
    }
    *sums = s;
}

static void flush(lane_sums *lanes, double sums[4])
{
    for (int k = 0; k < LANES; k++) {
        sums[0] += (double)lanes->weight[k];
        sums[1] += (double)lanes->r[k];
        sums[2] += (double)lanes->g[k];
        sums[3] += (double)lanes->b[k];
    }
    memset(lanes, 0, sizeof *lanes);
}

/* Single precision sums at most this many blocks before a double takes over. */
#define BLOCKS_PER_FLUSH 8

INLINE int matters(const pe_light_block *cone, const float o[3])
{
    return cone->axis[2] * o[2] - cone->axis[0] * o[0] - cone->axis[1] * o[1] >= cone->cos_reach;
}

INLINE void add_points(pe_ndf_kind kind, pe_weight weight, const pe_lobe *l, const pe_lights *lights,
                       const float (*o)[3], const float *lambda_o, size_t count, double (*sums)[4])
{
    lane_sums lanes[PE_FILTER_POINTS_MAX];

    memset(lanes, 0, sizeof lanes);
    for (size_t block = 0; block < lights->blocks; block++) {
        const float *values = block_values(lights, block, X);

        for (size_t k = 0; k < count; k++)
            if (matters(&lights->cones[block], o[k]))
                add_block(kind, weight, l, values, o[k], lambda_o[k], &lanes[k]);
        if (block % BLOCKS_PER_FLUSH == BLOCKS_PER_FLUSH - 1)
            for (size_t k = 0; k < count; k++)
                flush(&lanes[k], sums[k]);
    }
    for (size_t k = 0; k < count; k++)
        flush(&lanes[k], sums[k]);
}

/* A loop for each NDF and weight. */
typedef void points_function(const pe_lobe *l, const pe_lights *lights, const float (*o)[3], const float *lambda_o,
                             size_t count, double (*sums)[4]);

#define POINTS(name, kind, weight) \
    CLONES static void name(const pe_lobe *l, const pe_lights *lights, const float(*o)[3], const float *lambda_o, \
                            size_t count, double(*sums)[4]) \
    { \
        add_points(kind, weight, l, lights, o, lambda_o, count, sums); \
    }

POINTS(beckmann_ndf, PE_NDF_BECKMANN, PE_WEIGHT_NDF)
POINTS(ggx_ndf, PE_NDF_GGX, PE_WEIGHT_NDF)
POINTS(phong_ndf, PE_NDF_PHONG, PE_WEIGHT_NDF)
POINTS(table_ndf, PE_NDF_TABLE, PE_WEIGHT_NDF)
POINTS(beckmann_microfacet, PE_NDF_BECKMANN, PE_WEIGHT_MICROFACET)
POINTS(ggx_microfacet, PE_NDF_GGX, PE_WEIGHT_MICROFACET)
POINTS(table_microfacet, PE_NDF_TABLE, PE_WEIGHT_MICROFACET)

/* By weight and kind; Phong has no masking, so pe_surface_check lets no microfacets of it pass. */
static points_function *const points_functions[2][4] = {
    { beckmann_ndf, ggx_ndf, phong_ndf, table_ndf },
    { beckmann_microfacet, ggx_microfacet, phong_ndf, table_microfacet },
};

void pe_filter_points(const pe_lobe *lobe, const pe_lights *lights, const float (*o)[3], size_t count,
                      double (*sums)[4])
{
    const pe_surface *surface = &lobe->surface;
    float lambda_o[PE_FILTER_POINTS_MAX] = { 0 };

    for (size_t k = 0; k < count && surface->weight == PE_WEIGHT_MICROFACET; k++) {
        const double viewer[3] = { (double)o[k][0], (double)o[k][1], (double)o[k][2] };

        lambda_o[k] = (float)pe_ndf_lambda(&surface->ndf, viewer);
    }
    memset(sums, 0, count * sizeof *sums);
    points_functions[surface->weight][surface->ndf.kind](lobe, lights, o, lambda_o, count, sums);
}

INLINE void all_densities(pe_ndf_kind kind, const pe_lobe *l, const float w[3], const float *const o[3], size_t count,
                          float *densities)
{
    for (size_t k = 0; k < count; k += LANES) {
        half h = { load(o[0] + k) + w[0], load(o[1] + k) + w[1], load(o[2] + k) + w[2] };
        floats d;

        density(kind, l, &h, &d);
        memcpy(densities + k, &d, sizeof d);
    }
}

typedef void densities_function(const pe_lobe *l, const float w[3], const float *const o[3], size_t count,
                                float *densities);

#define DENSITIES(name, kind) \
    CLONES static void name(const pe_lobe *l, const float w[3], const float *const o[3], size_t count, \
                            float *densities) \
    { \
        all_densities(kind, l, w, o, count, densities); \
    }

DENSITIES(beckmann_densities, PE_NDF_BECKMANN)
DENSITIES(ggx_densities, PE_NDF_GGX)
DENSITIES(phong_densities, PE_NDF_PHONG)
DENSITIES(table_densities, PE_NDF_TABLE)

void pe_filter_densities(const pe_lobe *lobe, const float w[3], const float *const o[3], size_t count, float *densities)
{
    static densities_function *const functions[4] = { beckmann_densities, ggx_densities, phong_densities,
                                                      table_densities };

    functions[lobe->surface.ndf.kind](lobe, w, o, count, densities);
}

void pe_mirror_viewer(const pe_frame *frame, const double world[3], float o[3])
{
    double w[3];

    pe_frame_coordinates(frame, world, w);
    o[0] = (float)-w[0];
    o[1] = (float)-w[1];
    o[2] = (float)w[2];
}

/* What is left of the mirror's light where the lobe is a point: h = n. */
static void reflect_in_mirror(const pe_lobe *lobe, double cosine, double rgb[3])
{
    for (int c = 0; c < 3; c++)
        rgb[c] *= pe_reflectance(lobe->surface.eta[c], lobe->surface.k[c], cosine);
}

void pe_filter_radiance(const pe_lobe *lobe, const pe_env *env, const double sums[4], const double world[3],
                        const float o[3], double rgb[3])
{
    const double viewer[3] = { (double)o[0], (double)o[1], (double)o[2] };
    int microfacet = lobe->surface.weight == PE_WEIGHT_MICROFACET;

    if (sums[0] > 0) {
        pe_scale(1 / sums[0], sums + 1, rgb);
    } else {
        pe_env_lookup(env, world, rgb);
        if (microfacet)
            reflect_in_mirror(lobe, viewer[2], rgb);
    }
    if (microfacet)
        pe_scale(pe_lobe_albedo(lobe, viewer), rgb, rgb);
}
