/* atlas.c - see atlas.h. */
#include "atlas.h"

#include <string.h>

pe_atlas pe_atlas_of(int count, int tile_width, int tile_height)
{
    pe_atlas a = { .count = count, .tile_width = tile_width, .tile_height = tile_height, .columns = 1 };

    while ((long long)a.columns * a.columns * tile_width < (long long)count * tile_height)
        a.columns++;
    a.rows = (count + a.columns - 1) / a.columns;
    a.width = a.columns * tile_width;
    a.height = a.rows * tile_height;
    return a;
}

/* Where row y of tile k begins. */
static size_t place(const pe_atlas *a, int k, int y)
{
    size_t row = (size_t)(k / a->columns) * (size_t)a->tile_height + (size_t)y;

    return 3 * (row * (size_t)a->width + (size_t)(k % a->columns) * (size_t)a->tile_width);
}

void pe_atlas_insert(const pe_atlas *a, int k, const float *tile, float *picture)
{
    size_t values = 3 * (size_t)a->tile_width;

    for (int y = 0; y < a->tile_height; y++)
        memcpy(picture + place(a, k, y), tile + (size_t)y * values, values * sizeof *tile);
}

void pe_atlas_extract(const pe_atlas *a, int k, const float *picture, float *tile)
{
    size_t values = 3 * (size_t)a->tile_width;

    for (int y = 0; y < a->tile_height; y++)
        memcpy(tile + (size_t)y * values, picture + place(a, k, y), values * sizeof *tile);
}
