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
#include "status.h"

#include <math.h>
#include <stdlib.h>

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

/* Of a lobe: how many times as long as wide. */
static double aspect_of(const double fineness[2])
{
    return fmax(fineness[0], fineness[1]) / fmin(fineness[0], fineness[1]);
}

/* A plan of this frequency, without sizes.  Returns how many images it has. */
static double plan_images(const pe_maps_info *info, int frequency, plan *p)
{
    double fineness[2], aspect, images = 10.0 * frequency * frequency + 2;

    *p = (plan){ .frequency = frequency };
    pe_ndf_fineness(&info->surface.ndf, fineness);
    aspect = aspect_of(fineness);
    if (info->angles == 1 && aspect > ASPECT_MIN)
        plan_poles(info, aspect, p);
    if (p->pole_angles)
        images *= 1 + (1 - p->pole_cosine) * (p->pole_angles - 1);
    return images * info->angles;
}

/* A hemisphere this wide has the environment's own resolution in its middle. */
static int greatest_side(const pe_maps_info *info)
{
    return (int)(2 * M_SQRT2 / M_PI * info->source_height + 2 * PE_DISC_MARGIN);
}

static plan make_plan(const pe_maps_info *info, int frequency, double pitch)
{
    int most = greatest_side(info);
    plan p;
    double fineness[2], images = plan_images(info, frequency, &p);

    pe_ndf_fineness(&info->surface.ndf, fineness);
    p.width = info->width ? info->width : side_of(fineness[0], pitch, most);
    p.height = info->height ? info->height : side_of(fineness[1], pitch, most);
    p.bytes = images * p.width * p.height * BYTES_PER_TEXEL;
    p.error = hypot(NORMALS_ERROR * pow(frequency, -NORMALS_POWER),
                    SPLINE_ERROR * sqrt(aspect_of(fineness)) * pow(pitch, SPLINE_POWER));
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

/* How many normals a cap holds is known for certain once it is chosen. */
static double bytes_of(const pe_maps_info *info, const plan *p)
{
    int count;

    if (!p->pole_angles || pe_poles_count(p->frequency, info->direction, p->pole_cosine, &count, NULL) != PE_OK)
        return p->bytes;
    return (10.0 * p->frequency * p->frequency + 2 + count * (p->pole_angles - 1)) * p->width * p->height *
           BYTES_PER_TEXEL;
}

/* Sizes that were not asked for become so much longer. */
static void scale_sides(const pe_maps_info *info, double scale, plan *p)
{
    p->width = info->width ? info->width : (int)fmax(p->width * scale, PE_DISC_SIDE_MIN);
    p->height = info->height ? info->height : (int)fmax(p->height * scale, PE_DISC_SIDE_MIN);
}

static void fit_poles(const pe_maps_info *info, plan *p, double budget)
{
    if (p->pole_angles && p->bytes <= budget)
        scale_sides(info, fmin(sqrt(budget / bytes_of(info, p)), 1), p);
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

/* ---- grades ----
 *
 * Of several grades within one memory each has fewer normals and texels than a file of its roughness, down to where the
 * constants above do not reach; these were fitted there, to photographs, again. */

/* Of normals, which count for more where lobes are wide: these two, the second times alpha up to the widest of all that
 * were tried. */
#define GRADE_NORMALS_ERROR 0.05
#define GRADE_NORMALS_ROUGH 0.9
#define GRADE_NORMALS_POWER 1.7
#define GRADE_ROUGHEST 0.5

/* Of texels, along an axis: near the horizon lobes of any width are narrow, so that the pitch that does goes with less
 * than alpha itself. */
#define GRADE_SPLINE_ERROR 0.34
#define GRADE_SPLINE_POWER 4.0
#define GRADE_WIDTH_POWER 0.72

/* What lies between two grades is off by GRADES_ERROR with one for each doubling of alpha, which meets it with the
 * fourth power.  Of a mixture of four, errors that have nothing to do with each other are lower. */
#define GRADES_ERROR 0.02
#define GRADES_POWER 4.0
#define MIXED 0.8

/* What lies between grades is small enough where it is so much of the error that each grade has by itself, which given
 * normals or sizes may keep large: more grades would take time and memory for nothing. */
#define GRADES_SHARE 0.1

/* What a grade may be. */
enum { MENU_FREQUENCIES = 20, MENU_PITCHES = 60 };
#define MENU_PITCH_MIN 0.08
#define MENU_PITCH_STEP 1.04

typedef struct menu {
    pe_maps_info info; /* of the grade */
    int count;
    plan plans[MENU_FREQUENCIES * MENU_PITCHES];
} menu;

static double spline_error(double width, int side)
{
    return GRADE_SPLINE_ERROR * pow(2 / ((side - 2 * PE_DISC_MARGIN) * width), GRADE_SPLINE_POWER);
}

static plan plan_grade(const pe_maps_info *info, int frequency, double pitch)
{
    const pe_ndf *ndf = &info->surface.ndf;
    double along = pow(ndf->alpha_x, GRADE_WIDTH_POWER), across = pow(ndf->alpha_y, GRADE_WIDTH_POWER);
    double rough = fmin(fmax(ndf->alpha_x, ndf->alpha_y), GRADE_ROUGHEST);
    int most = greatest_side(info);
    plan p;
    double images = plan_images(info, frequency, &p);

    p.width = info->width ? info->width : side_of(along, pitch, most);
    p.height = info->height ? info->height : side_of(across, pitch, most);
    p.bytes = images * p.width * p.height * BYTES_PER_TEXEL;
    p.error = hypot((GRADE_NORMALS_ERROR + GRADE_NORMALS_ROUGH * rough) * pow(frequency, -GRADE_NORMALS_POWER),
                    hypot(spline_error(along, p.width), spline_error(across, p.height)));
    return p;
}

static void make_menu(const pe_maps_info *info, int grade, menu *m)
{
    int given = pe_geodesic_frequency(info->normals);

    m->info = *info;
    m->info.surface.ndf = pe_grades_ndf(&info->surface.ndf, info->alpha_max, pe_grades_alpha(info, grade));
    m->count = 0;
    for (int f = given ? given : 2; f < (given ? given + 1 : 2 + MENU_FREQUENCIES); f++)
        for (int k = 0; k < MENU_PITCHES; k++)
            m->plans[m->count++] = plan_grade(&m->info, f, MENU_PITCH_MIN * pow(MENU_PITCH_STEP, k));
}

/* The least of squared error and memory at its price. */
static plan buy(const menu *m, double price)
{
    const plan *best = m->plans;

    for (const plan *p = m->plans; p < m->plans + m->count; p++)
        if (p->error * p->error + price * p->bytes < best->error * best->error + price * best->bytes)
            best = p;
    return *best;
}

static double error_between(int grades, double octaves)
{
    return GRADES_ERROR * pow(octaves / (grades - 1), GRADES_POWER);
}

/* All grades at one price, which is how together they have the least error for their memory.  Returns what the whole
 * takes and how far it is off. */
static plan buy_all(const menu *menus, int grades, double octaves, double price, plan *each)
{
    plan whole = { .bytes = 0 };
    double square = 0;

    for (int k = 0; k < grades; k++) {
        each[k] = buy(&menus[k], price);
        whole.bytes += each[k].bytes;
        square += each[k].error * each[k].error / grades;
    }
    whole.error = hypot(MIXED * sqrt(square), error_between(grades, octaves));
    return whole;
}

#define PRICE_MIN 1e-18 /* of a byte */
#define PRICE_MAX 1e-3
#define BISECTIONS 40

/* The least memory that reaches the aim, or, if none does within the budget, what that buys. */
static plan plan_grades(const menu *menus, int grades, double octaves, double aim, double budget, plan *each)
{
    double low = PRICE_MIN, high = PRICE_MAX;
    plan whole;

    for (int k = 0; k < BISECTIONS; k++) {
        double price = sqrt(low * high);

        whole = buy_all(menus, grades, octaves, price, each);
        if (whole.bytes > budget || whole.error < aim)
            low = price;
        else
            high = price;
    }
    whole = buy_all(menus, grades, octaves, low, each);
    return whole.bytes > budget ? buy_all(menus, grades, octaves, high, each) : whole;
}

#define ROUNDING 1.1

/* Frequencies go in steps, and poles were estimated: sizes make up for it. */
static void fill_budget(const menu *menus, int grades, double budget, plan *each)
{
    double bytes = 0;

    for (int k = 0; k < grades; k++)
        bytes += bytes_of(&menus[k].info, &each[k]);
    for (int k = 0; k < grades; k++)
        scale_sides(&menus[k].info, fmin(sqrt(budget / bytes), ROUNDING), &each[k]);
}

static int are_near(int grades, double octaves, double aim, const plan *each)
{
    double least = INFINITY;

    for (int k = 0; k < grades; k++)
        least = fmin(least, each[k].error);
    return error_between(grades, octaves) < GRADES_SHARE * fmax(least, aim);
}

/* More grades as long as that is better for the whole. */
static int choose_count(pe_maps_info *info, double octaves, double aim, double budget, menu *menus)
{
    plan best = { .bytes = INFINITY }, each[PE_GRADES_MAX];

    for (int grades = PE_GRADES_MIN; grades <= PE_GRADES_MAX; grades++) {
        plan whole;

        info->grades = grades;
        for (int k = 0; k < grades; k++)
            make_menu(info, k, &menus[k]);
        whole = plan_grades(menus, grades, octaves, aim, budget, each);
        if (!is_better(&whole, &best, aim, budget))
            return grades - 1;
        if (are_near(grades, octaves, aim, each))
            return grades;
        best = whole;
    }
    return PE_GRADES_MAX;
}

pe_status pe_choose_grades(const pe_bake_options *options, double aim, pe_maps_info *info, pe_maps_info *each,
                           pe_error *error)
{
    double budget = budget_for(options), octaves = log2(info->alpha_max / info->surface.ndf.alpha_x);
    menu *menus = malloc(PE_GRADES_MAX * sizeof *menus);
    plan plans[PE_GRADES_MAX];

    if (!menus)
        return pe_fail_memory(error, "the choice of grades");
    info->grades = options->layers ? options->layers : choose_count(info, octaves, aim, budget, menus);
    for (int k = 0; k < info->grades; k++)
        make_menu(info, k, &menus[k]);
    if (plan_grades(menus, info->grades, octaves, aim, budget, plans).error > aim)
        fill_budget(menus, info->grades, budget, plans);
    for (int k = 0; k < info->grades; k++) {
        each[k] = menus[k].info;
        take_plan(&plans[k], &each[k]);
    }
    free(menus);
    return PE_OK;
}

void pe_choose_fine_size(const pe_ndf *ndf, int *width, int *height)
{
    double fineness[2];

    pe_ndf_fineness(ndf, fineness);
    *width = side_of(fineness[0], 0.25, 8192);
    *height = side_of(fineness[1], 0.25, 8192);
}
