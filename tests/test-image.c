/* test-image.c - claims: of a picture that cannot be read nothing is left behind, wherever it is cut off; a small PNG
 * claims no large memory; an opacity is clipped. */
#include "prefenv.h"
#include "reference.h"
#include "tap.h"

#include <math.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

enum { FILE_MAX = 4096 };

typedef struct file {
    unsigned char bytes[FILE_MAX];
    size_t size;
} file;

static void put(file *f, const void *bytes, size_t size)
{
    need(f->size + size <= FILE_MAX, "the file is too large");
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

static void put_attribute(file *f, const char *name, const char *type, const void *value, int size)
{
    put(f, name, strlen(name) + 1);
    put(f, type, strlen(type) + 1);
    put(f, &size, 4);
    put(f, value, (size_t)size);
}

/* ---- files ---- */

enum { WIDTH = 4, HEIGHT = 2 };

static const float alphas[WIDTH] = { 5, -3, 0.25f, NAN };

/* Uncompressed floats: A as above in all rows, and R, G and B of 1. */
static file make_exr(void)
{
    static const unsigned char start[8] = { 0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0 }, zeros[8] = { 0 };
    static const int window[4] = { 0, 0, WIDTH - 1, HEIGHT - 1 }, channel[4] = { 2, 0, 1, 1 };
    static const float one = 1, corner[2] = { 0, 0 };
    const int row_bytes = 4 * WIDTH * 4;
    unsigned char channels[4 * 18 + 1] = { 0 };
    file f = { .size = 0 };

    for (int k = 0; k < 4; k++) {
        channels[18 * k] = (unsigned char)"ABGR"[k];
        memcpy(channels + 18 * k + 2, channel, 16);
    }
    put(&f, start, sizeof start);
    put_attribute(&f, "channels", "chlist", channels, sizeof channels);
    put_attribute(&f, "compression", "compression", zeros, 1);
    put_attribute(&f, "dataWindow", "box2i", window, 16);
    put_attribute(&f, "displayWindow", "box2i", window, 16);
    put_attribute(&f, "lineOrder", "lineOrder", zeros, 1);
    put_attribute(&f, "pixelAspectRatio", "float", &one, 4);
    put_attribute(&f, "screenWindowCenter", "v2f", corner, 8);
    put_attribute(&f, "screenWindowWidth", "float", &one, 4);
    put(&f, zeros, 1);
    for (int y = 0; y < HEIGHT; y++) {
        size_t offset = f.size + 8 * (size_t)(HEIGHT - y) + (size_t)y * (8 + (size_t)row_bytes);

        put(&f, &offset, 8);
    }
    for (int y = 0; y < HEIGHT; y++) {
        put(&f, &y, 4);
        put(&f, &row_bytes, 4);
        put(&f, alphas, sizeof alphas);
        for (int k = 0; k < 3 * WIDTH; k++)
            put(&f, &one, 4);
    }
    return f;
}

static file make_hdr(void)
{
    static const char header[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
    static const unsigned char texel[4] = { 128, 64, 32, 129 };
    file f = { .size = 0 };

    put(&f, header, sizeof header - 1);
    for (int k = 0; k < WIDTH * HEIGHT; k++)
        put(&f, texel, 4);
    return f;
}

static file make_png(void)
{
    char path[] = "/tmp/prefenv-test-image-XXXXXX";
    pe_image image = { 8, 8, reference_noise(8, 8, 1), NULL };
    file f = { .size = 0 };
    FILE *stream;

    close(mkstemp(path));
    need(pe_image_write_png(path, &image, NULL) == PE_OK, "no PNG");
    stream = fopen(path, "rb");
    f.size = stream ? fread(f.bytes, 1, sizeof f.bytes, stream) : 0;
    if (stream)
        fclose(stream);
    need(f.size > 0, "the PNG has no bytes");
    unlink(path);
    pe_image_free(&image);
    return f;
}

/* ---- claims ---- */

/* Of all that is cut off, some must be refused, and leave the picture that was there. */
static void leaves_nothing(const char *name, file f)
{
    float kept = 7;
    int refused = 0, changed = 0;

    for (size_t size = 0; size < f.size; size++) {
        pe_image image = { 3, 5, &kept, NULL };

        if (pe_image_read_memory(f.bytes, size, name, &image, NULL) == PE_OK) {
            pe_image_free(&image);
            continue;
        }
        refused++;
        changed += image.width != 3 || image.height != 5 || image.rgb != &kept || image.alpha;
    }
    ok(refused > 0 && changed == 0, "%s cut off: refused %d times, and %d times the picture has changed", name, refused,
       changed);
}

static void clips_alpha(void)
{
    file f = make_exr();
    pe_image image;
    pe_error error;

    need(pe_image_read_memory(f.bytes, f.size, "alpha.exr", &image, &error) == PE_OK && image.alpha, "%s",
         error.message);
    ok(image.alpha[0] == 1 && image.alpha[1] == 0 && image.alpha[2] == 0.25f && image.alpha[3] == 0,
       "opacities of 5, -3, 0.25 and NaN are %g, %g, %g and %g", (double)image.alpha[0], (double)image.alpha[1],
       (double)image.alpha[2], (double)image.alpha[3]);
    pe_image_free(&image);
}

static long peak_megabytes(void)
{
    struct rusage usage;

    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

/* A texel wide and 2^27 high: of 68 bytes. */
static void claims_no_memory(void)
{
    static const unsigned char tall[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
        0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x08, 0x02, 0x00, 0x00, 0x00, 0xe0, 0xf3, 0x22, 0x63, 0x00,
        0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x80, 0x00, 0x00, 0x00, 0x08, 0x00,
        0x01, 0xb7, 0x58, 0x73, 0x95, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82,
    };
    long before = peak_megabytes(), more;
    pe_image image;
    pe_error error = { PE_OK, "" };
    pe_status status = pe_image_read_memory(tall, sizeof tall, "tall.png", &image, &error);

    more = peak_megabytes() - before;
    ok(status == PE_ERROR_FORMAT && strstr(error.message, "1 x 134217728"), "refused: %s", error.message);
    ok(more < 200, "... and it took %ld MB", more);
}

int main(void)
{
    leaves_nothing("EXR", make_exr());
    leaves_nothing("HDR", make_hdr());
    leaves_nothing("PNG", make_png());
    clips_alpha();
    claims_no_memory();
    return done_testing();
}
