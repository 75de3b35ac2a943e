/* status.c - how a failure is told. */
#include "status.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

pe_status pe_fail(pe_error *error, pe_status status, const char *format, ...)
{
    va_list arguments;

    if (!error)
        return status;
    error->status = status;
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    return status;
}

pe_status pe_fail_memory(pe_error *error, const char *what)
{
    return pe_fail(error, PE_ERROR_MEMORY, "not enough memory for %s", what);
}

const char *pe_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash ? slash + 1 : path;
}
