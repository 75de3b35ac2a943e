/* info.c - `prefenv info`: what a file of ours says of itself: maps, a table of slopes, a height field. */
#include "cli.h"
#include "commands.h"
#include "describe.h"
#include "prefenv.h"
#include "status.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct info_settings {
    const char *file;
    int json;
} info_settings;

static const cli_operand operands[] = {
    { "FILE", offsetof(info_settings, file), "a maps file, a table of 'prefenv ndf' or heights of 'prefenv surface'" },
    { NULL, 0, NULL },
};

static const cli_option options[] = { CLI_OPTION_JSON(info_settings), { .name = NULL } };

/* The bytes of a file of one kind. */
typedef struct content {
    const info_settings *settings;
    const unsigned char *bytes;
    size_t size;
} content;

static void open_json(json *out, const info_settings *settings, const char *kind)
{
    json_open(out, NULL);
    json_text(out, "file", settings->file);
    json_text(out, "kind", kind);
}

/* ---- maps ---- */

static pe_status tell_maps(const content *c, pe_error *error)
{
    json out = { 0 };
    pe_maps *maps;
    pe_status status = pe_maps_read_memory(c->bytes, c->size, c->settings->file, &maps, error);

    if (status != PE_OK)
        return status;
    if (c->settings->json) {
        open_json(&out, c->settings, "maps");
        describe_maps_json(&out, maps);
        json_close(&out);
    } else {
        printf("file       %s\n", c->settings->file);
        describe_maps(maps);
    }
    pe_maps_free(maps);
    return PE_OK;
}

/* ---- what is measured: rms slopes, and the alpha of Beckmann's distribution of the same ---- */

static void print_slopes(const double alpha[2])
{
    printf("rms slope  %.4g along the brush, %.4g across\n", alpha[0] * M_SQRT1_2, alpha[1] * M_SQRT1_2);
    printf("alpha      %.4g along the brush, %.4g across: Beckmann's of these rms slopes\n", alpha[0], alpha[1]);
}

static void write_slopes(json *out, const double alpha[2])
{
    const double rms[2] = { alpha[0] * M_SQRT1_2, alpha[1] * M_SQRT1_2 };

    json_numbers(out, "rms_slope", rms, 2);
    json_numbers(out, "alpha", alpha, 2);
}

static void print_table(const info_settings *settings, const pe_ndf_table *table)
{
    double p[2], q[2], alpha[2];
    int width, height;
    json out = { 0 };

    pe_ndf_table_size(table, &width, &height, p, q);
    pe_ndf_table_alpha(table, alpha);
    if (settings->json) {
        open_json(&out, settings, "table");
        json_integer(&out, "width", width);
        json_integer(&out, "height", height);
        json_numbers(&out, "p_range", p, 2);
        json_numbers(&out, "q_range", q, 2);
        write_slopes(&out, alpha);
        json_close(&out);
        return;
    }
    printf("file       %s\n", settings->file);
    printf("kind       table of slopes, for bake --ndf\n");
    printf("table      %dx%d cells, slopes %.4g to %.4g along the brush, %.4g to %.4g across\n", width, height, p[0],
           p[1], q[0], q[1]);
    print_slopes(alpha);
}

static pe_status tell_table(const content *c, pe_error *error)
{
    pe_ndf_table *table;
    pe_status status = pe_ndf_table_read_memory(c->bytes, c->size, c->settings->file, &table, error);

    if (status != PE_OK)
        return status;
    print_table(c->settings, table);
    pe_ndf_table_free(table);
    return PE_OK;
}

static void print_heights(const info_settings *settings, const pe_heights *heights, const double alpha[2])
{
    const double size[2] = { heights->width * heights->pitch, heights->height * heights->pitch };
    json out = { 0 };

    if (settings->json) {
        open_json(&out, settings, "heights");
        json_integer(&out, "width", heights->width);
        json_integer(&out, "height", heights->height);
        json_number(&out, "pitch", heights->pitch);
        write_slopes(&out, alpha);
        json_close(&out);
        return;
    }
    printf("file       %s\n", settings->file);
    printf("kind       height field, for prefenv ndf\n");
    printf("heights    %dx%d texels of %g um, %g by %g um\n", heights->width, heights->height, heights->pitch, size[0],
           size[1]);
    print_slopes(alpha);
}

static pe_status tell_heights(const content *c, pe_error *error)
{
    pe_slope_statistics statistics;
    pe_heights heights;
    pe_slopes slopes;
    pe_status status = pe_heights_read_memory(c->bytes, c->size, c->settings->file, 0, 0, &heights, error);

    if (status != PE_OK)
        return status;
    status = pe_slopes_of_heights(&heights, PE_EDGES_OPEN, &slopes, error);
    if (status == PE_OK) {
        pe_slopes_measure(&slopes, &statistics);
        print_heights(c->settings, &heights, statistics.alpha);
        pe_slopes_free(&slopes);
    }
    pe_heights_free(&heights);
    return status;
}

/* ---- the command ---- */

static pe_status tell(const info_settings *settings, pe_error *error)
{
    content c = { .settings = settings };
    unsigned char *bytes;
    pe_status status = pe_file_read(settings->file, &bytes, &c.size, error);

    if (status != PE_OK)
        return status;
    c.bytes = bytes;
    if (pe_ndf_table_detect(bytes, c.size))
        status = tell_table(&c, error);
    else if (pe_heights_detect(bytes, c.size))
        status = tell_heights(&c, error);
    else
        status = tell_maps(&c, error); /* which says what a maps file is, if this is none */
    free(bytes);
    return status;
}

static int info_run(int argc, char **argv)
{
    info_settings settings = { 0 };
    pe_error error;
    int proceed = cli_parse(&info_command, argc, argv, &settings, NULL);

    if (proceed != CLI_PROCEED)
        return proceed;
    if (tell(&settings, &error) != PE_OK) {
        cli_error("info", "%s", error.message);
        return CLI_FAILURE;
    }
    return cli_flush("info");
}

const cli_command info_command = {
    "info",
    "say what a file of ours holds",
    "Says what a maps file holds: method, normal distribution, normals, size, source, accuracy; of a table of slopes "
    "or "
    "a height field, its size and widths. The whole file is read and checked.",
    operands,
    options,
    info_run,
};
