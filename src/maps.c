/* maps.c - a set of maps in memory: made, described, released. */
#include "maps.h"

#include "atlas.h"
#include "layering.h"
#include "parallel.h"
#include "spline.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

static pe_status check_normals(int normals, pe_error *error)
{
    int below = 12, above = 0;

    if (pe_geodesic_frequency(normals))
        return PE_OK;
    for (int f = 1; f <= PE_FREQUENCY_MAX && !above; f++) {
        if (10 * f * f + 2 < normals)
            below = 10 * f * f + 2;
        else
            above = 10 * f * f + 2;
    }
    if (above && above != below && normals > 12)
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "normals %d is not 10 f^2 + 2 for a whole f from 1 to %d; the nearest are %d and %d", normals,
                       PE_FREQUENCY_MAX, below, above);
    return pe_fail(error, PE_ERROR_ARGUMENT,
                   "normals %d is not 10 f^2 + 2 for a whole f from 1 to %d; the nearest is %d", normals,
                   PE_FREQUENCY_MAX, below);
}

/* Of a table that is known by name only, whatever was measured will do. */
static pe_status check_surface(const pe_surface *surface, pe_error *error)
{
    pe_surface likely = *surface;

    if (surface->ndf.kind == PE_NDF_TABLE) {
        if (!(surface->ndf.alpha_x >= 0 && surface->ndf.alpha_y >= 0))
            return pe_fail(error, PE_ERROR_ARGUMENT, "alpha %g, %g of a table is below 0", surface->ndf.alpha_x,
                           surface->ndf.alpha_y);
        likely.ndf = (pe_ndf){ .alpha_x = 1, .alpha_y = 1 };
    }
    return pe_surface_check(&likely, error);
}

static pe_status check_direction(const double d[3], pe_error *error)
{
    for (int c = 0; c < 3; c++)
        if (!isfinite(d[c]))
            return pe_fail(error, PE_ERROR_ARGUMENT, "direction is not finite");
    if (d[0] == 0 && d[1] == 0 && d[2] == 0)
        return pe_fail(error, PE_ERROR_ARGUMENT, "direction has no length");
    return PE_OK;
}

/* In whose frames brush angles turn, and whose pictures are discs. */
static int are_hemispheres(const pe_maps_info *info)
{
    return info->method == PE_METHOD_HEMISPHERES || info->method == PE_METHOD_GRADES;
}

static int have_normals(const pe_maps_info *info)
{
    return are_hemispheres(info) || info->method == PE_METHOD_REPRESENTATIVE;
}

static pe_status check_angles(const pe_maps_info *info, pe_error *error)
{
    if (info->pole_angles &&
        (!are_hemispheres(info) || info->angles != 1 || info->pole_angles < PE_MAPS_ANGLES_MIN ||
         info->pole_angles > PE_MAPS_ANGLES_MAX || !(info->pole_cosine > 0 && info->pole_cosine < 1)))
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "%d angles at normals within a cosine of %g of the brush direction are out of range",
                       info->pole_angles, info->pole_cosine);
    if (info->angles == 1)
        return PE_OK;
    if (!are_hemispheres(info))
        return pe_fail(error, PE_ERROR_ARGUMENT, "angles %d: only hemispheres can have more than 1", info->angles);
    if (info->angles < PE_MAPS_ANGLES_MIN || info->angles > PE_MAPS_ANGLES_MAX)
        return pe_fail(error, PE_ERROR_ARGUMENT, "angles %d is out of range; give 1, or %d to %d", info->angles,
                       PE_MAPS_ANGLES_MIN, PE_MAPS_ANGLES_MAX);
    return PE_OK;
}

/* An atlas has room for a few more hemispheres than there are. */
size_t pe_maps_stored_texels(const pe_maps_info *info)
{
    size_t texels = (size_t)info->width * (size_t)info->height;
    pe_atlas atlas;

    if (info->method != PE_METHOD_HEMISPHERES && info->method != PE_METHOD_VOXELS)
        return texels * (size_t)info->images;
    atlas = pe_atlas_of(info->images / info->angles, info->width, info->height);
    return texels * (size_t)(atlas.rows * atlas.columns) * (size_t)info->angles;
}

static pe_status check_size(const pe_maps_info *info, pe_error *error)
{
    int least = are_hemispheres(info) ? PE_DISC_SIDE_MIN : 2;

    if (info->width < least || info->height < least || info->width > PE_MAPS_SIDE_MAX ||
        info->height > PE_MAPS_SIDE_MAX)
        return pe_fail(error, PE_ERROR_ARGUMENT, "size %d x %d is out of range; each side lies between %d and %d",
                       info->width, info->height, least, PE_MAPS_SIDE_MAX);
    if (info->method != PE_METHOD_GRADES && pe_maps_stored_texels(info) > PE_MAPS_TEXELS_MAX)
        return pe_fail(error, PE_ERROR_LIMIT,
                       "%d maps of %d x %d are more than can be held; make them fewer, or smaller than %zu texels each",
                       info->images, info->width, info->height, PE_MAPS_TEXELS_MAX / (size_t)info->images);
    return PE_OK;
}

static pe_status count_hemispheres(pe_maps_info *info, pe_error *error)
{
    int poles = 0;
    pe_status status = PE_OK;

    if (info->pole_angles)
        status = pe_poles_count(info->frequency, info->direction, info->pole_cosine, &poles, error);
    info->images = info->normals * info->angles + poles * (info->pole_angles - 1);
    return status;
}

static pe_status count_images(pe_maps_info *info, pe_error *error)
{
    if (!have_normals(info))
        info->normals = 0;
    info->frequency = pe_geodesic_frequency(info->normals);
    switch (info->method) {
    case PE_METHOD_DEFAULT:
    case PE_METHOD_HEMISPHERES:
        return count_hemispheres(info, error);
    case PE_METHOD_REPRESENTATIVE:
        info->images = info->normals / 2;
        break;
    case PE_METHOD_BASELINE:
        info->images = 1;
        break;
    case PE_METHOD_LAYERS:
    case PE_METHOD_GRADES:
        break;
    case PE_METHOD_VOXELS:
        info->images = info->smoothness.size;
        break;
    }
    return PE_OK;
}

static pe_status check_roughness(const pe_maps_info *info, pe_error *error)
{
    pe_status status = pe_smoothness_check(&info->smoothness, error);
    int size = info->smoothness.size;

    if (status != PE_OK)
        return status;
    if (size <= 0 || info->smoothness.window <= 0 || info->smoothness.levels <= 0)
        return pe_fail(error, PE_ERROR_ARGUMENT, "size, window or levels is 0");
    if (info->method == PE_METHOD_VOXELS && (info->width != size || info->height != size))
        return pe_fail(error, PE_ERROR_ARGUMENT, "images of %d x %d are no slices of a cube of %d voxels", info->width,
                       info->height, size);
    if (info->method == PE_METHOD_LAYERS && (info->images < PE_LAYERS_MIN || info->images > PE_LAYERS_MAX))
        return pe_fail(error, PE_ERROR_ARGUMENT, "layers %d is out of range; there are %d to %d", info->images,
                       PE_LAYERS_MIN, PE_LAYERS_MAX);
    if (info->method == PE_METHOD_LAYERS && (info->width != 2 * info->height || info->width < PE_LAYER_WIDTH_MIN))
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "size %d x %d of layers is not twice as wide as high and at least %d wide", info->width,
                       info->height, PE_LAYER_WIDTH_MIN);
    return PE_OK;
}

pe_status pe_maps_complete_info(pe_maps_info *info, pe_error *error)
{
    pe_status status = check_surface(&info->surface, error);

    if (status != PE_OK)
        return status;
    if (info->method < PE_METHOD_HEMISPHERES || info->method > PE_METHOD_GRADES)
        return pe_fail(error, PE_ERROR_ARGUMENT, "method %d is not known", (int)info->method);
    status = check_direction(info->direction, error);
    if (status == PE_OK)
        status = check_angles(info, error);
    if (status == PE_OK && have_normals(info))
        status = check_normals(info->normals, error);
    if (status == PE_OK && info->method == PE_METHOD_GRADES)
        status = pe_grades_check(info, error);
    if (status == PE_OK && pe_method_has_lambda(info->method))
        status = check_roughness(info, error);
    if (status != PE_OK)
        return status;
    status = count_images(info, error);
    return status == PE_OK ? check_size(info, error) : status;
}

void pe_maps_set_source(pe_maps_info *info, const pe_env *env)
{
    info->source_name = env->name;
    info->source_fingerprint = pe_env_fingerprint(env);
}

static pe_status allocate(pe_maps *maps, const char *source_name, const char *ndf_name, pe_error *error)
{
    pe_status status = PE_OK;

    maps->disc = (pe_disc){ maps->info.width, maps->info.height };
    if (maps->info.method == PE_METHOD_REPRESENTATIVE || maps->info.method == PE_METHOD_BASELINE)
        status = pe_grid_make(maps->info.width, maps->info.height, &maps->grid, error);
    if (status == PE_OK && maps->info.frequency && maps->info.method != PE_METHOD_GRADES)
        status = pe_geodesic_make(maps->info.frequency, &maps->geodesic, error);
    if (status == PE_OK && maps->info.method == PE_METHOD_LAYERS)
        status = pe_layers_make(maps, error);
    if (status == PE_OK && maps->geodesic && maps->info.pole_angles)
        status = pe_poles_make(maps->geodesic, maps->info.direction, maps->info.pole_cosine, &maps->poles, error);
    if (status != PE_OK)
        return status;
    maps->source_name = strdup(source_name ? source_name : "");
    maps->ndf_name = strdup(ndf_name ? ndf_name : "");
    if (maps->info.method != PE_METHOD_GRADES)
        maps->rgb = calloc(pe_maps_values(maps), sizeof *maps->rgb);
    if (!maps->source_name || !maps->ndf_name || (!maps->rgb && maps->info.method != PE_METHOD_GRADES))
        return pe_fail(error, PE_ERROR_MEMORY, "not enough memory for %d maps of %d x %d", maps->info.images,
                       maps->info.width, maps->info.height);
    maps->info.source_name = maps->source_name;
    maps->info.ndf_name = maps->ndf_name;
    return PE_OK;
}

pe_status pe_maps_create(const pe_maps_info *info, pe_maps **out, pe_error *error)
{
    pe_maps_info checked = *info;
    pe_status status = pe_maps_complete_info(&checked, error);
    pe_maps *maps;

    if (status != PE_OK)
        return status;
    maps = calloc(1, sizeof *maps);
    if (!maps)
        return pe_fail_memory(error, "maps");
    maps->info = checked;
    maps->info.format_version = PE_MAPS_FORMAT_VERSION;
    status = allocate(maps, info->source_name, info->ndf_name, error);
    if (status != PE_OK) {
        pe_maps_free(maps);
        return status;
    }
    *out = maps;
    return PE_OK;
}

void pe_maps_free(pe_maps *maps)
{
    if (!maps)
        return;
    pe_geodesic_free(maps->geodesic);
    pe_grid_free(&maps->grid);
    pe_denominator_free(maps->denominator);
    pe_layers_free(maps);
    for (int k = 0; maps->grades && k < maps->info.grades; k++)
        pe_maps_free(maps->grades[k]);
    free(maps->grades);
    pe_poles_free(&maps->poles);
    free(maps->source_name);
    free(maps->ndf_name);
    free(maps->rgb);
    free(maps->frames);
    free(maps->coefficients);
    free(maps);
}

const pe_maps_info *pe_maps_get_info(const pe_maps *maps)
{
    return &maps->info;
}

int pe_maps_have_roughness(const pe_maps *maps)
{
    return pe_method_has_lambda(maps->info.method) || maps->info.method == PE_METHOD_GRADES;
}

const float *pe_maps_image(const pe_maps *maps, int k)
{
    maps = pe_grades_find(maps, &k);
    return maps->rgb + (maps->layers ? maps->layers[k].offset : (size_t)k * pe_maps_image_values(maps));
}

void pe_maps_image_size(const pe_maps *maps, int k, int *width, int *height)
{
    maps = pe_grades_find(maps, &k);
    *width = maps->layers ? maps->layers[k].width : maps->info.width;
    *height = maps->layers ? maps->layers[k].height : maps->info.height;
}

double pe_maps_image_exponent(const pe_maps *maps, int k)
{
    return maps->layers ? maps->layers[k].exponent : 0;
}

size_t pe_maps_values(const pe_maps *maps)
{
    const pe_layer *last = maps->layers ? &maps->layers[maps->info.images - 1] : NULL;
    size_t values = 0;

    for (int k = 0; k < maps->info.grades; k++)
        values += pe_maps_values(maps->grades[k]);
    if (values)
        return values;
    return last ? last->offset + 3 * (size_t)last->width * (size_t)last->height
                : (size_t)maps->info.images * pe_maps_image_values(maps);
}

void pe_maps_normal(const pe_maps *maps, int k, double n[3])
{
    static const double up[3] = { 0, 1, 0 };
    int vertex, angle;

    maps = pe_grades_find(maps, &k);
    vertex = 2 * k;
    if (maps->info.method == PE_METHOD_HEMISPHERES)
        pe_maps_place_of(maps, k, &vertex, &angle);
    memcpy(n, maps->geodesic ? pe_geodesic_vertex(maps->geodesic, vertex) : up, 3 * sizeof *n);
}

/* ---- hemispheres ---- */

void pe_maps_frame(const pe_maps *maps, int k, pe_frame *frame)
{
    int vertex, angle;
    double turn;
    pe_frame still;

    pe_maps_place_of(maps, k, &vertex, &angle);
    turn = pe_maps_turn(&maps->info) * angle / pe_maps_angles_at(maps, vertex);
    pe_frame_make(pe_geodesic_vertex(maps->geodesic, vertex), maps->info.direction, &still);
    *frame = still;
    for (int c = 0; c < 3; c++) {
        frame->t[c] = cos(turn) * still.t[c] + sin(turn) * still.b[c];
        frame->b[c] = cos(turn) * still.b[c] - sin(turn) * still.t[c];
    }
}

static void set_frames(pe_maps *maps)
{
    for (int vertex = 0; vertex < maps->info.normals; vertex++) {
        pe_frame frame;

        pe_maps_frame(maps, pe_maps_image_at(maps, vertex, 0), &frame);
        for (int c = 0; c < 3; c++) {
            maps->frames[vertex][c][0] = (float)frame.t[c];
            maps->frames[vertex][c][1] = (float)frame.b[c];
            maps->frames[vertex][c][2] = (float)frame.n[c];
            maps->frames[vertex][c][3] = 0;
        }
    }
}

static void set_turns(pe_maps *maps)
{
    int angles = maps->info.pole_angles ? maps->info.pole_angles : maps->info.angles;

    for (int k = 0; k < angles; k++) {
        double angle = pe_maps_turn(&maps->info) * k / angles;

        maps->turns[k][0] = (float)cos(angle);
        maps->turns[k][1] = (float)sin(angle);
    }
}

static void set_coefficients(size_t image, void *data)
{
    pe_maps *maps = data;
    size_t values = pe_maps_image_values(maps);
    float *coefficients = maps->coefficients + image * values;

    memcpy(coefficients, maps->rgb + image * values, values * sizeof *coefficients);
    pe_spline_coefficients(coefficients, maps->info.width, maps->info.height, 3);
}

/* Lookups go everywhere in the splines, some tens of megabytes: on large pages where the system has them, which spares
 * the processor half of its page walks. */
static float *allocate_coefficients(size_t count)
{
    const size_t page = (size_t)2 << 20;
    size_t bytes = (count * sizeof(float) + page - 1) / page * page;
    float *coefficients = aligned_alloc(page, bytes);

#ifdef MADV_HUGEPAGE
    if (coefficients && bytes > page)
        madvise(coefficients, bytes, MADV_HUGEPAGE); /* advice only */
#endif
    return coefficients;
}

pe_status pe_maps_finish(pe_maps *maps, int threads, pe_error *error)
{
    size_t normals = (size_t)maps->info.normals;

    if (maps->info.method == PE_METHOD_LAYERS)
        return pe_layers_finish(maps, threads, error);
    if (maps->info.method == PE_METHOD_GRADES)
        return pe_grades_finish(maps, threads, error);
    if (maps->info.method != PE_METHOD_HEMISPHERES)
        return PE_OK;
    maps->info.suns = maps->suns.count;
    maps->frames = malloc(normals * sizeof *maps->frames);
    maps->coefficients = allocate_coefficients((size_t)maps->info.images * pe_maps_image_values(maps) + 1);
    if (!maps->frames || !maps->coefficients)
        return pe_fail_memory(error, "the splines through the maps");
    maps->coefficients[(size_t)maps->info.images * pe_maps_image_values(maps)] = 0;
    set_frames(maps);
    set_turns(maps);
    pe_parallel_for((size_t)maps->info.images, threads, set_coefficients, maps, NULL);
    return maps->suns.count ? pe_denominator_make(&maps->info.surface.ndf, &maps->denominator, error) : PE_OK;
}
