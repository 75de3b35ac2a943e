/* rivals.c - how far other ways are from the exact sum over the texels, each from that of its own definition, by one
 * measure: relative L2, |what it gives - exact| / |exact|.  See bench/run.sh.
 *
 *     rivals cube ENV FOLDER ALPHA    cmgen's cube map, FOLDER/{px,nx,py,ny,pz,nz}.exr
 *     rivals baseline ENV MAPS        our baseline map
 *     rivals views ENV MAPS           our maps, and filtered importance sampling, for views of every kind
 *
 * Each prints one JSON object. */
#include "check.h"
#include "fis.h"
#include "prefenv.h"
#include "seconds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TEXELS 1000 /* compared */
#define VIEWS 600

static double now(void)
{
    return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

typedef struct comparison {
    double difference2, exact2;
} comparison;

static void compare(comparison *to, const double got[3], const double exact[3])
{
    for (int c = 0; c < 3; c++) {
        to->difference2 += (got[c] - exact[c]) * (got[c] - exact[c]);
        to->exact2 += exact[c] * exact[c];
    }
}

static double relative_l2(const comparison *c)
{
    return sqrt(c->difference2 / c->exact2);
}

/* ---- cmgen's cube map ---- */

/* What cmgen samples: GGX seen head on, each light weighted by its cosine as well. */
static void exact_of_cmgen(const pe_env *env, double alpha, const double n[3], double rgb[3])
{
    int width = pe_env_width(env), height = pe_env_height(env);
    const float *texel = pe_env_texels(env);
    double sum = 0, light[3] = { 0, 0, 0 };

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++, texel += 3) {
            double w[3], cosine, tan2, weight;

            pe_latlong_direction((x + 0.5) / width, (y + 0.5) / height, w);
            cosine = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
            if (cosine <= 0)
                continue;
            tan2 = (1 - cosine) / (1 + cosine); /* of the half vector */
            weight = (1 + tan2) / (1 + tan2 / (alpha * alpha));
            weight *= weight * cosine * sin(M_PI * (y + 0.5) / height);
            sum += weight;
            for (int c = 0; c < 3; c++)
                light[c] += weight * (double)texel[c];
        }
    for (int c = 0; c < 3; c++)
        rgb[c] = light[c] / sum;
}

/* Face `face` of a cube map as OpenGL has it, s to the right and t down, and the mirroring that cmgen adds. */
static void cube_direction(int face, double s, double t, double n[3])
{
    const double cube[6][3] = {
        { 1, -t, -s }, { -1, -t, s }, { s, 1, t }, { s, -1, -t }, { s, -t, 1 }, { -s, -t, -1 }
    };
    double length = sqrt(1 + s * s + t * t);

    n[0] = -cube[face][2] / length;
    n[1] = cube[face][1] / length;
    n[2] = cube[face][0] / length;
}

static void compare_face(const pe_env *env, const char *folder, int face, double alpha, comparison *result)
{
    static const char *const names[] = { "px", "nx", "py", "ny", "pz", "nz" };
    char path[4096];
    pe_image image;
    pe_error error;
    int step;

    snprintf(path, sizeof path, "%s/%s.exr", folder, names[face]);
    check(pe_image_read(path, &image, &error), &error);
    step = image.width * image.height * 6 / TEXELS | 1;
    for (int k = step / 2; k < image.width * image.height; k += step) {
        int x = k % image.width, y = k / image.width;
        double got[3], exact[3], n[3];

        cube_direction(face, 2 * (x + 0.5) / image.width - 1, 2 * (y + 0.5) / image.height - 1, n);
        exact_of_cmgen(env, alpha, n, exact);
        for (int c = 0; c < 3; c++)
            got[c] = (double)image.rgb[3 * k + c];
        compare(result, got, exact);
    }
    pe_image_free(&image);
}

static void cube(const pe_env *env, const char *folder, const char *alpha)
{
    comparison result = { 0, 0 };

    for (int face = 0; face < 6; face++)
        compare_face(env, folder, face, strtod(alpha, NULL), &result);
    printf("{\n  \"relative_l2\": %.4g\n}\n", relative_l2(&result));
}

/* ---- our baseline map ---- */

static pe_maps *read_maps(const char *path)
{
    pe_maps *maps;
    pe_error error;

    check(pe_maps_read(path, &maps, &error), &error);
    return maps;
}

/* Texels by the golden ratio, so that they do not lie in columns, and fewer near the poles, as in a cube map. */
static void baseline(const pe_env *env, const char *path)
{
    pe_maps *maps = read_maps(path);
    const pe_maps_info *info = pe_maps_get_info(maps);
    comparison result = { 0, 0 };

    for (int k = 0; k < TEXELS; k++) {
        double v = acos(1 - 2 * (k + 0.5) / TEXELS) / M_PI, u = fmod(k * 0.6180339887498949, 1), n[3], got[3], exact[3];
        int x = (int)(u * info->width), y = (int)(v * info->height);

        pe_latlong_direction((x + 0.5) / info->width, (y + 0.5) / info->height, n);
        pe_exact(env, &info->surface, info->direction, n, n, exact);
        for (int c = 0; c < 3; c++)
            got[c] = (double)pe_maps_image(maps, 0)[3 * (y * info->width + x) + c];
        compare(&result, got, exact);
    }
    printf("{\n  \"relative_l2\": %.4g\n}\n", relative_l2(&result));
    pe_maps_free(maps);
}

/* ---- views ---- */

typedef struct view {
    pe_point at;
    double exact[3];
} view;

static void random_direction(double direction[3])
{
    double length;

    do {
        for (int c = 0; c < 3; c++)
            direction[c] = 2.0 * rand() / RAND_MAX - 1;
        length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
    } while (length > 1 || length < 0.1);
    for (int c = 0; c < 3; c++)
        direction[c] /= length;
}

static void make_views(const pe_env *env, const pe_maps_info *info, view views[VIEWS])
{
    srand(1);
    for (int k = 0; k < VIEWS;) {
        view *v = &views[k];

        random_direction(v->at.n);
        random_direction(v->at.o);
        if (v->at.n[0] * v->at.o[0] + v->at.n[1] * v->at.o[1] + v->at.n[2] * v->at.o[2] < 0.15)
            continue;
        pe_exact(env, &info->surface, info->direction, v->at.n, v->at.o, v->exact);
        k++;
    }
}

/* Error and lookups a second of one way: `samples` of filtered importance sampling, or with 0 our maps. */
static void try_views(const fis_pyramid *pyramid, const pe_maps *maps, const view views[VIEWS], int samples,
                      const char *name, const char *comma)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    const double alpha[2] = { info->surface.ndf.alpha_x, info->surface.ndf.alpha_y };
    comparison result = { 0, 0 };
    int rounds = 0;
    double start = now(), seconds;

    do {
        result = (comparison){ 0, 0 };
        for (int k = 0; k < VIEWS; k++) {
            double got[3];

            if (samples)
                fis_reflect(pyramid, alpha, info->direction, samples, views[k].at.n, views[k].at.o, got);
            else
                pe_sample(maps, NULL, &views[k].at, got);
            compare(&result, got, views[k].exact);
        }
        rounds++;
        seconds = now() - start;
    } while (seconds < 0.5);
    printf("  \"%s_relative_l2\": %.4g,\n  \"%s_per_second\": %.4g%s\n", name, relative_l2(&result), name,
           (double)VIEWS * rounds / seconds, comma);
}

static void all_views(const pe_env *env, const char *path)
{
    pe_maps *maps = read_maps(path);
    fis_pyramid *pyramid = fis_pyramid_make(env);
    view *views = calloc(VIEWS, sizeof *views);

    if (views == NULL)
        abort();
    make_views(env, pe_maps_get_info(maps), views);
    printf("{\n");
    try_views(pyramid, maps, views, 0, "maps", ",");
    try_views(pyramid, maps, views, 16, "fis_16", ",");
    try_views(pyramid, maps, views, 32, "fis_32", ",");
    try_views(pyramid, maps, views, 96, "fis_96", "");
    printf("}\n");
    free(views);
    fis_pyramid_free(pyramid);
    pe_maps_free(maps);
}

int main(int argc, char **argv)
{
    pe_env *env;
    pe_error error;

    if (argc < 4 || argc != (strcmp(argv[1], "cube") == 0 ? 5 : 4)) {
        fprintf(stderr, "Usage: rivals cube ENV FOLDER ALPHA | baseline ENV MAPS | views ENV MAPS\n");
        return 1;
    }
    check(pe_env_read(argv[2], &env, &error), &error);
    if (strcmp(argv[1], "cube") == 0)
        cube(env, argv[3], argv[4]);
    else if (strcmp(argv[1], "baseline") == 0)
        baseline(env, argv[3]);
    else
        all_views(env, argv[3]);
    pe_env_free(env);
    return 0;
}
