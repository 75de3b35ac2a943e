/* reflectance.c - what the options say of the surface: --ndf, --alpha. */
#include "reflectance.h"
#include "cli.h"

#include <string.h>

static const struct {
    const char *name;
    pe_ndf_kind kind;
} closed_forms[] = { { "beckmann", PE_NDF_BECKMANN }, { "ggx", PE_NDF_GGX }, { "phong", PE_NDF_PHONG } };

enum { CLOSED_FORMS = sizeof closed_forms / sizeof *closed_forms };

/* A file has a dot or a slash in its name. */
static int is_file(const char *text)
{
    return strpbrk(text, "./") != NULL;
}

static int read_table(const char *command, const cli_surface *asked, pe_ndf *ndf, pe_ndf_table **table)
{
    pe_error error;

    if (asked->alpha[0] > 0) {
        cli_error(command, "--alpha does not go with --ndf %s, which has its widths from its file; leave it out",
                  asked->ndf);
        return CLI_FAILURE;
    }
    if (pe_ndf_table_read(asked->ndf, table, &error) != PE_OK) {
        cli_error(command, "%s", error.message);
        return CLI_FAILURE;
    }
    *ndf = (pe_ndf){ .kind = PE_NDF_TABLE, .table = *table };
    return CLI_SUCCESS;
}

static int choose_ndf(const char *command, const cli_surface *asked, pe_ndf *ndf)
{
    const char *names[CLOSED_FORMS], *nearest;

    for (int k = 0; k < CLOSED_FORMS; k++) {
        names[k] = closed_forms[k].name;
        if (strcmp(names[k], asked->ndf) == 0) {
            *ndf = (pe_ndf){ closed_forms[k].kind, asked->alpha[0], asked->alpha[1], NULL };
            if (ndf->alpha_x == 0)
                ndf->alpha_x = ndf->alpha_y = 0.1;
            return CLI_SUCCESS;
        }
    }
    nearest = cli_nearest(asked->ndf, names, CLOSED_FORMS);
    if (nearest)
        cli_error(command, "--ndf %s: not known; did you mean %s?", asked->ndf, nearest);
    else
        cli_error(command, "--ndf %s: not known; what there is: beckmann, ggx, phong, or a file such as cut.ndf.exr",
                  asked->ndf);
    return CLI_FAILURE;
}

int cli_make_surface(const char *command, const cli_surface *asked, pe_surface *surface, pe_ndf_table **table)
{
    pe_error error;

    *surface = (pe_surface){ .weight = PE_WEIGHT_NDF };
    *table = NULL;
    if ((is_file(asked->ndf) ? read_table(command, asked, &surface->ndf, table)
                             : choose_ndf(command, asked, &surface->ndf)) != CLI_SUCCESS)
        return CLI_FAILURE;
    if (pe_surface_check(surface, &error) == PE_OK)
        return CLI_SUCCESS;
    pe_ndf_table_free(*table);
    cli_error(command, "%s", error.message);
    return CLI_FAILURE;
}
