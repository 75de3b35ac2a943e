/* image.h - the readers behind pe_image_read: one a format, each from bytes in memory, into a picture of zeros. */
#ifndef PE_IMAGE_H
#define PE_IMAGE_H

#include "prefenv.h"

#include <stdbool.h>

/* Allocates image->rgb (and alpha, if asked for) after checking that the size is one we are willing to handle. */
pe_status pe_image_allocate(const char *name, long long width, long long height, bool alpha, pe_image *image,
                            pe_error *error);

/* The widest step that all colour values are multiples of, and that is itself one of 1/65535, as those of PNGs of any
 * depth and of whole numbers are; 0 if there is none, or but one value. */
double pe_image_step(const pe_image *image);

bool pe_hdr_detect(const unsigned char *bytes, size_t size);
pe_status pe_hdr_read(const unsigned char *bytes, size_t size, const char *name, pe_image *image, pe_error *error);

bool pe_png_detect(const unsigned char *bytes, size_t size);
pe_status pe_png_read(const unsigned char *bytes, size_t size, const char *name, pe_image *image, pe_error *error);
pe_status pe_png_read_data(const unsigned char *bytes, size_t size, const char *name, pe_image *image, pe_error *error);

#endif
