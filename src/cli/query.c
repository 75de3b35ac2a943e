/* query.c - see query.h. */
#include "query.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FIELDS_MAX = 10, BRUSH = 3 };

/* The fields of a form without the brush, and all their names. */
static const int fields_of[] = { 6, 7 };
static const char *const names_of[][FIELDS_MAX] = {
    { "nx", "ny", "nz", "ox", "oy", "oz", "dx", "dy", "dz" },
    { "nx", "ny", "nz", "ox", "oy", "oz", "roughness", "dx", "dy", "dz" },
};
static const char *const wanted[] = {
    "six are wanted: nx ny nz ox oy oz, or nine, with the brush direction dx dy dz",
    "seven are wanted: nx ny nz ox oy oz roughness, or ten, with the brush direction dx dy dz",
};

/* All that strtod passes over, but for the line feed: let loose on another it would go on to the next line. */
static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
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

static int refuse_word(const char *field, const char *word, const char *why, char error[QUERY_ERROR_BYTES])
{
    size_t length = word_length(word);

    snprintf(error, QUERY_ERROR_BYTES, "%s is \"%.*s%s\", %s", field, (int)(length > 40 ? 40 : length), word,
             length > 40 ? "..." : "", why);
    return -1;
}

/* Returns how many there are, or -1. */
static int parse_fields(const char *line, query_form form, double values[FIELDS_MAX], char error[QUERY_ERROR_BYTES])
{
    int fields = fields_of[form];
    const char *text = skip_blanks(line);
    int count = 0;

    while (count < fields + BRUSH && *text != '\n') {
        const char *end = decimal_parse(text, &values[count]);

        if (end == text || (*end != '\n' && !is_blank(*end)))
            return refuse_word(names_of[form][count], text, "which is not a number", error);
        if (!isfinite(values[count]))
            return refuse_word(names_of[form][count], text, "which is not finite", error);
        text = skip_blanks(end);
        count++;
    }
    if (*text == '\n' && (count == fields || count == fields + BRUSH))
        return count;
    snprintf(error, QUERY_ERROR_BYTES, "%d values; %s", words_on(line), wanted[form]);
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

/* Zero, with its error, if one of the vectors is zero. */
static int take_vectors(double values[FIELDS_MAX], query_form form, int count, pe_point *point,
                        char error[QUERY_ERROR_BYTES])
{
    static const char *const names[] = { "normal", "direction to the viewer", "brush direction" };
    int fields = fields_of[form];
    double *const vectors[] = { values, values + 3, values + fields };

    for (int i = 0; i < (count > fields ? 3 : 2); i++)
        if (!tame(vectors[i])) {
            snprintf(error, QUERY_ERROR_BYTES, "the %s 0 0 0 has no direction", names[i]);
            return 0;
        }
    memcpy(point->n, values, sizeof point->n);
    memcpy(point->o, values + 3, sizeof point->o);
    point->direction = count > fields ? values + fields : NULL;
    point->roughness = form == QUERY_ROUGHNESS ? values[6] : 0;
    return 1;
}

int query_answer(const char *line, size_t length, query_form form, query_function *function, const void *data,
                 char answer[QUERY_ANSWER_MAX], char error[QUERY_ERROR_BYTES])
{
    double values[FIELDS_MAX] = { 0 }, rgb[3];
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
    count = parse_fields(line, form, values, error);
    if (count < 0 || !take_vectors(values, form, count, &point, error))
        return -1;
    function(&point, data, rgb);
    return format_answer(rgb, answer);
}
