/* test-decimal.c - the command's fast numbers against the C library's: printf("%.9g") byte for byte, strtod bit for
 * bit. */
#include "cli/decimal.h"
#include "tap.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { TRIES = 400000, KINDS = 6 };

static uint64_t state = 88172645463325252u;

/* Marsaglia's xorshift, so that every run tries the same numbers. */
static uint64_t draw(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

/* A number of one of several kinds that matter: any bits, radiances, floats, halfway cases, decimal fractions. */
static double draw_number(int kind)
{
    uint64_t bits = draw();
    double number;

    switch (kind) {
    case 0:
        memcpy(&number, &bits, sizeof number);
        return number;
    case 1:
        return (double)(bits % 2000001) / 1e6 - 1;
    case 2:
        return ldexp((double)(bits >> 11), -53 - (int)(draw() % 20));
    case 3:
        return (double)(float)ldexp((double)(bits >> 40), (int)(draw() % 24) - 24);
    case 4: /* nine digits and a half: a tie, or next to one */
        return ((double)(bits % 1000000000) + 0.5) * pow(10, (int)(draw() % 14) - 14);
    default:
        return (double)(bits % 1000000) * pow(10, (int)(draw() % 12) - 9);
    }
}

static int formats_as_printf(double number)
{
    char text[DECIMAL_BYTES], wanted[64];
    size_t length = decimal_format(number, text);

    if ((size_t)snprintf(wanted, sizeof wanted, "%.9g", number) == length && memcmp(text, wanted, length) == 0)
        return 1;
    note("%%.9g is %s, not %.*s", wanted, (int)length, text);
    return 0;
}

static int parses_as_strtod(const char *text)
{
    double number, wanted;
    char *wanted_end;
    const char *end = decimal_parse(text, &number);

    wanted = strtod(text, &wanted_end);
    if (end == wanted_end && (end == text || isnan(wanted) || memcmp(&number, &wanted, sizeof number) == 0))
        return 1;
    note("\"%s\" is %.17g, not %.17g, and ends after %d bytes", text, wanted, number, (int)(wanted_end - text));
    return 0;
}

static void test_random(void)
{
    int formatted = 0, parsed = 0;

    for (int i = 0; i < TRIES; i++) {
        double number = draw_number(i % KINDS);
        char text[512];

        formatted += formats_as_printf(number);
        switch (draw() % 5) {
        case 0:
            snprintf(text, sizeof text, "%.17g", number);
            break;
        case 1:
            snprintf(text, sizeof text, "%.9g", number);
            break;
        case 2:
            snprintf(text, sizeof text, "%.6f", number);
            break;
        case 3:
            snprintf(text, sizeof text, "%.3e", number);
            break;
        default:
            snprintf(text, sizeof text, "%+.15g", number);
        }
        parsed += parses_as_strtod(text);
    }
    ok(formatted == TRIES, "%d of %d numbers written as printf writes them", formatted, TRIES);
    ok(parsed == TRIES, "%d of %d numbers read as strtod reads them", parsed, TRIES);
}

static void test_corners(void)
{
    static const char *const texts[] = {
        "",      "-",     ".",     "-.",       ".5",        "5.",
        "1e",    "1e+",   "0x10",  "0x",       "1.2.3",     "+3",
        "--3",   "1e5x",  "00012", "1e400",    "1e-400",    "12345678901234567890",
        "-0",    "inf",   "nan",   "infinity", "1e022",     "0.000000000000000000000001",
        "1,2",   "e5",    ".e5",   "1.e5",     "1e0000001", "9007199254740993",
        "1e-22", "3e-23", "1e22",  "1e23",     "1 2",       "9007199254740992e22",
    };
    static const double numbers[] = { 0,   -0.0, 1e-4, 9.9999999949e-5, 9.9999999951e-5,       999999999.4, 999999999.6,
                                      0.5, 1e9,  1e-5, 5e-324,          1.7976931348623157e308 };

    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        ok(parses_as_strtod(texts[i]), "\"%s\" read as strtod reads it", texts[i]);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        ok(formats_as_printf(numbers[i]) && formats_as_printf(-numbers[i]), "%.17g written", numbers[i]);
    ok(formats_as_printf(INFINITY) && formats_as_printf(-INFINITY) && formats_as_printf(NAN), "what is not finite");
}

int main(void)
{
    test_random();
    test_corners();
    return done_testing();
}
