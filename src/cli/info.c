/* info.c - `prefenv info`: what a maps file says of itself. */
#include "cli.h"
#include "commands.h"
#include "describe.h"
#include "prefenv.h"

#include <stdio.h>

typedef struct info_settings {
    const char *maps;
    int json;
} info_settings;

static const cli_operand operands[] = { { "MAPS", offsetof(info_settings, maps), "a maps file" }, { NULL, 0, NULL } };

static const cli_option options[] = { CLI_OPTION_JSON(info_settings), { .name = NULL } };

static int info_run(int argc, char **argv)
{
    info_settings settings = { 0 };
    pe_maps *maps;
    pe_error error;
    int proceed = cli_parse(&info_command, argc, argv, &settings);

    if (proceed != CLI_PROCEED)
        return proceed;
    if (pe_maps_read(settings.maps, &maps, &error) != PE_OK) {
        cli_error("info", "%s", error.message);
        return CLI_FAILURE;
    }
    if (settings.json) {
        json out = { 0 };

        json_open(&out, NULL);
        json_text(&out, "file", settings.maps);
        describe_maps_json(&out, pe_maps_get_info(maps));
        json_close(&out);
    } else {
        printf("file       %s\n", settings.maps);
        describe_maps(pe_maps_get_info(maps));
    }
    pe_maps_free(maps);
    return cli_flush("info");
}

const cli_command info_command = {
    "info",
    "say what a maps file holds",
    "Says what a maps file holds: method, normal distribution, normals, size, source, accuracy. The whole file is read "
    "and checked.",
    operands,
    options,
    info_run,
};
