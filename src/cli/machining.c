/* machining.c - `prefenv surface`: the height field of a machined surface, for 'prefenv ndf' to measure. */
#include "cli.h"
#include "commands.h"
#include "prefenv.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct surface_settings {
    const char *kind, *output;
    int size[2], seed, quiet;
    double pitch, feed, radius, slope, roughness, length[2];
} surface_settings;

static const cli_operand operands[] = {
    { "KIND", offsetof(surface_settings, kind), "turned, milled, blasted or brushed" },
    { NULL, 0, NULL },
};

static const char *const kinds[] = {
    [PE_TURNED] = "turned", [PE_MILLED] = "milled", [PE_BLASTED] = "blasted", [PE_BRUSHED] = "brushed"
};
#define KINDS (int)(sizeof kinds / sizeof kinds[0])

#define UM_MIN 0.001 /* a nanometre */
#define UM_MAX 1e6   /* a metre */

static const cli_option options[] = {
    { "output", 'o', "HEIGHTS.exr", CLI_TEXT, offsetof(surface_settings, output), 0, 0, NULL, NULL, 1,
      "the height field to write, an OpenEXR in micrometres that knows its pitch" },
    { "size", 0, "WxH", CLI_SIZE, offsetof(surface_settings, size), PE_HEIGHTS_SIDE_MIN, 8192, NULL, "1024x1024", 0,
      "width and height of the field, in texels" },
    { "pitch", 0, "LENGTH", CLI_LENGTH, offsetof(surface_settings, pitch), UM_MIN, UM_MAX, NULL, "1um", 0,
      "distance of texels" },
    { "feed", 0, "LENGTH", CLI_LENGTH, offsetof(surface_settings, feed), UM_MIN, UM_MAX, NULL, NULL, 0,
      "turned, milled: distance of grooves, at least 8 pitches, rounded so that they fit into the field. Default: "
      "100um, 128um" },
    { "radius", 0, "LENGTH", CLI_LENGTH, offsetof(surface_settings, radius), UM_MIN, UM_MAX, NULL, NULL, 0,
      "turned: of the tool's nose. Default: 400um" },
    { "slope", 0, "S", CLI_NUMBER, offsetof(surface_settings, slope), 0.001, 10, NULL, NULL, 0,
      "milled: of the grooves' flanks, height by length. Default: 0.12" },
    { "roughness", 0, "LENGTH", CLI_LENGTH, offsetof(surface_settings, roughness), 1e-6, UM_MAX, NULL, NULL, 0,
      "root mean square height of the Gaussian surface, alone or over the grooves. Default: turned 0.04um, "
      "milled 0.06um, blasted 0.4um, brushed 0.6um" },
    { "length", 0, "L|LX,LY", CLI_LENGTHS, offsetof(surface_settings, length), UM_MIN, UM_MAX, NULL, NULL, 0,
      "its correlation length; two: along and across the lay. Its alpha is 2 roughness / length. Default: 16um,8um, of "
      "blasted 8um, of brushed 40um,8um" },
    { "seed", 0, "N", CLI_INTEGER, offsetof(surface_settings, seed), 0, 2147483647, NULL, "1", 0,
      "the same seed makes the same surface" },
    CLI_OPTION_QUIET(surface_settings),
    { .name = NULL },
};

/* The kind's number; -1, with its error printed, if there is none of the name. */
static int find_kind(const char *name)
{
    const char *nearest;

    for (int kind = 0; kind < KINDS; kind++)
        if (strcmp(kinds[kind], name) == 0)
            return kind;
    nearest = cli_nearest(name, kinds, KINDS);
    if (nearest)
        cli_error("surface", "unknown kind '%s'; did you mean '%s'?", name, nearest);
    else
        cli_error("surface", "unknown kind '%s'; what there is: turned, milled, blasted, brushed", name);
    return -1;
}

/* Options that a kind has no use for are a mistake. */
static int check_settings(const surface_settings *settings, int kind)
{
    const char *none[] = { NULL };

    if (settings->feed > 0 && kind != PE_TURNED && kind != PE_MILLED)
        cli_error("surface", "--feed is for turned and milled; a %s surface has no grooves", settings->kind);
    else if (settings->radius > 0 && kind != PE_TURNED)
        cli_error("surface", "--radius is for turned; a %s surface has no round tool", settings->kind);
    else if (settings->slope > 0 && kind != PE_MILLED)
        cli_error("surface", "--slope is for milled; a %s surface has no flanks", settings->kind);
    else
        return cli_check_exr_output("surface", settings->output, none);
    return CLI_FAILURE;
}

static void print_summary(const surface_settings *settings, const pe_machining_options *o)
{
    fprintf(stderr, "%s: %s, %dx%d texels of %g um; roughness %g um, alpha %.3g along, %.3g across the lay",
            settings->output, settings->kind, o->width, o->height, o->pitch, o->roughness,
            2 * o->roughness / o->length[0], 2 * o->roughness / o->length[1]);
    if (o->kind == PE_TURNED)
        fprintf(stderr, "; grooves every %g um, slopes across even to %.3g", o->feed, o->feed / 2 / o->radius);
    if (o->kind == PE_MILLED)
        fprintf(stderr, "; grooves every %g um, flanks of slope %g", o->feed, o->slope);
    fputc('\n', stderr);
}

static pe_status write_surface(const surface_settings *settings, pe_machining_options *machining, pe_error *error)
{
    pe_heights heights;
    pe_status status = pe_machining_complete(machining, error);

    if (status == PE_OK)
        status = pe_heights_machine(machining, &heights, error);
    if (status != PE_OK)
        return status;
    status = pe_heights_write(&heights, settings->output, error);
    pe_heights_free(&heights);
    return status;
}

static int surface_run(int argc, char **argv)
{
    surface_settings settings = { 0 };
    pe_machining_options machining;
    pe_error error;
    int proceed = cli_parse(&surface_command, argc, argv, &settings, NULL), kind;

    if (proceed != CLI_PROCEED)
        return proceed;
    kind = find_kind(settings.kind);
    if (kind < 0 || check_settings(&settings, kind) != CLI_SUCCESS)
        return CLI_FAILURE;
    machining = (pe_machining_options){
        .kind = (pe_machining)kind,
        .width = settings.size[0],
        .height = settings.size[1],
        .pitch = settings.pitch,
        .feed = settings.feed,
        .radius = settings.radius,
        .slope = settings.slope,
        .roughness = settings.roughness,
        .length = { settings.length[0], settings.length[1] },
        .seed = (unsigned)settings.seed,
    };
    if (write_surface(&settings, &machining, &error) != PE_OK) {
        cli_error("surface", "%s", error.message);
        return CLI_FAILURE;
    }
    if (!settings.quiet)
        print_summary(&settings, &machining);
    return CLI_SUCCESS;
}

const cli_command surface_command = {
    "surface",
    "make the height field of a machined surface",
    "Makes the height field of a machined surface, grooves along x, for 'prefenv ndf' to measure: turned by a "
    "round-nosed tool, milled into grooves with straight flanks, blasted, or brushed. The field repeats itself.",
    operands,
    options,
    surface_run,
};
