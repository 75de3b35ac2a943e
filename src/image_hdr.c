/* image_hdr.c - Radiance pictures: flat, old run lengths and new run lengths, in any of the eight orientations.
 *
 * The format is that of Radiance's own manual, "The RADIANCE Picture File Format" (Ward): text header lines, an empty
 * line, a resolution line, then scan lines of shared-exponent RGBE texels. */
#include "image.h"
#include "status.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE_MAX_LENGTH 2048

typedef struct reader {
    const unsigned char *at, *end;
    const char *name;
    pe_error *error;
} reader;

/* How scan lines lie in the picture: "-Y h +X w" is the usual one, rows from the top, texels from the left. */
typedef struct layout {
    long long lines, length; /* scan lines in the file, texels in each */
    bool lines_are_columns, lines_reversed, texels_reversed;
} layout;

bool pe_hdr_detect(const unsigned char *bytes, size_t size)
{
    return (size >= 10 && memcmp(bytes, "#?RADIANCE", 10) == 0) || (size >= 6 && memcmp(bytes, "#?RGBE", 6) == 0);
}

/* The next header line without its end, truncated to the buffer's size; false at the end of the file. */
static bool next_line(reader *in, char line[LINE_MAX_LENGTH])
{
    const unsigned char *newline = memchr(in->at, '\n', (size_t)(in->end - in->at));
    size_t length;

    if (!newline)
        return false;
    length = (size_t)(newline - in->at);
    if (length >= LINE_MAX_LENGTH)
        length = LINE_MAX_LENGTH - 1;
    memcpy(line, in->at, length);
    line[length] = 0;
    if (length && line[length - 1] == '\r')
        line[length - 1] = 0;
    in->at = newline + 1;
    return true;
}

/* Header lines up to the empty one: the format must be RGBE; EXPOSURE and COLORCORR lines multiply. */
static pe_status read_header(reader *in, double scale[3])
{
    char line[LINE_MAX_LENGTH];
    double factor, color[3];

    for (int c = 0; c < 3; c++)
        scale[c] = 1;
    while (next_line(in, line)) {
        if (!*line)
            return PE_OK;
        if (strncmp(line, "FORMAT=", 7) == 0 && strcmp(line + 7, "32-bit_rle_rgbe") != 0)
            return pe_fail(in->error, PE_ERROR_FORMAT, "%s: FORMAT is '%.40s'; only 32-bit_rle_rgbe is read", in->name,
                           line + 7);
        if (sscanf(line, "EXPOSURE=%lf", &factor) == 1 && factor > 0)
            for (int c = 0; c < 3; c++)
                scale[c] /= factor;
        if (sscanf(line, "COLORCORR=%lf %lf %lf", &color[0], &color[1], &color[2]) == 3)
            for (int c = 0; c < 3; c++)
                scale[c] /= color[c] > 0 ? color[c] : 1;
    }
    return pe_fail(in->error, PE_ERROR_FORMAT, "%s: the header has no end", in->name);
}

static pe_status read_layout(reader *in, layout *l)
{
    char line[LINE_MAX_LENGTH] = "", sign[2], axis[2], rest;

    if (!next_line(in, line) ||
        sscanf(line, "%c%c %lld %c%c %lld %c", &sign[0], &axis[0], &l->lines, &sign[1], &axis[1], &l->length, &rest) !=
            6 ||
        !strchr("+-", sign[0]) || !strchr("+-", sign[1]) ||
        !((axis[0] == 'X' && axis[1] == 'Y') || (axis[0] == 'Y' && axis[1] == 'X')))
        return pe_fail(in->error, PE_ERROR_FORMAT, "%s: resolution line '%.40s' is not like '-Y 512 +X 1024'", in->name,
                       line);
    l->lines_are_columns = axis[0] == 'X';
    l->lines_reversed = l->lines_are_columns ? sign[0] == '-' : sign[0] == '+';
    l->texels_reversed = l->lines_are_columns ? sign[1] == '+' : sign[1] == '-';
    return PE_OK;
}

static pe_status truncated(reader *in, long long line)
{
    return pe_fail(in->error, PE_ERROR_FORMAT, "%s: ends within scan line %lld", in->name, line);
}

/* A line whose four components are coded apart: bytes of a run (count > 128) or literals. */
static bool read_new_line(reader *in, unsigned char *rgbe, long long length)
{
    for (int component = 0; component < 4; component++) {
        long long x = 0;

        while (x < length) {
            int count, run;

            if (in->end - in->at < 2)
                return false;
            count = *in->at++;
            run = count > 128;
            count -= run ? 128 : 0;
            if (count == 0 || x + count > length || in->end - in->at < (run ? 1 : count))
                return false;
            for (int k = 0; k < count; k++)
                rgbe[4 * x++ + component] = in->at[run ? 0 : k];
            in->at += run ? 1 : count;
        }
    }
    return true;
}

/* A flat line, in which a texel 1 1 1 n repeats the one before it n times (n << 8 on the second such in a row, ...). */
static bool read_old_line(reader *in, unsigned char *rgbe, long long length)
{
    long long x = 0;
    int shift = 0;

    while (x < length) {
        const unsigned char *texel = in->at;

        if (in->end - in->at < 4)
            return false;
        in->at += 4;
        if (texel[0] == 1 && texel[1] == 1 && texel[2] == 1) {
            long long count = shift < 24 ? (long long)texel[3] << shift : length;

            if (x == 0 || x + count > length)
                return false;
            for (; count > 0; count--, x++)
                memcpy(rgbe + 4 * x, rgbe + 4 * (x - 1), 4);
            shift += 8;
        } else {
            memcpy(rgbe + 4 * x++, texel, 4);
            shift = 0;
        }
    }
    return true;
}

static bool read_line(reader *in, unsigned char *rgbe, long long length)
{
    const unsigned char *at = in->at;

    if (length >= 8 && length < 32768 && in->end - at >= 4 && at[0] == 2 && at[1] == 2 &&
        ((long long)at[2] << 8 | at[3]) == length) {
        in->at += 4;
        return read_new_line(in, rgbe, length);
    }
    return read_old_line(in, rgbe, length);
}

static void store_line(const layout *l, long long line, const unsigned char *rgbe, const double scale[3],
                       pe_image *image)
{
    for (long long k = 0; k < l->length; k++) {
        long long i = l->lines_reversed ? l->lines - 1 - line : line;
        long long j = l->texels_reversed ? l->length - 1 - k : k;
        float *out = image->rgb + 3 * (l->lines_are_columns ? j * image->width + i : i * image->width + j);
        const unsigned char *texel = rgbe + 4 * k;
        double unit = texel[3] ? ldexp(1, texel[3] - (128 + 8)) : 0;

        /* The middle of the mantissa's step, as Radiance and POV-Ray read it. */
        for (int c = 0; c < 3; c++)
            out[c] = (float)((texel[c] + 0.5) * unit * scale[c]);
    }
}

pe_status pe_hdr_read(const unsigned char *bytes, size_t size, const char *name, pe_image *image, pe_error *error)
{
    reader in = { bytes, bytes + size, name, error };
    unsigned char *rgbe;
    double scale[3];
    layout l;
    pe_status status = read_header(&in, scale);

    if (status == PE_OK)
        status = read_layout(&in, &l);
    if (status != PE_OK)
        return status;
    status = pe_image_allocate(name, l.lines_are_columns ? l.lines : l.length, l.lines_are_columns ? l.length : l.lines,
                               false, image, error);
    if (status != PE_OK)
        return status;
    rgbe = malloc((size_t)l.length * 4);
    if (!rgbe)
        status = pe_fail_memory(error, "a scan line");
    for (long long line = 0; status == PE_OK && line < l.lines; line++) {
        if (read_line(&in, rgbe, l.length))
            store_line(&l, line, rgbe, scale, image);
        else
            status = truncated(&in, line);
    }
    free(rgbe);
    if (status != PE_OK)
        pe_image_free(image);
    return status;
}
