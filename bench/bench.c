/* bench.c - the library against its rivals, in one process: `bench ENV` prints one JSON object.  See bench/run.sh.
 *
 * A "pair" is a texel of a map and a texel of the environment, both in the hemisphere of the map's normal: of a map of
 * w x h texels and an environment of W x H there are (w h / 2) (W H / 2), whether they are all looked at or not. */
#include "check.h"
#include "naive.h"
#include "prefenv.h"
#include "seconds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define ALPHA 0.1
#define NORMALS 42

/* Seconds; for one thread its own time, which other work on the machine does not stretch. */
static double now(int threads)
{
    return seconds_of(threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC);
}

/* The environment on a smaller grid: each texel the mean of 4 x 4 lookups. */
static pe_env *shrink(const pe_env *env, int width, int height)
{
    float *rgb = malloc((size_t)width * (size_t)height * 3 * sizeof *rgb);
    pe_env *small;
    pe_error error;

    if (rgb == NULL)
        abort();
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double sum[3] = { 0, 0, 0 };

            for (int k = 0; k < 16; k++) {
                int row = 4 * y + k / 4, column = 4 * x + k % 4;
                double direction[3], light[3];

                pe_latlong_direction((column + 0.5) / (4 * width), (row + 0.5) / (4 * height), direction);
                pe_env_lookup(env, direction, light);
                for (int c = 0; c < 3; c++)
                    sum[c] += light[c] / 16;
            }
            for (int c = 0; c < 3; c++)
                rgb[3 * (y * width + x) + c] = (float)sum[c];
        }
    check(pe_env_create(width, height, rgb, &small, &error), &error);
    free(rgb);
    return small;
}

static pe_maps *bake(const pe_env *env, int width, int height, pe_accuracy accuracy, int threads, double *seconds)
{
    pe_bake_options options = { .method = PE_METHOD_REPRESENTATIVE,
                                .surface.ndf = { PE_NDF_BECKMANN, ALPHA, ALPHA, NULL },
                                .normals = NORMALS,
                                .width = width,
                                .height = height,
                                .accuracy = accuracy,
                                .threads = threads };
    pe_maps *maps;
    pe_error error;
    double start = now(threads);

    check(pe_bake(env, &options, &maps, &error), &error);
    *seconds = now(threads) - start;
    return maps;
}

static double pairs(const pe_env *env, double map_texels)
{
    return map_texels / 2 * pe_env_width(env) * pe_env_height(env) / 2;
}

static void texel_direction(const pe_maps_info *info, int texel, double direction[3])
{
    int x = texel % info->width, y = texel / info->width;

    pe_latlong_direction((x + 0.5) / info->width, (y + 0.5) / info->height, direction);
}

/* Some 300 texels of the first map, by the naive loop; the worst relative difference to the maps given. */
static double naive(const pe_env *env, const pe_maps *maps, double *seconds, int *count)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    const float *image = pe_maps_image(maps, 0);
    int texels = info->width * info->height, step = texels / 601 | 1, used = 0;
    float(*o)[3] = malloc(sizeof *o * (size_t)(texels / step + 1)), n[3];
    float(*rgb)[3] = malloc(sizeof *rgb * (size_t)(texels / step + 1)), worst = 0;
    int *which = malloc(sizeof *which * (size_t)(texels / step + 1));
    double normal[3], start;

    if (o == NULL || rgb == NULL || which == NULL)
        abort();
    pe_maps_normal(maps, 0, normal);
    for (int c = 0; c < 3; c++)
        n[c] = (float)normal[c];
    for (int t = 0; t < texels; t += step) {
        double r[3], r_n;

        texel_direction(info, t, r);
        r_n = r[0] * normal[0] + r[1] * normal[1] + r[2] * normal[2];
        if (r_n < 0.15)
            continue;
        for (int c = 0; c < 3; c++)
            o[used][c] = (float)(2 * r_n * normal[c] - r[c]);
        which[used++] = t;
    }
    start = now(1);
    naive_filter(env, ALPHA, n, (const float(*)[3])o, used, rgb);
    *seconds = now(1) - start;
    for (int k = 0; k < used; k++)
        for (int c = 0; c < 3; c++)
            worst = fmaxf(worst, fabsf(rgb[k][c] - image[3 * which[k] + c]) / image[3 * which[k] + c]);
    *count = used;
    free(o);
    free(rgb);
    free(which);
    return (double)worst;
}

/* |a - b| / |b| in the L2 sense, over the texels with |n.r| > 0.15. */
static double relative_l2(const pe_maps *a, const pe_maps *b)
{
    const pe_maps_info *info = pe_maps_get_info(a);
    double difference = 0, reference = 0;

    for (int k = 0; k < info->images; k++) {
        const float *p = pe_maps_image(a, k), *q = pe_maps_image(b, k);
        double n[3];

        pe_maps_normal(a, k, n);
        for (int t = 0; t < info->width * info->height; t++) {
            double r[3];

            texel_direction(info, t, r);
            if (fabs(r[0] * n[0] + r[1] * n[1] + r[2] * n[2]) < 0.15)
                continue;
            for (int c = 0; c < 3; c++) {
                double d = (double)p[3 * t + c] - (double)q[3 * t + c];

                difference += d * d;
                reference += (double)q[3 * t + c] * (double)q[3 * t + c];
            }
        }
    }
    return sqrt(difference / reference);
}

/* ---- lookups ---- */

#define SIDE 512
#define ROUNDS 4

static double uniform(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0 - 0.5;
}

/* Normal and viewer of every pixel of a sphere, row by row, as a renderer asks; or any, one after the other. */
static int make_views(int random, pe_point *points)
{
    unsigned state = 1;
    int count = 0;

    for (int k = 0; k < SIDE * SIDE; k++) {
        int row = k / SIDE;
        double x = (k % SIDE + 0.5) / SIDE * 2 - 1, y = 1 - (row + 0.5) / SIDE * 2, square = x * x + y * y;
        pe_point *p = &points[count];

        *p = (pe_point){ .n = { x, y, -sqrt(fmax(1 - square, 0)) }, .o = { 0, 0, -1 } };
        for (int c = 0; c < 3 && random; c++) {
            p->n[c] = uniform(&state);
            p->o[c] = uniform(&state);
        }
        count += random || square < 0.99;
    }
    return count;
}

/* A second of one core's time. */
static double lookup_rate(const pe_maps *maps, pe_interpolation interpolation, int random)
{
    const pe_sampling sampling = { .interpolation = interpolation };
    pe_point *points = malloc(sizeof *points * SIDE * SIDE);
    double start, sum = 0, seconds;
    int count;

    if (points == NULL)
        abort();
    count = make_views(random, points);
    start = now(1);
    for (int round = 0; round < ROUNDS; round++)
        for (int k = 0; k < count; k++) {
            double rgb[3];

            pe_sample(maps, &sampling, &points[k], rgb);
            sum += rgb[0];
        }
    seconds = now(1) - start;
    free(points);
    return sum > 0 ? ROUNDS * (double)count / seconds : 0;
}

static void print_lookups(const pe_env *env)
{
    const pe_bake_options options = { .surface.ndf = { PE_NDF_BECKMANN, ALPHA, ALPHA, NULL } };
    pe_maps *ours, *paper;
    pe_error error;
    double seconds;

    check(pe_bake(env, &options, &ours, &error), &error);
    paper = bake(env, 400, 200, PE_ACCURACY_FAST, 0, &seconds);
    for (int random = 0; random < 2; random++) {
        const char *views = random ? "random" : "coherent";

        printf("  \"lookups_%s\": %.4g,\n", views, lookup_rate(ours, PE_INTERPOLATION_LINEAR, random));
        printf("  \"paper_lookups_%s\": %.4g,\n", views, lookup_rate(paper, PE_INTERPOLATION_WEIGHTED, random));
    }
    pe_maps_free(ours);
    pe_maps_free(paper);
}

int main(int argc, char **argv)
{
    pe_env *env, *small;
    pe_maps *exact, *fast;
    pe_error error;
    double seconds, exact_seconds, fast_seconds, difference;
    int count;

    if (argc != 2) {
        fprintf(stderr, "Usage: bench ENV\n");
        return 1;
    }
    check(pe_env_read(argv[1], &env, &error), &error);
    small = shrink(env, 400, 200);

    printf("{\n");
    exact = bake(small, 100, 50, PE_ACCURACY_EXACT, 1, &seconds);
    printf("  \"exact_pairs_per_second_one_thread\": %.4g,\n", pairs(small, 100 * 50 * NORMALS) / seconds);
    difference = naive(small, exact, &seconds, &count);
    printf("  \"naive_pairs_per_second_one_thread\": %.4g,\n", pairs(small, 2 * count) / seconds);
    printf("  \"naive_worst_relative_difference\": %.3g,\n", difference);
    pe_maps_free(exact);
    fflush(stdout);

    exact = bake(small, 400, 200, PE_ACCURACY_EXACT, 0, &seconds);
    printf("  \"exact_400x200_from_400x200_seconds\": %.4g,\n", seconds);
    printf("  \"exact_pairs_per_second\": %.4g,\n", pairs(small, 400.0 * 200 * NORMALS) / seconds);
    pe_maps_free(exact);
    fflush(stdout);

    fast = bake(env, 400, 200, PE_ACCURACY_FAST, 0, &seconds);
    printf("  \"fast_400x200_from_%dx%d_seconds\": %.4g,\n", pe_env_width(env), pe_env_height(env), seconds);
    pe_maps_free(fast);
    fflush(stdout);

    print_lookups(env);
    exact = bake(env, 200, 100, PE_ACCURACY_EXACT, 0, &exact_seconds);
    fast = bake(env, 200, 100, PE_ACCURACY_FAST, 0, &fast_seconds);
    printf("  \"exact_200x100_seconds\": %.4g,\n", exact_seconds);
    printf("  \"fast_200x100_seconds\": %.4g,\n", fast_seconds);
    printf("  \"fast_relative_l2\": %.4g,\n", relative_l2(fast, exact));
    printf("  \"fast_own_estimate\": %.4g\n}\n", pe_maps_get_info(fast)->error_estimate);
    pe_maps_free(exact);
    pe_maps_free(fast);
    pe_env_free(small);
    pe_env_free(env);
    return 0;
}
