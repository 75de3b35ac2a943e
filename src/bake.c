/* bake.c - environment + NDF + representative normals to maps. [Motegi 3.1, Eq. 5]
 *
 * A texel w of the image that n_k and -n_k share belongs to the side it lies on, n = +-n_k.  The viewer who sees w in a
 * mirror of normal n is o = reflect(w, n): in the tangent frame of n, with w = (x, y, z), o = (-x, -y, z). */
#include "baseline.h"
#include "cluster.h"
#include "estimate.h"
#include "filter.h"
#include "maps.h"
#include "parallel.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

/* Exact costs (lights x texels): beyond this many lights AUTO becomes fast. */
#define AUTO_EXACT_TEXELS_MAX (400 * 200)

/* One side of a pair, ready to be filtered. */
typedef struct side {
    pe_frame frame;
    pe_lights lights;
} side;

/* What all rows of one image share. */
typedef struct job {
    const pe_env *env;
    const pe_cloud *cloud;
    const pe_lobe *lobe;
    double lobe_reach;
    pe_maps *maps;
    int image;
    side sides[2];
} job;

/* ---- points ---- */

/* Texels of one side waiting to be filtered together. */
typedef struct batch {
    size_t count;
    float o[PE_FILTER_POINTS_MAX][3];
    double world[PE_FILTER_POINTS_MAX][3];
    float *out[PE_FILTER_POINTS_MAX];
} batch;

static void store(const job *j, const double sums[4], const double world[3], const float o[3], float *out)
{
    double rgb[3];

    pe_filter_radiance(j->lobe, j->env, sums, world, o, rgb);
    for (int c = 0; c < 3; c++)
        out[c] = (float)rgb[c];
}

static void finish(const job *j, const pe_lights *lights, batch *points)
{
    double sums[PE_FILTER_POINTS_MAX][4];

    pe_filter_points(j->lobe, lights, (const float(*)[3])points->o, points->count, sums);
    for (size_t k = 0; k < points->count; k++)
        store(j, sums[k], points->world[k], points->o[k], points->out[k]);
    points->count = 0;
}

static void add_point(const job *j, const side *s, const double world[3], float *out, batch *points)
{
    size_t k = points->count++;

    pe_mirror_viewer(&s->frame, world, points->o[k]);
    memcpy(points->world[k], world, sizeof points->world[k]);
    points->out[k] = out;
    if (points->count == PE_FILTER_POINTS_MAX)
        finish(j, &s->lights, points);
}

/* ---- representative normals ---- */

static float *row_of(const job *j, size_t y)
{
    return j->maps->rgb + (size_t)j->image * pe_maps_image_values(j->maps) + 3 * y * (size_t)j->maps->info.width;
}

static void filter_row(size_t y, void *data)
{
    const job *j = data;
    float *row = row_of(j, y);
    batch points[2];

    points[0].count = points[1].count = 0;
    for (int x = 0; x < j->maps->info.width; x++) {
        double world[3];
        int which;

        pe_grid_direction(&j->maps->grid, x, (int)y, world);
        which = !(pe_dot(world, j->sides[0].frame.n) > 0);
        add_point(j, &j->sides[which], world, row + 3 * x, &points[which]);
    }
    for (int which = 0; which < 2; which++)
        finish(j, &j->sides[which].lights, &points[which]);
}

static void prepare_side(size_t which, void *data)
{
    job *j = data;
    side *s = &j->sides[which];

    pe_frame_make(pe_geodesic_vertex(j->maps->geodesic, 2 * j->image + (int)which), j->maps->info.direction, &s->frame);
    pe_lights_fill(j->cloud, j->lobe, &s->frame, j->lobe_reach, &s->lights);
}

static pe_status bake_images(job *j, int threads, pe_report *report, pe_error *error)
{
    pe_status status = pe_lights_allocate(j->cloud, &j->sides[0].lights, error);

    if (status == PE_OK)
        status = pe_lights_allocate(j->cloud, &j->sides[1].lights, error);
    for (j->image = 0; status == PE_OK && j->image < j->maps->info.images; j->image++) {
        pe_parallel_for(2, threads, prepare_side, j, NULL);
        status = pe_parallel_for((size_t)j->maps->info.height, threads, filter_row, j, report);
        report->done += j->maps->info.height;
    }
    pe_lights_free(&j->sides[0].lights);
    pe_lights_free(&j->sides[1].lights);
    return status;
}

/* ---- baseline ---- */

static pe_status bake_baseline(const job *j, int threads, const pe_report *report, pe_error *error)
{
    pe_head_on *head_on;
    pe_status status = pe_head_on_make(j->cloud, j->lobe, j->maps->info.direction, j->lobe_reach, &head_on, error);

    if (status != PE_OK)
        return status;
    status = pe_baseline_fill(head_on, j->maps, threads, report, error);
    pe_head_on_free(head_on);
    return status;
}

/* ---- the whole ---- */

/* Lobes narrower than a cluster would see single lights, so clusters shrink with the lobe's area, of which each texel
 * then sees the same number.  The constants keep the error below 1 % on photographs with suns: tests/test-fast.c. */
#define CLUSTERS_PER_LOBE_AREA 164.0
#define CLUSTERS_MIN 4096

static double cluster_count(const pe_ndf *ndf)
{
    double width[2];

    pe_ndf_fineness(ndf, width);
    return CLUSTERS_MIN + CLUSTERS_PER_LOBE_AREA / (width[0] * width[1]);
}

/* The fast mode passes over lights whose exponential is below exp(-18) = 1.5e-8 of the mirror's; 1 / cos^4 of their
 * half vectors raises that to (1 + 18 alpha^2)^2 times as much. */
#define FAST_LIMIT 18

/* With half as many clusters as texels there is nothing to gain from them. */
static pe_status make_cloud(const pe_env *env, const pe_maps_info *info, pe_cloud *cloud, pe_error *error)
{
    double texels = (double)env->width * env->height, clusters = cluster_count(&info->surface.ndf);

    if (info->accuracy == PE_ACCURACY_EXACT || clusters > texels / 2)
        return pe_cloud_from_env(env, cloud, error);
    return pe_cloud_from_clusters(env, (size_t)clusters, cloud, error);
}

static pe_status fill_maps(const pe_env *env, const pe_lobe *lobe, pe_maps *maps, const pe_bake_options *options,
                           pe_error *error)
{
    const pe_maps_info *info = &maps->info;
    pe_cloud cloud;
    job j = { .env = env, .cloud = &cloud, .lobe = lobe, .maps = maps };
    pe_report report = { options->progress, options->progress_data, 0, (double)info->images * info->height };
    pe_status status = make_cloud(env, info, &cloud, error);

    if (status != PE_OK)
        return status;
    j.lobe_reach = pe_lobe_reach(lobe, info->accuracy == PE_ACCURACY_EXACT ? PE_LOBE_CUTOFF : FAST_LIMIT);
    status = info->method == PE_METHOD_BASELINE ? bake_baseline(&j, options->threads, &report, error)
                                                : bake_images(&j, options->threads, &report, error);
    pe_cloud_free(&cloud);
    if (status == PE_OK && info->accuracy == PE_ACCURACY_FAST)
        status = pe_estimate_error(env, maps, lobe, options->threads, &maps->info.error_estimate, error);
    if (status == PE_ERROR_CANCELLED)
        pe_fail(error, status, "cancelled");
    return status;
}

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

static void choose_info(const pe_env *env, const pe_bake_options *options, pe_maps_info *info)
{
    static const double plus_y[3] = { 0, 1, 0 };
    const double *d = options->direction;

    *info = (pe_maps_info){ .method = options->method,
                            .surface = options->surface,
                            .normals = options->normals ? options->normals : 42,
                            .width = options->width ? options->width : 400,
                            .height = options->height ? options->height : 200,
                            .source_name = env->name,
                            .source_width = env->width,
                            .source_height = env->height,
                            .accuracy = choose_accuracy(options->accuracy, env) };
    choose_alphas(info);
    memcpy(info->direction, d[0] == 0 && d[1] == 0 && d[2] == 0 ? plus_y : d, sizeof info->direction);
}

pe_status pe_bake(const pe_env *env, const pe_bake_options *options, pe_maps **out, pe_error *error)
{
    pe_maps_info info;
    pe_maps *maps;
    pe_lobe *lobe;
    pe_status status;

    choose_info(env, options, &info);
    status = pe_lobe_make(&info.surface, options->threads, &lobe, error);
    if (status != PE_OK)
        return status;
    status = pe_maps_create(&info, &maps, error);
    if (status == PE_OK) {
        status = fill_maps(env, lobe, maps, options, error);
        maps->info.surface.ndf.table = NULL; /* the caller's, who may free it */
        if (status == PE_OK)
            *out = maps;
        else
            pe_maps_free(maps);
    }
    pe_lobe_free(lobe);
    return status;
}
