/* pairs_strip.c - see pairs_strip.h.
 *
 * The two hemispheres of an image are filtered side by side, made splines of, and looked up for all frames at once. */
#include "pairs_strip.h"

#include "lanes.h"
#include "look.h"
#include "quad.h"
#include "spline.h"
#include "status.h"

#include <stdlib.h>

typedef struct job {
    const pe_strip *strip;
    const pe_kernel *kernel;
    pe_disc disc; /* of the hemispheres */
    const pe_lobe *lobe;
    const pe_suns *suns;
    pe_denominator *denominator; /* NULL where no frame has suns */
    pe_maps *const *maps;
} job;

/* An image's two hemispheres: lanes of every texel. */
typedef struct image {
    const job *job;
    pe_frame frames[2];
    float *sides[2];
} image;

/* ---- filter ---- */

static void store(int place, const float o[3], const float (*sums)[PE_STRIP_LANES], void *data)
{
    const image *i = data;

    for (int side = 0; side < 2; side++) {
        float rgb[PE_STRIP_FRAMES][3] = { { 0 } };
        float *lanes = i->sides[side] + (size_t)PE_STRIP_LANES * (size_t)place;

        pe_strip_radiance(i->job->strip, i->job->lobe, &i->frames[side], o, sums[side], rgb);
        memcpy(lanes, rgb, sizeof rgb);
        lanes[PE_STRIP_WEIGHT] = 0;
    }
}

static int filter_sides(image *i)
{
    const job *j = i->job;
    pe_strip_cells cells;

    if (pe_strip_cells_allocate(j->kernel, &cells, NULL) != PE_OK)
        return 0;
    pe_strip_filter(j->strip, j->kernel, i->frames, &cells, store, i);
    pe_strip_cells_free(&cells);
    for (int side = 0; side < 2; side++) {
        pe_disc_continue(&j->disc, i->sides[side], PE_STRIP_LANES);
        pe_spline_coefficients(i->sides[side], j->disc.width, j->disc.height, PE_STRIP_LANES);
    }
    return 1;
}

/* ---- look up ---- */

/* A row's texels on one side: where in the row, the viewers who see them in a mirror, what the spline shows. */
typedef struct side_row {
    int count, *column;
    float *o[3], *weight, *lanes, *densities; /* weight: Eq. 5's denominator, where there are suns */
} side_row;

/* Whether a spline's coefficients about a lookup have any below zero; see pe_look_beside_lamp. */
INLINE int any_negative(const ints *signs)
{
    int lanes[LANES], sign = 0;

    memcpy(lanes, signs, sizeof lanes);
    for (int k = 0; k < LANES; k++)
        sign |= lanes[k];
    return sign < 0;
}

CLONES static int look(const float *corner, int width, const pe_disc_taps *t, float lanes[LANES])
{
    floats sum = { 0 };
    ints signs = { 0 };

    for (int j = 0; j < 4; j++, corner += LANES * width) {
        floats a = load(corner), b = load(corner + LANES), c = load(corner + 2 * LANES), d = load(corner + 3 * LANES);

        sum += t->down[j] * (t->across[0] * a + t->across[1] * b + t->across[2] * c + t->across[3] * d);
        signs |= (ints)a | (ints)b | (ints)c | (ints)d;
    }
    memcpy(lanes, &sum, sizeof sum);
    return any_negative(&signs);
}

/* Four lanes at a time. */
static void look_beside_lamp(const float *corner, int width, const pe_disc_taps *t, float lanes[LANES])
{
    for (int k = 0; k < LANES; k += 4) {
        pe_quad sum = pe_quad_load(lanes + k);

        pe_quad_store(lanes + k, pe_look_beside_lamp(corner + k, LANES, LANES * width, t->right, t->below, sum));
    }
}

static void look_at(const image *i, int side, const float local[3], float lanes[LANES])
{
    const pe_disc *disc = &i->job->disc;
    const float *corner;
    pe_disc_taps t;

    pe_disc_taps_at(disc, local, &t);
    corner = i->sides[side] + (size_t)LANES * (size_t)((t.y - 1) * disc->width + t.x - 1);
    if (look(corner, disc->width, &t, lanes))
        look_beside_lamp(corner, disc->width, &t, lanes);
}

static float weight_at(const pe_denominator *denominator, const double mirror[3])
{
    const double o[3] = { -mirror[0], -mirror[1], fmax(mirror[2], PE_HORIZON) };

    return (float)pe_denominator_at(denominator, o);
}

static void look_up_row(const image *i, int y, side_row sides[2])
{
    const pe_grid *grid = &i->job->maps[0]->grid;
    int count[2] = { 0, 0 };

    for (int x = 0; x < grid->width; x++) {
        double world[3], local[3];
        float toward[3];
        const side_row *r;
        int side, k;

        pe_grid_direction(grid, x, y, world);
        side = !(pe_dot(world, i->frames[0].n) > 0);
        r = &sides[side];
        k = count[side]++;
        pe_frame_coordinates(&i->frames[side], world, local);
        for (int c = 0; c < 3; c++) {
            toward[c] = (float)local[c];
            r->o[c][k] = c < 2 ? -toward[c] : toward[c];
        }
        look_at(i, side, toward, r->lanes + (size_t)LANES * (size_t)k);
        if (i->job->denominator)
            r->weight[k] = weight_at(i->job->denominator, local);
        r->column[k] = x;
    }
    for (int side = 0; side < 2; side++)
        sides[side].count = count[side];
}

/* ---- suns ---- */

static void add_sun(const float power[3], const side_row *r, float *row)
{
    for (int k = 0; k < r->count; k++) {
        float share = r->densities[k] / r->weight[k];

        for (int c = 0; c < 3; c++)
            row[3 * r->column[k] + c] += share * power[c];
    }
}

static void add_suns(const image *i, const pe_suns *suns, const pe_frame *frame, const side_row *r, float *row)
{
    const pe_lobe *lobe = i->job->lobe;
    const double unit = 1 / (M_PI * lobe->surface.ndf.alpha_x * lobe->surface.ndf.alpha_y);
    const float *const o[3] = { r->o[0], r->o[1], r->o[2] };

    for (int k = 0; k < suns->count; k++) {
        double local[3];
        float w[3], power[3];

        pe_frame_coordinates(frame, suns->direction[k], local);
        if (!(local[2] > PE_HORIZON))
            continue;
        for (int c = 0; c < 3; c++) {
            w[c] = (float)local[c];
            power[c] = (float)(unit * suns->power[k][c]);
        }
        pe_filter_densities(lobe, w, o, (size_t)r->count, r->densities);
        add_sun(power, r, row);
    }
}

/* One by one: of microfacets. */
static void add_scattered_suns(const image *i, const pe_suns *suns, const pe_frame *frame, const side_row *r,
                               float *row)
{
    for (int k = 0; k < r->count && suns->count; k++) {
        const double local[3] = { (double)r->o[0][k], (double)r->o[1][k], (double)r->o[2][k] };
        double o[3], rgb[3] = { 0, 0, 0 };

        pe_frame_direction(frame, local, o);
        pe_suns_add(suns, &i->job->lobe->surface, NULL, i->job->maps[0]->info.direction, frame->n, o, rgb);
        for (int c = 0; c < 3; c++)
            row[3 * r->column[k] + c] += (float)rgb[c];
    }
}

static float positive(float value)
{
    return value > 0 ? value : 0;
}

static void store_frame(const image *i, int frame, const side_row sides[2], float *row)
{
    for (int side = 0; side < 2; side++) {
        const side_row *r = &sides[side];

        for (int k = 0; k < r->count; k++)
            for (int c = 0; c < 3; c++)
                row[3 * r->column[k] + c] = positive(r->lanes[LANES * (size_t)k + (size_t)(3 * frame + c)]);
        if (i->job->lobe->surface.weight == PE_WEIGHT_NDF)
            add_suns(i, &i->job->suns[frame], &i->frames[side], r, row);
        else
            add_scattered_suns(i, &i->job->suns[frame], &i->frames[side], r, row);
    }
}

/* ---- an image ---- */

static int allocate_row(int width, side_row *r)
{
    size_t room = ((size_t)width + LANES - 1) / LANES * LANES;
    float *values = calloc(room * (5 + LANES), sizeof *values);

    *r = (side_row){ .column = malloc(room * sizeof *r->column), .lanes = values };
    if (!r->column || !values)
        return 0;
    r->densities = values + room * LANES;
    r->weight = values + room * (LANES + 4);
    for (int c = 0; c < 3; c++)
        r->o[c] = values + room * (LANES + 1 + (size_t)c);
    return 1;
}

static void free_row(side_row *r)
{
    free(r->column);
    free(r->lanes);
}

static void look_up_rows(const image *i, int index, side_row sides[2])
{
    const pe_maps_info *info = &i->job->maps[0]->info;

    for (int y = 0; y < info->height; y++) {
        look_up_row(i, y, sides);
        for (int k = 0; k < i->job->strip->count; k++)
            store_frame(i, k, sides,
                        pe_maps_image_to_fill(i->job->maps[k], index) + (size_t)3 * (size_t)(y * info->width));
    }
}

static int look_up_image(const image *i, int index)
{
    int width = i->job->maps[0]->info.width, enough;
    side_row sides[2];

    enough = allocate_row(width, &sides[0]);
    enough &= allocate_row(width, &sides[1]);
    if (enough)
        look_up_rows(i, index, sides);
    free_row(&sides[0]);
    free_row(&sides[1]);
    return enough;
}

/* ---- all ---- */

static float *allocate_side(const pe_disc *disc)
{
    return aligned_alloc(LANES * sizeof(float), (size_t)disc->width * (size_t)disc->height * LANES * sizeof(float));
}

static int fill_image(size_t index, void *data)
{
    const job *j = data;
    int enough;
    image i = { .job = j, .sides = { allocate_side(&j->disc), allocate_side(&j->disc) } };

    for (int side = 0; side < 2; side++)
        pe_frame_make(pe_geodesic_vertex(j->maps[0]->geodesic, 2 * (int)index + side), j->maps[0]->info.direction,
                      &i.frames[side]);
    enough = i.sides[0] && i.sides[1] && filter_sides(&i) && look_up_image(&i, (int)index);
    free(i.sides[0]);
    free(i.sides[1]);
    return enough;
}

static int any_suns(const pe_strip *strip, const pe_suns *suns)
{
    int any = 0;

    for (int k = 0; k < strip->count; k++)
        any |= suns[k].count;
    return any;
}

pe_status pe_fill_pairs_of_strip(const pe_strip *strip, const pe_kernel *kernel, const pe_lobe *lobe,
                                 const pe_suns *suns, int threads, pe_report *report, pe_maps *const *maps,
                                 pe_error *error)
{
    size_t images = (size_t)maps[0]->info.images;
    job j = { strip, kernel, *pe_kernel_map(kernel), lobe, suns, NULL, maps };
    pe_status status = PE_OK;

    if (lobe->surface.weight == PE_WEIGHT_NDF && any_suns(strip, suns))
        status = pe_denominator_make(&lobe->surface.ndf, &j.denominator, error);
    if (status != PE_OK)
        return status;
    report->total = (double)images;
    status = pe_parallel_try(images, threads, fill_image, &j, report, "the hemispheres of an image", error);
    pe_denominator_free(j.denominator);
    return status;
}
