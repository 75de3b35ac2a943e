/* quality.c - `make bench-quality`: how far what maps show is from the truth over spheres seen from everywhere, ours
 * and the paper's, for every HDRI at its own resolution.
 *
 * Error: root mean square over the mean of the truth, of views with n.o > 0.15.  The paper's maps: 42 normals in pairs
 * of 400 x 200, weighted interpolation with a = 50. */
#include "check.h"
#include "parallel.h"
#include "prefenv.h"
#include "views.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define VIEWS 3000

typedef struct truth {
    const pe_env *env;
    const pe_surface *surface;
    view *views;
} truth;

static void find_truth(size_t k, void *data)
{
    const truth *t = data;
    view *v = &t->views[k];

    place_view((int)k, VIEWS, &v->point);
    pe_exact(t->env, t->surface, plus_y, v->point.n, v->point.o, v->exact);
}

static double error_of(const pe_env *env, const pe_bake_options *options, const pe_sampling *sampling,
                       const view *views, double *megabytes)
{
    double error2 = 0, sum = 0;
    const pe_maps_info *info;
    pe_maps *maps;
    pe_error error;

    check(pe_bake(env, options, &maps, &error), &error);
    for (int k = 0; k < VIEWS; k++) {
        double rgb[3];

        pe_sample(maps, sampling, &views[k].point, rgb);
        for (int c = 0; c < 3; c++) {
            error2 += (rgb[c] - views[k].exact[c]) * (rgb[c] - views[k].exact[c]);
            sum += views[k].exact[c];
        }
    }
    info = pe_maps_get_info(maps);
    *megabytes = 6e-6 * info->images * info->width * info->height;
    pe_maps_free(maps);
    return sqrt(error2 / (3 * VIEWS)) / (sum / (3 * VIEWS));
}

static void print_errors(const char *path, double alpha_x, double alpha_y)
{
    static const pe_sampling weighted = { .interpolation = PE_INTERPOLATION_WEIGHTED, .exponent = 50 };
    static view views[VIEWS];
    const pe_surface surface = { .ndf = { PE_NDF_BECKMANN, alpha_x, alpha_y, NULL } };
    double paper, ours, high, megabytes[3];
    pe_error error;
    pe_env *env;
    truth t;

    check(pe_env_read(path, &env, &error), &error);
    t = (truth){ env, &surface, views };
    check(pe_parallel_for(VIEWS, 0, find_truth, &t, NULL), &error);
    paper = error_of(env, &(pe_bake_options){ .surface = surface, .method = PE_METHOD_REPRESENTATIVE }, &weighted,
                     views, &megabytes[0]);
    ours = error_of(env, &(pe_bake_options){ .surface = surface }, NULL, views, &megabytes[1]);
    high =
        error_of(env, &(pe_bake_options){ .surface = surface, .quality = PE_QUALITY_HIGH }, NULL, views, &megabytes[2]);
    printf("%-12s %4g, %-4g %9.3f %% %9.3f %%  1/%-6.3g %6.1f MB %9.3f %% %6.1f MB\n", pe_env_name(env), alpha_x,
           alpha_y, 100 * paper, 100 * ours, paper / ours, megabytes[1], 100 * high, megabytes[2]);
    fflush(stdout);
    pe_env_free(env);
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: quality HDRI...\n");
        return 2;
    }
    printf("%-12s %10s %11s %11s %9s %18s %10s\n", "environment", "alpha", "the paper's", "ours", "", "", "high");
    for (int k = 1; k < argc; k++) {
        print_errors(argv[k], 0.1, 0.1);
        print_errors(argv[k], 0.1, 0.03);
    }
    return 0;
}
