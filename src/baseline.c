/* baseline.c - one map, every texel seen head on. [Motegi Fig. 3a] */
#include "baseline_lights.h"

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
