/* status.h - how a failure is told, and files read and written whole. */
#ifndef PE_STATUS_H
#define PE_STATUS_H

#include "prefenv.h"

/* Fills error (if not NULL) with the status and one sentence made as printf does, and returns the status. */
pe_status pe_fail(pe_error *error, pe_status status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* PE_ERROR_MEMORY, saying what was too large. */
pe_status pe_fail_memory(pe_error *error, const char *what);

/* The part of a path after the last slash. */
const char *pe_base_name(const char *path);

/* Reads a regular file or a pipe whole, up to PE_FILE_SIZE_MAX bytes.  Release *bytes with free(). */
#define PE_FILE_SIZE_MAX ((size_t)4 << 30)
pe_status pe_file_read(const char *path, unsigned char **bytes, size_t *size, pe_error *error);

/* Writes a file that appears whole or not at all: into a temporary file beside it, flushed to disk, then renamed.
 * A device such as /dev/stdout is written straight. */
pe_status pe_file_write(const char *path, const void *bytes, size_t size, pe_error *error);

#endif
