/* image_png.c - PNG by libpng: 8 and 16 bit, sRGB or the file's own gamma made linear, or the values as they are
 * stored; 8-bit sRGB written. */
#include "image.h"
#include "status.h"

#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* What libpng's callbacks see: bytes to read from or to append to, and where failures go. */
typedef struct stream {
    const unsigned char *at, *end;
    unsigned char *written;
    size_t size, capacity;
    const char *name;
    pe_error *error;
    pe_status status;
} stream;

bool pe_png_detect(const unsigned char *bytes, size_t size)
{
    return size >= 8 && png_sig_cmp(bytes, 0, 8) == 0;
}

static void on_error(png_structp png, png_const_charp message)
{
    stream *s = png_get_error_ptr(png);

    s->status = pe_fail(s->error, PE_ERROR_FORMAT, "%s: libpng says: %s", s->name, message);
    longjmp(png_jmpbuf(png), 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void on_read(png_structp png, png_bytep out, size_t size)
{
    stream *s = png_get_io_ptr(png);

    if ((size_t)(s->end - s->at) < size)
        png_error(png, "the file ends too early");
    memcpy(out, s->at, size);
    s->at += size;
}

/* A table of what each of the 65536 samples means, which serves 8 bits too, since libpng widens those to 16. */
typedef float *make_table(png_structp png, png_infop info);

/* Encoded sample to linear light. */
static float *make_linear_table(png_structp png, png_infop info)
{
    float *table = malloc(65536 * sizeof *table);
    double gamma = 0;
    int intent;
    bool own_gamma = !png_get_sRGB(png, info, &intent) && png_get_gAMA(png, info, &gamma) && gamma > 0 &&
                     fabs(gamma - 1 / 2.2) > 0.005;

    for (int k = 0; table && k < 65536; k++)
        table[k] = (float)(own_gamma ? pow(k / 65535.0, 1 / gamma) : pe_srgb_decode(k / 65535.0));
    return table;
}

/* Sample as it is: 0 to 1. */
static float *make_plain_table(png_structp png, png_infop info)
{
    float *table = malloc(65536 * sizeof *table);

    (void)png;
    (void)info;
    for (int k = 0; table && k < 65536; k++)
        table[k] = (float)(k / 65535.0);
    return table;
}

static void store_row(const png_byte *row, long long y, const float *table, pe_image *image)
{
    for (int x = 0; x < image->width; x++) {
        size_t texel = (size_t)y * (size_t)image->width + (size_t)x;
        const png_byte *in = row + 8 * (size_t)x;

        for (int c = 0; c < 3; c++)
            image->rgb[3 * texel + (size_t)c] = table[in[2 * c] << 8 | in[2 * c + 1]];
        if (image->alpha)
            image->alpha[texel] = (float)((in[6] << 8 | in[7]) / 65535.0);
    }
}

/* What has to be released whether libpng jumps out or not: kept apart from the frame that calls setjmp. */
typedef struct reading {
    stream s;
    png_structp png;
    png_infop info;
    png_bytep *rows;
    make_table *meaning;
    float *table;
} reading;

#define DEFLATE_MOST 1032 /* bytes that one byte of deflated data can stand for: 258 for two bits */

/* So that a few bytes do not claim gigabytes: they are refused before anything is allocated. */
static pe_status check_size(const reading *r, size_t size)
{
    size_t row = 1 + png_get_rowbytes(r->png, r->info), height = png_get_image_height(r->png, r->info);

    if (row <= size * DEFLATE_MOST / height)
        return PE_OK;
    return pe_fail(r->s.error, PE_ERROR_FORMAT,
                   "%s: %zu bytes cannot hold the %u x %zu texels of its header; "
                   "the file is damaged or cut off",
                   r->s.name, size, png_get_image_width(r->png, r->info), height);
}

static pe_status read_rows(reading *r, pe_image *image)
{
    size_t stride, width = (size_t)image->width, height = (size_t)image->height;

    r->table = r->meaning(r->png, r->info);
    stride = 8 * width;
    r->rows = malloc(height * (sizeof *r->rows + stride));
    if (!r->table || !r->rows)
        return pe_fail_memory(r->s.error, "a PNG's rows");
    for (size_t y = 0; y < height; y++)
        r->rows[y] = (png_bytep)(r->rows + height) + y * stride;
    png_read_image(r->png, r->rows);
    png_read_end(r->png, NULL);
    for (size_t y = 0; y < height; y++)
        store_row(r->rows[y], (long long)y, r->table, image);
    return PE_OK;
}

/* Every colour type and depth becomes 16-bit RGBA. */
static pe_status read_png(reading *r, pe_image *image)
{
    size_t size = (size_t)(r->s.end - r->s.at);
    bool alpha;
    pe_status status;

    if (setjmp(png_jmpbuf(r->png)))
        return r->s.status;
    png_set_user_limits(r->png, PE_IMAGE_TEXELS_MAX, PE_IMAGE_TEXELS_MAX);
    png_set_read_fn(r->png, &r->s, on_read);
    png_read_info(r->png, r->info);
    alpha =
        (png_get_color_type(r->png, r->info) & PNG_COLOR_MASK_ALPHA) || png_get_valid(r->png, r->info, PNG_INFO_tRNS);
    status = check_size(r, size);
    if (status != PE_OK)
        return status;
    status = pe_image_allocate(r->s.name, png_get_image_width(r->png, r->info), png_get_image_height(r->png, r->info),
                               alpha, image, r->s.error);
    if (status != PE_OK)
        return status;
    png_set_expand_16(r->png);
    png_set_gray_to_rgb(r->png);
    png_set_add_alpha(r->png, 0xffff, PNG_FILLER_AFTER);
    png_set_interlace_handling(r->png);
    png_read_update_info(r->png, r->info);
    return read_rows(r, image);
}

static pe_status read_bytes(const unsigned char *bytes, size_t size, const char *name, make_table *meaning,
                            pe_image *image, pe_error *error)
{
    reading r = { .s = { .at = bytes, .end = bytes + size, .name = name, .error = error }, .meaning = meaning };
    pe_status status;

    r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r.s, on_error, on_warning);
    r.info = r.png ? png_create_info_struct(r.png) : NULL;
    status = r.info ? read_png(&r, image) : pe_fail_memory(error, "libpng");
    png_destroy_read_struct(&r.png, &r.info, NULL);
    free(r.rows);
    free(r.table);
    if (status != PE_OK)
        pe_image_free(image);
    return status;
}

pe_status pe_png_read(const unsigned char *bytes, size_t size, const char *name, pe_image *image, pe_error *error)
{
    return read_bytes(bytes, size, name, make_linear_table, image, error);
}

pe_status pe_png_read_data(const unsigned char *bytes, size_t size, const char *name, pe_image *image, pe_error *error)
{
    return read_bytes(bytes, size, name, make_plain_table, image, error);
}

static void on_write(png_structp png, png_bytep bytes, size_t size)
{
    stream *s = png_get_io_ptr(png);

    if (s->size + size > s->capacity) {
        size_t capacity = 2 * (s->size + size);
        unsigned char *larger = realloc(s->written, capacity);

        if (!larger) {
            s->status = pe_fail_memory(s->error, "a PNG");
            longjmp(png_jmpbuf(png), 1);
        }
        s->written = larger;
        s->capacity = capacity;
    }
    memcpy(s->written + s->size, bytes, size);
    s->size += size;
}

static void on_flush(png_structp png)
{
    (void)png;
}

static void encode_row(const pe_image *image, int y, png_byte *row)
{
    const float *in = image->rgb + 3 * (size_t)y * (size_t)image->width;

    for (int k = 0; k < 3 * image->width; k++)
        row[k] = (png_byte)(pe_srgb_encode(in[k]) * 255 + 0.5);
}

static pe_status write_png(png_structp png, png_infop info, stream *s, const pe_image *image, png_byte *row)
{
    if (setjmp(png_jmpbuf(png)))
        return s->status;
    png_set_write_fn(png, s, on_write, on_flush);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (int y = 0; y < image->height; y++) {
        encode_row(image, y, row);
        png_write_row(png, row);
    }
    png_write_end(png, info);
    return PE_OK;
}

pe_status pe_image_write_png(const char *path, const pe_image *image, pe_error *error)
{
    stream s = { .name = path, .error = error };
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &s, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    png_byte *row = malloc(3 * (size_t)image->width);
    pe_status status = info && row ? write_png(png, info, &s, image, row) : pe_fail_memory(error, "libpng");

    png_destroy_write_struct(&png, &info);
    free(row);
    if (status == PE_OK)
        status = pe_file_write(path, s.written, s.size, error);
    free(s.written);
    return status;
}
