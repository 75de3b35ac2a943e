/* measure.c - see measure.h. */
#include "measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct sums {
    double squares, reference, reference_squares;
    double level_squares[3]; /* of the distances from level_mean: Welford's running variance */
} sums;

static size_t pixel_count(const pe_image *image)
{
    return (size_t)image->width * (size_t)image->height;
}

static int is_translucent(const pe_image *image)
{
    if (image->alpha)
        for (size_t i = 0; i < pixel_count(image); i++)
            if (image->alpha[i] < 1)
                return 1;
    return 0;
}

unsigned char *measure_keep(const pe_image *mask)
{
    size_t count = pixel_count(mask);
    int by_alpha = is_translucent(mask);
    unsigned char *keep = malloc(count);

    for (size_t i = 0; keep && i < count; i++) {
        const float *c = mask->rgb + 3 * i;
        double luminance = 0.2126 * (double)c[0] + 0.7152 * (double)c[1] + 0.0722 * (double)c[2]; /* ITU-R BT.709 */

        keep[i] = (by_alpha ? (double)mask->alpha[i] : luminance) > 0.5;
    }
    return keep;
}

static int is_finite(const float a[3], const float b[3])
{
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]) && isfinite(b[0]) && isfinite(b[1]) && isfinite(b[2]);
}

static void add_pixel(const float a[3], const float b[3], sums *s, measures *m)
{
    m->pixels++;
    for (int c = 0; c < 3; c++) {
        double difference = (double)a[c] - (double)b[c];
        double levels = 255 * fabs(pe_srgb_encode((double)a[c]) - pe_srgb_encode((double)b[c]));
        double away = levels - m->level_mean[c];

        s->squares += difference * difference;
        s->reference += fabs((double)b[c]);
        s->reference_squares += (double)b[c] * (double)b[c];
        m->level_mean[c] += away / (double)m->pixels;
        s->level_squares[c] += away * (levels - m->level_mean[c]);
    }
}

static void note_worst(const float a[3], const float b[3], int x, int y, measures *m)
{
    double difference = 0;

    for (int c = 0; c < 3; c++)
        difference = fmax(difference, fabs((double)a[c] - (double)b[c]));
    if (m->pixels > 1 && difference <= m->worst_difference)
        return;
    m->worst_difference = difference;
    m->worst_x = x;
    m->worst_y = y;
    for (int c = 0; c < 3; c++) {
        m->worst[c] = (double)a[c];
        m->worst_reference[c] = (double)b[c];
    }
}

/* part / whole, but 0 / 0 is 0: equal pictures do not differ, black or not. */
static double relation(double part, double whole)
{
    return part > 0 ? part / whole : part;
}

static void conclude(const sums *s, measures *m)
{
    double values = 3 * (double)m->pixels;

    m->mse = s->squares / values; /* NaN if no pixel counts, and all that follows from it */
    m->rmse = sqrt(m->mse);
    m->relative_rmse = relation(m->rmse, s->reference / values);
    m->relative_l2 = relation(m->rmse, sqrt(s->reference_squares / values));
    m->psnr = -10 * log10(m->mse);
    for (int c = 0; c < 3; c++)
        m->level_variance[c] = s->level_squares[c] / (double)m->pixels;
}

void measure_difference(const pe_image *image, const pe_image *reference, const unsigned char *keep, measures *result)
{
    sums s = { 0 };
    size_t i = 0;

    memset(result, 0, sizeof *result);
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++, i++) {
            const float *a = image->rgb + 3 * i, *b = reference->rgb + 3 * i;

            if (keep && !keep[i])
                continue;
            if (!is_finite(a, b)) {
                result->not_finite++;
                continue;
            }
            add_pixel(a, b, &s, result);
            note_worst(a, b, x, y, result);
        }
    conclude(&s, result);
}

pe_status measure_picture(const pe_image *image, const pe_image *reference, const unsigned char *keep, double amplify,
                          pe_image *picture)
{
    static const float magenta[3] = { 1, 0, 1 };
    size_t count = pixel_count(image);

    picture->width = image->width;
    picture->height = image->height;
    picture->alpha = NULL;
    picture->rgb = calloc(count, 3 * sizeof *picture->rgb);
    if (!picture->rgb)
        return PE_ERROR_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const float *a = image->rgb + 3 * i, *b = reference->rgb + 3 * i;
        float *to = picture->rgb + 3 * i;

        if (keep && !keep[i])
            continue;
        for (int c = 0; c < 3; c++)
            to[c] = is_finite(a, b) ? (float)(amplify * fabs((double)a[c] - (double)b[c])) : magenta[c];
    }
    return PE_OK;
}
