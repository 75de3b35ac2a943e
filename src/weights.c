/* weights.c - see weights.h.  The vertices of a cone lie between two heights: domes are sorted by theirs. */
#include "weights.h"

#include "phong.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>

static const int frequencies[PE_DOMES] = { 144, 72, 36, 18, 9 };

/* The whole weight of a lobe is summed up to this part of its peak. */
#define WHOLE 1e-9

/* A dome serves a lobe whose standard deviation, in radians, is at least this part of the distance of its vertices. */
#define LOBE_PER_PITCH 0.86

static double deviation_of(double exponent)
{
    return 1 / sqrt(exponent + 1e-9);
}

static int choose_dome(double exponent)
{
    for (int d = PE_DOMES - 1; d > 0; d--)
        if (deviation_of(exponent) >= LOBE_PER_PITCH * pe_dome_pitch(frequencies[d]))
            return d;
    return 0;
}

/* ---- voxels ---- */

/* Of the three places that are (x, y, z) moved on, the one that stands for all; those with x, y, z in the upper half
 * stand for their mirror images. */
static int is_first(const int at[3])
{
    int codes[3];

    for (int k = 0; k < 3; k++)
        codes[k] = at[k] << 16 | at[(k + 1) % 3] << 8 | at[(k + 2) % 3];
    return codes[0] <= codes[1] && codes[0] <= codes[2];
}

static double lambda_of(int size, const int at[3])
{
    double t[3];

    pe_voxel_centre(size, at, t);
    return sqrt(pe_dot(t, t));
}

/* Counts the voxels, or lists them if there is where. */
static size_t list_voxels(const pe_smoothness *scale, pe_voxel *voxels)
{
    size_t count = 0;
    int half = scale->size / 2;

    for (int k = 0; k < half * half * half; k++) {
        const int at[3] = { half + k / half / half, half + k / half % half, half + k % half };
        double lambda = lambda_of(scale->size, at);

        if (!is_first(at) || lambda > pe_voxel_reach(scale->size))
            continue;
        if (voxels)
            voxels[count] = (pe_voxel){ { (unsigned char)at[0], (unsigned char)at[1], (unsigned char)at[2] },
                                        (unsigned char)choose_dome(pe_smoothness_exponent(scale, fmin(lambda, 1))) };
        count++;
    }
    return count;
}

static pe_status make_domes(pe_weights *w, pe_error *error)
{
    int used[PE_DOMES] = { 0 };
    pe_status status = PE_OK;

    for (size_t k = 0; k < w->count; k++)
        used[w->voxels[k].dome] = 1;
    for (int d = 0; d < PE_DOMES && status == PE_OK; d++)
        if (used[d])
            status = pe_dome_make(frequencies[d], &w->domes[d], error);
    return status;
}

pe_status pe_weights_make_voxels(const pe_smoothness *scale, double threshold, pe_weights **out, pe_error *error)
{
    pe_weights *w = calloc(1, sizeof *w);
    pe_status status = PE_OK;

    if (!w)
        return pe_fail_memory(error, "a table of weights");
    w->scale = *scale;
    w->threshold = threshold;
    w->count = list_voxels(scale, NULL);
    w->voxels = calloc(w->count + 1, sizeof *w->voxels);
    w->kept = calloc(w->count + 1, sizeof *w->kept);
    w->first = calloc(w->count + 1, sizeof *w->first);
    if (!w->voxels || !w->kept || !w->first) {
        status = pe_fail_memory(error, "a table of weights");
    } else {
        list_voxels(scale, w->voxels);
        status = make_domes(w, error);
    }
    if (status == PE_OK)
        *out = w;
    else
        pe_weights_free(w);
    return status;
}

void pe_weights_free(pe_weights *w)
{
    if (!w)
        return;
    for (int d = 0; d < PE_DOMES; d++)
        pe_dome_free(&w->domes[d]);
    free(w->voxels);
    free(w->kept);
    free(w->first);
    free(w->vertex);
    free(w->weight);
    free(w);
}

size_t pe_weights_bytes(const pe_weights *w)
{
    size_t entries = (size_t)w->first[w->count];

    return entries * (sizeof *w->vertex + sizeof *w->weight) + w->count * (sizeof *w->first + sizeof *w->kept);
}

/* ---- entries ---- */

/* The lobe of one voxel over its dome. */
typedef struct lobe {
    const pe_dome *dome;
    double r[3], exponent, threshold, least_cosine;
    int begin, end;   /* in from_top: those that may have weight */
    size_t entries;   /* above the threshold */
    double sum, kept; /* of all weights, and of those */
} lobe;

/* The first of from_top at or below a height. */
static int find_height(const pe_dome *dome, double y)
{
    int low = 0, high = dome->count;

    while (low < high) {
        int middle = (low + high) / 2;

        if (pe_geodesic_vertex(dome->sphere, dome->from_top[middle])[1] > y)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static lobe make_lobe(const pe_weights *w, size_t k)
{
    const pe_voxel *voxel = &w->voxels[k];
    const int at[3] = { voxel->at[0], voxel->at[1], voxel->at[2] };
    lobe l = { .dome = &w->domes[voxel->dome], .threshold = w->threshold };
    double t[3], lambda, polar, reach;

    pe_voxel_centre(w->scale.size, at, t);
    lambda = sqrt(pe_dot(t, t));
    pe_scale(1 / lambda, t, l.r);
    l.exponent = pe_smoothness_exponent(&w->scale, lambda);
    polar = acos(fmax(fmin(l.r[1], 1), -1));
    l.least_cosine = exp(log(WHOLE) / l.exponent);
    reach = acos(l.least_cosine) + 1e-6;
    l.begin = polar - reach > 0 ? find_height(l.dome, cos(polar - reach)) : 0;
    l.end = polar + reach < M_PI ? find_height(l.dome, cos(polar + reach)) : l.dome->count;
    return l;
}

/* What is done with each vertex above the threshold. */
typedef void keep(void *data, int vertex, double weight);

static void for_each_vertex(lobe *l, keep *function, void *data)
{
    l->entries = 0;
    l->sum = l->kept = 0;
    for (int k = l->begin; k < l->end; k++) {
        int v = l->dome->from_top[k];
        double cosine = pe_dot(l->r, pe_geodesic_vertex(l->dome->sphere, v)), power, weight;

        if (!(cosine > l->least_cosine))
            continue;
        power = exp(l->exponent * log(cosine));
        weight = power * pe_geodesic_share(l->dome->sphere, v);
        l->sum += weight;
        if (!(power > l->threshold))
            continue;
        l->entries++;
        l->kept += weight;
        function(data, v, weight);
    }
}

typedef struct job {
    pe_weights *weights;
    size_t at; /* the next entry of the voxel that is being filled */
} job;

static void only_count(void *data, int vertex, double weight)
{
    (void)data;
    (void)vertex;
    (void)weight;
}

static void store(void *data, int vertex, double weight)
{
    job *j = data;

    j->weights->vertex[j->at] = (uint32_t)vertex;
    j->weights->weight[j->at++] = (float)weight;
}

/* A lobe that falls between the vertices takes the three around it. */
#define AROUND 3

static void count_entries(size_t k, void *data)
{
    pe_weights *w = data;
    lobe l = make_lobe(w, k);

    for_each_vertex(&l, only_count, NULL);
    w->first[k + 1] = l.entries ? l.entries : AROUND;
    w->kept[k] = l.entries ? (float)(l.kept / l.sum) : 1;
}

static void store_around(pe_weights *w, size_t k, const lobe *l)
{
    int vertices[AROUND];
    double shares[AROUND];

    pe_geodesic_locate(l->dome->sphere, l->r, vertices, shares);
    for (int i = 0; i < AROUND; i++) {
        w->vertex[w->first[k] + (size_t)i] = (uint32_t)vertices[i];
        w->weight[w->first[k] + (size_t)i] = (float)shares[i];
    }
}

static void fill_entries(size_t k, void *data)
{
    pe_weights *w = data;
    lobe l = make_lobe(w, k);
    job j = { w, w->first[k] };

    for_each_vertex(&l, store, &j);
    if (!l.entries) {
        store_around(w, k, &l);
        return;
    }
    for (size_t i = w->first[k]; i < w->first[k + 1]; i++)
        w->weight[i] = (float)((double)w->weight[i] / l.kept);
}

pe_status pe_weights_make(const pe_smoothness *scale, double threshold, int threads, const pe_report *report,
                          pe_weights **out, pe_error *error)
{
    pe_report half = report ? *report : (pe_report){ 0 };
    pe_weights *w;
    pe_status status = pe_weights_make_voxels(scale, threshold, &w, error);

    if (status != PE_OK)
        return status;
    half.total = 2 * (double)w->count;
    status = pe_parallel_for(w->count, threads, count_entries, w, &half);
    for (size_t k = 0; k < w->count; k++)
        w->first[k + 1] += w->first[k];
    w->vertex = malloc((size_t)w->first[w->count] * sizeof *w->vertex);
    w->weight = malloc((size_t)w->first[w->count] * sizeof *w->weight);
    if (status == PE_OK && (!w->vertex || !w->weight))
        status = pe_fail_memory(error, "a table of weights");
    half.done = (double)w->count;
    if (status == PE_OK)
        status = pe_parallel_for(w->count, threads, fill_entries, w, &half);
    if (status == PE_OK)
        *out = w;
    else
        pe_weights_free(w);
    return status;
}
