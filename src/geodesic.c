/* geodesic.c - geodesic spheres of class I.
 *
 * Each face of the icosahedron carries the flat grid P(i, j) = (i A + j B + (f - i - j) C) / f; a vertex is P made
 * unit.  Point location follows from that: the face of a direction is the one whose centre is nearest (the faces are
 * the Voronoi cells of their centres); its gnomonic image on the flat face, scaled by f, lies in the unit cell
 * (floor i, floor j), in the triangle on this or that side of the cell's diagonal.
 *
 * Directions come in any order, and a branch that goes either way costs more than all these sums: there is none. */
#include "geodesic.h"

#include "status.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

#define FACES 20

typedef struct face {
    double centre[3];  /* unit */
    double inverse[9]; /* rows a, b, c: coordinates of a direction along the corners A, B, C */
    int *vertices;     /* vertex at grid point (i, j), at index i * (f + 1) + j */
} face;

struct pe_geodesic {
    int frequency, count;
    double (*vertices)[3];
    double *lengths; /* of the flat grid point under each vertex, for barycentric weights of unit vertices */
    double *shares;
    face faces[FACES];
    int nearest[8][8]; /* faces by octant and by which family is nearest: see nearest_face */
    int *grids;
};

#define GOLDEN 1.6180339887498948482 /* the golden ratio */

/* Cyclic permutations of (0, +-1, +-golden ratio), and the triples at edge length 2. */
static void make_icosahedron(double corners[12][3], int faces[FACES][3])
{
    int found = 0;

    for (int k = 0; k < 12; k++) {
        double p[3] = { 0, k & 1 ? -1 : 1, k & 2 ? -GOLDEN : GOLDEN };

        for (int c = 0; c < 3; c++)
            corners[k][(c + k / 4) % 3] = p[c];
        pe_normalize(corners[k], corners[k]);
    }
    for (int a = 0; a < 12; a++)
        for (int b = a + 1; b < 12; b++)
            for (int c = b + 1; c < 12; c++)
                if (pe_dot(corners[a], corners[b]) > 0.4 && pe_dot(corners[b], corners[c]) > 0.4 &&
                    pe_dot(corners[c], corners[a]) > 0.4) {
                    faces[found][0] = a;
                    faces[found][1] = b;
                    faces[found++][2] = c;
                }
}

static void make_face(face *f, const double a[3], const double b[3], const double c[3])
{
    double volume;

    for (int k = 0; k < 3; k++)
        f->centre[k] = a[k] + b[k] + c[k];
    pe_normalize(f->centre, f->centre);
    pe_cross(b, c, f->inverse);
    pe_cross(c, a, f->inverse + 3);
    pe_cross(a, b, f->inverse + 6);
    volume = pe_dot(a, f->inverse);
    for (int k = 0; k < 9; k++)
        f->inverse[k] /= volume;
}

/* Vertices made so far, in slices of the sphere by their y: where neighbouring faces meet, each finds the other's. */
typedef struct slices {
    int count;
    int *first; /* the vertex last put into each slice, -1 if there is none */
    int *next;  /* of each vertex, the one put before it */
} slices;

static int slice_of(const slices *s, double y)
{
    int slice = (int)((y + 1) / 2 * s->count);

    return slice < 0 ? 0 : slice >= s->count ? s->count - 1 : slice;
}

static void put(slices *s, const pe_geodesic *g, int vertex)
{
    int slice = slice_of(s, g->vertices[vertex][1]);

    s->next[vertex] = s->first[slice];
    s->first[slice] = vertex;
}

/* The vertex at p, -1 if there is none. */
static int find(const slices *s, const pe_geodesic *g, const double p[3])
{
    for (int slice = slice_of(s, p[1] - 1e-6); slice <= slice_of(s, p[1] + 1e-6); slice++)
        for (int k = s->first[slice]; k >= 0; k = s->next[k])
            if (pe_dot(g->vertices[k], p) > 1 - 1e-9)
                return k;
    return -1;
}

/* The pair whose members are p or -p, made if it is new; returns the vertex at p. */
static int find_or_add(pe_geodesic *g, slices *s, const double p[3], double length)
{
    int found = find(s, g, p);

    if (found >= 0)
        return found;
    for (int c = 0; c < 3; c++) {
        g->vertices[g->count][c] = p[c];
        g->vertices[g->count + 1][c] = -p[c];
    }
    g->lengths[g->count] = g->lengths[g->count + 1] = length;
    put(s, g, g->count);
    put(s, g, g->count + 1);
    g->count += 2;
    return g->count - 2;
}

static void make_vertices(pe_geodesic *g, slices *s, face *f, const double a[3], const double b[3], const double c[3])
{
    int n = g->frequency;

    for (int i = 0; i <= n; i++)
        for (int j = 0; i + j <= n; j++) {
            double p[3], length;

            for (int k = 0; k < 3; k++)
                p[k] = (i * a[k] + j * b[k] + (n - i - j) * c[k]) / n;
            length = sqrt(pe_dot(p, p));
            pe_scale(1 / length, p, p);
            f->vertices[i * (n + 1) + j] = find_or_add(g, s, p, length);
        }
}

/* The faces' centres are the corners of a dodecahedron, in four families: those of a cube, (+-1, +-1, +-1), and the
 * cyclic permutations of (+-1 / golden ratio, 0, +-golden ratio).  Here x by x, y by y and z by z, without signs. */
#define FAMILIES 4
static const double centres[3][FAMILIES] = { { 1, GOLDEN - 1, GOLDEN, 0 },
                                             { 1, 0, GOLDEN - 1, GOLDEN },
                                             { 1, GOLDEN, 0, GOLDEN - 1 } };

/* Of a family the centre nearest to a direction is that with its signs. */
static inline int octant_of(const double n[3])
{
    return (n[0] < 0) | (n[1] < 0) << 1 | (n[2] < 0) << 2;
}

static int face_at(const pe_geodesic *g, int octant, int family)
{
    for (int k = 0; k < FACES; k++) {
        double cosine = 0;

        for (int c = 0; c < 3; c++)
            cosine += (octant >> c & 1 ? -1 : 1) * centres[c][family] * g->faces[k].centre[c] / sqrt(3);
        if (cosine > 0.99)
            return k;
    }
    return 0;
}

static void find_nearest_faces(pe_geodesic *g)
{
    for (int octant = 0; octant < 8; octant++)
        for (int k = 0; k < 8; k++)
            g->nearest[octant][k] = face_at(g, octant, k & 4 ? 2 + (k >> 1 & 1) : k & 1);
}

/* A flat grid's cells are all of one size; seen from the centre, one at the distance d is d^-3 as large, and has lost a
 * sixth at the icosahedron's own corners, where five triangles meet in place of six. */
static void set_shares(pe_geodesic *g)
{
    double sum = 0;

    for (int k = 0; k < g->count; k++) {
        g->shares[k] = pow(g->lengths[k], -3) * (g->lengths[k] > 1 - 1e-9 ? 5.0 / 6 : 1);
        sum += g->shares[k];
    }
    for (int k = 0; k < g->count; k++)
        g->shares[k] /= sum;
}

static void make_faces(pe_geodesic *g, slices *s)
{
    size_t grid = (size_t)(g->frequency + 1) * (size_t)(g->frequency + 1);
    double corners[12][3];
    int triples[FACES][3];

    for (int k = 0; k < s->count; k++)
        s->first[k] = -1;
    make_icosahedron(corners, triples);
    for (int k = 0; k < FACES; k++) {
        const double *a = corners[triples[k][0]], *b = corners[triples[k][1]], *c = corners[triples[k][2]];

        g->faces[k].vertices = g->grids + (size_t)k * grid;
        make_face(&g->faces[k], a, b, c);
        make_vertices(g, s, &g->faces[k], a, b, c);
    }
    find_nearest_faces(g);
    set_shares(g);
}

pe_status pe_geodesic_make(int frequency, pe_geodesic **out, pe_error *error)
{
    size_t count = 10 * (size_t)frequency * (size_t)frequency + 2;
    size_t grid = (size_t)(frequency + 1) * (size_t)(frequency + 1);
    slices s = { .count = 4 * frequency };
    pe_geodesic *g = calloc(1, sizeof *g);
    int whole;

    if (!g)
        return pe_fail_memory(error, "a geodesic sphere");
    g->frequency = frequency;
    g->vertices = calloc(count, sizeof *g->vertices);
    g->lengths = calloc(count, sizeof *g->lengths);
    g->shares = calloc(count, sizeof *g->shares);
    g->grids = calloc(FACES * grid, sizeof *g->grids);
    s.first = calloc((size_t)s.count, sizeof *s.first);
    s.next = calloc(count, sizeof *s.next);
    whole = g->vertices && g->lengths && g->shares && g->grids && s.first && s.next;
    if (whole)
        make_faces(g, &s);
    free(s.first);
    free(s.next);
    if (!whole) {
        pe_geodesic_free(g);
        return pe_fail_memory(error, "a geodesic sphere");
    }
    *out = g;
    return PE_OK;
}

void pe_geodesic_free(pe_geodesic *g)
{
    if (!g)
        return;
    free(g->vertices);
    free(g->lengths);
    free(g->shares);
    free(g->grids);
    free(g);
}

int pe_geodesic_count(const pe_geodesic *g)
{
    return g->count;
}

const double *pe_geodesic_vertex(const pe_geodesic *g, int index)
{
    return g->vertices[index];
}

double pe_geodesic_share(const pe_geodesic *g, int index)
{
    return g->shares[index];
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

static inline const face *nearest_face(const pe_geodesic *g, const double n[3])
{
    double cosines[FAMILIES];
    int first, second, either;

    for (int k = 0; k < FAMILIES; k++)
        cosines[k] = fabs(n[0]) * centres[0][k] + fabs(n[1]) * centres[1][k] + fabs(n[2]) * centres[2][k];
    first = cosines[1] > cosines[0];
    second = cosines[3] > cosines[2];
    either = greater(cosines[2], cosines[3]) > greater(cosines[0], cosines[1]);
    return &g->faces[g->nearest[octant_of(n)][either << 2 | second << 1 | first]];
}

/* In a cell whose corners are (i, j), (i + 1, j), (i, j + 1) and (i + 1, j + 1), the point (x, y) has in the lower
 * triangle the weights e = 1 - x - y, x and y; in the upper one, where e < 0, they are 0, x + e, y + e and -e. */
void pe_geodesic_locate(const pe_geodesic *g, const double n[3], int vertices[3], double weights[3])
{
    const face *f = nearest_face(g, n);
    int size = g->frequency, i, j;
    double a = pe_dot(f->inverse, n), b = pe_dot(f->inverse + 3, n), c = pe_dot(f->inverse + 6, n);
    double scale = size / (a + b + c), x = greater(a * scale, 0), y = greater(b * scale, 0), e, below, sum;
    const int *corner;

    /* Rounding may leave the face by a hair: stay on its grid. */
    i = x < size ? (int)x : size - 1;
    j = y < size - i ? (int)y : size - i - 1;
    x -= i;
    y -= j;
    e = 1 - x - y;
    below = (e - fabs(e)) / 2;
    corner = f->vertices + i * (size + 1) + j;
    vertices[0] = corner[size + 1];
    vertices[1] = corner[1];
    vertices[2] = corner[((e < 0) & (i + j + 2 <= size)) * (size + 2)];
    x = greater(x + below, 0) * g->lengths[vertices[0]];
    y = greater(y + below, 0) * g->lengths[vertices[1]];
    e = fabs(e) * g->lengths[vertices[2]];
    sum = 1 / (x + y + e);
    weights[0] = x * sum;
    weights[1] = y * sum;
    weights[2] = e * sum;
}

int pe_geodesic_frequency(int count)
{
    for (int f = 1; f <= PE_FREQUENCY_MAX; f++)
        if (10 * f * f + 2 == count)
            return f;
    return 0;
}
