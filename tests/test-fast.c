/* test-fast.c - claims: the fast bake is within 1 % of the exact one (relative L2 over texels with n.r > 0.15), and the
 * error it records is the error it has, within a factor of 2 either way or 0.1 %.
 *
 * On real HDRIs where the data is at hand (PREFENV_DATA), and on an environment with small suns of 30,000. */
#include "hdri.h"
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

#define ERROR_MAX 0.01

static pe_maps *bake(const pe_env *env, double alpha_x, double alpha_y, pe_accuracy accuracy)
{
    pe_bake_options options = { .method = PE_METHOD_REPRESENTATIVE,
                                .surface.ndf = { PE_NDF_BECKMANN, alpha_x, alpha_y, NULL },
                                .normals = 12,
                                .width = 80,
                                .height = 40,
                                .accuracy = accuracy };
    pe_maps *maps;
    pe_error error;

    need(pe_bake(env, &options, &maps, &error) == PE_OK, "%s", error.message);
    return maps;
}

/* Over all texels of all maps with n.r > cosine_min. */
static double relative_error(const pe_maps *fast, const pe_maps *exact, double cosine_min)
{
    const pe_maps_info *info = pe_maps_get_info(exact);
    double error2 = 0, norm2 = 0;

    for (int k = 0; k < info->images; k++)
        for (int texel = 0; texel < info->width * info->height; texel++) {
            double n[3], r[3], theta;

            pe_maps_normal(exact, k, n);
            reference_direction(info->width, info->height, texel % info->width, texel / info->width, r, &theta);
            if (!(fabs(pe_dot(n, r)) > cosine_min))
                continue;
            for (int c = 0; c < 3; c++) {
                double truth = (double)pe_maps_image(exact, k)[3 * texel + c];
                double difference = (double)pe_maps_image(fast, k)[3 * texel + c] - truth;

                error2 += difference * difference;
                norm2 += truth * truth;
            }
        }
    return sqrt(error2 / norm2);
}

static void test_env(const char *name, const pe_env *env, double alpha_x, double alpha_y)
{
    pe_maps *fast = bake(env, alpha_x, alpha_y, PE_ACCURACY_FAST);
    pe_maps *exact = bake(env, alpha_x, alpha_y, PE_ACCURACY_EXACT);
    double error = relative_error(fast, exact, 0.15), estimate = pe_maps_get_info(fast)->error_estimate;

    ok(error <= ERROR_MAX, "%s, alpha %g, %g: fast within %.3f %% (%.3f %% with grazing)", name, alpha_x, alpha_y,
       100 * error, 100 * relative_error(fast, exact, 0));
    ok(estimate < 2 * error + 0.001 && estimate > error / 2 - 0.001, "%s, alpha %g, %g: says %.3f %%", name, alpha_x,
       alpha_y, 100 * estimate);
    pe_maps_free(fast);
    pe_maps_free(exact);
}

static void test_suns(void)
{
    const int width = 512, height = 256;
    float *rgb = reference_noise(width, height, 17);
    unsigned state = 2;
    pe_env *env;

    for (int sun = 0; sun < 6; sun++)
        rgb[3 * (int)(reference_random(&state) * width * height) + 1] = 30000;
    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK, "no memory");
    free(rgb);
    test_env("noise with six suns", env, 0.1, 0.1);
    test_env("noise with six suns", env, 0.1, 0.03);
    test_env("noise with six suns", env, 0.6, 0.6);
    pe_env_free(env);
}

static void test_hdri(const char *name)
{
    pe_env *env = hdri_read(name);

    if (!env)
        return;
    test_env(name, env, 0.1, 0.1);
    if (strcmp(name, "city") == 0) { /* a lobe of a texel's width */
        test_env(name, env, 0.01, 0.01);
        test_env(name, env, 0.2, 0.02);
    }
    pe_env_free(env);
}

int main(void)
{
    static const char *const hdris[] = { "city", "studio", "forest", "courtyard", "sunrise" };

    test_suns();
    for (int k = 0; k < 5; k++)
        test_hdri(hdris[k]);
    return done_testing();
}
