/* exr_header.c - an OpenEXR header looked over before a library allocates what it says.
 *
 * OpenEXR 3.1 believes sizes: an attribute of 2 GiB in a file of 4 kB is allocated and cleared before the read fails,
 * and tables are made for as many scan lines as the data window claims.  The layout walked here is that of "OpenEXR
 * File Layout" (openexr.com): magic and version, four bytes each; per part a list of attributes - name, type, size,
 * value - ended by an empty name; with several parts an empty header after the last. */
#include "exr_header.h"

#include "status.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define MULTI_PART 0x1000u
#define BLOCK_BYTES_MAX ((uint64_t)1 << 30) /* one block of scan lines, or one tile, decompressed */
#define BLOCK_LINES_MAX 256                 /* of any compression: DWAB's */

typedef struct walker {
    const unsigned char *at, *end;
    const char *name;
    pe_error *error;
} walker;

/* What one part claims. */
typedef struct part {
    int64_t width;        /* of the data window */
    uint64_t texel_bytes; /* of all channels */
    uint64_t tile_texels; /* 0: scan lines */
} part;

static pe_status cut_short(const walker *w)
{
    return pe_fail(w->error, PE_ERROR_FORMAT, "%s: its header is damaged or cut short", w->name);
}

/* The next zero-terminated text, at most 255 characters long; NULL if there is none. */
static const char *next_text(walker *w)
{
    size_t room = (size_t)(w->end - w->at);
    const unsigned char *start = w->at, *stop = memchr(start, 0, room < 256 ? room : 256);

    if (!stop)
        return NULL;
    w->at = stop + 1;
    return (const char *)start;
}

static uint32_t little_endian(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static bool next_integer(walker *w, uint32_t *value)
{
    if (w->end - w->at < 4)
        return false;
    *value = little_endian(w->at);
    w->at += 4;
    return true;
}

static pe_status check_window(const walker *w, const char *attribute, const unsigned char *value, part *p)
{
    int64_t width = (int64_t)(int32_t)little_endian(value + 8) - (int32_t)little_endian(value) + 1;
    int64_t height = (int64_t)(int32_t)little_endian(value + 12) - (int32_t)little_endian(value + 4) + 1;

    if (width < 1 || height < 1)
        return pe_fail(w->error, PE_ERROR_FORMAT, "%s: %s is %lld x %lld, which is no size", w->name, attribute,
                       (long long)width, (long long)height);
    if (width > PE_IMAGE_TEXELS_MAX || height > PE_IMAGE_TEXELS_MAX || width * height > PE_IMAGE_TEXELS_MAX)
        return pe_fail(w->error, PE_ERROR_LIMIT,
                       "%s: %s is %lld x %lld, more than the %u texels read here; scale it down", w->name, attribute,
                       (long long)width, (long long)height, PE_IMAGE_TEXELS_MAX);
    if (strcmp(attribute, "dataWindow") == 0)
        p->width = width;
    return PE_OK;
}

/* A list of name, pixel type (1 is half, others take 4 bytes), 4 bytes, two samplings; ended by an empty name. */
static pe_status check_channels(const walker *w, const unsigned char *value, size_t size, part *p)
{
    walker list = { value, value + size, w->name, w->error };

    p->texel_bytes = 0;
    for (;;) {
        const char *channel = next_text(&list);
        uint32_t type, ignored;

        if (!channel)
            return cut_short(w);
        if (!*channel)
            return PE_OK;
        if (!next_integer(&list, &type) || !next_integer(&list, &ignored) || !next_integer(&list, &ignored) ||
            !next_integer(&list, &ignored))
            return cut_short(w);
        p->texel_bytes += type == 1 ? 2 : 4;
    }
}

/* Texts, each behind its length, fill the value. */
static pe_status check_texts(const walker *w, const unsigned char *value, size_t size)
{
    walker list = { value, value + size, w->name, w->error };

    while (list.at < list.end) {
        uint32_t length;

        if (!next_integer(&list, &length) || length > (size_t)(list.end - list.at))
            return cut_short(w);
        list.at += length;
    }
    return PE_OK;
}

static pe_status check_value(const walker *w, const char *attribute, const char *type, const unsigned char *value,
                             size_t size, part *p)
{
    if (strcmp(type, "box2i") == 0 && size == 16 &&
        (strcmp(attribute, "dataWindow") == 0 || strcmp(attribute, "displayWindow") == 0))
        return check_window(w, attribute, value, p);
    if (strcmp(type, "chlist") == 0 && strcmp(attribute, "channels") == 0)
        return check_channels(w, value, size, p);
    if (strcmp(type, "tiledesc") == 0 && size == 9)
        p->tile_texels = (uint64_t)little_endian(value) * little_endian(value + 4);
    if (strcmp(type, "stringvector") == 0)
        return check_texts(w, value, size);
    if (strcmp(type, "preview") == 0 &&
        (size < 8 || (uint64_t)little_endian(value) * little_endian(value + 4) != (size - 8) / 4))
        return cut_short(w);
    return PE_OK;
}

static pe_status check_blocks(const walker *w, const part *p)
{
    uint64_t texels = p->tile_texels ? p->tile_texels : (uint64_t)p->width * BLOCK_LINES_MAX;

    if (p->texel_bytes && texels > BLOCK_BYTES_MAX / p->texel_bytes)
        return pe_fail(
            w->error, PE_ERROR_LIMIT,
            "%s: its scan lines or tiles hold %llu bytes a texel, more than is read here; keep R, G, B alone", w->name,
            (unsigned long long)p->texel_bytes);
    return PE_OK;
}

/* One part's header; *empty if there was none. */
static pe_status check_part(walker *w, bool *empty)
{
    part p = { 0, 0, 0 };

    for (*empty = true;; *empty = false) {
        const char *attribute = next_text(w), *type;
        uint32_t size;
        pe_status status;

        if (!attribute)
            return cut_short(w);
        if (!*attribute)
            return check_blocks(w, &p);
        type = next_text(w);
        if (!type || !next_integer(w, &size) || size > (size_t)(w->end - w->at))
            return cut_short(w);
        status = check_value(w, attribute, type, w->at, size, &p);
        if (status != PE_OK)
            return status;
        w->at += size;
    }
}

pe_status pe_exr_check_header(const unsigned char *bytes, size_t size, const char *name, pe_error *error)
{
    walker w = { bytes + 8, bytes + size, name, error };
    pe_status status;
    bool several, empty;

    if (size < 8)
        return cut_short(&(walker){ bytes, bytes, name, error });
    several = little_endian(bytes + 4) & MULTI_PART;
    do
        status = check_part(&w, &empty);
    while (status == PE_OK && several && !empty);
    return status;
}
