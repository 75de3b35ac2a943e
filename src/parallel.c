/* parallel.c - a loop over every processor: workers take the next index until none is left. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "parallel.h"

#include "status.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

#define THREADS_MAX 256

typedef struct loop {
    atomic_size_t next, done;
    atomic_bool cancelled;
    size_t count;
    pe_task *task;
    void *data;
} loop;

int pe_processors(void)
{
    cpu_set_t set;

    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return 1;
    return CPU_COUNT(&set) > 0 ? CPU_COUNT(&set) : 1;
}

/* Takes one turn; 0 when none is left. */
static int take_turn(loop *l)
{
    size_t index;

    if (atomic_load(&l->cancelled))
        return 0;
    index = atomic_fetch_add(&l->next, 1);
    if (index >= l->count)
        return 0;
    l->task(index, l->data);
    atomic_fetch_add(&l->done, 1);
    return 1;
}

static void *work(void *data)
{
    while (take_turn(data))
        ;
    return NULL;
}

static void work_and_report(loop *l, const pe_report *report)
{
    while (take_turn(l)) {
        double done = (double)atomic_load(&l->done);

        if (report && report->function && report->function((report->done + done) / report->total, report->data))
            atomic_store(&l->cancelled, 1);
    }
}

pe_status pe_parallel_for(size_t count, int threads, pe_task *task, void *data, const pe_report *report)
{
    loop l = { .count = count, .task = task, .data = data };
    pthread_t workers[THREADS_MAX];
    int started = 0;

    if (threads <= 0)
        threads = pe_processors();
    if (threads > THREADS_MAX)
        threads = THREADS_MAX;
    while (started < threads - 1 && (size_t)started + 1 < count &&
           pthread_create(&workers[started], NULL, work, &l) == 0)
        started++;
    work_and_report(&l, report);
    while (started > 0)
        pthread_join(workers[--started], NULL);
    /* Others may have had the last turns, or the stop been asked for during them. */
    if (report && report->function && !atomic_load(&l.cancelled) &&
        report->function((report->done + (double)count) / report->total, report->data))
        atomic_store(&l.cancelled, 1);
    return atomic_load(&l.cancelled) ? PE_ERROR_CANCELLED : PE_OK;
}

/* ---- turns that may lack memory ---- */

typedef struct tries {
    pe_try *turn;
    void *data;
    atomic_int any_failed;
} tries;

static void run_try(size_t index, void *data)
{
    tries *t = data;

    if (!t->turn(index, t->data))
        atomic_store(&t->any_failed, 1);
}

pe_status pe_parallel_try(size_t count, int threads, pe_try *turn, void *data, const pe_report *report,
                          const char *what, pe_error *error)
{
    tries t = { .turn = turn, .data = data };
    pe_status status = pe_parallel_for(count, threads, run_try, &t, report);

    return status == PE_OK && atomic_load(&t.any_failed) ? pe_fail_memory(error, what) : status;
}
