/* weights_file.c - a table of weights as a file, little-endian:
 *
 *   8 bytes  "PEWEIGHT"
 *   u32      PE_WEIGHTS_VERSION
 *   u32      size; f64 window, levels, threshold
 *   u64      voxels that stand for all, u64 entries
 *   of each voxel:  u32 entries, f32 kept
 *   of each entry:  u32 vertex, f32 weight
 *   u64      sum of all bytes before, by Fowler, Noll and Vo's function
 *
 * Which voxels and which domes follow from the size, the window and the levels. */
#include "status.h"
#include "weights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAGIC "PEWEIGHT"
#define MAGIC_BYTES 8
#define HEADER_BYTES (8 + 4 + 4 + 3 * 8 + 2 * 8)
#define VOXEL_BYTES 8
#define ENTRY_BYTES 8
#define SUM_BYTES 8

static uint64_t sum_of(const unsigned char *bytes, size_t size)
{
    uint64_t sum = 14695981039346656037u;

    for (size_t k = 0; k < size; k++)
        sum = (sum ^ bytes[k]) * 1099511628211u;
    return sum;
}

/* ---- write ---- */

static unsigned char *put_bits(unsigned char *at, uint64_t bits, int bytes)
{
    for (int k = 0; k < bytes; k++)
        *at++ = (unsigned char)(bits >> 8 * k);
    return at;
}

static unsigned char *put_double(unsigned char *at, double value)
{
    uint64_t bits;

    memcpy(&bits, &value, sizeof bits);
    return put_bits(at, bits, 8);
}

static unsigned char *put_float(unsigned char *at, float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    return put_bits(at, bits, 4);
}

void pe_weights_seal(unsigned char *bytes, size_t size)
{
    put_bits(bytes + size - SUM_BYTES, sum_of(bytes, size - SUM_BYTES), SUM_BYTES);
}

static void encode(const pe_weights *w, unsigned char *bytes, size_t size)
{
    unsigned char *at = bytes;

    for (int k = 0; k < MAGIC_BYTES; k++)
        at[k] = (unsigned char)MAGIC[k];
    at = put_bits(at + MAGIC_BYTES, PE_WEIGHTS_VERSION, 4);
    at = put_bits(at, (uint64_t)w->scale.size, 4);
    at = put_double(at, w->scale.window);
    at = put_double(at, w->scale.levels);
    at = put_double(at, w->threshold);
    at = put_bits(at, w->count, 8);
    at = put_bits(at, w->first[w->count], 8);
    for (size_t k = 0; k < w->count; k++) {
        at = put_bits(at, w->first[k + 1] - w->first[k], 4);
        at = put_float(at, w->kept[k]);
    }
    for (size_t k = 0; k < w->first[w->count]; k++) {
        at = put_bits(at, w->vertex[k], 4);
        at = put_float(at, w->weight[k]);
    }
    pe_weights_seal(bytes, size);
}

pe_status pe_weights_write(const pe_weights *w, const char *path, pe_error *error)
{
    size_t size = HEADER_BYTES + w->count * VOXEL_BYTES + (size_t)w->first[w->count] * ENTRY_BYTES + SUM_BYTES;
    unsigned char *bytes = malloc(size);
    pe_status status;

    if (!bytes)
        return pe_fail_memory(error, "a file of weights");
    encode(w, bytes, size);
    status = pe_file_write(path, bytes, size, error);
    free(bytes);
    return status;
}

/* ---- read ---- */

static uint64_t get_bits(const unsigned char *at, int bytes)
{
    uint64_t bits = 0;

    for (int k = 0; k < bytes; k++)
        bits |= (uint64_t)at[k] << 8 * k;
    return bits;
}

static double get_double(const unsigned char *at)
{
    uint64_t bits = get_bits(at, 8);
    double value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

static float get_float(const unsigned char *at)
{
    uint32_t bits = (uint32_t)get_bits(at, 4);
    float value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

/* A part of the whole, rounding aside. */
static int is_share(float value)
{
    return value >= 0 && value <= 1.0001f;
}

static pe_status damaged(const char *name, const char *what, pe_error *error)
{
    return pe_fail(error, PE_ERROR_FORMAT, "%s: %s; remove it, and it will be made again", name, what);
}

static pe_status read_header(const unsigned char *bytes, size_t size, const char *name, pe_smoothness *scale,
                             double *threshold, pe_error *error)
{
    uint32_t version;

    if (size < HEADER_BYTES + SUM_BYTES || memcmp(bytes, MAGIC, MAGIC_BYTES) != 0)
        return pe_fail(error, PE_ERROR_FORMAT, "%s: is not a file of weights that prefenv bake --weights wrote", name);
    version = (uint32_t)get_bits(bytes + 8, 4);
    if (version != PE_WEIGHTS_VERSION)
        return pe_fail(error, PE_ERROR_FORMAT, "%s: weights of version %u, not the %d read here; remove it", name,
                       (unsigned)version, PE_WEIGHTS_VERSION);
    if (get_bits(bytes + size - SUM_BYTES, SUM_BYTES) != sum_of(bytes, size - SUM_BYTES))
        return damaged(name, "its sum is wrong, so it is damaged", error);
    *scale = (pe_smoothness){ (int)get_bits(bytes + 12, 4), get_double(bytes + 16), get_double(bytes + 24) };
    *threshold = get_double(bytes + 32);
    if (scale->size <= 0 || pe_smoothness_check(scale, NULL) != PE_OK || scale->window == 0 || scale->levels == 0 ||
        !(*threshold >= 0 && *threshold < 1))
        return damaged(name, "its size, window, levels or threshold cannot be", error);
    return PE_OK;
}

static pe_status check_counts(const pe_weights *w, const unsigned char *bytes, size_t size, const char *name,
                              pe_error *error)
{
    uint64_t voxels = get_bits(bytes + 40, 8), entries = get_bits(bytes + 48, 8);

    if (voxels != w->count || entries > size / ENTRY_BYTES ||
        size != HEADER_BYTES + voxels * VOXEL_BYTES + entries * ENTRY_BYTES + SUM_BYTES)
        return damaged(name, "its length is not that of its table", error);
    return PE_OK;
}

static pe_status read_voxels(pe_weights *w, const unsigned char *at, uint64_t entries, const char *name,
                             pe_error *error)
{
    for (size_t k = 0; k < w->count; k++, at += VOXEL_BYTES) {
        w->first[k + 1] = w->first[k] + get_bits(at, 4);
        w->kept[k] = get_float(at + 4);
        if (!is_share(w->kept[k]))
            return damaged(name, "a voxel keeps more than there is", error);
    }
    if (w->first[w->count] != entries)
        return damaged(name, "its voxels do not share out its entries", error);
    return PE_OK;
}

static pe_status read_entries(pe_weights *w, const unsigned char *at, const char *name, pe_error *error)
{
    size_t entries = (size_t)w->first[w->count];

    w->vertex = malloc((entries ? entries : 1) * sizeof *w->vertex);
    w->weight = malloc((entries ? entries : 1) * sizeof *w->weight);
    if (!w->vertex || !w->weight)
        return pe_fail_memory(error, "a table of weights");
    for (size_t k = 0; k < w->count; k++)
        for (size_t i = w->first[k]; i < w->first[k + 1]; i++, at += ENTRY_BYTES) {
            w->vertex[i] = (uint32_t)get_bits(at, 4);
            w->weight[i] = get_float(at + 4);
            if (w->vertex[i] >= (uint32_t)w->domes[w->voxels[k].dome].count || !is_share(w->weight[i]))
                return damaged(name, "an entry names no vertex or is no weight", error);
        }
    return PE_OK;
}

pe_status pe_weights_read_memory(const void *bytes, size_t size, const char *name, pe_weights **out, pe_error *error)
{
    const unsigned char *at = bytes;
    pe_smoothness scale = { 0 };
    double threshold = 0;
    pe_weights *w = NULL;
    pe_status status = read_header(at, size, name, &scale, &threshold, error);

    if (status == PE_OK)
        status = pe_weights_make_voxels(&scale, threshold, &w, error);
    if (status == PE_OK)
        status = check_counts(w, at, size, name, error);
    if (status == PE_OK)
        status = read_voxels(w, at + HEADER_BYTES, get_bits(at + 48, 8), name, error);
    if (status == PE_OK)
        status = read_entries(w, at + HEADER_BYTES + w->count * VOXEL_BYTES, name, error);
    if (status == PE_OK)
        *out = w;
    else
        pe_weights_free(w);
    return status;
}

pe_status pe_weights_read(const char *path, pe_weights **out, pe_error *error)
{
    unsigned char *bytes;
    size_t size;
    pe_status status = pe_file_read(path, &bytes, &size, error);

    if (status != PE_OK)
        return status;
    status = pe_weights_read_memory(bytes, size, path, out, error);
    free(bytes);
    return status;
}
