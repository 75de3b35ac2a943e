/* multiscale.c - see multiscale.h. */
#include "multiscale.h"

#include "choose.h"
#include "layering.h"
#include "layers.h"
#include "phong.h"
#include "pyramid.h"
#include "sequence.h"
#include "status.h"
#include "voxels.h"

#include <stdlib.h>
#include <unistd.h>

struct pe_multiscale {
    pe_bake_options options;
    pe_maps_info info;
    pe_weights *weights; /* voxels, unless they are made without */
};

/* ---- decisions ---- */

#define THRESHOLD 0.001

/* Texels of the smoothest layer for each standard deviation of its lobe, and layers for each doubling of the exponent,
 * for an error of ERROR_OF_THESE on photographs; both meet it with the fourth power.  tests/test-voxels.c */
#define TEXELS_PER_DEVIATION 1.0
#define LAYERS_PER_OCTAVE 1.0
#define ERROR_OF_THESE 0.002

static void choose_layers(const pe_bake_options *options, double aim, pe_maps_info *info)
{
    double exponent = pe_smoothness_exponent(&info->smoothness, 1);
    double finer = pow(ERROR_OF_THESE / aim, 0.25);
    double width = 2 * M_PI * sqrt(exponent) * TEXELS_PER_DEVIATION * finer;
    double layers = log2(exponent) * LAYERS_PER_OCTAVE * finer + 1;

    info->images = options->layers ? options->layers : (int)fmin(fmax(ceil(layers), PE_LAYERS_MIN), PE_LAYERS_MAX);
    if (!info->width)
        info->width = PE_LAYER_WIDTH_MIN * (int)ceil(fmin(width, PE_MAPS_SIDE_MAX) / PE_LAYER_WIDTH_MIN);
    if (!info->height)
        info->height = info->width / 2;
}

static pe_status check_options(const pe_bake_options *options, pe_error *error)
{
    if (options->surface.ndf.kind != PE_NDF_BECKMANN && options->surface.ndf.kind != PE_NDF_PHONG)
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "layers and voxels are of Phong's lobe; leave the ndf out, or ask for grades");
    if (options->threshold != 0 && !(options->threshold >= 1e-6 && options->threshold <= 0.5))
        return pe_fail(error, PE_ERROR_ARGUMENT, "threshold %g is out of range; it lies between 0.000001 and 0.5",
                       options->threshold);
    return pe_smoothness_check(&options->smoothness, error);
}

static pe_status choose_info(pe_multiscale *m, double aim, int width, int height, pe_error *error)
{
    const pe_bake_options *options = &m->options;
    double alpha;

    m->info = (pe_maps_info){ .method = options->method,
                              .direction = { 0, 1, 0 },
                              .angles = 1,
                              .width = options->width,
                              .height = options->height,
                              .source_name = "",
                              .ndf_name = "",
                              .source_width = width,
                              .source_height = height,
                              .accuracy = options->accuracy == PE_ACCURACY_EXACT ? PE_ACCURACY_EXACT : PE_ACCURACY_FAST,
                              .error_wanted = pe_wanted_error(options),
                              .smoothness = options->smoothness };
    pe_smoothness_complete(&m->info.smoothness);
    alpha = pe_phong_alpha(pe_smoothness_exponent(&m->info.smoothness, 1));
    m->info.surface.ndf = (pe_ndf){ .kind = PE_NDF_PHONG, .alpha_x = alpha, .alpha_y = alpha };
    if (options->method == PE_METHOD_LAYERS) {
        choose_layers(options, aim, &m->info);
    } else {
        m->info.width = m->info.height = m->info.smoothness.size;
        m->info.threshold = options->threshold > 0 ? options->threshold : THRESHOLD;
        m->info.threshold = m->info.accuracy == PE_ACCURACY_EXACT ? 0 : m->info.threshold;
        m->info.lost = options->lost;
    }
    return pe_maps_complete_info(&m->info, error);
}

/* ---- the table of weights ---- */

/* A file's weights must be those that are asked for. */
static pe_status check_weights(const pe_multiscale *m, pe_error *error)
{
    const pe_smoothness *has = &m->weights->scale, *wanted = &m->info.smoothness;
    const char *path = m->options.weights;

    if (has->size != wanted->size)
        return pe_fail(error, PE_ERROR_ARGUMENT, "%s: weights for size %d, not the %d asked for; name another file",
                       path, has->size, wanted->size);
    if (has->window != wanted->window || has->levels != wanted->levels)
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "%s: weights for window %g and levels %g, not the %g and %g asked for; name another file", path,
                       has->window, has->levels, wanted->window, wanted->levels);
    if (m->weights->threshold != m->info.threshold)
        return pe_fail(error, PE_ERROR_ARGUMENT, "%s: weights of threshold %g, not the %g asked for; name another file",
                       path, m->weights->threshold, m->info.threshold);
    return PE_OK;
}

static pe_status get_weights(pe_multiscale *m, pe_error *error)
{
    const pe_report report = { m->options.progress, m->options.progress_data, 0, 1 };
    const char *path = m->options.weights;
    pe_status status;

    if (path && access(path, F_OK) == 0) {
        status = pe_weights_read(path, &m->weights, error);
        return status == PE_OK ? check_weights(m, error) : status;
    }
    status = pe_weights_make(&m->info.smoothness, m->info.threshold, m->options.threads, &report, &m->weights, error);
    if (status == PE_OK && path)
        status = pe_weights_write(m->weights, path, error);
    return status;
}

/* ---- made, released ---- */

pe_status pe_multiscale_make(const pe_bake_options *options, double aim, int width, int height, pe_multiscale **out,
                             pe_error *error)
{
    pe_multiscale *m = calloc(1, sizeof *m);
    pe_status status;

    if (!m)
        return pe_fail_memory(error, "a baker");
    m->options = *options;
    status = check_options(options, error);
    if (status == PE_OK)
        status = choose_info(m, aim, width, height, error);
    if (status == PE_OK && options->method == PE_METHOD_VOXELS && m->info.accuracy == PE_ACCURACY_FAST)
        status = get_weights(m, error);
    if (status == PE_OK)
        *out = m;
    else
        pe_multiscale_free(m);
    return status;
}

void pe_multiscale_free(pe_multiscale *m)
{
    if (!m)
        return;
    pe_weights_free(m->weights);
    free(m);
}

const pe_maps_info *pe_multiscale_get_info(const pe_multiscale *m)
{
    return &m->info;
}

/* ---- the errors ---- */

#define PROBES 200

/* One in TEXEL_PER_DEVIATION of a lobe is as good as the environment itself. */
#define TEXEL_PER_DEVIATION 0.125

typedef struct trial {
    const pe_maps *maps;
    const pe_pyramid *pyramid;
    double error2[PROBES], norm2[PROBES];
    int of_texels; /* or of lookups */
} trial;

/* Where texels lie, or anywhere; lambda as evenly as the voxels' distances. */
static void choose_point(const trial *t, int k, pe_point *point)
{
    static const double offsets[2] = { 0.25, 0.5 };
    const pe_maps_info *info = &t->maps->info;
    double u[2];

    pe_lattice_point(k, offsets, u);
    pe_latlong_direction(u[0], acos(1 - 2 * u[1]) / M_PI, point->n);
    point->roughness = (k + 0.5) / PROBES;
    if (t->of_texels && info->method == PE_METHOD_LAYERS) {
        int layer = k % info->images, width, height;

        pe_maps_image_size(t->maps, layer, &width, &height);
        point->roughness = pe_smoothness_lambda(&info->smoothness, pe_maps_image_exponent(t->maps, layer));
        pe_latlong_direction((floor(u[0] * width) + 0.5) / width,
                             (floor(acos(1 - 2 * u[1]) / M_PI * height) + 0.5) / height, point->n);
    } else if (t->of_texels) {
        for (int c = 0; c < 3; c++) {
            double place = (point->roughness * point->n[c] + 1) / 2 * info->width;

            point->n[c] = (2 * fmin(floor(place), info->width - 1) + 1) / info->width - 1;
        }
        point->roughness = fmin(sqrt(pe_dot(point->n, point->n)), 1);
    }
    for (int c = 0; c < 3; c++)
        point->o[c] = point->n[c];
}

static void probe(size_t k, void *data)
{
    trial *t = data;
    pe_point point = { 0 };
    double shown[3], exact[3], exponent;

    choose_point(t, (int)k, &point);
    exponent = pe_smoothness_exponent(&t->maps->info.smoothness, point.roughness);
    pe_sample(t->maps, NULL, &point, shown);
    pe_phong(pe_pyramid_level(t->pyramid, TEXEL_PER_DEVIATION / sqrt(exponent)), exponent, PE_HORIZON_IGNORED, NULL,
             point.n, exact);
    for (int c = 0; c < 3; c++) {
        t->error2[k] += (shown[c] - exact[c]) * (shown[c] - exact[c]);
        t->norm2[k] += exact[c] * exact[c];
    }
}

static double estimate(const pe_pyramid *pyramid, const pe_maps *maps, int of_texels, int threads)
{
    trial t = { .maps = maps, .pyramid = pyramid, .of_texels = of_texels };
    double error2 = 0, norm2 = 0;

    pe_parallel_for(PROBES, threads, probe, &t, NULL);
    for (int k = 0; k < PROBES; k++) {
        error2 += t.error2[k];
        norm2 += t.norm2[k];
    }
    return norm2 > 0 ? sqrt(error2 / norm2) : 0;
}

static pe_status record_errors(const pe_env *env, const pe_bake_errors *known, int threads, pe_maps *maps,
                               pe_error *error)
{
    pe_pyramid pyramid;
    pe_status status;

    if (known) {
        maps->info.error_estimate = known->texels;
        maps->info.lookup_error = known->lookups;
        return PE_OK;
    }
    status = pe_pyramid_make(env, TEXEL_PER_DEVIATION, &pyramid, error);
    if (status != PE_OK)
        return status;
    if (maps->info.accuracy != PE_ACCURACY_EXACT)
        maps->info.error_estimate = estimate(&pyramid, maps, 1, threads);
    maps->info.lookup_error = estimate(&pyramid, maps, 0, threads);
    pe_pyramid_free(&pyramid);
    return PE_OK;
}

/* ---- the bake ---- */

static pe_status fill_layers(const pe_multiscale *m, const pe_env *env, pe_report *report, pe_maps *maps,
                             pe_error *error)
{
    report->total = 0;
    for (int k = 0; k < maps->info.images; k++)
        report->total += maps->layers[k].height;
    if (m->info.accuracy == PE_ACCURACY_EXACT)
        return pe_fill_layers_exactly(env, m->options.threads, report, maps);
    return pe_fill_layers(env, m->options.threads, report, maps, error);
}

static pe_status fill(const pe_multiscale *m, const pe_env *env, pe_maps *maps, pe_error *error)
{
    pe_report report = { m->options.progress, m->options.progress_data, 0, 1 };

    if (m->info.method == PE_METHOD_LAYERS)
        return fill_layers(m, env, &report, maps, error);
    if (m->weights)
        return pe_fill_voxels(m->weights, m->info.lost, env, m->options.threads, maps, error);
    report.total = (double)m->info.width * m->info.width;
    return pe_fill_voxels_exactly(env, m->options.threads, &report, maps);
}

pe_status pe_multiscale_bake(const pe_multiscale *m, const pe_env *env, const pe_bake_errors *known, pe_maps **out,
                             pe_error *error)
{
    pe_maps_info info = m->info;
    pe_maps *maps;
    pe_status status;

    pe_maps_set_source(&info, env);
    status = pe_maps_create(&info, &maps, error);
    if (status != PE_OK)
        return status;
    status = fill(m, env, maps, error);
    if (status == PE_ERROR_CANCELLED)
        pe_fail(error, status, "cancelled");
    if (status == PE_OK)
        status = pe_maps_finish(maps, m->options.threads, error);
    if (status == PE_OK)
        status = record_errors(env, known, m->options.threads, maps, error);
    if (status == PE_OK)
        *out = maps;
    else
        pe_maps_free(maps);
    return status;
}
