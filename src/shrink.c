/* shrink.c - see shrink.h. */
#include "shrink.h"

#include "status.h"
#include "vector.h"

#include <stdlib.h>

/* How often a side can be halved before texels are wider than pitch. */
static int halvings(const pe_env *env, double pitch)
{
    int times = 0, width = env->width, height = env->height;

    while (width % 2 == 0 && height % 2 == 0 && 4 * M_PI / width <= pitch) {
        width /= 2;
        height /= 2;
        times++;
    }
    return times;
}

/* Adds row y of env, by solid angle, to a row `factor` times narrower. */
static void add_row(const pe_env *env, int y, int factor, float share, float *row)
{
    const float *texel = env->rgb + 3 * (size_t)y * (size_t)env->width;

    for (int x = 0; x < env->width; x++, texel += 3)
        for (int c = 0; c < 3; c++)
            row[3 * (x / factor) + c] += share * texel[c];
}

pe_status pe_env_shrink(const pe_env *env, double pitch, pe_env **out, pe_error *error)
{
    int factor = 1 << halvings(env, pitch), width = env->width / factor, height = env->height / factor;
    float *rgb;
    pe_status status;

    *out = NULL;
    if (factor == 1)
        return PE_OK;
    rgb = calloc(3 * (size_t)width * (size_t)height, sizeof *rgb);
    if (!rgb)
        return pe_fail_memory(error, "a smaller environment");
    for (int y = 0; y < height; y++) {
        double total = 0;

        for (int k = 0; k < factor; k++)
            total += env->grid.solid_angle_sr[y * factor + k];
        for (int k = 0; k < factor; k++)
            add_row(env, y * factor + k, factor, (float)(env->grid.solid_angle_sr[y * factor + k] / total / factor),
                    rgb + 3 * (size_t)y * (size_t)width);
    }
    status = pe_env_create(width, height, rgb, out, error);
    free(rgb);
    return status;
}

void pe_shrunk_direction(const pe_env *env, const pe_env *fine, int x, int y, double direction[3])
{
    int factor = fine->width / env->width;
    double sum[3] = { 0 };

    pe_grid_direction(&env->grid, x, y, direction);
    for (int j = y * factor; j < (y + 1) * factor; j++)
        for (int i = x * factor; i < (x + 1) * factor; i++) {
            double power = fine->grid.solid_angle_sr[j] *
                           pe_luminance(fine->rgb + 3 * ((size_t)j * (size_t)fine->width + (size_t)i));
            double at[3];

            pe_grid_direction(&fine->grid, i, j, at);
            for (int c = 0; c < 3; c++)
                sum[c] += power * at[c];
        }
    if (factor > 1 && pe_dot(sum, sum) > 0)
        pe_normalize(sum, direction);
}
