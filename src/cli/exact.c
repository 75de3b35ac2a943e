/* exact.c - `prefenv exact`: what eval approximates, from every texel of the environment [Motegi Eq. 4]. */
#include "cli.h"
#include "commands.h"
#include "lines.h"
#include "prefenv.h"
#include "reflectance.h"

typedef struct exact_settings {
    const char *environment;
    cli_surface surface;
    double direction[3];
    int threads, quiet;
} exact_settings;

static const cli_operand operands[] = {
    { "ENV", offsetof(exact_settings, environment), "lat-long environment: OpenEXR, Radiance HDR or PNG" },
    { NULL, 0, NULL },
};

static const cli_option options[] = {
    CLI_OPTION_NDF(exact_settings),       CLI_OPTION_ALPHA(exact_settings),
    CLI_OPTION_DIRECTION(exact_settings), CLI_OPTION_WEIGHT(exact_settings),
    CLI_OPTION_MATERIAL(exact_settings),  CLI_OPTION_IOR(exact_settings),
    CLI_OPTION_K(exact_settings),         CLI_OPTION_THREADS(exact_settings),
    CLI_OPTION_QUIET(exact_settings),     { .name = NULL },
};

enum { LINES_PER_BLOCK = 4 }; /* a line takes about as long as a million texels do */

typedef struct truth {
    const pe_env *env;
    pe_surface surface;
    double direction[3];
} truth;

static void sum_up(const pe_point *point, const void *data, double rgb[3])
{
    const truth *t = data;

    pe_exact(t->env, &t->surface, point->direction ? point->direction : t->direction, point->n, point->o, rgb);
}

static int answer_lines(const exact_settings *settings, const pe_surface *surface, const pe_env *env)
{
    const truth t = {
        env,
        *surface,
        { settings->direction[0], settings->direction[1], settings->direction[2] },
    };
    const lines_job job = { "exact", settings->threads, LINES_PER_BLOCK, sum_up, &t };

    return lines_run(&job);
}

static int answer(const exact_settings *settings, const pe_surface *surface)
{
    pe_env *env;
    pe_error error;
    int result;

    if (cli_read_environment(settings->environment, &env, &error) != PE_OK) {
        cli_error("exact", "%s", error.message);
        return CLI_FAILURE;
    }
    if (!settings->quiet)
        cli_warn_of_flaws("exact", settings->environment, env);
    result = answer_lines(settings, surface, env);
    pe_env_free(env);
    return result;
}

static int exact_run(int argc, char **argv)
{
    exact_settings settings = { 0 };
    pe_surface surface;
    pe_ndf_table *table;
    int result = cli_parse(&exact_command, argc, argv, &settings);

    if (result != CLI_PROCEED)
        return result;
    if (cli_make_surface("exact", &settings.surface, &surface, &table) != CLI_SUCCESS)
        return CLI_FAILURE;
    result = answer(&settings, &surface);
    pe_ndf_table_free(table);
    return result;
}

const cli_command exact_command = {
    "exact",
    "compute the exact radiance for lines of normal and viewer",
    "Reads and prints the same lines as 'prefenv eval', but sums over every texel of the environment in double "
    "precision: slow, and the truth that eval is measured against.",
    operands,
    options,
    exact_run,
};
