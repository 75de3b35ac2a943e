/* reflectance.c - what the options say of the surface: --ndf, --alpha, --aspect, --weight, --material, --ior, --k. */
#include "reflectance.h"
#include "cli.h"

#include <math.h>
#include <stdio.h>
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

    if (asked->alpha[0] > 0 || asked->aspect > 0) {
        cli_error(command, "--%s does not go with --ndf %s, which has its widths from its file; leave it out",
                  asked->alpha[0] > 0 ? "alpha" : "aspect", asked->ndf);
        return CLI_FAILURE;
    }
    if (pe_ndf_table_read(asked->ndf, table, &error) != PE_OK) {
        cli_error(command, "%s", error.message);
        return CLI_FAILURE;
    }
    *ndf = (pe_ndf){ .kind = PE_NDF_TABLE, .table = *table };
    return CLI_SUCCESS;
}

/* A ratio of widths that are written with some digits. */
#define SAME_ASPECT 1e-3

static int choose_aspect(const char *command, const cli_surface *asked, pe_ndf *ndf)
{
    if (asked->aspect == 0)
        return CLI_SUCCESS;
    if (asked->alpha[1] > 0 && fabs(asked->alpha[1] * asked->aspect / asked->alpha[0] - 1) > SAME_ASPECT) {
        cli_error(command, "--aspect %g contradicts --alpha %g,%g, which says both widths; leave it out", asked->aspect,
                  asked->alpha[0], asked->alpha[1]);
        return CLI_FAILURE;
    }
    if (asked->alpha[1] == 0)
        ndf->alpha_y = ndf->alpha_x / asked->aspect;
    return CLI_SUCCESS;
}

static int choose_ndf(const char *command, const cli_surface *asked, pe_ndf *ndf)
{
    const char *names[CLOSED_FORMS], *nearest;

    for (int k = 0; k < CLOSED_FORMS; k++) {
        names[k] = closed_forms[k].name;
        if (strcmp(names[k], asked->ndf) == 0) {
            *ndf = (pe_ndf){ .kind = closed_forms[k].kind, .alpha_x = asked->alpha[0] > 0 ? asked->alpha[0] : 0.1 };
            ndf->alpha_y = asked->alpha[1] > 0 ? asked->alpha[1] : ndf->alpha_x;
            return choose_aspect(command, asked, ndf);
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

static int is_given(const double v[3])
{
    return v[0] != 0 || v[1] != 0 || v[2] != 0;
}

static int choose_material(const char *command, const char *name, pe_surface *surface)
{
    enum { NAMES_MAX = 32 };
    const char *names[NAMES_MAX], *nearest;
    char list[256] = "";
    int count = 0;

    if (pe_material(name, surface->eta, surface->k))
        return CLI_SUCCESS;
    for (; count < NAMES_MAX && pe_material_name(count); count++) {
        size_t used = strlen(list);

        names[count] = pe_material_name(count);
        snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", names[count]);
    }
    nearest = cli_nearest(name, names, (size_t)count);
    if (nearest)
        cli_error(command, "--material %s: not known; did you mean %s?", name, nearest);
    else
        cli_error(command, "--material %s: not known; what there is: %s; or give --ior and --k", name, list);
    return CLI_FAILURE;
}

static int choose_index(const char *command, const cli_surface *asked, pe_surface *surface)
{
    if (asked->weight != PE_WEIGHT_MICROFACET && (asked->material || is_given(asked->eta) || is_given(asked->k))) {
        cli_error(command, "--material, --ior and --k are for --weight microfacet; give it, or leave them out");
        return CLI_FAILURE;
    }
    if (asked->material && (is_given(asked->eta) || is_given(asked->k))) {
        cli_error(command, "--material and --ior or --k exclude each other; give one of them");
        return CLI_FAILURE;
    }
    if (asked->material)
        return choose_material(command, asked->material, surface);
    memcpy(surface->eta, asked->eta, sizeof surface->eta);
    memcpy(surface->k, asked->k, sizeof surface->k);
    return CLI_SUCCESS;
}

/* And the roughest of a range. */
static pe_status check_surface(const cli_surface *asked, const pe_surface *surface, pe_error *error)
{
    pe_surface roughest = *surface;
    pe_status status = pe_surface_check(surface, error);

    if (status != PE_OK || !(asked->alpha[2] > 0))
        return status;
    roughest.ndf.alpha_y *= asked->alpha[2] / asked->alpha[0];
    roughest.ndf.alpha_x = asked->alpha[2];
    return pe_surface_check(&roughest, error);
}

int cli_make_surface(const char *command, const cli_surface *asked, pe_surface *surface, pe_ndf_table **table)
{
    pe_error error;

    *surface = (pe_surface){ .weight = (pe_weight)asked->weight };
    *table = NULL;
    if (choose_index(command, asked, surface) != CLI_SUCCESS)
        return CLI_FAILURE;
    if ((is_file(asked->ndf) ? read_table(command, asked, &surface->ndf, table)
                             : choose_ndf(command, asked, &surface->ndf)) != CLI_SUCCESS)
        return CLI_FAILURE;
    if (check_surface(asked, surface, &error) == PE_OK)
        return CLI_SUCCESS;
    pe_ndf_table_free(*table);
    cli_error(command, "%s", error.message);
    return CLI_FAILURE;
}
