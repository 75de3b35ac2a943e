/* baseline.c - one map, every texel seen head on. [Motegi Fig. 3a]
 *
 * With n = o = w, the half vector of a light l at the distance c = |l - w| has
 *
 *     tan^2(theta_h) = c^2 / (4 - c^2),   1 / cos^2(theta_h) = 4 / (4 - c^2)
 *
 * so that the weight of an isotropic lobe depends on c^2 alone, and no tangent frame is needed.  Any other surface is
 * filtered as everywhere else, in the frame of each texel.
 *
 * Texels are done in tiles.  What is out of a tile's reach is left out block by block; of what may lie behind the
 * surface of one of its texels, what does is left out one by one: lights, or, where the lobe is so wide that it matters
 * which part of a light lies astride the horizon, the texels that a light stands for. */
#include "baseline.h"

#include "lanes.h"
#include "status.h"

#include <stdint.h>
#include <stdlib.h>

typedef double doubles __attribute__((vector_size(8 * LANES)));
typedef long long longs __attribute__((vector_size(8 * LANES)));

/* 16 lights: unit directions, to double and to single precision, solid angle, and radiance times solid angle. */
typedef struct block {
    double direction[3][LANES];
    float rounded[3][LANES];
    float values[4][LANES];
} block;

/* All lights of a block lie within `radius` of axis, and all their texels within `extent`. */
typedef struct cone {
    double axis[3];
    double radius, extent;
} cone;

struct pe_head_on {
    const pe_cloud *cloud;
    const pe_lobe *lobe;
    double direction[3];
    double lobe_reach;
    double radius_max; /* of the cones */
    int takes_apart;   /* lights astride a horizon are taken apart into their texels */
    size_t count;
    block *blocks;
    cone *cones;
};

/* ---- blocks ---- */

static void set_light(block *to, int lane, const double direction[3], const float values[4])
{
    for (int c = 0; c < 3; c++) {
        to->direction[c][lane] = direction[c];
        to->rounded[c][lane] = (float)direction[c];
    }
    for (int c = 0; c < 4; c++)
        to->values[c][lane] = values[c];
}

static void set_cloud_light(const pe_cloud *cloud, size_t light, block *to, int lane)
{
    const double direction[3] = { cloud->x[light], cloud->y[light], cloud->z[light] };
    const float values[4] = { cloud->weight_sr[light], cloud->r[light], cloud->g[light], cloud->b[light] };

    set_light(to, lane, direction, values);
}

static void get_direction(const block *from, int lane, double direction[3])
{
    for (int c = 0; c < 3; c++)
        direction[c] = from->direction[c][lane];
}

/* The last light again, without weight, fills up a block: it adds exactly nothing. */
static void pad(block *to, int used)
{
    const float nothing[4] = { 0 };
    double direction[3];

    get_direction(to, used - 1, direction);
    for (int lane = used; lane < LANES; lane++)
        set_light(to, lane, direction, nothing);
}

/* The cone around directions; a hair wider than it need be, for rounding. */
static void set_cone(cone *to, const double (*directions)[3], size_t count)
{
    double sum[3] = { 0 }, narrowest = 1;

    *to = (cone){ { 0, 0, 1 }, M_PI, M_PI };
    for (size_t k = 0; k < count; k++)
        for (int c = 0; c < 3; c++)
            sum[c] += directions[k][c];
    if (!(pe_dot(sum, sum) > 1e-12))
        return;
    pe_normalize(sum, to->axis);
    for (size_t k = 0; k < count; k++)
        narrowest = fmin(narrowest, pe_dot(to->axis, directions[k]));
    to->radius = to->extent = acos(fmax(narrowest, -1)) + 1e-6;
}

/* The angle that a chord of the unit sphere is seen under. */
static double angle_of(double chord)
{
    return 2 * asin(fmin(chord / 2, 1));
}

static void set_block(pe_head_on *h, size_t index)
{
    double directions[LANES][3];
    size_t first = index * LANES;
    cone *at = &h->cones[index];
    int used = 0;

    for (; used < LANES && first + (size_t)used < h->cloud->count; used++)
        set_cloud_light(h->cloud, first + (size_t)used, &h->blocks[index], used);
    pad(&h->blocks[index], used);
    for (int lane = 0; lane < LANES; lane++)
        get_direction(&h->blocks[index], lane, directions[lane]);
    set_cone(at, (const double(*)[3])directions, LANES);
    for (int lane = 0; lane < used && h->takes_apart; lane++) {
        double apart = acos(fmin(pe_dot(at->axis, directions[lane]), 1));

        at->extent = fmax(at->extent, apart + angle_of((double)h->cloud->chord[first + (size_t)lane]));
    }
}

/* Beyond exp(-7), a thousandth of the mirror's weight, it does not matter on which side of a light the horizon is. */
#define LIMIT_OF_HORIZON 7

pe_status pe_head_on_make(const pe_cloud *cloud, const pe_lobe *lobe, const double direction[3], double lobe_reach,
                          pe_head_on **out, pe_error *error)
{
    pe_head_on *h = calloc(1, sizeof *h);

    if (!h)
        return pe_fail_memory(error, "the lights of a baseline map");
    *h = (pe_head_on){ .cloud = cloud,
                       .lobe = lobe,
                       .direction = { direction[0], direction[1], direction[2] },
                       .lobe_reach = lobe_reach,
                       .count = (cloud->count + LANES - 1) / LANES,
                       .takes_apart = cloud->chord && pe_lobe_reach(lobe, LIMIT_OF_HORIZON) > M_PI / 2 };
    h->blocks = aligned_alloc(64, h->count * sizeof *h->blocks);
    h->cones = malloc(h->count * sizeof *h->cones);
    if (!h->blocks || !h->cones) {
        pe_head_on_free(h);
        return pe_fail_memory(error, "the lights of a baseline map");
    }
    for (size_t k = 0; k < h->count; k++) {
        set_block(h, k);
        h->radius_max = fmax(h->radius_max, h->cones[k].radius);
    }
    *out = h;
    return PE_OK;
}

void pe_head_on_free(pe_head_on *h)
{
    if (!h)
        return;
    free(h->blocks);
    free(h->cones);
    free(h);
}

/* ---- what a tile sees ---- */

/* Blocks that matter, by their index. */
typedef struct list {
    const block *blocks;
    uint32_t *index;
    size_t count;
} list;

/* `whole` are above the horizon of every texel of the tile, or lights of several texels of which it does not matter;
 * `edge` perhaps not.  The edge blocks are among those of the cloud, or `parts`, where lights were taken apart. */
typedef struct view {
    cone tile;
    double cos_farthest; /* blocks beyond are out of reach */
    double cos_reach;    /* lights beyond are */
    list whole, edge;
    block *parts;
    size_t parts_count, parts_room;
    int used; /* lights in the last of parts */
} view;

static void view_free(view *v)
{
    free(v->whole.index);
    free(v->edge.index);
    free(v->parts);
}

/* One more light in parts; 0 if memory does not suffice. */
static int add_part(view *v, const double direction[3], const float values[4])
{
    if (v->parts_count == 0 || v->used == LANES) {
        if (v->parts_count == v->parts_room) {
            size_t room = 2 * v->parts_room + 64;
            block *more = aligned_alloc(64, room * sizeof *more);

            if (!more)
                return 0;
            if (v->parts_count)
                memcpy(more, v->parts, v->parts_count * sizeof *more);
            free(v->parts);
            v->parts = more;
            v->parts_room = room;
        }
        v->parts_count++;
        v->used = 0;
    }
    set_light(&v->parts[v->parts_count - 1], v->used++, direction, values);
    return 1;
}

static int add_texels(view *v, const pe_env *env, const pe_rect *area)
{
    for (int y = area->top; y < area->bottom; y++)
        for (int x = area->left; x < area->right; x++) {
            const float *texel = env->rgb + 3 * ((size_t)y * (size_t)env->width + (size_t)x);
            float weight = (float)env->grid.solid_angle_sr[y];
            const float values[4] = { weight, weight * texel[0], weight * texel[1], weight * texel[2] };
            double direction[3];

            pe_grid_direction(&env->grid, x, y, direction);
            if (!add_part(v, direction, values))
                return 0;
        }
    return 1;
}

/* Of a block some of whose lights may lie astride a horizon of the tile's, those within reach. */
static int add_parts(view *v, const pe_cloud *cloud, const block *b, size_t first)
{
    double tile_chord = 2 * sin(v->tile.radius / 2) + 1e-6;

    for (int lane = 0; lane < LANES && first + (size_t)lane < cloud->count; lane++) {
        size_t light = first + (size_t)lane;
        const float values[4] = { b->values[0][lane], b->values[1][lane], b->values[2][lane], b->values[3][lane] };
        double direction[3], cosine;

        get_direction(b, lane, direction);
        cosine = pe_dot(v->tile.axis, direction);
        if (cosine < v->cos_reach)
            continue;
        if (fabs(cosine) <= (double)cloud->chord[light] + tile_chord) {
            if (!add_texels(v, cloud->env, &cloud->areas[light]))
                return 0;
        } else if (!add_part(v, direction, values)) {
            return 0;
        }
    }
    return 1;
}

/* Sorts block k into the view, or leaves it out. */
static int look_at(const pe_head_on *h, size_t k, view *v)
{
    const cone *at = &h->cones[k];
    double cosine = pe_dot(at->axis, v->tile.axis), apart, spread, slack;
    list *to;

    if (cosine < v->cos_farthest)
        return 1;
    apart = acos(fmin(cosine, 1));
    spread = at->radius + v->tile.radius;
    slack = at->extent + v->tile.radius + 1e-6;
    if (apart > h->lobe_reach + spread || apart > M_PI / 2 + slack)
        return 1;
    if (apart >= M_PI / 2 - slack && h->takes_apart)
        return add_parts(v, h->cloud, &h->blocks[k], k * LANES);
    to = apart < M_PI / 2 - slack || h->cloud->chord ? &v->whole : &v->edge;
    to->index[to->count++] = (uint32_t)k;
    return 1;
}

static int list_make(const block *blocks, size_t room, list *l)
{
    *l = (list){ blocks, malloc((room ? room : 1) * sizeof *l->index), 0 };
    return l->index != NULL;
}

/* The parts become the edge. */
static int take_parts(view *v)
{
    if (v->parts_count)
        pad(&v->parts[v->parts_count - 1], v->used);
    if (!list_make(v->parts, v->parts_count, &v->edge))
        return 0;
    for (; v->edge.count < v->parts_count; v->edge.count++)
        v->edge.index[v->edge.count] = (uint32_t)v->edge.count;
    return 1;
}

/* Whatever it returns, view_free has to follow; 0 if memory does not suffice. */
static int look(const pe_head_on *h, const double (*world)[3], size_t count, view *v)
{
    *v = (view){ 0 };
    set_cone(&v->tile, world, count);
    v->cos_reach = cos(fmin(h->lobe_reach + v->tile.radius, M_PI)) - 1e-9;
    v->cos_farthest = cos(fmin(h->lobe_reach + v->tile.radius + h->radius_max, M_PI)) - 1e-9;
    if (!list_make(h->blocks, h->count, &v->whole))
        return 0;
    if (!h->takes_apart && !list_make(h->blocks, h->count, &v->edge))
        return 0;
    for (size_t k = 0; k < h->count; k++)
        if (!look_at(h, k, v))
            return 0;
    return !h->takes_apart || take_parts(v);
}

/* ---- isotropic lobes ---- */

typedef struct lane_sums {
    floats value[4]; /* weight, red, green, blue */
} lane_sums;

/* c^2 = |l - w|^2 of a block's lights. */
INLINE floats chord_squared(const block *b, const float w[3])
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

INLINE void add_weighted(const block *b, floats d, lane_sums *sums)
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
INLINE floats above_horizon(const block *b, const double w[3], floats d)
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
    CLONES static void lobe##_whole(const block *blocks, const uint32_t *index, size_t count, const double w[3], \
                                    float width, lane_sums *sums) \
    { \
        const float rounded[3] = { (float)w[0], (float)w[1], (float)w[2] }; \
\
        for (size_t k = 0; k < count; k++) { \
            const block *b = &blocks[index[k]]; \
            floats c2 = chord_squared(b, rounded); \
\
            add_weighted(b, above(c2, lobe(c2, width)), sums); \
        } \
    } \
    CLONES static void lobe##_edge(const block *blocks, const uint32_t *index, size_t count, const double w[3], \
                                   float width, lane_sums *sums) \
    { \
        const float rounded[3] = { (float)w[0], (float)w[1], (float)w[2] }; \
\
        for (size_t k = 0; k < count; k++) { \
            const block *b = &blocks[index[k]]; \
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

typedef void isotropic_function(const block *blocks, const uint32_t *index, size_t count, const double w[3],
                                float width, lane_sums *sums);

static void filter_isotropic(isotropic_function *function, float width, const list *l, const double (*world)[3],
                             size_t count, double (*sums)[4])
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

/* ---- any surface ---- */

#define LIGHT_BLOCKS 4
#define BLOCKS_PER_LIGHT_BLOCK (PE_LIGHT_BLOCK / LANES)

/* Lights in the frame of one texel, as pe_filter_points takes them. */
typedef struct turned {
    _Alignas(64) float values[LIGHT_BLOCKS][PE_LIGHT_VALUES][PE_LIGHT_BLOCK];
    pe_light_block cones[LIGHT_BLOCKS];
} turned;

/* What is not above the horizon becomes a light straight above, without weight. */
static void turn_block(const block *b, const pe_lobe *lobe, const pe_frame *frame, float (*values)[PE_LIGHT_BLOCK],
                       int first)
{
    for (int lane = 0; lane < LANES; lane++) {
        double world[3], local[3];
        int at = first + lane;

        get_direction(b, lane, world);
        pe_frame_coordinates(frame, world, local);
        if (local[2] > PE_HORIZON) {
            for (int c = 0; c < 3; c++)
                values[c][at] = (float)local[c];
            for (int c = 0; c < 4; c++)
                values[3 + c][at] = b->values[c][lane];
            if (lobe->surface.weight == PE_WEIGHT_MICROFACET)
                values[7][at] = (float)pe_ndf_lambda(&lobe->surface.ndf, local);
        } else {
            for (int c = 0; c < PE_LIGHT_VALUES; c++)
                values[c][at] = c == 2;
        }
    }
}

static void add_turned(const pe_lobe *lobe, const double brush[3], const block *blocks, const uint32_t *index,
                       size_t count, const double world[3], turned *lights, double sums[4])
{
    static const float head_on[1][3] = { { 0, 0, 1 } };
    pe_lights all = { (count + BLOCKS_PER_LIGHT_BLOCK - 1) / BLOCKS_PER_LIGHT_BLOCK, &lights->values[0][0][0],
                      lights->cones };
    double some[1][4];
    pe_frame frame;

    pe_frame_make(world, brush, &frame);
    for (size_t k = 0; k < all.blocks * BLOCKS_PER_LIGHT_BLOCK; k++) {
        float(*values)[PE_LIGHT_BLOCK] = lights->values[k / BLOCKS_PER_LIGHT_BLOCK];
        int first = (int)(k % BLOCKS_PER_LIGHT_BLOCK) * LANES;

        if (k < count)
            turn_block(&blocks[index[k]], lobe, &frame, values, first);
        for (int c = 0; c < PE_LIGHT_VALUES && k >= count; c++)
            for (int lane = 0; lane < LANES; lane++)
                values[c][first + lane] = c == 2;
    }
    pe_filter_points(lobe, &all, head_on, 1, some);
    for (int c = 0; c < 4; c++)
        sums[c] += some[0][c];
}

static void filter_any(const pe_lobe *lobe, const double brush[3], const list *l, const double (*world)[3],
                       size_t count, double (*sums)[4])
{
    const size_t at_once = (size_t)LIGHT_BLOCKS * BLOCKS_PER_LIGHT_BLOCK;
    turned lights;

    for (int k = 0; k < LIGHT_BLOCKS; k++)
        lights.cones[k] = (pe_light_block){ { 0, 0, 1 }, -2 };
    for (size_t first = 0; first < l->count; first += at_once)
        for (size_t k = 0; k < count; k++)
            add_turned(lobe, brush, l->blocks, l->index + first,
                       l->count - first < at_once ? l->count - first : at_once, world[k], &lights, sums[k]);
}

/* ---- a tile ---- */

static void filter_view(const pe_lobe *lobe, const double brush[3], const view *v, const double (*world)[3],
                        size_t count, double (*sums)[4])
{
    const pe_ndf *ndf = &lobe->surface.ndf;
    double alpha2 = ndf->alpha_x * ndf->alpha_x;
    int isotropic = ndf->alpha_x == ndf->alpha_y && lobe->surface.weight == PE_WEIGHT_NDF;

    if (isotropic && ndf->kind == PE_NDF_BECKMANN) {
        filter_isotropic(beckmann_whole, (float)(M_LOG2E / alpha2), &v->whole, world, count, sums);
        filter_isotropic(beckmann_edge, (float)(M_LOG2E / alpha2), &v->edge, world, count, sums);
    } else if (isotropic && ndf->kind == PE_NDF_GGX) {
        filter_isotropic(ggx_whole, (float)alpha2, &v->whole, world, count, sums);
        filter_isotropic(ggx_edge, (float)alpha2, &v->edge, world, count, sums);
    } else {
        filter_any(lobe, brush, &v->whole, world, count, sums);
        filter_any(lobe, brush, &v->edge, world, count, sums);
    }
}

pe_status pe_head_on_filter(const pe_head_on *h, const double (*world)[3], size_t count, double (*sums)[4],
                            pe_error *error)
{
    view v;
    int enough = look(h, world, count, &v);

    memset(sums, 0, count * sizeof *sums);
    if (enough)
        filter_view(h->lobe, h->direction, &v, world, count, sums);
    view_free(&v);
    return enough ? PE_OK : pe_fail_memory(error, "what a tile of a baseline map sees");
}

/* ---- the map ---- */

#define TILE 8

typedef struct job {
    const pe_head_on *head_on;
    pe_maps *maps;
} job;

static pe_status fill_tile(const job *j, int left, int top, int right, int bottom)
{
    static const float head_on[3] = { 0, 0, 1 };
    double world[TILE * TILE][3], sums[TILE * TILE][4], rgb[3];
    const pe_maps_info *info = &j->maps->info;
    size_t count = 0, k = 0;
    pe_status status;

    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++)
            pe_grid_direction(&j->maps->grid, x, y, world[count++]);
    status = pe_head_on_filter(j->head_on, (const double(*)[3])world, count, sums, NULL);
    if (status != PE_OK)
        return status;
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++, k++) {
            float *out = j->maps->rgb + 3 * ((size_t)y * (size_t)info->width + (size_t)x);

            pe_filter_radiance(j->head_on->lobe, j->head_on->cloud->env, sums[k], world[k], head_on, rgb);
            for (int c = 0; c < 3; c++)
                out[c] = (float)rgb[c];
        }
    return PE_OK;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int fill_row(size_t row, void *data)
{
    const job *j = data;
    const pe_maps_info *info = &j->maps->info;
    int top = (int)row * TILE;

    for (int left = 0; left < info->width; left += TILE)
        if (fill_tile(j, left, top, least(left + TILE, info->width), least(top + TILE, info->height)) != PE_OK)
            return 0;
    return 1;
}

pe_status pe_baseline_fill(const pe_head_on *head_on, pe_maps *maps, int threads, const pe_report *report,
                           pe_error *error)
{
    size_t rows = ((size_t)maps->info.height + TILE - 1) / TILE;
    job j = { head_on, maps };
    pe_report by_rows = { report->function, report->data, 0, (double)rows };

    return pe_parallel_try(rows, threads, fill_row, &j, &by_rows, "what a tile of a baseline map sees", error);
}
