/* exr.h - OpenEXR behind a C interface.
 *
 * Files are read by the C++ library, which decodes every compression (OpenEXRCore 3.1.5, its C sibling, lacks DWAA and
 * DWAB), and parts written by the C library, which takes chunks that are deflated already.  All of it works on bytes in
 * memory; no C++ exception leaves this room. */
#ifndef PE_EXR_H
#define PE_EXR_H

#include "prefenv.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

bool pe_exr_detect(const unsigned char *bytes, size_t size);

/* The first part of a file as a picture: its display window, with zeros where the data window does not reach. */
pe_status pe_exr_read_image(const unsigned char *bytes, size_t size, const char *name, pe_image *image,
                            pe_error *error);

/* ---- files of several parts with attributes ---- */

typedef enum pe_attribute_type {
    PE_ATTRIBUTE_INT,
    PE_ATTRIBUTE_DOUBLE,
    PE_ATTRIBUTE_VECTOR,
    PE_ATTRIBUTE_STRING
} pe_attribute_type;

/* One header attribute: which field counts depends on the type. */
typedef struct pe_attribute {
    const char *name;
    pe_attribute_type type;
    int integer;
    double number;
    double vector[3];
    const char *string;
} pe_attribute;

/* One part to be written: RGB floats, rows from the top. */
typedef struct pe_exr_part {
    const char *name;
    int width, height;
    const float *rgb;
    const pe_attribute *attributes;
    size_t attribute_count;
} pe_exr_part;

/* Encodes parts as OpenEXR (scan lines, ZIP) into memory; release *bytes with free(). */
pe_status pe_exr_encode(const pe_exr_part *parts, int count, pe_pixel_type type, unsigned char **bytes, size_t *size,
                        pe_error *error);

/* The same of one picture without a name, of floats in one channel Y. */
pe_status pe_exr_encode_gray(const float *values, int width, int height, const pe_attribute *attributes,
                             size_t attribute_count, unsigned char **bytes, size_t *size, pe_error *error);

/* An open file of parts.  Strings that it hands out live as long as it. */
typedef struct pe_exr_file pe_exr_file;

pe_status pe_exr_open(const unsigned char *bytes, size_t size, const char *name, pe_exr_file **file, pe_error *error);
void pe_exr_close(pe_exr_file *file);
int pe_exr_part_count(const pe_exr_file *file);
void pe_exr_part_size(const pe_exr_file *file, int part, long long *width, long long *height);

/* Fills the field that attribute->type asks for; false if the part has no such attribute of that type. */
bool pe_exr_get_attribute(const pe_exr_file *file, int part, pe_attribute *attribute);

/* Do these bytes start an OpenEXR file whose first part has such an attribute, which is filled in?  Non-zero if so. */
int pe_exr_carries(const void *bytes, size_t size, pe_attribute *attribute);

/* R, G, B of a whole part into 3 * width * height floats. */
pe_status pe_exr_read_part(const pe_exr_file *file, int part, float *rgb, pe_error *error);

#ifdef __cplusplus
}
#endif

#endif
