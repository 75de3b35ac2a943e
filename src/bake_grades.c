/* bake_grades.c - hemispheres of several roughnesses: a baker for each, suns that are drawn out once for all. */
#include "bake.h"

#include "choose.h"
#include "estimate.h"
#include "status.h"

#include <stdlib.h>

static pe_maps_info describe(const pe_bake_options *options, int width, int height)
{
    pe_maps_info info = pe_describe_bake(options, width, height);

    info.alpha_max = options->alpha_max == 0 ? PE_GRADES_ALPHA_MAX : options->alpha_max;
    if (info.surface.ndf.alpha_x == 0 && info.surface.ndf.alpha_y == 0)
        info.surface.ndf.alpha_x = info.surface.ndf.alpha_y = PE_GRADES_ALPHA_MIN;
    return info;
}

/* A baker of one roughness, as if its normals and size had been asked for. */
static pe_status make_grade(const pe_baker *b, const pe_maps_info *its, pe_baker **out, pe_error *error)
{
    pe_bake_options options = b->options;

    options.method = PE_METHOD_HEMISPHERES;
    options.surface = its->surface;
    options.normals = its->normals;
    options.width = its->width;
    options.height = its->height;
    options.accuracy = b->info.accuracy;
    return pe_baker_make(&options, b->info.source_width, b->info.source_height, out, error);
}

/* Their bakers know what became of what was chosen. */
static pe_status make_grades(pe_baker *b, const pe_maps_info *each, pe_error *error)
{
    pe_status status = PE_OK;

    b->grades = calloc((size_t)b->info.grades, sizeof(pe_baker *));
    if (!b->grades)
        return pe_fail_memory(error, "grades");
    b->info.images = 0;
    for (int k = 0; k < b->info.grades && status == PE_OK; k++) {
        status = make_grade(b, &each[k], &b->grades[k], error);
        if (status == PE_OK)
            b->info.images += b->grades[k]->info.images;
    }
    return status;
}

/* Is what was asked for possible, whatever is chosen for the rest? */
static pe_status check(const pe_bake_options *options, const pe_maps_info *info, pe_error *error)
{
    pe_maps_info trial = *info;

    trial.grades = options->layers ? options->layers : PE_GRADES_MIN;
    trial.normals = info->normals ? info->normals : 12;
    trial.width = info->width ? info->width : PE_DISC_SIDE_MIN;
    trial.height = info->height ? info->height : PE_DISC_SIDE_MIN;
    return pe_maps_complete_info(&trial, error);
}

pe_status pe_baker_prepare_grades(pe_baker *b, double aim, int width, int height, pe_error *error)
{
    pe_maps_info each[PE_GRADES_MAX];
    pe_status status;

    b->info = describe(&b->options, width, height);
    status = check(&b->options, &b->info, error);
    if (status != PE_OK)
        return status;
    status = pe_choose_grades(&b->options, aim, &b->info, each, error);
    if (status == PE_OK)
        status = make_grades(b, each, error);
    if (status != PE_OK)
        return status;
    b->info.normals = each[0].normals;
    b->info.width = each[0].width;
    b->info.height = each[0].height;
    b->info.pole_angles = b->grades[0]->info.pole_angles;
    b->info.pole_cosine = b->grades[0]->info.pole_cosine;
    return pe_maps_complete_info(&b->info, error);
}

void pe_baker_free_grades(pe_baker *b)
{
    for (int k = 0; b->grades && k < b->info.grades; k++)
        pe_baker_free(b->grades[k]);
    free(b->grades);
}

/* ---- one environment ---- */

/* What the grades of one bake share: the environment as fine as the smoothest needs it, and that without suns. */
typedef struct job {
    const pe_baker *baker;
    const pe_env *env;
    pe_env *shrunk, *rest;
    const pe_bake_errors *known;
    pe_maps *maps;
    pe_stage stage;
} job;

/* The environment of a grade, which is `env` itself if *shrunk is NULL then. */
static pe_status shrink(const job *j, int grade, const pe_env *env, pe_env **shrunk, pe_error *error)
{
    *shrunk = NULL;
    if (j->baker->info.accuracy == PE_ACCURACY_EXACT)
        return PE_OK;
    return pe_baker_shrink(j->baker->grades[grade], env, shrunk, error);
}

/* Of the time of a bake; the rest is that of looking at errors. */
#define FILL_SHARE 0.7

/* Whether there are suns is asked for the smoothest surface whose lobe is as wide as a texel: one that is smoother, for
 * which alone they would be left where they are, goes without harm by what is right for the rest. */
static pe_status draw_out_suns(job *j, pe_suns *suns, pe_error *error)
{
    const pe_maps_info *info = &j->baker->info;
    const pe_ndf *ndf = &info->surface.ndf;
    pe_surface surface = info->surface;
    const pe_env *env;
    double texel;
    pe_status status = shrink(j, 0, j->env, &j->shrunk, error);

    if (status != PE_OK)
        return status;
    env = j->shrunk ? j->shrunk : j->env;
    texel = 2 * M_PI / env->width;
    surface.ndf = pe_grades_ndf(ndf, info->alpha_max, texel * 1.001 * fmax(ndf->alpha_x / ndf->alpha_y, 1));
    return pe_suns_draw_out(env, j->env, &surface, suns, &j->rest, error);
}

static pe_status create_maps(job *j, const pe_suns *suns, pe_error *error)
{
    pe_maps_info info = j->baker->info, each[PE_GRADES_MAX];
    pe_status status;

    pe_maps_set_source(&info, j->env);
    for (int k = 0; k < info.grades; k++)
        each[k] = j->baker->grades[k]->info;
    status = pe_grades_create(&info, each, &j->maps, error);
    if (status == PE_OK)
        j->maps->suns = *suns;
    return status;
}

/* Errors of texels are looked at where there are no suns, which texels do not hold. */
static pe_status fill_grade(job *j, int k, pe_report *report, pe_error *error)
{
    const pe_baker *grade = j->baker->grades[k];
    pe_maps *maps = j->maps->grades[k];
    pe_env *shrunk;
    pe_status status = shrink(j, k, j->rest, &shrunk, error);

    if (status != PE_OK)
        return status;
    status = pe_baker_fill(grade, shrunk ? shrunk : j->rest, report, maps, error);
    if (status == PE_OK && !j->known)
        status = pe_estimate_texels(shrunk ? shrunk : j->rest, maps, grade->lobe, grade->options.threads, error);
    pe_env_free(shrunk);
    return status;
}

static pe_status fill_grades(job *j, double share, pe_error *error)
{
    pe_status status = PE_OK;

    for (int k = 0; k < j->baker->info.grades && status == PE_OK; k++) {
        pe_report report = pe_stage_begin(&j->stage, share / j->baker->info.grades);

        status = fill_grade(j, k, &report, error);
    }
    return status;
}

/* Lookups whose roughness is nearest to a grade see the environment as it did. */
static pe_status look_at_errors(job *j, pe_report *report, pe_error *error)
{
    int grades = j->baker->info.grades;
    pe_estimate sum = { 0, 0 };
    double texels2 = 0;
    pe_status status = PE_OK;

    for (int k = 0; k < grades && status == PE_OK; k++) {
        pe_maps_info *info = &j->maps->grades[k]->info;
        pe_estimate its = { 0, 0 };
        pe_env *shrunk;

        status = shrink(j, k, j->env, &shrunk, error);
        if (status != PE_OK)
            break;
        status =
            pe_estimate_grade(shrunk ? shrunk : j->env, j->maps, k, j->baker->options.threads, report, &its, error);
        pe_env_free(shrunk);
        info->lookup_error = its.norm2 > 0 ? sqrt(its.error2 / its.norm2) : 0;
        texels2 += info->error_estimate * info->error_estimate / grades;
        sum.error2 += its.error2;
        sum.norm2 += its.norm2;
    }
    j->maps->info.lookup_error = sum.norm2 > 0 ? sqrt(sum.error2 / sum.norm2) : 0;
    j->maps->info.error_estimate = sqrt(texels2);
    return status;
}

static pe_status record_errors(job *j, pe_error *error)
{
    if (!j->known) {
        pe_report report = pe_stage_begin(&j->stage, 1 - FILL_SHARE);

        report.total = PE_ESTIMATE_FRAMES;
        return look_at_errors(j, &report, error);
    }
    j->maps->info.error_estimate = j->known->texels;
    j->maps->info.lookup_error = j->known->lookups;
    return PE_OK;
}

static pe_status run(job *j, pe_error *error)
{
    pe_suns suns;
    pe_status status = draw_out_suns(j, &suns, error);

    if (status == PE_OK)
        status = create_maps(j, &suns, error);
    if (status == PE_OK)
        status = fill_grades(j, j->known ? 1 : FILL_SHARE, error);
    if (status == PE_OK)
        status = pe_maps_finish(j->maps, j->baker->options.threads, error);
    return status == PE_OK ? record_errors(j, error) : status;
}

pe_status pe_baker_bake_grades(const pe_baker *b, const pe_env *env, const pe_bake_errors *known, pe_maps **out,
                               pe_error *error)
{
    job j = { .baker = b, .env = env, .known = known, .stage = { &b->options, 0, 0 } };
    pe_status status = run(&j, error);

    if (status == PE_ERROR_CANCELLED)
        pe_fail(error, status, "cancelled");
    pe_env_free(j.shrunk);
    pe_env_free(j.rest);
    if (status == PE_OK)
        *out = j.maps;
    else
        pe_maps_free(j.maps);
    return status;
}
