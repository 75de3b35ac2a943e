/* bake.c - environment + surface + representative normals to maps: what is done with which lights. */
#include "baseline.h"
#include "choose.h"
#include "cluster.h"
#include "estimate.h"
#include "filter.h"
#include "hemispheres.h"
#include "maps.h"
#include "pairs.h"
#include "shrink.h"
#include "status.h"
#include "suns.h"

#include <string.h>

/* Exact costs (lights x texels): beyond this many lights AUTO becomes fast. */
#define AUTO_EXACT_TEXELS_MAX (128 * 64)

/* What one bake shares. */
typedef struct job {
    const pe_bake_options *options;
    const pe_env *fine; /* what the environment was shrunk from, or itself */
    const pe_lobe *lobe;
    pe_maps *maps;
    pe_report report;
} job;

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
static pe_status make_cloud(const job *j, const pe_env *env, pe_cloud *cloud, pe_error *error)
{
    double texels = (double)env->width * env->height;
    double clusters = cluster_count(&j->maps->info.surface.ndf, pe_wanted_error(j->options));

    if (j->maps->info.method != PE_METHOD_BASELINE)
        clusters *= CLUSTERS_OF_HEMISPHERES;
    if (j->maps->info.accuracy == PE_ACCURACY_EXACT || clusters > texels / 2)
        return pe_cloud_from_env(env, cloud, error);
    return pe_cloud_from_clusters(env, (size_t)clusters, cloud, error);
}

/* The fast mode passes over lights whose exponential is below exp(-18) = 1.5e-8 of the mirror's; 1 / cos^4 of their
 * half vectors raises that to (1 + 18 alpha^2)^2 times as much. */
#define FAST_LIMIT 18

static double reach_of(const job *j)
{
    return pe_lobe_reach(j->lobe, j->maps->info.accuracy == PE_ACCURACY_EXACT ? PE_LOBE_CUTOFF : FAST_LIMIT);
}

/* ---- the methods ---- */

static pe_status fill_by_lights(job *j, const pe_cloud *cloud, pe_maps *maps, pe_error *error)
{
    j->report.total = maps->info.images;
    return pe_fill_hemispheres(cloud, j->lobe, reach_of(j), j->options->threads, &j->report, maps, error);
}

static pe_status fill_by_kernel(job *j, const pe_cloud *cloud, pe_maps *maps, pe_error *error)
{
    pe_disc cells = pe_kernel_cells(j->lobe, pe_wanted_error(j->options));
    pe_kernel *kernel;
    pe_status status = pe_kernel_make(j->lobe, &maps->disc, &cells, j->options->threads, &kernel, error);

    if (status != PE_OK)
        return status;
    j->report.total = (double)(maps->info.images + PE_KERNEL_GROUP - 1) / PE_KERNEL_GROUP;
    status = pe_fill_hemispheres_by_kernel(cloud, j->lobe, kernel, j->options->threads, &j->report, maps, error);
    pe_kernel_free(kernel);
    return status;
}

static int suits_kernel(const job *j, const pe_maps_info *info)
{
    pe_disc cells = pe_kernel_cells(j->lobe, pe_wanted_error(j->options));

    return info->accuracy == PE_ACCURACY_FAST && pe_kernel_suits(j->lobe, &cells, info->width, info->height);
}

static pe_status bake_hemispheres(job *j, const pe_env *env, pe_maps *maps, pe_error *error)
{
    pe_env *rest;
    pe_cloud cloud;
    pe_status status = pe_suns_draw_out(env, j->fine, &maps->info.surface, &maps->suns, &rest, error);

    if (status != PE_OK)
        return status;
    status = make_cloud(j, rest, &cloud, error);
    if (status == PE_OK) {
        status = suits_kernel(j, &maps->info) ? fill_by_kernel(j, &cloud, maps, error)
                                              : fill_by_lights(j, &cloud, maps, error);
        pe_cloud_free(&cloud);
    }
    pe_env_free(rest);
    if (status == PE_OK)
        status = pe_maps_finish(maps, j->options->threads, error);
    return status;
}

/* The hemispheres that pairs can be looked up in. */
static pe_maps_info hemispheres_for(const pe_maps_info *pairs)
{
    pe_maps_info info = *pairs;

    info.method = PE_METHOD_HEMISPHERES;
    pe_choose_fine_size(&info.surface.ndf, &info.width, &info.height);
    return info;
}

static pe_status bake_pairs_from_hemispheres(job *j, const pe_env *env, const pe_maps_info *info, pe_error *error)
{
    pe_maps *hemispheres;
    pe_status status = pe_maps_create(info, &hemispheres, error);

    if (status != PE_OK)
        return status;
    status = bake_hemispheres(j, env, hemispheres, error);
    if (status == PE_OK)
        status = pe_fill_pairs_from_hemispheres(hemispheres, j->options->threads, NULL, j->maps);
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
    status = pe_fill_pairs(&cloud, j->lobe, reach_of(j), j->options->threads, &j->report, j->maps, error);
    pe_cloud_free(&cloud);
    return status;
}

/* By way of hemispheres, if these can be filtered by a kernel. */
static pe_status bake_pairs(job *j, const pe_env *env, pe_error *error)
{
    pe_maps_info hemispheres = hemispheres_for(&j->maps->info);

    return suits_kernel(j, &hemispheres) ? bake_pairs_from_hemispheres(j, env, &hemispheres, error)
                                         : bake_pairs_from_lights(j, env, error);
}

static pe_status bake_baseline(job *j, const pe_env *env, pe_error *error)
{
    const pe_maps_info *info = &j->maps->info;
    pe_head_on *head_on;
    pe_cloud cloud;
    pe_status status = make_cloud(j, env, &cloud, error);

    if (status != PE_OK)
        return status;
    status = pe_head_on_make(&cloud, j->lobe, info->direction, reach_of(j), &head_on, error);
    if (status == PE_OK) {
        j->report.total = info->height;
        status = pe_baseline_fill(head_on, j->maps, j->options->threads, &j->report, error);
        pe_head_on_free(head_on);
    }
    pe_cloud_free(&cloud);
    return status;
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
    }
    if (status == PE_OK)
        status = pe_estimate_errors(env, j->maps, j->lobe, j->options->threads, error);
    if (status == PE_ERROR_CANCELLED)
        pe_fail(error, status, "cancelled");
    return status;
}

/* Texels this narrow beside the lobe's finest feature lie as well in the middle of four. */
#define FINEST_TEXEL 0.0625

/* A small sun on the horizon of a texel seen head on, where no suns are drawn out, has to keep its place beside a lobe
 * however wide. */
#define FINENESS_OF_BASELINE 0.1

/* Fast bakes are the same for however fine an environment. */
static pe_status fill_maps_from_shrunk(job *j, pe_error *error)
{
    pe_env *shrunk;
    double fineness[2];
    pe_status status;

    pe_ndf_fineness(&j->maps->info.surface.ndf, fineness);
    if (j->maps->info.method == PE_METHOD_BASELINE)
        fineness[0] = fmin(fineness[0], FINENESS_OF_BASELINE);
    status = pe_env_shrink(j->fine, FINEST_TEXEL * fmin(fineness[0], fineness[1]), &shrunk, error);
    if (status != PE_OK)
        return status;
    status = fill_maps(j, shrunk ? shrunk : j->fine, error);
    pe_env_free(shrunk);
    return status;
}

/* ---- the whole ---- */

static pe_accuracy choose_accuracy(pe_accuracy asked, const pe_env *env)
{
    if (asked != PE_ACCURACY_AUTO)
        return asked;
    return (size_t)env->width * (size_t)env->height <= AUTO_EXACT_TEXELS_MAX ? PE_ACCURACY_EXACT : PE_ACCURACY_FAST;
}

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

static pe_status choose_info(const pe_env *env, const pe_bake_options *options, pe_maps_info *info, pe_error *error)
{
    static const double plus_y[3] = { 0, 1, 0 };
    const double *d = options->direction;
    pe_status status;

    *info = (pe_maps_info){ .method = options->method ? options->method : PE_METHOD_HEMISPHERES,
                            .surface = options->surface,
                            .normals = options->normals,
                            .angles = options->angles ? options->angles : 1,
                            .width = options->width,
                            .height = options->height,
                            .source_name = env->name,
                            .source_width = env->width,
                            .source_height = env->height,
                            .accuracy = choose_accuracy(options->accuracy, env) };
    choose_alphas(info);
    status = pe_surface_check(&info->surface, error);
    if (status != PE_OK)
        return status;
    memcpy(info->direction, d[0] == 0 && d[1] == 0 && d[2] == 0 ? plus_y : d, sizeof info->direction);
    if (info->method == PE_METHOD_HEMISPHERES) {
        pe_choose_hemispheres(env, options, info);
        return PE_OK;
    }
    info->normals = info->normals ? info->normals : 42;
    info->width = info->width ? info->width : 400;
    info->height = info->height ? info->height : 200;
    return PE_OK;
}

static pe_status check_error(double wanted, pe_error *error)
{
    if (wanted == 0 || (wanted >= 0.0005 && wanted <= 0.1))
        return PE_OK;
    return pe_fail(error, PE_ERROR_ARGUMENT, "error %g is out of range; it lies between 0.0005 and 0.1", wanted);
}

pe_status pe_bake(const pe_env *env, const pe_bake_options *options, pe_maps **out, pe_error *error)
{
    pe_maps_info info;
    pe_lobe *lobe = NULL;
    job j = { .options = options, .report = { options->progress, options->progress_data, 0, 1 } };
    pe_status status = check_error(options->error, error);

    if (status == PE_OK)
        status = choose_info(env, options, &info, error);
    if (status == PE_OK)
        status = pe_maps_create(&info, &j.maps, error);
    if (status != PE_OK)
        return status;
    status = pe_lobe_make(&info.surface, options->threads, &lobe, error);
    j.lobe = lobe;
    j.fine = env;
    if (status == PE_OK)
        status = info.accuracy == PE_ACCURACY_FAST ? fill_maps_from_shrunk(&j, error) : fill_maps(&j, env, error);
    pe_lobe_free(lobe);
    j.maps->info.surface.ndf.table = NULL; /* the caller's, who may free it */
    if (status == PE_OK)
        *out = j.maps;
    else
        pe_maps_free(j.maps);
    return status;
}
