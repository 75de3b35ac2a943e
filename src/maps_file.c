/* maps_file.c - maps as an OpenEXR file: one part an image, header attributes that say all there is to know.
 *
 * Part "normal.00" holds the pair n_0, -n_0 and so on; a baseline file has the one part "baseline".  Attributes of the
 * first part: prefenv:version, :method, :ndf, :ndfName, :alphaX, :alphaY, :direction, :normals, :source, :sourceWidth,
 * :sourceHeight, :accuracy, :errorEstimate; of every part: prefenv:normal. */
#include "exr.h"
#include "maps.h"
#include "status.h"
#include "vector.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const method_names[] = { "representative", "baseline" };
static const char *const accuracy_names[] = { "auto", "exact", "fast" };
static const char *const ndf_names[] = { "beckmann", "ggx", "phong", "table" };

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))
#define PART_NAME_MAX 32
#define ATTRIBUTES 13

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
    };

    memcpy(out, all, sizeof all);
}

/* Everything a part needs while it is being written. */
typedef struct part_room {
    char name[PART_NAME_MAX];
    pe_attribute attributes[ATTRIBUTES + 1];
} part_room;

static void fill_part(const pe_maps *maps, int k, part_room *room, pe_exr_part *part)
{
    size_t count = 0;
    double n[3];

    if (maps->geodesic) {
        int digits = snprintf(NULL, 0, "%d", maps->info.images - 1);

        snprintf(room->name, sizeof room->name, "normal.%0*d", digits > 2 ? digits : 2, k);
        pe_maps_normal(maps, k, n);
        room->attributes[count++] = vector("prefenv:normal", n);
    } else {
        snprintf(room->name, sizeof room->name, "baseline");
    }
    if (k == 0) {
        describe(&maps->info, room->attributes + count);
        count += ATTRIBUTES;
    }
    *part = (pe_exr_part){ room->name, pe_maps_image(maps, k), room->attributes, count };
}

static pe_status check_half_range(const pe_maps *maps, const char *path, pe_error *error)
{
    const float largest_half = 65504;
    size_t values = (size_t)maps->info.images * pe_maps_image_values(maps);

    for (size_t k = 0; k < values; k++)
        if (maps->rgb[k] > largest_half)
            return pe_fail(error, PE_ERROR_LIMIT,
                           "%s: a radiance of %g is more than the 65504 a half float holds; write floats (--float)",
                           path, (double)maps->rgb[k]);
    return PE_OK;
}

static pe_status encode(const pe_maps *maps, pe_pixel_type type, unsigned char **bytes, size_t *size, pe_error *error)
{
    int count = maps->info.images;
    part_room *rooms = calloc((size_t)count, sizeof *rooms);
    pe_exr_part *parts = calloc((size_t)count, sizeof *parts);
    pe_status status = PE_ERROR_MEMORY;

    for (int k = 0; rooms && parts && k < count; k++)
        fill_part(maps, k, &rooms[k], &parts[k]);
    if (rooms && parts)
        status = pe_exr_encode(parts, count, maps->info.width, maps->info.height, type, bytes, size, error);
    else
        pe_fail_memory(error, "the parts of a maps file");
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

/* The index of a string attribute among `names`. */
static pe_status get_choice(const header *from, const char *name, const char *const *names, int count, int *value)
{
    pe_attribute a = string(name, NULL);

    if (!pe_exr_get_attribute(from->file, 0, &a))
        return missing(from, name);
    for (*value = 0; *value < count; ++*value)
        if (strcmp(a.string, names[*value]) == 0)
            return PE_OK;
    return pe_fail(from->error, PE_ERROR_FORMAT, "%s: %s '%.40s' is not known to this version of prefenv", from->name,
                   name, a.string);
}

static pe_status check_version(const header *from)
{
    int version = 0;
    pe_status status = get_integer(from, "prefenv:version", &version);

    if (status == PE_OK && version != PE_MAPS_FORMAT_VERSION)
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: format version %d is not the %d read here; bake it again",
                       from->name, version, PE_MAPS_FORMAT_VERSION);
    return status;
}

/* Runs its call only if all before it went well. */
#define AND_THEN(call) \
    if (status == PE_OK) \
        status = (call);

static pe_status read_info(const header *from, pe_maps_info *info)
{
    pe_attribute source = string("prefenv:source", ""), ndf_name = string("prefenv:ndfName", "");
    int method = 0, kind = 0, accuracy = 0;
    pe_status status = check_version(from);

    *info = (pe_maps_info){ .format_version = PE_MAPS_FORMAT_VERSION };
    AND_THEN(get_choice(from, "prefenv:method", method_names, COUNT(method_names), &method))
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
    info->surface.ndf.kind = (pe_ndf_kind)kind;
    info->accuracy = (pe_accuracy)accuracy;
    pe_exr_get_attribute(from->file, 0, &source);
    pe_exr_get_attribute(from->file, 0, &ndf_name);
    info->source_name = source.string;
    info->ndf_name = ndf_name.string;
    return PE_OK;
}

/* Parts of one size, as many as there are images; the size goes into info. */
static pe_status check_parts(const header *from, pe_maps_info *info)
{
    int parts = pe_exr_part_count(from->file);
    int expected = info->method == PE_METHOD_BASELINE ? 1 : info->normals / 2;
    long long first_width, first_height;

    if (parts != expected)
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: has %d parts where %d normals need %d", from->name, parts,
                       info->normals, expected);
    pe_exr_part_size(from->file, 0, &first_width, &first_height);
    for (int k = 1; k < parts; k++) {
        long long width, height;

        pe_exr_part_size(from->file, k, &width, &height);
        if (width != first_width || height != first_height)
            return pe_fail(from->error, PE_ERROR_FORMAT, "%s: part %d is %lld x %lld, part 0 is %lld x %lld",
                           from->name, k, width, height, first_width, first_height);
    }
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

    if (!maps->geodesic)
        return PE_OK;
    pe_maps_normal(maps, k, expected);
    status = get_vector(from, k, "prefenv:normal", n);
    if (status == PE_OK && !(pe_dot(n, expected) > 1 - 1e-6 && pe_dot(n, n) < 1 + 1e-6))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: prefenv:normal of part %d is not the geodesic sphere's",
                       from->name, k);
    return status;
}

static pe_status read_image(const header *from, pe_maps *maps, int k)
{
    float *rgb = maps->rgb + (size_t)k * pe_maps_image_values(maps);
    pe_status status = check_normal(from, maps, k);

    AND_THEN(pe_exr_read_part(from->file, k, rgb, from->error))
    if (status != PE_OK)
        return status;
    for (size_t v = 0; v < pe_maps_image_values(maps); v++)
        if (!isfinite(rgb[v]))
            return pe_fail(from->error, PE_ERROR_FORMAT, "%s: part %d holds a value that is not finite", from->name, k);
    return PE_OK;
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
    for (int k = 0; status == PE_OK && k < maps->info.images; k++)
        status = read_image(from, maps, k);
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
    pe_exr_file *file;
    int found;

    if (!pe_exr_detect(bytes, size) || pe_exr_open(bytes, size, "", &file, NULL) != PE_OK)
        return 0;
    found = pe_exr_get_attribute(file, 0, &version);
    pe_exr_close(file);
    return found;
}
