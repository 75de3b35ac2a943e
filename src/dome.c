/* dome.c - see dome.h. */
#include "dome.h"

#include "parallel.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

double pe_dome_pitch(int frequency)
{
    double count = 10.0 * frequency * frequency + 2;

    return sqrt(4 * M_PI / count * 2 / sqrt(3)); /* of a lattice of triangles */
}

/* ---- images of vertices ---- */

static int vertex_at(const pe_geodesic *sphere, const double direction[3])
{
    int vertices[3], best = 0;
    double weights[3];

    pe_geodesic_locate(sphere, direction, vertices, weights);
    for (int k = 1; k < 3; k++)
        if (weights[k] > weights[best])
            best = k;
    return vertices[best];
}

/* The signs are changed after the coordinates are moved on; each image is one change away from one before it. */
static void set_images(pe_dome *dome)
{
    for (int v = 0; v < dome->count; v++) {
        const double *at = pe_geodesic_vertex(dome->sphere, v);
        double moved[3] = { at[1], at[2], at[0] };

        dome->images[v][0] = (unsigned)v;
        dome->images[v][8] = (unsigned)vertex_at(dome->sphere, moved);
        for (int c = 0; c < 3; c++) {
            double mirrored[3] = { at[0], at[1], at[2] };

            mirrored[c] = -mirrored[c];
            dome->images[v][1 << c] = (unsigned)vertex_at(dome->sphere, mirrored);
        }
    }
    for (int v = 0; v < dome->count; v++)
        dome->images[v][16] = dome->images[dome->images[v][8]][8];
    for (int v = 0; v < dome->count; v++)
        for (int g = 0; g < PE_DOME_IMAGES; g++) {
            unsigned image = dome->images[v][g & ~7];

            for (int c = 0; c < 3; c++)
                if (g >> c & 1)
                    image = dome->images[image][1 << c];
            dome->images[v][g] = image;
        }
}

/* ---- made, released ---- */

typedef struct place {
    double y;
    int vertex;
} place;

static int higher_first(const void *a, const void *b)
{
    const place *p = a, *q = b;

    return p->y != q->y ? (p->y < q->y) - (p->y > q->y) : (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

static pe_status sort_vertices(pe_dome *dome, pe_error *error)
{
    place *places = malloc((size_t)dome->count * sizeof *places);

    if (!places)
        return pe_fail_memory(error, "a dome");
    for (int v = 0; v < dome->count; v++)
        places[v] = (place){ pe_geodesic_vertex(dome->sphere, v)[1], v };
    qsort(places, (size_t)dome->count, sizeof *places, higher_first);
    for (int v = 0; v < dome->count; v++)
        dome->from_top[v] = places[v].vertex;
    free(places);
    return PE_OK;
}

pe_status pe_dome_make(int frequency, pe_dome *dome, pe_error *error)
{
    pe_status status;

    *dome = (pe_dome){ 0 };
    status = pe_geodesic_make(frequency, &dome->sphere, error);
    if (status != PE_OK)
        return status;
    dome->count = pe_geodesic_count(dome->sphere);
    dome->from_top = malloc((size_t)dome->count * sizeof *dome->from_top);
    dome->images = malloc((size_t)dome->count * sizeof *dome->images);
    if (!dome->from_top || !dome->images)
        status = pe_fail_memory(error, "a dome");
    else
        status = sort_vertices(dome, error);
    if (status == PE_OK)
        set_images(dome);
    else
        pe_dome_free(dome);
    return status;
}

void pe_dome_free(pe_dome *dome)
{
    pe_geodesic_free(dome->sphere);
    free(dome->from_top);
    free(dome->images);
    *dome = (pe_dome){ 0 };
}

/* ---- an environment on it ---- */

#define VERTICES_PER_TURN 1024

typedef struct fill {
    const pe_dome *dome;
    const pe_env *env;
    float *values;
} fill;

static int turn_end(const fill *f, size_t turn)
{
    int end = ((int)turn + 1) * VERTICES_PER_TURN;

    return end < f->dome->count ? end : f->dome->count;
}

static void look_up(size_t turn, void *data)
{
    const fill *f = data;

    for (int v = (int)turn * VERTICES_PER_TURN; v < turn_end(f, turn); v++) {
        double rgb[3];

        pe_env_lookup(f->env, pe_geodesic_vertex(f->dome->sphere, v), rgb);
        for (int c = 0; c < 3; c++)
            f->values[(size_t)v * PE_DOME_VALUES + (size_t)c] = (float)rgb[c];
    }
}

/* Image 0 is the vertex itself, and is there already. */
static void copy_images(size_t turn, void *data)
{
    const fill *f = data;

    for (int v = (int)turn * VERTICES_PER_TURN; v < turn_end(f, turn); v++) {
        float *to = f->values + (size_t)v * PE_DOME_VALUES;

        for (int g = 1; g < PE_DOME_IMAGES; g++)
            memcpy(to + 3 * g, f->values + (size_t)f->dome->images[v][g] * PE_DOME_VALUES, 3 * sizeof *to);
        memset(to + 3 * PE_DOME_IMAGES, 0, (PE_DOME_VALUES - 3 * PE_DOME_IMAGES) * sizeof *to);
    }
}

void pe_dome_fill(const pe_dome *dome, const pe_env *env, int threads, float *values)
{
    fill f = { .dome = dome, .env = env, .values = values };
    size_t turns = ((size_t)dome->count + VERTICES_PER_TURN - 1) / VERTICES_PER_TURN;

    pe_parallel_for(turns, threads, look_up, &f, NULL);
    pe_parallel_for(turns, threads, copy_images, &f, NULL);
}
