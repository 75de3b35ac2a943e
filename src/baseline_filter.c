/* baseline_filter.c - lights seen head on: isotropic lobes of Eq. 4 need no tangent frame, any other is filtered as
 * everywhere else, in the frame of each texel. */
#include "baseline_lights.h"

#include "status.h"

#define LIGHT_BLOCKS 4
#define BLOCKS_PER_LIGHT_BLOCK (PE_LIGHT_BLOCK / LANES)

/* Lights in the frame of one texel, as pe_filter_points takes them. */
typedef struct turned {
    _Alignas(64) float values[LIGHT_BLOCKS][PE_LIGHT_VALUES][PE_LIGHT_BLOCK];
    pe_light_block cones[LIGHT_BLOCKS];
} turned;

/* What is not above the horizon becomes a light straight above, without weight. */
static void turn_block(const pe_block *b, const pe_lobe *lobe, const pe_frame *frame, float (*values)[PE_LIGHT_BLOCK],
                       int first)
{
    for (int lane = 0; lane < LANES; lane++) {
        double world[3], local[3];
        int at = first + lane;

        pe_block_direction(b, lane, world);
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

static void add_turned(const pe_lobe *lobe, const double brush[3], const pe_block *blocks, const uint32_t *index,
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

static void filter_any(const pe_lobe *lobe, const double brush[3], const pe_block_list *l, const double (*world)[3],
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

pe_status pe_head_on_filter(const pe_head_on *h, const double (*world)[3], size_t count, double (*sums)[4],
                            pe_error *error)
{
    pe_tile_view v;
    int enough = pe_tile_view_make(h, world, count, &v);

    memset(sums, 0, count * sizeof *sums);
    if (enough && !pe_tile_view_add_isotropic(&v, h->lobe, world, count, sums)) {
        filter_any(h->lobe, h->direction, &v.whole, world, count, sums);
        filter_any(h->lobe, h->direction, &v.edge, world, count, sums);
    }
    pe_tile_view_free(&v);
    return enough ? PE_OK : pe_fail_memory(error, "what a tile of a baseline map sees");
}
