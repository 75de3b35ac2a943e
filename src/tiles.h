/* tiles.h - places for the lights of any environment of one size: whatever shines there, they stay.
 *
 * The sphere's texels are cut into tiles of about one size.  In each stand 3 x 3 lights, between which each texel's
 * light is shared by Lagrange's polynomials: what a lobe makes of a tile is exact as far as the lobe is a biquadratic
 * polynomial within it, however unevenly the tile shines.  Tiles that would be too small for that are single texels,
 * each a light. */
#ifndef PE_TILES_H
#define PE_TILES_H

#include "env.h"
#include "filter.h"

#define PE_TILE_NODES 3

typedef struct pe_tile {
    pe_rect area;
    float direction[3], chord; /* its middle; no texel of it and no light is farther, by the chord of unit vectors */
} pe_tile;

typedef struct pe_tiles {
    int nodes; /* along each side of a tile: PE_TILE_NODES, or 1 where tiles are texels */
    size_t count;
    pe_tile *tiles;
    float (*directions)[3]; /* of the lights, nodes^2 for each tile in turn, row by row */
} pe_tiles;

/* The grid is that of the environments; side_rad: of a tile. */
pe_status pe_tiles_make(const pe_grid *grid, double side_rad, pe_tiles *tiles, pe_error *error);
void pe_tiles_free(pe_tiles *tiles);

static inline size_t pe_tiles_lights(const pe_tiles *tiles)
{
    return tiles->count * (size_t)tiles->nodes * (size_t)tiles->nodes;
}

/* What each node along a side of `count` texels has of texel k. */
void pe_tile_shares(const pe_tiles *tiles, int k, int count, float shares[PE_TILE_NODES]);

#endif
