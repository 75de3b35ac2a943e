/* values.c - the text of an option's value to numbers, checked against the table's range. */
#include "cli.h"
#include "options.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One sentence: which option, what was written, what is wanted. */
__attribute__((format(printf, 4, 5))) static int refuse(const cli_command *command, const cli_option *option,
                                                        const char *text, const char *format, ...)
{
    char wanted[512];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(wanted, sizeof wanted, format, arguments);
    va_end(arguments);
    cli_error(command->name, "--%s %s: %s", option->name, text, wanted);
    return CLI_FAILURE;
}

void cli_describe_range(const cli_option *option, char text[CLI_RANGE_BYTES])
{
    if (option->low == 0 && option->high == 0)
        *text = '\0';
    else if (isinf(option->high))
        snprintf(text, CLI_RANGE_BYTES, "%.10g or more", option->low);
    else
        snprintf(text, CLI_RANGE_BYTES, "%.10g to %.10g", option->low, option->high);
}

/* A value outside the table's range. */
static int refuse_range(const cli_command *command, const cli_option *option, const char *text)
{
    char range[CLI_RANGE_BYTES];

    cli_describe_range(option, range);
    return refuse(command, option, text, "out of range: %s", range);
}

static int in_range(const cli_option *option, double value)
{
    return (option->low == 0 && option->high == 0) || (value >= option->low && value <= option->high);
}

/* Reads the number at *text and steps over it.  Zero if none is there; infinities and NaN count as none. */
static int read_number(const char **text, double *value)
{
    char *end;

    *value = strtod(*text, &end);
    if (end == *text || !isfinite(*value))
        return 0;
    *text = end;
    return 1;
}

/* The same for a number and a unit of length, um if there is none; the value is in um. */
static int read_length(const char **text, double *value)
{
    static const struct {
        const char *name;
        double um;
    } units[] = { { "nm", 1e-3 }, { "um", 1 },   { "\u00b5m", 1 }, { "\u03bcm", 1 },
                  { "mm", 1e3 },  { "cm", 1e4 }, { "m", 1e6 },     { "in", 25400 } };

    if (!read_number(text, value))
        return 0;
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (strncmp(*text, units[i].name, strlen(units[i].name)) == 0) {
            *text += strlen(units[i].name);
            *value *= units[i].um;
            break;
        }
    return isfinite(*value);
}

typedef int read_value(const char **text, double *value);

/* Reads `count` values with `separator` between them.  How many were read, 0 if the text is not that. */
static int read_values(const char *text, read_value *read, char separator, int count, double *values)
{
    for (int i = 0; i < count; i++) {
        if (!read(&text, &values[i]))
            return 0;
        if (*text == '\0')
            return i + 1;
        if (*text++ != separator)
            return 0;
    }
    return 0; /* more than asked for */
}

static int store_integer(const cli_command *command, const cli_option *option, const char *text, int *target)
{
    char *end;
    long value;

    errno = 0;
    value = strtol(text, &end, 10);
    if (end == text || *end)
        return refuse(command, option, text, "a whole number is wanted");
    if (errno || value < INT_MIN || value > INT_MAX || !in_range(option, (double)value))
        return refuse_range(command, option, text);
    *target = (int)value;
    return CLI_SUCCESS;
}

static int store_number(const cli_command *command, const cli_option *option, const char *text, double *target)
{
    double value;

    if (read_values(text, read_number, ',', 1, &value) != 1)
        return refuse(command, option, text, "a number is wanted");
    if (!in_range(option, value))
        return refuse_range(command, option, text);
    *target = value;
    return CLI_SUCCESS;
}

static int store_length(const cli_command *command, const cli_option *option, const char *text, double *target)
{
    double value;

    if (read_values(text, read_length, ',', 1, &value) != 1)
        return refuse(command, option, text, "a length is wanted, as in 1.5um (nm, um, mm, cm, m, in)");
    if (!in_range(option, value))
        return refuse_range(command, option, text);
    *target = value;
    return CLI_SUCCESS;
}

/* One value or two. */
static int store_pair(const cli_command *command, const cli_option *option, const char *text, read_value *read,
                      const char *wanted, double target[2])
{
    double values[2] = { 0, 0 };
    int count = read_values(text, read, ',', 2, values);

    if (count == 0)
        return refuse(command, option, text, "%s", wanted);
    for (int i = 0; i < count; i++)
        if (!in_range(option, values[i]))
            return refuse_range(command, option, text);
    memcpy(target, values, sizeof values);
    return CLI_SUCCESS;
}

/* One length stands for two. */
static int store_lengths(const cli_command *command, const cli_option *option, const char *text, double target[2])
{
    static const char wanted[] = "one length is wanted, or two as in 40um,8um";

    if (store_pair(command, option, text, read_length, wanted, target) != CLI_SUCCESS)
        return CLI_FAILURE;
    if (target[1] == 0)
        target[1] = target[0];
    return CLI_SUCCESS;
}

/* Of one width the second is 0.  A range has a number before its '-', and none of them is below 0. */
static int store_widths(const cli_command *command, const cli_option *option, const char *text, double target[3])
{
    static const char wanted[] = "one number is wanted, two as in 0.1,0.03, or a range as in 0.02-0.5";
    double values[2];

    if (!strpbrk(text, ",") && read_values(text, read_number, '-', 2, values) == 2) {
        if (!in_range(option, values[0]) || !in_range(option, values[1]))
            return refuse_range(command, option, text);
        if (!(values[0] < values[1]))
            return refuse(command, option, text, "a range is from the smaller number to the larger");
        target[0] = values[0];
        target[1] = 0;
        target[2] = values[1];
        return CLI_SUCCESS;
    }
    target[2] = 0;
    return store_pair(command, option, text, read_number, wanted, target);
}

static int store_triple(const cli_command *command, const cli_option *option, const char *text, double target[3])
{
    double values[3];

    if (read_values(text, read_number, ',', 3, values) != 3)
        return refuse(command, option, text, "three numbers are wanted, as in 0,1,0");
    memcpy(target, values, sizeof values);
    return CLI_SUCCESS;
}

static int store_vector(const cli_command *command, const cli_option *option, const char *text, double target[3])
{
    double values[3] = { 0 };

    if (store_triple(command, option, text, values) != CLI_SUCCESS)
        return CLI_FAILURE;
    if (values[0] == 0 && values[1] == 0 && values[2] == 0)
        return refuse(command, option, text, "the zero vector has no direction");
    memcpy(target, values, sizeof values);
    return CLI_SUCCESS;
}

static int store_size(const cli_command *command, const cli_option *option, const char *text, int target[2])
{
    long size[2];
    const char *c = text;
    char *end;

    errno = 0;
    for (int i = 0; i < 2; i++, c = end + 1) {
        size[i] = strtol(c, &end, 10);
        if (i == 0 && end > c && *end == '\0') {
            size[1] = size[0];
            break;
        }
        if (end == c || *end != (i == 0 ? 'x' : '\0'))
            return refuse(command, option, text, "width and height are wanted, as in 400x200");
    }
    for (int i = 0; i < 2; i++)
        if (errno || size[i] < (long)option->low || size[i] > (long)option->high)
            return refuse_range(command, option, text);
    target[0] = (int)size[0];
    target[1] = (int)size[1];
    return CLI_SUCCESS;
}

static int store_choice(const cli_command *command, const cli_option *option, const char *text, int *target)
{
    char list[128] = "";
    size_t used = 0;

    for (const cli_choice *choice = option->choices; choice->name; choice++) {
        if (strcmp(choice->name, text) == 0) {
            *target = choice->value;
            return CLI_SUCCESS;
        }
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", choice->name);
    }
    return refuse(command, option, text, "not known; what there is: %s", list);
}

int cli_store(const cli_command *command, const cli_option *option, const char *text, void *settings)
{
    void *target = (char *)settings + option->offset;

    switch (option->type) {
    case CLI_SWITCH:
        *(int *)target = 1;
        return CLI_SUCCESS;
    case CLI_INTEGER:
        return store_integer(command, option, text, target);
    case CLI_NUMBER:
        return store_number(command, option, text, target);
    case CLI_WIDTHS:
        return store_widths(command, option, text, target);
    case CLI_LENGTH:
        return store_length(command, option, text, target);
    case CLI_LENGTHS:
        return store_lengths(command, option, text, target);
    case CLI_VECTOR:
        return store_vector(command, option, text, target);
    case CLI_TRIPLE:
        return store_triple(command, option, text, target);
    case CLI_SIZE:
        return store_size(command, option, text, target);
    case CLI_CHOICE:
        return store_choice(command, option, text, target);
    case CLI_TEXT:
        *(const char **)target = text;
        return CLI_SUCCESS;
    }
    return CLI_FAILURE;
}
