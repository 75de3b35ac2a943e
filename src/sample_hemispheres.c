/* sample_hemispheres.c - one bicubic lookup a hemisphere, mixed between representative normals and brush angles.
 *
 * In the frame of n_k the direction r is a point of n_k's picture, and the cubic B-spline there takes 4 x 4 texels.  A
 * map whose horizon r is below answers with its horizon's, so that nothing jumps.  Where the brush may point anywhere,
 * as in all maps of several angles, and about the poles of a brush that is fixed, where tangents turn fast,
 * its direction at n is carried along to n_k's tangent plane, and the four angles about it are mixed by a cubic that
 * goes round and round in half turns, or whole ones.  Each angle's picture has its own turned frame, so that a narrow
 * lobe lies along its axes. */
#include "look.h"
#include "sample.h"
#include "spline.h"

/* A unit vector in n_k's frame. */
static inline void enter(const float frame[3][3], const float world[3], float local[3])
{
    for (int row = 0; row < 3; row++)
        local[row] = frame[row][0] * world[0] + frame[row][1] * world[1] + frame[row][2] * world[2];
}

/* What the maps looked up so far add up to. */
typedef struct mix {
    const pe_maps *maps;
    float r[3];
    const double *direction; /* of the brush */
    const double *n;
    float brush[3]; /* along it at n, once has_brush */
    int has_brush;
    pe_quad rgb;
    float weight;
} mix;

/* A direction of the vertex's frame, in the frame turned by angle k. */
static void turn(const pe_maps *maps, int k, const float local[3], float turned[3])
{
    float c = maps->turns[k][0], s = maps->turns[k][1];

    turned[0] = c * local[0] + s * local[1];
    turned[1] = c * local[1] - s * local[0];
    turned[2] = local[2];
}

/* The brush's tangent t at n. */
static void need_brush(mix *sum)
{
    pe_frame frame;

    if (sum->has_brush)
        return;
    pe_frame_make(sum->n, sum->direction, &frame);
    for (int c = 0; c < 3; c++)
        sum->brush[c] = (float)frame.t[c];
    sum->has_brush = 1;
}

static pe_quad look_at_angles(mix *sum, int vertex, int angles, const float local[3])
{
    float brush[3], turned[3], weights[4], at;
    pe_quad rgb = { 0, 0, 0, 0 };
    int first;

    need_brush(sum);
    enter((const float(*)[3])sum->maps->frames[vertex], sum->brush, brush);
    at = (float)(atan2((double)brush[1], (double)brush[0]) / pe_maps_turn(&sum->maps->info) + 1) * (float)angles;
    first = (int)at;
    pe_interpolating_weights(at - (float)first, weights);
    for (int k = 0; k < 4; k++) {
        int angle = (first + k - 1 + angles) % angles;

        turn(sum->maps, angle, local, turned);
        rgb += weights[k] * pe_look(sum->maps, pe_maps_image_at(sum->maps, vertex, angle), turned);
    }
    return rgb;
}

static void add_map(int vertex, double weight, void *data)
{
    mix *sum = data;
    int angles = pe_maps_angles_at(sum->maps, vertex);
    float local[3];

    enter((const float(*)[3])sum->maps->frames[vertex], sum->r, local);
    sum->rgb +=
        (float)weight * (angles > 1 ? look_at_angles(sum, vertex, angles, local) : pe_look(sum->maps, vertex, local));
    sum->weight += (float)weight;
}

void pe_sample_hemispheres(const pe_maps *maps, const pe_sampling *sampling, const pe_view *view, double rgb[3])
{
    mix sum = { .maps = maps,
                .r = { (float)view->r[0], (float)view->r[1], (float)view->r[2] },
                .n = view->n,
                .direction = view->direction ? view->direction : maps->info.direction };

    pe_visit_normals(maps, sampling, view->n, add_map, &sum);
    for (int c = 0; c < 3; c++)
        rgb[c] = fmax((double)(sum.rgb[c] / sum.weight), 0);
    if (maps->suns.count)
        pe_suns_add(&maps->suns, &maps->info.surface, maps->denominator, sum.direction, view->n, view->o, rgb);
}
