/* lines.h - lines "nx ny nz ox oy oz", or with a roughness and "dx dy dz" besides, from standard input, "R G B" a line
 * to standard output, in order.
 *
 * The calling thread reads and cuts the input into blocks of whole lines, workers compute blocks, one thread writes
 * them in order.  A ring of blocks bounds the memory.  Whatever whole lines have arrived are computed at once, so that
 * the command answers at the other end of a pipe.
 */
#ifndef CLI_LINES_H
#define CLI_LINES_H

#include "query.h"

typedef struct lines_job {
    const char *command; /* for messages */
    int threads;         /* 0: one a processor */
    int lines_per_block; /* at most; few where a line takes long */
    query_form form;
    query_function *function;
    const void *data;
} lines_job;

/* Works until the input ends.  The exit code, with the error printed if it is not CLI_SUCCESS. */
int lines_run(const lines_job *job);

#endif
