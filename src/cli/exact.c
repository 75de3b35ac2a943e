/* exact.c - `prefenv exact`: what eval approximates, from every texel of the environment [Motegi Eq. 4]. */
#include "cli.h"
#include "commands.h"
#include "lines.h"
#include "maps.h"
#include "prefenv.h"
#include "reflectance.h"
#include "vector.h"

typedef struct exact_settings {
    const char *environment;
    cli_surface surface;
    double direction[3];
    int phong, horizon, size;
    double window, levels;
    int threads, quiet;
    cli_given given;
} exact_settings;

static const cli_operand operands[] = {
    { "ENV", offsetof(exact_settings, environment), "lat-long environment: OpenEXR, Radiance HDR or PNG" },
    { NULL, 0, NULL },
};

static const cli_choice horizons[] = {
    { "ignored", PE_HORIZON_IGNORED },
    { "dark", PE_HORIZON_DARK },
    { "mean", PE_HORIZON_MEAN },
    { NULL, 0 },
};

static const cli_option options[] = {
    CLI_OPTION_NDF(exact_settings),
    CLI_OPTION_ALPHA(exact_settings),
    CLI_OPTION_ASPECT(exact_settings),
    CLI_OPTION_DIRECTION(exact_settings),
    CLI_OPTION_WEIGHT(exact_settings),
    CLI_OPTION_MATERIAL(exact_settings),
    CLI_OPTION_IOR(exact_settings),
    CLI_OPTION_K(exact_settings),
    { "phong", 0, NULL, CLI_SWITCH, offsetof(exact_settings, phong), 0, 0, NULL, NULL, 0,
      "Phong's lobe about the mirror direction, its smoothness lambda the seventh number of each line: what maps of "
      "the methods voxels and layers look up" },
    { "size", 0, "S", CLI_INTEGER, offsetof(exact_settings, size), PE_SMOOTHNESS_SIZE_MIN, PE_SMOOTHNESS_SIZE_MAX, NULL,
      "128", 0, "for --phong: the voxels along the cube's edge that lambda refers to" },
    CLI_OPTION_WINDOW(exact_settings),
    CLI_OPTION_LEVELS(exact_settings),
    { "horizon", 0, "NAME", CLI_CHOICE, offsetof(exact_settings, horizon), 0, 0, horizons, "ignored", 0,
      "for --phong, the light from below the surface: ignored, it counts; dark, it is hidden; mean, it is hidden and "
      "the rest averaged" },
    CLI_OPTION_THREADS(exact_settings),
    CLI_OPTION_QUIET(exact_settings),
    { .name = NULL },
};

enum { LINES_PER_BLOCK = 4 }; /* a line takes about as long as a million texels do */

typedef struct truth {
    const pe_env *env;
    pe_surface surface;
    double alpha_max; /* where a range of alpha_x ends, that begins with the surface's; 0: there is none */
    double direction[3];
    pe_smoothness scale;
    pe_horizon horizon;
} truth;

static void sum_up(const pe_point *point, const void *data, double rgb[3])
{
    const truth *t = data;

    pe_exact(t->env, &t->surface, point->direction ? point->direction : t->direction, point->n, point->o, rgb);
}

/* What lies beyond the range is as its end, as with maps. */
static void sum_up_rough(const pe_point *point, const void *data, double rgb[3])
{
    const truth *t = data;
    pe_surface surface = t->surface;

    surface.ndf = pe_grades_ndf(&t->surface.ndf, t->alpha_max, point->roughness);
    pe_exact(t->env, &surface, point->direction ? point->direction : t->direction, point->n, point->o, rgb);
}

static void sum_up_phong(const pe_point *point, const void *data, double rgb[3])
{
    const truth *t = data;
    double n[3], o[3], r[3];

    pe_normalize_any(point->n, n);
    pe_normalize_any(point->o, o);
    if (pe_dot(n, o) < 0)
        pe_scale(-1, n, n);
    pe_reflect(o, n, r);
    pe_phong(t->env, pe_smoothness_exponent(&t->scale, point->roughness), t->horizon, n, r, rgb);
}

static int answer_lines(const exact_settings *settings, const pe_surface *surface, const pe_env *env)
{
    const truth t = {
        env,
        *surface,
        settings->surface.alpha[2],
        { settings->direction[0], settings->direction[1], settings->direction[2] },
        { settings->size, settings->window, settings->levels },
        (pe_horizon)settings->horizon,
    };
    query_function *function = settings->phong ? sum_up_phong : t.alpha_max > 0 ? sum_up_rough : sum_up;
    const lines_job job = { "exact",         settings->threads,
                            LINES_PER_BLOCK, function == sum_up ? QUERY_PLAIN : QUERY_ROUGHNESS,
                            function,        &t };

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

/* What says how Phong's lobe is meant, and what says that another one is. */
static int check_lobe(const exact_settings *settings)
{
    static const char with[] = "is for --phong; give both, or neither",
                      without[] = "does not go with --phong, whose roughness is said at each line; leave one of "
                                  "them out";
    const int phong = settings->phong;
    const cli_rule rules[] = {
        { "size", phong, with },         { "window", phong, with },        { "levels", phong, with },
        { "horizon", phong, with },      { "ndf", !phong, without },       { "alpha", !phong, without },
        { "aspect", !phong, without },   { "direction", !phong, without }, { "weight", !phong, without },
        { "material", !phong, without }, { "ior", !phong, without },       { "k", !phong, without },
    };

    return cli_check_rules(&exact_command, settings->given, rules, sizeof rules / sizeof *rules);
}

static int check_scale(const exact_settings *settings)
{
    const pe_smoothness scale = { settings->size, settings->window, settings->levels };
    pe_error error;

    if (pe_smoothness_check(&scale, &error) == PE_OK)
        return CLI_SUCCESS;
    cli_error("exact", "%s", error.message);
    return CLI_FAILURE;
}

static int exact_run(int argc, char **argv)
{
    exact_settings settings = { 0 };
    pe_surface surface;
    pe_ndf_table *table;
    int result = cli_parse(&exact_command, argc, argv, &settings, &settings.given);

    if (result != CLI_PROCEED)
        return result;
    if (check_lobe(&settings) != CLI_SUCCESS || check_scale(&settings) != CLI_SUCCESS ||
        cli_make_surface("exact", &settings.surface, &surface, &table) != CLI_SUCCESS)
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
