/* pairs.c - see pairs.h.
 *
 * A texel w of the image that n_k and -n_k share belongs to the side it lies on, n = +-n_k.  The viewer who sees w in a
 * mirror of normal n is o = reflect(w, n): in the tangent frame of n, with w = (x, y, z), o = (-x, -y, z). */
#include "pairs.h"

#include "look.h"
#include "suns.h"
#include "vector.h"

#include <string.h>

/* One side of a pair, ready to be filtered. */
typedef struct side {
    pe_frame frame;
    pe_lights lights;
} side;

/* What all rows of one image share. */
typedef struct job {
    const pe_cloud *cloud;
    const pe_lobe *lobe;
    double lobe_reach;
    pe_maps *maps;
    int image;
    side sides[2];
} job;

/* ---- points ---- */

/* Texels of one side waiting to be filtered together. */
typedef struct batch {
    size_t count;
    float o[PE_FILTER_POINTS_MAX][3];
    double world[PE_FILTER_POINTS_MAX][3];
    float *out[PE_FILTER_POINTS_MAX];
} batch;

static void store(const job *j, const double sums[4], const double world[3], const float o[3], float *out)
{
    double rgb[3];

    pe_filter_radiance(j->lobe, j->cloud->env, sums, world, o, rgb);
    for (int c = 0; c < 3; c++)
        out[c] = (float)rgb[c];
}

static void finish(const job *j, const pe_lights *lights, batch *points)
{
    double sums[PE_FILTER_POINTS_MAX][4];

    pe_filter_points(j->lobe, lights, (const float(*)[3])points->o, points->count, sums);
    for (size_t k = 0; k < points->count; k++)
        store(j, sums[k], points->world[k], points->o[k], points->out[k]);
    points->count = 0;
}

static void add_point(const job *j, const side *s, const double world[3], float *out, batch *points)
{
    size_t k = points->count++;

    pe_mirror_viewer(&s->frame, world, points->o[k]);
    memcpy(points->world[k], world, sizeof points->world[k]);
    points->out[k] = out;
    if (points->count == PE_FILTER_POINTS_MAX)
        finish(j, &s->lights, points);
}

/* ---- representative normals ---- */

static float *row_of(const job *j, size_t y)
{
    return j->maps->rgb + (size_t)j->image * pe_maps_image_values(j->maps) + 3 * y * (size_t)j->maps->info.width;
}

static void filter_row(size_t y, void *data)
{
    const job *j = data;
    float *row = row_of(j, y);
    batch points[2];

    points[0].count = points[1].count = 0;
    for (int x = 0; x < j->maps->info.width; x++) {
        double world[3];
        int which;

        pe_grid_direction(&j->maps->grid, x, (int)y, world);
        which = !(pe_dot(world, j->sides[0].frame.n) > 0);
        add_point(j, &j->sides[which], world, row + 3 * x, &points[which]);
    }
    for (int which = 0; which < 2; which++)
        finish(j, &j->sides[which].lights, &points[which]);
}

static void prepare_side(size_t which, void *data)
{
    job *j = data;
    side *s = &j->sides[which];

    pe_frame_make(pe_geodesic_vertex(j->maps->geodesic, 2 * j->image + (int)which), j->maps->info.direction, &s->frame);
    pe_lights_fill(j->cloud, j->lobe, &s->frame, j->lobe_reach, &s->lights);
}

static pe_status fill_images(job *j, int threads, pe_report *report, pe_error *error)
{
    pe_status status = pe_lights_allocate(j->cloud, &j->sides[0].lights, error);

    if (status == PE_OK)
        status = pe_lights_allocate(j->cloud, &j->sides[1].lights, error);
    for (j->image = 0; status == PE_OK && j->image < j->maps->info.images; j->image++) {
        pe_parallel_for(2, threads, prepare_side, j, NULL);
        status = pe_parallel_for((size_t)j->maps->info.height, threads, filter_row, j, report);
        report->done += j->maps->info.height;
    }
    pe_lights_free(&j->sides[0].lights);
    pe_lights_free(&j->sides[1].lights);
    return status;
}

pe_status pe_fill_pairs(const pe_cloud *cloud, const pe_lobe *lobe, double lobe_reach, int threads, pe_report *report,
                        pe_maps *maps, pe_error *error)
{
    job j = { .cloud = cloud, .lobe = lobe, .lobe_reach = lobe_reach, .maps = maps };

    return fill_images(&j, threads, report, error);
}

/* ---- from hemispheres ---- */

typedef struct copy {
    const pe_maps *from;
    pe_maps *to;
} copy;

/* What the hemisphere of `vertex`, whose frame it is, shows towards `world`. */
static void copy_texel(const pe_maps *from, int vertex, const pe_frame *frame, const double world[3], float *out)
{
    double local[3], o[3], rgb[3];
    pe_denominators denominators = { 0 };
    pe_quad toward[3] = { { 0 } };
    pe_aims aims;
    pe_quad shown;

    pe_frame_coordinates(frame, world, local);
    for (int k = 0; k < 3; k++)
        toward[k][0] = (float)local[k];
    pe_look_aim(from, &vertex, 1, toward, &aims);
    shown = pe_look_at(from, &aims, 0);
    for (int k = 0; k < 3; k++)
        rgb[k] = fmax((double)shown[k], 0);
    pe_reflect(world, frame->n, o);
    pe_denominators_add(&denominators, from->denominator, 1);
    if (from->suns.count)
        pe_suns_add(&from->suns, &from->info.surface, &denominators, from->info.direction, frame->n, o, rgb);
    for (int k = 0; k < 3; k++)
        out[k] = (float)rgb[k];
}

static void copy_row(size_t row, void *data)
{
    const copy *c = data;
    int width = c->to->info.width, height = c->to->info.height;
    int image = (int)row / height, y = (int)row % height;
    float *out = pe_maps_image_to_fill(c->to, image) + 3 * y * width;
    pe_frame frames[2];

    for (int which = 0; which < 2; which++)
        pe_maps_frame(c->from, 2 * image + which, &frames[which]);
    for (int x = 0; x < width; x++) {
        double world[3];
        int which;

        pe_grid_direction(&c->to->grid, x, y, world);
        which = !(pe_dot(world, frames[0].n) > 0);
        copy_texel(c->from, 2 * image + which, &frames[which], world, out + 3 * x);
    }
}

pe_status pe_fill_pairs_from_hemispheres(const pe_maps *hemispheres, int threads, const pe_report *report,
                                         pe_maps *maps)
{
    copy c = { hemispheres, maps };

    return pe_parallel_for((size_t)maps->info.images * (size_t)maps->info.height, threads, copy_row, &c, report);
}
