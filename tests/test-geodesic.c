/* test-geodesic.c - claim: 10 f^2 + 2 vertices in opposite pairs, evenly spread; location finds the triangle. */
#include "geodesic.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <string.h>

static int nearest_of_all(const pe_geodesic *g, const double n[3])
{
    int best = 0;

    for (int k = 1; k < pe_geodesic_count(g); k++)
        if (pe_dot(n, pe_geodesic_vertex(g, k)) > pe_dot(n, pe_geodesic_vertex(g, best)))
            best = k;
    return best;
}

/* Is `vertex`, or one as near to n, among the triangle's? */
static int has_nearest(const pe_geodesic *g, const double n[3], const int vertices[3])
{
    double nearest = pe_dot(n, pe_geodesic_vertex(g, nearest_of_all(g, n)));

    for (int k = 0; k < 3; k++)
        if (pe_dot(n, pe_geodesic_vertex(g, vertices[k])) > nearest - 1e-12)
            return 1;
    return 0;
}

/* n against the weighted vertices: cosine of the angle between them. */
static double rebuilt_cosine(const pe_geodesic *g, const double n[3], const int vertices[3], const double weights[3])
{
    double sum[3] = { 0 };

    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            sum[c] += weights[k] * pe_geodesic_vertex(g, vertices[k])[c];
    pe_normalize(sum, sum);
    return pe_dot(sum, n);
}

static void test_vertices(const pe_geodesic *g, int f)
{
    int count = pe_geodesic_count(g), opposite = 1, unit = 1, distinct = 1;

    for (int k = 0; k < count; k++) {
        const double *v = pe_geodesic_vertex(g, k), *other = pe_geodesic_vertex(g, k ^ 1);

        opposite &= v[0] == -other[0] && v[1] == -other[1] && v[2] == -other[2];
        unit &= fabs(pe_dot(v, v) - 1) < 1e-14;
        for (int j = 0; j < k; j++)
            distinct &= pe_dot(v, pe_geodesic_vertex(g, j)) < 1 - 0.1 / (f * f);
    }
    ok(count == 10 * f * f + 2, "f = %d: %d vertices", f, count);
    ok(opposite && unit && distinct, "f = %d: unit, distinct, in exactly opposite pairs", f);
    ok(pe_geodesic_frequency(count) == f, "f = %d: recognised by its count", f);
}

static void test_location(const pe_geodesic *g, int f)
{
    int points = 20000, sums = 1, nearest = 1, at_vertices = 1;
    double lowest = 1, widest = 1;
    unsigned state = 3;

    for (int k = 0; k < points; k++) {
        double n[3], weights[3];
        int vertices[3];

        reference_random_direction(&state, n);
        if (k % 10 == 0) /* edges and corners of the icosahedron's symmetry, where floor() is on the brink */
            for (int c = 0; c < 3; c++)
                n[c] = round(n[c] * 2) + (k % 20 ? 0 : 1e-15);
        if (!(pe_dot(n, n) > 0))
            n[1] = 1;
        pe_normalize(n, n);
        pe_geodesic_locate(g, n, vertices, weights);
        sums &= weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0 &&
                fabs(weights[0] + weights[1] + weights[2] - 1) < 1e-14;
        lowest = least_of(lowest, rebuilt_cosine(g, n, vertices, weights));
        nearest &= has_nearest(g, n, vertices);
        for (int c = 0; c < 3; c++)
            widest = least_of(widest, pe_dot(n, pe_geodesic_vertex(g, vertices[c])));
    }
    for (int k = 0; k < pe_geodesic_count(g); k++) {
        double weights[3], own = 0;
        int vertices[3];

        pe_geodesic_locate(g, pe_geodesic_vertex(g, k), vertices, weights);
        for (int c = 0; c < 3; c++)
            own += vertices[c] == k ? weights[c] : 0;
        at_vertices &= own > 1 - 1e-12;
    }
    ok(sums, "f = %d: weights are not negative and add up to 1", f);
    ok(lowest > 1 - 1e-14, "f = %d: the weighted vertices give n back (cosine %.17g)", f, lowest);
    ok(nearest, "f = %d: the nearest vertex of all is one of the triangle's", f);
    ok(acos(widest) < 1.4 / f, "f = %d: no vertex of the triangle is farther than %.3f", f, acos(widest));
    ok(at_vertices, "f = %d: a vertex has itself alone", f);
}

int main(void)
{
    static const int frequencies[] = { 1, 2, 3, 4, 8, 9, 32 };

    for (int k = 0; k < (int)(sizeof frequencies / sizeof *frequencies); k++) {
        pe_geodesic *g;

        need(pe_geodesic_make(frequencies[k], &g, NULL) == PE_OK, "no memory");
        if (frequencies[k] < 20)
            test_vertices(g, frequencies[k]);
        test_location(g, frequencies[k]);
        pe_geodesic_free(g);
    }
    ok(pe_geodesic_frequency(43) == 0 && pe_geodesic_frequency(0) == 0, "43 and 0 are no counts");
    return done_testing();
}
