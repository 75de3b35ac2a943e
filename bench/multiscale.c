/* multiscale.c - [Okumura Tables 2, 3 and 4] and section 3.3 again, the paper's numbers beside ours: `multiscale ENV`.
 *
 * The environments are the paper's in kind: (a) hue along x and saturation along y, (b) a panorama, ENV, as a camera
 * of 8 bits would have seen it; both 512 x 256, values in steps of 1/255 taken for radiance.  Errors are in 256
 * levels, the mean of the three channels. */
#include "check.h"
#include "prefenv.h"
#include "seconds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH 512
#define HEIGHT 256
#define SIZE 128

typedef struct times {
    double wall, processor;
} times;

static times now(void)
{
    return (times){ seconds_of(CLOCK_MONOTONIC), seconds_of(CLOCK_PROCESS_CPUTIME_ID) };
}

static times since(times start)
{
    times end = now();

    return (times){ end.wall - start.wall, end.processor - start.processor };
}

/* ---- environments ---- */

static pe_env *finish(float *rgb)
{
    pe_error error;
    pe_env *env;

    for (int k = 0; k < 3 * WIDTH * HEIGHT; k++)
        rgb[k] = roundf(rgb[k] * 255) / 255;
    check(pe_env_create(WIDTH, HEIGHT, rgb, &env, &error), &error);
    free(rgb);
    return env;
}

static float *room(void)
{
    float *rgb = malloc(3 * sizeof *rgb * WIDTH * HEIGHT);

    if (!rgb)
        abort();
    return rgb;
}

static pe_env *make_pattern(void)
{
    float *rgb = room();

    for (int k = 0; k < WIDTH * HEIGHT; k++) {
        int row = k / WIDTH;
        float saturation = ((float)row + 0.5f) / HEIGHT, hue = 6 * ((float)(k % WIDTH) + 0.5f) / WIDTH;

        for (int c = 0; c < 3; c++) {
            float away = fabsf(fmodf(hue - 2 * (float)c + 9, 6) - 3); /* from the channel's own hue */

            rgb[3 * k + c] = 1 - saturation * fminf(fmaxf(away - 1, 0), 1);
        }
    }
    return finish(rgb);
}

/* Means of 4 x 4 lookups, by the curve (c / (1 + c))^(1/2.2). */
static pe_env *make_panorama(const pe_env *hdri)
{
    float *rgb = room();

    for (int k = 0; k < WIDTH * HEIGHT; k++) {
        double sum[3] = { 0 };
        int row = k / WIDTH;

        for (int i = 0; i < 16; i++) {
            double direction[3], light[3];
            int down = i / 4;

            pe_latlong_direction((k % WIDTH + (i % 4 + 0.5) / 4) / WIDTH, (row + (down + 0.5) / 4) / HEIGHT, direction);
            pe_env_lookup(hdri, direction, light);
            for (int c = 0; c < 3; c++)
                sum[c] += light[c] / 16;
        }
        for (int c = 0; c < 3; c++)
            rgb[3 * k + c] = (float)pow(sum[c] / (1 + sum[c]), 1 / 2.2);
    }
    return finish(rgb);
}

/* ---- Tables 2 and 3 ---- */

typedef struct bake_times {
    times prepare, filter;
} bake_times;

static pe_maps *bake(const pe_env *env, const pe_bake_options *options, bake_times *took)
{
    static const pe_bake_errors known = { 0, 0 };
    times start = now();
    pe_baker *baker;
    pe_error error;
    pe_maps *maps;

    check(pe_baker_make(options, WIDTH, HEIGHT, &baker, &error), &error);
    took->prepare = since(start);
    start = now();
    check(pe_baker_bake(baker, env, &known, &maps, &error), &error);
    took->filter = since(start);
    pe_baker_free(baker);
    return maps;
}

/* The mean difference of the voxels that a lookup may take. */
static double compare_voxels(const pe_maps *a, const pe_maps *b)
{
    size_t count = 0;
    double sum = 0;

    for (int k = 0; k < SIZE * SIZE * SIZE; k++) {
        const int at[3] = { k % SIZE, k / SIZE % SIZE, k / SIZE / SIZE };
        size_t texel = 3 * ((size_t)at[1] * SIZE + (size_t)at[0]);
        double square = 0;

        for (int c = 0; c < 3; c++)
            square += pow((2 * at[c] + 1) / (double)SIZE - 1, 2);
        if (square > 1)
            continue;
        for (size_t c = texel; c < texel + 3; c++)
            sum += fabs((double)pe_maps_image(a, at[2])[c] - (double)pe_maps_image(b, at[2])[c]);
        count += 3;
    }
    return 255 * sum / (double)count;
}

static void print_times(const char *what, const bake_times *t)
{
    printf("    %-24s table %8.3f s (%.3f s of processor), filter %8.3f s (%.3f s)\n", what, t->prepare.wall,
           t->prepare.processor, t->filter.wall, t->filter.processor);
}

static void thresholds(const pe_env *env, const double paper[5])
{
    static const double th[5] = { 0.001, 0.005, 0.01, 0.05, 0.1 };
    pe_bake_options options = { .method = PE_METHOD_VOXELS, .accuracy = PE_ACCURACY_EXACT };
    bake_times took;
    pe_maps *exact = bake(env, &options, &took);

    printf("  Tables 2 and 3: voxels of %d^3 against the unaccelerated bake; paper's / dark / spread\n", SIZE);
    print_times("unaccelerated", &took);
    options.accuracy = PE_ACCURACY_FAST;
    for (int k = 0; k < 5; k++) {
        double error[2];

        options.threshold = th[k];
        for (int spread = 0; spread < 2; spread++) {
            pe_maps *maps;

            options.lost = spread ? PE_LOST_SPREAD : PE_LOST_DARK;
            maps = bake(env, &options, &took);
            error[spread] = compare_voxels(maps, exact);
            pe_maps_free(maps);
        }
        printf("  th %-6g %6.2f / %6.3f / %6.3f levels\n", th[k], paper[k], error[0], error[1]);
        print_times("", &took);
    }
    pe_maps_free(exact);
}

/* ---- Table 4 ---- */

#define VIEWS 4000

/* Directions spread evenly over the sphere, in a spiral. */
static void direction_of(int k, double r[3])
{
    double y = 1 - (2 * k + 1) / (double)VIEWS, turn = M_PI * (3 - sqrt(5)) * k;

    r[0] = sqrt(1 - y * y) * cos(turn);
    r[1] = y;
    r[2] = sqrt(1 - y * y) * sin(turn);
}

static double compare_lookups(const pe_maps *maps, const pe_env *env, double lambda)
{
    static const pe_smoothness paper = { 0 };
    double sum = 0;

    for (int k = 0; k < VIEWS; k++) {
        pe_point point = { .roughness = lambda };
        double got[3], exact[3];

        direction_of(k, point.n);
        memcpy(point.o, point.n, sizeof point.o);
        pe_sample(maps, NULL, &point, got);
        pe_phong(env, pe_smoothness_exponent(&paper, lambda), PE_HORIZON_IGNORED, NULL, point.n, exact);
        for (int c = 0; c < 3; c++)
            sum += fabs(got[c] - exact[c]) / (3 * VIEWS);
    }
    return 255 * sum;
}

static void lookups(const pe_env *env, const double paper[5])
{
    static const double lambdas[5] = { 1, 0.75, 0.5, 0.25, 0.1 };
    pe_bake_options options = { .method = PE_METHOD_VOXELS };
    bake_times took;
    pe_maps *voxels = bake(env, &options, &took), *layers;
    double errors[5][2];
    size_t texels = 0;

    options.method = PE_METHOD_LAYERS;
    layers = bake(env, &options, &took);
    for (int k = 0; k < pe_maps_get_info(layers)->images; k++) {
        int width, height;

        pe_maps_image_size(layers, k, &width, &height);
        texels += (size_t)width * (size_t)height;
    }
    printf(
        "  Table 4: lookups against Phong's lobe; paper's / voxels / layers; layers: %d of %dx%d and less, 1/%.2f of "
        "the voxels' memory\n",
        pe_maps_get_info(layers)->images, pe_maps_get_info(layers)->width, pe_maps_get_info(layers)->height,
        (double)SIZE * SIZE * SIZE / (double)texels);
    print_times("layers", &took);
    for (int k = 0; k < 5; k++) {
        errors[k][0] = compare_lookups(voxels, env, lambdas[k]);
        errors[k][1] = compare_lookups(layers, env, lambdas[k]);
    }
    for (int k = 0; k < 4; k++)
        printf("  lambda %-5g     %5.2f / %6.3f / %6.4f levels\n", lambdas[k], paper[k], errors[k][0], errors[k][1]);
    printf("  half 0.1, half 1 %5.2f / %6.3f / %6.4f levels\n", paper[4], (errors[0][0] + errors[4][0]) / 2,
           (errors[0][1] + errors[4][1]) / 2);
    pe_maps_free(voxels);
    pe_maps_free(layers);
}

/* ---- section 3.3: a moving environment ---- */

/* Environments a second, of which nothing is estimated, over a second of processor time. */
static void print_rate(const char *what, const pe_env *env, const pe_bake_options *options)
{
    static const pe_bake_errors known = { 0, 0 };
    pe_baker *baker;
    pe_error error;
    times start, took;
    int count = 0;

    check(pe_baker_make(options, WIDTH, HEIGHT, &baker, &error), &error);
    start = now();
    do {
        pe_maps *maps;

        check(pe_baker_bake(baker, env, &known, &maps, &error), &error);
        pe_maps_free(maps);
        count++;
        took = since(start);
    } while (took.processor < 1);
    printf(
        "  %-16s %6.1f environments a second, %6.1f a second of one processor; the paper's film has 15, and took 4 s "
        "each\n",
        what, count / took.wall, count / took.processor);
    pe_baker_free(baker);
}

static void rates(const pe_env *env)
{
    pe_bake_options options = { .method = PE_METHOD_VOXELS, .smoothness.size = 64 };

    printf("  Filter only\n");
    print_rate("voxels of 64^3", env, &options);
    options.smoothness.size = SIZE;
    print_rate("voxels of 128^3", env, &options);
    options.method = PE_METHOD_LAYERS;
    print_rate("layers", env, &options);
    options.smoothness.size = 64;
    print_rate("layers, size 64", env, &options);
}

int main(int argc, char **argv)
{
    static const double paper2[2][5] = { { 0.2, 1.93, 3.87, 19, 38 }, { 1.0, 2.03, 3.6, 18.1, 36 } };
    static const double paper4[2][5] = { { 0.35, 0.48, 0.643, 0.903, 0.56 }, { 0.73, 0.86, 0.91, 1.47, 1.2 } };
    pe_env *hdri, *environments[2];
    pe_error error;

    if (argc != 2) {
        fprintf(stderr, "usage: multiscale ENV\n");
        return 2;
    }
    check(pe_env_read(argv[1], &hdri, &error), &error);
    environments[0] = make_pattern();
    environments[1] = make_panorama(hdri);
    for (int e = 0; e < 2; e++) {
        printf("(%c) %s\n", 'a' + e, e ? pe_env_name(hdri) : "hue and saturation");
        thresholds(environments[e], paper2[e]);
        lookups(environments[e], paper4[e]);
        rates(environments[e]);
        pe_env_free(environments[e]);
    }
    pe_env_free(hdri);
    return 0;
}
