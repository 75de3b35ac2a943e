/* occluders_convex.c - is a convex body beside a lobe?
 *
 * It is if a plane through the lobe's origin parts them: some m with m.x <= 0 for all of the body, seen from there, and
 * m.w >= 0 for all of the lobe.  The latter are the m of a cone themselves, that which is polar to the lobe's.  From
 * the plane that touches the lobe on the body's side, m moves away from the body's farthest point beyond it, and back
 * into that cone, by turns: projections onto convex sets. */
#include "occluders.h"
#include "vector.h"

/* ---- how far bodies reach ---- */

static double length(const double *v, int dimensions)
{
    double square = 0;

    for (int i = 0; i < dimensions; i++)
        square += v[i] * v[i];
    return sqrt(square);
}

double pe_convex_reach(const pe_convex *body, const double m[3])
{
    const double along[3] = { pe_dot(body->axes[0], m), pe_dot(body->axes[1], m), pe_dot(body->axes[2], m) };

    switch (body->kind) {
    case PE_CONVEX_TRIANGLE:
        return fmax(along[0], fmax(along[1], along[2]));
    case PE_CONVEX_BALL:
        return length(along, 3);
    case PE_CONVEX_BOX:
        return fabs(along[0]) + fabs(along[1]) + fabs(along[2]);
    case PE_CONVEX_CONE:
        return fmax(body->radius[0] * length(along, 2) - along[2], body->radius[1] * length(along, 2) + along[2]);
    case PE_CONVEX_TORUS:
        return body->radius[0] * length(along, 2) + body->radius[1] * length(along, 3);
    case PE_CONVEX_HALF_SPACE:
    case PE_CONVEX_PLANE:
        break;
    }
    return INFINITY;
}

static void add_scaled(double scale, const double offset[3], double point[3])
{
    for (int c = 0; c < 3; c++)
        point[c] += scale * offset[c];
}

/* Goes from the centre of an ellipse or ellipsoid, of the body's axes times the radius, to its farthest point. */
static void add_round(const pe_convex *body, int dimensions, double radius, const double along[3], double point[3])
{
    double whole = length(along, dimensions);

    for (int i = 0; i < dimensions && whole > 0; i++)
        add_scaled(radius * along[i] / whole, body->axes[i], point);
}

/* Goes from the centre to the point of a bounded body that is farthest along m. */
static void add_farthest(const pe_convex *body, const double m[3], double point[3])
{
    const double along[3] = { pe_dot(body->axes[0], m), pe_dot(body->axes[1], m), pe_dot(body->axes[2], m) };
    int most = along[1] > along[0], end;

    switch (body->kind) {
    case PE_CONVEX_TRIANGLE:
        add_scaled(1, body->axes[along[2] > along[most] ? 2 : most], point);
        break;
    case PE_CONVEX_BALL:
        add_round(body, 3, 1, along, point);
        break;
    case PE_CONVEX_BOX:
        for (int i = 0; i < 3; i++)
            add_scaled(along[i] < 0 ? -1 : 1, body->axes[i], point);
        break;
    case PE_CONVEX_CONE:
        end = 2 * along[2] > (body->radius[0] - body->radius[1]) * length(along, 2);
        add_scaled(end ? 1 : -1, body->axes[2], point);
        add_round(body, 2, body->radius[end], along, point);
        break;
    case PE_CONVEX_TORUS:
        add_round(body, 2, body->radius[0], along, point);
        add_round(body, 3, body->radius[1], along, point);
        break;
    case PE_CONVEX_HALF_SPACE:
    case PE_CONVEX_PLANE:
        break;
    }
}

/* ---- planes between them and a lobe ---- */

enum { STEPS = 8 };

/* Steps beyond the plane through the farthest point make the way shorter. */
static const double RELAXATION = 1.6;

/* How far a body may reach over the plane, in its distance: that is rounding. */
static const double ROUNDING = 1e-9;

/* The nearest m of the polar cone, of length 1; false if that is 0. */
static bool into_polar(const pe_lobe_cone *cone, double m[3])
{
    double along = pe_dot(m, cone->axis), across, reach;
    double side[3];

    for (int c = 0; c < 3; c++)
        side[c] = m[c] - along * cone->axis[c];
    across = sqrt(pe_dot(side, side));
    if (across * cone->sine > along * cone->cosine) {
        reach = along * cone->sine + across * cone->cosine;
        if (!(reach > 0))
            return false;
        for (int c = 0; c < 3; c++)
            m[c] = reach * (cone->sine * cone->axis[c] + cone->cosine / across * side[c]);
    }
    if (!(pe_dot(m, m) > 0))
        return false;
    pe_normalize(m, m);
    return true;
}

/* The plane that touches the lobe on the side where the point is.  Where that is on the axis, to within rounding, which
 * leads anywhere, it is the one across the axis. */
static void touch(const pe_lobe_cone *cone, const double point[3], double m[3])
{
    double along = pe_dot(point, cone->axis), across;

    for (int c = 0; c < 3; c++)
        m[c] = point[c] - along * cone->axis[c];
    across = sqrt(pe_dot(m, m) + 1e-20 * pe_dot(point, point));
    for (int c = 0; c < 3; c++)
        m[c] = cone->sine * cone->axis[c] - (across > 0 ? cone->cosine / across * m[c] : 0);
}

/* The next m, where a point reaches over its plane by `over`; false if there is none. */
static bool away(const pe_lobe_cone *cone, double over, const double point[3], double m[3])
{
    for (int c = 0; c < 3; c++)
        m[c] -= RELAXATION * over / pe_dot(point, point) * point[c];
    return into_polar(cone, m);
}

static bool in_lobe(const pe_lobe_cone *cone, const double point[3], double slack)
{
    return pe_dot(point, cone->facet) > slack &&
           pe_dot(point, cone->axis) >= cone->cosine * sqrt(pe_dot(point, point)) + slack;
}

/* How high the lobe's origin is above the surface of a half space, or on its side of a plane; the normal there. */
static double height_above(const pe_lobe_cone *cone, const pe_convex *body, double normal[3])
{
    double from[3], height, rounding;

    pe_normalize(body->axes[2], normal);
    for (int c = 0; c < 3; c++)
        from[c] = cone->origin[c] - body->centre[c];
    height = pe_dot(normal, from);
    rounding = ROUNDING * length(from, 3);
    if (body->kind == PE_CONVEX_PLANE && (fabs(height) <= rounding ? pe_dot(normal, cone->facet) < 0 : height < 0)) {
        pe_scale(-1, normal, normal);
        height = -height;
    }
    return height + rounding;
}

/* Is all of the lobe above that surface? */
static bool above(const pe_lobe_cone *cone, const pe_convex *body)
{
    double normal[3];

    return height_above(cone, body, normal) >= 0 && ((cone->cosine >= 0 && pe_dot(normal, cone->axis) >= cone->sine) ||
                                                     pe_dot(normal, cone->facet) > 1 - ROUNDING);
}

bool pe_lobe_within(const pe_lobe_cone *cone, const pe_convex *body)
{
    double normal[3];

    return height_above(cone, body, normal) >= 0 && cone->cosine >= 0 && -pe_dot(normal, cone->axis) >= cone->sine;
}

bool pe_lobe_beside(const pe_lobe_cone *cone, const pe_convex *body)
{
    double centre[3], point[3], m[3], over, rounding;

    if (pe_convex_unbounded(body))
        return above(cone, body);
    for (int c = 0; c < 3; c++)
        centre[c] = body->centre[c] - cone->origin[c];
    rounding = (body->kind == PE_CONVEX_TRIANGLE ? body->slack : 0) + ROUNDING * length(centre, 3);
    if (pe_dot(centre, cone->facet) + pe_convex_reach(body, cone->facet) <= rounding)
        return true;
    if (cone->cosine < 0)
        return false;
    touch(cone, centre, m);
    for (int step = 0; step < STEPS; step++) {
        over = pe_dot(centre, m) + pe_convex_reach(body, m);
        if (over <= rounding)
            return true;
        pe_scale(1, centre, point);
        add_farthest(body, m, point);
        if (in_lobe(cone, point, rounding) || !away(cone, over, point, m))
            return false;
    }
    return false;
}
