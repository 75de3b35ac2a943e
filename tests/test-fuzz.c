/* test-fuzz.c - claim: no bytes make a loader crash, hang or speak in more than one sentence.
 *
 * Small valid files of every kind are damaged in a fixed, random way some thousand times and loaded.  Run under a
 * sanitizer (`make check-c` in a build configured with --enable-sanitizer=address,undefined) it sees more than
 * crashes. */
#include "prefenv.h"
#include "reference.h"
#include "sample_point.h"
#include "tap.h"
#include "weights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SIZE_MAX_BYTES 65536
#define ROUNDS 4000

typedef struct seed {
    const char *name;
    unsigned char bytes[SIZE_MAX_BYTES];
    size_t size;
    int rounds;
} seed;

static void load_file(const char *path, seed *s)
{
    FILE *file = fopen(path, "rb");

    need(file != NULL, "cannot open %s", path);
    s->size = fread(s->bytes, 1, sizeof s->bytes, file);
    fclose(file);
    unlink(path);
    need(s->size > 0 && s->size < sizeof s->bytes, "%s has %zu bytes", path, s->size);
}

/* The file of maps baked from width x width / 2 texels, which are freed; returns how many suns they have. */
static int bake_seed(seed *s, float *rgb, int width, const pe_bake_options *options, pe_pixel_type type)
{
    char path[] = "/tmp/prefenv-test-fuzz-XXXXXX";
    pe_env *env;
    pe_maps *maps = NULL;
    pe_error error = { PE_OK, "" };
    int suns;

    close(mkstemp(path));
    need(pe_env_create(width, width / 2, rgb, &env, &error) == PE_OK && pe_bake(env, options, &maps, &error) == PE_OK &&
             pe_maps_write(maps, path, type, &error) == PE_OK,
         "cannot make maps: %s", error.message);
    load_file(path, s);
    suns = pe_maps_get_info(maps)->suns;
    pe_maps_free(maps);
    pe_env_free(env);
    free(rgb);
    return suns;
}

static float *noise_with_sun(unsigned first)
{
    float *rgb = reference_noise(48, 24, first);

    rgb[3 * (9 * 48 + 20)] = 30000;
    return rgb;
}

static void seed_maps(seed *s, pe_pixel_type type)
{
    pe_bake_options options = {
        .normals = 12, .width = 8, .height = 8, .surface.ndf = { PE_NDF_BECKMANN, 0.5, 0.5, NULL }
    };

    bake_seed(s, reference_noise(16, 8, 1), 16, &options, type);
}

/* A sun and four brush angles. */
static void seed_angles(seed *s)
{
    pe_bake_options options = {
        .normals = 12, .width = 8, .height = 9, .angles = 4, .surface.ndf = { PE_NDF_GGX, 0.5, 0.3, NULL }
    };

    need(bake_seed(s, noise_with_sun(4), 48, &options, PE_PIXEL_HALF) == 1, "angles without their sun");
}

static void seed_roughness(seed *s, pe_method method)
{
    pe_bake_options options = { .method = method, .smoothness.size = 8, .layers = 4, .width = 32 };

    bake_seed(s, reference_noise(16, 8, 6), 16, &options, PE_PIXEL_HALF);
}

/* Grades, and a sun. */
static void seed_grades(seed *s)
{
    pe_bake_options options = { .method = PE_METHOD_GRADES,
                                .normals = 12,
                                .width = 8,
                                .height = 8,
                                .layers = 4,
                                .surface.ndf = { PE_NDF_BECKMANN, 0.3, 0.2, NULL },
                                .alpha_max = 0.9 };

    need(bake_seed(s, noise_with_sun(7), 48, &options, PE_PIXEL_HALF) == 1, "grades without their sun");
}

static void seed_table(seed *s)
{
    static const double range[2] = { -0.3, 0.5 };
    char path[] = "/tmp/prefenv-test-fuzz-XXXXXX";
    float *density = reference_noise(8, 3, 5);
    pe_ndf_table *table = NULL;

    close(mkstemp(path));
    need(pe_ndf_table_create(24, 3, range, range, density, &table, NULL) == PE_OK &&
             pe_ndf_table_write(table, path, NULL) == PE_OK,
         "cannot make a table");
    load_file(path, s);
    pe_ndf_table_free(table);
    free(density);
}

static void seed_png(seed *s)
{
    char path[] = "/tmp/prefenv-test-fuzz-XXXXXX";
    float *rgb = reference_noise(17, 9, 2);
    pe_image image = { 17, 9, rgb, NULL };

    close(mkstemp(path));
    need(pe_image_write_png(path, &image, NULL) == PE_OK, "cannot make a PNG");
    load_file(path, s);
    free(rgb);
}

/* A Radiance picture of 16 x 4: two lines of new run lengths, two flat ones with an old run. */
static void seed_hdr(seed *s)
{
    static const char header[] = "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 16\n";
    static const unsigned char flat[] = { 10, 20, 30, 128, 1, 1, 1, 15 };
    unsigned char *at = s->bytes;

    memcpy(at, header, sizeof header - 1);
    at += sizeof header - 1;
    for (int line = 0; line < 2; line++) {
        static const unsigned char start[] = { 2, 2, 0, 16 };

        memcpy(at, start, 4);
        at += 4;
        for (int component = 0; component < 4; component++) {
            *at++ = 128 + 12;
            *at++ = (unsigned char)(100 + component);
            *at++ = 4;
            for (int k = 0; k < 4; k++)
                *at++ = (unsigned char)(120 + k);
        }
    }
    for (int line = 0; line < 2; line++) {
        memcpy(at, flat, sizeof flat);
        at += sizeof flat;
    }
    s->size = (size_t)(at - s->bytes);
}

/* Heights with their pitch, one of them not measured. */
static void seed_heights(seed *s)
{
    char path[] = "/tmp/prefenv-test-fuzz-XXXXXX";
    float *rgb = reference_noise(9, 8, 3);
    pe_heights heights = { .width = 9, .height = 8, .pitch = 0.5, .values = rgb };

    close(mkstemp(path));
    rgb[40] = NAN;
    need(pe_heights_write(&heights, path, NULL) == PE_OK, "cannot write heights");
    load_file(path, s);
    free(rgb);
}

/* One of: a flipped bit, a random byte, a byte of great or small value, a cut, a block copied elsewhere. */
static void damage(unsigned char *bytes, size_t *size, unsigned *state)
{
    size_t at = (size_t)(reference_random(state) * (double)*size);

    switch ((int)(reference_random(state) * 5)) {
    case 0:
        bytes[at] ^= (unsigned char)(1 << (int)(reference_random(state) * 8));
        break;
    case 1:
        bytes[at] = (unsigned char)(reference_random(state) * 256);
        break;
    case 2:
        bytes[at] = reference_random(state) < 0.5 ? 0xff : 0x7f;
        break;
    case 3:
        if (reference_random(state) < 0.2)
            *size = at ? at : 1;
        break;
    default: {
        size_t from = (size_t)(reference_random(state) * (double)*size), count = (size_t)(reference_random(state) * 32);

        count = count < *size - from ? count : *size - from;
        count = count < *size - at ? count : *size - at;
        memmove(bytes + at, bytes + from, count);
    }
    }
}

/* 1 if the bytes as heights or normals end in slopes or in one sentence. */
static int measures_or_says(const unsigned char *bytes, size_t size)
{
    pe_heights heights;
    pe_slopes slopes;
    pe_image image;
    pe_error error = { PE_OK, "" };
    int sound = 1;

    if (pe_heights_read_memory(bytes, size, "fuzz", 1, 1, &heights, &error) == PE_OK) {
        if (pe_slopes_of_heights(&heights, PE_EDGES_WRAP, &slopes, &error) == PE_OK)
            pe_slopes_free(&slopes);
        pe_heights_free(&heights);
    } else {
        sound &= error.message[0] && !strchr(error.message, '\n');
    }
    if (pe_image_read_data_memory(bytes, size, "fuzz", &image, &error) == PE_OK) {
        if (pe_slopes_of_normals(&image, "fuzz", PE_GREEN_UP, &slopes, &error) == PE_OK)
            pe_slopes_free(&slopes);
        pe_image_free(&image);
    }
    return sound;
}

/* A table that loads can be looked up and drawn from. */
static int table_loads_or_says(const unsigned char *bytes, size_t size)
{
    pe_ndf_table *table;
    pe_error error = { PE_OK, "" };
    pe_ndf ndf = { .kind = PE_NDF_TABLE };
    double h[3] = { 0.1, 0.2, 0.9 };

    if (pe_ndf_table_read_memory(bytes, size, "fuzz", &table, &error) != PE_OK)
        return error.message[0] && !strchr(error.message, '\n');
    ndf.table = table;
    pe_ndf_evaluate(&ndf, h);
    pe_ndf_sample(&ndf, 0.5, 0.999, h);
    pe_ndf_table_free(table);
    return h[2] > 0;
}

/* 1 if loading the bytes in every way ends in success or in one sentence. */
static int loads_or_says(const unsigned char *bytes, size_t size, int *loaded)
{
    pe_image image;
    pe_env *env;
    pe_maps *maps = NULL;
    pe_error error = { PE_OK, "" };
    int sound = 1;

    if (pe_image_read_memory(bytes, size, "fuzz", &image, &error) == PE_OK) {
        pe_image_free(&image);
        ++*loaded;
    } else {
        sound &= error.message[0] && !strchr(error.message, '\n');
    }
    if (pe_env_read_memory(bytes, size, "fuzz", &env, &error) == PE_OK)
        pe_env_free(env);
    if (pe_maps_read_memory(bytes, size, "fuzz", &maps, &error) == PE_OK) {
        static const double n[3] = { 1, 2, 3 }, o[3] = { 1, 2, -0.5 };
        double rgb[3];

        for (int k = 0; k < pe_maps_get_info(maps)->images; k++)
            pe_maps_normal(maps, k, rgb);
        sample_point(maps, NULL, NULL, n, n, rgb);
        sample_point(maps, NULL, o, n, o, rgb);
        pe_maps_free(maps);
    } else {
        sound &= error.message[0] && !strchr(error.message, '\n');
    }
    pe_maps_detect(bytes, size);
    return sound && measures_or_says(bytes, size) && table_loads_or_says(bytes, size);
}

static void test_seed(const seed *s)
{
    static unsigned char bytes[SIZE_MAX_BYTES];
    unsigned state = 99;
    int sound = 1, loaded = 0, whole = 0;

    loads_or_says(s->bytes, s->size, &whole);
    ok(whole == 1, "%s: %zu bytes load", s->name, s->size);
    for (int round = 0; round < s->rounds; round++) {
        size_t size = s->size;

        memcpy(bytes, s->bytes, size);
        for (int k = 0; k <= round % 4; k++)
            damage(bytes, &size, &state);
        sound &= loads_or_says(bytes, size, &loaded);
    }
    ok(sound, "%s: %d damaged copies, %d still load", s->name, s->rounds, loaded);
}

/* Weights carry a sum of their bytes, which says no to nearly all that is damaged: it is put right, so that what is
 * behind it is tried, too. */
static void test_weights(void)
{
    static unsigned char whole[SIZE_MAX_BYTES], bytes[SIZE_MAX_BYTES];
    const pe_smoothness scale = { 8, 2, 4 };
    char path[] = "/tmp/prefenv-test-fuzz-XXXXXX";
    unsigned state = 4;
    int sound = 1, loaded = 0;
    pe_weights *w;
    size_t size;
    FILE *file;

    close(mkstemp(path));
    need(pe_weights_make(&scale, 0.3, 1, NULL, &w, NULL) == PE_OK && pe_weights_write(w, path, NULL) == PE_OK,
         "cannot make weights");
    pe_weights_free(w);
    file = fopen(path, "rb");
    need(file != NULL, "cannot open %s", path);
    size = fread(whole, 1, sizeof whole, file);
    fclose(file);
    unlink(path);
    need(size > 100 && size < sizeof whole, "weights have %zu bytes", size);
    for (int round = 0; round < ROUNDS / 10; round++) {
        size_t cut = size;
        pe_error error = { PE_OK, "" };

        memcpy(bytes, whole, size);
        for (int k = 0; k <= round % 3; k++)
            damage(bytes, &cut, &state);
        if (round % 2 && cut > 8)
            pe_weights_seal(bytes, cut);
        if (pe_weights_read_memory(bytes, cut, "fuzz", &w, &error) == PE_OK) {
            pe_weights_free(w);
            loaded++;
        } else {
            sound &= error.message[0] && !strchr(error.message, '\n');
        }
    }
    ok(sound, "weights: %zu bytes, %d damaged copies, %d still load", size, ROUNDS / 10, loaded);
}

int main(void)
{
    static seed seeds[] = { { .name = "half maps" }, { .name = "float maps" }, { .name = "PNG" },
                            { .name = "HDR" },       { .name = "heights" },    { .name = "table" },
                            { .name = "angles" },    { .name = "layers" },     { .name = "voxels" },
                            { .name = "grades" } };

    seed_maps(&seeds[0], PE_PIXEL_HALF);
    seed_maps(&seeds[1], PE_PIXEL_FLOAT);
    seed_png(&seeds[2]);
    seed_hdr(&seeds[3]);
    seed_heights(&seeds[4]);
    seed_table(&seeds[5]);
    seed_angles(&seeds[6]);
    seed_roughness(&seeds[7], PE_METHOD_LAYERS);
    seed_roughness(&seeds[8], PE_METHOD_VOXELS);
    seed_grades(&seeds[9]);
    for (int k = 0; k < 10; k++) {
        seeds[k].rounds = k < 6 ? ROUNDS : ROUNDS / 10; /* with suns or more parts, loading takes longer */
        test_seed(&seeds[k]);
    }
    test_weights();
    return done_testing();
}
