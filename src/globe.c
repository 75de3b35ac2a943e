/* globe.c - see globe.h.  A great circle over both poles is a column down and the opposite one up: along it, as along a
 * row, the values repeat, and so do the sums of the spline's recursive filter [Unser]. */
#include "globe.h"

#include <string.h>

#define POLE (-0.26794919243112270647) /* sqrt 3 - 2 */
#define REACH 24                       /* its powers vanish */

static void filter_circle(float *line, int count)
{
    double sum = 0, power = 1;

    for (int k = 0; k < REACH; k++) {
        sum += power * (double)line[(count - k % count) % count];
        power *= POLE;
    }
    line[0] = (float)sum;
    for (int k = 1; k < count; k++) {
        sum = (double)line[k] + POLE * sum;
        line[k] = (float)sum;
    }
    sum = 0;
    power = -POLE;
    for (int k = 0; k < REACH; k++) {
        sum += power * (double)line[(count - 1 + k) % count];
        power *= POLE;
    }
    line[count - 1] = (float)(6 * sum);
    for (int k = count - 2; k >= 0; k--) {
        sum = POLE * (sum - (double)line[k]);
        line[k] = (float)(6 * sum);
    }
}

/* A picture within its margins. */
typedef struct sheet {
    int width, height;
    float *values;
} sheet;

/* (x, y) may lie in the margins. */
static float *texel(const sheet *s, int x, int y)
{
    return s->values + 3 * ((y + PE_GLOBE_MARGIN) * (s->width + 2 * PE_GLOBE_MARGIN) + x + PE_GLOBE_MARGIN);
}

/* The texel k of the great circle through column x. */
static float *on_circle(const sheet *s, int x, int k)
{
    return k < s->height ? texel(s, x, k) : texel(s, x + s->width / 2, 2 * s->height - 1 - k);
}

static void filter_columns(const sheet *s, float *line)
{
    for (int x = 0; x < s->width / 2; x++)
        for (int c = 0; c < 3; c++) {
            for (int k = 0; k < 2 * s->height; k++)
                line[k] = on_circle(s, x, k)[c];
            filter_circle(line, 2 * s->height);
            for (int k = 0; k < 2 * s->height; k++)
                on_circle(s, x, k)[c] = line[k];
        }
}

static void filter_rows(const sheet *s, float *line)
{
    for (int y = 0; y < s->height; y++)
        for (int c = 0; c < 3; c++) {
            for (int x = 0; x < s->width; x++)
                line[x] = texel(s, x, y)[c];
            filter_circle(line, s->width);
            for (int x = 0; x < s->width; x++)
                texel(s, x, y)[c] = line[x];
        }
}

static void fill_margins(const sheet *s)
{
    int w = s->width, h = s->height;

    for (int y = 0; y < h; y++)
        for (int k = 1; k <= PE_GLOBE_MARGIN; k++) {
            memcpy(texel(s, -k, y), texel(s, w - k, y), 3 * sizeof(float));
            memcpy(texel(s, w - 1 + k, y), texel(s, k - 1, y), 3 * sizeof(float));
        }
    for (int x = -PE_GLOBE_MARGIN; x < w + PE_GLOBE_MARGIN; x++)
        for (int k = 1; k <= PE_GLOBE_MARGIN; k++) {
            int opposite = (x + w + w / 2) % w;

            memcpy(texel(s, x, -k), texel(s, opposite, k - 1), 3 * sizeof(float));
            memcpy(texel(s, x, h - 1 + k), texel(s, opposite, h - k), 3 * sizeof(float));
        }
}

void pe_globe_coefficients(const float *rgb, int width, int height, float *line, float *coefficients)
{
    const sheet s = { width, height, coefficients };

    for (int y = 0; y < height; y++)
        memcpy(texel(&s, 0, y), rgb + 3 * (size_t)y * (size_t)width, 3 * (size_t)width * sizeof *rgb);
    filter_columns(&s, line);
    filter_rows(&s, line);
    fill_margins(&s);
    coefficients[pe_globe_values(width, height) - 1] = 0;
}
