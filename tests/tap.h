/* tap.h - the few lines of Test Anything Protocol that a C test needs: ok() for each claim, done_testing() at the
 * end. */
#ifndef TAP_H
#define TAP_H

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static int tap_count, tap_failed;

/* One claim, described as printf does.  Returns its truth. */
__attribute__((format(printf, 2, 3), unused)) static int ok(int truth, const char *format, ...)
{
    va_list arguments;

    printf("%sok %d - ", truth ? "" : "not ", ++tap_count);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    putchar('\n');
    fflush(stdout);
    tap_failed += !truth;
    return truth;
}

/* A remark, for the log. */
__attribute__((format(printf, 1, 2), unused)) static void note(const char *format, ...)
{
    va_list arguments;

    fputs("# ", stdout);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    putchar('\n');
}

/* The greater of two differences, the greatest so far being one.  A NaN is greater than any number, and stays: fmax
 * would pass over it, and what came out as no number at all would count as exact. */
__attribute__((unused)) static double worst_of(double a, double b)
{
    return isnan(a) || a >= b ? a : b;
}

/* The lesser of two, likewise. */
__attribute__((unused)) static double least_of(double a, double b)
{
    return isnan(a) || a <= b ? a : b;
}

/* Something the test cannot do without: says so and ends it. */
__attribute__((format(printf, 2, 3), unused)) static void need(int truth, const char *format, ...)
{
    va_list arguments;

    if (truth)
        return;
    fputs("Bail out! ", stdout);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    putchar('\n');
    exit(1);
}

/* The plan, last; main returns it. */
__attribute__((unused)) static int done_testing(void)
{
    printf("1..%d\n", tap_count);
    return tap_failed != 0;
}

#endif
