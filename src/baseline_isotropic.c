/* baseline_isotropic.c - lights seen head on, by isotropic lobes.
 *
 * With n = o = w, the half vector of a light l at the distance c = |l - w| has
 *
 *     tan^2(theta_h) = c^2 / (4 - c^2),   1 / cos^2(theta_h) = 4 / (4 - c^2)
 *
 * so that the weight of an isotropic lobe depends on c^2 alone, and no tangent frame is needed. */
#include "baseline_lights.h"

typedef double doubles __attribute__((vector_size(8 * LANES)));
typedef long long longs __attribute__((vector_size(8 * LANES)));

typedef struct lane_sums {
    floats value[4]; /* weight, red, green, blue */
} lane_sums;

/* c^2 = |l - w|^2 of a block's lights. */
INLINE floats chord_squared(const pe_block *b, const float w[3])
{
    floats x = load(b->rounded[0]) - w[0], y = load(b->rounded[1]) - w[1], z = load(b->rounded[2]) - w[2];

    return x * x + y * y + z * z;
}

/* D as a function of c^2, up to a factor that cancels.  Beckmann's width is log2(e) / alpha^2. */
INLINE floats beckmann(floats c2, float width)
{
    floats inverse = 1.0f / (4.0f - c2), d = c2 * inverse * width;

    exp2_of_negative(&d, (float)(PE_LOBE_CUTOFF * M_LOG2E));
    return d * (inverse * inverse);
}

/* 1 / (cos^2 (1 + tan^2 / alpha^2))^2, whose width is alpha^2. */
INLINE floats ggx(floats c2, float width)
{
    floats root = 1.0f / (c2 * (1.0f - width) + 4.0f * width);

    return root * root;
}

INLINE void add_weighted(const pe_block *b, floats d, lane_sums *sums)
{
    for (int c = 0; c < 4; c++)
        sums->value[c] += d * load(b->values[c]);
}

/* Keeps of d what belongs to lights above the horizon, c^2 < 2. */
INLINE floats above(floats c2, floats d)
{
    return (floats)((ints)d & (c2 < 2.0f));
}

/* The same where it has to be right for lights on the horizon itself. */
INLINE floats above_horizon(const pe_block *b, const double w[3], floats d)
{
    doubles x, y, z;
    longs above;

    memcpy(&x, b->direction[0], sizeof x);
    memcpy(&y, b->direction[1], sizeof y);
    memcpy(&z, b->direction[2], sizeof z);
    above = x * w[0] + y * w[1] + z * w[2] > PE_HORIZON;
    return (floats)((ints)d & __builtin_convertvector(above, ints));
}

/* Adds blocks, seen from w, to the sums: `whole` and `edge` as in a view. */
#define ISOTROPIC(lobe) \
    CLONES static void lobe##_whole(const pe_block *blocks, const uint32_t *index, size_t count, const double w[3], \
                                    float width, lane_sums *sums) \
    { \
        const float rounded[3] = { (float)w[0], (float)w[1], (float)w[2] }; \
\
        for (size_t k = 0; k < count; k++) { \
            const pe_block *b = &blocks[index[k]]; \
            floats c2 = chord_squared(b, rounded); \
\
            add_weighted(b, above(c2, lobe(c2, width)), sums); \
        } \
    } \
    CLONES static void lobe##_edge(const pe_block *blocks, const uint32_t *index, size_t count, const double w[3], \
                                   float width, lane_sums *sums) \
    { \
        const float rounded[3] = { (float)w[0], (float)w[1], (float)w[2] }; \
\
        for (size_t k = 0; k < count; k++) { \
            const pe_block *b = &blocks[index[k]]; \
\
            add_weighted(b, above_horizon(b, w, lobe(chord_squared(b, rounded), width)), sums); \
        } \
    }

ISOTROPIC(beckmann)
ISOTROPIC(ggx)

static void flush(const lane_sums *lanes, double sums[4])
{
    for (int c = 0; c < 4; c++)
        for (int k = 0; k < LANES; k++)
            sums[c] += (double)lanes->value[c][k];
}

/* So many blocks stay in the nearest cache for all texels of a tile, and sum to single precision. */
#define BLOCKS_AT_ONCE 64

typedef void isotropic_function(const pe_block *blocks, const uint32_t *index, size_t count, const double w[3],
                                float width, lane_sums *sums);

static void filter_isotropic(isotropic_function *function, float width, const pe_block_list *l,
                             const double (*world)[3], size_t count, double (*sums)[4])
{
    for (size_t first = 0; first < l->count; first += BLOCKS_AT_ONCE) {
        size_t some = l->count - first < BLOCKS_AT_ONCE ? l->count - first : BLOCKS_AT_ONCE;

        for (size_t k = 0; k < count; k++) {
            lane_sums lanes = { 0 };

            function(l->blocks, l->index + first, some, world[k], width, &lanes);
            flush(&lanes, sums[k]);
        }
    }
}

int pe_tile_view_add_isotropic(const pe_tile_view *view, const pe_lobe *lobe, const double (*world)[3], size_t count,
                               double (*sums)[4])
{
    const pe_ndf *ndf = &lobe->surface.ndf;
    double alpha2 = ndf->alpha_x * ndf->alpha_x;

    if (ndf->alpha_x != ndf->alpha_y || lobe->surface.weight != PE_WEIGHT_NDF)
        return 0;
    switch (ndf->kind) {
    case PE_NDF_BECKMANN:
        filter_isotropic(beckmann_whole, (float)(M_LOG2E / alpha2), &view->whole, world, count, sums);
        filter_isotropic(beckmann_edge, (float)(M_LOG2E / alpha2), &view->edge, world, count, sums);
        return 1;
    case PE_NDF_GGX:
        filter_isotropic(ggx_whole, (float)alpha2, &view->whole, world, count, sums);
        filter_isotropic(ggx_edge, (float)alpha2, &view->edge, world, count, sums);
        return 1;
    default:
        return 0;
    }
}
