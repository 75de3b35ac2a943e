/* spline.c - see spline.h.  A cubic B-spline's coefficients are its values put through a recursive filter of one pole,
 * forth and back along each row and column: [Unser]. */
#include "spline.h"

#include <math.h>

#define POLE (-0.26794919243112270647) /* sqrt 3 - 2 */

/* What the filter has gathered before the first value: the mirrored picture's, until the pole's powers vanish. */
static double first_sum(const float *line, int count, int step)
{
    double sum = (double)line[0], power = 1;
    int at = 0, forth = 1;

    for (int k = 1; k < 24; k++) {
        if (at + forth < 0 || at + forth >= count)
            forth = -forth;
        at += forth;
        power *= POLE;
        sum += power * (double)line[at * step];
    }
    return sum;
}

static void filter_line(float *line, int count, int step)
{
    double before = first_sum(line, count, step), last;

    line[0] = (float)before;
    for (int k = 1; k < count; k++) {
        before = (double)line[k * step] + POLE * before;
        line[k * step] = (float)before;
    }
    last = POLE / (POLE * POLE - 1) * (before + POLE * (double)line[(count - 2) * step]);
    line[(count - 1) * step] = (float)(6 * last);
    for (int k = count - 2; k >= 0; k--) {
        last = POLE * (last - (double)line[k * step]);
        line[k * step] = (float)(6 * last);
    }
}

void pe_spline_coefficients(float *values, int width, int height, int channels)
{
    for (int y = 0; y < height; y++)
        for (int c = 0; c < channels; c++)
            filter_line(values + y * width * channels + c, width, channels);
    for (int x = 0; x < width * channels; x++)
        filter_line(values + x, height, width * channels);
}
