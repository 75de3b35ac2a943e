/* sample_grades.c - four grades about a roughness, in each a lookup of its own, mixed by a smooth curve through all. */
#include "layering.h"
#include "sample.h"

/* Of what the two nearest grades show: less than this is the curve's swing below a lamp's narrow highlight. */
#define LOW 0.25

static void add_suns(const pe_maps *maps, const pe_view *view, double alpha, const pe_denominators *denominators,
                     double rgb[3])
{
    pe_surface surface;

    pe_maps_surface(maps, alpha, &surface);
    pe_suns_add(&maps->suns, &surface, denominators, view->direction ? view->direction : maps->info.direction, view->n,
                view->o, rgb);
}

void pe_sample_grades(const pe_maps *maps, const pe_sampling *sampling, const pe_view *view, double alpha,
                      double rgb[3])
{
    float place = (float)pe_grades_place(&maps->info, alpha), weights[4];
    int first = pe_layering_weights(maps->info.grades, place, weights), near = (int)place;
    double part[3], least[3] = { 0, 0, 0 };
    pe_denominators denominators = { 0 };

    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int k = 0; k < 4; k++) {
        const pe_maps *grade = maps->grades[first + k];
        double share = first + k == near ? 1 - (double)(place - (float)near) : (double)(place - (float)near);

        if (weights[k] == 0)
            continue;
        pe_sample_hemispheres(grade, sampling, view, part);
        for (int c = 0; c < 3; c++) {
            rgb[c] += (double)weights[k] * part[c];
            least[c] += first + k == near || first + k == near + 1 ? LOW * share * part[c] : 0;
        }
        pe_denominators_add(&denominators, grade->denominator, (double)weights[k]);
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = fmax(rgb[c], least[c]);
    if (maps->suns.count)
        add_suns(maps, view, alpha, &denominators, rgb);
}
