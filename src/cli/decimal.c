/* decimal.c - see decimal.h.  Both directions take a short cut where it is provably right, and the C library else.
 *
 * Reading: a whole number below 2^53 and a power of ten up to 10^22 are exact in double precision, so one
 * multiplication or division rounds once, correctly.
 *   This work is based on: William D. Clinger, "How to Read Floating Point Numbers Accurately", PLDI 1990.
 * Writing: |v| 10^k, scaled to nine digits before the point, is off by at most one unit in the last place of a number
 * below 10^9, that is by less than 1.2e-7; unless it lies within 1e-6 of the middle between two whole numbers, rounding
 * it gives the nine digits of the exact value.
 */
#include "decimal.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static const double powers[] = { 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };

enum { POWER_MAX = 22, DIGITS_MAX = 18 }; /* 18 digits fit 64 bits */

typedef struct digits {
    uint64_t value;
    int count; /* of digits, without leading zeros */
} digits;

static const char *read_digits(const char *text, digits *number)
{
    for (; *text >= '0' && *text <= '9'; text++) {
        number->value = number->value * 10 + (uint64_t)(*text - '0');
        number->count += number->value != 0;
        if (number->count > DIGITS_MAX)
            return NULL;
    }
    return text;
}

/* "e-3": adds to *exponent; NULL if no digit follows or there are more than three. */
static const char *read_exponent(const char *text, int *exponent)
{
    int negative = *++text == '-', value = 0, length = 0;

    text += *text == '-' || *text == '+';
    for (; *text >= '0' && *text <= '9'; text++, length++) {
        if (length == 3)
            return NULL;
        value = value * 10 + (*text - '0');
    }
    *exponent += negative ? -value : value;
    return length ? text : NULL;
}

static const char *parse_slowly(const char *text, double *value)
{
    char *end;

    *value = strtod(text, &end);
    return end;
}

const char *decimal_parse(const char *text, double *value)
{
    const char *start = text + (*text == '-' || *text == '+'), *c, *point;
    digits number = { 0, 0 };
    int exponent = 0;

    c = read_digits(start, &number);
    if (c && *c == '.') {
        point = c + 1;
        c = read_digits(point, &number);
        exponent = c ? -(int)(c - point) : 0;
        if (c == point && point == start + 1) /* a point alone */
            return parse_slowly(text, value);
    } else if (c == start) {
        return parse_slowly(text, value);
    }
    if (c && (*c == 'e' || *c == 'E'))
        c = read_exponent(c, &exponent);
    if (!c || *c == 'x' || *c == 'X' || number.value >= (uint64_t)1 << 53 || exponent < -POWER_MAX ||
        exponent > POWER_MAX)
        return parse_slowly(text, value);
    *value = exponent < 0 ? (double)number.value / powers[-exponent] : (double)number.value * powers[exponent];
    if (*text == '-')
        *value = -*value;
    return c;
}

static size_t format_slowly(double value, char *text)
{
    return (size_t)snprintf(text, DECIMAL_BYTES, "%.9g", value);
}

/* Writes the nine digits of `digits9` with the point behind the first 1 + exponent, -4 <= exponent <= 8. */
static size_t write_fixed(uint32_t digits9, int exponent, char *text)
{
    char digit[9], *c = text;
    int last = 8, before = exponent < 0 ? 0 : exponent + 1;

    for (int i = 8; i >= 0; i--, digits9 /= 10)
        digit[i] = (char)('0' + digits9 % 10);
    while (last >= before && last > 0 && digit[last] == '0') /* %g leaves out zeros behind the point */
        last--;
    for (int i = 0; i < before; i++)
        *c++ = digit[i];
    if (before == 0)
        *c++ = '0';
    if (last < before)
        return (size_t)(c - text);
    *c++ = '.';
    for (int i = exponent; i < -1; i++)
        *c++ = '0';
    for (int i = before; i <= last; i++)
        *c++ = digit[i];
    return (size_t)(c - text);
}

size_t decimal_format(double value, char text[DECIMAL_BYTES])
{
    double size = fabs(value), scaled, whole;
    int exponent = 0;

    if (!(size >= 1e-4 && size < 1e9)) /* zero, exponents, infinities, NaN */
        return format_slowly(value, text);
    if (size >= 1)
        while (size >= powers[exponent + 1])
            exponent++;
    else
        while (size * powers[-exponent] < 1)
            exponent--;
    scaled = size * powers[8 - exponent];
    whole = floor(scaled + 0.5);
    if (fabs(fabs(scaled - whole) - 0.5) < 1e-6 || whole < 1e8 || whole >= 1e9)
        return format_slowly(value, text);
    if (value > 0)
        return write_fixed((uint32_t)whole, exponent, text);
    *text = '-';
    return 1 + write_fixed((uint32_t)whole, exponent, text + 1);
}
