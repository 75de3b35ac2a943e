/* occluders.c - what stands in a scene, as convex bodies: does a lobe reach any of it?
 *
 * A surface reflects light from a cone of directions, all but a small share of it.  Where no body is in that cone the
 * lookup is right, and no ray need be traced to see that. */
#include "occluders.h"
#include "vector.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- what stands in a scene ---- */

pe_occluders *pe_occluders_create(void)
{
    return calloc(1, sizeof(pe_occluders));
}

void pe_occluders_free(pe_occluders *occluders)
{
    if (occluders == NULL)
        return;
    free(occluders->bodies);
    free(occluders->parts);
    free(occluders->nodes);
    free(occluders);
}

/* Room for `more` beyond `count` things of `size` bytes; NULL, and the old room remains, if there is none. */
static void *more_room(void *things, int count, int more, int *room, size_t size)
{
    int wanted = *room;

    if (more > INT_MAX / 4 - count)
        return NULL;
    if (count + more <= wanted)
        return things;
    wanted = 2 * (count + more);
    things = realloc(things, (size_t)wanted * size);
    if (things != NULL)
        *room = wanted;
    return things;
}

/* Does a body say where it is? */
static bool is_somewhere(const pe_convex *body)
{
    double sum = body->radius[0] + body->radius[1] + body->slack;

    for (int c = 0; c < 3; c++)
        sum += body->centre[c] + body->axes[0][c] + body->axes[1][c] + body->axes[2][c];
    return isfinite(sum);
}

int pe_occluders_add(pe_occluders *occluders, const pe_convex *bodies, int count)
{
    pe_part *part, added = { occluders->body_count, count };
    pe_convex *to;
    bool somewhere = count > 0;

    for (int i = 0; i < count; i++)
        somewhere = somewhere && is_somewhere(&bodies[i]);
    occluders->finished = false;
    if (!somewhere) {
        occluders->everywhere = true;
        return 1;
    }
    to = more_room(occluders->bodies, occluders->body_count, count, &occluders->body_room, sizeof *to);
    if (to == NULL)
        return 0;
    occluders->bodies = to;
    part = more_room(occluders->parts, occluders->part_count, 1, &occluders->part_room, sizeof *part);
    if (part == NULL)
        return 0;
    occluders->parts = part;
    to += added.first;
    memcpy(to, bodies, (size_t)count * sizeof *to);
    occluders->body_count += count;
    /* One with bounds in front, as the tree wants it. */
    for (int i = 0; i < count; i++)
        if (!pe_convex_unbounded(&bodies[i])) {
            to[0] = bodies[i];
            to[i] = bodies[0];
            break;
        }
    part += occluders->part_count++;
    *part = added;
    if (pe_convex_unbounded(&to[0])) {
        *part = occluders->parts[occluders->unbounded];
        occluders->parts[occluders->unbounded++] = added;
    }
    return 1;
}

int pe_occluders_finish(pe_occluders *occluders)
{
    free(occluders->nodes);
    occluders->nodes = NULL;
    occluders->node_count = 0;
    occluders->finished = pe_occluders_tree(occluders);
    return occluders->finished;
}

/* ---- lobes ---- */

static void make_cone(const double origin[3], const double facet[3], const double axis[3], double half_angle,
                      pe_lobe_cone *cone)
{
    const pe_octet zero = { 0 };

    cone->sine = sin(half_angle);
    cone->cosine = cos(half_angle);
    cone->rounding = 0;
    for (int c = 0; c < 3; c++) {
        cone->origin[c] = origin[c];
        cone->facet[c] = facet[c];
        cone->axis[c] = axis[c];
        cone->origins[c] = zero + (float)origin[c];
        cone->facets[c] = zero + (float)facet[c];
        cone->axes[c] = zero + (float)axis[c];
        cone->rounding = fmaxf(cone->rounding, 2e-7F * (float)fabs(origin[c]));
    }
}

static bool part_beside(const pe_occluders *occluders, const pe_part *part, const pe_lobe_cone *cone)
{
    for (int i = 0; i < part->count; i++)
        if (pe_lobe_beside(cone, &occluders->bodies[part->first + i]))
            return true;
    return false;
}

static bool node_beside(const pe_occluders *occluders, int number, const pe_lobe_cone *cone)
{
    const pe_occluder_node *node = &occluders->nodes[number];
    unsigned meets = pe_lobe_meets_boxes(cone, &node->boxes);

    for (; meets != 0; meets &= meets - 1) {
        int child = node->child[__builtin_ctz(meets)];

        if (child < 0 ? !part_beside(occluders, &occluders->parts[~child], cone) : !node_beside(occluders, child, cone))
            return false;
    }
    return true;
}

/* Do all directions lead to a plane? */
static bool is_covered(const pe_occluders *occluders, const pe_lobe_cone *cone)
{
    for (int i = 0; i < occluders->unbounded; i++) {
        const pe_part *part = &occluders->parts[i];

        if (part->count == 1 && occluders->bodies[part->first].kind == PE_CONVEX_PLANE &&
            pe_lobe_within(cone, &occluders->bodies[part->first]))
            return true;
    }
    return false;
}

pe_sight pe_lobe_sight(const pe_occluders *occluders, const double origin[3], const double facet[3],
                       const double axis[3], double half_angle)
{
    pe_lobe_cone cone;

    make_cone(origin, facet, axis, half_angle, &cone);
    if (is_covered(occluders, &cone))
        return PE_SIGHT_COVERED;
    if (occluders->everywhere || !occluders->finished)
        return PE_SIGHT_UNKNOWN;
    for (int i = 0; i < occluders->unbounded; i++)
        if (!part_beside(occluders, &occluders->parts[i], &cone))
            return PE_SIGHT_UNKNOWN;
    return occluders->node_count == 0 || node_beside(occluders, 0, &cone) ? PE_SIGHT_CLEAR : PE_SIGHT_UNKNOWN;
}
