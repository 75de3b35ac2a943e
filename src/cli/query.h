/* query.h - one line of input to one line of output. */
#ifndef CLI_QUERY_H
#define CLI_QUERY_H

#include "decimal.h"

#include <stddef.h>

/* Radiance of a surface of normal n towards o, its brush along `direction`, or NULL where the line does not say; all
 * are finite, not zero, of any length. */
typedef void query_function(const double n[3], const double o[3], const double direction[3], const void *data,
                            double rgb[3]);

enum {
    QUERY_LINE_MAX = 1024,                /* bytes of an input line without its end */
    QUERY_LINE_MIN = 12,                  /* bytes of the shortest that has an answer, with its end: "0 0 1 0 0 1" */
    QUERY_ANSWER_MAX = 3 * DECIMAL_BYTES, /* bytes of an answer, with its end */
    QUERY_ERROR_BYTES = 256
};

/* Answers the line at `line`, `length` bytes that a line feed follows.  Returns the bytes written to `answer`, none for
 * a blank line or a comment; -1 if the line is wrong: `error` then says how. */
int query_answer(const char *line, size_t length, query_function *function, const void *data,
                 char answer[QUERY_ANSWER_MAX], char error[QUERY_ERROR_BYTES]);

#endif
