/* ndf.c - `prefenv ndf`: the normal distribution of a measured surface. */
#include "cli.h"
#include "commands.h"
#include "json.h"
#include "prefenv.h"

#include <math.h>
#include <stdio.h>

#define UM_MIN 1e-6 /* a picometre */
#define UM_MAX 1e9  /* a kilometre */

enum { HEIGHTS = -1 }; /* --normal-map was not given */

typedef struct ndf_settings {
    const char *input, *output;
    double height, pitch, scale;
    int green; /* a pe_green, or HEIGHTS */
    int wrap, turn, keep_tilt;
    double range, smooth;
    int raw, json, quiet;
} ndf_settings;

static const cli_operand operands[] = {
    { "SURFACE", offsetof(ndf_settings, input), "a height map, or with --normal-map normals: OpenEXR or PNG" },
    { NULL, 0, NULL },
};

static const cli_choice greens[] = {
    { "none", HEIGHTS },
    { "opengl", PE_GREEN_UP },
    { "directx", PE_GREEN_DOWN },
    { NULL, 0 },
};

static const cli_option options[] = {
    { "output", 'o', "NDF.exr", CLI_TEXT, offsetof(ndf_settings, output), 0, 0, NULL, NULL, 1,
      "the distribution to write, for 'prefenv bake --ndf'" },
    { "height", 0, "LENGTH", CLI_LENGTH, offsetof(ndf_settings, height), UM_MIN, UM_MAX, NULL, NULL, 0,
      "what the value 1 stands for: in a PNG, white over black" },
    { "pitch", 0, "LENGTH", CLI_LENGTH, offsetof(ndf_settings, pitch), UM_MIN, UM_MAX, NULL, NULL, 0,
      "distance of texels; what 'prefenv surface' made knows both" },
    { "scale", 0, "RATIO", CLI_NUMBER, offsetof(ndf_settings, scale), 1e-12, 1e12, NULL, NULL, 0,
      "the two in one number: height divided by pitch" },
    { "normal-map", 0, "GREEN", CLI_CHOICE, offsetof(ndf_settings, green), 0, 0, greens, "none", 0,
      "SURFACE holds normals in tangent space: opengl, green up, or directx, green down" },
    { "wrap", 0, NULL, CLI_SWITCH, offsetof(ndf_settings, wrap), 0, 0, NULL, NULL, 0,
      "the height map repeats itself; without it the three texels at each edge have no slope" },
    { "turn", 0, NULL, CLI_SWITCH, offsetof(ndf_settings, turn), 0, 0, NULL, NULL, 0,
      "the brush direction is down the picture's columns; without it, along its rows" },
    { "keep-tilt", 0, NULL, CLI_SWITCH, offsetof(ndf_settings, keep_tilt), 0, 0, NULL, NULL, 0,
      "do not level: leave the mean slope in" },
    { "range", 0, "SLOPE", CLI_NUMBER, offsetof(ndf_settings, range), 0.004, 100, NULL, NULL, 0,
      "how far the table reaches. Default: as far as all but 0.01 % of the area, along each axis" },
    { "smooth", 0, "SLOPE", CLI_NUMBER, offsetof(ndf_settings, smooth), 1e-6, 1, NULL, NULL, 0,
      "blur the distribution with a Gaussian of this standard deviation. Default: as much as lets one half of the "
      "surface foretell the other best" },
    { "raw", 0, NULL, CLI_SWITCH, offsetof(ndf_settings, raw), 0, 0, NULL, NULL, 0, "do not blur it" },
    CLI_OPTION_JSON(ndf_settings),
    CLI_OPTION_QUIET(ndf_settings),
    { .name = NULL },
};

/* What was found out on the way to the table. */
typedef struct findings {
    size_t count, missing;
    double step, noise;
    pe_slope_statistics statistics;
    int width, height;
    double range[2], smooth[2], beyond;
} findings;

static int check_settings(const ndf_settings *s)
{
    const char *inputs[] = { s->input, NULL };
    int scaled = s->height > 0 || s->pitch > 0 || s->scale > 0;

    if (s->green != HEIGHTS && (scaled || s->wrap))
        cli_error("ndf", "a normal map holds slopes as it is; --height, --pitch, --scale and --wrap are for heights");
    else if (s->scale > 0 && (s->height > 0 || s->pitch > 0))
        cli_error("ndf", "--scale is --height divided by --pitch; give it, or the two");
    else if ((s->height > 0) != (s->pitch > 0))
        cli_error("ndf", "--height and --pitch make a scale together; --%s is missing",
                  s->pitch > 0 ? "height" : "pitch");
    else if (s->raw && s->smooth > 0)
        cli_error("ndf", "--raw and --smooth exclude each other; give one of them");
    else
        return cli_check_exr_output("ndf", s->output, inputs);
    return CLI_FAILURE;
}

/* ---- the measurement ---- */

static pe_status read_heights(const ndf_settings *s, pe_slopes *slopes, pe_error *error)
{
    double unit = s->scale > 0 ? s->scale : s->height, pitch = s->scale > 0 ? 1 : s->pitch;
    pe_heights heights;
    pe_status status = pe_heights_read(s->input, unit, pitch, &heights, error);

    if (status != PE_OK)
        return status;
    if (unit > 0 && heights.own_pitch > 0 && !s->quiet)
        cli_warning("ndf", "%s: states its scale, a pitch of %g um, which the one given takes the place of", s->input,
                    heights.own_pitch);
    status = pe_slopes_of_heights(&heights, s->wrap ? PE_EDGES_WRAP : PE_EDGES_OPEN, slopes, error);
    pe_heights_free(&heights);
    return status;
}

static pe_status read_normals(const ndf_settings *s, pe_slopes *slopes, pe_error *error)
{
    pe_image image;
    pe_status status = pe_image_read_data(s->input, &image, error);

    if (status != PE_OK)
        return status;
    status = pe_slopes_of_normals(&image, s->input, (pe_green)s->green, slopes, error);
    pe_image_free(&image);
    return status;
}

static pe_status write_table(const ndf_settings *s, const pe_slope_density *d, pe_error *error)
{
    const double p_range[2] = { -d->range[0], d->range[0] }, q_range[2] = { -d->range[1], d->range[1] };
    pe_ndf_table *table;
    pe_status status = pe_ndf_table_create(d->width, d->height, p_range, q_range, d->values, &table, error);

    if (status != PE_OK)
        return status;
    status = pe_ndf_table_write(table, s->output, error);
    pe_ndf_table_free(table);
    return status;
}

static pe_status measure_slopes(const ndf_settings *s, pe_slopes *slopes, findings *found, pe_error *error)
{
    const pe_density_options how = {
        .range = s->range,
        .smoothing = s->raw          ? PE_SMOOTHING_NONE
                     : s->smooth > 0 ? PE_SMOOTHING_GIVEN
                                     : PE_SMOOTHING_AUTO,
        .smooth = s->smooth,
    };
    pe_slope_density density;
    pe_status status;

    if (s->turn)
        pe_slopes_turn(slopes);
    pe_slopes_measure(slopes, &found->statistics);
    if (!s->keep_tilt)
        pe_slopes_level(slopes);
    status = pe_slopes_density(slopes, &how, &density, error);
    if (status != PE_OK)
        return status;
    found->count = slopes->count;
    found->missing = slopes->missing;
    found->step = slopes->step;
    found->noise = slopes->noise;
    found->width = density.width;
    found->height = density.height;
    found->beyond = density.beyond;
    for (int axis = 0; axis < 2; axis++) {
        found->range[axis] = density.range[axis];
        found->smooth[axis] = density.smooth[axis];
    }
    status = write_table(s, &density, error);
    pe_slope_density_free(&density);
    return status;
}

static pe_status measure_file(const ndf_settings *s, findings *found, pe_error *error)
{
    pe_slopes slopes;
    pe_status status = s->green == HEIGHTS ? read_heights(s, &slopes, error) : read_normals(s, &slopes, error);

    if (status != PE_OK)
        return status;
    status = measure_slopes(s, &slopes, found, error);
    pe_slopes_free(&slopes);
    return status;
}

/* ---- the report ---- */

static double degrees(double slope)
{
    return atan(slope) * 180 / M_PI;
}

static void print_text(const ndf_settings *s, const findings *f)
{
    const pe_slope_statistics *m = &f->statistics;

    printf("slopes     %zu, and %zu texels without\n", f->count, f->missing);
    printf("tilt       %.4f along the brush, %.4f across: %.2f degrees, %s\n", m->mean[0], m->mean[1],
           degrees(hypot(m->mean[0], m->mean[1])), s->keep_tilt ? "left in" : "taken off");
    printf("rms slope  %.4g along the brush, %.4g across, %.4g in all (Sdq)\n", m->rms[0], m->rms[1],
           hypot(m->rms[0], m->rms[1]));
    printf("alpha      %.4g along the brush, %.4g across: Beckmann's of these rms slopes\n", m->alpha[0], m->alpha[1]);
    printf("steepest   %.4g, %.3g degrees\n", m->steepest, degrees(m->steepest));
    printf("table      %dx%d cells to slopes of %.4g, %.4g\n", f->width, f->height, f->range[0], f->range[1]);
    printf("smoothed   by %.2g, %.2g%s\n", f->smooth[0], f->smooth[1],
           s->raw || s->smooth > 0 ? "" : ", as found best");
    printf("beyond     %.2g %% of the area\n", 100 * f->beyond);
}

static void print_json(const ndf_settings *s, const findings *f)
{
    const pe_slope_statistics *m = &f->statistics;
    json out = { 0 };

    json_open(&out, NULL);
    json_text(&out, "file", s->output);
    json_text(&out, "surface", s->input);
    json_integer(&out, "slopes", (long long)f->count);
    json_integer(&out, "missing", (long long)f->missing);
    json_numbers(&out, "tilt", m->mean, 2);
    json_numbers(&out, "rms_slope", m->rms, 2);
    json_numbers(&out, "alpha", m->alpha, 2);
    json_number(&out, "steepest", m->steepest);
    json_number(&out, "rounding_noise", f->noise);
    json_integer(&out, "width", f->width);
    json_integer(&out, "height", f->height);
    json_numbers(&out, "range", f->range, 2);
    json_numbers(&out, "smooth", f->smooth, 2);
    json_number(&out, "beyond", f->beyond);
    json_close(&out);
}

/* Noise adds to the square of the rms slope: at a third of it, alpha is 5 % too large. */
static void warn(const findings *f)
{
    double least = fmin(f->statistics.rms[0], f->statistics.rms[1]);

    if (f->noise > least / 3)
        cli_warning("ndf",
                    "its values are rounded so coarsely that they add an rms slope of %.2g to one of %.2g; "
                    "16 bits or floats are wanted",
                    f->noise, least);
    if (f->beyond > 0.01)
        cli_warning("ndf", "%.2g %% of the area is steeper than the range and left out; widen --range",
                    100 * f->beyond);
}

static int ndf_run(int argc, char **argv)
{
    ndf_settings settings = { 0 };
    findings found = { 0 };
    pe_error error;
    int proceed = cli_parse(&ndf_command, argc, argv, &settings, NULL);

    if (proceed != CLI_PROCEED)
        return proceed;
    if (check_settings(&settings) != CLI_SUCCESS)
        return CLI_FAILURE;
    if (measure_file(&settings, &found, &error) != PE_OK) {
        cli_error("ndf", "%s", error.message);
        return CLI_FAILURE;
    }
    if (!settings.quiet)
        warn(&found);
    if (settings.json)
        print_json(&settings, &found);
    else if (!settings.quiet)
        print_text(&settings, &found);
    return cli_flush("ndf");
}

const cli_command ndf_command = {
    "ndf",
    "measure the normal distribution of a machined surface",
    "Measures the distribution of normals of a surface from its heights or from a normal map, and writes the table "
    "that "
    "'prefenv bake --ndf' filters with. The brush direction is along the picture's rows, and so should the grooves be.",
    operands,
    options,
    ndf_run,
};
