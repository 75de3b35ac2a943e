/* json.c - see json.h. */
#include "json.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* The length of the UTF-8 sequence at `s` (Unicode 15, table 3-7), 0 if it is none. */
static int sequence_length(const unsigned char *s)
{
    int length = s[0] < 0x80                    ? 1
                 : s[0] >= 0xc2 && s[0] <= 0xdf ? 2
                 : s[0] >= 0xe0 && s[0] <= 0xef ? 3
                 : s[0] >= 0xf0 && s[0] <= 0xf4 ? 4
                                                : 0;

    for (int i = 1; i < length; i++)
        if ((s[i] & 0xc0) != 0x80)
            return 0;
    if ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] > 0x9f) || (s[0] == 0xf0 && s[1] < 0x90) ||
        (s[0] == 0xf4 && s[1] > 0x8f))
        return 0;
    return length;
}

static void print_string(const char *text)
{
    const unsigned char *s = (const unsigned char *)text;

    putchar('"');
    while (*s) {
        int length = sequence_length(s);

        if (length == 0)
            fputs("\\ufffd", stdout);
        else if (*s == '"' || *s == '\\')
            printf("\\%c", *s);
        else if (*s < 0x20 || *s == 0x7f)
            printf("\\u%04x", *s);
        else
            fwrite(s, 1, (size_t)length, stdout);
        s += length ? length : 1;
    }
    putchar('"');
}

/* Comma, new line, indentation and name: what stands before a value. */
static void print_name(json *out, const char *name)
{
    if (out->depth == 0)
        return;
    printf("%s\n%*s", out->members ? "," : "", 2 * out->depth, "");
    print_string(name);
    fputs(": ", stdout);
    out->members++;
}

static void print_number(double value)
{
    if (isfinite(value))
        printf("%.9g", value);
    else
        fputs("null", stdout);
}

void json_open(json *out, const char *name)
{
    print_name(out, name);
    putchar('{');
    out->depth++;
    out->members = 0;
}

void json_close(json *out)
{
    out->depth--;
    printf("\n%*s}", 2 * out->depth, "");
    if (out->depth == 0)
        putchar('\n');
    out->members = 1; /* the object that holds this one has at least this one */
}

void json_text(json *out, const char *name, const char *text)
{
    print_name(out, name);
    print_string(text);
}

void json_integer(json *out, const char *name, long long value)
{
    print_name(out, name);
    printf("%lld", value);
}

void json_number(json *out, const char *name, double value)
{
    print_name(out, name);
    print_number(value);
}

void json_numbers(json *out, const char *name, const double *values, int count)
{
    print_name(out, name);
    putchar('[');
    for (int i = 0; i < count; i++) {
        if (i)
            fputs(", ", stdout);
        print_number(values[i]);
    }
    putchar(']');
}
