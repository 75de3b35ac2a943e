/* env.c - lat-long environments: load and repair, direction to texel and back, bilinear lookup. */
#include "env.h"

#include "image.h"
#include "status.h"
#include "vector.h"

#include <float.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- directions ---- */

void pe_latlong_direction(double u, double v, double direction[3])
{
    double phi = 2 * M_PI * u, theta = M_PI * v;

    direction[0] = sin(theta) * cos(phi);
    direction[1] = cos(theta);
    direction[2] = sin(theta) * sin(phi);
}

void pe_latlong_coordinates(const double direction[3], double *u, double *v)
{
    double turn = atan2(direction[2], direction[0]) / (2 * M_PI);
    /* atan2 keeps its accuracy at the poles, where acos(y) loses half its digits. */
    double fall = atan2(hypot(direction[0], direction[2]), direction[1]) / M_PI;

    turn = turn < 0 ? turn + 1 : turn;
    /* -1e-17 + 1 is 1; and a direction that is not a number must not become an index that is none. */
    *u = turn < 1 ? turn : 0;
    *v = fall >= 0 ? fall : 0;
}

pe_status pe_grid_make(int width, int height, pe_grid *grid, pe_error *error)
{
    size_t w = (size_t)width, h = (size_t)height;
    double *values = malloc((3 * h + 2 * w) * sizeof *values);

    if (!values)
        return pe_fail_memory(error, "a table of directions");
    *grid = (pe_grid){ width, height, values, values + h, values + 2 * h, values + 2 * h + w, values + 2 * h + 2 * w };
    for (int y = 0; y < height; y++) {
        double theta = M_PI * (y + 0.5) / height;

        grid->sin_theta[y] = sin(theta);
        grid->cos_theta[y] = cos(theta);
        grid->solid_angle_sr[y] = 2 * M_PI / width * (cos(M_PI * y / height) - cos(M_PI * (y + 1) / height));
    }
    for (int x = 0; x < width; x++) {
        double phi = 2 * M_PI * (x + 0.5) / width;

        grid->sin_phi[x] = sin(phi);
        grid->cos_phi[x] = cos(phi);
    }
    return PE_OK;
}

void pe_grid_free(pe_grid *grid)
{
    free(grid->sin_theta); /* one block, made by pe_grid_make */
    *grid = (pe_grid){ 0 };
}

/* ---- loading ---- */

/* Is it a radiance, or at least below 0 and of a size? */
static bool is_sound(float value)
{
    return isfinite(value) && value <= PE_RADIANCE_MAX;
}

/* The brightest sound value of each channel: what a greater one becomes. */
static void find_brightest(const float *rgb, size_t texels, float brightest[3])
{
    memset(brightest, 0, 3 * sizeof *brightest);
    for (size_t texel = 0; texel < texels; texel++)
        for (int c = 0; c < 3; c++)
            if (is_sound(rgb[3 * texel + (size_t)c]) && rgb[3 * texel + (size_t)c] > brightest[c])
                brightest[c] = rgb[3 * texel + (size_t)c];
}

/* What was found: texels repaired, those of them that are no radiance at all, and the sum of values above 0 and that of
 * what those below 0 fall short of it. */
typedef struct repairs {
    size_t texels, unsound;
    double light, missing;
} repairs;

static void repair_texel(float *texel, const float brightest[3], repairs *found)
{
    bool unsound = false, negative = false;

    for (int c = 0; c < 3; c++) {
        float value = texel[c];

        if (!is_sound(value))
            texel[c] = value > 0 ? brightest[c] : 0;
        else if (value < 0)
            texel[c] = 0;
        unsound |= !is_sound(value);
        negative |= value < 0;
        if (is_sound(value))
            *(value < 0 ? &found->missing : &found->light) += fabs((double)value);
    }
    found->unsound += unsound;
    found->texels += unsound || negative;
}

/* Are all values at least `least`, and radiances?  Nearly always, so that it is asked first, without branches. */
static bool are_above(float least, const float *rgb, size_t texels)
{
    int is_wrong = 0;

    for (size_t k = 0; k < 3 * texels; k++)
        is_wrong |= !(rgb[k] >= least) | !(rgb[k] <= PE_RADIANCE_MAX);
    return !is_wrong;
}

static repairs repair(float *rgb, size_t texels)
{
    repairs found = { 0 };
    float brightest[3] = { 0, 0, 0 };

    if (are_above(0, rgb, texels))
        return found;
    if (!are_above(-FLT_MAX, rgb, texels))
        find_brightest(rgb, texels, brightest);
    for (size_t texel = 0; texel < texels; texel++)
        repair_texel(rgb + 3 * texel, brightest, &found);
    return found;
}

static void add_remark(pe_env *env, const char *sentence)
{
    size_t used = strlen(env->remark);

    snprintf(env->remark + used, sizeof env->remark - used, "%s%s", used ? "; " : "", sentence);
}

/* Negative texels are what resampling leaves beside a lamp, and no harm, as long as they are dim. */
#define MISSING_MAX 0.001

static void remark_repairs(pe_env *env, const repairs *found)
{
    char sentence[128];

    if (found->unsound) {
        snprintf(sentence, sizeof sentence, "%zu of %zu texels, NaN, infinite or above %g, %s repaired", found->unsound,
                 (size_t)env->width * (size_t)env->height, (double)PE_RADIANCE_MAX,
                 found->unsound == 1 ? "was" : "were");
        add_remark(env, sentence);
    }
    if (found->missing > MISSING_MAX * found->light) {
        snprintf(sentence, sizeof sentence, "%.2g %% of its light is negative and was left out",
                 100 * found->missing / (found->light + found->missing));
        add_remark(env, sentence);
    }
}

/* Takes the picture's texels over. */
static pe_status make_env(pe_image *image, const char *name, pe_env **out, pe_error *error)
{
    pe_env *env = calloc(1, sizeof *env);
    pe_status status;
    repairs found;

    if (!env)
        return pe_fail_memory(error, "an environment");
    env->name = strdup(name);
    status = env->name ? pe_grid_make(image->width, image->height, &env->grid, error) : pe_fail_memory(error, "a name");
    if (status != PE_OK) {
        pe_env_free(env);
        return status;
    }
    env->width = image->width;
    env->height = image->height;
    env->rgb = image->rgb;
    image->rgb = NULL;
    found = repair(env->rgb, (size_t)env->width * (size_t)env->height);
    env->repairs = found.texels;
    remark_repairs(env, &found);
    *out = env;
    return PE_OK;
}

static pe_status take_image(pe_status status, pe_image *image, const char *name, pe_env **env, pe_error *error)
{
    if (status == PE_OK)
        status = make_env(image, name, env, error);
    pe_image_free(image);
    return status;
}

/* Neither keeps anybody from using the picture, and both give results that look wrong for no visible reason. */
static void remark_file(pe_env *env, bool is_png)
{
    char shape[128];

    if (env->width != 2 * env->height) {
        snprintf(shape, sizeof shape, "%d x %d texels are not twice as wide as high, as a whole sphere is", env->width,
                 env->height);
        add_remark(env, shape);
    }
    if (is_png)
        add_remark(env, "a PNG holds no light brighter than white, so suns and lamps are lost; "
                        "OpenEXR or Radiance HDR keep them");
}

pe_status pe_env_read(const char *path, pe_env **env, pe_error *error)
{
    unsigned char *bytes;
    size_t size;
    pe_status status = pe_file_read(path, &bytes, &size, error);

    if (status != PE_OK)
        return status;
    status = pe_env_read_memory(bytes, size, path, env, error);
    free(bytes);
    return status;
}

pe_status pe_env_read_memory(const void *bytes, size_t size, const char *name, pe_env **env, pe_error *error)
{
    pe_image image = { 0 };
    pe_status status =
        take_image(pe_image_read_memory(bytes, size, name, &image, error), &image, pe_base_name(name), env, error);

    if (status == PE_OK)
        remark_file(*env, pe_png_detect(bytes, size));
    return status;
}

pe_status pe_env_create(int width, int height, const float *rgb, pe_env **env, pe_error *error)
{
    pe_image image = { 0 };
    pe_status status;

    if (width < 1 || height < 1)
        return pe_fail(error, PE_ERROR_ARGUMENT, "an environment of %d x %d texels has none", width, height);
    status = pe_image_allocate("environment", width, height, false, &image, error);
    if (status == PE_OK)
        memcpy(image.rgb, rgb, 3 * sizeof *rgb * (size_t)width * (size_t)height);
    return take_image(status, &image, "", env, error);
}

void pe_env_free(pe_env *env)
{
    if (!env)
        return;
    pe_grid_free(&env->grid);
    free(env->name);
    free(env->rgb);
    free(env);
}

int pe_env_width(const pe_env *env)
{
    return env->width;
}

int pe_env_height(const pe_env *env)
{
    return env->height;
}

const float *pe_env_texels(const pe_env *env)
{
    return env->rgb;
}

const char *pe_env_name(const pe_env *env)
{
    return env->name;
}

size_t pe_env_repairs(const pe_env *env)
{
    return env->repairs;
}

const char *pe_env_remark(const pe_env *env)
{
    return env->remark;
}

/* ---- lookup ---- */

static int clamp_index(double position, int count)
{
    return position <= 0 ? 0 : position >= count - 1 ? count - 1 : (int)position;
}

const float *pe_env_texel(const pe_env *env, const double direction[3])
{
    double u, v;

    pe_latlong_coordinates(direction, &u, &v);
    return env->rgb + 3 * ((size_t)clamp_index(v * env->height, env->height) * (size_t)env->width +
                           (size_t)clamp_index(u * env->width, env->width));
}

/* Two taps of row y, `x` texels from u = 0 (texel centres at whole numbers), sharing `share`. */
static void row_taps(int width, double x, int y, double share, pe_tap taps[2])
{
    double left = floor(x), right_part = x - left;
    int column = (int)left % width;

    column += column < 0 ? width : 0;
    taps[0] = (pe_tap){ column, y, share * (1 - right_part) };
    taps[1] = (pe_tap){ column + 1 < width ? column + 1 : 0, y, share * right_part };
}

void pe_latlong_taps(int width, int height, double u, double v, pe_tap taps[4])
{
    double x = u * width - 0.5, y = v * height - 0.5;
    double above = floor(y), lower_part = y - above;
    int row = (int)above;
    double half_turn = 0.5 * width;

    if (row < 0)
        row_taps(width, x + half_turn, 0, 1 - lower_part, taps);
    else
        row_taps(width, x, row, 1 - lower_part, taps);
    if (row + 1 >= height)
        row_taps(width, x + half_turn, height - 1, lower_part, taps + 2);
    else
        row_taps(width, x, row + 1, lower_part, taps + 2);
}

void pe_env_lookup(const pe_env *env, const double direction[3], double rgb[3])
{
    pe_tap taps[4];
    double u, v;

    pe_latlong_coordinates(direction, &u, &v);
    pe_latlong_taps(env->width, env->height, u, v, taps);
    for (int c = 0; c < 3; c++) {
        rgb[c] = 0;
        for (int k = 0; k < 4; k++)
            rgb[c] += taps[k].share *
                      (double)env->rgb[3 * ((size_t)taps[k].y * (size_t)env->width + (size_t)taps[k].x) + (size_t)c];
    }
}

/* FNV-1a [FNV] over the sizes and the bits of the texels, 32 of them at a time. */
unsigned long long pe_env_fingerprint(const pe_env *env)
{
    const uint64_t prime = 0x100000001b3;
    uint64_t hash = 0xcbf29ce484222325;
    const uint32_t size[2] = { (uint32_t)env->width, (uint32_t)env->height };

    for (int k = 0; k < 2; k++)
        hash = (hash ^ size[k]) * prime;
    for (size_t k = 0; k < 3 * (size_t)env->width * (size_t)env->height; k++) {
        uint32_t bits;

        memcpy(&bits, &env->rgb[k], sizeof bits);
        hash = (hash ^ bits) * prime;
    }
    return hash ? hash : 1;
}

void pe_env_mean(const pe_env *env, double rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int y = 0; y < env->height; y++)
        for (int x = 0; x < env->width; x++)
            for (int c = 0; c < 3; c++)
                rgb[c] += env->grid.solid_angle_sr[y] / (4 * M_PI) *
                          (double)env->rgb[3 * ((size_t)y * (size_t)env->width + (size_t)x) + (size_t)c];
}
