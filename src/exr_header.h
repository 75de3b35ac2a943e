/* exr_header.h - an OpenEXR header looked over before a library allocates what it says. */
#ifndef PE_EXR_HEADER_H
#define PE_EXR_HEADER_H

#include "prefenv.h"

/* Walks the headers of all parts: every attribute must end within the file, windows, tiles and scan lines be of a size
 * that pe_image_read is willing to handle.  What the values mean is left to OpenEXR. */
pe_status pe_exr_check_header(const unsigned char *bytes, size_t size, const char *name, pe_error *error);

#endif
