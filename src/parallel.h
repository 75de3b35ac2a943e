/* parallel.h - a loop over every processor. */
#ifndef PE_PARALLEL_H
#define PE_PARALLEL_H

#include "prefenv.h"

/* One turn of the loop.  Turns run in any order on any thread, so each must write only what belongs to its index. */
typedef void pe_task(size_t index, void *data);

/* How often and to whom a long loop reports: turns done so far plus `done`, out of `total`.  function may be NULL. */
typedef struct pe_report {
    pe_progress *function;
    void *data;
    double done, total;
} pe_report;

/* Processors this process may run on; at least 1. */
int pe_processors(void);

/* Runs task(0 … count - 1).  threads <= 0: one a processor.  The calling thread works too and alone calls the report,
 * which may be NULL.  Returns PE_OK, or PE_ERROR_CANCELLED when the report asked to stop: turns not yet begun are then
 * left out.  If threads cannot be made, fewer do the work. */
pe_status pe_parallel_for(size_t count, int threads, pe_task *task, void *data, const pe_report *report);

/* A turn that takes memory: 0 if there was not enough. */
typedef int pe_try(size_t index, void *data);

/* The same of such turns.  If any lacked memory: PE_ERROR_MEMORY, and error says for what, as pe_fail_memory does. */
pe_status pe_parallel_try(size_t count, int threads, pe_try *turn, void *data, const pe_report *report,
                          const char *what, pe_error *error);

#endif
