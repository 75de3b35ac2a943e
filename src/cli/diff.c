/* diff.c - `prefenv diff`: a picture against its reference. */
#include "cli.h"
#include "commands.h"
#include "json.h"
#include "measure.h"
#include "prefenv.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct diff_settings {
    const char *image, *reference, *mask, *output;
    double amplify, limit, relative_limit;
    int json, quiet;
    cli_given given;
} diff_settings;

static const cli_operand operands[] = {
    { "IMAGE", offsetof(diff_settings, image), "the picture: OpenEXR, Radiance HDR or PNG" },
    { "REFERENCE", offsetof(diff_settings, reference), "what it should be, of the same size" },
    { NULL, 0, NULL },
};

static const cli_option options[] = {
    { "mask", 0, "IMAGE", CLI_TEXT, offsetof(diff_settings, mask), 0, 0, NULL, NULL, 0,
      "count only the pixels where this picture's alpha, or its luminance if it is opaque, is above 1/2" },
    { "output", 'o', "DIFF.png", CLI_TEXT, offsetof(diff_settings, output), 0, 0, NULL, NULL, 0,
      "write a picture of the absolute differences" },
    { "amplify", 0, "FACTOR", CLI_NUMBER, offsetof(diff_settings, amplify), 0.001, 1000000, NULL, "4", 0,
      "multiply the differences in that picture" },
    { "fail-above", 0, "RMSE", CLI_NUMBER, offsetof(diff_settings, limit), 0, INFINITY, NULL, NULL, 0,
      "exit with 1 if the RMSE is greater" },
    { "fail-above-relative", 0, "R", CLI_NUMBER, offsetof(diff_settings, relative_limit), 0, INFINITY, NULL, NULL, 0,
      "exit with 1 if the relative RMSE is greater" },
    CLI_OPTION_JSON(diff_settings),
    CLI_OPTION_QUIET(diff_settings),
    { .name = NULL },
};

typedef struct pictures {
    pe_image image, reference, mask;
    unsigned char *keep;
} pictures;

static int read_picture(const char *path, pe_image *picture)
{
    pe_error error;

    if (pe_image_read(path, picture, &error) == PE_OK)
        return CLI_SUCCESS;
    cli_error("diff", "%s", error.message);
    return CLI_FAILURE;
}

static int check_size(const char *path, const pe_image *picture, const char *other_path, const pe_image *other)
{
    if (picture->width == other->width && picture->height == other->height)
        return CLI_SUCCESS;
    cli_error("diff", "%s is %dx%d, but %s is %dx%d; the sizes must be the same", path, picture->width, picture->height,
              other_path, other->width, other->height);
    return CLI_FAILURE;
}

static int read_mask(const diff_settings *settings, pictures *all)
{
    size_t count = (size_t)all->image.width * (size_t)all->image.height;

    if (read_picture(settings->mask, &all->mask) != CLI_SUCCESS ||
        check_size(settings->mask, &all->mask, settings->image, &all->image) != CLI_SUCCESS)
        return CLI_FAILURE;
    all->keep = measure_keep(&all->mask);
    if (!all->keep) {
        cli_error("diff", "out of memory");
        return CLI_FAILURE;
    }
    if (memchr(all->keep, 1, count))
        return CLI_SUCCESS;
    cli_error("diff", "%s keeps no pixel: its %s is nowhere above 1/2", settings->mask,
              all->mask.alpha ? "alpha or luminance" : "luminance");
    return CLI_FAILURE;
}

static int read_all(const diff_settings *settings, pictures *all)
{
    if (read_picture(settings->image, &all->image) != CLI_SUCCESS ||
        read_picture(settings->reference, &all->reference) != CLI_SUCCESS ||
        check_size(settings->image, &all->image, settings->reference, &all->reference) != CLI_SUCCESS)
        return CLI_FAILURE;
    return settings->mask ? read_mask(settings, all) : CLI_SUCCESS;
}

static void print_text(const measures *m)
{
    printf("pixels         %zu\n", m->pixels);
    if (m->not_finite)
        printf("not finite     %zu, left out\n", m->not_finite);
    printf("MSE            %.6g\n", m->mse);
    printf("RMSE           %.6g\n", m->rmse);
    printf("relative RMSE  %.6g %%\n", 100 * m->relative_rmse);
    printf("relative L2    %.6g %%\n", 100 * m->relative_l2);
    printf("PSNR           %.6g dB\n", m->psnr);
    printf("worst pixel    (%d, %d) differs by %.6g: %.6g %.6g %.6g, reference %.6g %.6g %.6g\n", m->worst_x,
           m->worst_y, m->worst_difference, m->worst[0], m->worst[1], m->worst[2], m->worst_reference[0],
           m->worst_reference[1], m->worst_reference[2]);
    printf("levels of 255  mean %.4g %.4g %.4g, variance %.4g %.4g %.4g\n", m->level_mean[0], m->level_mean[1],
           m->level_mean[2], m->level_variance[0], m->level_variance[1], m->level_variance[2]);
}

static void print_json(const diff_settings *settings, const pictures *all, const measures *m)
{
    json out = { 0 };

    json_open(&out, NULL);
    json_text(&out, "image", settings->image);
    json_text(&out, "reference", settings->reference);
    if (settings->mask)
        json_text(&out, "mask", settings->mask);
    json_integer(&out, "width", all->image.width);
    json_integer(&out, "height", all->image.height);
    json_integer(&out, "pixels", (long long)m->pixels);
    json_integer(&out, "not_finite", (long long)m->not_finite);
    json_number(&out, "mse", m->mse);
    json_number(&out, "rmse", m->rmse);
    json_number(&out, "relative_rmse", m->relative_rmse);
    json_number(&out, "relative_l2", m->relative_l2);
    json_number(&out, "psnr", m->psnr);
    json_open(&out, "worst");
    json_integer(&out, "x", m->worst_x);
    json_integer(&out, "y", m->worst_y);
    json_number(&out, "difference", m->worst_difference);
    json_numbers(&out, "image", m->worst, 3);
    json_numbers(&out, "reference", m->worst_reference, 3);
    json_close(&out);
    json_numbers(&out, "level_mean", m->level_mean, 3);
    json_numbers(&out, "level_variance", m->level_variance, 3);
    json_close(&out);
}

/* A negative limit means that none was given. */
static int judge(const diff_settings *settings, const measures *m)
{
    int result = CLI_SUCCESS;

    if (m->not_finite) {
        cli_error("diff", "%zu %s NaN or infinite in one of the pictures", m->not_finite,
                  m->not_finite == 1 ? "pixel is" : "pixels are");
        result = CLI_ABOVE_LIMIT;
    }
    if (settings->limit >= 0 && m->rmse > settings->limit) {
        cli_error("diff", "the RMSE of %g is above %g", m->rmse, settings->limit);
        result = CLI_ABOVE_LIMIT;
    }
    if (settings->relative_limit >= 0 && m->relative_rmse > settings->relative_limit) {
        cli_error("diff", "the relative RMSE of %g is above %g", m->relative_rmse, settings->relative_limit);
        result = CLI_ABOVE_LIMIT;
    }
    return result;
}

static int write_picture(const diff_settings *settings, const pictures *all)
{
    pe_image picture;
    pe_error error = { PE_ERROR_MEMORY, "out of memory" };
    pe_status status = measure_picture(&all->image, &all->reference, all->keep, settings->amplify, &picture);

    if (status == PE_OK) {
        status = pe_image_write_png(settings->output, &picture, &error);
        pe_image_free(&picture);
    }
    if (status == PE_OK)
        return CLI_SUCCESS;
    cli_error("diff", "%s", error.message);
    return CLI_FAILURE;
}

static int compare(const diff_settings *settings, const pictures *all)
{
    measures m;

    measure_difference(&all->image, &all->reference, all->keep, &m);
    if (settings->output && write_picture(settings, all) != CLI_SUCCESS)
        return CLI_FAILURE;
    if (settings->json)
        print_json(settings, all, &m);
    else if (!settings->quiet)
        print_text(&m);
    return cli_flush("diff") == CLI_SUCCESS ? judge(settings, &m) : CLI_FAILURE;
}

static int check_output(const diff_settings *settings)
{
    const char *inputs[] = { settings->image, settings->reference, settings->mask, NULL };
    size_t length = strlen(settings->output);

    if (length >= 4 && strchr(settings->output + length - 4, '.') &&
        strcasecmp(settings->output + length - 4, ".png")) {
        cli_error("diff", "%s: the picture of differences is a PNG; name it so", settings->output);
        return CLI_FAILURE;
    }
    return cli_check_output("diff", settings->output, inputs);
}

static int check_settings(const diff_settings *settings)
{
    const cli_rule amplify = { "amplify", settings->output != NULL,
                               "is for the picture of differences; give -o DIFF.png, too, or leave it out" };

    if (cli_check_rules(&diff_command, settings->given, &amplify, 1) != CLI_SUCCESS)
        return CLI_FAILURE;
    return settings->output ? check_output(settings) : CLI_SUCCESS;
}

static int diff_run(int argc, char **argv)
{
    diff_settings settings = { .limit = -1, .relative_limit = -1 };
    pictures all;
    int result = cli_parse(&diff_command, argc, argv, &settings, &settings.given);

    if (result != CLI_PROCEED)
        return result;
    if (check_settings(&settings) != CLI_SUCCESS)
        return CLI_FAILURE;
    memset(&all, 0, sizeof all);
    result = read_all(&settings, &all);
    if (result == CLI_SUCCESS)
        result = compare(&settings, &all);
    pe_image_free(&all.image);
    pe_image_free(&all.reference);
    pe_image_free(&all.mask);
    free(all.keep);
    return result;
}

const cli_command diff_command = {
    "diff",
    "compare a picture with a reference",
    "Compares a picture with its reference, in linear values: mean squared error, RMSE, the same relative to the "
    "reference, PSNR, the worst pixel, and mean and variance of the absolute difference per channel in display levels.",
    operands,
    options,
    diff_run,
};
