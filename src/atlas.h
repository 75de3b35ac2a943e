/* atlas.h - many small pictures of one size as one: side by side, row by row, nearly square. */
#ifndef PE_ATLAS_H
#define PE_ATLAS_H

#include <stddef.h>

typedef struct pe_atlas {
    int count, tile_width, tile_height; /* the small pictures */
    int columns, rows;
    int width, height; /* all together */
} pe_atlas;

/* The atlas of `count` >= 1 pictures. */
pe_atlas pe_atlas_of(int count, int tile_width, int tile_height);

/* Tile k's texels (3 * tile_width * tile_height floats) into the atlas (3 * width * height floats) and back. */
void pe_atlas_insert(const pe_atlas *atlas, int k, const float *tile, float *picture);
void pe_atlas_extract(const pe_atlas *atlas, int k, const float *picture, float *tile);

#endif
