/* sample_hemispheres.c - one bicubic lookup a hemisphere, mixed between representative normals and brush angles.
 *
 * In the frame of n_k the direction r is a point of n_k's picture, and the cubic B-spline there takes 4 x 4 texels.  A
 * map whose horizon r is below answers with its horizon's, and counts the less the lower r is, so that nothing jumps.
 * Where the brush may point anywhere, as in all maps of several angles, and about the poles of a brush that is fixed,
 * where tangents turn fast, its direction at n is carried along to n_k's tangent plane, and the four angles about it
 * are mixed by a cubic that goes round and round in half turns, or whole ones.  Each angle's picture has its own turned
 * frame, so that a narrow lobe lies along its axes. */
#include "look.h"
#include "sample.h"
#include "spline.h"

/* A unit vector in n_k's frame. */
static inline void enter(const float frame[3][3], const float world[3], float local[3])
{
    for (int row = 0; row < 3; row++)
        local[row] = frame[row][0] * world[0] + frame[row][1] * world[1] + frame[row][2] * world[2];
}

/* As many lookups as wait for each other's texels: those of a triangle at four angles. */
#define LOOKUPS 12

typedef struct lookup {
    pe_aim aim;
    float weight;
} lookup;

/* What the maps looked up so far add up to, and the lookups that have been aimed and not yet added. */
typedef struct mix {
    const pe_maps *maps;
    float r[3];
    const double *direction; /* of the brush */
    const double *n;
    float brush[3]; /* along it at n, once has_brush */
    int has_brush;
    pe_quad rgb;
    float weight;
    int count;
    lookup lookups[LOOKUPS];
} mix;

static void add_lookups(mix *sum)
{
    for (int k = 0; k < sum->count; k++) {
        sum->rgb += sum->lookups[k].weight * pe_look_at(sum->maps, &sum->lookups[k].aim);
        sum->weight += sum->lookups[k].weight;
    }
    sum->count = 0;
}

static inline void aim(mix *sum, int image, const float local[3], float weight)
{
    lookup *next;

    if (sum->count == LOOKUPS)
        add_lookups(sum);
    next = &sum->lookups[sum->count++];
    pe_look_aim(sum->maps, image, local, &next->aim);
    next->weight = weight;
}

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

static void aim_at_angles(mix *sum, int vertex, int angles, const float local[3], float weight)
{
    float brush[3], turned[3], weights[4], at;
    int first;

    need_brush(sum);
    enter((const float(*)[3])sum->maps->frames[vertex], sum->brush, brush);
    at = (float)(atan2((double)brush[1], (double)brush[0]) / pe_maps_turn(&sum->maps->info) + 1) * (float)angles;
    first = (int)at;
    pe_interpolating_weights(at - (float)first, weights);
    for (int k = 0; k < 4; k++) {
        int angle = (first + k - 1 + angles) % angles;

        turn(sum->maps, angle, local, turned);
        aim(sum, pe_maps_image_at(sum->maps, vertex, angle), turned, weight * weights[k]);
    }
}

/* How much a map counts where r is this high above its horizon: a lobe near the horizon is far narrower than that of n,
 * and below it is seen displaced.  Found by trial on photographs.  Never nothing, as it may be the only map. */
#define HORIZON 0.25f
#define TRUST_MIN 0.001f

static inline float trust(float height)
{
    float share = (height + HORIZON) / (2 * HORIZON);

    return share > 1 ? 1 : share > TRUST_MIN ? share : TRUST_MIN;
}

static void aim_at_vertex(int vertex, double weight, void *data)
{
    mix *sum = data;
    int angles = pe_maps_angles_at(sum->maps, vertex);
    float local[3], share;

    enter((const float(*)[3])sum->maps->frames[vertex], sum->r, local);
    share = (float)weight * trust(local[2]);
    if (angles > 1)
        aim_at_angles(sum, vertex, angles, local, share);
    else
        aim(sum, vertex, local, share);
}

void pe_sample_hemispheres(const pe_maps *maps, const pe_sampling *sampling, const pe_view *view, double rgb[3])
{
    mix sum; /* filled in member by member: it would take long to clear all of it */

    sum.maps = maps;
    for (int c = 0; c < 3; c++)
        sum.r[c] = (float)view->r[c];
    sum.direction = view->direction ? view->direction : maps->info.direction;
    sum.n = view->n;
    sum.has_brush = 0;
    sum.rgb = (pe_quad){ 0, 0, 0, 0 };
    sum.weight = 0;
    sum.count = 0;
    pe_visit_normals(maps, sampling, view->n, aim_at_vertex, &sum);
    add_lookups(&sum);
    for (int c = 0; c < 3; c++)
        rgb[c] = sum.rgb[c] > 0 ? (double)(sum.rgb[c] / sum.weight) : 0;
    if (maps->suns.count)
        pe_suns_add(&maps->suns, &maps->info.surface, maps->denominator, sum.direction, view->n, view->o, rgb);
}
