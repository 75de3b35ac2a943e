/* maps_file.c - maps as an OpenEXR file: pictures, and header attributes that say all there is to know.
 *
 * Hemispheres: one part for each brush angle, "angle.00" and so on, with the hemispheres of all normals side by side,
 * row by row: an atlas.  Lat-long maps: part "normal.00" holds the pair n_0, -n_0 and so on, with attribute
 * prefenv:normal; a baseline file has the one part "baseline".  Layers: part "layer.00" is the smoothest, each lat-long
 * and with attribute prefenv:exponent.  Voxels: one part "voxels", the slices of the cube side by side, row by row.
 *
 * Attributes of the first part: prefenv:version, :method,
 * :weight, :eta, :k, :ndf, :ndfName, :alphaX, :alphaY, :direction, :normals, :source, :sourceWidth, :sourceHeight,
 * :accuracy, :errorEstimate, :errorWanted (which may be missing); of hemispheres :angles, :width, :height,
 * :lookupError, :poleAngles, :poleCosine, :suns, :turn (the degrees that the angles divide), and for each sun
 * :sun.00.direction and :sun.00.power; of layers and voxels :size, :window, :levels, :lookupError, :width, :threshold
 * and :lost. */
#include "atlas.h"
#include "exr.h"
#include "maps.h"
#include "status.h"
#include "vector.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const method_names[] = PE_METHOD_NAMES;
static const char *const lost_names[] = { "spread", "dark" };
static const char *const accuracy_names[] = { "auto", "exact", "fast" };
static const char *const weight_names[] = { "ndf", "microfacet" };
static const char *const ndf_names[] = PE_NDF_NAMES;

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))
#define PART_NAME_MAX 32
#define ATTRIBUTES 17
#define HEMISPHERE_ATTRIBUTES 8
#define ROUGHNESS_ATTRIBUTES 7
#define SUN_NAME_MAX 40

/* ---- write ---- */

static pe_attribute integer(const char *name, int value)
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_INT, .integer = value };
}

static pe_attribute number(const char *name, double value)
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_DOUBLE, .number = value };
}

static pe_attribute vector(const char *name, const double v[3])
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_VECTOR, .vector = { v[0], v[1], v[2] } };
}

static pe_attribute string(const char *name, const char *value)
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_STRING, .string = value };
}

static void describe(const pe_maps_info *info, pe_attribute out[ATTRIBUTES])
{
    const pe_attribute all[ATTRIBUTES] = {
        integer("prefenv:version", PE_MAPS_FORMAT_VERSION),
        string("prefenv:method", method_names[info->method]),
        string("prefenv:weight", weight_names[info->surface.weight]),
        vector("prefenv:eta", info->surface.eta),
        vector("prefenv:k", info->surface.k),
        string("prefenv:ndf", ndf_names[info->surface.ndf.kind]),
        string("prefenv:ndfName", info->ndf_name),
        number("prefenv:alphaX", info->surface.ndf.alpha_x),
        number("prefenv:alphaY", info->surface.ndf.alpha_y),
        vector("prefenv:direction", info->direction),
        integer("prefenv:normals", info->normals),
        string("prefenv:source", info->source_name),
        integer("prefenv:sourceWidth", info->source_width),
        integer("prefenv:sourceHeight", info->source_height),
        string("prefenv:accuracy", accuracy_names[info->accuracy]),
        number("prefenv:errorEstimate", info->error_estimate),
        number("prefenv:errorWanted", info->error_wanted),
    };

    memcpy(out, all, sizeof all);
}

static int turn_of(const pe_maps_info *info)
{
    return (int)nearbyint(pe_maps_turn(info) * 180 / M_PI);
}

static void describe_hemispheres(const pe_maps_info *info, pe_attribute out[HEMISPHERE_ATTRIBUTES])
{
    const pe_attribute all[HEMISPHERE_ATTRIBUTES] = {
        integer("prefenv:angles", info->angles),
        integer("prefenv:width", info->width),
        integer("prefenv:height", info->height),
        number("prefenv:lookupError", info->lookup_error),
        integer("prefenv:suns", info->suns),
        integer("prefenv:turn", turn_of(info)),
        integer("prefenv:poleAngles", info->pole_angles),
        number("prefenv:poleCosine", info->pole_cosine),
    };

    memcpy(out, all, sizeof all);
}

static void describe_roughness(const pe_maps_info *info, pe_attribute out[ROUGHNESS_ATTRIBUTES])
{
    const pe_attribute all[ROUGHNESS_ATTRIBUTES] = {
        integer("prefenv:size", info->smoothness.size),
        number("prefenv:window", info->smoothness.window),
        number("prefenv:levels", info->smoothness.levels),
        number("prefenv:lookupError", info->lookup_error),
        integer("prefenv:width", info->width),
        number("prefenv:threshold", info->threshold),
        string("prefenv:lost", lost_names[info->lost]),
    };

    memcpy(out, all, sizeof all);
}

/* Everything a part needs while it is being written. */
typedef struct part_room {
    char name[PART_NAME_MAX];
    pe_attribute attributes[ATTRIBUTES + HEMISPHERE_ATTRIBUTES + ROUGHNESS_ATTRIBUTES + 2 * PE_SUNS_MAX];
    char sun_names[2 * PE_SUNS_MAX][SUN_NAME_MAX];
} part_room;

static void name_sun(int sun, const char *what, char name[SUN_NAME_MAX])
{
    snprintf(name, SUN_NAME_MAX, "prefenv:sun.%02d.%s", sun, what);
}

static size_t describe_suns(const pe_suns *suns, part_room *room, pe_attribute *out)
{
    for (int k = 0; k < suns->count; k++) {
        name_sun(k, "direction", room->sun_names[2 * k]);
        name_sun(k, "power", room->sun_names[2 * k + 1]);
        out[2 * k] = vector(room->sun_names[2 * k], suns->direction[k]);
        out[2 * k + 1] = vector(room->sun_names[2 * k + 1], suns->power[k]);
    }
    return 2 * (size_t)suns->count;
}

/* Several images of one size are one part, side by side. */
static int has_atlas(const pe_maps_info *info)
{
    return info->method == PE_METHOD_HEMISPHERES || info->method == PE_METHOD_VOXELS;
}

static int parts_of(const pe_maps_info *info)
{
    return has_atlas(info) ? info->angles : info->images;
}

static void name_part(const pe_maps_info *info, int k, char name[PART_NAME_MAX])
{
    static const char *const names[] = { "", "angle", "normal", "baseline", "layer", "voxels" };
    int digits = snprintf(NULL, 0, "%d", parts_of(info) - 1);

    if (info->method == PE_METHOD_BASELINE || info->method == PE_METHOD_VOXELS)
        snprintf(name, PART_NAME_MAX, "%s", names[info->method]);
    else
        snprintf(name, PART_NAME_MAX, "%s.%0*d", names[info->method], digits > 2 ? digits : 2, k);
}

static void fill_part(const pe_maps *maps, int k, part_room *room, pe_exr_part *part)
{
    size_t count = 0;
    double n[3];

    name_part(&maps->info, k, room->name);
    if (maps->info.method == PE_METHOD_REPRESENTATIVE) {
        pe_maps_normal(maps, k, n);
        room->attributes[count++] = vector("prefenv:normal", n);
    }
    if (maps->info.method == PE_METHOD_LAYERS)
        room->attributes[count++] = number("prefenv:exponent", pe_maps_image_exponent(maps, k));
    if (k == 0) {
        describe(&maps->info, room->attributes + count);
        count += ATTRIBUTES;
    }
    if (k == 0 && maps->info.method == PE_METHOD_HEMISPHERES) {
        describe_hemispheres(&maps->info, room->attributes + count);
        count += HEMISPHERE_ATTRIBUTES;
        count += describe_suns(&maps->suns, room, room->attributes + count);
    }
    if (k == 0 && pe_method_has_roughness(maps->info.method)) {
        describe_roughness(&maps->info, room->attributes + count);
        count += ROUGHNESS_ATTRIBUTES;
    }
    part->name = room->name;
    part->attributes = room->attributes;
    part->attribute_count = count;
}

static pe_status check_half_range(const pe_maps *maps, const char *path, pe_error *error)
{
    const float largest_half = 65504;
    size_t values = pe_maps_values(maps);
    float largest = 0;
    int is_over = 0;

    for (size_t k = 0; k < values; k++)
        is_over |= maps->rgb[k] > largest_half;
    if (!is_over)
        return PE_OK;
    for (size_t k = 0; k < values; k++)
        largest = fmaxf(largest, maps->rgb[k]);
    return pe_fail(error, PE_ERROR_LIMIT,
                   "%s: a radiance of %g is more than the 65504 a half float holds; write floats (--float)", path,
                   (double)largest);
}

static pe_atlas atlas_of(const pe_maps_info *info)
{
    return pe_atlas_of(info->images / info->angles, info->width, info->height);
}

static size_t atlas_values(const pe_atlas *atlas)
{
    return 3 * (size_t)atlas->width * (size_t)atlas->height;
}

/* The atlases of all parts, one after the other: in image k lies the tile k / angles of part k % angles. */
static float *make_atlases(const pe_maps *maps, const pe_atlas *atlas)
{
    int angles = maps->info.angles;
    float *pictures = calloc((size_t)angles * atlas_values(atlas), sizeof *pictures);

    for (int k = 0; pictures && k < maps->info.images; k++)
        pe_atlas_insert(atlas, k / angles, pe_maps_image(maps, k),
                        pictures + (size_t)(k % angles) * atlas_values(atlas));
    return pictures;
}

/* Gives the parts their pictures; *own is to be freed. */
static pe_status add_pictures(const pe_maps *maps, pe_exr_part *parts, float **own, pe_error *error)
{
    pe_atlas atlas = atlas_of(&maps->info);

    *own = NULL;
    for (int k = 0; k < parts_of(&maps->info) && !has_atlas(&maps->info); k++) {
        parts[k].rgb = pe_maps_image(maps, k);
        pe_maps_image_size(maps, k, &parts[k].width, &parts[k].height);
    }
    if (!has_atlas(&maps->info))
        return PE_OK;
    *own = make_atlases(maps, &atlas);
    if (!*own)
        return pe_fail_memory(error, "an atlas of maps");
    for (int k = 0; k < parts_of(&maps->info); k++) {
        parts[k].rgb = *own + (size_t)k * atlas_values(&atlas);
        parts[k].width = atlas.width;
        parts[k].height = atlas.height;
    }
    return PE_OK;
}

static pe_status encode(const pe_maps *maps, pe_pixel_type type, unsigned char **bytes, size_t *size, pe_error *error)
{
    int count = parts_of(&maps->info);
    part_room *rooms = calloc((size_t)count, sizeof *rooms);
    pe_exr_part *parts = calloc((size_t)count, sizeof *parts);
    float *own = NULL;
    pe_status status = PE_OK;

    if (!rooms || !parts)
        status = pe_fail_memory(error, "the parts of a maps file");
    for (int k = 0; rooms && parts && k < count; k++)
        fill_part(maps, k, &rooms[k], &parts[k]);
    if (status == PE_OK)
        status = add_pictures(maps, parts, &own, error);
    if (status == PE_OK)
        status = pe_exr_encode(parts, count, type, bytes, size, error);
    free(own);
    free(parts);
    free(rooms);
    return status;
}

pe_status pe_maps_write(const pe_maps *maps, const char *path, pe_pixel_type type, pe_error *error)
{
    unsigned char *bytes;
    size_t size;
    pe_status status = type == PE_PIXEL_HALF ? check_half_range(maps, path, error) : PE_OK;

    if (status == PE_OK)
        status = encode(maps, type, &bytes, &size, error);
    if (status != PE_OK)
        return status;
    status = pe_file_write(path, bytes, size, error);
    free(bytes);
    return status;
}

/* ---- read ---- */

/* Where attributes are read from, and whom to tell if one is missing. */
typedef struct header {
    const pe_exr_file *file;
    const char *name;
    pe_error *error;
} header;

static pe_status missing(const header *from, const char *attribute)
{
    return pe_fail(from->error, PE_ERROR_FORMAT, "%s: has no attribute %s; is it a file that prefenv bake wrote?",
                   from->name, attribute);
}

static pe_status get_integer(const header *from, const char *name, int *value)
{
    pe_attribute a = integer(name, 0);

    if (!pe_exr_get_attribute(from->file, 0, &a))
        return missing(from, name);
    *value = a.integer;
    return PE_OK;
}

static pe_status get_number(const header *from, const char *name, double *value)
{
    pe_attribute a = number(name, 0);

    if (!pe_exr_get_attribute(from->file, 0, &a))
        return missing(from, name);
    if (!isfinite(a.number))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: attribute %s is not a finite number", from->name, name);
    *value = a.number;
    return PE_OK;
}

static pe_status get_vector(const header *from, int part, const char *name, double value[3])
{
    static const double zero[3] = { 0, 0, 0 };
    pe_attribute a = vector(name, zero);

    if (!pe_exr_get_attribute(from->file, part, &a))
        return missing(from, name);
    memcpy(value, a.vector, sizeof a.vector);
    return PE_OK;
}

#define SHOWN_BYTES 41

/* The first characters of a text that may hold anything, fit for one line. */
static void show(const char *text, char shown[SHOWN_BYTES])
{
    int k = 0;

    for (; k < SHOWN_BYTES - 1 && text[k]; k++)
        shown[k] = (char)(text[k] >= 0 && text[k] < ' ' ? '?' : text[k]);
    shown[k] = '\0';
}

/* The index of a string attribute among `names`. */
static pe_status get_choice(const header *from, const char *name, const char *const *names, int count, int *value)
{
    pe_attribute a = string(name, NULL);
    char shown[SHOWN_BYTES];

    if (!pe_exr_get_attribute(from->file, 0, &a))
        return missing(from, name);
    for (*value = 0; *value < count; ++*value)
        if (strcmp(a.string, names[*value]) == 0)
            return PE_OK;
    show(a.string, shown);
    return pe_fail(from->error, PE_ERROR_FORMAT, "%s: %s '%s' is not known to this version of prefenv", from->name,
                   name, shown);
}

static pe_status read_version(const header *from, int *out)
{
    int version = 0;
    pe_status status = get_integer(from, "prefenv:version", &version);

    if (status == PE_OK && (version < PE_MAPS_FORMAT_VERSION_MIN || version > PE_MAPS_FORMAT_VERSION))
        return pe_fail(from->error, PE_ERROR_FORMAT,
                       "%s: format version %d is not one of the %d to %d read here; bake it again", from->name, version,
                       PE_MAPS_FORMAT_VERSION_MIN, PE_MAPS_FORMAT_VERSION);
    *out = version;
    return status;
}

/* Runs its call only if all before it went well. */
#define AND_THEN(call) \
    if (status == PE_OK) \
        status = (call);

/* Files of tables from before there was this attribute divide half a turn, which they are not the same after. */
static pe_status check_turn(const header *from, const pe_maps_info *info)
{
    int turn = 180;
    pe_attribute a = integer("prefenv:turn", 0);

    if (pe_exr_get_attribute(from->file, 0, &a))
        turn = a.integer;
    if (info->angles == 1 || turn == turn_of(info))
        return PE_OK;
    return pe_fail(from->error, PE_ERROR_FORMAT,
                   "%s: its %d angles divide %d degrees where %d are read here; bake it again", from->name,
                   info->angles, turn, turn_of(info));
}

/* What hemispheres have besides. */
static pe_status read_hemispheres_info(const header *from, pe_maps_info *info)
{
    pe_attribute poles = integer("prefenv:poleAngles", 0);
    pe_status status = PE_OK;

    info->angles = 1;
    if (info->method != PE_METHOD_HEMISPHERES)
        return PE_OK;
    AND_THEN(get_integer(from, "prefenv:angles", &info->angles))
    AND_THEN(get_integer(from, "prefenv:width", &info->width))
    AND_THEN(get_integer(from, "prefenv:height", &info->height))
    AND_THEN(get_number(from, "prefenv:lookupError", &info->lookup_error))
    if (pe_exr_get_attribute(from->file, 0, &poles))
        info->pole_angles = poles.integer;
    if (info->pole_angles)
        AND_THEN(get_number(from, "prefenv:poleCosine", &info->pole_cosine))
    AND_THEN(get_integer(from, "prefenv:suns", &info->suns))
    AND_THEN(check_turn(from, info))
    if (status == PE_OK && info->suns && !pe_suns_possible(&info->surface))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: has suns, which maps of its ndf cannot have", from->name);
    if (status == PE_OK && (info->suns < 0 || info->suns > PE_SUNS_MAX))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: prefenv:suns %d is out of range; at most %d can be",
                       from->name, info->suns, PE_SUNS_MAX);
    return status;
}

/* What layers and voxels have besides. */
static pe_status read_roughness_info(const header *from, pe_maps_info *info)
{
    int lost = 0;
    pe_status status = PE_OK;

    if (!pe_method_has_roughness(info->method))
        return PE_OK;
    AND_THEN(get_integer(from, "prefenv:size", &info->smoothness.size))
    AND_THEN(get_number(from, "prefenv:window", &info->smoothness.window))
    AND_THEN(get_number(from, "prefenv:levels", &info->smoothness.levels))
    AND_THEN(get_number(from, "prefenv:lookupError", &info->lookup_error))
    AND_THEN(get_integer(from, "prefenv:width", &info->width))
    AND_THEN(get_number(from, "prefenv:threshold", &info->threshold))
    AND_THEN(get_choice(from, "prefenv:lost", lost_names, COUNT(lost_names), &lost))
    info->lost = (pe_lost_weight)lost;
    info->height = info->method == PE_METHOD_LAYERS ? info->width / 2 : info->width;
    info->images = info->method == PE_METHOD_LAYERS ? pe_exr_part_count(from->file) : info->smoothness.size;
    return status;
}

static pe_status read_sun(const header *from, int k, pe_suns *suns)
{
    char name[SUN_NAME_MAX];
    double direction[3], power[3];
    pe_status status;

    name_sun(k, "direction", name);
    status = get_vector(from, 0, name, direction);
    if (status == PE_OK && !(fabs(pe_dot(direction, direction) - 1) < 1e-6))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: %s is not of length 1", from->name, name);
    name_sun(k, "power", name);
    AND_THEN(get_vector(from, 0, name, power))
    for (int c = 0; status == PE_OK && c < 3; c++)
        if (!(power[c] >= 0 && power[c] <= 4 * M_PI * (double)PE_RADIANCE_MAX))
            return pe_fail(from->error, PE_ERROR_FORMAT, "%s: %s is not a radiance times solid angle", from->name,
                           name);
    if (status == PE_OK)
        pe_suns_add_sun(suns, direction, power);
    return status;
}

static pe_status read_info(const header *from, pe_maps_info *info)
{
    pe_attribute source = string("prefenv:source", ""), ndf_name = string("prefenv:ndfName", "");
    pe_attribute wanted = number("prefenv:errorWanted", 0);
    int method = 0, weight = 0, kind = 0, accuracy = 0;
    pe_status status;

    *info = (pe_maps_info){ .format_version = 0 };
    status = read_version(from, &info->format_version);
    AND_THEN(get_choice(from, "prefenv:method", method_names, COUNT(method_names), &method))
    AND_THEN(get_choice(from, "prefenv:weight", weight_names, COUNT(weight_names), &weight))
    AND_THEN(get_vector(from, 0, "prefenv:eta", info->surface.eta))
    AND_THEN(get_vector(from, 0, "prefenv:k", info->surface.k))
    AND_THEN(get_choice(from, "prefenv:ndf", ndf_names, COUNT(ndf_names), &kind))
    AND_THEN(get_number(from, "prefenv:alphaX", &info->surface.ndf.alpha_x))
    AND_THEN(get_number(from, "prefenv:alphaY", &info->surface.ndf.alpha_y))
    AND_THEN(get_vector(from, 0, "prefenv:direction", info->direction))
    AND_THEN(get_integer(from, "prefenv:normals", &info->normals))
    AND_THEN(get_integer(from, "prefenv:sourceWidth", &info->source_width))
    AND_THEN(get_integer(from, "prefenv:sourceHeight", &info->source_height))
    AND_THEN(get_choice(from, "prefenv:accuracy", accuracy_names, COUNT(accuracy_names), &accuracy))
    AND_THEN(get_number(from, "prefenv:errorEstimate", &info->error_estimate))
    if (status != PE_OK)
        return status;
    info->method = (pe_method)method;
    info->surface.weight = (pe_weight)weight;
    info->surface.ndf.kind = (pe_ndf_kind)kind;
    info->accuracy = (pe_accuracy)accuracy;
    pe_exr_get_attribute(from->file, 0, &source);
    pe_exr_get_attribute(from->file, 0, &ndf_name);
    if (pe_exr_get_attribute(from->file, 0, &wanted) && isfinite(wanted.number))
        info->error_wanted = wanted.number;
    info->source_name = source.string;
    info->ndf_name = ndf_name.string;
    if (method == PE_METHOD_DEFAULT)
        return missing(from, "prefenv:method");
    status = read_hemispheres_info(from, info);
    AND_THEN(read_roughness_info(from, info))
    return status;
}

/* How many parts there are to be; 0: a count of normals that cannot be. */
static int expected_parts(const pe_maps_info *info)
{
    switch (info->method) {
    case PE_METHOD_BASELINE:
    case PE_METHOD_VOXELS:
        return 1;
    case PE_METHOD_REPRESENTATIVE:
        return info->normals / 2;
    case PE_METHOD_LAYERS:
        return info->images;
    case PE_METHOD_DEFAULT:
    case PE_METHOD_HEMISPHERES:
        break;
    }
    return info->angles;
}

static pe_status check_part_count(const header *from, const pe_maps_info *info)
{
    int parts = pe_exr_part_count(from->file), expected = expected_parts(info);

    if (parts == expected)
        return PE_OK;
    return pe_fail(from->error, PE_ERROR_FORMAT, "%s: has %d parts where %d normals and %d angles need %d", from->name,
                   parts, info->normals, info->angles, expected);
}

/* Parts of one size, but for layers, whose sizes are known; of lat-long maps, it is theirs and goes into info. */
static pe_status check_parts(const header *from, pe_maps_info *info)
{
    long long first_width, first_height;
    pe_status status = check_part_count(from, info);

    if (status != PE_OK || info->method == PE_METHOD_LAYERS)
        return status;
    pe_exr_part_size(from->file, 0, &first_width, &first_height);
    for (int k = 1; k < pe_exr_part_count(from->file); k++) {
        long long width, height;

        pe_exr_part_size(from->file, k, &width, &height);
        if (width != first_width || height != first_height)
            return pe_fail(from->error, PE_ERROR_FORMAT, "%s: part %d is %lld x %lld, part 0 is %lld x %lld",
                           from->name, k, width, height, first_width, first_height);
    }
    if (has_atlas(info))
        return PE_OK;
    if (first_width > PE_MAPS_SIDE_MAX || first_height > PE_MAPS_SIDE_MAX)
        return pe_fail(from->error, PE_ERROR_LIMIT, "%s: size %lld x %lld is more than %d on a side", from->name,
                       first_width, first_height, PE_MAPS_SIDE_MAX);
    info->width = (int)first_width;
    info->height = (int)first_height;
    return PE_OK;
}

static pe_status check_normal(const header *from, const pe_maps *maps, int k)
{
    double expected[3], n[3] = { 0, 0, 0 };
    pe_status status;

    if (maps->info.method != PE_METHOD_REPRESENTATIVE)
        return PE_OK;
    pe_maps_normal(maps, k, expected);
    status = get_vector(from, k, "prefenv:normal", n);
    if (status == PE_OK && !(pe_dot(n, expected) > 1 - 1e-6 && pe_dot(n, n) < 1 + 1e-6))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: prefenv:normal of part %d is not the geodesic sphere's",
                       from->name, k);
    return status;
}

static pe_status read_part(const header *from, int k, float *rgb, size_t values)
{
    pe_status status = pe_exr_read_part(from->file, k, rgb, from->error);

    for (size_t v = 0; status == PE_OK && v < values; v++)
        if (!isfinite(rgb[v]))
            return pe_fail(from->error, PE_ERROR_FORMAT, "%s: part %d holds a value that is not finite", from->name, k);
    return status;
}

/* Of layers, whose size follows from their place. */
static pe_status check_layer(const header *from, const pe_maps *maps, int k)
{
    long long width, height;
    int expected[2];

    if (maps->info.method != PE_METHOD_LAYERS)
        return PE_OK;
    pe_exr_part_size(from->file, k, &width, &height);
    pe_maps_image_size(maps, k, &expected[0], &expected[1]);
    if (width == expected[0] && height == expected[1])
        return PE_OK;
    return pe_fail(from->error, PE_ERROR_FORMAT, "%s: layer %d is %lld x %lld where %d layers need %d x %d", from->name,
                   k, width, height, maps->info.images, expected[0], expected[1]);
}

static pe_status read_latlong(const header *from, pe_maps *maps)
{
    pe_status status = PE_OK;

    for (int k = 0; status == PE_OK && k < maps->info.images; k++) {
        int width, height;

        pe_maps_image_size(maps, k, &width, &height);
        status = check_normal(from, maps, k);
        AND_THEN(check_layer(from, maps, k))
        AND_THEN(read_part(from, k, pe_maps_image_to_fill(maps, k), 3 * (size_t)width * (size_t)height))
    }
    return status;
}

static pe_status check_atlas(const header *from, const pe_atlas *atlas)
{
    long long width, height;

    pe_exr_part_size(from->file, 0, &width, &height);
    if (width == atlas->width && height == atlas->height)
        return PE_OK;
    return pe_fail(from->error, PE_ERROR_FORMAT, "%s: is %lld x %lld where %d maps of %d x %d need %d x %d", from->name,
                   width, height, atlas->count, atlas->tile_width, atlas->tile_height, atlas->width, atlas->height);
}

static pe_status read_atlases(const header *from, pe_maps *maps)
{
    pe_atlas atlas = atlas_of(&maps->info);
    size_t values = atlas_values(&atlas);
    int tiles = maps->info.images / maps->info.angles;
    float *picture;
    pe_status status = check_atlas(from, &atlas);

    for (int k = 0; status == PE_OK && k < maps->info.suns; k++)
        status = read_sun(from, k, &maps->suns);
    if (status != PE_OK)
        return status;
    picture = malloc(values * sizeof *picture);
    if (!picture)
        return pe_fail_memory(from->error, "an atlas of maps");
    for (int angle = 0; status == PE_OK && angle < maps->info.angles; angle++) {
        status = read_part(from, angle, picture, values);
        for (int k = 0; status == PE_OK && k < tiles; k++)
            pe_atlas_extract(&atlas, k, picture, pe_maps_image_to_fill(maps, k * maps->info.angles + angle));
    }
    free(picture);
    return status;
}

static pe_status read_file(const header *from, pe_maps **out)
{
    pe_maps_info info;
    pe_maps *maps = NULL;
    pe_error inner = { PE_OK, "" };
    pe_status status = read_info(from, &info);

    AND_THEN(check_parts(from, &info))
    if (status != PE_OK)
        return status;
    status = pe_maps_create(&info, &maps, &inner);
    if (status != PE_OK)
        return pe_fail(from->error, status == PE_ERROR_ARGUMENT ? PE_ERROR_FORMAT : status, "%s: %s", from->name,
                       inner.message);
    status = has_atlas(&info) ? read_atlases(from, maps) : read_latlong(from, maps);
    AND_THEN(pe_maps_finish(maps, 0, from->error))
    maps->info.format_version = info.format_version;
    if (status == PE_OK)
        *out = maps;
    else
        pe_maps_free(maps);
    return status;
}

pe_status pe_maps_read_memory(const void *bytes, size_t size, const char *name, pe_maps **maps, pe_error *error)
{
    header from = { NULL, name, error };
    pe_exr_file *file;
    pe_status status;

    if (!pe_exr_detect(bytes, size))
        return pe_fail(error, PE_ERROR_FORMAT, "%s: is not an OpenEXR file; make maps with prefenv bake", name);
    status = pe_exr_open(bytes, size, name, &file, error);
    if (status != PE_OK)
        return status;
    from.file = file;
    status = read_file(&from, maps);
    pe_exr_close(file);
    return status;
}

pe_status pe_maps_read(const char *path, pe_maps **maps, pe_error *error)
{
    unsigned char *bytes;
    size_t size;
    pe_status status = pe_file_read(path, &bytes, &size, error);

    if (status != PE_OK)
        return status;
    status = pe_maps_read_memory(bytes, size, path, maps, error);
    free(bytes);
    return status;
}

int pe_maps_detect(const void *bytes, size_t size)
{
    pe_attribute version = integer("prefenv:version", 0);

    return pe_exr_carries(bytes, size, &version);
}
