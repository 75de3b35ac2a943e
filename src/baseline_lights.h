/* baseline_lights.h - the lights of baseline maps, in blocks, and which of them a tile of texels sees. */
#ifndef PE_BASELINE_LIGHTS_H
#define PE_BASELINE_LIGHTS_H

#include "baseline.h"
#include "lanes.h"

#include <stdint.h>

/* 16 lights: unit directions, to double and to single precision, solid angle, and radiance times solid angle. */
typedef struct pe_block {
    double direction[3][LANES];
    float rounded[3][LANES];
    float values[4][LANES];
} pe_block;

/* All lights of a block lie within `radius` of axis, and all their texels within `extent`. */
typedef struct pe_cone {
    double axis[3];
    double radius, extent;
} pe_cone;

struct pe_head_on {
    const pe_cloud *cloud;
    const pe_lobe *lobe;
    double direction[3];
    double lobe_reach;
    double radius_max; /* of the cones */
    int takes_apart;   /* lights astride a horizon are taken apart into their texels */
    size_t count;
    pe_block *blocks;
    pe_cone *cones;
};

void pe_block_set(pe_block *block, int lane, const double direction[3], const float values[4]);
void pe_block_direction(const pe_block *block, int lane, double direction[3]);

/* The last light again, without weight, fills up a block: it adds exactly nothing. */
void pe_block_pad(pe_block *block, int used);

/* The cone around directions; a hair wider than it need be, for rounding. */
void pe_cone_around(pe_cone *cone, const double (*directions)[3], size_t count);

/* Blocks that matter, by their index. */
typedef struct pe_block_list {
    const pe_block *blocks;
    uint32_t *index;
    size_t count;
} pe_block_list;

/* `whole` are above the horizon of every texel of the tile, or lights of several texels of which it does not matter;
 * `edge` perhaps not.  The edge blocks are among those of the cloud, or `parts`, where lights were taken apart. */
typedef struct pe_tile_view {
    pe_cone tile;
    double cos_farthest; /* blocks beyond are out of reach */
    double cos_reach;    /* lights beyond are */
    pe_block_list whole, edge;
    pe_block *parts;
    size_t parts_count, parts_room;
    int used; /* lights in the last of parts */
} pe_tile_view;

/* Whatever it returns, pe_tile_view_free has to follow; 0 if memory does not suffice. */
int pe_tile_view_make(const pe_head_on *head_on, const double (*world)[3], size_t count, pe_tile_view *view);
void pe_tile_view_free(pe_tile_view *view);

/* Adds what each texel world[k] sees to sums[k], as pe_head_on_filter gives it, for an isotropic lobe of Eq. 4 by
 * Beckmann or GGX; 0, and nothing is added, for any other. */
int pe_tile_view_add_isotropic(const pe_tile_view *view, const pe_lobe *lobe, const double (*world)[3], size_t count,
                               double (*sums)[4]);

#endif
