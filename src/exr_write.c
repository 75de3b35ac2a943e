/* exr_write.c - parts as an OpenEXR file in memory.
 *
 * OpenEXR's C library writes headers and tables.  What is in the chunks is made here: it deflates with zlib, which
 * takes longer than to bake a frame of a film; libdeflate takes two fifths of the time for smaller files of the same
 * format. */
#include "exr.h"

#include "status.h"

#include <half.h>
#include <libdeflate.h>
#include <openexr.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHUNK_LINES 16 /* of ZIP */
#define DEFLATE_LEVEL 1
#define CHANNELS 3

static const char *const channel_names[CHANNELS] = { "B", "G", "R" }; /* in the order of the file */

/* ---- a stream in memory, and the library's words ---- */

typedef struct output {
    unsigned char *bytes;
    size_t size, room;
    int lacks_memory;
    char message[128]; /* of the first error */
} output;

static int64_t write_bytes(exr_const_context_t context, void *data, const void *from, uint64_t size, uint64_t offset,
                           exr_stream_error_func_ptr_t error)
{
    output *o = data;
    size_t end = (size_t)(offset + size);

    (void)context;
    (void)error;
    if (end > o->room) {
        unsigned char *larger = realloc(o->bytes, 2 * end);

        o->lacks_memory |= !larger;
        if (!larger)
            return -1;
        o->bytes = larger;
        o->room = 2 * end;
    }
    memcpy(o->bytes + offset, from, (size_t)size);
    o->size = end > o->size ? end : o->size;
    return (int64_t)size;
}

static void note_error(exr_const_context_t context, exr_result_t code, const char *message)
{
    void *data = NULL;

    (void)code;
    if (exr_get_user_data(context, &data) == EXR_ERR_SUCCESS && data && !*((output *)data)->message)
        snprintf(((output *)data)->message, sizeof((output *)data)->message, "%s", message);
}

/* ---- headers ---- */

static exr_attr_box2i_t window_of(const pe_exr_part *part)
{
    exr_attr_box2i_t window;

    window.min.x = window.min.y = 0;
    window.max.x = part->width - 1;
    window.max.y = part->height - 1;
    return window;
}

static exr_result_t set_attribute(exr_context_t file, int part, const pe_attribute *a)
{
    exr_attr_v3d_t vector;

    memcpy(&vector, a->vector, sizeof vector);
    switch (a->type) {
    case PE_ATTRIBUTE_INT:
        return exr_attr_set_int(file, part, a->name, a->integer);
    case PE_ATTRIBUTE_DOUBLE:
        return exr_attr_set_double(file, part, a->name, a->number);
    case PE_ATTRIBUTE_VECTOR:
        return exr_attr_set_v3d(file, part, a->name, &vector);
    case PE_ATTRIBUTE_STRING:
        return exr_attr_set_string(file, part, a->name, a->string);
    }
    return EXR_ERR_INVALID_ARGUMENT;
}

/* The display window is the whole file's, that of its first part. */
static exr_result_t add_part(exr_context_t file, const pe_exr_part *part, const pe_exr_part *first, pe_pixel_type type)
{
    const exr_attr_box2i_t data = window_of(part), display = window_of(first);
    exr_attr_v2f_t centre;
    exr_pixel_type_t pixels = type == PE_PIXEL_FLOAT ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF;
    int index = 0;
    exr_result_t result = exr_add_part(file, part->name, EXR_STORAGE_SCANLINE, &index);

    centre.x = centre.y = 0;
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr(file, index, &display, &data, 1, &centre, 1, EXR_LINEORDER_INCREASING_Y,
                                              EXR_COMPRESSION_ZIP);
    for (int c = 0; c < CHANNELS && result == EXR_ERR_SUCCESS; c++)
        result = exr_add_channel(file, index, channel_names[c], pixels, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    for (size_t k = 0; k < part->attribute_count && result == EXR_ERR_SUCCESS; k++)
        result = set_attribute(file, index, &part->attributes[k]);
    return result;
}

/* ---- chunks ---- */

/* Room for one chunk in each of its states. */
typedef struct chunk {
    struct libdeflate_compressor *compressor;
    size_t size;                              /* before it is deflated */
    unsigned char *plain, *parted, *deflated; /* as pixels; made ready; deflated */
} chunk;

static void free_chunk(chunk *c)
{
    libdeflate_free_compressor(c->compressor);
    free(c->plain);
    free(c->parted);
    free(c->deflated);
}

static size_t value_bytes(pe_pixel_type type)
{
    return type == PE_PIXEL_FLOAT ? 4 : 2;
}

static int allocate_chunk(const pe_exr_part *parts, int count, pe_pixel_type type, chunk *c)
{
    size_t most = 0;

    for (int k = 0; k < count; k++) {
        size_t size = (size_t)parts[k].width * CHANNELS * CHUNK_LINES * value_bytes(type);

        most = size > most ? size : most;
    }
    *c = (chunk){ .compressor = libdeflate_alloc_compressor(DEFLATE_LEVEL),
                  .plain = malloc(most + 1),
                  .parted = malloc(most + 1),
                  .deflated = malloc(most + 1) };
    return c->compressor && c->plain && c->parted && c->deflated;
}

static unsigned char *put_half(float value, unsigned char *to)
{
    uint16_t bits = imath_float_to_half(value);

    to[0] = (unsigned char)bits;
    to[1] = (unsigned char)(bits >> 8);
    return to + 2;
}

static unsigned char *put_float(float value, unsigned char *to)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    for (int k = 0; k < 4; k++)
        to[k] = (unsigned char)(bits >> 8 * k);
    return to + 4;
}

/* Lines from `top` on: of each its channels, one after the other. */
static void set_plain(const pe_exr_part *part, int top, int lines, pe_pixel_type type, chunk *c)
{
    unsigned char *to = c->plain;

    for (int y = top; y < top + lines; y++)
        for (int channel = 0; channel < CHANNELS; channel++) {
            const float *from = part->rgb + CHANNELS * (size_t)y * (size_t)part->width + (CHANNELS - 1 - channel);

            for (int x = 0; x < part->width; x++, from += CHANNELS)
                to = type == PE_PIXEL_FLOAT ? put_float(*from, to) : put_half(*from, to);
        }
    c->size = (size_t)(to - c->plain);
}

/* Every other byte, then the rest; and of each its difference from the one before. */
static void set_parted(chunk *c)
{
    size_t half = c->size / 2; /* values have an even number of bytes */
    unsigned char *low = c->deflated, *parted = c->parted;

    for (size_t k = 0; k < half; k++) {
        low[k] = c->plain[2 * k];
        low[half + k] = c->plain[2 * k + 1];
    }
    parted[0] = low[0];
    for (size_t k = 1; k < c->size; k++)
        parted[k] = (unsigned char)(low[k] - low[k - 1] + 128);
}

/* What does not become smaller is stored as it is. */
static exr_result_t write_chunk(exr_context_t file, int part, int top, chunk *c)
{
    size_t deflated;

    set_parted(c);
    deflated = libdeflate_zlib_compress(c->compressor, c->parted, c->size, c->deflated, c->size - 1);
    return deflated ? exr_write_scanline_chunk(file, part, top, c->deflated, deflated)
                    : exr_write_scanline_chunk(file, part, top, c->plain, c->size);
}

static exr_result_t write_part(exr_context_t file, const pe_exr_part *part, int index, pe_pixel_type type, chunk *c)
{
    exr_result_t result = EXR_ERR_SUCCESS;

    for (int top = 0; top < part->height && result == EXR_ERR_SUCCESS; top += CHUNK_LINES) {
        int lines = part->height - top < CHUNK_LINES ? part->height - top : CHUNK_LINES;

        set_plain(part, top, lines, type, c);
        result = write_chunk(file, index, top, c);
    }
    return result;
}

/* ---- the file ---- */

static exr_result_t write_parts(exr_context_t file, const pe_exr_part *parts, int count, pe_pixel_type type, chunk *c)
{
    exr_result_t result = EXR_ERR_SUCCESS;

    for (int k = 0; k < count && result == EXR_ERR_SUCCESS; k++)
        result = add_part(file, &parts[k], &parts[0], type);
    if (result == EXR_ERR_SUCCESS)
        result = exr_write_header(file);
    for (int k = 0; k < count && result == EXR_ERR_SUCCESS; k++)
        result = write_part(file, &parts[k], k, type, c);
    return result;
}

static exr_result_t write_file(const pe_exr_part *parts, int count, pe_pixel_type type, chunk *c, output *o)
{
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t file = NULL;
    exr_result_t result, finished;

    start.error_handler_fn = note_error;
    start.user_data = o;
    start.write_fn = write_bytes;
    result = exr_start_write(&file, "memory", EXR_WRITE_FILE_DIRECTLY, &start);
    if (result != EXR_ERR_SUCCESS)
        return result;
    result = write_parts(file, parts, count, type, c);
    finished = exr_finish(&file); /* writes the tables of offsets */
    return result != EXR_ERR_SUCCESS ? result : finished;
}

pe_status pe_exr_encode(const pe_exr_part *parts, int count, pe_pixel_type type, unsigned char **bytes, size_t *size,
                        pe_error *error)
{
    output o = { .bytes = NULL };
    chunk c;
    int enough = allocate_chunk(parts, count, type, &c);
    exr_result_t result = enough ? write_file(parts, count, type, &c, &o) : EXR_ERR_OUT_OF_MEMORY;

    free_chunk(&c);
    if (result == EXR_ERR_SUCCESS) {
        *bytes = o.bytes;
        *size = o.size;
        return PE_OK;
    }
    free(o.bytes);
    if (result == EXR_ERR_OUT_OF_MEMORY || o.lacks_memory)
        return pe_fail(error, PE_ERROR_MEMORY, "OpenEXR output: not enough memory");
    return pe_fail(error, PE_ERROR_FORMAT, "OpenEXR output: OpenEXR says: %s",
                   *o.message ? o.message : exr_get_default_error_message(result));
}
