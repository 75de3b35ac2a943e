/* cluster.c - an environment as few lights.
 *
 * A binary tree over the lat-long image: a node is a rectangle of texels, halved across its longer side.  Replacing a
 * node's texels j by one light at their mean direction errs by at most about sum_j w_j |omega_j - mean|^2 times the
 * lobe's curvature, with w_j = (luminance + floor) times solid angle; so, starting from the whole image, the node with
 * the greatest such sum is split until there are `count` leaves.  The floor, a share of the mean luminance, keeps dark
 * areas from being one light: their solid angle counts in Eq. 5's denominator.  A small sun ends up alone in its
 * texels. */
#include "cluster.h"

#include "status.h"

#include <stdlib.h>
#include <string.h>

typedef struct node {
    pe_rect area;
    double spread; /* sum_j w_j |omega_j - mean|^2 */
    int first;     /* children first and first + 1; 0: a leaf */
} node;

/* Sums over a node's texels. */
typedef struct moments {
    double weight, direction[3];   /* of w_j and w_j omega_j */
    double solid_angle_sr, rgb[3]; /* of solid angle, and radiance times solid angle */
} moments;

typedef struct tree {
    const pe_env *env;
    double floor;
    node *nodes;
    int *heap; /* indices of leaves that may be split, greatest spread first */
    size_t node_count, heap_count;
    const pe_report *report;
    size_t unreported; /* texels gathered since the report was called */
} tree;

static double mean_luminance(const pe_env *env)
{
    double sum = 0;

    for (int y = 0; y < env->height; y++)
        for (int x = 0; x < env->width; x++)
            sum +=
                env->grid.solid_angle_sr[y] * pe_luminance(env->rgb + 3 * ((size_t)y * (size_t)env->width + (size_t)x));
    return sum / (4 * M_PI);
}

static void gather(const tree *t, const pe_rect *area, moments *m)
{
    *m = (moments){ 0 };
    for (int y = area->top; y < area->bottom; y++) {
        const float *texel = t->env->rgb + 3 * ((size_t)y * (size_t)t->env->width + (size_t)area->left);
        double solid_angle = t->env->grid.solid_angle_sr[y];

        for (int x = area->left; x < area->right; x++, texel += 3) {
            double weight = solid_angle * (pe_luminance(texel) + t->floor), direction[3];

            pe_grid_direction(&t->env->grid, x, y, direction);
            m->weight += weight;
            m->solid_angle_sr += solid_angle;
            for (int c = 0; c < 3; c++) {
                m->direction[c] += weight * direction[c];
                m->rgb[c] += solid_angle * (double)texel[c];
            }
        }
    }
}

/* sum_j w_j |omega_j - mean|^2 of unit vectors: W - |sum_j w_j omega_j|^2 / W. */
static double spread_of(const moments *m)
{
    return m->weight > 0 ? m->weight - pe_dot(m->direction, m->direction) / m->weight : 0;
}

/* ---- a heap of leaves ---- */

static int before(const tree *t, int a, int b)
{
    return t->nodes[a].spread > t->nodes[b].spread || (t->nodes[a].spread == t->nodes[b].spread && a < b);
}

static void push(tree *t, int leaf)
{
    size_t k = t->heap_count++;

    for (; k > 0 && before(t, leaf, t->heap[(k - 1) / 2]); k = (k - 1) / 2)
        t->heap[k] = t->heap[(k - 1) / 2];
    t->heap[k] = leaf;
}

static int pop(tree *t)
{
    int top = t->heap[0], last = t->heap[--t->heap_count];
    size_t k = 0;

    for (;;) {
        size_t child = 2 * k + 1;

        if (child + 1 < t->heap_count && before(t, t->heap[child + 1], t->heap[child]))
            child++;
        if (child >= t->heap_count || !before(t, t->heap[child], last))
            break;
        t->heap[k] = t->heap[child];
        k = child;
    }
    t->heap[k] = last;
    return top;
}

/* ---- the tree ---- */

static void add_node(tree *t, pe_rect area)
{
    moments m;

    t->unreported += (size_t)(area.right - area.left) * (size_t)(area.bottom - area.top);
    gather(t, &area, &m);
    t->nodes[t->node_count] = (node){ area, spread_of(&m), 0 };
    if (area.right - area.left > 1 || area.bottom - area.top > 1)
        push(t, (int)t->node_count);
    t->node_count++;
}

/* Which side is longer on the sphere: a column's width shrinks with sin(theta). */
static int is_wide(const tree *t, const pe_rect *area)
{
    double width =
        2 * M_PI * (area->right - area->left) / t->env->width * t->env->grid.sin_theta[(area->top + area->bottom) / 2];
    double height = M_PI * (area->bottom - area->top) / t->env->height;

    if (area->right - area->left < 2)
        return 0;
    return area->bottom - area->top < 2 || width > height;
}

static void split(tree *t, int parent)
{
    pe_rect first = t->nodes[parent].area, second = first;

    if (is_wide(t, &first))
        first.right = second.left = (first.left + first.right) / 2;
    else
        first.bottom = second.top = (first.top + first.bottom) / 2;
    t->nodes[parent].first = (int)t->node_count;
    add_node(t, first);
    add_node(t, second);
}

#define TEXELS_A_REPORT ((size_t)1 << 20) /* some hundredths of a second */

static int is_cancelled(tree *t)
{
    const pe_report *report = t->report;

    if (!report || !report->function || t->unreported < TEXELS_A_REPORT)
        return 0;
    t->unreported = 0;
    return report->function(report->done / report->total, report->data);
}

static pe_status grow(tree *t, size_t leaves)
{
    t->node_count = t->heap_count = 0;
    add_node(t, (pe_rect){ 0, 0, t->env->width, t->env->height });
    for (size_t made = 1; made < leaves && t->heap_count; made++) {
        split(t, pop(t));
        if (is_cancelled(t))
            return PE_ERROR_CANCELLED;
    }
    return PE_OK;
}

/* The largest distance between the unit vectors of a texel of the area and of its light. */
static float chord_of(const tree *t, const pe_rect *area, const double direction[3])
{
    double least = 1;

    for (int y = area->top; y < area->bottom; y++)
        for (int x = area->left; x < area->right; x++) {
            double texel[3];

            pe_grid_direction(&t->env->grid, x, y, texel);
            least = fmin(least, pe_dot(texel, direction));
        }
    /* |a - b|^2 = 2 - 2 a.b, and a hair for rounding */
    return (float)(sqrt(fmax(2 - 2 * least, 0)) + 1e-6);
}

/* Leaves in the order of the tree, so that neighbours in space are neighbours in the cloud. */
static void harvest(const tree *t, int index, pe_cloud *cloud)
{
    const node *at = &t->nodes[index];
    size_t light = cloud->count;
    double direction[3];
    moments m;

    if (at->first) {
        harvest(t, at->first, cloud);
        harvest(t, at->first + 1, cloud);
        return;
    }
    gather(t, &at->area, &m);
    if (!(pe_dot(m.direction, m.direction) > 1e-12 * m.weight * m.weight))
        pe_grid_direction(&t->env->grid, at->area.left, at->area.top, m.direction); /* a black or a round-about node */
    pe_normalize(m.direction, direction);
    cloud->x[light] = direction[0];
    cloud->y[light] = direction[1];
    cloud->z[light] = direction[2];
    cloud->weight_sr[light] = (float)m.solid_angle_sr;
    cloud->r[light] = (float)m.rgb[0];
    cloud->g[light] = (float)m.rgb[1];
    cloud->b[light] = (float)m.rgb[2];
    cloud->chord[light] = chord_of(t, &at->area, direction);
    cloud->areas[light] = at->area;
    cloud->count++;
}

#define FLOOR_SHARE 0.25

static pe_status fill(tree *t, size_t leaves, pe_cloud *cloud, pe_error *error)
{
    pe_status status;

    t->nodes = malloc(2 * leaves * sizeof *t->nodes);
    t->heap = malloc(2 * leaves * sizeof *t->heap);
    if (!t->nodes || !t->heap)
        return pe_fail_memory(error, "a tree of lights");
    status = grow(t, leaves);
    if (status != PE_OK)
        return status;
    cloud->count = 0;
    cloud->floor = t->floor;
    harvest(t, 0, cloud);
    return PE_OK;
}

pe_status pe_cloud_from_clusters(const pe_env *env, size_t count, const pe_report *report, pe_cloud *cloud,
                                 pe_error *error)
{
    size_t texels = (size_t)env->width * (size_t)env->height;
    size_t leaves = count < texels ? count : texels;
    tree t = { .env = env, .floor = FLOOR_SHARE * mean_luminance(env), .report = report };
    pe_status status = pe_cloud_allocate_areas(env, leaves, cloud, error);

    if (status != PE_OK)
        return status;
    if (!(t.floor > 0))
        t.floor = 1;
    status = fill(&t, leaves, cloud, error);
    if (status != PE_OK)
        pe_cloud_free(cloud);
    free(t.nodes);
    free(t.heap);
    return status;
}
