/* sample_hemispheres.c - one bicubic lookup a hemisphere, mixed between representative normals and brush angles.
 *
 * In the frame of n_k the direction r is a point of n_k's picture, and the cubic B-spline there takes 4 x 4 texels.  A
 * map whose horizon r is below answers with its horizon's, and counts the less the lower r is, so that nothing jumps.
 * Where the brush may point anywhere, as in all maps of several angles, and about the poles of a brush that is fixed,
 * where tangents turn fast, its direction at n is carried along to n_k's tangent plane, and the four angles about it
 * are mixed by a cubic that goes round and round in half turns, or whole ones.  Each angle's picture has its own turned
 * frame, so that a narrow lobe lies along its axes. */
#include "lanes.h"
#include "look.h"
#include "sample.h"
#include "spline.h"

/* A unit vector in n_k's frame. */
static inline pe_quad enter(const float frame[3][4], const float world[3])
{
    return pe_quad_load(frame[0]) * world[0] + pe_quad_load(frame[1]) * world[1] + pe_quad_load(frame[2]) * world[2];
}

/* Lookups that are aimed together: those at a vertex's four angles, or those of several vertices of one angle. */
typedef struct group {
    pe_aims aims;
    _Alignas(pe_quad) float weights[PE_AIMS];
} group;

/* Groups that wait for each other's texels: of each vertex of a triangle, and of those of one angle. */
#define GROUPS 4

/* What the maps looked up so far add up to. */
typedef struct mix {
    const pe_maps *maps;
    float r[3];
    const double *direction; /* of the brush */
    const double *n;
    float brush[3]; /* along it at n, once has_brush */
    int has_brush;

    /* Vertices of one angle, not yet aimed at. */
    int waiting, vertices[PE_AIMS];
    pe_quad locals[PE_AIMS]; /* r in their frames, and their weights */

    int count; /* of groups, aimed and not yet added */
    group groups[GROUPS];
    pe_quad rgb;
    float weight;
} mix;

CLONES static void add_groups(mix *sum)
{
    for (const group *g = sum->groups; g < sum->groups + sum->count; g++)
        for (int k = 0; k < g->aims.count; k++) {
            sum->rgb += g->weights[k] * pe_look_at(sum->maps, &g->aims, k);
            sum->weight += g->weights[k];
        }
    sum->count = 0;
}

static group *new_group(mix *sum)
{
    if (sum->count == GROUPS)
        add_groups(sum);
    return &sum->groups[sum->count++];
}

/* How much a map counts where r is this high above its horizon: a lobe near the horizon is far narrower than that of n,
 * and below it is seen displaced.  Found by trial on photographs.  Never nothing, as it may be the only map. */
#define HORIZON 0.25f
#define TRUST_MIN 0.001f

static inline float trust(float height)
{
    float share = (height + HORIZON) / (2 * HORIZON);

    share = share > TRUST_MIN ? share : TRUST_MIN;
    return share < 1 ? share : 1;
}

CLONES static void aim_at_vertices(mix *sum)
{
    group *g = new_group(sum);
    pe_quad columns[4];

    pe_quad_transpose(sum->locals, columns);
    pe_look_aim(sum->maps, sum->vertices, sum->waiting, columns, &g->aims);
    for (int k = 0; k < PE_AIMS; k++)
        g->weights[k] = columns[3][k] * trust(columns[2][k]);
    sum->waiting = 0;
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

/* r is turned into the frame of each angle. */
CLONES static void aim_at_angles(mix *sum, int vertex, int angles, pe_quad local, float weight)
{
    const pe_maps *maps = sum->maps;
    group *g = new_group(sum);
    float weights[4], at;
    int images[PE_AIMS], first, before;
    pe_quad brush, c = { 0 }, s = { 0 }, locals[3];

    need_brush(sum);
    brush = enter((const float(*)[4])maps->frames[vertex], sum->brush);
    at = (atan2f(brush[1], brush[0]) / (float)pe_maps_turn(&maps->info) + 1) * (float)angles;
    first = (int)at;
    before = (first - 1 + angles) % angles;
    pe_interpolating_weights(at - (float)first, weights);
    for (int k = 0; k < 4; k++) {
        int angle = before + k < angles ? before + k : before + k - angles;

        g->weights[k] = weight * weights[k];
        images[k] = pe_maps_image_at(maps, vertex, angle);
        c[k] = maps->turns[angle][0];
        s[k] = maps->turns[angle][1];
    }
    locals[0] = c * local[0] + s * local[1];
    locals[1] = c * local[1] - s * local[0];
    locals[2] = local[2] - (pe_quad){ 0 };
    pe_look_aim(maps, images, 4, locals, &g->aims);
}

static void add_vertex(int vertex, double weight, void *data)
{
    mix *sum = data;
    int angles = pe_maps_angles_at(sum->maps, vertex);
    pe_quad local = enter((const float(*)[4])sum->maps->frames[vertex], sum->r);

    if (angles > 1) {
        aim_at_angles(sum, vertex, angles, local, (float)weight * trust(local[2]));
        return;
    }
    if (sum->waiting == PE_AIMS)
        aim_at_vertices(sum);
    local[3] = (float)weight;
    sum->vertices[sum->waiting] = vertex;
    sum->locals[sum->waiting++] = local;
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
    sum.waiting = 0;
    for (int k = 0; k < PE_AIMS; k++)
        sum.locals[k] = (pe_quad){ 0, 0, 0, 0 };
    sum.count = 0;
    sum.rgb = (pe_quad){ 0, 0, 0, 0 };
    sum.weight = 0;
    pe_visit_normals(maps, sampling, view->n, add_vertex, &sum);
    if (sum.waiting)
        aim_at_vertices(&sum);
    add_groups(&sum);
    for (int c = 0; c < 3; c++)
        rgb[c] = sum.rgb[c] > 0 ? (double)(sum.rgb[c] / sum.weight) : 0;
    if (maps->suns.count) {
        pe_denominators denominators = { 0 };

        pe_denominators_add(&denominators, maps->denominator, 1);
        pe_suns_add(&maps->suns, &maps->info.surface, &denominators, sum.direction, view->n, view->o, rgb);
    }
}
