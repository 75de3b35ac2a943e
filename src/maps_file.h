/* maps_file.h - maps as an OpenEXR file: pictures, and header attributes that say all there is to know.
 *
 * Hemispheres: one part for each brush angle, "angle.00" and so on, with the hemispheres of all normals side by side,
 * row by row: an atlas.  Lat-long maps: part "normal.00" holds the pair n_0, -n_0 and so on, with attribute
 * prefenv:normal; a baseline file has the one part "baseline".  Layers: part "layer.00" is the smoothest, each lat-long
 * and with attribute prefenv:exponent.  Voxels: one part "voxels", the slices of the cube side by side, row by row.
 * Grades: those of hemispheres for each, "grade.00.angle.00" and so on, the smoothest first.
 *
 * Attributes of the first part: prefenv:version, :method,
 * :weight, :eta, :k, :ndf, :ndfName, :alphaX, :alphaY, :direction, :normals, :source, :sourceWidth, :sourceHeight,
 * :accuracy, :errorEstimate, :errorWanted and :sourceFingerprint (which may be missing); of hemispheres :angles,
 * :width, :height, :lookupError, :poleAngles, :poleCosine, :suns, :turn (the degrees that the angles divide), and for
 * each sun :sun.00.direction and :sun.00.power; of layers and voxels :size, :window, :levels, :lookupError, :width,
 * :threshold and :lost; of grades :grades, :alphaMax, :lookupError, :angles, :suns, :turn, the suns, and, in each
 * grade's first part, :grade.alphaX, :grade.alphaY, :grade.normals, :grade.width, :grade.height, :grade.poleAngles,
 * :grade.poleCosine and :grade.lookupError; the two alphas are for people, and follow from the first part's. */
#ifndef PE_MAPS_FILE_H
#define PE_MAPS_FILE_H

#include "atlas.h"
#include "exr.h"
#include "maps.h"

#include <stdio.h>

static const char *const pe_method_names[] = PE_METHOD_NAMES;
static const char *const pe_lost_names[] = { "spread", "dark" };
static const char *const pe_accuracy_names[] = { "auto", "exact", "fast" };
static const char *const pe_weight_names[] = { "ndf", "microfacet" };
static const char *const pe_ndf_names[] = PE_NDF_NAMES;

#define PE_SUN_NAME_MAX 40
#define PE_FINGERPRINT_DIGITS 16 /* hexadecimal */

static inline pe_attribute pe_attribute_integer(const char *name, int value)
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_INT, .integer = value };
}

static inline pe_attribute pe_attribute_number(const char *name, double value)
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_DOUBLE, .number = value };
}

static inline pe_attribute pe_attribute_vector(const char *name, const double v[3])
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_VECTOR, .vector = { v[0], v[1], v[2] } };
}

static inline pe_attribute pe_attribute_string(const char *name, const char *value)
{
    return (pe_attribute){ .name = name, .type = PE_ATTRIBUTE_STRING, .string = value };
}

/* The degrees that brush angles divide. */
static inline int pe_maps_degrees(const pe_maps_info *info)
{
    return (int)nearbyint(pe_maps_turn(info) * 180 / M_PI);
}

static inline void pe_maps_name_sun(int sun, const char *what, char name[PE_SUN_NAME_MAX])
{
    snprintf(name, PE_SUN_NAME_MAX, "prefenv:sun.%02d.%s", sun, what);
}

/* Several images of one size are one part, side by side. */
static inline int pe_maps_have_atlas(const pe_maps_info *info)
{
    return info->method == PE_METHOD_HEMISPHERES || info->method == PE_METHOD_VOXELS;
}

static inline pe_atlas pe_maps_atlas(const pe_maps_info *info)
{
    return pe_atlas_of(info->images / info->angles, info->width, info->height);
}

static inline size_t pe_atlas_values(const pe_atlas *atlas)
{
    return 3 * (size_t)atlas->width * (size_t)atlas->height;
}

#endif
