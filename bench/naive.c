/* naive.c - [Motegi Eq. 5] as it stands: a half vector, a square root, an exponential for every pair of texels.
 *
 * What a compiler makes of it at -O3 is what libprefenv's filter is measured against. */
#include "naive.h"

#include <math.h>
#include <stdlib.h>

/* Eq. 6, isotropic. */
static float beckmann(float alpha, float cos_theta)
{
    float cos_2, tan_2;

    if (cos_theta <= 0)
        return 0;
    cos_2 = cos_theta * cos_theta;
    tan_2 = (1 - cos_2) / cos_2;
    return expf(-tan_2 / (alpha * alpha)) / ((float)M_PI * alpha * alpha * cos_2 * cos_2);
}

void naive_filter(const pe_env *env, double alpha, const float n[3], const float (*o)[3], int count, float (*rgb)[3])
{
    int width = pe_env_width(env), height = pe_env_height(env);
    const float *texels = pe_env_texels(env);
    float *direction = malloc((size_t)width * (size_t)height * 3 * sizeof *direction);

    if (direction == NULL)
        abort();
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double d[3];

            pe_latlong_direction((x + 0.5) / width, (y + 0.5) / height, d);
            for (int c = 0; c < 3; c++)
                direction[3 * (y * width + x) + c] = (float)d[c];
        }

    for (int k = 0; k < count; k++) {
        float sum = 0, light[3] = { 0, 0, 0 };

        for (int y = 0; y < height; y++) {
            float sin_theta = sinf((float)M_PI * ((float)y + 0.5f) / (float)height);

            for (int x = 0; x < width; x++) {
                const float *w = direction + 3 * (y * width + x), *texel = texels + 3 * (y * width + x);
                float h[3], length, weight;

                if (w[0] * n[0] + w[1] * n[1] + w[2] * n[2] <= 0)
                    continue;
                for (int c = 0; c < 3; c++)
                    h[c] = o[k][c] + w[c];
                length = sqrtf(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
                weight = beckmann((float)alpha, (h[0] * n[0] + h[1] * n[1] + h[2] * n[2]) / length) * sin_theta;
                sum += weight;
                for (int c = 0; c < 3; c++)
                    light[c] += weight * texel[c];
            }
        }
        for (int c = 0; c < 3; c++)
            rgb[k][c] = sum > 0 ? light[c] / sum : 0;
    }
    free(direction);
}
