/* batch.h - environments to maps files, one alone or several together; what they share is made once. */
#ifndef CLI_BATCH_H
#define CLI_BATCH_H

#include "prefenv.h"
#include "progress.h"

/* One environment on its way. */
typedef struct batch_frame {
    char *environment, *output; /* names of files */
    pe_env *env;
    pe_maps *maps;
    int needs_floats; /* where halves were asked for */
    pe_status status; /* of what was done last */
    pe_error error;
} batch_frame;

typedef struct batch {
    /* to be set */
    pe_bake_options options; /* without progress */
    const char *measured;    /* the file of options.surface's table, or NULL */
    pe_pixel_type pixels;
    int quiet;
    int count; /* of files that will be asked for */

    /* what became of it */
    int made, left;
    size_t repairs;        /* texels repaired of the environment read last */
    pe_maps *maps;         /* those made last, or NULL */
    pe_bake_errors errors; /* the greatest estimated so far: what maps record that are not looked at themselves */

    batch_frame frames[PE_FRAMES_MAX]; /* `waiting` of them wait to be made, `baking` are being made */
    int waiting, baking;
    batch_frame baked[PE_FRAMES_MAX]; /* `unwritten` of them wait to be written, while others are being made */
    int unwritten;
    int bakes; /* of several frames, so far */

    pe_baker *baker; /* for the size of the first environment */
    progress bar;
} batch;

/* Reads, bakes, writes one alone; the output's name was checked.  CLI_FAILURE, with its error printed, if something
 * cannot be done. */
int batch_make(batch *b, const char *environment, const char *output);

/* The same of a frame, in the company of others: it may wait for them until batch_flush, and be written while others
 * are being made. */
int batch_add(batch *b, const char *environment, const char *output);
int batch_flush(batch *b);

/* The same, but leaves alone an output that is whole, says of itself what a new one would and is not older than what it
 * is made from. */
int batch_update(batch *b, const char *environment, const char *output);

/* Wipes the progress bar away. */
void batch_end(batch *b);

void batch_free(batch *b); /* frees what it made, not the struct */

#endif
