/* image.c - pictures of any kind: told apart by their first bytes, read, written as PNG. */
#include "image.h"

#include "exr.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>

double pe_srgb_encode(double linear)
{
    if (!(linear > 0))
        return 0;
    if (linear >= 1)
        return 1;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

double pe_srgb_decode(double encoded)
{
    if (!(encoded > 0))
        return 0;
    if (encoded >= 1)
        return 1;
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

pe_status pe_image_allocate(const char *name, long long width, long long height, bool alpha, pe_image *image,
                            pe_error *error)
{
    size_t texels;

    if (width < 1 || height < 1)
        return pe_fail(error, PE_ERROR_FORMAT, "%s: size %lld x %lld is not a picture's", name, width, height);
    if (width > PE_IMAGE_TEXELS_MAX || height > PE_IMAGE_TEXELS_MAX || width * height > PE_IMAGE_TEXELS_MAX)
        return pe_fail(error, PE_ERROR_LIMIT,
                       "%s: size %lld x %lld is more than the %u texels read here; scale it down", name, width, height,
                       PE_IMAGE_TEXELS_MAX);
    texels = (size_t)(width * height);
    *image = (pe_image){ .width = (int)width, .height = (int)height };
    image->rgb = calloc(texels, 3 * sizeof *image->rgb);
    image->alpha = alpha ? calloc(texels, sizeof *image->alpha) : NULL;
    if (!image->rgb || (alpha && !image->alpha)) {
        pe_image_free(image);
        return pe_fail(error, PE_ERROR_MEMORY, "%s: not enough memory for %lld x %lld texels", name, width, height);
    }
    return PE_OK;
}

#define LEVELS 65535.0 /* of 16 bits, and a multiple of those of 1, 2, 4 and 8 */

/* The greatest divisor that two whole numbers share, by Euclid's algorithm; that of 0 and b is b. */
static double common_divisor(double a, double b)
{
    while (b > 0) {
        double rest = fmod(a, b);

        a = b;
        b = rest;
    }
    return a;
}

/* A float in [0, 1] is off its level by 6e-8 at most, and other values soon miss a level by more. */
double pe_image_step(const pe_image *image)
{
    size_t count = 3 * (size_t)image->width * (size_t)image->height;
    double divisor = 0, least = INFINITY, most = -INFINITY;

    for (size_t k = 0; k < count; k++) {
        double value = (double)image->rgb[k], level = nearbyint(fabs(value) * LEVELS), steps;

        if (!isfinite(value))
            continue;
        if (fabs(fabs(value) * LEVELS - level) > 1e-7 * LEVELS)
            return 0;
        least = fmin(least, value);
        most = fmax(most, value);
        steps = divisor > 0 ? level / divisor : 0.5;
        if (fabs(steps - nearbyint(steps)) > 0)
            divisor = common_divisor(level, divisor);
    }
    return most > least ? divisor / LEVELS : 0;
}

void pe_image_free(pe_image *image)
{
    if (!image)
        return;
    free(image->rgb);
    free(image->alpha);
    *image = (pe_image){ 0 };
}

typedef pe_status read_format(const unsigned char *bytes, size_t size, const char *name, pe_image *image,
                              pe_error *error);

static pe_status read_kind(const void *bytes, size_t size, const char *name, read_format *png, pe_image *image,
                           pe_error *error)
{
    if (size == 0)
        return pe_fail(error, PE_ERROR_FORMAT, "%s: is empty", name);
    if (pe_exr_detect(bytes, size))
        return pe_exr_read_image(bytes, size, name, image, error);
    if (pe_hdr_detect(bytes, size))
        return pe_hdr_read(bytes, size, name, image, error);
    if (pe_png_detect(bytes, size))
        return png(bytes, size, name, image, error);
    return pe_fail(error, PE_ERROR_FORMAT, "%s: is neither OpenEXR, Radiance HDR nor PNG", name);
}

static pe_status read_bytes(const void *bytes, size_t size, const char *name, read_format *png, pe_image *image,
                            pe_error *error)
{
    pe_image read = { 0 };
    pe_status status = read_kind(bytes, size, name, png, &read, error);

    if (status == PE_OK)
        *image = read;
    return status;
}

static pe_status read_path(const char *path, read_format *png, pe_image *image, pe_error *error)
{
    unsigned char *bytes;
    size_t size;
    pe_status status = pe_file_read(path, &bytes, &size, error);

    if (status != PE_OK)
        return status;
    status = read_bytes(bytes, size, path, png, image, error);
    free(bytes);
    return status;
}

pe_status pe_image_read_memory(const void *bytes, size_t size, const char *name, pe_image *image, pe_error *error)
{
    return read_bytes(bytes, size, name, pe_png_read, image, error);
}

pe_status pe_image_read(const char *path, pe_image *image, pe_error *error)
{
    return read_path(path, pe_png_read, image, error);
}

pe_status pe_image_read_data_memory(const void *bytes, size_t size, const char *name, pe_image *image, pe_error *error)
{
    return read_bytes(bytes, size, name, pe_png_read_data, image, error);
}

pe_status pe_image_read_data(const char *path, pe_image *image, pe_error *error)
{
    return read_path(path, pe_png_read_data, image, error);
}
