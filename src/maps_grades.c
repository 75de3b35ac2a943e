/* maps_grades.c - hemispheres of several roughnesses, a constant factor from one to the next. */
#include "maps.h"
#include "parallel.h"
#include "status.h"

#include <stdlib.h>
#include <string.h>

/* From the smoothest grade to the roughest, a factor at least this large. */
#define RANGE_MIN 1.1

static double range_of(const pe_maps_info *info)
{
    return info->alpha_max / info->surface.ndf.alpha_x;
}

double pe_grades_place(const pe_maps_info *info, double alpha)
{
    double place = log(fmax(alpha / info->surface.ndf.alpha_x, 1)) / log(range_of(info));

    return fmin(place, 1) * (info->grades - 1);
}

double pe_grades_alpha(const pe_maps_info *info, double place)
{
    return info->surface.ndf.alpha_x * pow(range_of(info), place / (info->grades - 1));
}

pe_ndf pe_grades_ndf(const pe_ndf *smoothest, double alpha_max, double alpha)
{
    pe_ndf ndf = *smoothest;
    double factor = fmin(fmax(alpha / ndf.alpha_x, 1), alpha_max / ndf.alpha_x);

    ndf.alpha_x *= factor;
    ndf.alpha_y *= factor;
    return ndf;
}

pe_status pe_grades_check(const pe_maps_info *info, pe_error *error)
{
    pe_surface roughest = info->surface;

    if (info->surface.ndf.kind == PE_NDF_TABLE)
        return pe_fail(error, PE_ERROR_ARGUMENT,
                       "a measured distribution has one roughness, its own, and cannot be baked in grades");
    if (info->grades < PE_GRADES_MIN || info->grades > PE_GRADES_MAX)
        return pe_fail(error, PE_ERROR_ARGUMENT, "grades %d are out of range; there are %d to %d", info->grades,
                       PE_GRADES_MIN, PE_GRADES_MAX);
    if (!(range_of(info) > RANGE_MIN - 1e-9 && info->alpha_max <= PE_ALPHA_MAX))
        return pe_fail(
            error, PE_ERROR_ARGUMENT,
            "alpha %g to %g is no range; the roughest is at least %g times the smoothest, and at most %g itself",
            info->surface.ndf.alpha_x, info->alpha_max, RANGE_MIN, PE_ALPHA_MAX);
    roughest.ndf.alpha_y *= range_of(info);
    roughest.ndf.alpha_x = info->alpha_max;
    return pe_surface_check(&roughest, error);
}

/* What grade k is, of its own normals, size and angles at the poles. */
static pe_status complete_grade(const pe_maps_info *info, int k, const pe_maps_info *its, pe_maps_info *grade,
                                pe_error *error)
{
    *grade = *info;
    grade->method = PE_METHOD_HEMISPHERES;
    grade->surface.ndf = pe_grades_ndf(&info->surface.ndf, info->alpha_max, pe_grades_alpha(info, k));
    grade->grades = 0;
    grade->alpha_max = 0;
    grade->normals = its->normals;
    grade->width = its->width;
    grade->height = its->height;
    grade->pole_angles = its->pole_angles;
    grade->pole_cosine = its->pole_cosine;
    grade->lookup_error = its->lookup_error;
    return pe_maps_complete_info(grade, error);
}

/* Completes them all and what the whole has of them; before any memory is taken. */
static pe_status complete(pe_maps_info *info, const pe_maps_info *each, pe_maps_info *grades, pe_error *error)
{
    pe_status status = pe_grades_check(info, error);
    size_t texels = 0;

    info->images = 0;
    for (int k = 0; k < info->grades && status == PE_OK; k++) {
        status = complete_grade(info, k, &each[k], &grades[k], error);
        if (status != PE_OK)
            break;
        info->images += grades[k].images;
        texels += pe_maps_stored_texels(&grades[k]);
    }
    if (status == PE_OK && texels > PE_MAPS_TEXELS_MAX)
        status = pe_fail(error, PE_ERROR_LIMIT, "%d grades of %d maps are more than can be held", info->grades,
                         info->images);
    if (status != PE_OK)
        return status;
    info->normals = grades[0].normals;
    info->width = grades[0].width;
    info->height = grades[0].height;
    info->pole_angles = grades[0].pole_angles;
    info->pole_cosine = grades[0].pole_cosine;
    return PE_OK;
}

pe_status pe_grades_create(const pe_maps_info *info, const pe_maps_info *each, pe_maps **out, pe_error *error)
{
    pe_maps_info whole = *info, grades[PE_GRADES_MAX];
    pe_maps *maps;
    pe_status status = complete(&whole, each, grades, error);

    if (status == PE_OK)
        status = pe_maps_create(&whole, &maps, error);
    if (status != PE_OK)
        return status;
    maps->grades = calloc((size_t)whole.grades, sizeof(pe_maps *));
    if (!maps->grades)
        status = pe_fail_memory(error, "grades");
    for (int k = 0; k < whole.grades && status == PE_OK; k++)
        status = pe_maps_create(&grades[k], &maps->grades[k], error);
    if (status == PE_OK)
        *out = maps;
    else
        pe_maps_free(maps);
    return status;
}

/* ---- before the first lookup ---- */

/* Suns are of all grades, and what they are divided by is of each. */
static int make_denominator(size_t k, void *data)
{
    const pe_maps *maps = data;
    pe_maps *grade = maps->grades[k];

    return pe_denominator_make(&grade->info.surface.ndf, &grade->denominator, NULL) == PE_OK;
}

pe_status pe_grades_finish(pe_maps *maps, int threads, pe_error *error)
{
    pe_status status = PE_OK;

    maps->info.suns = maps->suns.count;
    for (int k = 0; k < maps->info.grades && status == PE_OK; k++)
        if (!maps->grades[k]->coefficients)
            status = pe_maps_finish(maps->grades[k], threads, error);
    if (status == PE_OK && maps->suns.count && maps->info.surface.weight == PE_WEIGHT_NDF)
        status = pe_parallel_try((size_t)maps->info.grades, threads, make_denominator, maps, NULL,
                                 "the weights of a lobe", error);
    return status;
}

/* ---- what they hold ---- */

const pe_maps *pe_grades_find(const pe_maps *maps, int *k)
{
    int grade = 0;

    if (!maps->grades)
        return maps;
    for (; grade < maps->info.grades - 1 && *k >= maps->grades[grade]->info.images; grade++)
        *k -= maps->grades[grade]->info.images;
    return maps->grades[grade];
}

const pe_maps *pe_maps_grade(const pe_maps *maps, int k)
{
    return maps->grades && k >= 0 && k < maps->info.grades ? maps->grades[k] : NULL;
}

void pe_maps_surface(const pe_maps *maps, double roughness, pe_surface *surface)
{
    *surface = maps->info.surface;
    if (maps->grades)
        surface->ndf = pe_grades_ndf(&maps->info.surface.ndf, maps->info.alpha_max, roughness);
}
