/* bake.c - environment + surface + representative normals to maps: what is done with which lights. */
#include "bake.h"

#include "baseline.h"
#include "choose.h"
#include "cluster.h"
#include "estimate.h"
#include "filter.h"
#include "hemispheres.h"
#include "maps.h"
#include "multiscale.h"
#include "pairs.h"
#include "shrink.h"
#include "status.h"
#include "suns.h"

#include <stdlib.h>

/* What one bake shares. */
typedef struct job {
    const pe_baker *baker;
    const pe_env *fine;          /* what the environment was shrunk from, or itself */
    const pe_bake_errors *known; /* or NULL */
    pe_maps *maps;
    pe_stage stage;
    pe_report report; /* on the stage */
} job;

/* Where the kernel fills the maps, looking at their errors takes as long. */
static double estimate_share(const pe_baker *b)
{
    return b->kernel ? 0.5 : 0.1;
}

static void begin_stage(job *j, double share)
{
    j->report = pe_stage_begin(&j->stage, share);
}

/* ---- stages ---- */

static int report_stage(double fraction, void *data)
{
    const pe_stage *s = data;

    return s->options->progress(s->begin + s->share * fraction, s->options->progress_data);
}

pe_report pe_stage_begin(pe_stage *s, double share)
{
    s->begin += s->share;
    s->share = share;
    return (pe_report){ s->options->progress ? report_stage : NULL, s, 0, 1 };
}

/* ---- lights ---- */

/* Lobes narrower than a cluster would see single lights, so clusters shrink with the lobe's area, of which each texel
 * then sees the same number; and the error falls as their number grows.  The constants keep the error below what is
 * wanted on photographs: tests/test-fast.c. */
#define CLUSTERS_PER_LOBE_AREA 0.33
#define CLUSTERS_MIN 8.0

/* Of hemispheres, which are mixed and looked up by splines, their pictures have to be better than what is wanted. */
#define CLUSTERS_OF_HEMISPHERES 2.5

static double cluster_count(const pe_ndf *ndf, double wanted)
{
    double width[2];

    pe_ndf_fineness(ndf, width);
    return (CLUSTERS_MIN + CLUSTERS_PER_LOBE_AREA / (width[0] * width[1])) / wanted;
}

/* With half as many clusters as texels there is nothing to gain from them. */
static pe_status make_cloud(job *j, const pe_env *env, pe_cloud *cloud, pe_error *error)
{
    double texels = (double)env->width * env->height;
    double clusters = cluster_count(&j->baker->info.surface.ndf, pe_wanted_error(&j->baker->options));

    if (j->baker->info.method != PE_METHOD_BASELINE)
        clusters *= CLUSTERS_OF_HEMISPHERES;
    if (j->baker->info.accuracy == PE_ACCURACY_EXACT || clusters > texels / 2)
        return pe_cloud_from_env(env, cloud, error);
    return pe_cloud_from_clusters(env, (size_t)clusters, &j->report, cloud, error);
}

/* The fast mode passes over lights whose exponential is below exp(-18) = 1.5e-8 of the mirror's; 1 / cos^4 of their
 * half vectors raises that to (1 + 18 alpha^2)^2 times as much. */
#define FAST_LIMIT 18

static double reach_of(const pe_baker *b)
{
    return pe_lobe_reach(b->lobe, b->info.accuracy == PE_ACCURACY_EXACT ? PE_LOBE_CUTOFF : FAST_LIMIT);
}

/* ---- the methods ---- */

static pe_status fill_hemispheres(job *j, const pe_cloud *cloud, pe_maps *maps, pe_error *error)
{
    const pe_baker *b = j->baker;

    if (b->kernel) {
        j->report.total = (double)(maps->info.images + PE_KERNEL_GROUP - 1) / PE_KERNEL_GROUP;
        return pe_fill_hemispheres_by_kernel(cloud, b->lobe, b->kernel, b->options.threads, &j->report, maps, error);
    }
    j->report.total = maps->info.images;
    return pe_fill_hemispheres(cloud, b->lobe, reach_of(b), b->options.threads, &j->report, maps, error);
}

static pe_status fill_without_suns(job *j, const pe_env *rest, pe_maps *maps, pe_error *error)
{
    pe_cloud cloud;
    pe_status status = make_cloud(j, rest, &cloud, error);

    if (status == PE_OK) {
        status = fill_hemispheres(j, &cloud, maps, error);
        pe_cloud_free(&cloud);
    }
    return status == PE_OK ? pe_maps_finish(maps, j->baker->options.threads, error) : status;
}

pe_status pe_baker_fill(const pe_baker *b, const pe_env *rest, pe_report *report, pe_maps *maps, pe_error *error)
{
    job j = { .baker = b, .fine = rest, .report = *report };

    return fill_without_suns(&j, rest, maps, error);
}

static pe_status bake_hemispheres(job *j, const pe_env *env, pe_maps *maps, pe_error *error)
{
    pe_env *rest;
    pe_status status = pe_suns_draw_out(env, j->fine, &maps->info.surface, &maps->suns, &rest, error);

    if (status != PE_OK)
        return status;
    status = fill_without_suns(j, rest, maps, error);
    pe_env_free(rest);
    return status;
}

static pe_status bake_pairs_from_hemispheres(job *j, const pe_env *env, pe_error *error)
{
    pe_maps *hemispheres;
    pe_status status = pe_maps_create(&j->baker->hemispheres, &hemispheres, error);

    if (status != PE_OK)
        return status;
    j->stage.share /= 2;
    status = bake_hemispheres(j, env, hemispheres, error);
    begin_stage(j, j->stage.share);
    j->report.total = (double)j->maps->info.images * j->maps->info.height;
    if (status == PE_OK)
        status = pe_fill_pairs_from_hemispheres(hemispheres, j->baker->options.threads, &j->report, j->maps);
    j->maps->suns = hemispheres->suns; /* which are in the images; where they are matters to the estimate */
    pe_maps_free(hemispheres);
    return status;
}

static pe_status bake_pairs_from_lights(job *j, const pe_env *env, pe_error *error)
{
    pe_cloud cloud;
    pe_status status = make_cloud(j, env, &cloud, error);

    if (status != PE_OK)
        return status;
    j->report.total = (double)j->maps->info.images * j->maps->info.height;
    status = pe_fill_pairs(&cloud, j->baker->lobe, reach_of(j->baker), j->baker->options.threads, &j->report, j->maps,
                           error);
    pe_cloud_free(&cloud);
    return status;
}

/* By way of hemispheres, if these can be filtered by a kernel. */
static pe_status bake_pairs(job *j, const pe_env *env, pe_error *error)
{
    return j->baker->kernel ? bake_pairs_from_hemispheres(j, env, error) : bake_pairs_from_lights(j, env, error);
}

static pe_status bake_baseline(job *j, const pe_env *env, pe_error *error)
{
    const pe_maps_info *info = &j->maps->info;
    pe_head_on *head_on;
    pe_cloud cloud;
    pe_status status = make_cloud(j, env, &cloud, error);

    if (status != PE_OK)
        return status;
    status = pe_head_on_make(&cloud, j->baker->lobe, info->direction, reach_of(j->baker), &head_on, error);
    if (status == PE_OK) {
        j->report.total = info->height;
        status = pe_baseline_fill(head_on, j->maps, j->baker->options.threads, &j->report, error);
        pe_head_on_free(head_on);
    }
    pe_cloud_free(&cloud);
    return status;
}

static pe_status record_errors(job *j, const pe_env *env, pe_error *error)
{
    pe_maps_info *info = &j->maps->info;

    if (!j->known) {
        begin_stage(j, estimate_share(j->baker));
        return pe_estimate_errors(env, j->maps, j->baker->lobe, j->baker->options.threads, &j->report, error);
    }
    info->error_estimate = j->known->texels;
    info->lookup_error = j->known->lookups;
    return PE_OK;
}

static pe_status fill_maps(job *j, const pe_env *env, pe_error *error)
{
    pe_status status = PE_OK;

    switch (j->maps->info.method) {
    case PE_METHOD_DEFAULT:
    case PE_METHOD_HEMISPHERES:
        status = bake_hemispheres(j, env, j->maps, error);
        break;
    case PE_METHOD_REPRESENTATIVE:
        status = bake_pairs(j, env, error);
        break;
    case PE_METHOD_BASELINE:
        status = bake_baseline(j, env, error);
        break;
    case PE_METHOD_LAYERS:
    case PE_METHOD_VOXELS:
    case PE_METHOD_GRADES:
        break; /* pe_multiscale_bake, pe_baker_bake_grades */
    }
    return status == PE_OK ? record_errors(j, env, error) : status;
}

/* Texels this narrow beside the lobe's finest feature lie as well in the middle of four. */
#define FINEST_TEXEL 0.0625

/* A small sun on the horizon of a texel seen head on, where no suns are drawn out, has to keep its place beside a lobe
 * however wide. */
#define FINENESS_OF_BASELINE 0.1

pe_status pe_baker_shrink(const pe_baker *b, const pe_env *env, pe_env **shrunk, pe_error *error)
{
    double fineness[2];

    pe_ndf_fineness(&b->info.surface.ndf, fineness);
    if (b->info.method == PE_METHOD_BASELINE)
        fineness[0] = fmin(fineness[0], FINENESS_OF_BASELINE);
    return pe_env_shrink(env, FINEST_TEXEL * fmin(fineness[0], fineness[1]), shrunk, error);
}

/* Fast bakes are the same for however fine an environment. */
static pe_status fill_maps_from_shrunk(job *j, pe_error *error)
{
    pe_env *shrunk;
    pe_status status = pe_baker_shrink(j->baker, j->fine, &shrunk, error);

    if (status != PE_OK)
        return status;
    status = fill_maps(j, shrunk ? shrunk : j->fine, error);
    pe_env_free(shrunk);
    return status;
}

/* ---- what does not depend on the environment ---- */

static void choose_alphas(pe_maps_info *info)
{
    pe_ndf *ndf = &info->surface.ndf;

    if (ndf->kind == PE_NDF_TABLE && ndf->table) {
        double alpha[2];

        pe_ndf_table_alpha(ndf->table, alpha);
        ndf->alpha_x = alpha[0];
        ndf->alpha_y = alpha[1];
        info->ndf_name = pe_ndf_table_name(ndf->table);
    } else if (ndf->alpha_x == 0 && ndf->alpha_y == 0) {
        ndf->alpha_x = ndf->alpha_y = 0.1;
    }
}

pe_maps_info pe_describe_bake(const pe_bake_options *options, int width, int height)
{
    const double *d = options->direction;
    pe_maps_info info = { .method = options->method ? options->method : PE_METHOD_HEMISPHERES,
                          .surface = options->surface,
                          .direction = { d[0], d[1], d[2] },
                          .normals = options->normals,
                          .angles = options->angles ? options->angles : 1,
                          .width = options->width,
                          .height = options->height,
                          .source_name = "",
                          .ndf_name = "",
                          .source_width = width,
                          .source_height = height,
                          .accuracy = pe_choose_accuracy(options->accuracy, width, height),
                          .error_wanted = pe_wanted_error(options) };

    if (d[0] == 0 && d[1] == 0 && d[2] == 0)
        info.direction[1] = 1;
    return info;
}

static pe_status choose_info(const pe_bake_options *options, double aim, int width, int height, pe_maps_info *info,
                             pe_error *error)
{
    pe_status status;

    *info = pe_describe_bake(options, width, height);
    choose_alphas(info);
    status = pe_surface_check(&info->surface, error);
    if (status != PE_OK)
        return status;
    if (info->method == PE_METHOD_HEMISPHERES)
        pe_choose_hemispheres(options, aim, info);
    info->normals = info->normals ? info->normals : 42;
    info->width = info->width ? info->width : 400;
    info->height = info->height ? info->height : 200;
    return pe_maps_complete_info(info, error);
}

static pe_status check_error(double wanted, pe_error *error)
{
    if (wanted == 0 || (wanted >= PE_WANTED_ERROR_MIN && wanted <= PE_WANTED_ERROR_MAX))
        return PE_OK;
    return pe_fail(error, PE_ERROR_ARGUMENT, "error %g is out of range; it lies between %g and %g", wanted,
                   PE_WANTED_ERROR_MIN, PE_WANTED_ERROR_MAX);
}

static pe_status check_enums(const pe_bake_options *options, pe_error *error)
{
    if ((int)options->quality < PE_QUALITY_NORMAL || options->quality > PE_QUALITY_HIGH)
        return pe_fail(error, PE_ERROR_ARGUMENT, "quality %d is none of pe_quality", (int)options->quality);
    if ((int)options->accuracy < PE_ACCURACY_AUTO || options->accuracy > PE_ACCURACY_FAST)
        return pe_fail(error, PE_ERROR_ARGUMENT, "accuracy %d is none of pe_accuracy", (int)options->accuracy);
    if ((int)options->lost < PE_LOST_SPREAD || options->lost > PE_LOST_DARK)
        return pe_fail(error, PE_ERROR_ARGUMENT, "lost %d is none of pe_lost_weight", (int)options->lost);
    return PE_OK;
}

static pe_maps_info hemispheres_for(const pe_maps_info *wanted)
{
    pe_maps_info info = *wanted;

    if (wanted->method == PE_METHOD_HEMISPHERES)
        return info;
    info.method = PE_METHOD_HEMISPHERES;
    pe_choose_fine_size(&info.surface.ndf, &info.width, &info.height);
    return info;
}

/* Hemispheres that only stand between an environment and lat-long maps must not have more texels than this. */
#define HIDDEN_TEXELS_MAX 5e7

/* Leaves kernel NULL where none is of use. */
static pe_status make_kernel(pe_baker *b, pe_error *error)
{
    const pe_maps_info *info = &b->hemispheres;
    pe_disc map = { info->width, info->height }, cells = pe_kernel_cells(b->lobe, pe_wanted_error(&b->options));
    pe_stage stage = { &b->options, 0, 0 };
    pe_report report = pe_stage_begin(&stage, 0);

    if (b->info.method == PE_METHOD_REPRESENTATIVE &&
        (double)info->normals * info->width * info->height > HIDDEN_TEXELS_MAX)
        return PE_OK;
    if (b->info.method == PE_METHOD_BASELINE || info->accuracy != PE_ACCURACY_FAST ||
        !pe_kernel_suits(b->lobe, &cells, info->width, info->height))
        return PE_OK;
    return pe_kernel_make(b->lobe, &map, &cells, b->options.threads, &report, &b->kernel, error);
}

static pe_status prepare_multiscale(pe_baker *b, double aim, int width, int height, pe_error *error)
{
    pe_status status = pe_multiscale_make(&b->options, aim, width, height, &b->multiscale, error);

    if (status == PE_OK)
        b->info = *pe_multiscale_get_info(b->multiscale);
    return status;
}

static pe_status prepare(pe_baker *b, double aim, int width, int height, pe_error *error)
{
    pe_status status = check_error(b->options.error, error);

    if (status == PE_OK)
        status = check_enums(&b->options, error);
    if (status == PE_OK && pe_method_has_lambda(b->options.method))
        return prepare_multiscale(b, aim, width, height, error);
    if (status == PE_OK && b->options.method == PE_METHOD_GRADES)
        return pe_baker_prepare_grades(b, aim, width, height, error);
    if (status == PE_OK)
        status = choose_info(&b->options, aim, width, height, &b->info, error);
    if (status != PE_OK)
        return status;
    b->hemispheres = hemispheres_for(&b->info);
    status = pe_lobe_make(&b->info.surface, b->options.threads, &b->lobe, error);
    return status == PE_OK ? make_kernel(b, error) : status;
}

static pe_status make_baker(const pe_bake_options *options, double aim, int width, int height, pe_baker **out,
                            pe_error *error)
{
    pe_baker *b = calloc(1, sizeof *b);
    pe_status status;

    if (!b) {
        pe_fail_memory(error, "a baker");
        return PE_ERROR_MEMORY;
    }
    b->options = *options;
    status = prepare(b, aim, width, height, error);
    if (status == PE_ERROR_CANCELLED)
        pe_fail(error, status, "cancelled");
    if (status == PE_OK)
        *out = b;
    else
        pe_baker_free(b);
    return status;
}

pe_status pe_baker_make(const pe_bake_options *options, int width, int height, pe_baker **out, pe_error *error)
{
    return make_baker(options, pe_wanted_error(options), width, height, out, error);
}

void pe_baker_free(pe_baker *b)
{
    if (!b)
        return;
    pe_multiscale_free(b->multiscale);
    pe_baker_free_grades(b);
    pe_kernel_free(b->kernel);
    pe_lobe_free(b->lobe);
    free(b);
}

const pe_maps_info *pe_baker_get_info(const pe_baker *b)
{
    return &b->info;
}

/* ---- the whole ---- */

pe_status pe_baker_check_size(const pe_baker *b, const pe_env *env, pe_error *error)
{
    if (env->width == b->info.source_width && env->height == b->info.source_height)
        return PE_OK;
    return pe_fail(error, PE_ERROR_ARGUMENT, "%s: has %d x %d texels where %d x %d are expected, as the first has",
                   *env->name ? env->name : "the environment", env->width, env->height, b->info.source_width,
                   b->info.source_height);
}

pe_status pe_baker_bake(const pe_baker *b, const pe_env *env, const pe_bake_errors *known, pe_maps **out,
                        pe_error *error)
{
    pe_maps_info info = b->info;
    job j = { .baker = b, .fine = env, .known = known, .stage = { &b->options, 0, 0 } };
    pe_status status = pe_baker_check_size(b, env, error);

    if (status == PE_OK && b->multiscale)
        return pe_multiscale_bake(b->multiscale, env, known, out, error);
    if (status == PE_OK && b->grades)
        return pe_baker_bake_grades(b, env, known, out, error);
    pe_maps_set_source(&info, env);
    if (status == PE_OK)
        status = pe_maps_create(&info, &j.maps, error);
    if (status != PE_OK)
        return status;
    begin_stage(&j, known ? 1 : 1 - estimate_share(b));
    status = info.accuracy == PE_ACCURACY_FAST ? fill_maps_from_shrunk(&j, error) : fill_maps(&j, env, error);
    if (status == PE_ERROR_CANCELLED)
        pe_fail(error, status, "cancelled");
    j.maps->info.surface.ndf.table = NULL; /* the caller's, who may free it */
    if (status == PE_OK)
        *out = j.maps;
    else
        pe_maps_free(j.maps);
    return status;
}

static pe_status bake_once(const pe_env *env, const pe_bake_options *options, double aim, pe_maps **maps,
                           pe_error *error)
{
    pe_baker *baker;
    pe_status status = make_baker(options, aim, env->width, env->height, &baker, error);

    if (status != PE_OK)
        return status;
    status = pe_baker_bake(baker, env, NULL, maps, error);
    pe_baker_free(baker);
    return status;
}

/* How hard an environment is shows in a bake only.  An error that was asked for is aimed at from above, so that easy
 * ones have small maps; what misses it is baked again, so often at most, as long as that makes larger maps. */
#define AIM_ABOVE 3.0
#define AIM_BELOW 0.8
#define AIM_MIN 0.02
#define AIMS 5

static int is_as_large(const pe_maps *a, const pe_maps *b)
{
    return pe_maps_values(a) == pe_maps_values(b);
}

/* A bake that may not be the last: each is told of as half of what is left. */
static pe_status bake_attempt(const pe_env *env, pe_stage *stage, double aim, pe_maps **maps, pe_error *error)
{
    pe_bake_options options = *stage->options;
    pe_report report = pe_stage_begin(stage, (1 - stage->begin - stage->share) / 2);

    options.progress = report.function;
    options.progress_data = report.data;
    *maps = NULL;
    return bake_once(env, &options, aim, maps, error);
}

static pe_status bake_until(const pe_env *env, pe_stage *stage, pe_maps **maps, pe_error *error)
{
    double wanted = stage->options->error, aim = AIM_ABOVE * wanted;
    pe_status status = bake_attempt(env, stage, aim, maps, error);
    int is_final = 0;

    for (int k = 1; k < AIMS && status == PE_OK && !is_final && (*maps)->info.lookup_error > wanted; k++) {
        pe_maps *before = *maps;

        aim = fmax(aim * AIM_BELOW * wanted / before->info.lookup_error, AIM_MIN * wanted);
        status = bake_attempt(env, stage, aim, maps, error);
        is_final = status == PE_OK && is_as_large(before, *maps);
        pe_maps_free(before);
    }
    return status;
}

static pe_status bake_for_error(const pe_env *env, const pe_bake_options *options, pe_maps **out, pe_error *error)
{
    pe_stage stage = { options, 0, 0 };
    pe_maps *maps;
    pe_status status = bake_until(env, &stage, &maps, error);

    if (status == PE_OK && options->progress && options->progress(1, options->progress_data)) {
        pe_maps_free(maps);
        status = pe_fail(error, PE_ERROR_CANCELLED, "cancelled");
    }
    if (status == PE_OK)
        *out = maps;
    return status;
}

pe_status pe_bake(const pe_env *env, const pe_bake_options *options, pe_maps **maps, pe_error *error)
{
    int has_lookups = options->method == PE_METHOD_DEFAULT || options->method == PE_METHOD_HEMISPHERES ||
                      options->method == PE_METHOD_LAYERS || options->method == PE_METHOD_GRADES;

    if (options->error > 0 && has_lookups)
        return bake_for_error(env, options, maps, error);
    return bake_once(env, options, pe_wanted_error(options), maps, error);
}
