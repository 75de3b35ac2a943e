/* bake_frames.c - several environments at once. */
#include "bake.h"

#include "estimate.h"
#include "hemispheres_strip.h"
#include "pairs_strip.h"
#include "shrink.h"
#include "status.h"
#include "strip.h"
#include "suns.h"

_Static_assert(PE_FRAMES_MAX == PE_STRIP_FRAMES, "as many frames at once as a strip has");

/* What the frames of one bake share. */
typedef struct frames {
    const pe_baker *baker;
    int count;
    const pe_env *fine[PE_FRAMES_MAX]; /* the environments as they came */
    pe_env *shrunk[PE_FRAMES_MAX];     /* or NULL */
    pe_env *rest[PE_FRAMES_MAX];       /* without suns */
    pe_suns suns[PE_FRAMES_MAX];
    pe_maps **maps;
    pe_stage stage;
    pe_report report; /* on the stage */
} frames;

static const pe_env *env_of(const frames *f, int k)
{
    return f->shrunk[k] ? f->shrunk[k] : f->fine[k];
}

static pe_status make_rest(frames *f, pe_error *error)
{
    pe_status status = PE_OK;

    for (int k = 0; k < f->count && status == PE_OK; k++) {
        status = pe_baker_shrink(f->baker, f->fine[k], &f->shrunk[k], error);
        if (status == PE_OK)
            status =
                pe_suns_draw_out(env_of(f, k), f->fine[k], &f->baker->info.surface, &f->suns[k], &f->rest[k], error);
    }
    return status;
}

static pe_status make_maps(frames *f, pe_error *error)
{
    pe_status status = PE_OK;

    for (int k = 0; k < f->count && status == PE_OK; k++) {
        pe_maps_info info = f->baker->info;

        pe_maps_set_source(&info, f->fine[k]);
        status = pe_maps_create(&info, &f->maps[k], error);
        if (status == PE_OK) {
            f->maps[k]->info.surface.ndf.table = NULL; /* the caller's, who may free it */
            f->maps[k]->suns = f->suns[k];
            f->maps[k]->info.suns = info.method == PE_METHOD_HEMISPHERES ? f->suns[k].count : 0;
        }
    }
    return status;
}

/* A tile's side beside the lobe's finest feature, for an error of TILE_ERROR, which goes with its third power. */
#define TILE_SIDE 0.5
#define TILE_ERROR 0.002

static double tile_side(const pe_baker *b)
{
    double fineness[2];

    pe_ndf_fineness(&b->info.surface.ndf, fineness);
    return TILE_SIDE * fmin(fineness[0], fineness[1]) * cbrt(fmin(b->info.error_wanted / TILE_ERROR, 1));
}

static pe_status fill_maps(frames *f, pe_error *error)
{
    const pe_baker *b = f->baker;
    pe_strip strip;
    pe_status status = pe_strip_make((const pe_env *const *)f->rest, f->count, tile_side(b), &strip, error);

    if (status != PE_OK)
        return status;
    if (b->info.method == PE_METHOD_HEMISPHERES)
        status =
            pe_fill_hemispheres_of_strip(&strip, b->lobe, b->kernel, b->options.threads, &f->report, f->maps, error);
    else
        status =
            pe_fill_pairs_of_strip(&strip, b->kernel, b->lobe, f->suns, b->options.threads, &f->report, f->maps, error);
    pe_strip_free(&strip);
    return status;
}

#define ESTIMATE_SHARE 0.25 /* of the time of a few frames, to look at the errors of one */

static pe_status record_errors(frames *f, const pe_bake_errors *known, pe_error *error)
{
    pe_bake_errors errors = { 0, 0 };

    if (known) {
        errors = *known;
    } else {
        pe_maps_info *info = &f->maps[0]->info;
        int threads = f->baker->options.threads;
        pe_status status = pe_maps_finish(f->maps[0], threads, error);

        f->report = pe_stage_begin(&f->stage, ESTIMATE_SHARE);
        if (status == PE_OK)
            status = pe_estimate_errors(env_of(f, 0), f->maps[0], f->baker->lobe, threads, &f->report, error);
        if (status != PE_OK)
            return status;
        errors = (pe_bake_errors){ info->error_estimate, info->lookup_error };
    }
    for (int k = 0; k < f->count; k++) {
        f->maps[k]->info.error_estimate = errors.texels;
        f->maps[k]->info.lookup_error = errors.lookups;
    }
    return PE_OK;
}

static pe_status bake_one_by_one(frames *f, const pe_bake_errors *known, pe_error *error)
{
    pe_status status = PE_OK;
    pe_bake_errors first;

    for (int k = 0; k < f->count && status == PE_OK; k++) {
        status = pe_baker_bake(f->baker, f->fine[k], known, &f->maps[k], error);
        if (status == PE_OK && !known) {
            first = (pe_bake_errors){ f->maps[0]->info.error_estimate, f->maps[0]->info.lookup_error };
            known = &first;
        }
    }
    return status;
}

/* The strip, and the maps with their splines. */
#define BYTES_MAX 1e9

static int fit_a_strip(const frames *f)
{
    const pe_maps_info *info = &f->baker->info;
    double values = 3.0 * info->images * info->width * info->height;

    return pe_strip_bytes(f->rest[0]->width, f->rest[0]->height) + 2 * f->count * values * sizeof(float) < BYTES_MAX;
}

static pe_status bake_together(frames *f, const pe_bake_errors *known, pe_error *error)
{
    pe_status status = make_maps(f, error);

    f->report = pe_stage_begin(&f->stage, known ? 1 : 1 - ESTIMATE_SHARE);
    if (status == PE_OK)
        status = fill_maps(f, error);
    if (status == PE_OK)
        status = record_errors(f, known, error);
    if (status == PE_ERROR_CANCELLED)
        pe_fail(error, status, "cancelled");
    return status;
}

static pe_status bake_by_kernel(frames *f, const pe_bake_errors *known, pe_error *error)
{
    pe_status status = make_rest(f, error);

    if (status == PE_OK)
        status = fit_a_strip(f) ? bake_together(f, known, error) : bake_one_by_one(f, known, error);
    for (int k = 0; k < f->count; k++) {
        pe_env_free(f->shrunk[k]);
        pe_env_free(f->rest[k]);
    }
    return status;
}

static pe_status check_frames(const pe_baker *b, const pe_env *const *envs, int count, pe_error *error)
{
    pe_status status = PE_OK;

    if (count < 1 || count > PE_FRAMES_MAX)
        return pe_fail(error, PE_ERROR_ARGUMENT, "%d frames at once are out of range; give 1 to %d", count,
                       PE_FRAMES_MAX);
    for (int k = 0; k < count && status == PE_OK; k++)
        status = pe_baker_check_size(b, envs[k], error);
    return status;
}

/* The maps become the caller's, or, for a reason, nobody's. */
static pe_status hand_out(pe_maps *const *made, int count, pe_status why, pe_maps **maps)
{
    for (int k = 0; k < count; k++)
        if (why == PE_OK)
            maps[k] = made[k];
        else
            pe_maps_free(made[k]);
    return why;
}

pe_status pe_baker_bake_pictures(const pe_baker *b, const pe_env *const *envs, int count, const pe_bake_errors *errors,
                                 pe_maps **maps, pe_error *error)
{
    pe_maps *made[PE_FRAMES_MAX] = { NULL };
    frames f = { .baker = b, .count = count, .maps = made, .stage = { &b->options, 0, 0 } };
    pe_status status = check_frames(b, envs, count, error);

    if (status != PE_OK)
        return status;
    for (int k = 0; k < count; k++)
        f.fine[k] = envs[k];
    status = b->kernel ? bake_by_kernel(&f, errors, error) : bake_one_by_one(&f, errors, error);
    return hand_out(made, count, status, maps);
}

static pe_status finish(const pe_baker *b, pe_maps *maps, pe_error *error)
{
    int is_finished = maps->info.method != PE_METHOD_HEMISPHERES || maps->coefficients;

    return is_finished ? PE_OK : pe_maps_finish(maps, b->options.threads, error);
}

pe_status pe_baker_bake_frames(const pe_baker *b, const pe_env *const *envs, int count, const pe_bake_errors *errors,
                               pe_maps **maps, pe_error *error)
{
    pe_maps *made[PE_FRAMES_MAX] = { NULL };
    pe_status status = pe_baker_bake_pictures(b, envs, count, errors, made, error);

    if (status != PE_OK)
        return status;
    for (int k = 0; k < count && status == PE_OK; k++)
        status = finish(b, made[k], error);
    return hand_out(made, count, status, maps);
}
