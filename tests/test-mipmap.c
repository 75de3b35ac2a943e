/* test-mipmap.c - claims: through footprints of any size an environment shows what a sum over its texels says, the same
 * at a pole as on the equator; no light is lost; footprints grow evenly; those of a texel are the environment itself;
 * one colour stays that, whatever the size. */
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <string.h>

static pe_env *env_of(int width, int height, float *rgb)
{
    pe_env *env;
    pe_error error;

    need(pe_env_create(width, height, rgb, &env, &error) == PE_OK, "%s", error.message);
    free(rgb);
    return env;
}

static pe_mipmap *mipmap_of(const pe_env *env)
{
    pe_mipmap *mipmap;
    pe_error error;

    need(pe_mipmap_make(env, &mipmap, &error) == PE_OK, "%s", error.message);
    return mipmap;
}

/* The slow twin: the mean over a round footprint, which falls off to its rim as a cone does. */
static double mean_around(const pe_env *env, const double direction[3], double sr)
{
    int width = pe_env_width(env), height = pe_env_height(env);
    double radius = acos(fmax(1 - 3 * sr / (2 * M_PI), -1)), sum = 0, weights = 0;

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double w[3], theta, weight;

            reference_direction(width, height, x, y, w, &theta);
            weight = sin(theta) * fmax(1 - acos(fmin(pe_dot(w, direction), 1)) / radius, 0);
            sum += weight * (double)pe_env_texels(env)[3 * (y * width + x)];
            weights += weight;
        }
    return sum / weights;
}

static void test_truth(void)
{
    pe_env *env = env_of(256, 128, reference_room(256, 128));
    pe_mipmap *mipmap = mipmap_of(env);
    unsigned state = 11;

    for (int step = 0; step < 4; step++) {
        double sr = 0.003 * pow(5, step), squares = 0, truths = 0, bound = sr < 0.1 ? 0.11 : 0.18;

        for (int k = 0; k < 200; k++) {
            double w[3], rgb[3], truth;

            reference_random_direction(&state, w);
            truth = mean_around(env, w, sr);
            pe_mipmap_lookup(mipmap, w, sr, rgb);
            squares += (rgb[0] - truth) * (rgb[0] - truth);
            truths += truth * truth;
        }
        ok(sqrt(squares / truths) < bound, "a room through %g sr: within %.1f %% of a sum over texels", sr,
           100 * sqrt(squares / truths));
    }
    pe_mipmap_free(mipmap);
    pe_env_free(env);
}

/* The mean over the sphere, as each footprint has it.  (Through twelve vertices it is 2 % off.) */
static void test_light_kept(void)
{
    pe_env *env = env_of(250, 125, reference_room(250, 125));
    pe_mipmap *mipmap = mipmap_of(env);
    double mean[3], worst = 0;

    pe_env_mean(env, mean);
    for (int step = 0; step < 9; step++) {
        double sr = 1e-4 * pow(3, step), sum = 0, count = 40000;

        for (int k = 0; k < (int)count; k++) {
            double z = 1 - (2 * k + 1) / count, phi = 2.399963229728653 * k, w[3], rgb[3];

            w[0] = sqrt(1 - z * z) * cos(phi);
            w[1] = z;
            w[2] = sqrt(1 - z * z) * sin(phi);
            pe_mipmap_lookup(mipmap, w, sr, rgb);
            sum += rgb[1] / count;
        }
        worst = worst_of(worst, fabs(sum / mean[1] - 1));
    }
    ok(worst < 0.01, "a room keeps its mean through footprints up to 1 sr, within %.2f %%", 100 * worst);
    pe_mipmap_free(mipmap);
    pe_env_free(env);
}

/* How wide a lit texel's light is seen, as a solid angle: all of it, over that in the middle. */
static double footprint_of_texel(int width, int y, double sr)
{
    int height = width / 2;
    pe_env *env = env_of(width, height, reference_lit_texel(width, height, 77, y, 1000));
    pe_mipmap *mipmap = mipmap_of(env);
    double w[3], theta, rgb[3];

    reference_direction(width, height, 77, y, w, &theta);
    pe_mipmap_lookup(mipmap, w, sr, rgb);
    pe_mipmap_free(mipmap);
    pe_env_free(env);
    return 1000 * sin(theta) * 2 * M_PI / width * M_PI / height / rgb[0];
}

static void test_footprints(void)
{
    double least = 1e9, most = 0;

    for (int step = 0; step < 8; step++)
        for (int y = 0; y < 128; y += y < 4 ? 1 : 31) {
            double sr = 0.002 * pow(2.1, step), found = footprint_of_texel(512, y, sr) / sr;

            least = least_of(least, found);
            most = worst_of(most, found);
        }
    ok(least > 0.5 && most < 2, "a lit texel, from a pole to the equator, is seen through %.2f to %.2f footprints",
       least, most);
    least = 1e9;
    most = 0;
    for (int step = 0; step < 6; step++)
        for (int y = 10; y < 600; y += 245) {
            double sr = 1e-5 * pow(2.5, step), found = footprint_of_texel(2048, y, sr) / sr;

            least = least_of(least, found);
            most = worst_of(most, found);
        }
    ok(least > 0.5 && most < 2, "a small one through %.2f to %.2f", least, most);
}

static void test_even(void)
{
    pe_env *env = env_of(256, 128, reference_room(256, 128));
    pe_mipmap *mipmap = mipmap_of(env);
    double w[3] = { 0.6, 0.48, 0.64 }, last[3], rgb[3], worst = 0;

    pe_mipmap_lookup(mipmap, w, 1e-5, last);
    for (int step = 0; step < 1459; step++) {
        pe_mipmap_lookup(mipmap, w, 1e-5 * pow(1.01, step), rgb);
        worst = worst_of(worst, fabs(rgb[0] / last[0] - 1));
        memcpy(last, rgb, sizeof last);
    }
    ok(worst < 0.02, "footprints that grow by 1 %% change what they show by %.2f %% at most", 100 * worst);
    pe_env_lookup(env, w, last);
    pe_mipmap_lookup(mipmap, w, 1e-5, rgb);
    ok(memcmp(rgb, last, sizeof rgb) == 0, "those within a texel show it");
    pe_mipmap_free(mipmap);
    pe_env_free(env);
}

/* A single colour stays that, whatever the sizes. */
static void test_sizes(void)
{
    static const int sizes[][2] = { { 1, 1 }, { 2, 1 }, { 3, 7 }, { 17, 9 }, { 101, 50 }, { 2000, 3 }, { 2048, 1024 } };
    static const double footprints[] = { 0, 1e-9, 1e-4, 0.01, 1, 100, HUGE_VAL };

    for (int k = 0; k < 7; k++) {
        float colour = (float)(k + 1) / 3;
        pe_env *env = env_of(sizes[k][0], sizes[k][1], reference_constant(sizes[k][0], sizes[k][1], colour));
        pe_mipmap *mipmap = mipmap_of(env);
        unsigned state = 5;
        double worst = 0;

        for (int i = 0; i < 2000; i++) {
            double w[3], rgb[3];

            reference_random_direction(&state, w);
            pe_mipmap_lookup(mipmap, w, footprints[i % 7], rgb);
            worst = worst_of(worst, fabs(rgb[i % 3] - (double)colour));
        }
        ok(worst < 1e-6, "one colour of %d x %d texels stays within %.1e", sizes[k][0], sizes[k][1], worst);
        pe_mipmap_free(mipmap);
        pe_env_free(env);
    }
    pe_mipmap_free(NULL);
}

int main(void)
{
    test_truth();
    test_light_kept();
    test_footprints();
    test_even();
    test_sizes();
    return done_testing();
}
