/* occluders_boxes.c - are boxes beside a lobe?  Several at once, and by two planes alone: that of the facet, and the
 * one that touches the lobe on the side where a box has its centre. */
#include "lanes.h"
#include "occluders.h"

#include <float.h>
#include <math.h>

INLINE pe_octet magnitude(pe_octet v)
{
    return (pe_octet)((pe_octet_bits)v & 0x7fffffff);
}

INLINE pe_octet dot_octets(const pe_octet a[3], const pe_octet b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How far boxes reach along m; their centres are seen from the origin. */
INLINE pe_octet boxes_reach(const pe_tilted_boxes *boxes, const pe_octet centre[3], const pe_octet m[3])
{
    pe_octet reach = dot_octets(centre, m);

    for (int i = 0; i < 3; i++)
        reach += boxes->half[i] * magnitude(dot_octets(boxes->axis[i], m));
    return reach;
}

SAME_CLONES unsigned pe_lobe_meets_boxes(const pe_lobe_cone *cone, const pe_tilted_boxes *boxes)
{
    pe_octet centre[3], m[3], along, scale;
    pe_octet_bits meets;
    unsigned bits = 0;

    for (int c = 0; c < 3; c++)
        centre[c] = boxes->centre[c] - cone->origins[c];
    meets = boxes_reach(boxes, centre, cone->facets) > cone->rounding;
    if (cone->cosine >= 0) {
        along = dot_octets(centre, cone->axes);
        for (int c = 0; c < 3; c++)
            m[c] = centre[c] - along * cone->axes[c];
        /* What is left of a centre on the axis is rounding, and leads anywhere: of no length it does no harm. */
        scale = dot_octets(m, m) + 1e-10F * dot_octets(centre, centre) + FLT_MIN;
        for (int i = 0; i < PE_BOXES; i++)
            scale[i] = sqrtf(scale[i]);
        scale = (float)cone->cosine / scale;
        for (int c = 0; c < 3; c++)
            m[c] = (float)cone->sine * cone->axes[c] - scale * m[c];
        meets &= boxes_reach(boxes, centre, m) > cone->rounding;
    }
    for (int i = 0; i < PE_BOXES; i++)
        bits |= (unsigned)meets[i] & 1U << i;
    return bits;
}
