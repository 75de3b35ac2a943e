/* sphere_rays.c - for the tests that look at what POV-Ray has rendered: normals and view directions of a rendered unit
 * sphere, worked out from the camera alone, and the comparison of a picture with numbers.
 *
 *   sphere_rays rays SIZE DISTANCE CAMERA ENVIRONMENT
 *       One line `nx ny nz ox oy oz` for each pixel that shows the sphere, rows from the top.  The picture has SIZE x
 *       SIZE pixels and this camera:
 *           camera { location -DISTANCE*z direction z right x up y rotate <CAMERA> }
 *       The directions are those in the frame of an environment that was turned by rotate <ENVIRONMENT>.
 *       CAMERA and ENVIRONMENT are written as X,Y,Z in degrees.  Rays that pass the centre by more than 0.98 are left
 *       out.
 *
 *   sphere_rays check IMAGE DISTANCE WORST [MEAN]
 *       Reads `R G B` for the same pixels in the same order and compares them with the picture: exit status 0 if
 *       |difference| <= WORST * max(|wanted|, 1/100 of the largest wanted) everywhere, and <= MEAN times that in the
 *       mean.  Says how far it was.
 *
 *   sphere_rays noise DISTANCE IMAGE...
 *       Reads the same and compares it with the mean of pictures, three or more, that differ by noise alone: t, the
 *       difference over its standard error, which the pictures tell, for each pixel and channel.  Exit status 0 if the
 *       mean of t and that of t^2 are what chance makes of them, within four standard deviations.
 *
 *   sphere_rays chart WIDTH HEIGHT [SUN]
 *       Writes an environment to standard output, as Radiance HDR: smooth, but for a sun that is 2^SUN times as bright
 *       (3 by default, 0 for none).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "prefenv.h"

#define RIM 0.98

static const double pi = 3.14159265358979323846;

/* POV-Ray's rotate: about x, then y, then z, each the left-handed way. */
static void rotate(const double degrees[3], int inverse, double v[3])
{
    for (int k = 0; k < 3; k++) {
        const int axis = inverse ? 2 - k : k;
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        const double angle = (inverse ? -degrees[axis] : degrees[axis]) * pi / 180;
        const double c = cos(angle), s = sin(angle), a = v[i], b = v[j];

        v[i] = a * c - b * s;
        v[j] = a * s + b * c;
    }
}

/* Normal and direction to the viewer where the centre of pixel (x, y) shows the sphere, before the camera is turned; 0
 * if it does not show it. */
static int hit(int size, double distance, int x, int y, double n[3], double o[3])
{
    const double d[3] = { (x + 0.5) / size - 0.5, 0.5 - (y + 0.5) / size, 1 };
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + 1);
    const double along = distance / length; /* to the point of the ray nearest the centre */
    const double miss2 = distance * distance - along * along;

    if (miss2 > RIM * RIM)
        return 0;
    const double t = along - sqrt(1 - miss2);
    for (int i = 0; i < 3; i++) {
        n[i] = t * d[i] / length - (i == 2 ? distance : 0);
        o[i] = -d[i] / length;
    }
    return 1;
}

static int print_rays(int size, double distance, const double camera[3], const double environment[3])
{
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            double n[3], o[3];

            if (!hit(size, distance, x, y, n, o))
                continue;
            rotate(camera, 0, n);
            rotate(camera, 0, o);
            rotate(environment, 1, n);
            rotate(environment, 1, o);
            printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", n[0], n[1], n[2], o[0], o[1], o[2]);
        }
    return 0;
}

/* The colours on standard input; NULL if there are none.  The caller frees them. */
static double *read_colours(size_t *count)
{
    double *colours = NULL, rgb[3];
    size_t room = 0;

    for (*count = 0; scanf("%lf %lf %lf", &rgb[0], &rgb[1], &rgb[2]) == 3; ++*count) {
        if (*count == room) {
            room = 2 * room + 1024;
            double *more = realloc(colours, 3 * room * sizeof *more);
            if (!more) {
                free(colours);
                return NULL;
            }
            colours = more;
        }
        memcpy(colours + 3 * *count, rgb, sizeof rgb);
    }
    return colours;
}

static int compare(const pe_image *image, double distance, const double *wanted, size_t count, double worst_allowed,
                   double mean_allowed)
{
    double largest = 0, worst = 0, sum = 0;
    size_t k = 0;
    int worst_x = 0, worst_y = 0;

    for (size_t i = 0; i < 3 * count; i++)
        largest = fmax(largest, fabs(wanted[i]));
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            const float *got = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
            double n[3], o[3];

            if (!hit(image->width, distance, x, y, n, o) || k++ >= count)
                continue;
            for (size_t i = 0; i < 3; i++) {
                const double here = wanted[3 * (k - 1) + i];
                const double off = fabs(got[i] - here) / fmax(fmax(fabs(here), largest / 100), 1e-9);

                sum += off;
                if (!(off <= worst)) { /* a NaN too */
                    worst = off;
                    worst_x = x;
                    worst_y = y;
                }
            }
        }
    if (k != count || k == 0) {
        fprintf(stderr, "the sphere is seen in %zu pixels, but %zu colours were given\n", k, count);
        return 2;
    }
    const double mean = sum / (3 * (double)count);
    printf("%zu pixels, largest relative difference %.3g at (%d, %d), mean %.3g\n", k, worst, worst_x, worst_y, mean);
    return !(worst <= worst_allowed && mean <= mean_allowed);
}

static int check(const char *path, double distance, double worst_allowed, double mean_allowed)
{
    pe_image image;
    pe_error error;
    size_t count;

    if (pe_image_read(path, &image, &error) != PE_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 2;
    }
    double *wanted = read_colours(&count);
    const int status = compare(&image, distance, wanted, wanted ? count : 0, worst_allowed, mean_allowed);
    free(wanted);
    pe_image_free(&image);
    return status;
}

/* What the pictures say of one number: t of their mean. */
static double t_of(const pe_image *images, int count, size_t at, double wanted)
{
    double sum = 0, squares = 0;

    for (int i = 0; i < count; i++)
        sum += images[i].rgb[at];
    for (int i = 0; i < count; i++)
        squares += (images[i].rgb[at] - sum / count) * (images[i].rgb[at] - sum / count);
    return (sum / count - wanted) / sqrt(fmax(squares, 1e-30) / (count - 1) / count);
}

/* Student's t with `count` - 1 degrees of freedom: the bounds of the means of t and t^2 over `pixels`; a channel is
 * looked at by itself, for the three go together. */
static int compare_noise(const pe_image *images, int count, double distance, const double *wanted, size_t pixels)
{
    const double nu = count - 1, square = nu / (nu - 2);
    const double spread = nu > 4 ? square * sqrt(2 * (nu - 1) / (nu - 4)) : 3 * square;
    const double bound = 4 * sqrt(square / (double)pixels), bound_2 = square + 4 * spread / sqrt((double)pixels);
    double mean[3] = { 0 }, mean_2[3] = { 0 };
    size_t k = 0;
    int failed = 0;

    for (int y = 0; y < images->height; y++)
        for (int x = 0; x < images->width; x++) {
            double n[3], o[3];

            if (!hit(images->width, distance, x, y, n, o) || k++ >= pixels)
                continue;
            for (size_t i = 0; i < 3; i++) {
                const size_t at = 3 * ((size_t)y * (size_t)images->width + (size_t)x) + i;
                const double t = t_of(images, count, at, wanted[3 * (k - 1) + i]);

                mean[i] += t / (double)pixels;
                mean_2[i] += t * t / (double)pixels;
            }
        }
    if (k != pixels || k == 0) {
        fprintf(stderr, "the sphere is seen in %zu pixels, but %zu colours were given\n", k, pixels);
        return 2;
    }
    for (int i = 0; i < 3; i++) {
        failed |= !(fabs(mean[i]) <= bound && mean_2[i] <= bound_2);
        printf("%zu pixels, %d pictures, channel %d: mean t %.3f, at most %.3f; mean t^2 %.3f, at most %.3f\n", k,
               count, i, mean[i], bound, mean_2[i], bound_2);
    }
    return failed;
}

enum { PICTURES = 64 };

static int check_noise(int count, char **paths, double distance)
{
    pe_image images[PICTURES];
    pe_error error;
    size_t pixels;
    int read = 0, status = 2;

    for (; read < count; read++)
        if (pe_image_read(paths[read], &images[read], &error) != PE_OK) {
            fprintf(stderr, "%s\n", error.message);
            break;
        }
    double *wanted = read_colours(&pixels);
    if (read == count)
        status = compare_noise(images, count, distance, wanted, wanted ? pixels : 0);
    free(wanted);
    while (read > 0)
        pe_image_free(&images[--read]);
    return status;
}

static int write_chart(int width, int height, int sun)
{
    printf("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", height, width);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const double u = (x + 0.5) / width, v = (y + 0.5) / height;
            const int in_sun = x * 16 / width == 3 && y * 8 / height == 2;

            /* RGBE with one exponent for all: mantissa / 256 * 2^(exponent - 128) */
            putchar((int)(120 + 90 * sin(2 * pi * u) * sin(pi * v)));
            putchar((int)(128 + 100 * cos(pi * v)));
            putchar((int)(110 + 70 * cos(4 * pi * u) * sin(pi * v)));
            putchar(in_sun ? 128 + sun : 128);
        }
    return ferror(stdout) != 0;
}

static int triple(const char *text, double v[3])
{
    return sscanf(text, "%lf,%lf,%lf", &v[0], &v[1], &v[2]) == 3;
}

int main(int argc, char **argv)
{
    double camera[3], environment[3];

    if (argc == 6 && !strcmp(argv[1], "rays") && triple(argv[4], camera) && triple(argv[5], environment))
        return print_rays(atoi(argv[2]), atof(argv[3]), camera, environment);
    if ((argc == 5 || argc == 6) && !strcmp(argv[1], "check"))
        return check(argv[2], atof(argv[3]), atof(argv[4]), atof(argv[argc - 1]));
    if (argc >= 6 && argc <= 3 + PICTURES && !strcmp(argv[1], "noise"))
        return check_noise(argc - 3, argv + 3, atof(argv[2]));
    if ((argc == 4 || argc == 5) && !strcmp(argv[1], "chart"))
        return write_chart(atoi(argv[2]), atoi(argv[3]), argc == 5 ? atoi(argv[4]) : 3);
    fprintf(stderr, "usage: see the head of sphere_rays.c\n");
    return 2;
}
