/* frames.c - see frames.h. */
#include "frames.h"

#include "cli.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define DIGITS_MAX 9 /* so that every number fits an int */

/* Reads digits at *text, and moves it past them; -1 if there are none or too many. */
static int take_number(const char **text)
{
    const char *begin = *text;
    int number = 0;

    for (; isdigit((unsigned char)**text); ++*text) {
        if (*text - begin == DIGITS_MAX)
            return -1;
        number = 10 * number + (**text - '0');
    }
    return *text == begin ? -1 : number;
}

/* "A", or "A" `between` "B". */
static int take_pair(const char *text, char between, int *a, int *b)
{
    *a = *b = take_number(&text);
    if (*text == between) {
        text++;
        *b = take_number(&text);
    }
    return *text == '\0' && *a >= 0 && *b >= 0;
}

int frames_parse(const char *command, const char *range, const char *shard, frames *out)
{
    int index = 1, shards = 1;

    if (!take_pair(range, '-', &out->first, &out->last) || out->first > out->last) {
        cli_error(command, "--frames '%s' is not FIRST-LAST, two whole numbers, the first not above the last", range);
        return CLI_FAILURE;
    }
    if (shard && (!strchr(shard, '/') || !take_pair(shard, '/', &index, &shards) || index < 1 || index > shards)) {
        cli_error(command, "--shard '%s' is not I/N, two whole numbers, I from 1 to N", shard);
        return CLI_FAILURE;
    }
    out->first += index - 1;
    out->step = shards;
    return CLI_SUCCESS;
}

int frames_count(const frames *f)
{
    return f->first > f->last ? 0 : (f->last - f->first) / f->step + 1;
}

/* The length of the conversion at `text`, 0 if it is none of ours; *digits: how many it asks for at least. */
static size_t conversion(const char *text, int *digits)
{
    const char *end = text + 1;

    *digits = 1;
    if (*end == '0') {
        end++;
        *digits = *end >= '1' && *end <= '0' + DIGITS_MAX ? *end++ - '0' : -1;
    }
    return *digits > 0 && *end == 'd' ? (size_t)(end + 1 - text) : 0;
}

int frames_check_pattern(const char *command, const char *pattern)
{
    const char *at = pattern;
    int digits, count = 0;

    while ((at = strchr(at, '%'))) {
        size_t length = at[1] == '%' ? 2 : conversion(at, &digits);

        if (!length) {
            cli_error(command, "%s: '%.3s' does not stand for a frame's number; write %%d, or %%04d for four digits",
                      pattern, at);
            return CLI_FAILURE;
        }
        count += at[1] != '%';
        at += length;
    }
    if (count == 1)
        return CLI_SUCCESS;
    cli_error(command, "%s: has %s for the frame's number; with --frames it needs one, such as %%04d", pattern,
              count ? "more than one place" : "no place");
    return CLI_FAILURE;
}

int frames_look_missing(const char *name)
{
    const char *percent = strchr(name, '%');
    struct stat about;
    int digits;

    return percent && conversion(percent, &digits) > 0 && stat(name, &about) != 0;
}

char *frames_name(const char *pattern, int frame)
{
    char *name = malloc(strlen(pattern) + DIGITS_MAX + 1), *to = name;
    int digits;

    while (name && *pattern) {
        size_t length = *pattern == '%' ? conversion(pattern, &digits) : 0;

        if (length) {
            to += sprintf(to, "%0*d", digits, frame);
            pattern += length;
        } else {
            pattern += *pattern == '%'; /* the first of two */
            *to++ = *pattern++;
        }
    }
    if (name)
        *to = '\0';
    return name;
}

/* ---- outputs that are inputs ---- */

/* A frame's input, as the system knows it: links and other spellings of its name are the same file. */
typedef struct source {
    dev_t device;
    ino_t inode;
    int frame;
} source;

static int compare_sources(const void *a, const void *b)
{
    const source *x = a, *y = b;

    if (x->device != y->device)
        return x->device < y->device ? -1 : 1;
    return x->inode < y->inode ? -1 : x->inode > y->inode;
}

/* 0 if the file is not there. */
static int find_file(const char *pattern, int frame, source *out)
{
    char *name = frames_name(pattern, frame);
    struct stat about;
    int found = name && stat(name, &about) == 0 && S_ISREG(about.st_mode);

    free(name);
    if (found)
        *out = (source){ about.st_dev, about.st_ino, frame };
    return found;
}

static void refuse_overwriting(const char *command, const char *inputs, const char *outputs, int frame, int input_frame)
{
    char *input = frames_name(inputs, input_frame), *output = frames_name(outputs, frame);

    cli_error(command, "%s, the output of frame %d, is %s, the input of frame %d; give other names after -o",
              output ? output : outputs, frame, input ? input : inputs, input_frame);
    free(input);
    free(output);
}

int frames_check_overwriting(const char *command, const char *inputs, const char *outputs, const frames *f)
{
    size_t count = 0;
    source *sources = malloc(((size_t)(f->last - f->first) / (size_t)f->step + 1) * sizeof *sources), output;
    const source *met = NULL;

    if (!sources) {
        cli_error(command, "out of memory");
        return CLI_FAILURE;
    }
    for (int frame = f->first; frame <= f->last; frame += f->step)
        count += (size_t)find_file(inputs, frame, &sources[count]);
    qsort(sources, count, sizeof *sources, compare_sources);
    for (int frame = f->first; frame <= f->last && !met; frame += f->step)
        if (find_file(outputs, frame, &output)) {
            met = bsearch(&output, sources, count, sizeof *sources, compare_sources);
            if (met)
                refuse_overwriting(command, inputs, outputs, frame, met->frame);
        }
    free(sources);
    return met ? CLI_FAILURE : CLI_SUCCESS;
}
