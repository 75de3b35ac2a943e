/* occluders.h - what stands in a scene, as convex bodies: does a lobe reach any of it?
 *
 * The public part is in prefenv.h.  Here is what its files share: bodies, and the tree of boxes around them. */
#ifndef PE_OCCLUDERS_H
#define PE_OCCLUDERS_H

#include "prefenv.h"

#include <stdbool.h>
#include <stddef.h>

enum { PE_BOXES = 8 };

typedef float pe_octet __attribute__((vector_size(4 * PE_BOXES)));
typedef int pe_octet_bits __attribute__((vector_size(4 * PE_BOXES)));

/* The directions of a lobe: from the origin, above the facet, within a circular cone. */
typedef struct pe_lobe_cone {
    double origin[3];
    double facet[3], axis[3]; /* unit */
    double sine, cosine;      /* of the cone's half angle; a cosine below 0 is all above the facet */
    /* The same, in every lane. */
    pe_octet origins[3], facets[3], axes[3];
    float rounding; /* of the origin, in single precision */
} pe_lobe_cone;

/* Boxes of any orientation, with half their sides: lane by lane. */
typedef struct pe_tilted_boxes {
    pe_octet centre[3], axis[3][3], half[3];
} pe_tilted_boxes;

/* A part of the scene: where all of `count` bodies overlap. */
typedef struct pe_part {
    int first, count;
} pe_part;

/* What is in each of its boxes: the parts below node `child`, or if that is below 0 part ~child alone. */
typedef struct pe_occluder_node {
    pe_tilted_boxes boxes;
    int child[PE_BOXES];
} pe_occluder_node;

struct pe_occluders {
    pe_convex *bodies;
    pe_part *parts; /* those without bounds in front */
    pe_occluder_node *nodes;
    int body_count, part_count, node_count;
    int body_room, part_room;
    int unbounded;
    bool everywhere; /* something is there that no body tells of */
    bool finished;   /* the tree stands */
};

/* How far from its centre a body reaches along m. */
double pe_convex_reach(const pe_convex *body, const double m[3]);

static inline bool pe_convex_unbounded(const pe_convex *body)
{
    return body->kind == PE_CONVEX_HALF_SPACE || body->kind == PE_CONVEX_PLANE;
}

/* Is a plane through the origin between them?  If none is found, there may be one. */
bool pe_lobe_beside(const pe_lobe_cone *cone, const pe_convex *body);

/* Do all directions of the lobe lead to the surface of a half space or plane? */
bool pe_lobe_within(const pe_lobe_cone *cone, const pe_convex *body);

/* The same of boxes: a bit is set where none is found. */
unsigned pe_lobe_meets_boxes(const pe_lobe_cone *cone, const pe_tilted_boxes *boxes);

/* The tree over parts[unbounded ... part_count - 1], which it sorts.  False if memory does not suffice. */
bool pe_occluders_tree(pe_occluders *occluders);

#endif
