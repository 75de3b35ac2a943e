/* lines.c - see lines.h. */
#include "lines.h"
#include "cli.h"
#include "parallel.h"
#include "ring.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { THREADS_MAX = 256 };

typedef struct reader {
    char bytes[BLOCK_BYTES];
    size_t begin, end; /* what has been read and not been handed on */
    int at_end;        /* of the input */
    int error;         /* errno of a read that failed */
} reader;

/* Whole lines that wait at the front, at most lines_per_block; their length in bytes. */
static size_t measure_lines(const reader *in, int lines_per_block)
{
    const char *front = in->bytes + in->begin, *stop = in->bytes + in->end, *c = front;

    for (int i = 0; i < lines_per_block; i++) {
        const char *feed = memchr(c, '\n', (size_t)(stop - c));

        if (!feed)
            break;
        c = feed + 1;
    }
    return (size_t)(c - front);
}

/* Waits for input or for the end of all work, then reads once. */
static void read_more(reader *in, const ring *blocks)
{
    struct pollfd wait[2] = { { STDIN_FILENO, POLLIN, 0 }, { blocks->stop_pipe[0], POLLIN, 0 } };
    ssize_t got;

    memmove(in->bytes, in->bytes + in->begin, in->end - in->begin);
    in->end -= in->begin;
    in->begin = 0;
    do {
        got = 0;
        if (poll(wait, 2, -1) < 0)
            got = -1;
        else if (wait[1].revents)
            in->at_end = 1;
        else
            got = read(STDIN_FILENO, in->bytes + in->end, sizeof in->bytes - in->end);
    } while (got < 0 && (errno == EINTR || errno == EAGAIN));
    if (got < 0)
        in->error = errno;
    if (got <= 0)
        in->at_end = 1;
    else
        in->end += (size_t)got;
}

/* Moves the next lines into `to`; zero at the end of the input.  A last line without its line feed gets one; of a line
 * that is too long so much is handed on that the worker sees it. */
static size_t take_lines(reader *in, const ring *blocks, int lines_per_block, block *to)
{
    size_t size;

    while ((size = measure_lines(in, lines_per_block)) == 0 && in->end - in->begin <= QUERY_LINE_MAX && !in->at_end)
        read_more(in, blocks);
    if (in->error)
        return 0;
    to->input_size = size ? size : in->end - in->begin;
    memcpy(to->input, in->bytes + in->begin, to->input_size);
    in->begin += to->input_size;
    if (size == 0 && to->input_size)
        to->input[to->input_size++] = '\n';
    return to->input_size;
}

static void compute_block(const lines_job *job, block *b)
{
    const char *line = b->input, *stop = b->input + b->input_size;

    b->output_size = 0;
    b->lines = 0;
    b->failed = 0;
    while (line < stop) {
        const char *feed = memchr(line, '\n', (size_t)(stop - line));
        int size = query_answer(line, (size_t)(feed - line), job->form, job->function, job->data,
                                b->output + b->output_size, b->error);

        b->lines++;
        if (size < 0) {
            b->failed = 1;
            return;
        }
        b->output_size += (size_t)size;
        line = feed + 1;
    }
}

typedef struct crew {
    const lines_job *job;
    ring *blocks;
} crew;

static void *work(void *data)
{
    const crew *us = data;
    block *b;

    while ((b = ring_take(us->blocks)) != NULL) {
        compute_block(us->job, b);
        ring_give(us->blocks, b);
    }
    return NULL;
}

static int write_bytes(const char *bytes, size_t size)
{
    while (size) {
        struct pollfd wait = { STDOUT_FILENO, POLLOUT, 0 };
        ssize_t put = write(STDOUT_FILENO, bytes, size);

        if (put < 0 && errno == EAGAIN)
            poll(&wait, 1, -1);
        else if (put < 0 && errno != EINTR)
            return -1;
        if (put > 0) {
            bytes += put;
            size -= (size_t)put;
        }
    }
    return 0;
}

static int write_block(const char *command, const block *b, unsigned long long lines_before)
{
    if (write_bytes(b->output, b->output_size) < 0) {
        cli_error(command, "cannot write to standard output: %s", strerror(errno));
        return CLI_FAILURE;
    }
    if (b->failed) {
        cli_error(command, "line %llu: %s", lines_before + b->lines, b->error);
        return CLI_FAILURE;
    }
    return CLI_SUCCESS;
}

/* Writes the blocks in order until the last one or the first error, which stops everybody. */
static void *write_out(void *data)
{
    const crew *us = data;
    unsigned long long lines = 0;
    block *b;

    while ((b = ring_await(us->blocks)) != NULL) {
        if (write_block(us->job->command, b, lines) != CLI_SUCCESS) {
            ring_stop(us->blocks);
            break;
        }
        lines += b->lines;
        ring_release(us->blocks, b);
    }
    return NULL;
}

static void read_all(const lines_job *job, ring *blocks, reader *in)
{
    block *b;

    while ((b = ring_claim(blocks)) != NULL && take_lines(in, blocks, job->lines_per_block, b))
        ring_submit(blocks, b);
    ring_finish(blocks);
}

/* Starts workers and writer, reads, and waits for them.  Zero if threads cannot be made. */
static int run_crew(crew *us, int workers, reader *in)
{
    pthread_t threads[THREADS_MAX], writer;
    int started = 0;

    if (pthread_create(&writer, NULL, write_out, us) != 0)
        return 0;
    while (started < workers && pthread_create(&threads[started], NULL, work, us) == 0)
        started++;
    if (started)
        read_all(us->job, us->blocks, in);
    else
        ring_stop(us->blocks);
    for (int i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    pthread_join(writer, NULL);
    return started > 0;
}

int lines_run(const lines_job *job)
{
    int workers = job->threads ? job->threads : pe_processors();
    int result = CLI_FAILURE;
    reader *in = calloc(1, sizeof *in);
    ring *blocks;
    crew us = { job, NULL };

    workers = workers > THREADS_MAX ? THREADS_MAX : workers;
    blocks = ring_create(2 * (size_t)workers + 2);
    us.blocks = blocks;
    if (!in || !blocks)
        cli_error(job->command, "out of memory");
    else if (!run_crew(&us, workers, in))
        cli_error(job->command, "cannot start threads; try --threads 1");
    else if (in->error)
        cli_error(job->command, "cannot read standard input: %s", strerror(in->error));
    else if (!blocks->stopped)
        result = CLI_SUCCESS;
    ring_destroy(blocks);
    free(in);
    return result;
}
