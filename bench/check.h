/* check.h - a measurement ends with its first error. */
#ifndef BENCH_CHECK_H
#define BENCH_CHECK_H

#include "prefenv.h"

#include <stdio.h>
#include <stdlib.h>

static inline void check(pe_status status, const pe_error *error)
{
    if (status != PE_OK) {
        fprintf(stderr, "bench: %s\n", error->message);
        exit(1);
    }
}

#endif
