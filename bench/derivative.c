/* derivative.c - what facets and seams look like: `derivative OUT.png MAPS...`.
 *
 * A sphere reflects the environment of each file of maps, for a viewer far away on -z; from left to right one column a
 * file.  Above is the sphere, below the second derivative of its luminance, |d2L/dx2| + |d2L/dy2|, in which an edge of
 * facets or a seam is a bright line.  All columns are scaled alike.
 *
 * The spheres are drawn by the lookup that the renderer calls, in doubles: of the half floats in its OpenEXR files the
 * second derivative would show nothing but the rounding.
 *
 * Of each file it prints the root mean square of that derivative, per square of the radius and relative to the mean
 * luminance, over what faces the viewer: by differences a pixel wide, and a quarter of one.  Where there are no kinks
 * the two are the same; what is flat between kinks has twice as much in the second. */
#include "check.h"
#include "prefenv.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SIDE 320        /* of a panel, in pixels */
#define RADIUS 0.48     /* of the sphere, in panels */
#define FACING 0.3      /* cosine beyond which the sphere counts */
#define WHITE_SHARE 3.0 /* times its root mean square, the first file's derivative is white */
#define MAPS_MAX 8

static const pe_sampling weighted = { .interpolation = PE_INTERPOLATION_WEIGHTED };

/* Lat-long maps are mixed as the paper mixes them. */
static const pe_sampling *sampling_of(const pe_maps *maps)
{
    return pe_maps_get_info(maps)->method == PE_METHOD_REPRESENTATIVE ? &weighted : NULL;
}

/* What is seen at a point of a panel, x and y in pixels: 0 beside the sphere.  Returns the normal's cosine. */
static double look(const pe_maps *maps, double x, double y, double rgb[3])
{
    double u = (x / SIDE - 0.5) / RADIUS, v = (0.5 - y / SIDE) / RADIUS, square = 1 - u * u - v * v;
    pe_point point = { .n = { u, v, -sqrt(fmax(square, 0)) }, .o = { 0, 0, -1 } };

    memset(rgb, 0, 3 * sizeof *rgb);
    if (square > 0)
        pe_sample(maps, sampling_of(maps), &point, rgb);
    return sqrt(fmax(square, 0));
}

static double luminance(const pe_maps *maps, double x, double y)
{
    double rgb[3];

    look(maps, x, y, rgb);
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/* |d2L/dx2| + |d2L/dy2| per square of the radius, by differences `step` pixels wide. */
static double bend(const pe_maps *maps, double x, double y, double step)
{
    double middle = 2 * luminance(maps, x, y), unit = step / (SIDE * RADIUS);
    double along_x = luminance(maps, x - step, y) - middle + luminance(maps, x + step, y);
    double along_y = luminance(maps, x, y - step) - middle + luminance(maps, x, y + step);

    return (fabs(along_x) + fabs(along_y)) / (unit * unit);
}

/* Returns the root mean square of bends over what faces the viewer, relative to the mean luminance there. */
static double measure(const pe_maps *maps, double step, double *mean)
{
    double squares = 0, sum = 0, rgb[3];
    int count = 0;

    for (int k = 0; k < SIDE * SIDE; k++) {
        int row = k / SIDE;
        double x = k % SIDE + 0.5, y = row + 0.5, b;

        if (look(maps, x, y, rgb) < FACING)
            continue;
        b = bend(maps, x, y, step);
        squares += b * b;
        sum += luminance(maps, x, y);
        count++;
    }
    *mean = sum / count;
    return sqrt(squares / count) / *mean;
}

/* The column of one file: white is `white` of the bend. */
static void draw(const pe_maps *maps, double white, const pe_image *picture, int column)
{
    for (int k = 0; k < SIDE * SIDE; k++) {
        int row = k / SIDE;
        size_t at = (size_t)row * (size_t)picture->width + (size_t)(column * SIDE + k % SIDE);
        float *above = picture->rgb + 3 * at, *below = above + 3 * (size_t)SIDE * (size_t)picture->width;
        double x = k % SIDE + 0.5, y = row + 0.5, rgb[3], facing = look(maps, x, y, rgb);
        double b = facing > FACING ? bend(maps, x, y, 1) / white : 0;

        for (int c = 0; c < 3; c++) {
            above[c] = (float)rgb[c];
            below[c] = (float)b;
        }
    }
}

int main(int argc, char **argv)
{
    int columns = argc - 2;
    pe_image picture = { .width = columns * SIDE, .height = 2 * SIDE };
    double white = 0;
    pe_error error;

    if (columns < 1 || columns > MAPS_MAX) {
        fprintf(stderr, "usage: derivative OUT.png MAPS..., at most %d of them\n", MAPS_MAX);
        return 2;
    }
    picture.rgb = calloc(3 * (size_t)picture.width * (size_t)picture.height, sizeof *picture.rgb);
    if (!picture.rgb) {
        fprintf(stderr, "derivative: out of memory\n");
        return 1;
    }
    for (int k = 0; k < columns; k++) {
        double mean, pixel, quarter;
        pe_maps *maps;

        check(pe_maps_read(argv[2 + k], &maps, &error), &error);
        quarter = measure(maps, 0.25, &mean);
        pixel = measure(maps, 1, &mean);
        if (k == 0)
            white = WHITE_SHARE * pixel * mean;
        draw(maps, white, &picture, k);
        printf("%s: second derivative %.1f a pixel wide, %.1f a quarter: %.2f times\n", argv[2 + k], pixel, quarter,
               quarter / pixel);
        pe_maps_free(maps);
    }
    check(pe_image_write_png(argv[1], &picture, &error), &error);
    pe_image_free(&picture);
    return 0;
}
