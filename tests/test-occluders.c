/* test-occluders.c - claims: a lobe that is said to be clear holds no point of any body, whatever bodies there are, of
 * which some are parts of others, and however many; most that are clear are said to be, by a closed form for balls;
 * what is convex never hides the sky from itself; what is not known is not clear; planes cover what leads to them;
 * pe_ndf_spread() leaves out the share it says. */
#include "ndf.h"
#include "prefenv.h"
#include "sequence.h"
#include "tap.h"
#include "vector.h"

#include <stdbool.h>
#include <string.h>

static uint64_t state;

static double between(double low, double high)
{
    return low + (high - low) * pe_random_unit(&state);
}

static void direction(double w[3])
{
    double square;

    do {
        for (int c = 0; c < 3; c++)
            w[c] = between(-1, 1);
        square = pe_dot(w, w);
    } while (square > 1 || square < 1e-4);
    pe_normalize(w, w);
}

static pe_convex random_body(pe_convex_kind kind, double spread, double size)
{
    pe_convex body = { .kind = kind, .radius = { between(0, 1), between(0.1, 1) } };

    for (int c = 0; c < 3; c++) {
        body.centre[c] = between(-spread, spread);
        for (int i = 0; i < 3; i++)
            body.axes[i][c] = between(-size, size);
    }
    for (int c = 0; c < 3 && kind == PE_CONVEX_TRIANGLE; c++)
        body.axes[2][c] = -body.axes[0][c] - body.axes[1][c];
    if (kind >= PE_CONVEX_HALF_SPACE) {
        pe_cross(body.axes[2], body.axes[1], body.axes[0]);
        pe_cross(body.axes[2], body.axes[0], body.axes[1]);
    }
    return body;
}

/* A point of the body, in the coordinates of its axes. */
static void local_point(const pe_convex *body, double u[3])
{
    double angle = between(0, 2 * M_PI), across, tube[3];

    switch (body->kind) {
    case PE_CONVEX_BALL:
        direction(u);
        break;
    case PE_CONVEX_BOX:
        for (int c = 0; c < 3; c++)
            u[c] = between(-1, 1);
        break;
    case PE_CONVEX_CONE:
        u[2] = between(-1, 1);
        across = body->radius[0] + (body->radius[1] - body->radius[0]) * (u[2] + 1) / 2;
        u[0] = across * cos(angle);
        u[1] = across * sin(angle);
        break;
    case PE_CONVEX_TORUS:
        direction(tube);
        pe_scale(body->radius[1], tube, u);
        u[0] += body->radius[0] * cos(angle);
        u[1] += body->radius[0] * sin(angle);
        break;
    case PE_CONVEX_TRIANGLE:
        u[0] = between(0, 1);
        u[1] = between(0, 1 - u[0]);
        u[2] = 1 - u[0] - u[1];
        break;
    case PE_CONVEX_HALF_SPACE:
    case PE_CONVEX_PLANE:
        u[0] = between(-50, 50);
        u[1] = between(-50, 50);
        u[2] = body->kind == PE_CONVEX_PLANE ? 0 : between(-50, 0);
        break;
    }
}

static void point_of(const pe_convex *body, double point[3])
{
    double u[3];

    local_point(body, u);
    for (int c = 0; c < 3; c++)
        point[c] = body->centre[c] + u[0] * body->axes[0][c] + u[1] * body->axes[1][c] + u[2] * body->axes[2][c];
}

typedef struct lobe {
    double origin[3], facet[3], axis[3], half_angle;
} lobe;

/* Is it in the lobe, by more than rounding? */
static bool holds(const lobe *l, const double point[3])
{
    double to[3], distance;

    for (int c = 0; c < 3; c++)
        to[c] = point[c] - l->origin[c];
    distance = sqrt(pe_dot(to, to));
    return pe_dot(to, l->facet) > 1e-6 * distance &&
           pe_dot(to, l->axis) > distance * cos(l->half_angle) + 1e-6 * distance;
}

static pe_sight look(const pe_occluders *occluders, const lobe *l)
{
    return pe_lobe_sight(occluders, l->origin, l->facet, l->axis, l->half_angle);
}

static lobe random_lobe(double spread, double widest)
{
    lobe l = { .half_angle = between(0.01, widest) };

    for (int c = 0; c < 3; c++)
        l.origin[c] = between(-spread, spread);
    direction(l.facet);
    do
        direction(l.axis);
    while (pe_dot(l.axis, l.facet) < 0);
    return l;
}

static pe_occluders *make(void)
{
    pe_occluders *occluders = pe_occluders_create();

    need(occluders != NULL, "no memory");
    return occluders;
}

static void add(pe_occluders *occluders, const pe_convex *bodies, int count)
{
    need(pe_occluders_add(occluders, bodies, count), "no memory");
}

/* ---- the truth, by points of bodies ---- */

/* Scenes of several bodies: in how many lobes of those that are clear is a point of any? */
static void test_points(pe_convex_kind kind, const char *name)
{
    enum { SCENES = 60, LOBES = 60, POINTS = 40, MOST = 40 };
    int wrong = 0, clear = 0, open = 0, total = 0;

    for (int scene = 0; scene < SCENES; scene++) {
        int count = 1 + scene % MOST;
        bool flat = kind >= PE_CONVEX_HALF_SPACE;
        pe_occluders *occluders = make();
        pe_convex bodies[MOST];
        double points[MOST * POINTS][3];

        for (int i = 0; i < count; i++) {
            bodies[i] = random_body(flat && i > 0 ? PE_CONVEX_BALL : kind, 6, 1);
            add(occluders, &bodies[i], 1);
            for (int k = 0; k < POINTS; k++)
                point_of(&bodies[i], points[i * POINTS + k]);
        }
        need(pe_occluders_finish(occluders), "no memory");
        for (int k = 0; k < LOBES; k++, total++) {
            lobe l = random_lobe(8, k % 8 ? 0.6 : M_PI);
            bool hit = false;

            for (int i = 0; i < count * POINTS; i++)
                hit = hit || holds(&l, points[i]);
            open += !hit;
            if (look(occluders, &l) == PE_SIGHT_CLEAR) {
                clear++;
                wrong += hit;
            }
        }
        pe_occluders_free(occluders);
    }
    ok(wrong == 0 && clear > open / 4, "%s: of %d lobes %d hold no point, %d are clear, %d of these are not", name,
       total, open, clear, wrong);
}

/* What stands where bodies overlap is no larger than any of them. */
static void test_overlap(void)
{
    int more = 0, wrong = 0;

    for (int trial = 0; trial < 2000; trial++) {
        pe_convex bodies[2] = { random_body(PE_CONVEX_HALF_SPACE, 1, 1), random_body(PE_CONVEX_BOX, 1, 1) };
        pe_occluders *whole = make(), *part = make();
        lobe l = random_lobe(4, 0.6);
        pe_sight of_whole, of_part;
        double point[3], to[3];

        add(whole, &bodies[1], 1);
        add(part, bodies, 2);
        need(pe_occluders_finish(whole) && pe_occluders_finish(part), "no memory");
        of_whole = look(whole, &l);
        of_part = look(part, &l);
        more += of_part == PE_SIGHT_CLEAR && of_whole != PE_SIGHT_CLEAR;
        wrong += of_part != PE_SIGHT_CLEAR && of_whole == PE_SIGHT_CLEAR;
        for (int k = 0; k < 100 && of_part == PE_SIGHT_CLEAR; k++) {
            point_of(&bodies[1], point);
            for (int c = 0; c < 3; c++)
                to[c] = point[c] - bodies[0].centre[c];
            wrong += pe_dot(to, bodies[0].axes[2]) < 0 && holds(&l, point);
        }
        pe_occluders_free(whole);
        pe_occluders_free(part);
    }
    ok(wrong == 0 && more > 10, "a box cut by a plane: clear in %d cases more than the box, %d of them wrong", more,
       wrong);
}

/* ---- the closed form of a ball ---- */

static void test_ball(void)
{
    int wrong = 0, missed = 0, clear = 0;

    for (int trial = 0; trial < 5000; trial++) {
        pe_convex ball = { PE_CONVEX_BALL, { 0, 0, 0 }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 0, 0 }, 0 };
        pe_occluders *occluders = make();
        lobe l = random_lobe(4, 1.2);
        double distance = sqrt(pe_dot(l.origin, l.origin)), gap;

        add(occluders, &ball, 1);
        need(pe_occluders_finish(occluders), "no memory");
        pe_scale(1, l.axis, l.facet);
        if (distance > 1) {
            gap = acos(-pe_dot(l.axis, l.origin) / distance) - asin(1 / distance) - l.half_angle;
            clear += gap > 0.01;
            missed += gap > 0.01 && look(occluders, &l) != PE_SIGHT_CLEAR;
            wrong += gap < -1e-6 && pe_dot(l.axis, l.origin) < -1 && look(occluders, &l) == PE_SIGHT_CLEAR;
        } else {
            wrong += look(occluders, &l) == PE_SIGHT_CLEAR;
        }
        pe_occluders_free(occluders);
    }
    ok(wrong == 0 && missed < clear / 100,
       "a ball: of %d lobes a hundredth of a radian from it %d are not seen to be, "
       "and %d that meet it are not seen to",
       clear, missed, wrong);
}

/* Small ones right on the axis, or nearly, where what is left of their place beside it is rounding. */
static void test_axis(void)
{
    static const double off[] = { 0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5 };
    int wrong = 0;

    for (int trial = 0; trial < 6000; trial++) {
        pe_convex ball = { .kind = PE_CONVEX_BALL };
        pe_occluders *occluders = make();
        lobe l = random_lobe(4, 0.6);
        double side[3], distance = between(0.5, 20);

        direction(side);
        for (int c = 0; c < 3; c++) {
            ball.centre[c] = l.origin[c] + distance * (l.axis[c] + off[trial % 6] * side[c]);
            ball.axes[c][c] = distance * 1e-3;
        }
        pe_scale(1, l.axis, l.facet);
        add(occluders, &ball, 1);
        need(pe_occluders_finish(occluders), "no memory");
        wrong += look(occluders, &l) == PE_SIGHT_CLEAR;
        pe_occluders_free(occluders);
    }
    ok(wrong == 0, "a small ball on the axis, or nearly: %d are not seen", wrong);
}

/* ---- surfaces ---- */

/* From a point of each of a shell's triangles, along or against their normals: the share that is clear. */
static double shell(double scale, double place, double side)
{
    enum { STEPS = 40 };
    pe_occluders *occluders = make();
    static lobe lobes[STEPS * STEPS];
    int clear = 0;

    for (int i = 0; i < STEPS * STEPS; i++) {
        pe_convex triangle = { .kind = PE_CONVEX_TRIANGLE };
        double corner[3][3], edge[2][3];

        for (int k = 0; k < 3; k++) {
            int column = i % STEPS + k % 2, row = i / STEPS + k / 2;
            double phi = 2 * M_PI * column / STEPS, z = 1 - 1.9 * row / STEPS;
            double point[3] = { sqrt(1 - z * z) * cos(phi), sqrt(1 - z * z) * sin(phi), z };

            for (int c = 0; c < 3; c++) {
                corner[k][c] = place + scale * point[c];
                triangle.centre[c] += corner[k][c] / 3;
            }
        }
        for (int c = 0; c < 3; c++) {
            for (int k = 0; k < 3; k++)
                triangle.axes[k][c] = corner[k][c] - triangle.centre[c];
            edge[0][c] = corner[2][c] - corner[0][c];
            edge[1][c] = corner[1][c] - corner[0][c];
            lobes[i].origin[c] = triangle.centre[c];
        }
        triangle.slack = 1e-6 * scale;
        add(occluders, &triangle, 1);
        pe_cross(edge[0], edge[1], lobes[i].facet);
        if (i < STEPS) /* at the pole there is but one corner of two */
            for (int c = 0; c < 3; c++)
                lobes[i].facet[c] = triangle.centre[c] - place;
        pe_normalize(lobes[i].facet, lobes[i].facet);
        pe_scale(side, lobes[i].facet, lobes[i].facet);
        pe_scale(1, lobes[i].facet, lobes[i].axis);
        lobes[i].half_angle = 0.5;
    }
    need(pe_occluders_finish(occluders), "no memory");
    for (int i = STEPS; i < STEPS * STEPS; i++)
        clear += look(occluders, &lobes[i]) == PE_SIGHT_CLEAR;
    pe_occluders_free(occluders);
    return clear / (double)(STEPS * STEPS - STEPS);
}

/* What is not known is not clear: before the last is added, and where a number is none. */
static void test_unknown(void)
{
    static const double origin[3] = { 0 }, up[3] = { 0, 0, 1 };
    pe_convex ball = { PE_CONVEX_BALL, { 0, 0, -5 }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 0, 0 }, 0 };
    pe_occluders *occluders = pe_occluders_create();

    need(occluders != NULL && pe_occluders_add(occluders, &ball, 1), "no memory");
    ok(pe_lobe_sight(occluders, origin, up, up, 0.1) == PE_SIGHT_UNKNOWN, "a lobe is not clear before all is told");
    need(pe_occluders_finish(occluders), "no memory");
    ok(pe_lobe_sight(occluders, origin, up, up, 0.1) == PE_SIGHT_CLEAR, "but then");
    ball.centre[2] = 5;
    need(pe_occluders_add(occluders, &ball, 1), "no memory");
    ok(pe_lobe_sight(occluders, origin, up, up, 0.1) == PE_SIGHT_UNKNOWN, "nor after one more");
    need(pe_occluders_finish(occluders), "no memory");
    ok(pe_lobe_sight(occluders, origin, up, up, 0.1) == PE_SIGHT_UNKNOWN, "which is in the way");
    pe_occluders_free(occluders);

    occluders = pe_occluders_create();
    ball.centre[0] = NAN;
    need(occluders != NULL && pe_occluders_add(occluders, &ball, 1) && pe_occluders_finish(occluders), "no memory");
    ok(pe_lobe_sight(occluders, origin, up, up, 0.1) == PE_SIGHT_UNKNOWN, "nor where a ball is nowhere");
    pe_occluders_free(occluders);
}

static void test_shell(void)
{
    static const double scales[] = { 1, 1e-3, 1e5 }, places[] = { 0, 3, 1000 };

    for (int k = 0; k < 3; k++) {
        double outside = shell(scales[k], scales[k] * places[k], 1),
               inside = shell(scales[k], scales[k] * places[k], -1);

        ok(outside == 1 && inside < 0.2, "a round mesh of size %g, %g from the origin: %.3f clear outside, %.3f inside",
           scales[k], scales[k] * places[k], outside, inside);
    }
}

static void test_planes(void)
{
    pe_convex ground = { PE_CONVEX_PLANE, { 0, 0, 0 }, { { 1, 0, 0 }, { 0, 0, 1 }, { 0, 3, 0 } }, { 0, 0 }, 0 };
    lobe up = { { 2, 1, 5 }, { 0, 1, 0 }, { 0, 1, 0 }, 0.5 }, down = { { 2, 1, 5 }, { 0, -1, 0 }, { 0, -1, 0 }, 0.5 };
    lobe below = { { 2, -1, 5 }, { 0, 1, 0 }, { 0, 1, 0 }, 0.5 },
         along = { { 2, 1, 5 }, { 1, 0, 0 }, { 1, 0, 0 }, 0.5 };
    lobe on = { { 2, 0, 5 }, { 0, 1, 0 }, { 0.8, 0.6, 0 }, 1 };
    pe_occluders *occluders = make();

    need(pe_occluders_finish(occluders), "no memory");
    ok(look(occluders, &up) == PE_SIGHT_CLEAR, "where nothing is, all is clear");
    pe_occluders_free(occluders);
    occluders = make();
    add(occluders, &ground, 1);
    need(pe_occluders_finish(occluders), "no memory");
    ok(look(occluders, &up) == PE_SIGHT_CLEAR && look(occluders, &down) == PE_SIGHT_COVERED &&
           look(occluders, &below) == PE_SIGHT_COVERED && look(occluders, &along) == PE_SIGHT_UNKNOWN &&
           look(occluders, &on) == PE_SIGHT_CLEAR,
       "a plane: clear above it and on it, covered towards it, from both sides");
    pe_occluders_free(occluders);
    occluders = make();
    add(occluders, &ground, 1);
    add(occluders, NULL, 0);
    need(pe_occluders_finish(occluders), "no memory");
    ok(look(occluders, &up) == PE_SIGHT_UNKNOWN && look(occluders, &down) == PE_SIGHT_COVERED,
       "where something may be anywhere, nothing is clear");
    pe_occluders_free(occluders);
}

/* ---- how wide lobes are ---- */

static void test_spread(void)
{
    static const double range[2] = { -0.8, 0.8 }, shares[] = { 0.5, 0.05, 0.005 };
    float density[16 * 16], *cell = density;
    pe_ndf ndfs[] = { { PE_NDF_BECKMANN, 0.1, 0.3, NULL },
                      { PE_NDF_BECKMANN, 0.3, 0.3, NULL },
                      { PE_NDF_GGX, 0.2, 0.2, NULL },
                      { PE_NDF_PHONG, 0.3, 0.3, NULL },
                      { PE_NDF_TABLE, 0, 0, NULL } };
    pe_ndf_table *table;
    pe_error error;

    for (int y = 0; y < 16; y++)
        for (int x = 0; x < 16; x++)
            *cell++ = (float)(x + y);
    need(pe_ndf_table_create(16, 16, range, range, density, &table, &error) == PE_OK, "%s", error.message);
    ndfs[4].table = table;
    for (int i = 0; i < 5; i++) {
        enum { POINTS = 200000 };
        static const double zero[2];
        double worst = 0;
        int beyond[3] = { 0 };

        for (int k = 0; k < POINTS; k++) {
            double u[2], h[3];

            pe_golden_point(k, POINTS, zero, u);
            pe_ndf_sample(&ndfs[i], u[0], u[1], h);
            for (int s = 0; s < 3; s++)
                beyond[s] += acos(h[2]) > pe_ndf_spread(&ndfs[i], shares[s]);
        }
        for (int s = 0; s < 3; s++)
            worst = worst_of(beyond[s] / (shares[s] * POINTS), worst);
        /* Of two widths the wider counts, and of a table whole cells. */
        ok(worst < 1.02 && (i == 0 || beyond[0] > (i == 4 ? 0.5 : 0.98) * 0.5 * POINTS),
           "kind %d, alpha %g, %g: no more than the share is left out: %.3f of it at most", (int)ndfs[i].kind,
           ndfs[i].alpha_x, ndfs[i].alpha_y, worst);
    }
    pe_ndf_table_free(table);
}

int main(void)
{
    static const char *const names[] = {
        "balls", "boxes", "cones", "rings", "triangles", "a half space, and balls", "a plane, and balls"
    };

    for (int kind = 0; kind <= PE_CONVEX_PLANE; kind++)
        test_points((pe_convex_kind)kind, names[kind]);
    test_overlap();
    test_ball();
    test_axis();
    test_unknown();
    test_shell();
    test_planes();
    test_spread();
    return done_testing();
}
