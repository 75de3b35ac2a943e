/* decimal.h - numbers from and to text, as strtod and printf("%.9g") do it, only faster. */
#ifndef CLI_DECIMAL_H
#define CLI_DECIMAL_H

#include <stddef.h>

/* Reads the number that starts at `text`, correctly rounded, and returns its end; `text` itself if none is there. */
const char *decimal_parse(const char *text, double *value);

/* Longest text of decimal_format, with the null byte that snprintf leaves: "-1.23456789e-308". */
enum { DECIMAL_BYTES = 17 };

/* Writes the bytes of printf("%.9g") to `text`, not ended, and returns how many. */
size_t decimal_format(double value, char text[DECIMAL_BYTES]);

#endif
