/* lobe.c - a surface made ready for filtering. */
#include "lobe.h"

#include "status.h"

#include <math.h>
#include <stdlib.h>

static void set_slopes(pe_lobe *lobe)
{
    const pe_ndf *ndf = &lobe->surface.ndf;
    double unit = ndf->kind == PE_NDF_GGX ? 1 : M_LOG2E;

    if (ndf->kind == PE_NDF_TABLE) {
        lobe->scale_x = (float)(1 / ndf->table->p_step);
        lobe->scale_y = (float)(1 / ndf->table->q_step);
        lobe->offset_x = (float)(0.5 - ndf->table->p_min / ndf->table->p_step);
        lobe->offset_y = (float)(0.5 - ndf->table->q_min / ndf->table->q_step);
    } else {
        lobe->x = (float)(unit / (ndf->alpha_x * ndf->alpha_x));
        lobe->y = (float)(unit / (ndf->alpha_y * ndf->alpha_y));
    }
}

pe_status pe_lobe_make(const pe_surface *surface, int threads, pe_lobe **out, pe_error *error)
{
    pe_status status = pe_surface_check(surface, error);
    pe_lobe *lobe;

    (void)threads;
    if (status != PE_OK)
        return status;
    lobe = calloc(1, sizeof *lobe);
    if (!lobe)
        return pe_fail_memory(error, "a surface");
    lobe->surface = *surface;
    set_slopes(lobe);
    *out = lobe;
    return PE_OK;
}

void pe_lobe_free(pe_lobe *lobe)
{
    free(lobe);
}

double pe_lobe_reach(const pe_lobe *lobe, double limit)
{
    return 2 * atan(pe_ndf_reach(&lobe->surface.ndf, limit));
}
