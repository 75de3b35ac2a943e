/* query.h - one line of input to one line of output. */
#ifndef CLI_QUERY_H
#define CLI_QUERY_H

#include "decimal.h"
#include "prefenv.h"

#include <stddef.h>

/* Radiance of a point.  Its vectors are finite, not zero, of any length; direction is NULL where the line does not say
 * where the brush points. */
typedef void query_function(const pe_point *point, const void *data, double rgb[3]);

enum {
    QUERY_LINE_MAX = 1024,                /* bytes of an input line without its end */
    QUERY_LINE_MIN = 12,                  /* bytes of the shortest that has an answer, with its end: "0 0 1 0 0 1" */
    QUERY_ANSWER_MAX = 3 * DECIMAL_BYTES, /* bytes of an answer, with its end */
    QUERY_ERROR_BYTES = 256
};

/* What a line holds: nx ny nz ox oy oz, then a roughness if there are many, then perhaps dx dy dz. */
typedef enum query_form { QUERY_PLAIN, QUERY_ROUGHNESS } query_form;

/* Answers the line at `line`, `length` bytes that a line feed follows.  Returns the bytes written to `answer`, none for
 * a blank line or a comment; -1 if the line is wrong: `error` then says how. */
int query_answer(const char *line, size_t length, query_form form, query_function *function, const void *data,
                 char answer[QUERY_ANSWER_MAX], char error[QUERY_ERROR_BYTES]);

#endif
