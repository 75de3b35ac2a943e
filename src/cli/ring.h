/* ring.h - blocks of lines on their way round: claimed and filled by the reader, taken and computed by any worker,
 * awaited and written in order by the writer, then free for the reader again. */
#ifndef CLI_RING_H
#define CLI_RING_H

#include "query.h"

#include <pthread.h>
#include <stddef.h>

enum {
    BLOCK_BYTES = 1 << 16,
    BLOCK_OUTPUT_BYTES = (BLOCK_BYTES / QUERY_LINE_MIN + 1) * QUERY_ANSWER_MAX,
};

typedef struct block {
    char input[BLOCK_BYTES + 1]; /* whole lines */
    size_t input_size;
    char output[BLOCK_OUTPUT_BYTES];
    size_t output_size;
    unsigned long long lines; /* read from the input, the wrong one among them */
    int failed;               /* the last of them is wrong */
    char error[QUERY_ERROR_BYTES];
    int computed;
} block;

/* Block number i, counted from the first one ever, lies in slot i % count.  written <= taken <= submitted. */
typedef struct ring {
    pthread_mutex_t lock;
    pthread_cond_t freed, filled, done; /* for the reader, the workers, the writer */
    size_t submitted, taken, written, count;
    int finished;     /* nothing more will be submitted */
    int stopped;      /* drop everything */
    int stop_pipe[2]; /* readable once stopped: wakes a reader that waits for input */
    block *blocks;
} ring;

ring *ring_create(size_t count); /* NULL if memory or file descriptors are out */
void ring_destroy(ring *r);      /* NULL is allowed */

/* The reader's: a free block, NULL if all is stopped; hand it on; no more will come. */
block *ring_claim(ring *r);
void ring_submit(ring *r, block *b);
void ring_finish(ring *r);

/* A worker's: the oldest block that nobody has taken, NULL if none will come; give it back computed. */
block *ring_take(ring *r);
void ring_give(ring *r, block *b);

/* The writer's: the next block in order once it is computed, NULL after the last; make it free again. */
block *ring_await(ring *r);
void ring_release(ring *r, block *b);

/* Anybody's: ends everything as soon as the blocks at work are done. */
void ring_stop(ring *r);

#endif
