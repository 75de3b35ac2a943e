/* maps_write.c - maps to an OpenEXR file: see maps_file.h. */
#include "maps_file.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

#define PART_NAME_MAX 48
#define ATTRIBUTES 18
#define HEMISPHERE_ATTRIBUTES 8
#define ROUGHNESS_ATTRIBUTES 7
#define GRADES_ATTRIBUTES 6
#define GRADE_ATTRIBUTES 8

static void describe(const pe_maps_info *info, const char *fingerprint, pe_attribute out[ATTRIBUTES])
{
    const pe_attribute all[ATTRIBUTES] = {
        pe_attribute_integer("prefenv:version", PE_MAPS_FORMAT_VERSION),
        pe_attribute_string("prefenv:method", pe_method_names[info->method]),
        pe_attribute_string("prefenv:weight", pe_weight_names[info->surface.weight]),
        pe_attribute_vector("prefenv:eta", info->surface.eta),
        pe_attribute_vector("prefenv:k", info->surface.k),
        pe_attribute_string("prefenv:ndf", pe_ndf_names[info->surface.ndf.kind]),
        pe_attribute_string("prefenv:ndfName", info->ndf_name),
        pe_attribute_number("prefenv:alphaX", info->surface.ndf.alpha_x),
        pe_attribute_number("prefenv:alphaY", info->surface.ndf.alpha_y),
        pe_attribute_vector("prefenv:direction", info->direction),
        pe_attribute_integer("prefenv:normals", info->normals),
        pe_attribute_string("prefenv:source", info->source_name),
        pe_attribute_integer("prefenv:sourceWidth", info->source_width),
        pe_attribute_integer("prefenv:sourceHeight", info->source_height),
        pe_attribute_string("prefenv:accuracy", pe_accuracy_names[info->accuracy]),
        pe_attribute_number("prefenv:errorEstimate", info->error_estimate),
        pe_attribute_number("prefenv:errorWanted", info->error_wanted),
        pe_attribute_string("prefenv:sourceFingerprint", fingerprint),
    };

    memcpy(out, all, sizeof all);
}

static void describe_hemispheres(const pe_maps_info *info, pe_attribute out[HEMISPHERE_ATTRIBUTES])
{
    const pe_attribute all[HEMISPHERE_ATTRIBUTES] = {
        pe_attribute_integer("prefenv:angles", info->angles),
        pe_attribute_integer("prefenv:width", info->width),
        pe_attribute_integer("prefenv:height", info->height),
        pe_attribute_number("prefenv:lookupError", info->lookup_error),
        pe_attribute_integer("prefenv:suns", info->suns),
        pe_attribute_integer("prefenv:turn", pe_maps_degrees(info)),
        pe_attribute_integer("prefenv:poleAngles", info->pole_angles),
        pe_attribute_number("prefenv:poleCosine", info->pole_cosine),
    };

    memcpy(out, all, sizeof all);
}

static void describe_roughness(const pe_maps_info *info, pe_attribute out[ROUGHNESS_ATTRIBUTES])
{
    const pe_attribute all[ROUGHNESS_ATTRIBUTES] = {
        pe_attribute_integer("prefenv:size", info->smoothness.size),
        pe_attribute_number("prefenv:window", info->smoothness.window),
        pe_attribute_number("prefenv:levels", info->smoothness.levels),
        pe_attribute_number("prefenv:lookupError", info->lookup_error),
        pe_attribute_integer("prefenv:width", info->width),
        pe_attribute_number("prefenv:threshold", info->threshold),
        pe_attribute_string("prefenv:lost", pe_lost_names[info->lost]),
    };

    memcpy(out, all, sizeof all);
}

static void describe_grades(const pe_maps_info *info, pe_attribute out[GRADES_ATTRIBUTES])
{
    const pe_attribute all[GRADES_ATTRIBUTES] = {
        pe_attribute_integer("prefenv:grades", info->grades),
        pe_attribute_number("prefenv:alphaMax", info->alpha_max),
        pe_attribute_number("prefenv:lookupError", info->lookup_error),
        pe_attribute_integer("prefenv:angles", info->angles),
        pe_attribute_integer("prefenv:suns", info->suns),
        pe_attribute_integer("prefenv:turn", pe_maps_degrees(info)),
    };

    memcpy(out, all, sizeof all);
}

static void describe_grade(const pe_maps_info *info, pe_attribute out[GRADE_ATTRIBUTES])
{
    const pe_attribute all[GRADE_ATTRIBUTES] = {
        pe_attribute_number("prefenv:grade.alphaX", info->surface.ndf.alpha_x),
        pe_attribute_number("prefenv:grade.alphaY", info->surface.ndf.alpha_y),
        pe_attribute_integer("prefenv:grade.normals", info->normals),
        pe_attribute_integer("prefenv:grade.width", info->width),
        pe_attribute_integer("prefenv:grade.height", info->height),
        pe_attribute_integer("prefenv:grade.poleAngles", info->pole_angles),
        pe_attribute_number("prefenv:grade.poleCosine", info->pole_cosine),
        pe_attribute_number("prefenv:grade.lookupError", info->lookup_error),
    };

    memcpy(out, all, sizeof all);
}

/* Everything a part needs while it is being written. */
typedef struct part_room {
    char name[PART_NAME_MAX];
    pe_attribute attributes[ATTRIBUTES + HEMISPHERE_ATTRIBUTES + GRADE_ATTRIBUTES + 2 * PE_SUNS_MAX];
    char sun_names[2 * PE_SUNS_MAX][PE_SUN_NAME_MAX];
    char fingerprint[PE_FINGERPRINT_DIGITS + 1];
} part_room;

static size_t describe_suns(const pe_suns *suns, part_room *room, pe_attribute *out)
{
    for (int k = 0; k < suns->count; k++) {
        pe_maps_name_sun(k, "direction", room->sun_names[2 * k]);
        pe_maps_name_sun(k, "power", room->sun_names[2 * k + 1]);
        out[2 * k] = pe_attribute_vector(room->sun_names[2 * k], suns->direction[k]);
        out[2 * k + 1] = pe_attribute_vector(room->sun_names[2 * k + 1], suns->power[k]);
    }
    return 2 * (size_t)suns->count;
}

static int parts_of(const pe_maps_info *info)
{
    if (info->method == PE_METHOD_GRADES)
        return info->grades * info->angles;
    return pe_maps_have_atlas(info) ? info->angles : info->images;
}

static void name_part(const pe_maps_info *info, int k, char name[PART_NAME_MAX])
{
    static const char *const names[] = { "", "angle", "normal", "baseline", "layer", "voxels", "" };
    int digits = snprintf(NULL, 0, "%d", parts_of(info) - 1);

    if (info->method == PE_METHOD_BASELINE || info->method == PE_METHOD_VOXELS)
        snprintf(name, PART_NAME_MAX, "%s", names[info->method]);
    else if (info->method == PE_METHOD_GRADES)
        snprintf(name, PART_NAME_MAX, "grade.%02d.angle.%02d", k / info->angles, k % info->angles);
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
        room->attributes[count++] = pe_attribute_vector("prefenv:normal", n);
    }
    if (maps->info.method == PE_METHOD_LAYERS)
        room->attributes[count++] = pe_attribute_number("prefenv:exponent", pe_maps_image_exponent(maps, k));
    if (maps->info.method == PE_METHOD_GRADES && k % maps->info.angles == 0) {
        describe_grade(&maps->grades[k / maps->info.angles]->info, room->attributes + count);
        count += GRADE_ATTRIBUTES;
    }
    if (k == 0) {
        snprintf(room->fingerprint, sizeof room->fingerprint, "%0*llx", PE_FINGERPRINT_DIGITS,
                 maps->info.source_fingerprint);
        describe(&maps->info, room->fingerprint, room->attributes + count);
        count += ATTRIBUTES;
    }
    if (k == 0 && maps->info.method == PE_METHOD_HEMISPHERES) {
        describe_hemispheres(&maps->info, room->attributes + count);
        count += HEMISPHERE_ATTRIBUTES;
        count += describe_suns(&maps->suns, room, room->attributes + count);
    }
    if (k == 0 && maps->info.method == PE_METHOD_GRADES) {
        describe_grades(&maps->info, room->attributes + count);
        count += GRADES_ATTRIBUTES;
        count += describe_suns(&maps->suns, room, room->attributes + count);
    }
    if (k == 0 && pe_method_has_lambda(maps->info.method)) {
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
    size_t values = maps->rgb ? pe_maps_values(maps) : 0;
    float largest = 0;
    int is_over = 0;
    pe_status status = PE_OK;

    for (int k = 0; k < maps->info.grades && status == PE_OK; k++)
        status = check_half_range(maps->grades[k], path, error);
    for (size_t k = 0; k < values; k++)
        is_over |= maps->rgb[k] > largest_half;
    if (!is_over)
        return status;
    for (size_t k = 0; k < values; k++)
        largest = fmaxf(largest, maps->rgb[k]);
    return pe_fail(error, PE_ERROR_LIMIT,
                   "%s: a radiance of %g is more than the 65504 a half float holds; write floats (--float)", path,
                   (double)largest);
}

/* Floats of the atlases of all parts. */
static size_t values_of_atlases(const pe_maps *maps)
{
    pe_atlas atlas;
    size_t values = 0;

    for (int k = 0; k < maps->info.grades; k++)
        values += values_of_atlases(maps->grades[k]);
    if (maps->grades)
        return values;
    atlas = pe_maps_atlas(&maps->info);
    return (size_t)maps->info.angles * pe_atlas_values(&atlas);
}

/* Atlases for the parts, one after the other: in image k lies the tile k / angles of part k % angles.  `pictures` are
 * zeros. */
static void add_atlases(const pe_maps *maps, pe_exr_part *parts, float *pictures)
{
    pe_atlas atlas = pe_maps_atlas(&maps->info);
    int angles = maps->info.angles;

    for (int k = 0; k < maps->info.images; k++)
        pe_atlas_insert(&atlas, k / angles, pe_maps_image(maps, k),
                        pictures + (size_t)(k % angles) * pe_atlas_values(&atlas));
    for (int k = 0; k < angles; k++) {
        parts[k].rgb = pictures + (size_t)k * pe_atlas_values(&atlas);
        parts[k].width = atlas.width;
        parts[k].height = atlas.height;
    }
}

/* Gives the parts their pictures; *own is to be freed. */
static pe_status add_pictures(const pe_maps *maps, pe_exr_part *parts, float **own, pe_error *error)
{
    float *pictures;

    *own = NULL;
    for (int k = 0; k < parts_of(&maps->info) && !maps->grades && !pe_maps_have_atlas(&maps->info); k++) {
        parts[k].rgb = pe_maps_image(maps, k);
        pe_maps_image_size(maps, k, &parts[k].width, &parts[k].height);
    }
    if (!maps->grades && !pe_maps_have_atlas(&maps->info))
        return PE_OK;
    *own = pictures = calloc(values_of_atlases(maps) + 1, sizeof *pictures); /* none is something, too */
    if (!pictures)
        return pe_fail_memory(error, "an atlas of maps");
    if (!maps->grades)
        add_atlases(maps, parts, pictures);
    for (int k = 0; k < maps->info.grades; k++) {
        add_atlases(maps->grades[k], parts + (size_t)k * (size_t)maps->info.angles, pictures);
        pictures += values_of_atlases(maps->grades[k]);
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
