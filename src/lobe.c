/* lobe.c - a surface made ready for filtering. */
#include "lobe.h"

#include "parallel.h"
#include "status.h"
#include "surface.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>

static void set_slopes(pe_lobe *lobe)
{
    const pe_ndf *ndf = &lobe->surface.ndf;
    double unit = ndf->kind == PE_NDF_GGX ? 1 : M_LOG2E;
    int exponent;

    if (ndf->kind == PE_NDF_TABLE) {
        lobe->scale_x = (float)(1 / ndf->table->p_step);
        lobe->scale_y = (float)(1 / ndf->table->q_step);
        /* a narrow table's D times the brightest radiance is no float; a power of two rounds nothing */
        frexp(ndf->table->peak, &exponent);
        lobe->gain = (float)ldexp(1, -exponent);
        lobe->offset_x = (float)(0.5 - ndf->table->p_min / ndf->table->p_step);
        lobe->offset_y = (float)(0.5 - ndf->table->q_min / ndf->table->q_step);
    } else {
        lobe->x = (float)(unit / (ndf->alpha_x * ndf->alpha_x));
        lobe->y = (float)(unit / (ndf->alpha_y * ndf->alpha_y));
    }
}

/* ---- reflectance ---- */

/* F has a pole at the cosine -1 / (eta + i k) or near, too close to [0, 1] for a polynomial of the cosine.  The place
 * y = c (1 + d) / (c + d), with d somewhat beyond that distance, sends it away: a polynomial of degree 7 through the
 * Chebyshev points of y is within 2e-4 of F for the metals of pe_material, and 1e-3 for conductors of all kinds. */
#define KNEE 1.7

static double choose_knee(const pe_surface *surface)
{
    double size = 0;

    for (int c = 0; c < 3; c++)
        size += hypot(surface->eta[c], surface->k[c]) / 3;
    return size > 0 ? KNEE / size : 1;
}

/* Coefficients of the powers of x from those of Chebyshev's polynomials, by their recurrence. */
static void to_powers(const double chebyshev[PE_REFLECTANCE_TERMS], float powers[PE_REFLECTANCE_TERMS])
{
    double before[PE_REFLECTANCE_TERMS] = { 1 }, now[PE_REFLECTANCE_TERMS] = { 0, 1 },
           sum[PE_REFLECTANCE_TERMS] = { 0 };

    sum[0] = chebyshev[0];
    for (int n = 1; n < PE_REFLECTANCE_TERMS; n++) {
        for (int k = 0; k < PE_REFLECTANCE_TERMS; k++)
            sum[k] += chebyshev[n] * now[k];
        for (int k = PE_REFLECTANCE_TERMS - 1; k >= 0; k--)
            before[k] = (k > 0 ? 2 * now[k - 1] : 0) - before[k];
        for (int k = 0; k < PE_REFLECTANCE_TERMS; k++) {
            double next = before[k];

            before[k] = now[k];
            now[k] = next;
        }
    }
    for (int k = 0; k < PE_REFLECTANCE_TERMS; k++)
        powers[k] = (float)sum[k];
}

static void set_reflectance(pe_lobe *lobe)
{
    const pe_surface *surface = &lobe->surface;
    double knee = choose_knee(surface);

    lobe->knee = (float)knee;
    for (int c = 0; c < 3; c++) {
        double chebyshev[PE_REFLECTANCE_TERMS] = { 0 };

        for (int i = 0; i < PE_REFLECTANCE_TERMS; i++) {
            double angle = M_PI * (i + 0.5) / PE_REFLECTANCE_TERMS, y = (cos(angle) + 1) / 2;
            double f = pe_reflectance(surface->eta[c], surface->k[c], knee * y / (1 + knee - y));

            for (int n = 0; n < PE_REFLECTANCE_TERMS; n++)
                chebyshev[n] += (n == 0 ? 1.0 : 2.0) / PE_REFLECTANCE_TERMS * f * cos(n * angle);
        }
        to_powers(chebyshev, lobe->reflectance[c]);
    }
}

/* ---- albedo ---- */

/* The viewer at the polar angle theta, with the stretched tangent tau = |(alpha_x o_x, alpha_y o_y)| / o_z, has the
 * place 1 / (1 + tau): from grazing, 0, to straight above, 1, fine where the lobe's own width matters.  Its azimuth is
 * that of (alpha_x o_x, alpha_y o_y); closed forms are the same in all four quadrants, and isotropic ones in all
 * directions. */
enum { PLACES = 32, QUADRANT = 8, CIRCLE = 32, SIDE = 64 };

static void widths_of(const pe_ndf *ndf, double width[2])
{
    if (ndf->kind == PE_NDF_TABLE) {
        pe_ndf_table_alpha(ndf->table, width);
    } else {
        width[0] = ndf->alpha_x;
        width[1] = ndf->alpha_y;
    }
}

static double azimuth_step(const pe_lobe *lobe)
{
    return lobe->surface.ndf.kind == PE_NDF_TABLE ? 2 * M_PI / CIRCLE : M_PI / 2 / QUADRANT;
}

static void fill_albedo(size_t index, void *data)
{
    const pe_lobe *lobe = data;
    size_t azimuth_number = index / (PLACES + 1);
    double place = fmax((double)(index % (PLACES + 1)) / PLACES, 1e-4), tau = 1 / place - 1, width[2], o[3];
    double azimuth = (double)azimuth_number * azimuth_step(lobe);

    widths_of(&lobe->surface.ndf, width);
    o[0] = tau * cos(azimuth) / fmax(width[0], 1e-6);
    o[1] = tau * sin(azimuth) / fmax(width[1], 1e-6);
    o[2] = 1;
    pe_normalize(o, o);
    lobe->albedo[index] = (float)pe_directional_albedo(&lobe->surface.ndf, o, SIDE);
}

static int set_albedo(pe_lobe *lobe, int threads)
{
    const pe_ndf *ndf = &lobe->surface.ndf;
    size_t count;

    if (ndf->kind == PE_NDF_TABLE)
        lobe->azimuths = CIRCLE;
    else
        lobe->azimuths = ndf->alpha_x == ndf->alpha_y ? 1 : QUADRANT + 1;
    count = (size_t)lobe->azimuths * (PLACES + 1);
    lobe->albedo = malloc(count * sizeof *lobe->albedo);
    if (!lobe->albedo)
        return 0;
    pe_parallel_for(count, threads, fill_albedo, lobe, NULL);
    return 1;
}

/* Lagrange's cubic through four neighbours at -1, 0, 1, 2. */
static void cubic(double t, double weights[4])
{
    weights[0] = -t * (t - 1) * (t - 2) / 6;
    weights[1] = (t + 1) * (t - 1) * (t - 2) / 2;
    weights[2] = -(t + 1) * t * (t - 2) / 2;
    weights[3] = (t + 1) * t * (t - 1) / 6;
}

/* A row of places; the first and last four serve the ends. */
static double albedo_at(const float *row, double place)
{
    double weights[4], sum = 0;
    int first = (int)fmin(fmax(floor(place) - 1, 0), PLACES - 3);

    cubic(place - first - 1, weights);
    for (int k = 0; k < 4; k++)
        sum += weights[k] * (double)row[first + k];
    return sum;
}

/* Azimuths mirrored at the quadrant's ends, or around. */
static int azimuth_index(const pe_lobe *lobe, int k)
{
    if (lobe->surface.ndf.kind == PE_NDF_TABLE)
        return (k + CIRCLE) % CIRCLE;
    k = k < 0 ? -k : k;
    return k > QUADRANT ? 2 * QUADRANT - k : k;
}

double pe_lobe_albedo(const pe_lobe *lobe, const double o[3])
{
    double width[2], x, y, place, azimuth, weights[4], sum = 0;
    int first;

    widths_of(&lobe->surface.ndf, width);
    x = width[0] * o[0];
    y = width[1] * o[1];
    place = PLACES * o[2] / (o[2] + hypot(x, y));
    if (lobe->azimuths == 1)
        return albedo_at(lobe->albedo, place);
    azimuth = lobe->surface.ndf.kind == PE_NDF_TABLE ? atan2(y, x) : atan2(fabs(y), fabs(x));
    azimuth = (azimuth < 0 ? azimuth + 2 * M_PI : azimuth) / azimuth_step(lobe);
    first = (int)azimuth - 1;
    cubic(azimuth - first - 1, weights);
    for (int k = 0; k < 4; k++)
        sum += weights[k] * albedo_at(lobe->albedo + azimuth_index(lobe, first + k) * (PLACES + 1), place);
    return sum;
}

/* ---- the whole ---- */

pe_status pe_lobe_make(const pe_surface *surface, int threads, pe_lobe **out, pe_error *error)
{
    pe_status status = pe_surface_check(surface, error);
    pe_lobe *lobe;

    if (status != PE_OK)
        return status;
    lobe = calloc(1, sizeof *lobe);
    if (!lobe)
        return pe_fail_memory(error, "a surface");
    lobe->surface = *surface;
    set_slopes(lobe);
    set_reflectance(lobe);
    if (surface->weight == PE_WEIGHT_MICROFACET && !set_albedo(lobe, threads)) {
        pe_lobe_free(lobe);
        return pe_fail_memory(error, "a surface");
    }
    *out = lobe;
    return PE_OK;
}

void pe_lobe_free(pe_lobe *lobe)
{
    if (!lobe)
        return;
    free(lobe->albedo);
    free(lobe);
}

double pe_lobe_reach(const pe_lobe *lobe, double limit)
{
    return 2 * atan(pe_ndf_reach(&lobe->surface.ndf, limit));
}
