/* strip.c - see strip.h. */
#include "strip.h"

#include "lanes.h"
#include "status.h"

#include <stdlib.h>

/* ---- make ---- */

double pe_strip_bytes(int width, int height)
{
    return 2.0 * width * height * PE_STRIP_LANES * sizeof(float);
}

static void set_texel(const pe_strip *strip, int x, int y, float *lanes)
{
    const pe_env *first = strip->env[0];
    size_t texel = (size_t)y * (size_t)first->width + (size_t)x;
    float solid_angle = (float)first->grid.solid_angle_sr[y];

    memset(lanes, 0, PE_STRIP_LANES * sizeof *lanes);
    for (int k = 0; k < strip->count; k++)
        for (int c = 0; c < 3; c++)
            lanes[3 * k + c] = solid_angle * strip->env[k]->rgb[3 * texel + (size_t)c];
    lanes[PE_STRIP_WEIGHT] = solid_angle;
}

static void set_texels(pe_strip *strip)
{
    float *lanes = strip->texels;

    for (int y = 0; y < strip->env[0]->height; y++)
        for (int x = 0; x < strip->env[0]->width; x++, lanes += PE_STRIP_LANES)
            set_texel(strip, x, y, lanes);
}

CLONES static void share_texel(const float *texel, const float across[PE_TILE_NODES], const float down[PE_TILE_NODES],
                               float *lights)
{
    floats value = load(texel);

    for (int j = 0; j < PE_TILE_NODES; j++)
        for (int i = 0; i < PE_TILE_NODES; i++, lights += LANES) {
            floats sum = load(lights) + across[i] * down[j] * value;

            memcpy(lights, &sum, sizeof sum);
        }
}

static void share_tile(const pe_strip *strip, const pe_rect *area, float *lights)
{
    int width = strip->env[0]->width;
    float across[PE_TILE_NODES], down[PE_TILE_NODES];

    memset(lights, 0, (size_t)PE_TILE_NODES * PE_TILE_NODES * PE_STRIP_LANES * sizeof *lights);
    for (int y = area->top; y < area->bottom; y++) {
        pe_tile_shares(&strip->tiles, y - area->top, area->bottom - area->top, down);
        for (int x = area->left; x < area->right; x++) {
            pe_tile_shares(&strip->tiles, x - area->left, area->right - area->left, across);
            share_texel(strip->texels + PE_STRIP_LANES * ((size_t)y * (size_t)width + (size_t)x), across, down, lights);
        }
    }
}

static float *allocate_lanes(size_t count)
{
    return aligned_alloc(PE_STRIP_LANES * sizeof(float), count * PE_STRIP_LANES * sizeof(float));
}

static void set_lights(pe_strip *strip)
{
    const size_t step = (size_t)PE_TILE_NODES * PE_TILE_NODES * PE_STRIP_LANES;

    for (size_t k = 0; k < strip->tiles.count; k++)
        share_tile(strip, &strip->tiles.tiles[k].area, strip->lights + k * step);
}

pe_status pe_strip_make(const pe_env *const *envs, int count, double side_rad, pe_strip *strip, pe_error *error)
{
    pe_status status;

    *strip = (pe_strip){ .count = count };
    for (int k = 0; k < count; k++)
        strip->env[k] = envs[k];
    status = pe_tiles_make(&envs[0]->grid, side_rad, &strip->tiles, error);
    if (status != PE_OK)
        return status;
    strip->texels = allocate_lanes((size_t)envs[0]->width * (size_t)envs[0]->height);
    strip->lights = strip->tiles.nodes > 1 ? allocate_lanes(pe_tiles_lights(&strip->tiles)) : strip->texels;
    if (!strip->texels || !strip->lights) {
        pe_strip_free(strip);
        return pe_fail_memory(error, "the lights of several frames");
    }
    set_texels(strip);
    if (strip->tiles.nodes > 1)
        set_lights(strip);
    return PE_OK;
}

void pe_strip_free(pe_strip *strip)
{
    if (strip->lights != strip->texels)
        free(strip->lights);
    free(strip->texels);
    pe_tiles_free(&strip->tiles);
    *strip = (pe_strip){ 0 };
}

/* ---- spread ---- */

/* Lights above the horizon that wait to be spread together. */
enum { WAITING_MAX = 64 };

typedef struct queue {
    const pe_frame *frame;
    const pe_disc *cells;
    float *to;
    int count;
    float x[WAITING_MAX], y[WAITING_MAX], z[WAITING_MAX]; /* in the world */
    const float *lanes[WAITING_MAX];
} queue;

/* Where lights lie among the cells, and their shares: pe_disc_taps of many. */
typedef struct places {
    int cell[WAITING_MAX];
    float across[4][WAITING_MAX], down[4][WAITING_MAX];
} places;

INLINE void square_root(floats *v)
{
    float lanes[LANES];

    memcpy(lanes, v, sizeof lanes);
    for (int k = 0; k < LANES; k++)
        lanes[k] = sqrtf(lanes[k]);
    memcpy(v, lanes, sizeof lanes);
}

/* The taps of points along one axis. */
INLINE void taps_along(int side, const floats *point, ints *tap, float (*shares)[WAITING_MAX], int at)
{
    floats t, s, w;

    *tap = __builtin_convertvector(*point - 0.5f, ints);
    *tap = (*tap & (*tap >= 1)) + ((*tap < 1) & 1);
    *tap += (*tap > side - 3) & (side - 3 - *tap);
    t = *point - 0.5f - __builtin_convertvector(*tap, floats);
    s = 1 - t;
    w = s * s * s * (1 / 6.0f);
    memcpy(&shares[0][at], &w, sizeof w);
    w = (4 - 3 * t * t * (2 - t)) * (1 / 6.0f);
    memcpy(&shares[1][at], &w, sizeof w);
    w = (4 - 3 * s * s * (2 - s)) * (1 / 6.0f);
    memcpy(&shares[2][at], &w, sizeof w);
    w = t * t * t * (1 / 6.0f);
    memcpy(&shares[3][at], &w, sizeof w);
}

INLINE void project(const double axis[3], const floats *x, const floats *y, const floats *z, floats *out)
{
    *out = (float)axis[0] * *x + (float)axis[1] * *y + (float)axis[2] * *z;
}

INLINE void place_lights(const queue *q, places *p)
{
    for (int k = 0; k < q->count; k += LANES) {
        floats x = load(q->x + k), y = load(q->y + k), z = load(q->z + k), t, b, up;
        ints column, row;

        project(q->frame->t, &x, &y, &z, &t);
        project(q->frame->b, &x, &y, &z, &b);
        project(q->frame->n, &x, &y, &z, &up);
        up = (floats)((ints)up & (up > 0));
        up += 1;
        square_root(&up);
        t = t / up * (float)pe_disc_radius(q->cells->width) + 0.5f * (float)q->cells->width;
        b = b / up * (float)pe_disc_radius(q->cells->height) + 0.5f * (float)q->cells->height;
        taps_along(q->cells->width, &t, &column, p->across, k);
        taps_along(q->cells->height, &b, &row, p->down, k);
        column += (row - 1) * q->cells->width - 1;
        memcpy(p->cell + k, &column, sizeof column);
    }
}

INLINE void add_light(const places *p, int k, const float *lanes, int width, float *to)
{
    floats value = load(lanes);
    float *cell = to + (size_t)LANES * (size_t)p->cell[k];

    for (int j = 0; j < 4; j++, cell += LANES * (width - 4)) {
        floats part = p->down[j][k] * value;

        for (int i = 0; i < 4; i++, cell += LANES) {
            floats sum = load(cell) + p->across[i][k] * part;

            memcpy(cell, &sum, sizeof sum);
        }
    }
}

CLONES static void spread_waiting(queue *q)
{
    places p;

    place_lights(q, &p);
    for (int k = 0; k < q->count; k++)
        add_light(&p, k, q->lanes[k], q->cells->width, q->to);
    q->count = 0;
}

static void add_waiting(queue *q, const float direction[3], const float *lanes)
{
    int k = q->count++;

    q->x[k] = direction[0];
    q->y[k] = direction[1];
    q->z[k] = direction[2];
    q->lanes[k] = lanes;
    if (q->count == WAITING_MAX)
        spread_waiting(q);
}

/* The texels of a tile across the horizon. */
static void add_upper_part(const pe_strip *strip, const pe_rect *area, queue *q)
{
    const pe_env *env = strip->env[0];

    for (int y = area->top; y < area->bottom; y++)
        for (int x = area->left; x < area->right; x++) {
            double world[3];
            float direction[3];

            pe_grid_direction(&env->grid, x, y, world);
            if (!(pe_dot(q->frame->n, world) > PE_HORIZON))
                continue;
            for (int c = 0; c < 3; c++)
                direction[c] = (float)world[c];
            add_waiting(q, direction, strip->texels + PE_STRIP_LANES * ((size_t)y * (size_t)env->width + (size_t)x));
        }
}

void pe_strip_spread(const pe_strip *strip, const pe_frame *frame, const pe_disc *cells, float *to)
{
    const pe_tiles *tiles = &strip->tiles;
    size_t nodes = (size_t)tiles->nodes * (size_t)tiles->nodes;
    queue q = { .frame = frame, .cells = cells, .to = to };

    for (size_t tile = 0; tile < tiles->count; tile++) {
        const pe_tile *t = &tiles->tiles[tile];
        double height = frame->n[0] * (double)t->direction[0] + frame->n[1] * (double)t->direction[1] +
                        frame->n[2] * (double)t->direction[2];

        if (height > (double)t->chord + PE_HORIZON)
            for (size_t k = tile * nodes; k < (tile + 1) * nodes; k++)
                add_waiting(&q, tiles->directions[k], strip->lights + k * PE_STRIP_LANES);
        else if (height >= -(double)t->chord)
            add_upper_part(strip, &t->area, &q);
    }
    if (q.count)
        spread_waiting(&q);
}
