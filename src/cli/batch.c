/* batch.c - see batch.h. */
#include "batch.h"

#include "cli.h"
#include "interrupt.h"
#include "status.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

/* Of so many frames made, one has its errors estimated, which takes as long as a good part of its bake. */
#define ESTIMATE_EVERY 16

static int draw_progress(double fraction, void *data)
{
    batch *b = data;

    progress_draw(&b->bar, (b->made + fraction) / (b->count - b->left));
    return 0;
}

static int fail(batch *b, const pe_error *error)
{
    progress_clear(&b->bar);
    cli_error("bake", "%s", error->message);
    return CLI_FAILURE;
}

/* ---- bake and write ---- */

static pe_status make_baker(batch *b, const pe_env *env, pe_error *error)
{
    if (b->baker)
        return PE_OK;
    b->options.progress = progress_is_visible() && !b->quiet ? draw_progress : NULL;
    b->options.progress_data = b;
    progress_begin(&b->bar);
    return pe_baker_make(&b->options, pe_env_width(env), pe_env_height(env), &b->baker, error);
}

static pe_status bake(batch *b, const pe_env *env, pe_error *error)
{
    int is_known = b->made % ESTIMATE_EVERY != 0;
    pe_status status = pe_baker_bake(b->baker, env, is_known ? &b->errors : NULL, &b->maps, error);

    if (status != PE_OK)
        return status;
    b->errors.texels = fmax(b->errors.texels, pe_maps_get_info(b->maps)->error_estimate);
    b->errors.lookups = fmax(b->errors.lookups, pe_maps_get_info(b->maps)->lookup_error);
    return status;
}

/* Half floats unless floats are asked for or needed: a bake that took minutes is not thrown away for a bright sun. */
static pe_status write_maps(batch *b, const char *output, pe_error *error)
{
    pe_status status = pe_maps_write(b->maps, output, b->pixels, error);

    if (b->pixels == PE_PIXEL_FLOAT || status != PE_ERROR_LIMIT)
        return status;
    status = pe_maps_write(b->maps, output, PE_PIXEL_FLOAT, error);
    if (status == PE_OK && !b->quiet) {
        progress_clear(&b->bar);
        cli_warning("bake", "%s: brighter than half floats can hold (65504): written as with --float", output);
    }
    return status;
}

/* What was asked for may take more memory than the choice may, or a harder environment than it knows. */
static void warn_of_error(batch *b, const char *output)
{
    const pe_maps_info *info = pe_maps_get_info(b->maps);
    int of_lookups = info->method == PE_METHOD_HEMISPHERES; /* of lat-long maps only texels are measured */
    double wanted = b->options.error, reached = of_lookups ? info->lookup_error : info->error_estimate;

    if (b->quiet || b->made > 0 || !(wanted > 0 && reached > wanted))
        return;
    progress_clear(&b->bar);
    cli_warning("bake", "%s: the error of %s is %.2g %%, not the %.2g %% asked for; %s", output,
                of_lookups ? "lookups" : "texels", 100 * reached, 100 * wanted,
                of_lookups ? "give more --normals, and a larger --size" : "--exact has none");
}

static int bake_file(batch *b, const pe_env *env, const char *environment, const char *output)
{
    pe_status status;
    pe_error error;

    pe_maps_free(b->maps);
    b->maps = NULL;
    b->repairs = pe_env_repairs(env);
    if (!b->quiet && *pe_env_remark(env)) {
        progress_clear(&b->bar);
        cli_warn_of_flaws("bake", environment, env);
    }
    status = bake(b, env, &error);
    if (status != PE_OK)
        return fail(b, &error);
    interrupt_hold(output);
    status = write_maps(b, output, &error);
    interrupt_release();
    if (status != PE_OK)
        return fail(b, &error);
    warn_of_error(b, output);
    b->made++;
    return CLI_SUCCESS;
}

/* ---- what is there already ---- */

static int is_same_surface(const pe_maps_info *a, const pe_maps_info *b)
{
    const pe_surface *x = &a->surface, *y = &b->surface;

    return x->ndf.kind == y->ndf.kind && x->ndf.alpha_x == y->ndf.alpha_x && x->ndf.alpha_y == y->ndf.alpha_y &&
           strcmp(a->ndf_name, b->ndf_name) == 0 && x->weight == y->weight &&
           memcmp(x->eta, y->eta, sizeof x->eta) == 0 && memcmp(x->k, y->k, sizeof x->k) == 0;
}

static int is_same_bake(const pe_maps_info *a, const pe_maps_info *b)
{
    return is_same_surface(a, b) && a->method == b->method && a->normals == b->normals && a->angles == b->angles &&
           a->width == b->width && a->height == b->height && a->accuracy == b->accuracy &&
           a->error_wanted == b->error_wanted && a->source_width == b->source_width &&
           a->source_height == b->source_height && memcmp(a->direction, b->direction, sizeof a->direction) == 0;
}

/* A file that is not there is not newer. */
static int is_newer(const char *path, const struct stat *than)
{
    struct stat about;

    if (!path || stat(path, &about) != 0)
        return 0;
    return about.st_mtim.tv_sec != than->st_mtim.tv_sec ? about.st_mtim.tv_sec > than->st_mtim.tv_sec
                                                        : about.st_mtim.tv_nsec > than->st_mtim.tv_nsec;
}

static int is_made(const batch *b, const char *environment, const char *output)
{
    const pe_maps_info *info;
    struct stat about;
    pe_maps *maps;
    int made;

    if (stat(output, &about) != 0 || !S_ISREG(about.st_mode) || is_newer(environment, &about) ||
        is_newer(b->measured, &about) || pe_maps_read(output, &maps, NULL) != PE_OK)
        return 0;
    info = pe_maps_get_info(maps);
    made = is_same_bake(info, pe_baker_get_info(b->baker)) && strcmp(info->source_name, pe_base_name(environment)) == 0;
    pe_maps_free(maps);
    return made;
}

/* ---- a frame ---- */

typedef int can_stay(const batch *b, const char *environment, const char *output);

static int never(const batch *b, const char *environment, const char *output)
{
    (void)b;
    (void)environment;
    (void)output;
    return 0;
}

/* The first environment says for which size the baker is to be; after it, what can stay is not read. */
static int make_unless(can_stay *stays, batch *b, const char *environment, const char *output)
{
    pe_error error;
    pe_env *env;
    int result;

    if (b->baker && stays(b, environment, output)) {
        b->left++;
        return CLI_SUCCESS;
    }
    if (cli_read_environment(environment, &env, &error) != PE_OK)
        return fail(b, &error);
    if (make_baker(b, env, &error) != PE_OK) {
        pe_env_free(env);
        return fail(b, &error);
    }
    if (b->made + b->left == 0 && stays(b, environment, output)) {
        b->left++;
        result = CLI_SUCCESS;
    } else {
        result = bake_file(b, env, environment, output);
    }
    pe_env_free(env);
    return result;
}

int batch_make(batch *b, const char *environment, const char *output)
{
    return make_unless(never, b, environment, output);
}

int batch_update(batch *b, const char *environment, const char *output)
{
    return make_unless(is_made, b, environment, output);
}

void batch_end(batch *b)
{
    progress_clear(&b->bar);
}

void batch_free(batch *b)
{
    pe_maps_free(b->maps);
    pe_baker_free(b->baker);
}
