/* eval.c - `prefenv eval`: looks maps up for lines of normal and viewer. */
#include "cli.h"
#include "commands.h"
#include "lines.h"
#include "maps.h"
#include "prefenv.h"

typedef struct eval_settings {
    const char *maps;
    int interpolation;
    double exponent;
    int horizon, threads;
    cli_given given;
} eval_settings;

static const cli_operand operands[] = { { "MAPS", offsetof(eval_settings, maps), "a maps file" }, { NULL, 0, NULL } };

static const cli_choice interpolations[] = {
    { "nearest", PE_INTERPOLATION_NEAREST },
    { "weighted", PE_INTERPOLATION_WEIGHTED },
    { "linear", PE_INTERPOLATION_LINEAR },
    { NULL, 0 },
};

static const cli_choice horizons[] = {
    { "ignored", PE_HORIZON_IGNORED },
    { "dark", PE_HORIZON_DARK },
    { NULL, 0 },
};

static const cli_option options[] = {
    { "interpolation", 0, "NAME", CLI_CHOICE, offsetof(eval_settings, interpolation), 0, 0, interpolations, "linear", 0,
      "between the representative normals: nearest, weighted or linear" },
    { "exponent", 0, "A", CLI_NUMBER, offsetof(eval_settings, exponent), 0.01, 1000000, NULL, NULL, 0,
      "for weighted: the power of the cosine that weighs the normals. Default: 50 for 42 normals, 50(f/2)^2 for "
      "10f^2+2" },
    { "horizon", 0, "NAME", CLI_CHOICE, offsetof(eval_settings, horizon), 0, 0, horizons, "ignored", 0,
      "of layers and voxels, the light from below the surface: ignored, it counts; dark, it is hidden, as far as the "
      "share of the lobe above the horizon tells" },
    CLI_OPTION_THREADS(eval_settings),
    { .name = NULL },
};

enum { LINES_PER_BLOCK = 2048 };

typedef struct lookup {
    const pe_maps *maps;
    pe_sampling sampling;
} lookup;

static void look_up(const pe_point *point, const void *data, double rgb[3])
{
    const lookup *l = data;

    pe_sample(l->maps, &l->sampling, point, rgb);
}

static int answer_lines(const eval_settings *settings, const pe_maps *maps)
{
    const lookup l = {
        maps, { (pe_interpolation)settings->interpolation, settings->exponent, (pe_horizon)settings->horizon }
    };
    const query_form form = pe_maps_have_roughness(maps) ? QUERY_ROUGHNESS : QUERY_PLAIN;
    const lines_job job = { "eval", settings->threads, LINES_PER_BLOCK, form, look_up, &l };

    return lines_run(&job);
}

/* What says nothing of these maps. */
static int check_method(const eval_settings *settings, const pe_maps *maps)
{
    static const char no_normals[] = "is between normals, of which this file's method has none; leave it out",
                      not_phong[] = "is for maps of the methods layers and voxels, whose lobe knows no surface; leave "
                                    "it out";
    const pe_method method = pe_maps_get_info(maps)->method;
    const int phong = pe_method_has_lambda(method);
    const cli_rule rules[] = {
        { "interpolation", !phong && method != PE_METHOD_BASELINE, no_normals },
        { "horizon", phong, not_phong },
    };

    return cli_check_rules(&eval_command, settings->given, rules, sizeof rules / sizeof *rules);
}

static int eval_run(int argc, char **argv)
{
    eval_settings settings = { 0 };
    pe_maps *maps;
    pe_error error;
    int result = cli_parse(&eval_command, argc, argv, &settings, &settings.given);

    if (result != CLI_PROCEED)
        return result;
    if (settings.exponent != 0 && settings.interpolation != PE_INTERPOLATION_WEIGHTED) {
        cli_error("eval", "--exponent is for --interpolation weighted; leave it out or give both");
        return CLI_FAILURE;
    }
    if (pe_maps_read(settings.maps, &maps, &error) != PE_OK) {
        cli_error("eval", "%s", error.message);
        return CLI_FAILURE;
    }
    result = check_method(&settings, maps);
    if (result == CLI_SUCCESS)
        result = answer_lines(&settings, maps);
    pe_maps_free(maps);
    return result;
}

const cli_command eval_command = {
    "eval",
    "look maps up for lines of normal and viewer",
    "Reads lines 'nx ny nz ox oy oz' from standard input, the normal and the direction to the viewer, or lines "
    "'nx ny nz ox oy oz dx dy dz', with the brush direction there, none of any particular length, and prints the "
    "reflected radiance 'R G B' for each, in order. Of layers and voxels a seventh number is the smoothness lambda, of "
    "grades the roughness alpha. "
    "Blank lines and lines that start with # are passed over.",
    operands,
    options,
    eval_run,
};
