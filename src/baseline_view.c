/* baseline_view.c - what the texels of a tile see of the lights.
 *
 * What is out of a tile's reach is left out block by block; of what may lie behind the surface of one of its texels,
 * what does is left out one by one: lights, or, where the lobe is so wide that it matters which part of a light lies
 * astride the horizon, the texels that a light stands for. */
#include "baseline_lights.h"

#include <stdlib.h>

void pe_tile_view_free(pe_tile_view *v)
{
    free(v->whole.index);
    free(v->edge.index);
    free(v->parts);
}

/* One more light in parts; 0 if memory does not suffice. */
static int add_part(pe_tile_view *v, const double direction[3], const float values[4])
{
    if (v->parts_count == 0 || v->used == LANES) {
        if (v->parts_count == v->parts_room) {
            size_t room = 2 * v->parts_room + 64;
            pe_block *more = aligned_alloc(64, room * sizeof *more);

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
    pe_block_set(&v->parts[v->parts_count - 1], v->used++, direction, values);
    return 1;
}

static int add_texels(pe_tile_view *v, const pe_env *env, const pe_rect *area)
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
static int add_parts(pe_tile_view *v, const pe_cloud *cloud, const pe_block *b, size_t first)
{
    double tile_chord = 2 * sin(v->tile.radius / 2) + 1e-6;

    for (int lane = 0; lane < LANES && first + (size_t)lane < cloud->count; lane++) {
        size_t light = first + (size_t)lane;
        const float values[4] = { b->values[0][lane], b->values[1][lane], b->values[2][lane], b->values[3][lane] };
        double direction[3], cosine;

        pe_block_direction(b, lane, direction);
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
static int look_at(const pe_head_on *h, size_t k, pe_tile_view *v)
{
    const pe_cone *at = &h->cones[k];
    double cosine = pe_dot(at->axis, v->tile.axis), apart, spread, slack;
    pe_block_list *to;

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

static int list_make(const pe_block *blocks, size_t room, pe_block_list *l)
{
    *l = (pe_block_list){ blocks, malloc((room ? room : 1) * sizeof *l->index), 0 };
    return l->index != NULL;
}

/* The parts become the edge. */
static int take_parts(pe_tile_view *v)
{
    if (v->parts_count)
        pe_block_pad(&v->parts[v->parts_count - 1], v->used);
    if (!list_make(v->parts, v->parts_count, &v->edge))
        return 0;
    for (; v->edge.count < v->parts_count; v->edge.count++)
        v->edge.index[v->edge.count] = (uint32_t)v->edge.count;
    return 1;
}

int pe_tile_view_make(const pe_head_on *h, const double (*world)[3], size_t count, pe_tile_view *v)
{
    *v = (pe_tile_view){ 0 };
    pe_cone_around(&v->tile, world, count);
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
