/* test-ndf-table.c - claims: a measured distribution is normalised, is drawn from as it is, survives its file, and is
 * filtered with as pe_exact does; and a Beckmann distribution tabulated finely bakes as the closed form does. */
#include "exr.h"
#include "prefenv.h"
#include "reference.h"
#include "tap.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double plus_y[3] = { 0, 1, 0 };

static pe_ndf_table *make(int width, int height, const double p_range[2], const double q_range[2], const float *density)
{
    pe_ndf_table *table;
    pe_error error;

    need(pe_ndf_table_create(width, height, p_range, q_range, density, &table, &error) == PE_OK, "%s", error.message);
    return table;
}

static pe_ndf_table *make_beckmann(double alpha_x, double alpha_y, int cells)
{
    const double p_range[2] = { -6 * alpha_x, 6 * alpha_x }, q_range[2] = { -6 * alpha_y, 6 * alpha_y };
    float *density = malloc((size_t)cells * (size_t)cells * sizeof *density);
    pe_ndf_table *table;

    for (int k = 0; k < cells * cells; k++) {
        int row = k / cells;
        double p = 12 * (k % cells + 0.5) / cells - 6, q = 12 * (row + 0.5) / cells - 6;

        density[k] = (float)exp(-p * p - q * q);
    }
    table = make(cells, cells, p_range, q_range, density);
    free(density);
    return table;
}

/* Two ridges that miss the middle, as milling leaves them, and noise; nothing about it is even. */
static pe_ndf_table *make_ridges(void)
{
    const double p_range[2] = { -0.3, 0.5 }, q_range[2] = { -0.6, 0.2 };
    enum { WIDTH = 64, HEIGHT = 40 };
    static float density[WIDTH * HEIGHT];
    unsigned state = 3;

    for (int k = 0; k < WIDTH * HEIGHT; k++) {
        int x = k % WIDTH;

        density[k] = (float)(reference_random(&state) * (fabs(x - 14.0) < 5 || fabs(x - 40.0) < 9 ? 1 : 0.01));
    }
    return make(WIDTH, HEIGHT, p_range, q_range, density);
}

/* D of slopes, times cos^4 theta: P. */
static double slope_density(const pe_ndf *ndf, double p, double q)
{
    double h[3] = { p, q, 1 };

    pe_normalize(h, h);
    return pe_ndf_evaluate(ndf, h) * pow(h[2], 4);
}

/* The integral of P, by a midpoint rule whose steps end where P has its creases. */
static void test_integral(const pe_ndf *ndf)
{
    enum { FINE = 16 };
    double sum = 0, p_step = 0.0125 / FINE, q_step = 0.02 / FINE;

    for (int i = 0; i < 80 * FINE; i++)
        for (int j = 0; j < 60 * FINE; j++)
            sum += slope_density(ndf, -0.30625 - 0.0125 + (i + 0.5) * p_step, -0.61 - 0.02 + (j + 0.5) * q_step);
    ok(fabs(sum * p_step * q_step - 1) < 2e-6, "ridges: the integral of P is %.7f", sum * p_step * q_step);
}

/* Halfway between samples bilinear is the mean; a cell's width outside there is nothing. */
static void test_bilinear(void)
{
    const double range[2] = { 0, 2 }, other[2] = { -1, 2 };
    const float density[6] = { 1, 3, 5, 7, 2, 6 };
    pe_ndf_table *table = make(2, 3, range, other, density);
    pe_ndf ndf = { .kind = PE_NDF_TABLE, .table = table };

    ok(fabs(slope_density(&ndf, 0.5, -0.5) - 1 / 24.0) < 1e-7, "the first sample is at the least p and q");
    ok(fabs(slope_density(&ndf, 1.5, 1.5) - 6 / 24.0) < 1e-7, "the last at the greatest");
    ok(fabs(slope_density(&ndf, 1, 0) - 4 / 24.0) < 1e-7, "bilinear between four");
    ok(fabs(slope_density(&ndf, -0.25, -0.5) - 0.25 / 24) < 1e-7, "it falls to 0 outside");
    ok(slope_density(&ndf, -0.51, -0.5) == 0 && slope_density(&ndf, 1, 2.51) == 0, "and is 0 a cell away");
    pe_ndf_table_free(table);
}

/* Chi-square over the cells of a grid of its own. */
static void test_sampler(const pe_ndf *ndf)
{
    enum { CELLS = 24, FINE = 40, SAMPLES = 1000000 };
    static int counts[CELLS][CELLS];
    double chi_square = 0, z, step = 1.0 / CELLS;
    int used = 0, lost = SAMPLES;
    unsigned state = 5;

    memset(counts, 0, sizeof counts);
    for (int k = 0; k < SAMPLES; k++) {
        double u1 = reference_random(&state), h[3];
        int x, y;

        pe_ndf_sample(ndf, u1, reference_random(&state), h);
        x = (int)floor((h[0] / h[2] + 0.4) / step);
        y = (int)floor((h[1] / h[2] + 0.7) / step);
        if (x >= 0 && y >= 0 && x < CELLS && y < CELLS)
            counts[y][x]++, lost--;
    }
    for (int cell = 0; cell < CELLS * CELLS; cell++) {
        int across = cell % CELLS, down = cell / CELLS;
        double expected = 0;

        for (int k = 0; k < FINE * FINE; k++) {
            int i = k % FINE, j = k / FINE;

            expected +=
                slope_density(ndf, -0.4 + step * (across + (i + 0.5) / FINE), -0.7 + step * (down + (j + 0.5) / FINE));
        }
        expected *= SAMPLES * step * step / (FINE * FINE);
        if (expected < 10)
            continue;
        chi_square += pow(counts[down][across] - expected, 2) / expected;
        used++;
    }
    z = (cbrt(chi_square / used) - (1 - 2.0 / (9 * used))) / sqrt(2.0 / (9 * used));
    ok(z < 3.7, "ridges: sampler's chi-square of %d cells is %.0f", used, chi_square);
    ok(lost == 0, "ridges: %d samples lie where P is 0", lost);
}

static void test_file(const pe_ndf_table *table)
{
    char path[] = "/tmp/prefenv-test-table-XXXXXX";
    pe_ndf ndf = { .kind = PE_NDF_TABLE, .table = table }, back = ndf;
    pe_ndf_table *again = NULL;
    pe_error error;
    double worst = 0, alpha[2], alpha_again[2];
    unsigned state = 8;

    close(mkstemp(path));
    need(pe_ndf_table_write(table, path, &error) == PE_OK && pe_ndf_table_read(path, &again, &error) == PE_OK, "%s",
         error.message);
    unlink(path);
    back.table = again;
    for (int k = 0; k < 10000; k++) {
        double p = reference_random(&state) - 0.4, q = reference_random(&state) - 0.7;

        worst = worst_of(worst, fabs(slope_density(&ndf, p, q) - slope_density(&back, p, q)));
    }
    ok(worst < 1e-5, "written and read again it is the same within %.1e", worst);
    ok(strcmp(pe_ndf_table_name(again), strrchr(path, '/') + 1) == 0 && !*pe_ndf_table_name(table),
       "it is called as its file");
    pe_ndf_table_alpha(table, alpha);
    pe_ndf_table_alpha(again, alpha_again);
    ok(fabs(alpha[0] - alpha_again[0]) < 1e-6 && fabs(alpha[1] - alpha_again[1]) < 1e-6, "its widths are %.3f, %.3f",
       alpha[0], alpha[1]);
    pe_ndf_table_free(again);
}

static void refuse(int width, int height, double low, double high, const float *density, pe_status why,
                   const char *word)
{
    const double range[2] = { low, high }, sound[2] = { -1, 1 };
    pe_ndf_table *table;
    pe_error error = { PE_OK, "" };

    ok(pe_ndf_table_create(width, height, range, sound, density, &table, &error) == why && error.status == why &&
           strstr(error.message, word),
       "refused: %s", error.message);
}

static void test_refusals(void)
{
    static const float good[4] = { 1, 1, 1, 1 }, negative[4] = { 1, -1, 1, 1 }, nan[4] = { 1, NAN, 1, 1 };
    static const float infinite[4] = { 1, INFINITY, 1, 1 }, nothing[4] = { 0 };

    refuse(1, 2, -1, 1, good, PE_ERROR_ARGUMENT, "1 x 2");
    refuse(8192, 8192, -1, 1, good, PE_ERROR_LIMIT, "8192 x 8192");
    refuse(2, 2, 1, -1, good, PE_ERROR_ARGUMENT, "from 1 to -1");
    refuse(2, 2, 0, NAN, good, PE_ERROR_ARGUMENT, "from 0 to nan");
    refuse(2, 2, -2000, 1, good, PE_ERROR_ARGUMENT, "-2000");
    refuse(2, 2, -1, 1, negative, PE_ERROR_ARGUMENT, "is -1");
    refuse(2, 2, -1, 1, nan, PE_ERROR_ARGUMENT, "is nan");
    refuse(2, 2, -1, 1, infinite, PE_ERROR_ARGUMENT, "is inf");
    refuse(2, 2, -1, 1, nothing, PE_ERROR_ARGUMENT, "0 everywhere");
}

/* What an argument may not be, a file's format may not. */
static void test_small_file(void)
{
    static const float density[2] = { 1, 1 };
    const pe_attribute attributes[] = {
        { .name = "prefenv:ndf-version", .type = PE_ATTRIBUTE_INT, .integer = 1 },
        { .name = "prefenv:ndf-p-min", .type = PE_ATTRIBUTE_DOUBLE, .number = -1 },
        { .name = "prefenv:ndf-p-max", .type = PE_ATTRIBUTE_DOUBLE, .number = 1 },
        { .name = "prefenv:ndf-q-min", .type = PE_ATTRIBUTE_DOUBLE, .number = -1 },
        { .name = "prefenv:ndf-q-max", .type = PE_ATTRIBUTE_DOUBLE, .number = 1 },
    };
    unsigned char *bytes;
    pe_ndf_table *table;
    pe_error error;
    size_t size;

    need(pe_exr_encode_gray(density, 1, 2, attributes, 5, &bytes, &size, &error) == PE_OK, "%s", error.message);
    ok(pe_ndf_table_read_memory(bytes, size, "narrow.exr", &table, &error) == PE_ERROR_FORMAT &&
           strstr(error.message, "narrow.exr: a table of 1 x 2"),
       "refused: %s", error.message);
    free(bytes);
}

static pe_maps *bake(const pe_env *env, const pe_ndf *ndf, pe_accuracy accuracy, int width, int height, int threads)
{
    pe_bake_options options = { .method = PE_METHOD_REPRESENTATIVE,
                                .surface.ndf = *ndf,
                                .normals = 12,
                                .width = width,
                                .height = height,
                                .accuracy = accuracy,
                                .threads = threads };
    pe_maps *maps;
    pe_error error;

    need(pe_bake(env, &options, &maps, &error) == PE_OK, "%s", error.message);
    return maps;
}

/* Relative L2 over the texels with |n.r| > cosine_min. */
static double difference(const pe_maps *a, const pe_maps *b, double cosine_min)
{
    const pe_maps_info *info = pe_maps_get_info(a);
    int texels = info->width * info->height;
    double error2 = 0, norm2 = 0;

    for (int k = 0; k < info->images * texels; k++) {
        double n[3], r[3], theta;

        reference_direction(info->width, info->height, k % texels % info->width, k % texels / info->width, r, &theta);
        pe_maps_normal(a, k / texels, n);
        for (int c = 0; c < 3 && fabs(pe_dot(n, r)) > cosine_min; c++) {
            double truth = (double)pe_maps_image(b, k / texels)[3 * (k % texels) + c];

            error2 += pow((double)pe_maps_image(a, k / texels)[3 * (k % texels) + c] - truth, 2);
            norm2 += truth * truth;
        }
    }
    return sqrt(error2 / norm2);
}

/* Between samples a Gaussian lies off its chord by step^2 / alpha^2 of its height at most; of 512 in 12 alpha that is
 * 5e-4; what it does to a mean over the lobe is far less. */
static void test_beckmann(double alpha_x, double alpha_y, int width)
{
    pe_ndf_table *table = make_beckmann(alpha_x, alpha_y, 512);
    pe_ndf tabulated = { .kind = PE_NDF_TABLE, .table = table }, closed = { PE_NDF_BECKMANN, alpha_x, alpha_y, NULL };
    float *rgb = reference_noise(width, width / 2, 12);
    double alpha[2], error;
    pe_maps *a, *b;
    pe_env *env = NULL;

    need(pe_env_create(width, width / 2, rgb, &env, NULL) == PE_OK, "no memory");
    pe_ndf_table_alpha(table, alpha);
    ok(fabs(alpha[0] / alpha_x - 1) < 1e-3 && fabs(alpha[1] / alpha_y - 1) < 1e-3, "beckmann %g, %g: widths %g, %g",
       alpha_x, alpha_y, alpha[0], alpha[1]);
    a = bake(env, &tabulated, PE_ACCURACY_EXACT, 60, 30, 0);
    b = bake(env, &closed, PE_ACCURACY_EXACT, 60, 30, 0);
    error = difference(a, b, 0.15);
    ok(error < 1e-4, "beckmann %g, %g tabulated bakes as the closed form does: %.1e", alpha_x, alpha_y, error);
    ok(pe_maps_get_info(a)->surface.ndf.kind == PE_NDF_TABLE && !pe_maps_get_info(a)->surface.ndf.table &&
           pe_maps_get_info(a)->surface.ndf.alpha_x == alpha[0],
       "the maps keep kind and widths, not the table");
    pe_maps_free(a);
    pe_maps_free(b);
    pe_env_free(env);
    pe_ndf_table_free(table);
    free(rgb);
}

/* Production in single precision against pe_exact; threads change nothing. */
static void test_bake(const pe_ndf *ndf)
{
    float *rgb = reference_noise(64, 32, 4);
    pe_surface surface = { .ndf = *ndf };
    pe_env *env = NULL;
    pe_maps *maps, *alone;
    double error2 = 0, norm2 = 0, rms;

    need(pe_env_create(64, 32, rgb, &env, NULL) == PE_OK, "no memory");
    maps = bake(env, ndf, PE_ACCURACY_EXACT, 60, 30, 0);
    for (int texel = 0; texel < 60 * 30; texel++) {
        double n[3], r[3], o[3], theta, exact[3];

        reference_direction(60, 30, texel % 60, texel / 60, r, &theta);
        pe_maps_normal(maps, 2, n);
        pe_scale(pe_dot(r, n) > 0 ? 1 : -1, n, n);
        pe_reflect(r, n, o);
        pe_exact(env, &surface, plus_y, n, o, exact);
        for (int c = 0; c < 3; c++) {
            error2 += pow((double)pe_maps_image(maps, 2)[3 * texel + c] - exact[c], 2);
            norm2 += exact[c] * exact[c];
        }
    }
    rms = sqrt(error2 / norm2);
    ok(rms < 3e-6, "ridges: bake and exact differ by %.1e", rms);
    alone = bake(env, ndf, PE_ACCURACY_EXACT, 60, 30, 1);
    ok(difference(maps, alone, 0) == 0, "ridges: one thread bakes the same bits");
    pe_maps_free(maps);
    pe_maps_free(alone);
    pe_env_free(env);
    free(rgb);
}

/* However narrow the lobe and bright the light, sums over it are floats. */
static void test_bright(double reach, pe_accuracy accuracy)
{
    const double range[2] = { -reach, reach };
    float density[16], *rgb = reference_constant(64, 32, 1);
    pe_ndf ndf = { .kind = PE_NDF_TABLE };
    pe_ndf_table *table;
    pe_env *env = NULL;
    pe_maps *maps;
    int wrong = 0;

    for (int k = 0; k < 16; k++)
        density[k] = 1;
    for (int k = 0; k < 9; k++)
        rgb[3 * (32 * 9 + k)] = PE_RADIANCE_MAX;
    ndf.table = table = make(4, 4, range, range, density);
    need(pe_env_create(64, 32, rgb, &env, NULL) == PE_OK, "no memory");
    maps = bake(env, &ndf, accuracy, 64, 32, 0);
    for (int k = 0; k < pe_maps_get_info(maps)->images * 3 * 64 * 32; k++)
        wrong += !(pe_maps_image(maps, 0)[k] <= 1.001f * PE_RADIANCE_MAX);
    ok(wrong == 0, "slopes within %g, light of %g: %d values are wrong", reach, (double)PE_RADIANCE_MAX, wrong);
    pe_maps_free(maps);
    pe_env_free(env);
    pe_ndf_table_free(table);
    free(rgb);
}

int main(void)
{
    pe_ndf_table *table = make_ridges();
    pe_ndf ndf = { .kind = PE_NDF_TABLE, .table = table };

    test_bilinear();
    test_integral(&ndf);
    test_sampler(&ndf);
    test_file(table);
    test_refusals();
    test_small_file();
    test_bake(&ndf);
    test_beckmann(0.1, 0.1, 256);
    test_beckmann(0.1, 0.03, 256);
    test_beckmann(0.01, 0.01, 1024);
    test_bright(1e-6, PE_ACCURACY_EXACT);
    test_bright(1e-6, PE_ACCURACY_FAST);
    test_bright(1000, PE_ACCURACY_EXACT);
    pe_ndf_table_free(table);
    return done_testing();
}
