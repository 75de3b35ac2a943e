/* query.c - see query.h. */
#include "query.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FIELDS = 6, FIELDS_WITH_BRUSH = 9 };

static const char *const field_names[FIELDS_WITH_BRUSH] = { "nx", "ny", "nz", "ox", "oy", "oz", "dx", "dy", "dz" };

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static const char *skip_blanks(const char *text)
{
    while (is_blank(*text))
        text++;
    return text;
}

/* Bytes of the word at `text`. */
static size_t word_length(const char *text)
{
    size_t length = 0;

    while (text[length] != '\n' && !is_blank(text[length]))
        length++;
    return length;
}

static int words_on(const char *line)
{
    int count = 0;

    for (line = skip_blanks(line); *line != '\n'; line = skip_blanks(line + word_length(line)))
        count++;
    return count;
}

static int refuse_word(int field, const char *word, const char *why, char error[QUERY_ERROR_BYTES])
{
    size_t length = word_length(word);

    snprintf(error, QUERY_ERROR_BYTES, "%s is \"%.*s%s\", %s", field_names[field], (int)(length > 40 ? 40 : length),
             word, length > 40 ? "..." : "", why);
    return -1;
}

/* Returns how many there are, or -1. */
static int parse_fields(const char *line, double values[FIELDS_WITH_BRUSH], char error[QUERY_ERROR_BYTES])
{
    const char *text = skip_blanks(line);
    int count = 0;

    while (count < FIELDS_WITH_BRUSH && *text != '\n') {
        const char *end = decimal_parse(text, &values[count]);

        if (end == text || (*end != '\n' && !is_blank(*end)))
            return refuse_word(count, text, "which is not a number", error);
        if (!isfinite(values[count]))
            return refuse_word(count, text, "which is not finite", error);
        text = skip_blanks(end);
        count++;
    }
    if (*text == '\n' && (count == FIELDS || count == FIELDS_WITH_BRUSH))
        return count;
    snprintf(error, QUERY_ERROR_BYTES,
             "%d values; six are wanted: nx ny nz ox oy oz, or nine, with the brush direction dx dy dz",
             words_on(line));
    return -1;
}

/* Scales a vector whose squared length would leave the range of double by a power of two, which rounds nothing.  Zero
 * if it is the zero vector. */
static int tame(double v[3])
{
    double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    int exponent;

    if (most > 1e-100 && most < 1e100)
        return 1;
    frexp(most, &exponent);
    for (int i = 0; i < 3; i++)
        v[i] = ldexp(v[i], -exponent);
    return most > 0;
}

static int format_answer(const double rgb[3], char *answer)
{
    char *c = answer;

    for (int i = 0; i < 3; i++) {
        c += decimal_format(rgb[i], c);
        *c++ = i < 2 ? ' ' : '\n';
    }
    return (int)(c - answer);
}

int query_answer(const char *line, size_t length, query_function *function, const void *data,
                 char answer[QUERY_ANSWER_MAX], char error[QUERY_ERROR_BYTES])
{
    static const char *const names[] = { "normal", "direction to the viewer", "brush direction" };
    double values[FIELDS_WITH_BRUSH], rgb[3];
    pe_point point = { 0 };
    const char *first;
    int count;

    if (length > QUERY_LINE_MAX) {
        snprintf(error, QUERY_ERROR_BYTES, "longer than %d bytes", QUERY_LINE_MAX);
        return -1;
    }
    first = skip_blanks(line);
    if (*first == '\n' || *first == '#')
        return 0;
    count = parse_fields(line, values, error);
    if (count < 0)
        return -1;
    for (int i = 0; i < 3 && 3 * i < count; i++)
        if (!tame(values + 3 * i)) {
            snprintf(error, QUERY_ERROR_BYTES, "the %s 0 0 0 has no direction", names[i]);
            return -1;
        }
    memcpy(point.n, values, sizeof point.n);
    memcpy(point.o, values + 3, sizeof point.o);
    point.direction = count == FIELDS ? NULL : values + 6;
    function(&point, data, rgb);
    return format_answer(rgb, answer);
}
