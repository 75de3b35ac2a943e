/* message.c - errors and warnings of the command, and the check that its output arrived. */
#include "cli.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define MESSAGE_BYTES 1536
#define WORD_BYTES 32

/* File names may hold anything; a message stays on its line. */
static void print_line(const char *command, const char *kind, const char *format, va_list arguments)
{
    char message[MESSAGE_BYTES];

    vsnprintf(message, sizeof message, format, arguments);
    for (char *c = message; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    fflush(stdout);
    if (command)
        fprintf(stderr, "prefenv: %s: %s%s\n", command, kind, message);
    else
        fprintf(stderr, "prefenv: %s%s\n", kind, message);
}

void cli_error(const char *command, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    print_line(command, "", format, arguments);
    va_end(arguments);
}

void cli_warning(const char *command, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    print_line(command, "warning: ", format, arguments);
    va_end(arguments);
}

int cli_flush(const char *command)
{
    if (fflush(stdout) == 0 && !ferror(stdout))
        return CLI_SUCCESS;
    cli_error(command, "cannot write to standard output: %s", strerror(errno ? errno : EIO));
    return CLI_FAILURE;
}

static size_t smallest(size_t a, size_t b, size_t c)
{
    size_t least = a < b ? a : b;

    return least < c ? least : c;
}

/* Levenshtein's distance: letters inserted, left out or changed. */
static size_t distance(const char *a, const char *b)
{
    size_t row[WORD_BYTES + 1], length_b = strlen(b);

    if (strlen(a) > WORD_BYTES || length_b > WORD_BYTES)
        return WORD_BYTES;
    for (size_t j = 0; j <= length_b; j++)
        row[j] = j;
    for (size_t i = 1; a[i - 1]; i++) {
        size_t diagonal = row[0];

        row[0] = i;
        for (size_t j = 1; j <= length_b; j++) {
            size_t changed = diagonal + (a[i - 1] != b[j - 1]);

            diagonal = row[j];
            row[j] = smallest(row[j] + 1, row[j - 1] + 1, changed);
        }
    }
    return row[length_b];
}

const char *cli_nearest(const char *typed, const char *const *words, size_t count)
{
    const char *nearest = NULL;
    size_t least = strlen(typed) < 6 ? 3 : 4; /* further than that is another word, not a slip */

    for (size_t i = 0; i < count; i++) {
        size_t d = distance(typed, words[i]);

        if (d < least && d < strlen(words[i])) {
            least = d;
            nearest = words[i];
        }
    }
    return nearest;
}
