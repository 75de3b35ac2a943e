/* seconds.h - what a clock of the system says. */
#ifndef BENCH_SECONDS_H
#define BENCH_SECONDS_H

#include <time.h>

/* Of CLOCK_MONOTONIC, or CLOCK_PROCESS_CPUTIME_ID. */
static inline double seconds_of(clockid_t clock)
{
    struct timespec t;

    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
