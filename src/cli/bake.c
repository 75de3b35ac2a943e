/* bake.c - `prefenv bake`: an environment image to a maps file. */
#include "cli.h"
#include "commands.h"
#include "describe.h"
#include "interrupt.h"
#include "prefenv.h"
#include "progress.h"
#include "reflectance.h"

#include <stdio.h>
#include <sys/stat.h>

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
    int threads, json, quiet;
} bake_settings;

static const cli_operand operands[] = {
    { "ENV", offsetof(bake_settings, environment), "lat-long environment: OpenEXR, Radiance HDR or PNG" },
    { NULL, 0, NULL },
};

static const cli_choice methods[] = {
    { "hemispheres", PE_METHOD_HEMISPHERES },
    { "representative", PE_METHOD_REPRESENTATIVE },
    { "baseline", PE_METHOD_BASELINE },
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
      "a "
      "lat-long map; baseline: one lat-long map, its lobe the one at normal incidence, for comparison" },
    { "paper", 0, NULL, CLI_SWITCH, offsetof(bake_settings, paper), 0, 0, NULL, NULL, 0,
      "the paper's settings: --method representative --normals 42 --size 400x200" },
    CLI_OPTION_NDF(bake_settings),
    CLI_OPTION_ALPHA(bake_settings),
    CLI_OPTION_DIRECTION(bake_settings),
    CLI_OPTION_WEIGHT(bake_settings),
    CLI_OPTION_MATERIAL(bake_settings),
    CLI_OPTION_IOR(bake_settings),
    CLI_OPTION_K(bake_settings),
    { "normals", 0, "COUNT", CLI_INTEGER, offsetof(bake_settings, normals), NORMALS_MIN, NORMALS_MAX, NULL, NULL, 0,
      "representative normals: 12, 42, 92, 162, ... 10f^2+2. Default: as alpha and --error need, of lat-long maps 42" },
    { "size", 0, "WxH", CLI_SIZE, offsetof(bake_settings, size), 2, 8192, NULL, NULL, 0,
      "width and height of each map. Default: as alpha and --error need, of lat-long maps 400x200" },
    { "angles", 0, "K", CLI_INTEGER, offsetof(bake_settings, angles), 1, 64, NULL, "1", 0,
      "filter each normal for K brush directions, 4 to 64, so that the brush may point anywhere; 1: along "
      "--direction" },
    { "quality", 0, "NAME", CLI_CHOICE, offsetof(bake_settings, quality), 0, 0, qualities, "normal", 0,
      "how much memory normals and sizes may take: normal, 10 MB; high, 64 MB" },
    { "error", 0, "E", CLI_NUMBER, offsetof(bake_settings, error), 0.0005, 0.1, NULL, NULL, 0,
      "the relative error wanted of what is looked up: 0.01 is one percent. Default: what --quality gives" },
    { "exact", 0, NULL, CLI_SWITCH, offsetof(bake_settings, exact), 0, 0, NULL, NULL, 0,
      "weigh every texel of the environment. Default: exact up to 128x64 texels of ENV, fast above" },
    { "fast", 0, NULL, CLI_SWITCH, offsetof(bake_settings, fast), 0, 0, NULL, NULL, 0,
      "gather texels in clusters; the error is estimated and recorded" },
    { "float", 0, NULL, CLI_SWITCH, offsetof(bake_settings, floats), 0, 0, NULL, NULL, 0,
      "store 32-bit floats, not half floats" },
    CLI_OPTION_THREADS(bake_settings),
    CLI_OPTION_JSON(bake_settings),
    CLI_OPTION_QUIET(bake_settings),
    { .name = NULL },
};

static int check_settings(const bake_settings *settings)
{
    const char *inputs[] = { settings->environment, NULL };

    if (settings->exact && settings->fast) {
        cli_error("bake", "--exact and --fast exclude each other; give one of them");
        return CLI_FAILURE;
    }
    if (settings->paper && settings->method && settings->method != PE_METHOD_REPRESENTATIVE) {
        cli_error("bake", "--paper is --method representative; give one of them");
        return CLI_FAILURE;
    }
    return cli_check_output("bake", settings->output, inputs);
}

static int draw_progress(double fraction, void *data)
{
    progress_draw(data, fraction);
    return 0;
}

static pe_status bake_maps(const bake_settings *settings, const pe_surface *surface, const pe_env *env, pe_maps **maps,
                           pe_error *error)
{
    progress bar;
    pe_status status;
    pe_bake_options bake = {
        .method = settings->paper ? PE_METHOD_REPRESENTATIVE : (pe_method)settings->method,
        .surface = *surface,
        .direction = { settings->direction[0], settings->direction[1], settings->direction[2] },
        .normals = settings->normals,
        .width = settings->size[0],
        .height = settings->size[1],
        .angles = settings->angles,
        .quality = (pe_quality)settings->quality,
        .error = settings->error,
        .accuracy = settings->exact  ? PE_ACCURACY_EXACT
                    : settings->fast ? PE_ACCURACY_FAST
                                     : PE_ACCURACY_AUTO,
        .threads = settings->threads,
        .progress = progress_is_visible() && !settings->quiet ? draw_progress : NULL,
        .progress_data = &bar,
    };

    progress_begin(&bar);
    status = pe_bake(env, &bake, maps, error);
    progress_clear(&bar);
    return status;
}

/* Half floats unless floats are asked for or needed: a bake that took minutes is not thrown away for a bright sun. */
static pe_status write_maps(const bake_settings *settings, const pe_maps *maps, pe_error *error)
{
    pe_pixel_type pixels = settings->floats ? PE_PIXEL_FLOAT : PE_PIXEL_HALF;
    pe_status status = pe_maps_write(maps, settings->output, pixels, error);

    if (settings->floats || status != PE_ERROR_LIMIT)
        return status;
    status = pe_maps_write(maps, settings->output, PE_PIXEL_FLOAT, error);
    if (status == PE_OK && !settings->quiet)
        cli_warning("bake", "brighter than half floats can hold (65504): written as with --float");
    return status;
}

static void print_summary(const bake_settings *settings, const pe_maps *maps, double seconds)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    char accuracy[DESCRIBE_BYTES];
    struct stat status;
    double bytes = stat(settings->output, &status) == 0 ? (double)status.st_size : 0;

    if (settings->json) {
        json out = { 0 };

        json_open(&out, NULL);
        json_text(&out, "file", settings->output);
        json_integer(&out, "bytes", (long long)bytes);
        json_number(&out, "seconds", seconds);
        describe_maps_json(&out, info);
        json_close(&out);
        return;
    }
    if (settings->quiet)
        return;
    describe_accuracy(info, accuracy);
    fprintf(stderr, "%s: %d %s of %dx%d, %.1f MB, in %.1f s, %s\n", settings->output, info->images,
            info->images == 1 ? "map" : "maps", info->width, info->height, bytes / 1e6, seconds, accuracy);
}

/* Bakes and writes; on success *maps is the caller's. */
static pe_status bake_file(const bake_settings *settings, const pe_surface *surface, pe_maps **maps, pe_error *error)
{
    pe_env *env;
    pe_status status = cli_read_environment(settings->environment, &env, error);

    if (status != PE_OK)
        return status;
    if (!settings->quiet)
        cli_warn_of_flaws("bake", settings->environment, env);
    status = bake_maps(settings, surface, env, maps, error);
    pe_env_free(env);
    if (status != PE_OK)
        return status;
    interrupt_hold(settings->output);
    status = write_maps(settings, *maps, error);
    interrupt_release();
    if (status != PE_OK)
        pe_maps_free(*maps);
    return status;
}

static int bake_run(int argc, char **argv)
{
    bake_settings settings = { 0 };
    double begun = clock_seconds();
    pe_surface surface;
    pe_ndf_table *table;
    pe_maps *maps;
    pe_error error;
    pe_status status;
    int proceed = cli_parse(&bake_command, argc, argv, &settings);

    if (proceed != CLI_PROCEED)
        return proceed;
    if (check_settings(&settings) != CLI_SUCCESS)
        return CLI_FAILURE;
    if (cli_make_surface("bake", &settings.surface, &surface, &table) != CLI_SUCCESS)
        return CLI_FAILURE;
    status = bake_file(&settings, &surface, &maps, &error);
    pe_ndf_table_free(table);
    if (status != PE_OK) {
        cli_error("bake", "%s", error.message);
        return CLI_FAILURE;
    }
    print_summary(&settings, maps, clock_seconds() - begun);
    pe_maps_free(maps);
    return cli_flush("bake");
}

const cli_command bake_command = {
    "bake",
    "filter an environment into a maps file",
    "Filters a lat-long environment image by a surface's normal distribution, once for each of a few representative "
    "normals, and writes the maps file that POV-Ray's prefiltered_environment and 'prefenv eval' look up.",
    operands,
    options,
    bake_run,
};
