/* tiles.c - see tiles.h.
 *
 * Bands of rows, cut into as many tiles as make them about square. */
#include "tiles.h"

#include "status.h"

#include <stdlib.h>

#define SIDE_MIN 4        /* texels, for three nodes */
#define AROUND_POLE_MIN 8 /* tiles of a band: those at the poles are wedges, which must not be too blunt */

/* Gauss and Legendre's places in [0, 1]: shared so, an even tile is exact to the fifth degree. */
static const double places[PE_TILE_NODES] = { 0.11270166537925831, 0.5, 0.88729833462074169 };

static int bands_of(double side_rad)
{
    return (int)fmax(1, ceil(M_PI / side_rad));
}

static int row_of(const pe_grid *grid, int band, int bands)
{
    return (int)((long long)band * grid->height / bands);
}

static int tiles_around(const pe_grid *grid, int top, int bottom)
{
    double middle = M_PI * (top + bottom) / 2.0 / grid->height, height = M_PI * (bottom - top) / grid->height;
    double count = fmax(AROUND_POLE_MIN, ceil(2 * M_PI * sin(middle) / height));

    return (int)fmin(count, grid->width);
}

static void direction_at(const pe_grid *grid, double x, double y, float direction[3])
{
    double theta = M_PI * y / grid->height, phi = 2 * M_PI * x / grid->width;

    direction[0] = (float)(sin(theta) * cos(phi));
    direction[1] = (float)cos(theta);
    direction[2] = (float)(sin(theta) * sin(phi));
}

static double distance2(const float a[3], const float b[3])
{
    double sum = 0;

    for (int c = 0; c < 3; c++)
        sum += (double)(a[c] - b[c]) * (double)(a[c] - b[c]);
    return sum;
}

/* The farthest of a tile's texels is on its rim. */
static float chord_of(const pe_grid *grid, const pe_tile *tile)
{
    const pe_rect *a = &tile->area;
    double farthest = 0;

    for (int y = a->top; y <= a->bottom; y++)
        for (int x = a->left; x <= a->right; x += y == a->top || y == a->bottom ? 1 : a->right - a->left) {
            float corner[3];

            direction_at(grid, x, y, corner);
            farthest = fmax(farthest, distance2(corner, tile->direction));
        }
    return (float)(sqrt(farthest) + 1e-5);
}

static void add_tile(const pe_grid *grid, const pe_rect *area, pe_tiles *out)
{
    pe_tile *tile = &out->tiles[out->count];
    float(*light)[3] = out->directions + out->count++ * (size_t)out->nodes * (size_t)out->nodes;
    double width = area->right - area->left, height = area->bottom - area->top;

    tile->area = *area;
    direction_at(grid, area->left + width / 2, area->top + height / 2, tile->direction);
    tile->chord = out->nodes > 1 ? chord_of(grid, tile) : 0;
    for (int j = 0; j < out->nodes; j++)
        for (int i = 0; i < out->nodes; i++) {
            double x = out->nodes > 1 ? places[i] : 0.5, y = out->nodes > 1 ? places[j] : 0.5;

            direction_at(grid, area->left + x * width, area->top + y * height, *light++);
        }
}

static void add_band(const pe_grid *grid, int top, int bottom, int count, pe_tiles *out)
{
    for (int k = 0; k < count; k++) {
        pe_rect area = { (int)((long long)k * grid->width / count), top, (int)((k + 1LL) * grid->width / count),
                         bottom };

        add_tile(grid, &area, out);
    }
}

static size_t count_tiles(const pe_grid *grid, int bands)
{
    size_t count = 0;

    for (int band = 0; band < bands; band++)
        count += (size_t)tiles_around(grid, row_of(grid, band, bands), row_of(grid, band + 1, bands));
    return count;
}

void pe_tiles_free(pe_tiles *tiles)
{
    free(tiles->tiles);
    free(tiles->directions);
    *tiles = (pe_tiles){ 0 };
}

static int allocate(pe_tiles *tiles, size_t count)
{
    if (count == 0)
        return 0; /* which no grid has */
    tiles->tiles = calloc(count, sizeof *tiles->tiles);
    tiles->directions = calloc(count * (size_t)tiles->nodes * (size_t)tiles->nodes, sizeof *tiles->directions);
    if (tiles->tiles && tiles->directions)
        return 1;
    pe_tiles_free(tiles);
    return 0;
}

pe_status pe_tiles_make(const pe_grid *grid, double side_rad, pe_tiles *tiles, pe_error *error)
{
    int whole = side_rad * grid->height >= SIDE_MIN * M_PI && grid->width >= SIDE_MIN * AROUND_POLE_MIN;
    int bands = whole ? bands_of(side_rad) : grid->height;
    size_t count = whole ? count_tiles(grid, bands) : (size_t)grid->width * (size_t)grid->height;

    *tiles = (pe_tiles){ .nodes = whole ? PE_TILE_NODES : 1 };
    if (!allocate(tiles, count))
        return pe_fail_memory(error, "the places of lights");
    for (int band = 0; band < bands; band++) {
        int top = row_of(grid, band, bands), bottom = row_of(grid, band + 1, bands);

        add_band(grid, top, bottom, whole ? tiles_around(grid, top, bottom) : grid->width, tiles);
    }
    return PE_OK;
}

void pe_tile_shares(const pe_tiles *tiles, int k, int count, float shares[PE_TILE_NODES])
{
    double at = (k + 0.5) / count;

    shares[0] = 1;
    for (int i = 0; tiles->nodes > 1 && i < PE_TILE_NODES; i++) {
        double share = 1;

        for (int other = 0; other < PE_TILE_NODES; other++)
            if (other != i)
                share *= (at - places[other]) / (places[i] - places[other]);
        shares[i] = (float)share;
    }
}
