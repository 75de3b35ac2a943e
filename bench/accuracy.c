/* accuracy.c - `make bench-accuracy`: how long the paper's 42 maps of 400 x 200 take, how far they are from the truth,
 * and how far they say they are, for lobes from 0.02 to 0.6, isotropic and ten times as wide one way.
 *
 * Error: relative L2 of texels, of those with n.r > 0.15 and of all.  The truth are maps of 80 x 40, baked exactly:
 * their texels stand where every fifth of every fifth row of the others stands. */
#include "check.h"
#include "prefenv.h"
#include "seconds.h"
#include "vector.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define FINER 5 /* odd, so that centres of texels fall together */

typedef struct setting {
    double alpha_x, alpha_y;
    double error; /* as asked for; 0: as usual */
} setting;

typedef struct errors {
    double away, all; /* from grazing; of all texels */
} errors;

static pe_maps *bake(const pe_env *env, const setting *s, pe_accuracy accuracy, int width)
{
    pe_bake_options options = { .method = PE_METHOD_REPRESENTATIVE,
                                .surface.ndf = { PE_NDF_BECKMANN, s->alpha_x, s->alpha_y, NULL },
                                .width = width,
                                .height = width / 2,
                                .accuracy = accuracy,
                                .error = s->error };
    pe_maps *maps;
    pe_error error;

    check(pe_bake(env, &options, &maps, &error), &error);
    return maps;
}

static errors errors_of(const pe_maps *fast, const pe_maps *exact)
{
    const pe_maps_info *info = pe_maps_get_info(exact);
    double error2[2] = { 0 }, norm2[2] = { 0 };

    for (int k = 0; k < info->images; k++)
        for (int y = 0; y < info->height; y++)
            for (int x = 0; x < info->width; x++) {
                const float *truth = pe_maps_image(exact, k) + 3 * (y * info->width + x);
                const float *ours = pe_maps_image(fast, k) +
                                    3 * ((FINER * y + FINER / 2) * FINER * info->width + FINER * x + FINER / 2);
                double n[3], r[3];
                int grazing;

                pe_maps_normal(exact, k, n);
                pe_latlong_direction((x + 0.5) / info->width, (y + 0.5) / info->height, r);
                grazing = fabs(pe_dot(n, r)) <= 0.15;
                for (int c = 0; c < 3; c++) {
                    error2[grazing] += ((double)ours[c] - (double)truth[c]) * ((double)ours[c] - (double)truth[c]);
                    norm2[grazing] += (double)truth[c] * (double)truth[c];
                }
            }
    return (errors){ sqrt(error2[0] / norm2[0]), sqrt((error2[0] + error2[1]) / (norm2[0] + norm2[1])) };
}

static void print_row(const pe_env *env, const setting *s)
{
    pe_maps *exact = bake(env, s, PE_ACCURACY_EXACT, 400 / FINER), *fast;
    double wall = -seconds_of(CLOCK_MONOTONIC), cpu = -seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    errors e;

    fast = bake(env, s, PE_ACCURACY_FAST, 400);
    wall += seconds_of(CLOCK_MONOTONIC);
    cpu += seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    e = errors_of(fast, exact);
    printf("%-12s %5g, %-5g %8g %8.2f s %8.2f s %9.3f %% %9.3f %% %9.3f %%\n", pe_env_name(env), s->alpha_x, s->alpha_y,
           s->error, wall, cpu, 100 * e.away, 100 * e.all, 100 * pe_maps_get_info(fast)->error_estimate);
    fflush(stdout);
    pe_maps_free(fast);
    pe_maps_free(exact);
}

int main(int argc, char **argv)
{
    static const setting settings[] = { { 0.02, 0.02, 0 },    { 0.05, 0.05, 0 }, { 0.1, 0.1, 0 },
                                        { 0.1, 0.1, 0.0005 }, { 0.2, 0.2, 0 },   { 0.6, 0.6, 0 },
                                        { 0.1, 0.03, 0 },     { 0.2, 0.02, 0 },  { 0.06, 0.6, 0 } };

    if (argc < 2) {
        fprintf(stderr, "usage: accuracy HDRI...\n");
        return 2;
    }
    printf("%-12s %12s %8s %10s %10s %11s %11s %11s\n", "environment", "alpha", "--error", "bake", "CPU", "n.r > 0.15",
           "all", "it says");
    for (int k = 1; k < argc; k++) {
        pe_error error;
        pe_env *env;

        check(pe_env_read(argv[k], &env, &error), &error);
        for (size_t a = 0; a < sizeof settings / sizeof *settings; a++)
            print_row(env, &settings[a]);
        pe_env_free(env);
    }
    return 0;
}
