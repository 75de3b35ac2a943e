/* test-voxels.c - claims: the cube of voxels and the layers hold what Phong's lobe gathers, within stated bounds; the
 * table of weights is what it says; files come back as they went; and any number of threads makes the same bits. */
#include "dome.h"
#include "globe.h"
#include "layering.h"
#include "layers.h"
#include "prefenv.h"
#include "reference.h"
#include "sample_point.h"
#include "tap.h"
#include "vector.h"
#include "weights.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define WIDTH 128
#define HEIGHT 64

/* Hue along x, saturation along y, as [Okumura Fig. 6a]; and a room of lamps. */
static pe_env *make_env(float *rgb)
{
    pe_env *env;

    need(pe_env_create(WIDTH, HEIGHT, rgb, &env, NULL) == PE_OK, "no environment");
    free(rgb);
    return env;
}

static float *pattern(void)
{
    float *rgb = reference_constant(WIDTH, HEIGHT, 0);

    for (int k = 0; k < 3 * WIDTH * HEIGHT; k++) {
        double hue = 6 * (k / 3 % WIDTH + 0.5) / WIDTH, away = fabs(fmod(hue - 2 * (k % 3) + 9, 6) - 3);
        int row = k / 3 / WIDTH;

        rgb[k] = (float)(1 - (row + 0.5) / HEIGHT * fmin(fmax(away - 1, 0), 1));
    }
    return rgb;
}

static pe_maps *bake(const pe_env *env, const pe_bake_options *options)
{
    pe_error error = { PE_OK, "" };
    pe_maps *maps = NULL;

    need(pe_bake(env, options, &maps, &error) == PE_OK, "%s", error.message);
    return maps;
}

/* ---- domes ---- */

static void test_dome(void)
{
    pe_dome dome;
    double worst = 0, sum = 0;
    int descending = 1;

    need(pe_dome_make(36, &dome, NULL) == PE_OK, "no dome");
    for (int v = 0; v < dome.count; v++) {
        const double *at = pe_geodesic_vertex(dome.sphere, v);

        sum += pe_geodesic_share(dome.sphere, v);
        for (int g = 0; g < PE_DOME_IMAGES; g++) {
            const double *image = pe_geodesic_vertex(dome.sphere, (int)dome.images[v][g]);

            for (int c = 0; c < 3; c++)
                worst = worst_of(worst, fabs(image[c] - (g >> c & 1 ? -1 : 1) * at[(c + g / 8) % 3]));
        }
        descending &= v == 0 || pe_geodesic_vertex(dome.sphere, dome.from_top[v])[1] <=
                                    pe_geodesic_vertex(dome.sphere, dome.from_top[v - 1])[1];
    }
    ok(dome.count == 12962 && worst < 1e-12, "a dome of %d vertices has its 24 images within %.1e", dome.count, worst);
    ok(descending && fabs(sum - 1) < 1e-9, "from the top down, and all shares make %.12f", sum);
    pe_dome_free(&dome);
}

/* Sums over the vertices by their shares, against integrals: the mean of (d.w)^8 over the sphere is 1/9. */
static void test_shares(void)
{
    pe_dome dome;
    unsigned state = 3;
    double worst = 0;

    need(pe_dome_make(9, &dome, NULL) == PE_OK, "no dome");
    for (int k = 0; k < 200; k++) {
        double d[3], sum = 0;

        reference_random_direction(&state, d);
        for (int v = 0; v < dome.count; v++)
            sum += pe_geodesic_share(dome.sphere, v) * pow(pe_dot(d, pe_geodesic_vertex(dome.sphere, v)), 8);
        worst = worst_of(worst, fabs(9 * sum - 1));
    }
    ok(worst < 0.01, "sums over 812 vertices, each with its share of the sphere, are integrals within %.4f", worst);
    pe_dome_free(&dome);
}

/* ---- the table ---- */

static void test_weights(double threshold)
{
    const pe_smoothness scale = { 32, 6.2, 256 };
    pe_weights *w;
    double worst = 0, worst_kept = 0, least = 1;

    need(pe_weights_make(&scale, threshold, 1, NULL, &w, NULL) == PE_OK, "no weights");
    for (size_t k = 0; k < w->count; k += 7) {
        const int at[3] = { w->voxels[k].at[0], w->voxels[k].at[1], w->voxels[k].at[2] };
        const pe_geodesic *sphere = w->domes[w->voxels[k].dome].sphere;
        double t[3], exponent, all = 0, kept = 0;

        pe_voxel_centre(32, at, t);
        exponent = pe_smoothness_exponent(&scale, sqrt(pe_dot(t, t)));
        pe_normalize(t, t);
        for (int v = 0; v < pe_geodesic_count(sphere); v++) { /* [Okumura Eq. 9] as it is written, but for the shares */
            double cosine = pe_dot(t, pe_geodesic_vertex(sphere, v)), power = cosine > 0 ? pow(cosine, exponent) : 0;

            all += power * pe_geodesic_share(sphere, v);
            kept += power > threshold ? power * pe_geodesic_share(sphere, v) : 0;
        }
        worst_kept = worst_of(worst_kept, fabs((double)w->kept[k] - kept / all));
        for (size_t i = w->first[k]; i < w->first[k + 1]; i++) {
            int v = (int)w->vertex[i];
            double power = pow(pe_dot(t, pe_geodesic_vertex(sphere, v)), exponent);

            least = least_of(least, power);
            worst = worst_of(worst, fabs((double)w->weight[i] - power * pe_geodesic_share(sphere, v) / kept));
        }
    }
    ok(worst < 1e-7 && worst_kept < 1e-6 && least > threshold,
       "threshold %g: weights within %.1e, what is kept within %.1e, of the formula", threshold, worst, worst_kept);
    pe_weights_free(w);
}

static void test_weights_file(void)
{
    const pe_smoothness scale = { 16, 6.2, 256 };
    char path[] = "/tmp/prefenv-test-weights-XXXXXX";
    pe_weights *w, *back;
    pe_error error = { PE_OK, "" };
    FILE *file;

    close(mkstemp(path));
    need(pe_weights_make(&scale, 0.01, 2, NULL, &w, NULL) == PE_OK && pe_weights_write(w, path, NULL) == PE_OK,
         "no weights");
    need(pe_weights_read(path, &back, &error) == PE_OK, "%s", error.message);
    ok(back->count == w->count && back->threshold == w->threshold && back->scale.size == 16 &&
           memcmp(back->first, w->first, (w->count + 1) * sizeof *w->first) == 0 &&
           memcmp(back->kept, w->kept, w->count * sizeof *w->kept) == 0 &&
           memcmp(back->vertex, w->vertex, (size_t)w->first[w->count] * sizeof *w->vertex) == 0 &&
           memcmp(back->weight, w->weight, (size_t)w->first[w->count] * sizeof *w->weight) == 0,
       "a file of weights comes back as it went");
    pe_weights_free(back);
    pe_weights_free(w);
    file = fopen(path, "r+b");
    need(file && fseek(file, 1000, SEEK_SET) == 0 && fputc('x', file) == 'x' && fclose(file) == 0, "%s", path);
    ok(pe_weights_read(path, &back, &error) == PE_ERROR_FORMAT && strstr(error.message, "is damaged"), "%s",
       error.message);
    unlink(path);
}

/* ---- lookups ---- */

/* Mean and greatest difference from Phong's lobe, over all directions and lambda from 0.02 to 1. */
typedef struct difference {
    double mean, greatest;
} difference;

static difference compare(const pe_maps *maps, const pe_env *env)
{
    enum { TRIES = 600 };
    const pe_smoothness *scale = &pe_maps_get_info(maps)->smoothness;
    difference d = { 0, 0 };
    unsigned state = 7;

    for (int k = 0; k < TRIES; k++) {
        pe_point point = { .roughness = 0.02 + 0.98 * k / (TRIES - 1) };
        double r[3], got[3], exact[3];

        reference_random_direction(&state, point.n);
        reference_random_direction(&state, point.o);
        if (k % 10 == 0) /* a pole of lat-long maps, an edge of the cube's */
            for (int c = 0; c < 3; c++)
                point.n[c] = point.o[c] = c == k / 10 % 3 ? 1 : 1e-9;
        pe_normalize(point.o, point.o);
        pe_normalize(point.n, point.n);
        pe_reflect(point.o, point.n, r);
        pe_sample(maps, NULL, &point, got);
        pe_phong(env, pe_smoothness_exponent(scale, point.roughness), PE_HORIZON_IGNORED, NULL, r, exact);
        for (int c = 0; c < 3; c++) {
            d.mean += fabs(got[c] - exact[c]) / (3 * TRIES);
            d.greatest = worst_of(d.greatest, fabs(got[c] - exact[c]));
        }
    }
    return d;
}

static void test_lookups(const char *name, pe_env *env, const pe_bake_options *options, double mean, double greatest)
{
    pe_maps *maps = bake(env, options);
    difference d = compare(maps, env);

    ok(d.mean < mean && d.greatest < greatest, "%s: lookups within %.5f of Phong's lobe on average, %.4f at most", name,
       d.mean, d.greatest);
    note("of themselves: texels %.5f, lookups %.5f", pe_maps_get_info(maps)->error_estimate,
         pe_maps_get_info(maps)->lookup_error);
    pe_maps_free(maps);
    pe_env_free(env);
}

/* Largest difference between the images of two bakes. */
static double difference_of_images(const pe_maps *a, const pe_maps *b)
{
    double worst = 0;

    for (int k = 0; k < pe_maps_get_info(a)->images; k++) {
        int width, height;

        pe_maps_image_size(a, k, &width, &height);
        for (int i = 0; i < 3 * width * height; i++)
            worst = worst_of(worst, fabs((double)pe_maps_image(a, k)[i] - (double)pe_maps_image(b, k)[i]));
    }
    return worst;
}

static void test_exact_twin(const char *name, pe_method method, pe_env *env, double bound)
{
    pe_bake_options options = { .method = method, .smoothness.size = 32 };
    pe_maps *fast = bake(env, &options), *exact, *alone;
    double off, same;

    options.accuracy = PE_ACCURACY_EXACT;
    exact = bake(env, &options);
    options.accuracy = PE_ACCURACY_FAST;
    options.threads = 1;
    alone = bake(env, &options);
    off = difference_of_images(fast, exact);
    same = difference_of_images(fast, alone);
    ok(off < bound && pe_maps_get_info(exact)->error_estimate == 0, "%s: within %.4f of every texel's sum", name, off);
    ok(same == 0, "%s: the same bits for any number of threads", name);
    pe_maps_free(alone);
    pe_maps_free(exact);
    pe_maps_free(fast);
    pe_env_free(env);
}

/* [Okumura Table 2]: what falls below the threshold is missing, unless the rest makes up for it. */
static void test_threshold(void)
{
    pe_bake_options options = { .method = PE_METHOD_VOXELS, .smoothness.size = 32, .threshold = 0.1 };
    pe_env *env = make_env(reference_constant(WIDTH, HEIGHT, 1));
    double seen[2];

    for (int lost = 0; lost < 2; lost++) {
        pe_maps *maps;

        options.lost = (pe_lost_weight)lost;
        maps = bake(env, &options);
        seen[lost] = (double)pe_maps_image(maps, 16)[3 * (16 * 32 + 28)];
        pe_maps_free(maps);
    }
    ok(fabs(seen[PE_LOST_SPREAD] - 1) < 1e-6 && fabs(seen[PE_LOST_DARK] - 0.9) < 0.02,
       "threshold 0.1 of white: %.5f spread, %.5f missing, as cos^n above 0.1 is 0.9 of all of it",
       seen[PE_LOST_SPREAD], seen[PE_LOST_DARK]);
    pe_env_free(env);
}

/* ---- splines ---- */

/* Three plane waves, which a sphere has no seam for. */
static void wave(const double d[3], double rgb[3])
{
    rgb[0] = cos(4 * d[0] + 1);
    rgb[1] = cos(4 * d[1] + 2);
    rgb[2] = cos(3 * d[2] - 2 * d[1]);
}

static void test_globe(void)
{
    enum { W = 64, H = 32, TRIES = 4000 };
    static float rgb[3 * W * H], line[2 * (W + H)];
    float *coefficients = malloc(pe_globe_values(W, H) * sizeof *coefficients);
    double worst = 0;
    unsigned state = 9;

    need(coefficients != NULL, "no memory");
    for (int k = 0; k < W * H; k++) {
        double d[3], value[3];
        int row = k / W;

        pe_latlong_direction((k % W + 0.5) / W, (row + 0.5) / H, d);
        wave(d, value);
        for (int c = 0; c < 3; c++)
            rgb[3 * k + c] = (float)value[c];
    }
    pe_globe_coefficients(rgb, W, H, line, coefficients);
    for (int k = 0; k < TRIES; k++) {
        double d[3], u, v, expected[3];
        pe_quad got;

        reference_random_direction(&state, d);
        if (k % 4 == 0) { /* within a texel of a pole */
            d[0] *= 0.03;
            d[2] *= 0.03;
            pe_normalize(d, d);
        }
        pe_latlong_coordinates(d, &u, &v);
        got = pe_globe_look(coefficients, W, H, (float)u, (float)v);
        wave(d, expected);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fabs((double)got[c] - expected[c]));
    }
    ok(worst < 0.003, "a spline over a lat-long picture follows waves within %.1e, over the poles and the seam", worst);
    free(coefficients);
}

/* Parabolas are followed exactly, and 1 is 1. */
static void test_layering(void)
{
    double worst = 0;

    for (int count = PE_LAYERS_MIN; count < 9; count++)
        for (int k = 0; k <= 1000; k++) {
            double place = (count - 1) * k / 1000.0, one = 0, square = 0;
            float weights[4];
            int first = pe_layering_weights(count, (float)place, weights);

            if (first < 0 || first + 4 > count)
                ok(0, "layers %d to %d of %d", first, first + 3, count);
            for (int i = 0; i < 4; i++) {
                one += (double)weights[i];
                square += (double)weights[i] * (first + i) * (first + i);
            }
            worst = worst_of(worst, worst_of(fabs(one - 1), fabs(square - place * place)));
        }
    ok(worst < 2e-5, "layers are mixed along a curve that follows parabolas within %.1e", worst);
}

/* ---- files ---- */

static void test_file(const char *name, pe_method method)
{
    pe_bake_options options = {
        .method = method, .smoothness = { 16, 5, 200 }, .threshold = 0.01, .lost = PE_LOST_DARK
    };
    char path[] = "/tmp/prefenv-test-voxels-XXXXXX";
    pe_env *env = make_env(reference_room(WIDTH, HEIGHT));
    pe_maps *maps = bake(env, &options), *back = NULL;
    const pe_maps_info *a, *b;
    pe_error error = { PE_OK, "" };

    close(mkstemp(path));
    need(pe_maps_write(maps, path, PE_PIXEL_FLOAT, &error) == PE_OK && pe_maps_read(path, &back, &error) == PE_OK, "%s",
         error.message);
    unlink(path);
    a = pe_maps_get_info(maps);
    b = pe_maps_get_info(back);
    ok(difference_of_images(maps, back) == 0 && a->method == b->method && a->images == b->images &&
           a->width == b->width && a->height == b->height &&
           memcmp(&a->smoothness, &b->smoothness, sizeof a->smoothness) == 0 && a->threshold == b->threshold &&
           a->lost == b->lost && a->lookup_error == b->lookup_error && a->error_estimate == b->error_estimate &&
           pe_maps_have_roughness(back),
       "%s: a file comes back as it went", name);
    pe_maps_free(back);
    pe_maps_free(maps);
    pe_env_free(env);
}

static void test_refusals(void)
{
    static const struct {
        pe_bake_options options;
        const char *words;
    } rows[] = {
        { { .method = PE_METHOD_VOXELS, .smoothness.size = 33 }, "size 33 is not an even number" },
        { { .method = PE_METHOD_VOXELS, .threshold = 0.9 }, "threshold 0.9 is out of range" },
        { { .method = PE_METHOD_LAYERS, .layers = 3 }, "layers 3 is out of range" },
        { { .method = PE_METHOD_LAYERS, .width = 100, .height = 40 }, "size 100 x 40 of layers is not twice as wide" },
        { { .method = PE_METHOD_LAYERS, .surface.ndf.kind = PE_NDF_GGX }, "are of Phong's lobe" },
        { { .method = PE_METHOD_LAYERS, .smoothness.window = 0.11 }, "window 0.11 is too narrow" },
        { { .method = PE_METHOD_VOXELS, .smoothness = { 8, 90, 2 } }, "window 90 is too wide" },
    };
    pe_env *env = make_env(reference_constant(WIDTH, HEIGHT, 1));

    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        pe_error error = { PE_OK, "" };
        pe_maps *maps = NULL;

        ok(pe_bake(env, &rows[k].options, &maps, &error) == PE_ERROR_ARGUMENT && strstr(error.message, rows[k].words),
           "refused: %s", error.message);
    }
    pe_env_free(env);
}

int main(void)
{
    pe_bake_options voxels = { .method = PE_METHOD_VOXELS, .smoothness.size = 64 };
    pe_bake_options layers = { .method = PE_METHOD_LAYERS, .smoothness.size = 64 };

    test_dome();
    test_shares();
    test_weights(0.001);
    test_weights(0.1);
    test_weights_file();
    test_globe();
    test_layering();
    test_lookups("voxels, white", make_env(reference_constant(WIDTH, HEIGHT, 1)), &voxels, 1e-6, 1e-6);
    test_lookups("layers, white", make_env(reference_constant(WIDTH, HEIGHT, 1)), &layers, 1e-6, 1e-5);
    test_lookups("voxels, hues", make_env(pattern()), &voxels, 0.003, 0.1);
    test_lookups("layers, hues", make_env(pattern()), &layers, 0.0002, 0.01);
    test_lookups("layers, a room", make_env(reference_room(WIDTH, HEIGHT)), &layers, 0.003, 0.1);
    test_exact_twin("voxels", PE_METHOD_VOXELS, make_env(pattern()), 0.05);
    test_exact_twin("layers", PE_METHOD_LAYERS, make_env(reference_room(WIDTH, HEIGHT)), 0.01);
    test_threshold();
    test_file("voxels", PE_METHOD_VOXELS);
    test_file("layers", PE_METHOD_LAYERS);
    test_refusals();
    return done_testing();
}
