/* ring.c - see ring.h. */
#include "ring.h"

#include <stdlib.h>
#include <unistd.h>

ring *ring_create(size_t count)
{
    ring *r = calloc(1, sizeof *r);

    if (!r)
        return NULL;
    r->count = count;
    r->blocks = malloc(count * sizeof *r->blocks);
    if (!r->blocks || pipe(r->stop_pipe) != 0) {
        free(r->blocks);
        free(r);
        return NULL;
    }
    pthread_mutex_init(&r->lock, NULL);
    pthread_cond_init(&r->freed, NULL);
    pthread_cond_init(&r->filled, NULL);
    pthread_cond_init(&r->done, NULL);
    return r;
}

void ring_destroy(ring *r)
{
    if (!r)
        return;
    pthread_cond_destroy(&r->done);
    pthread_cond_destroy(&r->filled);
    pthread_cond_destroy(&r->freed);
    pthread_mutex_destroy(&r->lock);
    close(r->stop_pipe[0]);
    close(r->stop_pipe[1]);
    free(r->blocks);
    free(r);
}

block *ring_claim(ring *r)
{
    block *b = NULL;

    pthread_mutex_lock(&r->lock);
    while (!r->stopped && r->submitted - r->written == r->count)
        pthread_cond_wait(&r->freed, &r->lock);
    if (!r->stopped)
        b = &r->blocks[r->submitted % r->count];
    pthread_mutex_unlock(&r->lock);
    return b;
}

void ring_submit(ring *r, block *b)
{
    pthread_mutex_lock(&r->lock);
    b->computed = 0;
    r->submitted++;
    pthread_cond_signal(&r->filled);
    pthread_mutex_unlock(&r->lock);
}

void ring_finish(ring *r)
{
    pthread_mutex_lock(&r->lock);
    r->finished = 1;
    pthread_cond_broadcast(&r->filled);
    pthread_cond_signal(&r->done);
    pthread_mutex_unlock(&r->lock);
}

block *ring_take(ring *r)
{
    block *b = NULL;

    pthread_mutex_lock(&r->lock);
    while (!r->stopped && r->taken == r->submitted && !r->finished)
        pthread_cond_wait(&r->filled, &r->lock);
    if (!r->stopped && r->taken < r->submitted)
        b = &r->blocks[r->taken++ % r->count];
    pthread_mutex_unlock(&r->lock);
    return b;
}

void ring_give(ring *r, block *b)
{
    pthread_mutex_lock(&r->lock);
    b->computed = 1;
    pthread_cond_signal(&r->done);
    pthread_mutex_unlock(&r->lock);
}

/* Is the writer to wait?  Under the lock. */
static int is_pending(const ring *r)
{
    if (r->stopped)
        return 0;
    if (r->written == r->submitted)
        return !r->finished;
    return !r->blocks[r->written % r->count].computed;
}

block *ring_await(ring *r)
{
    block *b = NULL;

    pthread_mutex_lock(&r->lock);
    while (is_pending(r))
        pthread_cond_wait(&r->done, &r->lock);
    if (!r->stopped && r->written < r->submitted)
        b = &r->blocks[r->written % r->count];
    pthread_mutex_unlock(&r->lock);
    return b;
}

void ring_release(ring *r, block *b)
{
    pthread_mutex_lock(&r->lock);
    b->computed = 0;
    r->written++;
    pthread_cond_signal(&r->freed);
    pthread_mutex_unlock(&r->lock);
}

void ring_stop(ring *r)
{
    pthread_mutex_lock(&r->lock);
    r->stopped = 1;
    pthread_cond_broadcast(&r->filled);
    pthread_cond_signal(&r->freed);
    pthread_cond_signal(&r->done);
    pthread_mutex_unlock(&r->lock);
    close(r->stop_pipe[1]); /* the other end reads as ended: poll sees it */
    r->stop_pipe[1] = -1;
}
