/* grades.c - `make bench-grades`: how far lookups in maps of any roughness are from the truth, beside those in maps of
 * the one roughness, for the HDRIs given, at their own resolution: the table of docs/roughness.md.
 *
 * Error: relative L2, of views with n.o > 0.15 and roughnesses about each alpha.  All maps with their defaults. */
#include "check.h"
#include "parallel.h"
#include "views.h"

#include <string.h>

#define VIEWS 400
#define ALPHA_MIN 0.02
#define ALPHA_MAX 0.5
#define BANDS 6

typedef struct band {
    const pe_env *env;
    double alpha, aspect, width; /* roughnesses from alpha / sqrt(width) to alpha * sqrt(width) */
    view views[VIEWS];
} band;

static pe_surface surface_of(double alpha, double aspect)
{
    return (pe_surface){ .ndf = { PE_NDF_BECKMANN, alpha, alpha / aspect, NULL } };
}

static void find_truth(size_t k, void *data)
{
    band *b = data;
    view *v = &b->views[k];
    pe_surface surface;

    place_view((int)k, VIEWS, &v->point);
    v->point.roughness = b->alpha * pow(b->width, ((double)k + 0.5) / VIEWS - 0.5);
    surface = surface_of(v->point.roughness, b->aspect);
    pe_exact(b->env, &surface, plus_y, v->point.n, v->point.o, v->exact);
}

static double error_of(const pe_maps *maps, const band *b)
{
    double error2 = 0, square = 0;

    for (int k = 0; k < VIEWS; k++) {
        double rgb[3];

        pe_sample(maps, NULL, &b->views[k].point, rgb);
        for (int c = 0; c < 3; c++) {
            error2 += (rgb[c] - b->views[k].exact[c]) * (rgb[c] - b->views[k].exact[c]);
            square += b->views[k].exact[c] * b->views[k].exact[c];
        }
    }
    return sqrt(error2 / square);
}

static pe_maps *bake(const pe_env *env, const pe_bake_options *options)
{
    pe_error error;
    pe_maps *maps;

    check(pe_bake(env, options, &maps, &error), &error);
    return maps;
}

/* Of a band: in maps of grades, and in those of its middle alone, where nothing but that is asked. */
static void measure(const pe_maps *grades, band *b, double errors[2])
{
    pe_error error;
    pe_maps *one = bake(b->env, &(pe_bake_options){ .surface = surface_of(b->alpha, b->aspect) });

    b->width = pow(ALPHA_MAX / ALPHA_MIN, 1.0 / BANDS);
    check(pe_parallel_for(VIEWS, 0, find_truth, b, NULL), &error);
    errors[0] = error_of(grades, b);
    b->width = 1;
    check(pe_parallel_for(VIEWS, 0, find_truth, b, NULL), &error);
    errors[1] = error_of(one, b);
    pe_maps_free(one);
}

static double alpha_of(int k)
{
    return ALPHA_MIN * pow(ALPHA_MAX / ALPHA_MIN, (k + 0.5) / BANDS);
}

static void print_row(const char *name, double aspect, double (*errors)[2], double scale, const char *mark)
{
    printf("| %s, %s |", name, aspect > 1 ? "3.3:1" : "isotropic");
    for (int k = 0; k < BANDS; k++)
        printf(" %s%.2g%s (%.2g) |", mark, 100 * scale * errors[k][0], mark, 100 * scale * errors[k][1]);
    putchar('\n');
    fflush(stdout);
}

static void print_errors(const char *path, double aspect, double (*sums)[2])
{
    double errors[BANDS][2];
    static band b;
    char name[64];
    pe_error error;
    pe_env *env;
    pe_maps *grades;

    check(pe_env_read(path, &env, &error), &error);
    grades =
        bake(env, &(pe_bake_options){
                      .method = PE_METHOD_GRADES, .surface = surface_of(ALPHA_MIN, aspect), .alpha_max = ALPHA_MAX });
    for (int k = 0; k < BANDS; k++) {
        b = (band){ .env = env, .alpha = alpha_of(k), .aspect = aspect };
        measure(grades, &b, errors[k]);
        for (int i = 0; i < 2; i++)
            sums[k][i] += errors[k][i];
    }
    snprintf(name, sizeof name, "*%.*s*", (int)strcspn(pe_env_name(env), "."), pe_env_name(env));
    print_row(name, aspect, errors, 1, "");
    pe_maps_free(grades);
    pe_env_free(env);
}

int main(int argc, char **argv)
{
    static const double aspects[2] = { 1, 3.3 };

    if (argc < 2) {
        fprintf(stderr, "usage: grades HDRI...\n");
        return 2;
    }
    printf("|");
    for (int k = 0; k < BANDS; k++)
        printf(" | α %.2g", alpha_of(k));
    printf(" |\n|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < 2; i++) {
        double sums[BANDS][2] = { { 0 } };

        for (int k = 1; k < argc; k++)
            print_errors(argv[k], aspects[i], sums);
        print_row("mean", aspects[i], sums, 1.0 / (argc - 1), "**");
    }
    return 0;
}
