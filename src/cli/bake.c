/* bake.c - `prefenv bake`: an environment image to a maps file, or a sequence of them. */
#include "batch.h"
#include "cli.h"
#include "commands.h"
#include "describe.h"
#include "frames.h"
#include "maps.h"
#include "prefenv.h"
#include "progress.h"
#include "reflectance.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define NORMALS_MIN 12    /* 10 f^2 + 2 for f = 1 */
#define NORMALS_MAX 10242 /* and for f = 32 */

typedef struct bake_settings {
    const char *environment, *output;
    int method;
    cli_surface surface;
    double direction[3];
    int paper, normals, angles, size[2], quality;
    double error;
    int exact, fast, floats;
    double window, levels, threshold;
    int no_renormalise;
    const char *weights;
    const char *frames, *shard;
    int force;
    int threads, json, quiet;
    cli_given given;
} bake_settings;

static const cli_operand operands[] = {
    { "ENV", offsetof(bake_settings, environment), "lat-long environment: OpenEXR, Radiance HDR or PNG" },
    { NULL, 0, NULL },
};

static const cli_choice methods[] = {
    { "hemispheres", PE_METHOD_HEMISPHERES },
    { "representative", PE_METHOD_REPRESENTATIVE },
    { "baseline", PE_METHOD_BASELINE },
    { "layers", PE_METHOD_LAYERS },
    { "voxels", PE_METHOD_VOXELS },
    { "grades", PE_METHOD_GRADES },
    { NULL, 0 },
};

static const cli_choice qualities[] = {
    { "normal", PE_QUALITY_NORMAL },
    { "high", PE_QUALITY_HIGH },
    { NULL, 0 },
};

static const cli_option options[] = {
    { "output", 'o', "MAPS", CLI_TEXT, offsetof(bake_settings, output), 0, 0, NULL, NULL, 1,
      "the maps file to write, an OpenEXR; it appears whole or not at all" },
    { "method", 0, "NAME", CLI_CHOICE, offsetof(bake_settings, method), 0, 0, methods, NULL, 0,
      "hemispheres (the default): a picture of its hemisphere for each normal; representative: opposite normals share "
      "a lat-long map; baseline: one lat-long map, its lobe the one at normal incidence, for comparison; layers: for "
      "roughness that varies, Phong's lobe of any smoothness; voxels: the same in a cube; grades: for roughness that "
      "varies, hemispheres for each of some roughnesses of the range --alpha LO-HI, which by itself means this "
      "method" },
    { "paper", 0, NULL, CLI_SWITCH, offsetof(bake_settings, paper), 0, 0, NULL, NULL, 0,
      "the paper's settings: --method representative --normals 42 --size 400x200" },
    CLI_OPTION_NDF(bake_settings),
    CLI_OPTION_ALPHA(bake_settings),
    CLI_OPTION_ASPECT(bake_settings),
    CLI_OPTION_DIRECTION(bake_settings),
    CLI_OPTION_WEIGHT(bake_settings),
    CLI_OPTION_MATERIAL(bake_settings),
    CLI_OPTION_IOR(bake_settings),
    CLI_OPTION_K(bake_settings),
    { "normals", 0, "COUNT", CLI_INTEGER, offsetof(bake_settings, normals), NORMALS_MIN, NORMALS_MAX, NULL, NULL, 0,
      "representative normals: 12, 42, 92, 162, ... 10f^2+2. Default: as alpha and --error need, of lat-long maps 42" },
    { "size", 0, "WxH", CLI_SIZE, offsetof(bake_settings, size), 2, 8192, NULL, NULL, 0,
      "width and height of each map. Default: as alpha and --error need, of lat-long maps 400x200. Of layers and "
      "voxels "
      "one number S: the voxels along the cube's edge that lambda refers to; default 128" },
    { "angles", 0, "K", CLI_INTEGER, offsetof(bake_settings, angles), 1, 64, NULL, "1", 0,
      "filter each normal for K brush directions, 4 to 64, so that the brush may point anywhere; 1: along "
      "--direction" },
    { "quality", 0, "NAME", CLI_CHOICE, offsetof(bake_settings, quality), 0, 0, qualities, "normal", 0,
      "how much memory normals and sizes may take: normal, 10 MB; high, 64 MB" },
    { "error", 0, "E", CLI_NUMBER, offsetof(bake_settings, error), PE_WANTED_ERROR_MIN, PE_WANTED_ERROR_MAX, NULL, NULL,
      0,
      "the relative error wanted of what is looked up, of lat-long maps that of their texels: 0.01 is one percent. "
      "Default: what --quality gives" },
    { "exact", 0, NULL, CLI_SWITCH, offsetof(bake_settings, exact), 0, 0, NULL, NULL, 0,
      "weigh every texel of the environment. Default: exact up to 128x64 texels of ENV, fast above" },
    { "fast", 0, NULL, CLI_SWITCH, offsetof(bake_settings, fast), 0, 0, NULL, NULL, 0,
      "gather texels in clusters; the error is estimated and recorded" },
    CLI_OPTION_WINDOW(bake_settings),
    CLI_OPTION_LEVELS(bake_settings),
    { "threshold", 0, "T", CLI_NUMBER, offsetof(bake_settings, threshold), 0.000001, 0.5, NULL, NULL, 0,
      "of voxels: weights below T of a lobe's peak are left out. Default: 0.001" },
    { "no-renormalise", 0, NULL, CLI_SWITCH, offsetof(bake_settings, no_renormalise), 0, 0, NULL, NULL, 0,
      "of voxels: and are missing then, as in the paper; by default the rest makes up for them" },
    { "weights", 0, "FILE", CLI_TEXT, offsetof(bake_settings, weights), 0, 0, NULL, NULL, 0,
      "of voxels: keep the table of weights in FILE: read if it is there, else made and written" },
    { "float", 0, NULL, CLI_SWITCH, offsetof(bake_settings, floats), 0, 0, NULL, NULL, 0,
      "store 32-bit floats, not half floats" },
    { "frames", 0, "FIRST-LAST", CLI_TEXT, offsetof(bake_settings, frames), 0, 0, NULL, NULL, 0,
      "bake a sequence: ENV and MAPS have a %d or %04d in their names, which these numbers take the place of; frames "
      "made before are left alone" },
    { "shard", 0, "I/N", CLI_TEXT, offsetof(bake_settings, shard), 0, 0, NULL, NULL, 0,
      "of --frames, only every N-th from the I-th on: one of N machines' share" },
    { "force", 0, NULL, CLI_SWITCH, offsetof(bake_settings, force), 0, 0, NULL, NULL, 0,
      "of --frames, make those anew that were made before" },
    CLI_OPTION_THREADS(bake_settings),
    CLI_OPTION_JSON(bake_settings),
    CLI_OPTION_QUIET(bake_settings),
    { .name = NULL },
};

static int has_roughness(const bake_settings *settings)
{
    return pe_method_has_lambda((pe_method)settings->method);
}

/* What says nothing with the method: the lobe of layers and voxels is Phong's, and has its width from each lookup. */
static int check_method(const bake_settings *settings)
{
    static const char by_lookup[] = "does not go with --method layers and voxels, whose roughness is said at each "
                                    "lookup; leave it out",
                      phong[] = "does not go with --method voxels, which hold Phong's lobe; leave it out, or take "
                                "--method grades",
                      one_map[] = "does not go with --method baseline, which is one map; leave it out",
                      scale[] = "is for --method layers and voxels; leave it out or give both",
                      size_alone[] = "does not go with --method voxels, whose --size says all; leave it out",
                      no_quality[] = "does not go with --error, which takes what memory it needs, up to that of "
                                     "high; leave one of them out",
                      table[] = "is for --method voxels; leave it out or give both",
                      no_table[] = "is for a table of weights, which --exact goes without; leave one of them out";
    const int voxels = settings->method == PE_METHOD_VOXELS, rough = has_roughness(settings);
    const cli_rule rules[] = {
        { "ndf", !voxels || strcmp(settings->surface.ndf, "phong") == 0, phong },
        { "alpha", !rough, by_lookup },
        { "aspect", !rough, by_lookup },
        { "direction", !rough, by_lookup },
        { "weight", !rough, by_lookup },
        { "material", !rough, by_lookup },
        { "ior", !rough, by_lookup },
        { "k", !rough, by_lookup },
        { "normals", !rough, by_lookup },
        { "normals", settings->method != PE_METHOD_BASELINE, one_map },
        { "angles", !rough, by_lookup },
        { "window", rough, scale },
        { "levels", rough, scale },
        { "quality", settings->error == 0, no_quality },
        { "error", !voxels, size_alone },
        { "quality", !voxels, size_alone },
        { "threshold", voxels, table },
        { "threshold", !settings->exact, no_table },
        { "no-renormalise", voxels, table },
        { "no-renormalise", !settings->exact, no_table },
        { "weights", voxels, table },
        { "weights", !settings->exact, no_table },
    };

    return cli_check_rules(&bake_command, settings->given, rules, sizeof rules / sizeof *rules);
}

/* The voxels along an edge are as many one way as another. */
static int check_size(const bake_settings *settings)
{
    if (has_roughness(settings) && settings->size[0] != settings->size[1]) {
        cli_error("bake", "--size %dx%d: of layers and voxels it is one number, such as 128", settings->size[0],
                  settings->size[1]);
        return CLI_FAILURE;
    }
    return CLI_SUCCESS;
}

/* A table of weights takes a while to make: can it be written then? */
static int check_weights(const bake_settings *settings)
{
    if (!settings->weights)
        return CLI_SUCCESS;
    if (!*settings->weights) {
        cli_error("bake", "the name of --weights is empty; give a file, or leave it out");
        return CLI_FAILURE;
    }
    if (cli_is_same_file(settings->weights, settings->output)) {
        cli_error("bake", "%s: is the maps file and that of --weights; give two names", settings->output);
        return CLI_FAILURE;
    }
    return access(settings->weights, F_OK) == 0 ? CLI_SUCCESS : cli_check_new("bake", settings->weights);
}

/* A range of roughnesses, or layers of what is not Phong's lobe, are grades. */
static int choose_method(bake_settings *settings)
{
    const double *alpha = settings->surface.alpha;

    if (settings->method == PE_METHOD_LAYERS && cli_is_given(&bake_command, settings->given, "ndf") &&
        strcmp(settings->surface.ndf, "phong") != 0)
        settings->method = PE_METHOD_GRADES;
    if (alpha[2] > 0 && (settings->method == PE_METHOD_LAYERS || (!settings->method && !settings->paper)))
        settings->method = PE_METHOD_GRADES;
    if (alpha[2] > 0 && settings->method != PE_METHOD_GRADES) {
        cli_error("bake", "--alpha %g-%g: a range is for --method grades; give one width, or leave out %s", alpha[0],
                  alpha[2], settings->paper ? "--paper" : "the other method");
        return CLI_FAILURE;
    }
    if (settings->method == PE_METHOD_GRADES && alpha[0] > 0 && alpha[2] == 0) {
        cli_error("bake", "--method grades has a range of widths; give --alpha as in 0.02-0.5, or leave it out");
        return CLI_FAILURE;
    }
    return CLI_SUCCESS;
}

static int check_settings(const bake_settings *settings)
{
    if (settings->exact && settings->fast) {
        cli_error("bake", "--exact and --fast exclude each other; give one of them");
        return CLI_FAILURE;
    }
    if (settings->paper && settings->method && settings->method != PE_METHOD_REPRESENTATIVE) {
        cli_error("bake", "--paper is --method representative; give one of them");
        return CLI_FAILURE;
    }
    if (!settings->frames && (settings->shard || settings->force)) {
        cli_error("bake", "%s is for sequences; give --frames, too", settings->shard ? "--shard" : "--force");
        return CLI_FAILURE;
    }
    if (!settings->frames && frames_look_missing(settings->environment)) {
        cli_error("bake", "%s: no such file; give --frames FIRST-LAST if it is a sequence", settings->environment);
        return CLI_FAILURE;
    }
    if (check_method(settings) != CLI_SUCCESS || check_size(settings) != CLI_SUCCESS)
        return CLI_FAILURE;
    return check_weights(settings);
}

static void set_options(const bake_settings *settings, const pe_surface *surface, pe_bake_options *out)
{
    *out = (pe_bake_options){
        .method = settings->paper ? PE_METHOD_REPRESENTATIVE : (pe_method)settings->method,
        .surface = *surface,
        .alpha_max = settings->surface.alpha[2],
        .direction = { settings->direction[0], settings->direction[1], settings->direction[2] },
        .normals = settings->normals,
        .width = has_roughness(settings) ? 0 : settings->size[0],
        .height = has_roughness(settings) ? 0 : settings->size[1],
        .angles = settings->angles,
        .quality = (pe_quality)settings->quality,
        .error = settings->error,
        .accuracy = settings->exact  ? PE_ACCURACY_EXACT
                    : settings->fast ? PE_ACCURACY_FAST
                                     : PE_ACCURACY_AUTO,
        .smoothness = { has_roughness(settings) ? settings->size[0] : 0, settings->window, settings->levels },
        .threshold = settings->threshold,
        .lost = settings->no_renormalise ? PE_LOST_DARK : PE_LOST_SPREAD,
        .weights = settings->weights,
        .threads = settings->threads,
    };
    if (settings->method == PE_METHOD_GRADES && settings->surface.alpha[0] == 0) {
        out->surface.ndf.alpha_y *= PE_GRADES_ALPHA_MIN / out->surface.ndf.alpha_x;
        out->surface.ndf.alpha_x = PE_GRADES_ALPHA_MIN;
    }
}

/* None of the files that are read, or kept, may be written over. */
static int check_output(const bake_settings *settings, const char *environment, const char *output, const batch *b)
{
    const char *inputs[4] = { environment };
    int count = 1;

    if (b->measured)
        inputs[count++] = b->measured;
    if (settings->weights)
        inputs[count] = settings->weights;
    return cli_check_exr_output("bake", output, inputs);
}

/* ---- one ---- */

static void print_summary(const bake_settings *settings, const batch *b, double seconds)
{
    const pe_maps_info *info = pe_maps_get_info(b->maps);
    char accuracy[DESCRIBE_BYTES], images[DESCRIBE_BYTES], repairs[64] = "";
    struct stat status;
    double bytes = stat(settings->output, &status) == 0 ? (double)status.st_size : 0;

    if (settings->json) {
        json out = { 0 };

        json_open(&out, NULL);
        json_text(&out, "file", settings->output);
        json_integer(&out, "bytes", (long long)bytes);
        json_number(&out, "seconds", seconds);
        json_integer(&out, "repairs", (long long)b->repairs);
        describe_maps_json(&out, b->maps);
        json_close(&out);
        return;
    }
    if (settings->quiet)
        return;
    describe_accuracy(info, accuracy);
    if (b->repairs)
        snprintf(repairs, sizeof repairs, "; %zu source %s repaired", b->repairs, b->repairs == 1 ? "texel" : "texels");
    describe_images(info, images);
    fprintf(stderr, "%s: %s, %.1f MB, in %.1f s, %s%s\n", settings->output, images, bytes / 1e6, seconds, accuracy,
            repairs);
}

static int bake_one(const bake_settings *settings, batch *b, double begun)
{
    int result;

    if (check_output(settings, settings->environment, settings->output, b) != CLI_SUCCESS)
        return CLI_FAILURE;
    b->count = 1;
    result = batch_make(b, settings->environment, settings->output);
    batch_end(b);
    if (result == CLI_SUCCESS)
        print_summary(settings, b, clock_seconds() - begun);
    return result;
}

/* ---- a sequence ---- */

typedef int frame_task(const bake_settings *settings, const char *environment, const char *output, batch *b);

static int for_each_frame(const bake_settings *settings, const frames *f, frame_task *task, batch *b)
{
    int result = CLI_SUCCESS;

    for (int frame = f->first; frame <= f->last && result == CLI_SUCCESS; frame += f->step) {
        char *environment = frames_name(settings->environment, frame), *output = frames_name(settings->output, frame);

        result = CLI_FAILURE;
        if (environment && output)
            result = task(settings, environment, output, b);
        else
            cli_error("bake", "out of memory");
        free(environment);
        free(output);
    }
    return result;
}

/* Before hours of work: is every frame there, and can it be written? */
static int check_frame(const bake_settings *settings, const char *environment, const char *output, batch *b)
{
    struct stat about;

    if (stat(environment, &about) == 0)
        return check_output(settings, environment, output, b);
    cli_error("bake", "%s: %s; --frames %s needs it", environment, strerror(errno), settings->frames);
    return CLI_FAILURE;
}

static int bake_frame(const bake_settings *settings, const char *environment, const char *output, batch *b)
{
    return settings->force ? batch_add(b, environment, output) : batch_update(b, environment, output);
}

static void print_sequence_json(const bake_settings *settings, const batch *b, double seconds)
{
    json out = { 0 };

    json_open(&out, NULL);
    json_text(&out, "file", settings->output);
    json_integer(&out, "frames", b->count);
    json_integer(&out, "made", b->made);
    json_integer(&out, "left", b->left);
    json_number(&out, "seconds", seconds);
    if (b->maps)
        describe_maps_json(&out, b->maps);
    json_close(&out);
}

static void print_sequence(const bake_settings *settings, const batch *b, double seconds)
{
    char accuracy[DESCRIBE_BYTES], images[DESCRIBE_BYTES];

    if (settings->json) {
        print_sequence_json(settings, b, seconds);
        return;
    }
    if (settings->quiet)
        return;
    fprintf(stderr, "%s: %d of %d frames made, %d left as they were, in %.1f s", settings->output, b->made, b->count,
            b->left, seconds);
    if (b->maps) {
        const pe_maps_info *info = pe_maps_get_info(b->maps);

        describe_accuracy(info, accuracy);
        describe_images(info, images);
        fprintf(stderr, "; %s each, %s", images, accuracy);
    }
    fprintf(stderr, "\n");
}

static int bake_sequence(const bake_settings *settings, batch *b, double begun)
{
    int result;
    frames all, f; /* of other machines' shares only the names matter */

    if (frames_parse("bake", settings->frames, NULL, &all) != CLI_SUCCESS ||
        frames_parse("bake", settings->frames, settings->shard, &f) != CLI_SUCCESS ||
        frames_check_pattern("bake", settings->environment) != CLI_SUCCESS ||
        frames_check_pattern("bake", settings->output) != CLI_SUCCESS ||
        for_each_frame(settings, &f, check_frame, b) != CLI_SUCCESS ||
        frames_check_overwriting("bake", settings->environment, settings->output, &all) != CLI_SUCCESS)
        return CLI_FAILURE;
    b->count = frames_count(&f);
    result = for_each_frame(settings, &f, bake_frame, b);
    if (result == CLI_SUCCESS)
        result = batch_flush(b);
    batch_end(b);
    if (result == CLI_SUCCESS)
        print_sequence(settings, b, clock_seconds() - begun);
    return result;
}

static int bake_run(int argc, char **argv)
{
    bake_settings settings = { 0 };
    double begun = clock_seconds();
    batch b = { 0 };
    pe_surface surface;
    pe_ndf_table *table;
    int result = cli_parse(&bake_command, argc, argv, &settings, &settings.given);

    if (result != CLI_PROCEED)
        return result;
    if (choose_method(&settings) != CLI_SUCCESS || check_settings(&settings) != CLI_SUCCESS ||
        cli_make_surface("bake", &settings.surface, &surface, &table) != CLI_SUCCESS)
        return CLI_FAILURE;
    set_options(&settings, &surface, &b.options);
    b.measured = table ? settings.surface.ndf : NULL;
    b.pixels = settings.floats ? PE_PIXEL_FLOAT : PE_PIXEL_HALF;
    b.quiet = settings.quiet;
    result = settings.frames ? bake_sequence(&settings, &b, begun) : bake_one(&settings, &b, begun);
    batch_free(&b);
    pe_ndf_table_free(table);
    return result == CLI_SUCCESS ? cli_flush("bake") : result;
}

const cli_command bake_command = {
    "bake",
    "filter an environment into a maps file",
    "Filters a lat-long environment image by a surface's normal distribution, once for each of some hundreds of "
    "representative normals, and writes the maps file that POV-Ray's prefiltered_environment and 'prefenv eval' look "
    "up.",
    operands,
    options,
    bake_run,
};
