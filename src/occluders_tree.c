/* occluders_tree.c - a tree of boxes around parts of a scene, each turned as its parts lie, so that those around a
 * piece of a surface are flat: a lobe above it passes them. */
#include "occluders.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

enum { SWEEPS = 3 };

/* ---- how parts lie ---- */

typedef struct point_sums {
    double sum[3], squares[3][3];
    double count;
} point_sums;

static void add_point(point_sums *sums, const double centre[3], double scale, const double offset[3])
{
    double point[3];

    for (int c = 0; c < 3; c++)
        point[c] = centre[c] + scale * offset[c];
    for (int c = 0; c < 3; c++) {
        sums->sum[c] += point[c];
        for (int e = 0; e <= c; e++)
            sums->squares[c][e] += point[c] * point[e];
    }
    sums->count++;
}

static void add_body(point_sums *sums, const pe_convex *body, const double about[3])
{
    double centre[3];

    for (int c = 0; c < 3; c++)
        centre[c] = body->centre[c] - about[c];
    for (int i = 0; i < 3; i++) {
        add_point(sums, centre, 1, body->axes[i]);
        if (body->kind != PE_CONVEX_TRIANGLE)
            add_point(sums, centre, -1, body->axes[i]);
    }
}

/* A turn in the plane of axes p and q that makes the covariance of the two 0: one step of Jacobi's. */
static void turn(double covariance[3][3], double axes[3][3], int p, int q)
{
    double off = covariance[p][q], theta, t, cosine, sine;

    if (off == 0)
        return;
    theta = (covariance[q][q] - covariance[p][p]) / (2 * off);
    t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    cosine = 1 / sqrt(t * t + 1);
    sine = t * cosine;
    for (int c = 0; c < 3; c++) {
        double a = covariance[c][p], b = covariance[c][q];

        covariance[c][p] = cosine * a - sine * b;
        covariance[c][q] = sine * a + cosine * b;
    }
    for (int c = 0; c < 3; c++) {
        double a = covariance[p][c], b = covariance[q][c], x = axes[p][c], y = axes[q][c];

        covariance[p][c] = cosine * a - sine * b;
        covariance[q][c] = sine * a + cosine * b;
        axes[p][c] = cosine * x - sine * y;
        axes[q][c] = sine * x + cosine * y;
    }
}

/* Axes along which the parts' points have no covariance, the one along which they reach farthest in front. */
static void principal_axes(const point_sums *sums, double axes[3][3])
{
    double covariance[3][3], swap[3];
    int longest = 0;

    memset(axes, 0, 9 * sizeof(double));
    for (int c = 0; c < 3; c++) {
        axes[c][c] = 1;
        for (int e = 0; e <= c; e++)
            covariance[c][e] = covariance[e][c] = sums->squares[c][e] - sums->sum[c] * sums->sum[e] / sums->count;
    }
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        turn(covariance, axes, 0, 1);
        turn(covariance, axes, 0, 2);
        turn(covariance, axes, 1, 2);
    }
    for (int c = 1; c < 3; c++)
        if (covariance[c][c] > covariance[longest][longest])
            longest = c;
    memcpy(swap, axes[0], sizeof swap);
    memcpy(axes[0], axes[longest], sizeof swap);
    memcpy(axes[longest], swap, sizeof swap);
}

/* ---- boxes ---- */

/* How far a part reaches along m: no farther than any of its bodies. */
static double reach(const pe_occluders *occluders, const pe_part *part, const double m[3])
{
    double least = INFINITY;

    for (int i = 0; i < part->count; i++) {
        const pe_convex *body = &occluders->bodies[part->first + i];

        least = fmin(least, pe_dot(body->centre, m) + pe_convex_reach(body, m) + body->slack);
    }
    return least;
}

/* Some parts, by number, and how they lie. */
typedef struct part_set {
    int *parts, count;
    double axes[3][3];
} part_set;

static const pe_part *part_of(const pe_occluders *occluders, const part_set *set, int i)
{
    return &occluders->parts[set->parts[i]];
}

static void orient(const pe_occluders *occluders, part_set *set)
{
    const double *about = occluders->bodies[part_of(occluders, set, 0)->first].centre;
    point_sums sums = { .count = 0 };

    for (int i = 0; i < set->count; i++)
        add_body(&sums, &occluders->bodies[part_of(occluders, set, i)->first], about);
    principal_axes(&sums, set->axes);
}

/* Box `lane` becomes the one around the set. */
static void enclose(const pe_occluders *occluders, const part_set *set, int lane, pe_tilted_boxes *boxes)
{
    double centre[3] = { 0, 0, 0 };
    float rounding = 0;

    for (int c = 0; c < 3; c++) {
        double back[3], high = -INFINITY, low = -INFINITY;

        pe_scale(-1, set->axes[c], back);
        for (int i = 0; i < set->count; i++) {
            high = fmax(high, reach(occluders, part_of(occluders, set, i), set->axes[c]));
            low = fmax(low, reach(occluders, part_of(occluders, set, i), back));
        }
        for (int e = 0; e < 3; e++) {
            centre[e] += (high - low) / 2 * set->axes[c][e];
            boxes->axis[c][e][lane] = (float)set->axes[c][e];
        }
        boxes->half[c][lane] = (float)((high + low) / 2);
        rounding += 3e-7F * (float)fmax(fabs(high), fabs(low));
    }
    for (int c = 0; c < 3; c++) {
        boxes->centre[c][lane] = (float)centre[c];
        boxes->half[c][lane] += rounding;
    }
}

/* ---- the tree ---- */

/* Where a part is along an axis. */
static double place(const pe_occluders *occluders, const double axis[3], int part)
{
    return pe_dot(occluders->bodies[occluders->parts[part].first].centre, axis);
}

/* The first `front` of these parts become those farthest back along the axis, by Hoare's selection. */
static void select_front(const pe_occluders *occluders, int *parts, int count, int front, const double axis[3])
{
    int low = 0, high = count - 1;

    while (low < high) {
        double pivot = place(occluders, axis, parts[low + (high - low) / 2]);
        int i = low, j = high;

        while (i <= j) {
            while (place(occluders, axis, parts[i]) < pivot)
                i++;
            while (place(occluders, axis, parts[j]) > pivot)
                j--;
            if (i <= j) {
                int swap = parts[i];

                parts[i++] = parts[j];
                parts[j--] = swap;
            }
        }
        if (front <= j)
            high = j;
        else if (front >= i)
            low = i;
        else
            return;
    }
}

/* Leaves in the set its front half, in whole trees of `unit` parts, and puts the rest in another. */
static void divide(const pe_occluders *occluders, int unit, part_set *set, part_set *rest)
{
    int front = (set->count / unit + 1) / 2 * unit;

    select_front(occluders, set->parts, set->count, front, set->axes[0]);
    rest->parts = set->parts + front;
    rest->count = set->count - front;
    set->count = front;
    orient(occluders, set);
    orient(occluders, rest);
}

/* Divides a set into no more than PE_BOXES; how many. */
static int divide_all(const pe_occluders *occluders, part_set sets[PE_BOXES])
{
    int unit = 1, count = 1;

    while (unit < (sets[0].count + PE_BOXES - 1) / PE_BOXES)
        unit *= PE_BOXES;
    for (int i = 0; i < count; i++)
        while (sets[i].count > unit)
            divide(occluders, unit, &sets[i], &sets[count++]);
    return count;
}

/* A node over the set; its number. */
static int add_node(pe_occluders *occluders, const part_set *set)
{
    int number = occluders->node_count++, count;
    pe_occluder_node *node = &occluders->nodes[number];
    part_set sets[PE_BOXES] = { *set };

    memset(node, 0, sizeof *node);
    count = divide_all(occluders, sets);
    /* Less than nothing is beside every lobe. */
    for (int i = count; i < PE_BOXES; i++)
        for (int c = 0; c < 3; c++) {
            node->boxes.axis[c][c][i] = 1;
            node->boxes.half[c][i] = -1e30F;
        }
    for (int i = 0; i < count; i++) {
        enclose(occluders, &sets[i], i, &node->boxes);
        node->child[i] = sets[i].count == 1 ? ~sets[i].parts[0] : add_node(occluders, &sets[i]);
    }
    return number;
}

/* Whole trees of u = 8^k parts have (u - 1) / 7 nodes, and but for the last of its children each is one; what that
 * leaves over is one node a level, of which there are 11 below 2^31 parts. */
static int nodes_at_most(int count)
{
    return count / (PE_BOXES - 1) + 12;
}

bool pe_occluders_tree(pe_occluders *occluders)
{
    int count = occluders->part_count - occluders->unbounded;
    int *parts = malloc((size_t)(count + 1) * sizeof *parts);
    part_set all = { parts, count, { { 0 } } };

    occluders->nodes = aligned_alloc(sizeof(pe_octet), (size_t)nodes_at_most(count) * sizeof *occluders->nodes);
    if (parts == NULL || occluders->nodes == NULL) {
        free(parts);
        return false;
    }
    for (int i = 0; i < count; i++)
        parts[i] = occluders->unbounded + i;
    if (count > 0) {
        orient(occluders, &all);
        add_node(occluders, &all);
    }
    free(parts);
    return true;
}
