/* test-maps.c - claims: a maps file read and written again has the same bytes; threads change nothing; what is wrong
 * with a file or an option is said in one sentence, and nothing is left behind. */
#include "prefenv.h"
#include "reference.h"
#include "tap.h"

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/prefenv-test-maps-XXXXXX";

static const char *in_folder(const char *name)
{
    static char paths[4][128];
    static int next;
    char *path = paths[next = (next + 1) % 4];

    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static size_t read_bytes(const char *path, unsigned char *bytes, size_t room)
{
    FILE *file = fopen(path, "rb");
    size_t size = file ? fread(bytes, 1, room, file) : 0;

    if (file)
        fclose(file);
    return size;
}

static int same_bytes(const char *a, const char *b)
{
    static unsigned char bytes_a[1 << 22], bytes_b[1 << 22];
    size_t size = read_bytes(a, bytes_a, sizeof bytes_a);

    return size > 0 && size == read_bytes(b, bytes_b, sizeof bytes_b) && memcmp(bytes_a, bytes_b, size) == 0;
}

static int files_in_folder(void)
{
    DIR *dir = opendir(folder);
    int count = -2;

    while (readdir(dir))
        count++;
    closedir(dir);
    return count;
}

static pe_env *noise(int width, int height)
{
    float *rgb = reference_noise(width, height, 12);
    pe_env *env;

    need(pe_env_create(width, height, rgb, &env, NULL) == PE_OK, "no memory");
    free(rgb);
    return env;
}

static const pe_bake_options small = { .method = PE_METHOD_REPRESENTATIVE,
                                       .surface.ndf = { PE_NDF_BECKMANN, 0.2, 0.07, NULL },
                                       .direction = { 1, 2, 3 },
                                       .normals = 42,
                                       .width = 40,
                                       .height = 20 };

static void test_threads(pe_method method, pe_accuracy accuracy)
{
    pe_env *env = noise(96, 48);
    static const char *const names[] = { "1.exr", "2.exr", "3.exr" };

    for (int threads = 1; threads <= 3; threads++) {
        pe_bake_options options = small;
        pe_maps *maps;

        options.threads = threads;
        options.method = method;
        options.accuracy = accuracy;
        need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
        need(pe_maps_write(maps, in_folder(names[threads - 1]), PE_PIXEL_HALF, NULL) == PE_OK, "write");
        pe_maps_free(maps);
    }
    ok(same_bytes(in_folder("1.exr"), in_folder("2.exr")) && same_bytes(in_folder("1.exr"), in_folder("3.exr")),
       "%s, %s: 1, 2 and 3 threads write the same bytes", method == PE_METHOD_BASELINE ? "baseline" : "representative",
       accuracy == PE_ACCURACY_FAST ? "fast" : "exact");
    pe_env_free(env);
}

/* Of the maps' values, the largest relative difference from those read back. */
static double worst_difference(const pe_maps *maps, const pe_maps *back)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    const float *a = pe_maps_image(maps, 0), *b = pe_maps_image(back, 0);
    double worst = 0;

    for (size_t k = 0; k < 3 * (size_t)info->images * (size_t)info->width * (size_t)info->height; k++)
        worst = worst_of(worst, fabs((double)(b[k] - a[k])) / (double)a[k]);
    return worst;
}

/* Maps of a few texels do not shrink when they are deflated, and are written as they are. */
static void test_round_trip(pe_method method, pe_pixel_type type, int height)
{
    pe_env *env = noise(64, 32);
    pe_bake_options options = small;
    pe_maps *maps, *back;
    const pe_maps_info *info, *again;
    pe_error error;

    options.method = method;
    options.width = 2 * height;
    options.height = height;
    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
    need(pe_maps_write(maps, in_folder("a.exr"), type, NULL) == PE_OK, "write");
    need(pe_maps_read(in_folder("a.exr"), &back, &error) == PE_OK, "%s", error.message);
    need(pe_maps_write(back, in_folder("b.exr"), type, NULL) == PE_OK, "write again");
    ok(same_bytes(in_folder("a.exr"), in_folder("b.exr")), "write, read, write: the same bytes");
    info = pe_maps_get_info(maps);
    again = pe_maps_get_info(back);
    ok(info->method == again->method && info->normals == again->normals && info->images == again->images &&
           info->width == again->width && info->height == again->height &&
           info->surface.ndf.alpha_y == again->surface.ndf.alpha_y && info->direction[2] == again->direction[2] &&
           info->accuracy == again->accuracy && info->source_width == again->source_width &&
           info->error_estimate == again->error_estimate && info->source_fingerprint == pe_env_fingerprint(env) &&
           again->source_fingerprint == info->source_fingerprint && strcmp(info->source_name, again->source_name) == 0,
       "what the file says of itself is what was written");
    ok(worst_difference(maps, back) <= (type == PE_PIXEL_FLOAT ? 0 : 0x1p-11), "%d rows of %s come back %s", height,
       type == PE_PIXEL_FLOAT ? "floats" : "halves", type == PE_PIXEL_FLOAT ? "bit for bit" : "as the nearest half");
    pe_maps_free(maps);
    pe_maps_free(back);
    pe_env_free(env);
}

/* Every truncation, and a flip of every header byte and many others, must be refused or read, never more. */
static void test_damage(void)
{
    static unsigned char whole[1 << 20], bytes[1 << 20];
    pe_env *env = noise(16, 8);
    pe_bake_options options = small;
    pe_maps *maps;
    size_t size;
    int refused = 0, read = 0, silent = 0;

    options.normals = 12;
    options.width = 8;
    options.height = 4;
    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
    need(pe_maps_write(maps, in_folder("c.exr"), PE_PIXEL_HALF, NULL) == PE_OK, "write");
    pe_maps_free(maps);
    pe_env_free(env);
    size = read_bytes(in_folder("c.exr"), whole, sizeof whole);
    for (size_t k = 0; k < 2 * size; k++) {
        pe_error error = { PE_OK, "" };
        size_t length = k < size ? k : size;

        memcpy(bytes, whole, length);
        if (k >= size)
            bytes[k - size] ^= (unsigned char)(1u << k % 8);
        if (pe_maps_read_memory(bytes, length, "damaged.exr", &maps, &error) == PE_OK) {
            read++;
            if (k < size)
                silent++;
            pe_maps_free(maps);
            continue;
        }
        refused++;
        silent += strncmp(error.message, "damaged.exr: ", 13) != 0 || strchr(error.message, '\n') != NULL;
    }
    ok(silent == 0 && refused > (int)size, "%zu bytes truncated and flipped: %d refused in a sentence, %d read", size,
       refused, read);
}

static void test_wrong_files(void)
{
    static unsigned char bytes[1 << 20];
    pe_maps *maps = NULL;
    pe_error error = { PE_OK, "" };
    size_t size = read_bytes(in_folder("a.exr"), bytes, sizeof bytes);
    unsigned char *name = NULL;

    ok(pe_maps_read(in_folder("none.exr"), &maps, &error) == PE_ERROR_FILE && strstr(error.message, "none.exr"), "%s",
       error.message);
    ok(pe_maps_read(folder, &maps, &error) == PE_ERROR_FILE, "%s", error.message);
    ok(pe_maps_read("/dev/null", &maps, &error) == PE_ERROR_FORMAT, "%s", error.message);
    ok(pe_maps_detect(bytes, size) && !pe_maps_detect(bytes, 3) && !pe_maps_detect("hello", 5),
       "maps are told from other bytes");
    for (size_t k = 0; k + 14 < size && !name; k++)
        if (memcmp(bytes + k, "representative", 14) == 0)
            name = bytes + k;
    need(name != NULL, "no method in the file");
    name[0] = 'R';
    ok(pe_maps_read_memory(bytes, size, "m.exr", &maps, &error) == PE_ERROR_FORMAT &&
           strstr(error.message, "prefenv:method") && strstr(error.message, "Representative"),
       "%s", error.message);
}

/* A texel that is not a number must be found on load: nothing checks it later. */
static void test_nan(void)
{
    static unsigned char bytes[1 << 20];
    static const float nan = NAN;
    pe_bake_options options = small;
    pe_env *env = noise(16, 8);
    pe_maps *maps = NULL;
    pe_error error = { PE_OK, "" };
    float mark;
    size_t size;
    int marks = 0;

    options.width = options.height =
        2; /* noise this small gains nothing from ZIP: texels stand in the file as they are */
    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
    mark = pe_maps_image(maps, 0)[0];
    need(pe_maps_write(maps, in_folder("c.exr"), PE_PIXEL_FLOAT, NULL) == PE_OK, "write");
    pe_maps_free(maps);
    maps = NULL;
    size = read_bytes(in_folder("c.exr"), bytes, sizeof bytes);
    for (size_t k = 0; k + 4 <= size && !marks; k++)
        if (memcmp(bytes + k, &mark, 4) == 0) {
            memcpy(bytes + k, &nan, 4);
            marks++;
        }
    need(marks == 1, "no texel found in the file");
    ok(pe_maps_read_memory(bytes, size, "nan.exr", &maps, &error) == PE_ERROR_FORMAT && strstr(error.message, "finite"),
       "%s", error.message);
    pe_env_free(env);
}

static void test_modes_and_links(void)
{
    pe_env *env = noise(16, 8);
    pe_bake_options options = small;
    pe_maps *maps;
    pe_error error = { PE_OK, "" };
    struct stat about;

    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
    need(pe_maps_write(maps, in_folder("c.exr"), PE_PIXEL_HALF, NULL) == PE_OK, "write");
    need(chmod(in_folder("c.exr"), 0600) == 0 && symlink("c.exr", in_folder("link.exr")) == 0, "chmod and link");
    need(pe_maps_write(maps, in_folder("link.exr"), PE_PIXEL_HALF, NULL) == PE_OK, "write through a link");
    ok(stat(in_folder("c.exr"), &about) == 0 && (about.st_mode & 07777) == 0600, "a file replaced keeps its mode");
    ok(lstat(in_folder("link.exr"), &about) == 0 && S_ISLNK(about.st_mode), "a link stays a link");
    unlink(in_folder("c.exr"));
    ok(pe_maps_write(maps, in_folder("link.exr"), PE_PIXEL_HALF, &error) == PE_ERROR_FILE, "%s", error.message);
    unlink(in_folder("link.exr"));
    pe_maps_free(maps);
    pe_env_free(env);
}

static int stop_at_half(double fraction, void *data)
{
    *(int *)data += 1;
    return fraction > 0.5;
}

static void refuse(pe_bake_options options, const char *word)
{
    pe_env *env = noise(16, 8);
    pe_maps *maps = NULL;
    pe_error error = { PE_OK, "" };
    pe_status status = pe_bake(env, &options, &maps, &error);

    ok(status != PE_OK && !maps && strstr(error.message, word), "refused: %s", error.message);
    pe_env_free(env);
}

static void test_options(void)
{
    pe_bake_options options = small;
    pe_env *env = noise(64, 32);
    pe_maps *maps = NULL;
    pe_error error = { PE_OK, "" };
    pe_status status;
    int calls = 0;

    options.normals = 43;
    refuse(options, "42 and 92");
    options.normals = -1;
    refuse(options, "12");
    options = small;
    options.surface.ndf.alpha_x = 3;
    refuse(options, "alpha");
    options = small;
    options.width = 1;
    refuse(options, "size");
    options = small;
    options.width = options.height = 8192;
    refuse(options, "fewer, or smaller");
    options = small;
    options.direction[0] = INFINITY;
    refuse(options, "direction");
    options = small;
    options.accuracy = (pe_accuracy)7;
    refuse(options, "accuracy 7");
    options = small;
    options.quality = (pe_quality)-1;
    refuse(options, "quality -1");
    options = small;
    options.method = PE_METHOD_VOXELS;
    options.smoothness.size = 16;
    options.lost = (pe_lost_weight)9;
    refuse(options, "lost 9");
    options = small;
    for (int c = 0; c < 3; c++)
        options.direction[c] *= 1e-200;
    ok(pe_bake(env, &options, &maps, &error) == PE_OK, "a direction may have any length: 1e-200");
    pe_maps_free(maps);
    maps = NULL;
    options = small;
    options.progress = stop_at_half;
    options.progress_data = &calls;
    status = pe_bake(env, &options, &maps, &error);
    ok(status == PE_ERROR_CANCELLED && !maps && calls > 10, "cancelled after %d reports", calls);
    pe_env_free(env);
}

static void test_bright(void)
{
    float *rgb = reference_constant(16, 8, 1e6f);
    pe_env *env;
    pe_bake_options options = small;
    pe_maps *maps;
    pe_error error = { PE_OK, "" };
    int files = files_in_folder();

    need(pe_env_create(16, 8, rgb, &env, NULL) == PE_OK, "env");
    free(rgb);
    need(pe_bake(env, &options, &maps, NULL) == PE_OK, "bake");
    ok(pe_maps_write(maps, in_folder("bright.exr"), PE_PIXEL_HALF, &error) == PE_ERROR_LIMIT &&
           strstr(error.message, "65504"),
       "%s", error.message);
    ok(pe_maps_write(maps, in_folder("none/bright.exr"), PE_PIXEL_FLOAT, &error) == PE_ERROR_FILE, "%s", error.message);
    ok(pe_maps_write(maps, folder, PE_PIXEL_FLOAT, &error) == PE_ERROR_FILE, "%s", error.message);
    if (access("/dev/full", W_OK) == 0)
        ok(pe_maps_write(maps, "/dev/full", PE_PIXEL_FLOAT, &error) == PE_ERROR_FILE, "%s", error.message);
    ok(files_in_folder() == files, "nothing is left of what could not be written");
    pe_maps_free(maps);
    pe_env_free(env);
}

int main(void)
{
    static const char *const left[] = { "1.exr", "2.exr", "3.exr", "a.exr", "b.exr", "c.exr" };

    need(mkdtemp(folder) != NULL, "no temporary folder");
    test_threads(PE_METHOD_REPRESENTATIVE, PE_ACCURACY_EXACT);
    test_threads(PE_METHOD_REPRESENTATIVE, PE_ACCURACY_FAST);
    test_threads(PE_METHOD_BASELINE, PE_ACCURACY_EXACT);
    for (int height = 2; height <= 20; height += 18) {
        test_round_trip(PE_METHOD_BASELINE, PE_PIXEL_HALF, height);
        test_round_trip(PE_METHOD_REPRESENTATIVE, PE_PIXEL_FLOAT, height);
        test_round_trip(PE_METHOD_REPRESENTATIVE, PE_PIXEL_HALF, height);
    }
    test_damage();
    test_wrong_files();
    test_options();
    test_nan();
    test_modes_and_links();
    test_bright();
    for (int k = 0; k < 6; k++)
        unlink(in_folder(left[k]));
    rmdir(folder);
    return done_testing();
}
