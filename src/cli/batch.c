/* batch.c - see batch.h. */
#include "batch.h"

#include "bake.h"
#include "cli.h"
#include "interrupt.h"
#include "parallel.h"
#include "status.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Of so many bakes of several frames, one has its errors estimated, which takes longer than the bake. */
#define ESTIMATE_EVERY 8

/* A bake ends early where a signal waits for files that are being written. */
static int look_for_interrupt(double fraction, void *data)
{
    (void)fraction;
    (void)data;
    return interrupt_waits();
}

static int draw_progress(double fraction, void *data)
{
    batch *b = data;

    progress_draw(&b->bar, (b->made + b->unwritten + fraction * b->baking) / (b->count - b->left));
    return interrupt_waits();
}

static int fail(batch *b, const pe_error *error)
{
    progress_clear(&b->bar);
    cli_error("bake", "%s", error->message);
    return CLI_FAILURE;
}

/* ---- bake and write ---- */

static void show_progress(batch *b)
{
    b->options.progress = progress_is_visible() && !b->quiet ? draw_progress : look_for_interrupt;
    b->options.progress_data = b;
    progress_begin(&b->bar);
}

static pe_status make_baker(batch *b, const pe_env *env, pe_error *error)
{
    if (b->baker)
        return PE_OK;
    show_progress(b);
    return pe_baker_make(&b->options, pe_env_width(env), pe_env_height(env), &b->baker, error);
}

static void note_errors(batch *b, const pe_maps *maps)
{
    b->errors.texels = fmax(b->errors.texels, pe_maps_get_info(maps)->error_estimate);
    b->errors.lookups = fmax(b->errors.lookups, pe_maps_get_info(maps)->lookup_error);
}

static void note_flaws(batch *b, const char *environment, const pe_env *env)
{
    b->repairs = pe_env_repairs(env);
    if (b->quiet || !*pe_env_remark(env))
        return;
    progress_clear(&b->bar);
    cli_warn_of_flaws("bake", environment, env);
}

static const char *way_to_less(const pe_bake_options *options, const pe_maps_info *info)
{
    int chosen = options->normals == 0 && options->width == 0; /* by itself */
    int more = chosen && options->error == 0 && options->quality == PE_QUALITY_NORMAL;

    switch (info->method) {
    case PE_METHOD_GRADES:
        return more     ? "give --quality high, or a smaller range of --alpha"
               : chosen ? "give a smaller range of --alpha"
                        : "leave out --normals and --size, or give larger ones";
    case PE_METHOD_HEMISPHERES:
        return more ? "give --quality high" : "give more --normals, and a larger --size";
    case PE_METHOD_LAYERS:
        return "finer layers were no better";
    default:
        return "--exact has none";
    }
}

/* What was asked for, or what is usual, may take more memory than the choice may, or a harder environment than it
 * knows. */
static void warn_of_error(batch *b, const pe_maps *maps, const char *output)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    int of_lookups = info->method == PE_METHOD_HEMISPHERES || info->method == PE_METHOD_LAYERS ||
                     info->method == PE_METHOD_GRADES; /* else not measured */
    double wanted = b->options.error, reached = of_lookups ? info->lookup_error : info->error_estimate;
    const char *way = way_to_less(&b->options, info);

    if (b->quiet || b->made > 0 || reached <= (wanted > 0 ? wanted : PE_VISIBLE_ERROR))
        return;
    progress_clear(&b->bar);
    if (wanted > 0)
        cli_warning("bake", "%s: the error of %s is %.2g %%, not the %.2g %% asked for; %s", output,
                    of_lookups ? "lookups" : "texels", 100 * reached, 100 * wanted, way);
    else
        cli_warning("bake", "%s: %s are off by about %.2g %%, which shows; %s", output,
                    of_lookups ? "lookups" : "texels", 100 * reached, way);
}

/* ---- write ---- */

/* Half floats unless floats are asked for or needed: a bake that took minutes is not thrown away for a bright sun. */
static void write_maps(size_t index, void *data)
{
    batch *b = data;
    batch_frame *f = &b->baked[index];

    f->status = pe_maps_write(f->maps, f->output, b->pixels, &f->error);
    f->needs_floats = b->pixels != PE_PIXEL_FLOAT && f->status == PE_ERROR_LIMIT;
    if (f->needs_floats)
        f->status = pe_maps_write(f->maps, f->output, PE_PIXEL_FLOAT, &f->error);
}

static void *write_all(void *data)
{
    batch *b = data;

    pe_parallel_for((size_t)b->unwritten, b->options.threads, write_maps, b, NULL);
    return NULL;
}

/* A file that is being written. */
typedef struct writer {
    pthread_t thread;
    int runs;
} writer;

/* In the background, where there may be more than one thread. */
static writer begin_writing(batch *b)
{
    writer w = { .runs = 0 };

    for (int k = 0; k < b->unwritten; k++)
        interrupt_hold(b->baked[k].output);
    if (b->unwritten && b->options.threads != 1)
        w.runs = pthread_create(&w.thread, NULL, write_all, b) == 0;
    if (b->unwritten && !w.runs)
        write_all(b);
    return w;
}

static void free_frame(batch_frame *f)
{
    pe_env_free(f->env);
    pe_maps_free(f->maps);
    free(f->environment);
    free(f->output);
    *f = (batch_frame){ .env = NULL };
}

static int finish_frame(batch *b, batch_frame *f)
{
    if (f->status != PE_OK)
        return fail(b, &f->error);
    if (f->needs_floats && !b->quiet) {
        progress_clear(&b->bar);
        cli_warning("bake", "%s: brighter than half floats can hold (65504): written as with --float", f->output);
    }
    warn_of_error(b, f->maps, f->output);
    b->made++;
    return CLI_SUCCESS;
}

/* Keeps the last one's maps. */
static void clear_baked(batch *b)
{
    if (b->unwritten && b->baked[b->unwritten - 1].maps) {
        pe_maps_free(b->maps);
        b->maps = b->baked[b->unwritten - 1].maps;
        b->baked[b->unwritten - 1].maps = NULL;
    }
    while (b->unwritten)
        free_frame(&b->baked[--b->unwritten]);
}

static int end_writing(batch *b, writer *w)
{
    int result = CLI_SUCCESS;

    if (w->runs)
        pthread_join(w->thread, NULL);
    interrupt_release();
    for (int k = 0; k < b->unwritten && result == CLI_SUCCESS; k++)
        result = finish_frame(b, &b->baked[k]);
    clear_baked(b);
    return result;
}

static int write_frames(batch *b)
{
    writer w = begin_writing(b);

    return end_writing(b, &w);
}

/* ---- frames that wait to be made together ---- */

/* What was baked of those that wait goes where it waits to be written; the rest is dropped. */
static void clear_frames(batch *b)
{
    for (int k = 0; k < b->waiting && b->frames[k].maps; k++) {
        pe_env_free(b->frames[k].env);
        b->frames[k].env = NULL;
        b->baked[b->unwritten++] = b->frames[k];
        b->frames[k] = (batch_frame){ .env = NULL };
    }
    while (b->waiting)
        free_frame(&b->frames[--b->waiting]);
}

static void read_frame(size_t index, void *data)
{
    batch_frame *f = &((batch *)data)->frames[index];

    f->status = cli_read_environment(f->environment, &f->env, &f->error);
}

/* How many of those that wait can be baked: all before the first that cannot, whose error says why. */
static int count_sound(batch *b)
{
    const pe_maps_info *info = pe_baker_get_info(b->baker);

    for (int k = 0; k < b->waiting; k++) {
        batch_frame *f = &b->frames[k];

        if (f->status == PE_OK &&
            (pe_env_width(f->env) != info->source_width || pe_env_height(f->env) != info->source_height)) {
            const pe_env *alone = f->env; /* is refused, with the reason */

            f->status = pe_baker_bake_frames(b->baker, &alone, 1, &b->errors, &f->maps, &f->error);
        }
        if (f->status != PE_OK)
            return k;
        note_flaws(b, f->environment, f->env);
    }
    return b->waiting;
}

static int bake_frames(batch *b, int count)
{
    const pe_env *envs[PE_FRAMES_MAX];
    pe_maps *maps[PE_FRAMES_MAX];
    pe_status status;
    pe_error error;
    writer w;

    for (int k = 0; k < count; k++)
        envs[k] = b->frames[k].env;
    b->baking = count;
    w = begin_writing(b);
    status =
        pe_baker_bake_pictures(b->baker, envs, count, b->bakes++ % ESTIMATE_EVERY ? &b->errors : NULL, maps, &error);
    if (end_writing(b, &w) != CLI_SUCCESS || status != PE_OK) {
        for (int k = 0; k < count && status == PE_OK; k++)
            pe_maps_free(maps[k]);
        return status != PE_OK ? fail(b, &error) : CLI_FAILURE;
    }
    for (int k = 0; k < count; k++)
        b->frames[k].maps = maps[k];
    note_errors(b, maps[0]);
    return CLI_SUCCESS;
}

/* Bakes those that wait, while those baked before are written. */
static int bake_waiting(batch *b)
{
    int result = CLI_SUCCESS, sound;

    pe_parallel_for((size_t)b->waiting, b->options.threads, read_frame, b, NULL);
    sound = b->waiting ? count_sound(b) : 0;
    if (sound)
        result = bake_frames(b, sound);
    if (result == CLI_SUCCESS && sound < b->waiting)
        result = fail(b, &b->frames[sound].error);
    clear_frames(b);
    if (result != CLI_SUCCESS)
        write_frames(b); /* those before it */
    return result;
}

int batch_flush(batch *b)
{
    int baked = bake_waiting(b), written = write_frames(b);

    return baked == CLI_SUCCESS ? written : baked;
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
    return is_same_surface(a, b) && a->method == b->method && a->grades == b->grades && a->alpha_max == b->alpha_max &&
           a->normals == b->normals && a->angles == b->angles && a->pole_angles == b->pole_angles &&
           a->pole_cosine == b->pole_cosine && a->images == b->images && a->width == b->width &&
           a->height == b->height && a->accuracy == b->accuracy && a->error_wanted == b->error_wanted &&
           a->smoothness.size == b->smoothness.size && a->smoothness.window == b->smoothness.window &&
           a->smoothness.levels == b->smoothness.levels && a->threshold == b->threshold && a->lost == b->lost &&
           a->source_width == b->source_width && a->source_height == b->source_height &&
           memcmp(a->direction, b->direction, sizeof a->direction) == 0;
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

/* The first environment says for which size the baker is to be. */
static int need_baker(batch *b, const char *environment)
{
    pe_status status;
    pe_error error;
    pe_env *env;

    if (b->baker)
        return CLI_SUCCESS;
    if (cli_read_environment(environment, &env, &error) != PE_OK)
        return fail(b, &error);
    status = make_baker(b, env, &error);
    pe_env_free(env);
    return status == PE_OK ? CLI_SUCCESS : fail(b, &error);
}

int batch_add(batch *b, const char *environment, const char *output)
{
    batch_frame *f = &b->frames[b->waiting];

    if (need_baker(b, environment) != CLI_SUCCESS)
        return CLI_FAILURE;
    f->environment = strdup(environment);
    f->output = strdup(output);
    b->waiting++;
    if (!f->environment || !f->output) {
        cli_error("bake", "out of memory");
        return CLI_FAILURE;
    }
    return b->waiting == PE_FRAMES_MAX ? bake_waiting(b) : CLI_SUCCESS;
}

int batch_update(batch *b, const char *environment, const char *output)
{
    if (need_baker(b, environment) != CLI_SUCCESS)
        return CLI_FAILURE;
    if (!is_made(b, environment, output))
        return batch_add(b, environment, output);
    b->left++;
    return CLI_SUCCESS;
}

/* ---- one alone ---- */

static int bake_alone(batch *b, batch_frame *f)
{
    note_flaws(b, f->environment, f->env);
    b->baking = 1;
    show_progress(b);
    f->status = pe_bake(f->env, &b->options, &f->maps, &f->error);
    if (f->status != PE_OK)
        return fail(b, &f->error);
    clear_frames(b);
    return write_frames(b);
}

int batch_make(batch *b, const char *environment, const char *output)
{
    batch_frame *f = &b->frames[0];
    int result;

    b->waiting = 1;
    f->environment = strdup(environment);
    f->output = strdup(output);
    if (!f->environment || !f->output) {
        cli_error("bake", "out of memory");
        return CLI_FAILURE;
    }
    read_frame(0, b);
    result = f->status == PE_OK ? bake_alone(b, f) : fail(b, &f->error);
    clear_frames(b);
    return result;
}

void batch_end(batch *b)
{
    progress_clear(&b->bar);
}

void batch_free(batch *b)
{
    clear_frames(b);
    clear_baked(b);
    pe_maps_free(b->maps);
    pe_baker_free(b->baker);
}
