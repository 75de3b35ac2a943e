/* heights.c - height fields: read from pictures, written as OpenEXR.
 *
 * A file of ours says of itself what its texels' distance is: prefenv:pitch, in the unit of its heights. */
#include "exr.h"
#include "image.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>

#define PITCH_ATTRIBUTE "prefenv:pitch"

void pe_heights_free(pe_heights *heights)
{
    if (!heights)
        return;
    free(heights->values);
    *heights = (pe_heights){ 0 };
}

/* ---- read ---- */

int pe_heights_detect(const void *bytes, size_t size)
{
    pe_attribute pitch = { .name = PITCH_ATTRIBUTE, .type = PE_ATTRIBUTE_DOUBLE };

    return pe_exr_carries(bytes, size, &pitch);
}

/* The distance of texels that the file itself states; 0 if it does not. */
static pe_status find_pitch(const unsigned char *bytes, size_t size, const char *name, double *pitch, pe_error *error)
{
    pe_attribute attribute = { .name = PITCH_ATTRIBUTE, .type = PE_ATTRIBUTE_DOUBLE };
    pe_exr_file *file;
    pe_status status;

    *pitch = 0;
    if (!pe_exr_detect(bytes, size))
        return PE_OK;
    status = pe_exr_open(bytes, size, name, &file, error);
    if (status != PE_OK)
        return status;
    if (pe_exr_get_attribute(file, 0, &attribute))
        *pitch = attribute.number;
    pe_exr_close(file);
    if (*pitch != 0 && !(*pitch > 0 && isfinite(*pitch)))
        return pe_fail(error, PE_ERROR_FORMAT, "%s: %s is %g; a distance is wanted", name, PITCH_ATTRIBUTE, *pitch);
    return PE_OK;
}

/* What is not given is as the file says. */
static pe_status find_scale(const char *name, double own_pitch, double *unit, double *pitch, pe_error *error)
{
    if (*unit == 0 && *pitch == 0) {
        if (own_pitch == 0)
            return pe_fail(error, PE_ERROR_ARGUMENT,
                           "%s: does not say its scale; give the height of the value 1 and the pitch of the texels "
                           "(--height 20um --pitch 1.5um), or the one divided by the other (--scale)",
                           name);
        *pitch = own_pitch;
        *unit = 1;
    }
    if (!(*unit > 0 && *pitch > 0 && isfinite(*unit / *pitch)))
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "%s: a height of %g for the value 1 and a pitch of %g are no scale; both are above 0", name,
                       *unit, *pitch);
    return PE_OK;
}

static pe_status check_gray(const pe_image *image, const char *name, pe_error *error)
{
    size_t width = (size_t)image->width, count = width * (size_t)image->height;

    for (size_t k = 0; k < count; k++) {
        const float *c = image->rgb + 3 * k;

        if (c[0] < c[1] || c[0] > c[1] || c[0] < c[2] || c[0] > c[2])
            return pe_fail(error, PE_ERROR_FORMAT,
                           "%s: heights are grey, but texel (%zu, %zu) is %g %g %g; is it a normal map?", name,
                           k % width, k / width, (double)c[0], (double)c[1], (double)c[2]);
    }
    return PE_OK;
}

static pe_status take_heights(const pe_image *image, const char *name, double unit, double pitch, pe_heights *heights,
                              pe_error *error)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    pe_status status = check_gray(image, name, error);
    float *values;

    if (status != PE_OK)
        return status;
    if (image->width < PE_HEIGHTS_SIDE_MIN || image->height < PE_HEIGHTS_SIDE_MIN)
        return pe_fail(error, PE_ERROR_LIMIT, "%s: %d x %d heights are too few; at least %d x %d are wanted", name,
                       image->width, image->height, PE_HEIGHTS_SIDE_MIN, PE_HEIGHTS_SIDE_MIN);
    values = malloc(count * sizeof *values);
    if (!values)
        return pe_fail_memory(error, "heights");
    *heights = (pe_heights){ .width = image->width,
                             .height = image->height,
                             .pitch = pitch,
                             .step = unit * pe_image_step(image),
                             .values = values };
    for (size_t k = 0; k < count; k++)
        values[k] = image->alpha && !(image->alpha[k] > 0.5f) ? NAN : (float)(unit * (double)image->rgb[3 * k]);
    return PE_OK;
}

pe_status pe_heights_read_memory(const void *bytes, size_t size, const char *name, double unit, double pitch,
                                 pe_heights *heights, pe_error *error)
{
    pe_image image;
    double own_pitch;
    pe_status status = pe_image_read_data_memory(bytes, size, name, &image, error);

    if (status != PE_OK)
        return status;
    status = find_pitch(bytes, size, name, &own_pitch, error);
    if (status == PE_OK)
        status = find_scale(name, own_pitch, &unit, &pitch, error);
    if (status == PE_OK)
        status = take_heights(&image, name, unit, pitch, heights, error);
    if (status == PE_OK)
        heights->own_pitch = own_pitch;
    pe_image_free(&image);
    return status;
}

pe_status pe_heights_read(const char *path, double unit, double pitch, pe_heights *heights, pe_error *error)
{
    unsigned char *bytes;
    size_t size;
    pe_status status = pe_file_read(path, &bytes, &size, error);

    if (status != PE_OK)
        return status;
    status = pe_heights_read_memory(bytes, size, path, unit, pitch, heights, error);
    free(bytes);
    return status;
}

/* ---- write ---- */

pe_status pe_heights_write(const pe_heights *heights, const char *path, pe_error *error)
{
    size_t count = (size_t)heights->width * (size_t)heights->height, size;
    pe_attribute pitch = { .name = PITCH_ATTRIBUTE, .type = PE_ATTRIBUTE_DOUBLE, .number = heights->pitch };
    float *rgb = malloc(3 * count * sizeof *rgb);
    pe_exr_part part = { "heights", heights->width, heights->height, rgb, &pitch, 1 };
    unsigned char *bytes;
    pe_status status;

    if (!rgb)
        return pe_fail_memory(error, "heights");
    for (size_t k = 0; k < 3 * count; k++)
        rgb[k] = heights->values[k / 3];
    status = pe_exr_encode(&part, 1, PE_PIXEL_FLOAT, &bytes, &size, error);
    free(rgb);
    if (status != PE_OK)
        return status;
    status = pe_file_write(path, bytes, size, error);
    free(bytes);
    return status;
}
