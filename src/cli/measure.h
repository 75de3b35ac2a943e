/* measure.h - how much a picture differs from its reference. */
#ifndef CLI_MEASURE_H
#define CLI_MEASURE_H

#include "prefenv.h"

#include <stddef.h>

/* Over the pixels that count: those the mask keeps, without those where either picture has a NaN or an infinity.
 * a: a channel of the picture, b: of the reference; sums and means run over pixels and channels, N = 3 pixels. */
typedef struct measures {
    size_t pixels;        /* that count */
    size_t not_finite;    /* kept by the mask, but with a NaN or an infinity */
    double mse;           /* sum (a - b)^2 / N */
    double rmse;          /* sqrt mse */
    double relative_rmse; /* rmse / (sum |b| / N); 0 if the pictures are equal, infinite if only b is 0 */
    double relative_l2;   /* sqrt (sum (a - b)^2 / sum b^2), likewise */
    double psnr;          /* -10 log10 mse: the peak is 1; infinite if the pictures are equal */
    double level_mean[3], level_variance[3]; /* of |a - b| per channel, both clipped, sRGB-encoded, times 255 */
    int worst_x, worst_y; /* the pixel of the greatest |a - b| in any channel, the first in reading order */
    double worst[3], worst_reference[3]; /* its values */
    double worst_difference;             /* that |a - b| */
} measures;

/* Pixels that a mask picture keeps, one byte each, to be freed; NULL if memory is out.  A mask whose alpha channel is
 * not 1 all over keeps alpha > 1/2; any other keeps a linear luminance > 1/2. */
unsigned char *measure_keep(const pe_image *mask);

/* The pictures are of one size; `keep` may be NULL: all pixels. */
void measure_difference(const pe_image *image, const pe_image *reference, const unsigned char *keep, measures *result);

/* Fills `picture` with |a - b| times `amplify`: black where the mask drops a pixel, magenta where it is not finite.
 * PE_ERROR_MEMORY if memory is out; release it with pe_image_free else. */
pe_status measure_picture(const pe_image *image, const pe_image *reference, const unsigned char *keep, double amplify,
                          pe_image *picture);

#endif
