/* choose.c - see choose.h.
 *
 * Two errors are balanced, both fitted to photographs: that of interpolating between normals, which falls with the
 * frequency f of the geodesic sphere nearly as its triangles' area, and that of the spline in a map, which depends on
 * texel pitch over alpha. */
#include "choose.h"

#include "disc.h"
#include "geodesic.h"
#include "maps.h"
#include "ndf.h"

#include <math.h>

#define NORMALS_ERROR 0.30
#define NORMALS_POWER 1.8
#define SPLINE_ERROR 0.04
#define SPLINE_POWER 3.0

#define PITCH_MIN 0.15 /* of alpha: finer texels change nothing */
#define PITCH_MAX 2.0
#define PITCH_STEPS 100
#define BYTES_PER_TEXEL 6 /* three half floats */

static double budget_of(pe_quality quality)
{
    return quality == PE_QUALITY_HIGH ? 64e6 : 21 * 400 * 200 * BYTES_PER_TEXEL;
}

double pe_wanted_error(const pe_bake_options *options)
{
    if (options->error > 0)
        return options->error;
    return options->quality == PE_QUALITY_HIGH ? 0.0005 : 0.002;
}

/* Exact costs (lights x texels): beyond this many lights AUTO becomes fast. */
#define AUTO_EXACT_TEXELS_MAX (128 * 64)

pe_accuracy pe_choose_accuracy(pe_accuracy asked, int width, int height)
{
    if (asked != PE_ACCURACY_AUTO)
        return asked;
    return (size_t)width * (size_t)height <= AUTO_EXACT_TEXELS_MAX ? PE_ACCURACY_EXACT : PE_ACCURACY_FAST;
}

/* Texels along one axis for a pitch, on the unit disc, of `pitch` times alpha. */
static int side_of(double alpha, double pitch, int most)
{
    double side = ceil(2 / (pitch * alpha) + 2 * PE_DISC_MARGIN);

    return (int)fmax(fmin(side, most), 12);
}

typedef struct plan {
    int frequency, width, height;
    int pole_angles;
    double pole_cosine;
    double bytes, error;
} plan;

/* From one normal to the next, tangents turn by their distance over that from the brush's pole.  Where that blurs a
 * lobe `aspect` times as long as wide, maps are made for several angles; all constants by trial on photographs. */
#define ASPECT_MIN 1.4
#define CAP_AT_LEAST 0.55 /* of the distance between normals */
#define CAP_BY_ASPECT 0.45
#define CAP_SHARE 0.45       /* of images, that poles may have more */
#define ANGLES_BY_ASPECT 1.8 /* in half a turn */
#define ANGLES_AT_LEAST 6

static void plan_poles(const pe_maps_info *info, double aspect, plan *p)
{
    double wanted = ANGLES_BY_ASPECT * aspect * pe_maps_turn(info) / M_PI;
    double distance = 1.107 / p->frequency; /* an icosahedron's edge, seen from its middle, in parts */

    p->pole_angles = (int)fmin(fmax(ceil(wanted), ANGLES_AT_LEAST), PE_MAPS_ANGLES_MAX);
    p->pole_cosine = fmax(cos(fmin(distance * (CAP_AT_LEAST + CAP_BY_ASPECT * (aspect - 1)), M_PI / 2)),
                          1 - CAP_SHARE / (p->pole_angles - 1));
}

static plan make_plan(const pe_maps_info *info, int frequency, double pitch)
{
    /* A hemisphere this wide has the environment's own resolution in its middle. */
    int most = (int)(2 * M_SQRT2 / M_PI * info->source_height + 2 * PE_DISC_MARGIN);
    plan p = { .frequency = frequency };
    double fineness[2], aspect, images = 10.0 * frequency * frequency + 2;

    pe_ndf_fineness(&info->surface.ndf, fineness);
    aspect = fmax(fineness[0], fineness[1]) / fmin(fineness[0], fineness[1]);
    if (info->angles == 1 && aspect > ASPECT_MIN)
        plan_poles(info, aspect, &p);
    if (p.pole_angles)
        images *= 1 + (1 - p.pole_cosine) * (p.pole_angles - 1);
    p.width = info->width ? info->width : side_of(fineness[0], pitch, most);
    p.height = info->height ? info->height : side_of(fineness[1], pitch, most);
    p.bytes = images * info->angles * p.width * p.height * BYTES_PER_TEXEL;
    p.error =
        hypot(NORMALS_ERROR * pow(frequency, -NORMALS_POWER), SPLINE_ERROR * sqrt(aspect) * pow(pitch, SPLINE_POWER));
    return p;
}

static int is_better(const plan *a, const plan *b, double wanted, double budget)
{
    int a_fits = a->bytes <= budget, b_fits = b->bytes <= budget;

    if (a_fits != b_fits)
        return a_fits;
    if (!a_fits)
        return a->bytes < b->bytes;
    if (a->error <= wanted && b->error <= wanted)
        return a->bytes < b->bytes;
    return a->error < b->error;
}

/* How many normals a cap holds is known for certain once it is chosen: sizes that were not asked for give way. */
static void fit_poles(const pe_maps_info *info, plan *p, double budget)
{
    double bytes, scale;
    int count;

    if (!p->pole_angles || p->bytes > budget ||
        pe_poles_count(p->frequency, info->direction, p->pole_cosine, &count, NULL) != PE_OK)
        return;
    bytes = (10.0 * p->frequency * p->frequency + 2 + count * (p->pole_angles - 1)) * p->width * p->height *
            BYTES_PER_TEXEL;
    scale = fmin(sqrt(budget / bytes), 1);
    p->width = info->width ? info->width : (int)fmax(p->width * scale, PE_DISC_SIDE_MIN);
    p->height = info->height ? info->height : (int)fmax(p->height * scale, PE_DISC_SIDE_MIN);
}

/* An error that is asked for may take what it takes, within the larger budget. */
static double budget_for(const pe_bake_options *options)
{
    return budget_of(options->error > 0 ? PE_QUALITY_HIGH : options->quality);
}

static plan best_plan(const pe_maps_info *info, double aim, double budget)
{
    int given = pe_geodesic_frequency(info->normals);
    plan best = make_plan(info, given ? given : 2, PITCH_MAX);

    for (int f = given ? given : 2; f <= (given ? given : PE_FREQUENCY_MAX); f++)
        for (int step = 0; step <= PITCH_STEPS; step++) {
            double pitch = PITCH_MAX * pow(PITCH_MIN / PITCH_MAX, (double)step / PITCH_STEPS);
            plan p = make_plan(info, f, pitch);

            if (is_better(&p, &best, aim, budget))
                best = p;
        }
    return best;
}

static void take_plan(const plan *p, pe_maps_info *info)
{
    info->normals = 10 * p->frequency * p->frequency + 2;
    info->width = p->width;
    info->height = p->height;
    info->pole_angles = p->pole_angles;
    info->pole_cosine = p->pole_cosine;
}

void pe_choose_hemispheres(const pe_bake_options *options, double aim, pe_maps_info *info)
{
    double budget = budget_for(options);
    int given = info->normals;
    plan best = best_plan(info, aim, budget);

    fit_poles(info, &best, budget);
    take_plan(&best, info);
    info->normals = given ? given : info->normals;
}

/* ---- grades ---- */

/* What lies between two grades is off by GRADES_ERROR with one for each doubling of alpha, which meets it with the
 * fourth power; fitted to photographs, as the rest. */
#define GRADES_ERROR 0.045
#define GRADES_POWER 4.0

/* A smooth grade takes more memory for the same error.  Where all together have the least, this one's goes with this
 * power of alpha. */
#define AIM_POWER (-1.0)

static int count_grades(const pe_maps_info *info, double aim)
{
    double octaves = log2(info->alpha_max / info->surface.ndf.alpha_x);
    double count = ceil(octaves * pow(GRADES_ERROR / aim, 1 / GRADES_POWER)) + 1;

    return (int)fmin(fmax(count, PE_GRADES_MIN), PE_GRADES_MAX);
}

/* Returns the bytes of all. */
static double plan_grades(const pe_bake_options *options, double aim, pe_maps_info *info, pe_maps_info *each)
{
    double bytes = 0;

    info->grades = options->layers ? options->layers : count_grades(info, aim);
    for (int k = 0; k < info->grades; k++) {
        double alpha = pe_grades_alpha(info, k), middle = sqrt(info->surface.ndf.alpha_x * info->alpha_max);
        plan best;

        each[k] = *info;
        each[k].surface.ndf = pe_grades_ndf(&info->surface.ndf, info->alpha_max, alpha);
        best = best_plan(&each[k], aim * pow(alpha / middle, AIM_POWER), INFINITY);
        take_plan(&best, &each[k]);
        bytes += best.bytes;
    }
    return bytes;
}

#define BISECTIONS 12
#define AIM_MAX 2.0

void pe_choose_grades(const pe_bake_options *options, double aim, pe_maps_info *info, pe_maps_info *each)
{
    double budget = budget_for(options), most = fmax(AIM_MAX, 2 * aim), least = aim;

    if (plan_grades(options, aim, info, each) <= budget)
        return;
    for (int k = 0; k < BISECTIONS; k++) {
        double middle = sqrt(least * most);

        if (plan_grades(options, middle, info, each) <= budget)
            most = middle;
        else
            least = middle;
    }
    plan_grades(options, most, info, each);
}

void pe_choose_fine_size(const pe_ndf *ndf, int *width, int *height)
{
    double fineness[2];

    pe_ndf_fineness(ndf, fineness);
    *width = side_of(fineness[0], 0.25, 8192);
    *height = side_of(fineness[1], 0.25, 8192);
}
