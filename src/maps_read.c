/* maps_read.c - maps from an OpenEXR file, all of it checked: see maps_file.h. */
#include "maps_file.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* Where attributes are read from, and whom to tell if one is missing. */
typedef struct header {
    const pe_exr_file *file;
    int part;
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
    pe_attribute a = pe_attribute_integer(name, 0);

    if (!pe_exr_get_attribute(from->file, from->part, &a))
        return missing(from, name);
    *value = a.integer;
    return PE_OK;
}

static pe_status get_number(const header *from, const char *name, double *value)
{
    pe_attribute a = pe_attribute_number(name, 0);

    if (!pe_exr_get_attribute(from->file, from->part, &a))
        return missing(from, name);
    if (!isfinite(a.number))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: attribute %s is not a finite number", from->name, name);
    *value = a.number;
    return PE_OK;
}

static pe_status get_vector(const header *from, int part, const char *name, double value[3])
{
    static const double zero[3] = { 0, 0, 0 };
    pe_attribute a = pe_attribute_vector(name, zero);

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
    pe_attribute a = pe_attribute_string(name, NULL);
    char shown[SHOWN_BYTES];

    if (!pe_exr_get_attribute(from->file, from->part, &a))
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
    pe_attribute a = pe_attribute_integer("prefenv:turn", 0);

    if (pe_exr_get_attribute(from->file, from->part, &a))
        turn = a.integer;
    if (info->angles == 1 || turn == pe_maps_degrees(info))
        return PE_OK;
    return pe_fail(from->error, PE_ERROR_FORMAT,
                   "%s: its %d angles divide %d degrees where %d are read here; bake it again", from->name,
                   info->angles, turn, pe_maps_degrees(info));
}

static pe_status check_suns(const header *from, const pe_maps_info *info)
{
    if (info->suns && !pe_suns_possible(&info->surface))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: has suns, which maps of its ndf cannot have", from->name);
    if (info->suns < 0 || info->suns > PE_SUNS_MAX)
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: prefenv:suns %d is out of range; at most %d can be",
                       from->name, info->suns, PE_SUNS_MAX);
    return PE_OK;
}

/* Files from before there was this attribute do not tell. */
static pe_status read_fingerprint(const header *from, pe_maps_info *info)
{
    pe_attribute a = pe_attribute_string("prefenv:sourceFingerprint", "");
    char shown[SHOWN_BYTES];

    if (!pe_exr_get_attribute(from->file, from->part, &a))
        return PE_OK;
    if (strlen(a.string) == PE_FINGERPRINT_DIGITS && strspn(a.string, "0123456789abcdef") == PE_FINGERPRINT_DIGITS) {
        info->source_fingerprint = strtoull(a.string, NULL, 16);
        return PE_OK;
    }
    show(a.string, shown);
    return pe_fail(from->error, PE_ERROR_FORMAT, "%s: prefenv:sourceFingerprint '%s' is not %d hexadecimal digits",
                   from->name, shown, PE_FINGERPRINT_DIGITS);
}

/* What hemispheres have besides. */
static pe_status read_hemispheres_info(const header *from, pe_maps_info *info)
{
    pe_attribute poles = pe_attribute_integer("prefenv:poleAngles", 0);
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
    AND_THEN(check_suns(from, info))
    return status;
}

/* What grades have in common besides; how many parts there have to be hangs on two numbers, which are looked at
 * before. */
static pe_status read_grades_info(const header *from, pe_maps_info *info)
{
    pe_status status = PE_OK;

    if (info->method != PE_METHOD_GRADES)
        return PE_OK;
    AND_THEN(get_integer(from, "prefenv:grades", &info->grades))
    AND_THEN(get_number(from, "prefenv:alphaMax", &info->alpha_max))
    AND_THEN(get_number(from, "prefenv:lookupError", &info->lookup_error))
    AND_THEN(get_integer(from, "prefenv:angles", &info->angles))
    AND_THEN(get_integer(from, "prefenv:suns", &info->suns))
    AND_THEN(check_turn(from, info))
    AND_THEN(check_suns(from, info))
    if (status == PE_OK && (info->grades < PE_GRADES_MIN || info->grades > PE_GRADES_MAX || info->angles < 1 ||
                            info->angles > PE_MAPS_ANGLES_MAX))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: %d grades of %d angles are out of range", from->name,
                       info->grades, info->angles);
    return status;
}

/* What each of them has. */
static pe_status read_grade_info(const header *from, pe_maps_info *grade)
{
    pe_status status = PE_OK;

    AND_THEN(get_integer(from, "prefenv:grade.normals", &grade->normals))
    AND_THEN(get_integer(from, "prefenv:grade.width", &grade->width))
    AND_THEN(get_integer(from, "prefenv:grade.height", &grade->height))
    AND_THEN(get_integer(from, "prefenv:grade.poleAngles", &grade->pole_angles))
    AND_THEN(get_number(from, "prefenv:grade.poleCosine", &grade->pole_cosine))
    AND_THEN(get_number(from, "prefenv:grade.lookupError", &grade->lookup_error))
    return status;
}

/* What layers and voxels have besides. */
static pe_status read_roughness_info(const header *from, pe_maps_info *info)
{
    int lost = 0;
    pe_status status = PE_OK;

    if (!pe_method_has_lambda(info->method))
        return PE_OK;
    AND_THEN(get_integer(from, "prefenv:size", &info->smoothness.size))
    AND_THEN(get_number(from, "prefenv:window", &info->smoothness.window))
    AND_THEN(get_number(from, "prefenv:levels", &info->smoothness.levels))
    AND_THEN(get_number(from, "prefenv:lookupError", &info->lookup_error))
    AND_THEN(get_integer(from, "prefenv:width", &info->width))
    AND_THEN(get_number(from, "prefenv:threshold", &info->threshold))
    AND_THEN(get_choice(from, "prefenv:lost", pe_lost_names, COUNT(pe_lost_names), &lost))
    info->lost = (pe_lost_weight)lost;
    info->height = info->method == PE_METHOD_LAYERS ? info->width / 2 : info->width;
    info->images = info->method == PE_METHOD_LAYERS ? pe_exr_part_count(from->file) : info->smoothness.size;
    return status;
}

static pe_status read_sun(const header *from, int k, pe_suns *suns)
{
    char name[PE_SUN_NAME_MAX];
    double direction[3] = { 0 }, power[3] = { 0 };
    pe_status status;

    pe_maps_name_sun(k, "direction", name);
    status = get_vector(from, 0, name, direction);
    if (status == PE_OK && !(fabs(pe_dot(direction, direction) - 1) < 1e-6))
        return pe_fail(from->error, PE_ERROR_FORMAT, "%s: %s is not of length 1", from->name, name);
    pe_maps_name_sun(k, "power", name);
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
    pe_attribute source = pe_attribute_string("prefenv:source", ""),
                 ndf_name = pe_attribute_string("prefenv:ndfName", "");
    pe_attribute wanted = pe_attribute_number("prefenv:errorWanted", 0);
    int method = 0, weight = 0, kind = 0, accuracy = 0;
    pe_status status;

    *info = (pe_maps_info){ .format_version = 0 };
    status = read_version(from, &info->format_version);
    AND_THEN(get_choice(from, "prefenv:method", pe_method_names, COUNT(pe_method_names), &method))
    AND_THEN(get_choice(from, "prefenv:weight", pe_weight_names, COUNT(pe_weight_names), &weight))
    AND_THEN(get_vector(from, 0, "prefenv:eta", info->surface.eta))
    AND_THEN(get_vector(from, 0, "prefenv:k", info->surface.k))
    AND_THEN(get_choice(from, "prefenv:ndf", pe_ndf_names, COUNT(pe_ndf_names), &kind))
    AND_THEN(get_number(from, "prefenv:alphaX", &info->surface.ndf.alpha_x))
    AND_THEN(get_number(from, "prefenv:alphaY", &info->surface.ndf.alpha_y))
    AND_THEN(get_vector(from, 0, "prefenv:direction", info->direction))
    AND_THEN(get_integer(from, "prefenv:normals", &info->normals))
    AND_THEN(get_integer(from, "prefenv:sourceWidth", &info->source_width))
    AND_THEN(get_integer(from, "prefenv:sourceHeight", &info->source_height))
    AND_THEN(get_choice(from, "prefenv:accuracy", pe_accuracy_names, COUNT(pe_accuracy_names), &accuracy))
    AND_THEN(get_number(from, "prefenv:errorEstimate", &info->error_estimate))
    AND_THEN(read_fingerprint(from, info))
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
    AND_THEN(read_grades_info(from, info))
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
    case PE_METHOD_GRADES:
        return info->grades * info->angles;
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

/* Parts of one size, but for layers and grades, whose sizes are known; of lat-long maps it is theirs and goes into
 * info. */
static pe_status check_parts(const header *from, pe_maps_info *info)
{
    long long first_width, first_height;
    pe_status status = check_part_count(from, info);

    if (status != PE_OK || info->method == PE_METHOD_LAYERS || info->method == PE_METHOD_GRADES)
        return status;
    pe_exr_part_size(from->file, 0, &first_width, &first_height);
    for (int k = 1; k < pe_exr_part_count(from->file); k++) {
        long long width, height;

        pe_exr_part_size(from->file, k, &width, &height);
        if (width != first_width || height != first_height)
            return pe_fail(from->error, PE_ERROR_FORMAT, "%s: part %d is %lld x %lld, part 0 is %lld x %lld",
                           from->name, k, width, height, first_width, first_height);
    }
    if (pe_maps_have_atlas(info))
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

static pe_status check_atlas(const header *from, int part, const pe_atlas *atlas)
{
    long long width, height;

    pe_exr_part_size(from->file, part, &width, &height);
    if (width == atlas->width && height == atlas->height)
        return PE_OK;
    return pe_fail(from->error, PE_ERROR_FORMAT, "%s: part %d is %lld x %lld where %d maps of %d x %d need %d x %d",
                   from->name, part, width, height, atlas->count, atlas->tile_width, atlas->tile_height, atlas->width,
                   atlas->height);
}

static pe_status read_suns(const header *from, pe_maps *maps)
{
    pe_status status = PE_OK;

    for (int k = 0; status == PE_OK && k < maps->info.suns; k++)
        status = read_sun(from, k, &maps->suns);
    return status;
}

/* From the part `first` on. */
static pe_status read_atlases(const header *from, int first, pe_maps *maps)
{
    pe_atlas atlas = pe_maps_atlas(&maps->info);
    size_t values = pe_atlas_values(&atlas);
    int tiles = maps->info.images / maps->info.angles;
    float *picture;
    pe_status status = PE_OK;

    for (int angle = 0; status == PE_OK && angle < maps->info.angles; angle++)
        status = check_atlas(from, first + angle, &atlas);
    if (status != PE_OK)
        return status;
    picture = malloc(values * sizeof *picture);
    if (!picture)
        return pe_fail_memory(from->error, "an atlas of maps");
    for (int angle = 0; status == PE_OK && angle < maps->info.angles; angle++) {
        status = read_part(from, first + angle, picture, values);
        for (int k = 0; status == PE_OK && k < tiles; k++)
            pe_atlas_extract(&atlas, k, picture, pe_maps_image_to_fill(maps, k * maps->info.angles + angle));
    }
    free(picture);
    return status;
}

static pe_status create_grades(const header *from, const pe_maps_info *info, pe_maps **maps, pe_error *inner)
{
    pe_maps_info each[PE_GRADES_MAX] = { { 0 } };
    pe_status status = PE_OK;

    for (int k = 0; k < info->grades && status == PE_OK; k++) {
        const header its = { from->file, k * info->angles, from->name, from->error };

        status = read_grade_info(&its, &each[k]);
    }
    return status == PE_OK ? pe_grades_create(info, each, maps, inner) : status;
}

/* The maps that the file says it holds, without their pictures. */
static pe_status create(const header *from, const pe_maps_info *info, pe_maps **maps)
{
    pe_error inner = { PE_OK, "" };
    pe_status status =
        info->method == PE_METHOD_GRADES ? create_grades(from, info, maps, &inner) : pe_maps_create(info, maps, &inner);

    if (inner.status == PE_OK)
        return status;
    return pe_fail(from->error, status == PE_ERROR_ARGUMENT ? PE_ERROR_FORMAT : status, "%s: %s", from->name,
                   inner.message);
}

static pe_status read_pictures(const header *from, pe_maps *maps)
{
    pe_status status = read_suns(from, maps);

    for (int k = 0; k < maps->info.grades; k++)
        AND_THEN(read_atlases(from, k * maps->info.angles, maps->grades[k]))
    if (status != PE_OK || maps->grades)
        return status;
    return pe_maps_have_atlas(&maps->info) ? read_atlases(from, 0, maps) : read_latlong(from, maps);
}

static pe_status read_file(const header *from, pe_maps **out)
{
    pe_maps_info info;
    pe_maps *maps = NULL;
    pe_status status = read_info(from, &info);

    AND_THEN(check_parts(from, &info))
    AND_THEN(create(from, &info, &maps))
    if (status != PE_OK)
        return status;
    status = read_pictures(from, maps);
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
    header from = { NULL, 0, name, error };
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
    pe_attribute version = pe_attribute_integer("prefenv:version", 0);

    return pe_exr_carries(bytes, size, &version);
}
